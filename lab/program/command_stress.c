/* `carom-lab stress`: the exact solver on random impacts, in every way it can be called.
 *
 * Collisions of two balls are solved by a single call and in a batch, in double and in single
 * precision; rows of batches are compared with single calls bit by bit. Impacts on cushions, and
 * coincidences of both, are solved by single calls. The precise solver behind the calls, whose
 * own error is about 1e-9 at most, is what they are compared with; where it and a call differ by
 * more than REFERENCE_FROM, for 1 row in 1000, and for all coincidences, the reference of
 * lab/stress decides. */
#include "accuracy.h"
#include "coincidences.h"
#include "command.h"
#include "draws.h"
#include "memory.h"
#include "message.h"
#include "number.h"
#include "options.h"
#include "output.h"
#include "precisely.h"
#include "precision.h"
#include "reference.h"
#include "subcommands.h"

#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "ball_ball/reduced.h"
#include "platform/enumerations.h"
#include "platform/threads.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  BLOCK = 1000, /* impacts that a thread draws and solves at a time */
  KINDS = 32,   /* room for so many kinds of draws */
  DECADES = 20, /* errors are counted in a histogram of their logarithms */
  PER_DECADE = 50,
};
static const double REFERENCE_FROM = 1e-7, LEAST_ERROR = 1e-18, MOST_OF_PLAY = 1e-6, MOST = 1e-5;

typedef struct stress_job {
  shared_options shared;
  int draws, seed, kind;
  int cushions, coincidences; /* or these impacts */
} stress_job;

/* Rows of one kind, solved in one way. Errors are those of rows with status ok that could be
 * compared. */
typedef struct tally {
  long rows, over_1e6, over_1e5, over_2e5;  /* compared; with an error larger than 1e-6, 1e-5,
                                               2e-5 */
  long unresolved, refused, left_out, slow; /* by status; without a reference; left to the
                                               precise solver */
  double largest, largest_of_play;
  uint64_t worst; /* number of the draw that has the largest error, over the bound that it may
                     have */
  double worst_share;
  long histogram[DECADES * PER_DECADE];
} tally;

/* One run, or a thread's part of it. For two balls a kind is a slip, and the tallies behind those
 * of double precision are those of single. */
typedef struct stress {
  const stress_job *job;
  bool balls;
  int kinds;
  uint64_t draws;
  tally tally[KINDS];
  long other_bits; /* rows of batches that differ from single calls */
  long asked, precise_wrong;
  double precise_largest; /* error against the reference */
} stress;

/* A motion of one ball or of two. */
typedef union outcome {
  carom_motion rail;
  carom_result balls;
} outcome;

/* ---- Counting */

static void count(tally *t, double error, bool of_play, uint64_t k) {
  const double share = error / (of_play ? MOST_OF_PLAY : MOST);
  t->rows++;
  t->over_1e6 += error > 1e-6;
  t->over_1e5 += error > 1e-5;
  t->over_2e5 += error > 2e-5;
  t->largest = fmax(t->largest, error);
  if (of_play)
    t->largest_of_play = fmax(t->largest_of_play, error);
  if (share > t->worst_share) {
    t->worst_share = share;
    t->worst = k;
  }
  const double place = PER_DECADE * log10(fmax(error, LEAST_ERROR) / LEAST_ERROR);
  const int last = DECADES * PER_DECADE - 1;
  t->histogram[place < last ? (int)place : last]++;
}

/* The error that so large a share of the rows do not exceed. */
static double quantile(const tally *t, double share) {
  long below = 0;
  for (int k = 0; k < DECADES * PER_DECADE; k++)
    if ((double)(below += t->histogram[k]) >= share * (double)t->rows)
      return fmin(LEAST_ERROR * pow(10, (k + 1.0) / PER_DECADE), t->largest);
  return t->largest;
}

