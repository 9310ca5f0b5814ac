/* `carom-lab learn`: a row of games/ratings/learned.h, fitted to racks that are played.
 *
 * A rack begins after a break, with some balls taken away, and is played until the turn ends and
 * once more by the other, by players whose errors are drawn. For each layout on the way the sample
 * has x, from carom_plan_features(), and the result. Three logistic regressions by maximum
 * likelihood follow, by Newton's method: of whether the turn was kept; of each later stroke of the
 * visit, by the mean of each layout before it; and of whether the other kept the turn that was left
 * to him. In straight pool and snooker the break is as hard as in eight-ball, and in a quarter of
 * the racks of snooker no red is left, in a quarter a colour is on after a red. Where balls count
 * for each player it is gentle or hard, and those that are down are shared out at random. A game in
 * which any ball may be struck is played as a match, of which all visits are looked at.
 */
#include "program/command.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/options.h"
#include "rack_play.h"
#include "subcommands.h"

#include "carom_match.h"
#include "platform/threads.h"
#include "view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STROKES_MOST = 20, BLOCK = 256, STEPS = 30 };

typedef struct learn_job {
  shared_options shared;
  int rules, racks, shots, seed;
} learn_job;

OPTION(learn_job, learn_rules, "rules", rules, NULL, set_named, CAROM_WORDS_RULES,
       "the game (default eightball)");

OPTION(learn_job, learn_racks, "racks", racks, "N", set_count, 10,
       "number of racks to play (default 100000)");
OPTION(learn_job, learn_shots, "shots", shots, "N", set_count, 100,
       "shots of a plan (default 200)");
OPTION(learn_job, learn_seed, "seed", seed, "N", set_count, 0, "seed of the racks (default 0)");

typedef enum chance_of { NEXT, LATER, FIRST } chance_of;

/* A stroke, for one of the three; what is known before it, and whether it kept the turn. */
typedef struct sample {
  double x[NEXT_NUMBERS];
  chance_of what;
  int keeps, left;
} sample;

/* The layouts of a rack. */
enum { SAMPLES_MOST = STROKES_MOST + STROKES_MOST * (STROKES_MOST - 1) / 2 + 1 };
typedef struct visit {
  int count;
  sample samples[SAMPLES_MOST];
} visit;

typedef struct block {
  const learn_job *job;
  int first;
  visit *visit;
} block;

/* ---- Racks */

static int objects_of(uint32_t in_play) {
  int n = 0;
  for (in_play &= ~UINT32_C(1); in_play != 0; in_play &= in_play - 1)
    n++;
  return n;
}

static sample look(const carom_plan_job *job, bool in_hand) {
  static const int seat = 0;
  const carom_plan_rules *rules = job->rules;
  carom_view view;
  carom_view_make(&view, job, job->options);
  carom_ball_state state[CAROM_BALLS_MOST];
  const int count = (int)job->count;
  for (int k = 0; k < count; k++)
    state[k] = job->balls[k].state;
  const uint32_t in_play = carom_in_play(state, count) | UINT32_C(1) << job->cue->ball;
  sample s = {.keeps = 0};
  carom_plan_features(&view, state, in_play, rules->on(&rules->state, in_play),
                      carom_pockets_of(rules, &rules->state), seat, in_hand, NULL, s.x);
  int32_t left[2];
  rules->left(&rules->state, in_play, left);
  s.left = rules->race == CAROM_RACE_POINTS ? objects_of(in_play) : left[0];
  return s;
}

static void take_away(lab_rack *rack, int ball) {
  rack->balls[ball].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
}

/* A stroke at the rack, of a speed in m/s. A ball that leaves the table is down. */
static void open_rack(lab_rack *rack, lab_random *draw, double least, double most) {
  const int count = (int)rack->plan.count;
  carom_ball_state final[RACK_BALLS];
  carom_shot played = {.final = final};
  carom_cue cue = *rack->plan.cue;
  cue.speed = lab_uniform(draw, least, most);
  cue.phi = lab_uniform(draw, 87.0, 91.0);
  carom_shoot(rack->plan.table, rack->balls, count, &cue, rack->plan.shot, &played);
  for (int k = 0; k < count; k++) {
    rack->balls[k].state = final[k];
    if (final[k].label == CAROM_BALL_OFF)
      take_away(rack, k);
  }
}

