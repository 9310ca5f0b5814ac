/* `carom-lab learn`: the numbers of src/plan/learned.h, fitted to racks that are played.
 *
 * A rack begins after a break, with some balls of both groups taken away, and is played until the
 * turn ends, by a player whose errors are drawn. Of each layout on the way the sample has x, as
 * carom_plan_features() tells it, and what came of it. Two logistic regressions by maximum
 * likelihood follow, by Newton's method: one of whether the turn was kept, and one of the later
 * pots of the visit, which come one after the other with equal chances until one fails.
 */
#include "command.h"
#include "memory.h"
#include "message.h"
#include "options.h"
#include "rack_play.h"
#include "subcommands.h"

#include "plan/view.h"
#include "platform/threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STROKES_MOST = 20, BLOCK = 256, STEPS = 30 };

typedef struct learn_job {
  shared_options shared;
  int racks, shots, seed;
} learn_job;

OPTION(learn_job, learn_racks, "racks", racks, 0, "N", set_count, 10,
       "racks to be played (default 100000)");
OPTION(learn_job, learn_shots, "shots", shots, 0, "N", set_count, 100,
       "shots of a plan (default 200)");
OPTION(learn_job, learn_seed, "seed", seed, 0, "N", set_count, 0, "seed of the racks (default 0)");

/* A layout before a stroke; how many later pots came, and how many failed. */
typedef struct sample {
  double x[NEXT_NUMBERS];
  int kept, later, failed;
} sample;

/* The layouts of a rack. */
typedef struct visit {
  int count;
  sample of[STROKES_MOST];
} visit;

typedef struct block {
  const learn_job *job;
  int first;
  visit *visit;
} block;

/* ---- Racks */

static sample look(const lab_rack *rack, bool hand) {
  static const int who = 0;
  carom_view view;
  carom_view_make(&view, &rack->plan, &rack->options);
  carom_ball_state state[RACK_BALLS];
  for (int k = 0; k < RACK_BALLS; k++)
    state[k] = rack->balls[k].state;
  const uint32_t in_play = carom_in_play(state, RACK_BALLS);
  sample s = {.kept = 0};
  carom_plan_features(&view, state, in_play, rack->rules.on(rack->rules.user, in_play),
                      ~UINT32_C(0), who, hand, s.x);
  return s;
}

static void play(const learn_job *job, int number, visit *to) {
  static const double errors[] = {0.25, 0.5, 1.0, 2.0, 3.0, 4.5};
  enum { PLAYERS = sizeof errors / sizeof errors[0], SOLIDS = 1, GROUP = 7 };
  static const int first_of[2] = {1, 9};
  lab_random draw = {((uint64_t)job->seed << 32) + 104729 * ((uint64_t)number + 1)};
  carom_table table;
  carom_table_make(CAROM_TABLE_POOLTOOL, &table);
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_player player = carom_player_of(errors[(int)lab_uniform(&draw, 0.0, PLAYERS)]);
  const carom_shot_options shot = {.space = CAROM_SPACE_FLAT, .plain = 1};
  lab_rack rack = {.options = {.shots = job->shots}};
  rack.plan = (carom_plan_job){.table = &table,
                               .cue = &cue,
                               .player = &player,
                               .shot = &shot,
                               .memory_size = carom_plan_memory(&rack.options)};
  rack.plan.memory = allocate(1, rack.plan.memory_size);
  lab_rack_make(&rack, lab_bits(&draw));

  /* some balls of both groups are down; the cue ball is anywhere, or in hand once in eight */
  rack.rules.user[0] = SOLIDS;
  for (int group = 0; group < 2; group++)
    for (int left = (int)lab_uniform(&draw, 0.0, GROUP + 1); left > 0; left--) {
      const int k = first_of[group] + (int)lab_uniform(&draw, 0.0, GROUP);
      rack.balls[k].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
    }
  double x, y;
  do {
    x = lab_uniform(&draw, 0.0, table.width);
    y = lab_uniform(&draw, 0.0, table.length);
  } while (carom_place_ball(&table, rack.balls, RACK_BALLS, 0, x, y, NULL) != CAROM_OK);
  bool hand = lab_bits(&draw) % 8 == 0;

  /* until the turn ends */
  carom_turn turn = {.is = CAROM_TURN_KEEP};
  to->count = 0;
  while (turn.is == CAROM_TURN_KEEP && to->count < STROKES_MOST) {
    carom_choice choice;
    sample s = look(&rack, hand);
    if (!lab_rack_stroke(&rack, hand, &choice, &turn))
      break;
    s.kept = turn.is == CAROM_TURN_KEEP || turn.is == CAROM_TURN_WIN;
    to->of[to->count++] = s;
    hand = false;
  }
  const bool won = turn.is == CAROM_TURN_WIN;
  for (int k = 0; k < to->count; k++)
    if (to->of[k].kept) {
      to->of[k].later = to->count - 1 - k - !won;
      to->of[k].failed = !won;
    }
  free(rack.plan.memory);
}

static size_t play_some(const void *context, size_t from, size_t end) {
  const block *b = context;
  for (size_t k = from; k < end; k++)
    play(b->job, b->first + (int)k, &b->visit[k]);
  return end;
}

/* ---- The fit */

/* Solves H d = g for a positive definite H by Gauss's method; d comes in the place of g. */
static void solve(int n, double H[][NEXT_NUMBERS], double *g) {
  for (int i = 0; i < n; i++)
    for (int k = i + 1; k < n; k++) {
      const double part = H[k][i] / H[i][i];
      for (int j = i; j < n; j++)
        H[k][j] -= part * H[i][j];
      g[k] -= part * g[i];
    }
  for (int i = n - 1; i >= 0; i--) {
    for (int j = i + 1; j < n; j++)
      g[i] -= H[i][j] * g[j];
    g[i] /= H[i][i];
  }
}