static void add_tally(tally *to, const tally *from) {
  to->rows += from->rows;
  to->over_1e6 += from->over_1e6;
  to->over_1e5 += from->over_1e5;
  to->over_2e5 += from->over_2e5;
  to->unresolved += from->unresolved;
  to->refused += from->refused;
  to->left_out += from->left_out;
  to->slow += from->slow;
  to->largest = fmax(to->largest, from->largest);
  to->largest_of_play = fmax(to->largest_of_play, from->largest_of_play);
  if (from->worst_share > to->worst_share) {
    to->worst_share = from->worst_share;
    to->worst = from->worst;
  }
  for (int k = 0; k < DECADES * PER_DECADE; k++)
    to->histogram[k] += from->histogram[k];
}

static void add(stress *to, const stress *from) {
  for (int k = 0; k < KINDS; k++)
    add_tally(&to->tally[k], &from->tally[k]);
  to->other_bits += from->other_bits;
  to->asked += from->asked;
  to->precise_wrong += from->precise_wrong;
  to->precise_largest = fmax(to->precise_largest, from->precise_largest);
}

/* ---- One impact */

static coincidence draw(const stress *s, int kind, uint64_t k) {
  const stress_job *job = s->job;
  const uint64_t seed = (uint64_t)job->seed;
  if (job->coincidences > 0)
    return coincidence_draw(kind, seed, k);
  if (!s->balls)
    return (coincidence){.cushion = true,
                         .of_play = kind == CUSHION_PLAY,
                         .rail = draw_cushion((cushion_draw)kind, seed, k)};
  return (coincidence){.of_play = job->kind == DRAW_REALISTIC,
                       .slip = (carom_slip)kind,
                       .balls = draw_collision((draw_kind)job->kind, (carom_slip)kind, seed, k)};
}

/* The largest speed of two balls, of their centres or surfaces. */
static double fastest(const double v_a[3], const double w_a[3], const double v_b[3],
                      const double w_b[3], double radius) {
  double most = 0;
  for (int k = 0; k < 3; k++) {
    most = fmax(most, fmax(fabs(v_a[k]), fabs(v_b[k])));
    most = fmax(most, radius * fmax(fabs(w_a[k]), fabs(w_b[k])));
  }
  return most;
}

static double apart(const coincidence *c, const outcome *a, const outcome *b) {
  if (c->cushion)
    return cushion_distance(&c->rail, &a->rail, &b->rail);
  /* where the balls come to rest but for rounding, errors are those over 1e-9 of the speed
   * before */
  const carom_impact *in = &c->balls;
  const carom_motion *to_a = &b->balls.a, *to_b = &b->balls.b;
  const double radius = in->a.radius,
               least = 1e-9 * fastest(in->a.v, in->a.w, in->b.v, in->b.w, radius);
  const double pair = accuracy_of(&a->balls, &b->balls, radius).pair,
               after = fastest(to_a->v, to_a->w, to_b->v, to_b->w, radius);
  return pair > 0 && after < least ? pair * (after / least) : pair;
}

static carom_status call(const coincidence *c, outcome *out) {
  const carom_options options = {.slip = c->slip};
  return c->cushion ? carom_cushion(&c->rail, NULL, &out->rail)
                    : carom_collide(&c->balls, &options, &out->balls);
}

static bool precisely(const coincidence *c, outcome *out) {
  return CAROM_OK == (c->cushion ? cushion_precisely(&c->rail, PRECISELY, &out->rail)
                                 : collide_precisely(&c->balls, c->slip, PRECISELY, &out->balls));
}

/* Whether a result is not there to be compared, which is counted. */
static bool is_error(tally *t, carom_status status) {
  t->unresolved += status == CAROM_ERROR_UNRESOLVED;
  t->refused += status < 0 && status != CAROM_ERROR_UNRESOLVED;
  return status != CAROM_OK;
}