/* Snooker: a hard stroke at the reds; and the colours in order, or a colour after a red. */
static void open_snooker(lab_rack *rack, lab_random *draw) {
  const int count = (int)rack->plan.count;
  open_rack(rack, draw, 3.0, 9.0);
  for (int k = 16; k < count; k++)
    if (rack->balls[k].state.label == CAROM_BALL_POCKETED)
      carom_spot_ball_of(CAROM_RACK_SNOOKER, rack->plan.table, rack->balls, count, k);
  const int phase = (int)lab_uniform(draw, 0.0, 4.0);
  rack->rules.state.on = phase == 1;
  for (int k = 1; k < 16 && phase == 0; k++)
    take_away(rack, k);
  const int gone = phase == 0 ? (int)lab_uniform(draw, 0.0, 6.0) : 0;
  for (int k = 16; k < 16 + gone; k++)
    take_away(rack, k);
}

/* The balls that are down count for both players, at most seven each. */
static void share_out(lab_rack *rack, lab_random *draw) {
  enum { MOST = 7 };
  int down = 0;
  for (int k = 1; k < (int)rack->plan.count; k++)
    down += rack->balls[k].state.label == CAROM_BALL_POCKETED;
  const int least = down > MOST ? down - MOST : 0, most = down > MOST ? MOST : down;
  const int player_balls = least + (int)lab_uniform(draw, 0.0, most - least + 1);
  rack->rules.state.score[0] = player_balls;
  rack->rules.state.score[1] = down - player_balls;
}

/* Begins a rack of the game as its players find it in the middle of a game: some balls are down,
 * and the cue ball is anywhere, or in hand once in eight. */
static void make_rack(lab_rack *rack, carom_rules_kind game, lab_random *draw) {
  const carom_rules_about *about = carom_rules_about_of(game);
  const bool snooker = game == CAROM_RULES_SNOOKER, straight = game == CAROM_RULES_STRAIGHT;
  lab_rack_make(rack, straight ? CAROM_RULES_EIGHTBALL : game, lab_bits(draw));
  if (straight)
    rack->rules = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
  const bool groups = game == CAROM_RULES_EIGHTBALL, breaks = rack->rules.breaks == 1;
  const bool counts = rack->rules.race == CAROM_RACE_OWN && !groups;
  if (snooker)
    open_snooker(rack, draw);
  if (counts)
    open_rack(rack, draw, 1.0, 8.0);

  /* the balls */
  int balls = breaks ? about->last - 1 : about->last - 2;
  if (snooker)
    balls = 15;
  if (groups)
    balls = 7;
  if (groups)
    rack->rules.state.group = CAROM_GROUP_SOLIDS;
  for (int group = 0; group < (groups ? 2 : 1); group++)
    for (int left = (int)lab_uniform(draw, 0.0, balls + 1); left > 0; left--) {
      const int k = 1 + 8 * group + (int)lab_uniform(draw, 0.0, balls);
      take_away(rack, k);
    }
  if (counts)
    share_out(rack, draw);

  /* the cue ball */
  double x, y;
  do {
    x = lab_uniform(draw, 0.0, rack->table.width);
    y = lab_uniform(draw, 0.0, rack->table.length);
  } while (carom_place_ball(&rack->table, rack->balls, (int)rack->plan.count, 0, x, y, NULL) !=
           CAROM_OK);
  rack->hand = lab_bits(draw) % 8 == 0 && !snooker;
  rack->plan.leave = rack->hand ? CAROM_LEAVE_ANYWHERE : CAROM_LEAVE_AFTER;
}

static bool keeps(const carom_turn *turn) {
  return turn->outcome == CAROM_TURN_KEEP || turn->outcome == CAROM_TURN_WIN;
}

/* Of each pair of strokes of a visit the later one, by the mean before the first one. */
static void add_pairs(visit *added, int first) {
  const int strokes = added->count;
  for (int k = first; k < strokes; k++)
    for (int j = k + 1; j < strokes && added->count < SAMPLES_MOST; j++) {
      sample s = added->samples[j];
      s.what = LATER;
      s.x[2] = 1.0 / s.left;
      s.x[3] = added->samples[k].x[2];
      added->samples[added->count++] = s;
    }
}

/* The first of a visit, which the other has left. */
static void add_first(visit *added, sample s) {
  s.what = FIRST;
  s.x[2] = 1.0 / s.left;
  if (added->count < SAMPLES_MOST)
    added->samples[added->count++] = s;
}