static double chance(const double *w, const double *x, int n) {
  double sum = 0.0;
  for (int k = 0; k < n; k++)
    sum += w[k] * x[k];
  return 1.0 / (1.0 + exp(-sum));
}

/* Successes and trials of a sample: of the next stroke, or of the later ones. */
static int successes(const sample *s, bool next) {
  return next ? s->kept : s->later;
}
static int trials(const sample *s, bool next) {
  return next ? 1 : s->later + s->failed;
}

/* The numbers w of greatest likelihood, and a trace of a prior that keeps them finite. */
static void fit(const sample *s, size_t count, bool next, int n, double *w) {
  memset(w, 0, (size_t)n * sizeof *w);
  for (int step = 0; step < STEPS; step++) {
    double H[NEXT_NUMBERS][NEXT_NUMBERS] = {{0.0}}, g[NEXT_NUMBERS];
    for (int i = 0; i < n; i++) {
      H[i][i] = 1e-3;
      g[i] = -1e-3 * w[i];
    }
    for (size_t k = 0; k < count; k++) {
      const double *x = s[k].x, p = chance(w, x, n), t = trials(&s[k], next);
      const double off = successes(&s[k], next) - t * p, weight = t * p * (1.0 - p);
      for (int i = 0; i < n; i++) {
        g[i] += off * x[i];
        for (int j = 0; j < n; j++)
          H[i][j] += weight * x[i] * x[j];
      }
    }
    solve(n, H, g);
    for (int i = 0; i < n; i++)
      w[i] += g[i];
  }
}

/* ---- The file */

/* The logarithm of the likelihood of a trial. */
static double likelihood(const sample *s, size_t count, bool next, int n, const double *w) {
  double sum = 0.0, all = 0.0;
  for (size_t k = 0; k < count; k++) {
    const double p = chance(w, s[k].x, n), yes = successes(&s[k], next), t = trials(&s[k], next);
    sum += yes * log(p) + (t - yes) * log(1.0 - p);
    all += t;
  }
  return sum / all;
}

static void print_numbers(const sample *s, size_t count, bool next, int n, const char *name) {
  double w[NEXT_NUMBERS], constant[1];
  fit(s, count, next, n, w);
  fit(s, count, next, 1, constant);
  printf("/* log-likelihood of a stroke %.4f; of one number for all, %.4f */\n",
         likelihood(s, count, next, n, w), likelihood(s, count, next, 1, constant));
  printf("static const double %s[] = {", name);
  for (int i = 0; i < n; i++)
    printf("%s%.3f", i > 0 ? ", " : "", w[i]);
  puts("};");
}

static void print_file(const learn_job *job, const sample *s, size_t count) {
  double mean = 0.0;
  for (size_t k = 0; k < count; k++)
    mean += s[k].x[2] / (double)count;
  printf("/* Numbers of value.c, fitted to %zu strokes: `carom-lab learn --racks %d --shots %d "
         "--seed\n * %d` made this file. */\n"
         "#ifndef CAROM_SRC_PLAN_LEARNED_H\n#define CAROM_SRC_PLAN_LEARNED_H\n\n"
         "#include \"plan/view.h\"\n\n",
         count, job->racks, job->shots, job->seed);
  print_numbers(s, count, true, NEXT_NUMBERS, "next_numbers");
  putchar('\n');
  print_numbers(s, count, false, LATER_NUMBERS, "later_numbers");
  printf("\n/* the mean of x[2] */\nstatic const double usual_mean = %.3f;\n\n#endif\n", mean);
}

static const command_form form = {
    .name = "learn",
    .usage = "[OPTIONS]",
    .about = "Plays racks of eight-ball by plans and fits the chances of value.c to what came of "
             "them. Prints src/plan/learned.h.\n",
    .options =
        (const option_row *const[]){&learn_racks, &learn_shots, &learn_seed, &option_threads, NULL},
    .details = "exit code: 0; 2 for bad usage\n",
    .example = "carom-lab learn --threads all > src/plan/learned.h",
    .files = NO_FILES,
};

int command_learn(int argc, char **argv) {
  static learn_job job;
  const char *path;
  job = (learn_job){.shared = {.options = {.threads = 0}}, .racks = 100000, .shots = 200};
  const int parsed = parse_arguments(&form, argc, argv, &job, &path);
  if (parsed >= 0)
    return parsed;
  const carom_plan_options options = {.shots = job.shots};
  if (carom_plan_memory(&options) == 0) {
    complain("--shots: it must be 100 to 1000000");
    return EXIT_USAGE;
  }
  block b = {.job = &job, .visit = allocate(BLOCK, sizeof *b.visit)};
  sample *all = NULL;
  size_t count = 0, room = 0;
  for (; b.first < job.racks; b.first += BLOCK) {
    const int many = job.racks - b.first < BLOCK ? job.racks - b.first : BLOCK;
    carom_in_threads(play_some, &b, (size_t)many, job.shared.options.threads, 1);
    for (int k = 0; k < many; k++) {
      all = grow(all, &room, count + (size_t)b.visit[k].count, sizeof *all);
      memcpy(all + count, b.visit[k].of, (size_t)b.visit[k].count * sizeof *all);
      count += (size_t)b.visit[k].count;
    }
    progress_show("racks", (double)(b.first + many), job.racks);
  }
  progress_clear();
  print_file(&job, all, count);
  free(all);
  free(b.visit);
  return EXIT_GOOD;
}