static void compare(stress *s, int kind, uint64_t k, const coincidence *c, const outcome *own,
                    carom_status status) {
  tally *t = &s->tally[kind];
  outcome precise, exact;
  if (s->balls && status != CAROM_SEPARATING)
    t->slow += carom_kernels_of_call(0)->call[CAROM_F64](&c->balls, carom_spin_sign(c->slip),
                                                         &exact, NULL) <= 0;
  if (is_error(t, status))
    return;
  const bool known = precisely(c, &precise);
  double error = known ? apart(c, own, &precise) : INFINITY;
  if (error > REFERENCE_FROM || s->job->coincidences > 0 || k % 1000 == 0) {
    if (REFERENCE_OK == (c->cushion ? reference_cushion(&c->rail, &exact.rail, NULL)
                                    : reference_collide(&c->balls, c->slip, &exact.balls, NULL))) {
      const double precise_error = known ? apart(c, &precise, &exact) : 0;
      error = apart(c, own, &exact);
      s->asked++;
      s->precise_wrong += precise_error > (s->balls ? 1e-9 : 1e-8);
      s->precise_largest = fmax(s->precise_largest, precise_error);
    } else if (error > REFERENCE_FROM) {
      t->left_out++;
      return;
    }
  }
  count(t, error, c->of_play, k);
}

/* The same collision in single precision, against the exact result for the rounded numbers. */
static void compare_single(stress *s, carom_slip slip, const carom_impact_f32 *in,
                           const carom_result_f32 *out, carom_status status) {
  tally *t = &s->tally[s->kinds + (int)slip];
  coincidence wide = {.slip = slip};
  outcome result, exact;
  carom_result_f32 unused;
  if (status == CAROM_SEPARATING)
    return;
  to_double(in, &wide.balls, 26);
  to_double(out, &result.balls, 12);
  t->slow +=
      carom_kernels_of_call(0)->call[CAROM_F32](in, carom_spin_sign(slip), &unused, NULL) == 0;
  if (is_error(t, status))
    return;
  if (precisely(&wide, &exact))
    count(t, apart(&wide, &result, &exact), false, 0);
  else
    t->left_out++;
}

/* ---- Blocks of impacts, in threads */

/* The batch of a block of collisions, beside single calls. */
static void run_batch(stress *s, carom_slip slip, uint64_t first, size_t n) {
  const carom_options options = {.slip = slip, .threads = 1};
  carom_impact *in = allocate(n, sizeof *in);
  carom_impact_f32 *in32 = allocate(n, sizeof *in32);
  carom_result *out = allocate(n, sizeof *out), alone;
  carom_result_f32 *out32 = allocate(n, sizeof *out32), alone32;
  int8_t *status = allocate(2 * n, 1);
  for (size_t k = 0; k < n; k++)
    in[k] = draw(s, (int)slip, first + k).balls;
  to_single(in, in32, 26 * n);
  carom_collide_batch(in, n, &options, out, status);
  carom_collide_batch_f32(in32, n, &options, out32, status + n);
  for (size_t k = 0; k < n; k++) {
    const carom_status one = carom_collide(&in[k], &options, &alone),
                       one32 = carom_collide_one(CAROM_F32, &in32[k], &options, &alone32);
    s->other_bits += one != status[k] || memcmp(&alone, &out[k], sizeof alone) != 0;
    s->other_bits += one32 != status[n + k] || memcmp(&alone32, &out32[k], sizeof alone32) != 0;
    compare_single(s, slip, &in32[k], &alone32, one32);
  }
  free(in);
  free(in32);
  free(out);
  free(out32);
  free(status);
}

static size_t run_blocks(const void *of, size_t from, size_t end) {
  static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  static size_t done;
  stress *const all = *(stress *const *)of, *part = allocate(1, sizeof *part);
  const size_t kinds = (size_t)all->kinds;
  *part = (stress){.job = all->job, .balls = all->balls, .kinds = all->kinds, .draws = all->draws};
  for (size_t block = from; block < end; block++) {
    const int kind = (int)(block % kinds);
    const uint64_t first = block / kinds * BLOCK,
                   n = all->draws - first < BLOCK ? all->draws - first : BLOCK;
    for (uint64_t k = first; k < first + n; k++) {
      const coincidence c = draw(part, kind, k);
      outcome own;
      const carom_status status = call(&c, &own);
      compare(part, kind, k, &c, &own, status);
    }
    if (all->balls)
      run_batch(part, (carom_slip)kind, first, (size_t)n);
    pthread_mutex_lock(&lock);
    progress_show("blocks of impacts", (double)++done,
                  (double)kinds * ceil((double)all->draws / BLOCK));
    pthread_mutex_unlock(&lock);
  }
  pthread_mutex_lock(&lock);
  add(all, part);
  pthread_mutex_unlock(&lock);
  free(part);
  return end;
}