/* Plays a match of two such players, and looks at each stroke behind the break. */
static void play_match(const learn_job *job, lab_random *draw, double scale, visit *played) {
  carom_table table;
  const carom_rules_kind game = (carom_rules_kind)job->rules;
  carom_table_make(lab_table_of(game), &table);
  const carom_player player = carom_player_of(scale);
  carom_plan_options options = {.shots = job->shots};
  carom_plan_job plan = {.player = &player, .options = &options};
  plan.memory_size = carom_plan_memory(&options);
  plan.memory = allocate(1, plan.memory_size);
  carom_match *match = allocate(1, sizeof *match);
  carom_status status = carom_match_begin(match, game, &table, lab_bits(draw), 0);
  played->count = 0;
  int first = 0; /* of the samples of a visit, which begins */
  bool begins = true;
  while (status == CAROM_OK && match->phase != CAROM_MATCH_OVER && played->count < SAMPLES_MOST) {
    const bool opens = match->rules.state.opening != 0;
    const int seat = match->seat;
    carom_plan_stroke choice;
    int found;
    options.seed = lab_bits(draw);
    status = carom_match_plan(match, &plan, &choice, 1, &found);
    plan.table = &match->record.table;
    plan.balls = match->record.balls;
    plan.count = match->record.count;
    plan.cue = &choice.cue;
    plan.rules = &match->rules;
    sample s = look(&plan, true);
    if (status == CAROM_OK)
      status = carom_match_prepare(match, seat, &choice);
    carom_player_strike(&player, options.seed, 0, &choice.cue);
    if (status == CAROM_OK)
      status = carom_match_stroke(match, seat, &choice.cue, NULL, NULL);
    plan = (carom_plan_job){.player = &player,
                            .options = &options,
                            .memory = plan.memory,
                            .memory_size = plan.memory_size};
    s.keeps = keeps(&match->ruling.turn);
    if (opens || status != CAROM_OK)
      continue;
    if (begins)
      add_first(played, s);
    if (begins)
      first = played->count;
    begins = !s.keeps;
    if (played->count < SAMPLES_MOST)
      played->samples[played->count++] = s;
    if (begins)
      add_pairs(played, first);
  }
  free(match);
  free(plan.memory);
}

/* Plays a visit until the turn ends, and the other's first stroke. */
static void play(const learn_job *job, int number, visit *played) {
  static const double errors[] = {0.25, 0.5, 1.0, 2.0, 3.0, 4.5};
  enum { PLAYERS = sizeof errors / sizeof errors[0] };
  lab_random draw = {((uint64_t)job->seed << 32) + 104729 * ((uint64_t)number + 1)};
  const carom_rules_kind game = (carom_rules_kind)job->rules;
  const double scale = errors[(int)lab_uniform(&draw, 0.0, PLAYERS)];
  if (carom_plan_rules_of(game).any_cue_ball != 0) {
    play_match(job, &draw, scale, played);
    return;
  }
  lab_rack rack = {.options = {.shots = job->shots}};
  lab_rack_begin(&rack, game, scale);
  make_rack(&rack, game, &draw);

  carom_turn turn = {.outcome = CAROM_TURN_KEEP};
  carom_plan_stroke choice;
  played->count = 0;
  while (turn.outcome == CAROM_TURN_KEEP && played->count < STROKES_MOST) {
    sample s = look(&rack.plan, rack.hand);
    if (!lab_rack_stroke(&rack, &choice, &turn))
      break;
    s.keeps = keeps(&turn);
    played->samples[played->count++] = s;
  }
  add_pairs(played, 0);
  if (turn.outcome == CAROM_TURN_PASS) {
    sample s = look(&rack.plan, rack.hand);
    if (lab_rack_stroke(&rack, &choice, &turn)) {
      s.keeps = keeps(&turn);
      add_first(played, s);
    }
  }
  free(rack.plan.memory);
}

static size_t play_some(const void *context, size_t start, size_t end) {
  const block *b = context;
  for (size_t k = start; k < end; k++)
    play(b->job, b->first + (int)k, &b->visit[k]);
  return end;
}

/* ---- The fit */

/* Solves H d = g for a positive definite H by Gauss's method; d replaces g. */
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