/* ---- Tables */

static const char *kind_name(const stress *s, int kind) {
  return s->balls                   ? carom_slip_name((carom_slip)kind)
         : s->job->coincidences > 0 ? coincidence_name(kind)
         : kind == CUSHION_PLAY     ? "play"
                                    : "any";
}

static bool of_cushion(const stress *s, int kind) {
  return !s->balls && (s->job->coincidences == 0 || coincidence_of_cushion(kind));
}

static void print_row(FILE *out, const char *first, const char *second, const tally *t) {
  fprintf(out,
          "%-9s %-15s %9ld  %7.1e   %7.1e   %7.1e   %7.1e  %7.1e  %7.1e  %7ld  %7ld  %7ld  %6.2f "
          "%%  %10ld  %7ld  %8ld\n",
          first, second, t->rows, quantile(t, 0.5), quantile(t, 0.99), quantile(t, 0.999),
          quantile(t, 0.9999), t->largest, t->largest_of_play, t->over_1e6, t->over_1e5,
          t->over_2e5,
          100.0 * (double)t->slow / fmax(1, (double)(t->rows + t->unresolved + t->left_out)),
          t->unresolved, t->refused, t->left_out);
}

/* The numbers of an impact, in the order of its struct. */
static void print_numbers(FILE *out, const coincidence *c) {
  const double *const number = c->cushion ? (const double *)&c->rail : (const double *)&c->balls;
  char text[NUMBER_TEXT];
  for (int k = 0; k < (c->cushion ? 15 : 26); k++)
    fprintf(out, "%s%s", k > 0 ? "," : "", number_text(number[k], text));
}

static void print_table(const stress *s, FILE *out) {
  static const char *const kinds[] = {"realistic", "regimes", "extreme"};
  const stress_job *job = s->job;
  fprintf(out, "%s%s, %llu drawn %s with seed %d, instruction set %s\n\n",
          s->balls ? kinds[job->kind] : "",
          s->balls                ? " collisions"
          : job->coincidences > 0 ? "coincidences"
                                  : "impacts on a cushion",
          (unsigned long long)s->draws, s->balls ? "for each slip" : "of each kind", job->seed,
          carom_isa_name(carom_isa_in_force()));
  fprintf(out,
          "%-9s %-15s %9s   median      99 %%    99.9 %%   99.99 %%  largest  of play   > 1e-6   > "
          "1e-5   > 2e-5  fallback  unresolved  refused  left out\n",
          s->balls ? "precision" : "impact", s->balls ? "slip" : "kind", "rows");
  for (int k = 0; k < (s->balls ? 2 : 1) * s->kinds; k++)
    print_row(out,
              k >= s->kinds      ? "single"
              : s->balls         ? "double"
              : of_cushion(s, k) ? "cushion"
                                 : "balls",
              kind_name(s, k % s->kinds), &s->tally[k]);
  fputc('\n', out);
  if (s->balls)
    fprintf(out, "rows of batches whose bits or status differ from single calls: %ld\n",
            s->other_bits);
  fprintf(out,
          "precise solver against the reference, where calls differ from it by more than %g, and "
          "%s: %ld rows, largest error %.1e, %ld above %s\n",
          REFERENCE_FROM, job->coincidences > 0 ? "all others" : "1 row in 1000", s->asked,
          s->precise_largest, s->precise_wrong, s->balls ? "1e-9" : "1e-8");
  fputs("\nlargest errors:\n", out);
  for (int kind = 0; kind < s->kinds; kind++)
    if (s->tally[kind].rows > 0) {
      const coincidence c = draw(s, kind, s->tally[kind].worst);
      fprintf(out, "%s, %s %llu, %.2g of its bound: ",
              s->balls    ? "balls"
              : c.cushion ? "cushion"
                          : carom_slip_name(c.slip),
              kind_name(s, kind), (unsigned long long)s->tally[kind].worst,
              s->tally[kind].worst_share);
      print_numbers(out, &c);
      fputc('\n', out);
    }
}