/* The numbers w of greatest likelihood, and a trace of a prior that keeps them finite. */
static void fit(const sample *s, size_t count, chance_of what, int n, double *w) {
  memset(w, 0, (size_t)n * sizeof *w);
  for (int step = 0; step < STEPS; step++) {
    double H[NEXT_NUMBERS][NEXT_NUMBERS] = {{0.0}}, g[NEXT_NUMBERS];
    for (int i = 0; i < n; i++) {
      H[i][i] = 1e-3;
      g[i] = -1e-3 * w[i];
    }
    for (size_t k = 0; k < count; k++) {
      if (s[k].what != what)
        continue;
      const double *x = s[k].x, p = chance(w, x, n), off = s[k].keeps - p, weight = p * (1.0 - p);
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
static double likelihood(const sample *s, size_t count, chance_of what, int n, const double *w) {
  double sum = 0.0, total = 0.0;
  for (size_t k = 0; k < count; k++) {
    const double p = chance(w, s[k].x, n);
    if (s[k].what == what) {
      sum += log(s[k].keeps ? p : 1.0 - p);
      total += 1.0;
    }
  }
  return sum / total;
}

static void print_numbers(const sample *s, size_t count, chance_of what, int n, const char *name,
                          bool anywhere) {
  double w[NEXT_NUMBERS], constant[1];
  fit(s, count, what, n, w);
  if (anywhere && w[n - 1] < 0.0) { /* a ball in hand that may be put anywhere is no worse */
    fit(s, count, what, n - 1, w);
    w[n - 1] = 0.0;
  }
  fit(s, count, what, 1, constant);
  printf("     /* log-likelihood of a stroke %.4f; of one number for all, %.4f */\n",
         likelihood(s, count, what, n, w), likelihood(s, count, what, 1, constant));
  printf("     .%s = {", name);
  for (int i = 0; i < n; i++)
    printf("%s%.3f", i > 0 ? ", " : "", w[i]);
  puts("},");
}

static void print_row(const learn_job *job, const sample *s, size_t count) {
  const char *game = carom_word(CAROM_WORDS_RULES, job->rules);
  double mean = 0.0;
  long strokes = 0;
  for (size_t k = 0; k < count; k++)
    strokes += s[k].what == NEXT;
  for (size_t k = 0; k < count; k++)
    mean += s[k].what == NEXT ? s[k].x[2] / (double)strokes : 0.0;
  printf("    {/* of %ld strokes: carom-lab learn --rules %s --racks %d --shots %d --seed %d */\n",
         strokes, game, job->racks, job->shots, job->seed);
  const int hand = carom_rules_about_of((carom_rules_kind)job->rules)->hand;
  print_numbers(s, count, NEXT, NEXT_NUMBERS, "next", hand == CAROM_LEAVE_ANYWHERE);
  print_numbers(s, count, LATER, LATER_NUMBERS, "later", false);
  print_numbers(s, count, FIRST, FIRST_NUMBERS, "first", false);
  carom_table table;
  carom_table_make(lab_table_of((carom_rules_kind)job->rules), &table);
  printf("     .mean = %.3f,\n     .width = %.4g,\n     .stretch = 1.0,\n     .edge = 1.0},\n",
         mean, table.width);
}

static const command_form form = {
    .name = "learn",
    .usage = "[OPTIONS]",
    .about = "Plays racks of a game with plans, and fits the chances of pots to the results. "
             "Prints the row of the game in games/ratings/learned.h.\n",
    .options = (const option_row *const[]){&learn_rules, &learn_racks, &learn_shots, &learn_seed,
                                           &option_threads, NULL},
    .details = "exit code: 0; 2 for bad usage\n",
    .example = "carom-lab learn --rules nineball",
    .files = NO_FILES,
};

int command_learn(int argc, char **argv) {
  static learn_job job;
  const char *path;
  job = (learn_job){.shared = {.options = {.threads = 0}}, .racks = 100000, .shots = 200};
  const int parsed = parse_arguments(&form, argc, argv, &job, &path);
  if (parsed >= 0)
    return parsed;
  if (!lab_game_is_played(job.rules))
    return EXIT_USAGE;
  const carom_plan_options options = {.shots = job.shots};
  if (carom_plan_memory(&options) == 0) {
    complain("--shots: it must be 100 to 1000000");
    return EXIT_USAGE;
  }
  block b = {.job = &job, .visit = allocate(BLOCK, sizeof *b.visit)};
  sample *samples = NULL;
  size_t count = 0, room = 0;
  for (; b.first < job.racks; b.first += BLOCK) {
    const int many = job.racks - b.first < BLOCK ? job.racks - b.first : BLOCK;
    carom_in_threads(play_some, &b, (size_t)many, job.shared.options.threads, 1);
    for (int k = 0; k < many; k++) {
      samples = grow(samples, &room, count + (size_t)b.visit[k].count, sizeof *samples);
      memcpy(samples + count, b.visit[k].samples, (size_t)b.visit[k].count * sizeof *samples);
      count += (size_t)b.visit[k].count;
    }
    progress_show("racks", (double)(b.first + many), job.racks);
  }
  progress_clear();
  print_row(&job, samples, count);
  free(samples);
  free(b.visit);
  return EXIT_GOOD;
}