/* The contract of carom.h for double precision: rows of play within 1e-6, all within 1e-5; and
 * more for collisions of play. */
static bool holds(const stress *s) {
  bool good = s->other_bits == 0;
  for (int kind = 0; kind < s->kinds; kind++) {
    const tally *t = &s->tally[kind];
    good &= t->largest_of_play <= MOST_OF_PLAY && t->largest <= MOST;
    good &= !s->balls || s->job->kind != DRAW_REALISTIC ||
            (quantile(t, 0.5) <= 3e-9 && s->tally[s->kinds + kind].over_2e5 == 0);
  }
  return good;
}

OPTION(stress_job, option_draws, "draws", draws, 'n', "N", set_count, 1,
       "number of collisions for each slip (default: 100000)");
OPTION(stress_job, option_seed, "seed", seed, 0, "S", set_count, 0,
       "seed of the random numbers (default: 1)");
OPTION(stress_job, option_kind, "kind", kind, 0, DRAW_KIND_NAMES, set_choice, 0,
       "realistic: collisions of play (default); regimes: the special cases of the tests; extreme: "
       "everything that carom accepts");
OPTION(stress_job, option_cushions, "cushion", cushions, 0, "N", set_count, 1,
       "draw so many impacts on a cushion of each kind instead: of play, and any");
OPTION(stress_job, option_coincidences, "coincidences", coincidences, 0, "N", set_count, 1,
       "draw so many impacts of each kind of coincidence instead, of two balls and on a cushion: "
       "numbers that are exactly equal, zero or at the edge of a friction cone; planar motion; "
       "slips that are rounding errors; grazing impacts");

static const command_form form = {
    .name = "stress",
    .usage = "[OPTIONS]",
    .about = "Draws random collisions and solves them by single calls and in batches, in double "
             "and in single precision. The results are compared with the precise solver; where "
             "they differ, with a reference in extended precision.\n",
    .options =
        (const option_row *const[]){&option_draws, &option_seed, &option_kind, &option_cushions,
                                    &option_coincidences, &option_threads, &option_output, NULL},
    .details = "exit code: 0; 1 if an error is larger than carom.h promises, or if a batch has "
               "other bits than single calls; 2 for bad usage\n",
    .example = "carom-lab stress --draws 10000 --kind regimes",
};

int command_stress(int argc, char **argv) {
  stress_job job = {.shared = {.options = COMMAND_OPTIONS, .output = "-"}, .seed = 1};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  const int counts = (job.draws > 0) + (job.cushions > 0) + (job.coincidences > 0);
  if (counts > 1) {
    complain("give one of --draws, --cushion and --coincidences");
    return EXIT_USAGE;
  }
  if (job.kind != DRAW_REALISTIC && counts == 1 && job.draws == 0) {
    complain("--kind is for collisions of two balls");
    return EXIT_USAGE;
  }
  FILE *out = output_open(job.shared.output);
  if (out == NULL)
    return EXIT_USAGE;
  stress *all = allocate(1, sizeof *all);
  all->job = &job;
  all->balls = job.cushions == 0 && job.coincidences == 0;
  all->kinds = all->balls             ? CAROM_SLIP_COUNT
               : job.coincidences > 0 ? coincidence_kinds()
                                      : CUSHION_DRAWS;
  all->draws = counts > 0 ? (uint64_t)(job.draws + job.cushions + job.coincidences) : 100000;
  carom_in_threads(run_blocks, &all, (size_t)all->kinds * ((all->draws + BLOCK - 1) / BLOCK),
                   job.shared.options.threads, 1);
  progress_clear();
  print_table(all, out);
  const bool good = holds(all);
  free(all);
  return !output_commit() ? EXIT_USAGE : good ? EXIT_GOOD : EXIT_SOME;
}
