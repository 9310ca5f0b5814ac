/* `carom-lab stress`: the exact solver on random impacts, in every way it can be called.
 *
 * Collisions of two balls are solved by a single call and in a batch, in double and in single
 * precision; rows of batches are compared with single calls bit by bit. Impacts on cushions are
 * solved by single calls. The precise solver behind the calls, whose own error is about 1e-9 at
 * most, is what they are compared with. The reference of core/reference decides where it and a call
 * differ by more than REFERENCE_FROM, and for 1 row in 1000 of each group. */
#include "kernel.h"
#include "program/program.h"
#include "random_impacts.h"
#include "reference.h"
#include "rows/number.h"
#include "rows/precision.h"
#include "subcommands.h"

#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "ball_ball/reduced.h"
#include "platform/enumerations.h"
#include "platform/threads.h"

#include <pthread.h>

enum {
  BLOCK = 1000, /* impacts that a thread draws and solves at a time */
  GROUPS = 20,  /* room for so many groups of draws */
  DECADES = 20, /* errors are counted in a histogram of their logarithms */
  PER_DECADE = 50,
};
static const double REFERENCE_FROM = 1e-7, LEAST_ERROR = 1e-18, MOST_OF_PLAY = 1e-6, MOST = 1e-5,
                    MOST_SINGLE = 2e-5;

typedef struct stress_job {
  shared_options shared;
  int draws, seed, kind;
  int cushions, coincidences; /* or these impacts */
} stress_job;

/* Rows of one group that are counted, with an error above 1e-6, 1e-5, 2e-5, by status, without a
 * reference, and those left to the precise solver. */
enum { ROWS, OVER_1E6, OVER_1E5, OVER_2E5, UNRESOLVED, NOT_TAKEN, LEFT_OUT, SLOW, COUNTS };

/* Rows of one group, solved in one way. Errors are over the rows with status ok that could be
 * compared. */
typedef struct tally {
  long count[COUNTS], histogram[DECADES * PER_DECADE];
  double largest, largest_of_play, worst_share;
  uint64_t worst; /* number of the draw whose error is the largest fraction of its bound */
} tally;

/* One run, or a thread's portion of it. */
typedef struct stress {
  draw_kind kind;
  uint64_t seed, draws;   /* draws of each group */
  tally tally[GROUPS][2]; /* of double and of single precision */
  long other_bits;        /* rows of batches that differ from single calls */
  long request, precise_wrong;
  double precise_largest; /* error against the reference */
} stress;

/* A motion of one ball or of two. */
typedef union outcome {
  carom_motion rail;
  carom_result balls;
} outcome;

/* ---- Counting */

static void count(tally *t, double error, bool of_play, uint64_t k) {
  double share = error / MOST;
  t->count[ROWS]++;
  t->count[OVER_1E6] += error > 1e-6;
  t->count[OVER_1E5] += error > 1e-5;
  t->count[OVER_2E5] += error > 2e-5;
  t->largest = fmax(t->largest, error);
  if (of_play) {
    share = error / MOST_OF_PLAY;
    t->largest_of_play = fmax(t->largest_of_play, error);
  }
  if (share > t->worst_share) {
    t->worst_share = share;
    t->worst = k;
  }
  const double place = PER_DECADE * log10(fmax(error, LEAST_ERROR) / LEAST_ERROR);
  t->histogram[(int)fmin(place, DECADES * PER_DECADE - 1)]++;
}

/* The error that so large a fraction of the rows do not exceed. */
static double quantile(const tally *t, double share) {
  long below = 0;
  for (int k = 0; k < DECADES * PER_DECADE; k++)
    if ((double)(below += t->histogram[k]) >= share * (double)t->count[ROWS])
      return fmin(LEAST_ERROR * pow(10, (k + 1.0) / PER_DECADE), t->largest);
  return t->largest;
}

static void add_tally(tally *sum, const tally *part) {
  for (int k = 0; k < COUNTS; k++)
    sum->count[k] += part->count[k];
  for (int k = 0; k < DECADES * PER_DECADE; k++)
    sum->histogram[k] += part->histogram[k];
  sum->largest = fmax(sum->largest, part->largest);
  sum->largest_of_play = fmax(sum->largest_of_play, part->largest_of_play);
  if (part->worst_share > sum->worst_share)
    sum->worst_share = part->worst_share, sum->worst = part->worst;
}

static void add(stress *sum, const stress *part) {
  for (int group = 0; group < GROUPS; group++)
    for (int single = 0; single < 2; single++)
      add_tally(&sum->tally[group][single], &part->tally[group][single]);
  sum->other_bits += part->other_bits;
  sum->request += part->request;
  sum->precise_wrong += part->precise_wrong;
  sum->precise_largest = fmax(sum->precise_largest, part->precise_largest);
}

/* ---- One impact */

/* Largest difference, over the largest speed of centres and surfaces: that after the impact, or
 * 1e-9 of that before, where balls stop but for rounding. */
static double apart(const drawn *c, const outcome *a, const outcome *b) {
  if (c->cushion)
    return cushion_distance(&c->rail, &a->rail, &b->rail);
  const carom_impact *in = &c->balls;
  const double *x = (const double *)&a->balls, *y = (const double *)&b->balls,
               *velocities[] = {in->a.v, in->b.v};
  double most = 0, scale = 0;
  const double weights[] = {1, in->a.radius}; /* of velocities, and of angular ones */
  for (int k = 0; k < 12; k++) {
    const double weight = weights[k / 3 % 2];
    if (isnan(x[k]))
      return INFINITY;
    most = fmax(most, weight * fabs(x[k] - y[k]));
    scale = fmax(scale, weight * fmax(fabs(y[k]), 1e-9 * fabs(velocities[k / 6][k % 6])));
  }
  if (most == 0)
    return 0;
  return most / scale;
}

static carom_status call(const drawn *c, outcome *out) {
  const carom_options options = {.slip = c->slip};
  if (c->cushion)
    return carom_cushion(&c->rail, NULL, &out->rail);
  return carom_collide(&c->balls, &options, &out->balls);
}

static bool precisely(const drawn *c, outcome *out) {
  if (c->cushion)
    return cushion_precisely(&c->rail, PRECISELY, &out->rail) == CAROM_OK;
  return collide_precisely(&c->balls, c->slip, PRECISELY, &out->balls) == CAROM_OK;
}

static bool by_reference(const drawn *c, outcome *out) {
  if (c->cushion)
    return reference_cushion(&c->rail, &out->rail) == REFERENCE_OK;
  return reference_collide(&c->balls, c->slip, &out->balls, NULL) == REFERENCE_OK;
}

/* Whether a result is not there to be compared, which is counted. */
static bool is_error(tally *t, carom_status status) {
  t->count[UNRESOLVED] += status == CAROM_ERROR_UNRESOLVED;
  t->count[NOT_TAKEN] += status < 0 && status != CAROM_ERROR_UNRESOLVED;
  return status != CAROM_OK;
}

static void compare(stress *s, int group, uint64_t k, const drawn *c) {
  tally *t = &s->tally[group][0];
  outcome solved, precise, exact;
  const carom_status status = call(c, &solved);
  if (!c->cushion && status != CAROM_SEPARATING)
    t->count[SLOW] += carom_kernels_of_call(0)->call[CAROM_F64](&c->balls, carom_spin_sign(c->slip),
                                                                &exact, NULL) <= 0;
  if (is_error(t, status))
    return;
  const bool known = precisely(c, &precise);
  double error = INFINITY;
  if (known)
    error = apart(c, &solved, &precise);
  if (error > REFERENCE_FROM || k % 1000 == 0) {
    if (by_reference(c, &exact)) {
      static const double precise_most[] = {1e-9, 1e-8}; /* of balls, on a cushion */
      double precise_error = 0;
      if (known)
        precise_error = apart(c, &precise, &exact);
      error = apart(c, &solved, &exact);
      s->request++;
      s->precise_wrong += precise_error > precise_most[c->cushion];
      s->precise_largest = fmax(s->precise_largest, precise_error);
    } else if (error > REFERENCE_FROM) {
      t->count[LEFT_OUT]++;
      return;
    }
  }
  count(t, error, c->of_play, k);
}

/* The same collision in single precision, against the exact result for the rounded numbers. */
static void compare_single(stress *s, int group, const drawn *c, const carom_impact_f32 *in,
                           const carom_result_f32 *out, carom_status status) {
  tally *t = &s->tally[group][1];
  drawn wide = {.slip = c->slip};
  outcome result, exact;
  carom_result_f32 unused;
  if (status == CAROM_SEPARATING)
    return;
  to_double(in, &wide.balls, 26);
  to_double(out, &result.balls, 12);
  t->count[SLOW] +=
      carom_kernels_of_call(0)->call[CAROM_F32](in, carom_spin_sign(c->slip), &unused, NULL) == 0;
  if (is_error(t, status))
    return;
  if (precisely(&wide, &exact))
    count(t, apart(&wide, &result, &exact), is_of_play(&wide.balls), 0);
  else
    t->count[LEFT_OUT]++;
}

/* ---- Blocks of impacts, in threads */

/* The batch of those collisions of a block that have this slip, compared with single calls. */
static void run_batch(stress *s, int group, carom_slip slip, const drawn *block, size_t count) {
  const carom_options options = {.slip = slip, .threads = 1};
  static _Thread_local carom_impact in[BLOCK];
  static _Thread_local carom_impact_f32 in32[BLOCK];
  static _Thread_local carom_result out[BLOCK];
  static _Thread_local carom_result_f32 out32[BLOCK];
  const drawn *draws[BLOCK];
  carom_result alone;
  carom_result_f32 alone32;
  int8_t status[BLOCK], status32[BLOCK];
  size_t n = 0;
  for (size_t k = 0; k < count; k++)
    if (!block[k].cushion && block[k].slip == slip)
      in[n] = block[k].balls, draws[n++] = &block[k];
  to_single(in, in32, 26 * n);
  carom_collide_batch(in, n, &options, out, status);
  carom_collide_batch_f32(in32, n, &options, out32, status32);
  for (size_t k = 0; k < n; k++) {
    const carom_status alone_status = carom_collide(&in[k], &options, &alone),
                       one32 = carom_collide_one(CAROM_F32, &in32[k], &options, &alone32);
    s->other_bits += alone_status != status[k] || memcmp(&alone, &out[k], sizeof alone) != 0;
    s->other_bits += one32 != status32[k] || memcmp(&alone32, &out32[k], sizeof alone32) != 0;
    compare_single(s, group, draws[k], &in32[k], &alone32, one32);
  }
}

static size_t run_blocks(const void *context, size_t start, size_t end) {
  static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  static size_t done;
  stress *const total = *(stress *const *)context, *part = allocate(1, sizeof *part);
  const size_t groups = (size_t)draw_groups(total->kind);
  drawn *drawn_ones = allocate(BLOCK, sizeof *drawn_ones);
  *part = (stress){.kind = total->kind, .seed = total->seed, .draws = total->draws};
  for (size_t block = start; block < end; block++) {
    const int group = (int)(block % groups);
    const uint64_t first = block / groups * BLOCK,
                   n = total->draws - first < BLOCK ? total->draws - first : BLOCK;
    for (uint64_t k = 0; k < n; k++) {
      drawn_ones[k] = draw(part->kind, group, part->seed, first + k);
      compare(part, group, first + k, &drawn_ones[k]);
    }
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
      run_batch(part, group, (carom_slip)slip, drawn_ones, (size_t)n);
    pthread_mutex_lock(&lock);
    progress_show("blocks of impacts", (double)++done,
                  (double)groups * ceil((double)total->draws / BLOCK));
    pthread_mutex_unlock(&lock);
  }
  pthread_mutex_lock(&lock);
  add(total, part);
  pthread_mutex_unlock(&lock);
  free(drawn_ones);
  free(part);
  return end;
}

/* ---- Tables */

static void print_row(FILE *out, const char *first, const char *second, const tally *t) {
  const long *n = t->count;
  fprintf(out,
          "%-9s %-20s %9ld  %7.1e   %7.1e   %7.1e   %7.1e  %7.1e  %7.1e  %7ld  %7ld  %7ld  %6.2f "
          "%%  %10ld  %7ld  %8ld\n",
          first, second, n[ROWS], quantile(t, 0.5), quantile(t, 0.99), quantile(t, 0.999),
          quantile(t, 0.9999), t->largest, t->largest_of_play, n[OVER_1E6], n[OVER_1E5],
          n[OVER_2E5],
          100.0 * (double)n[SLOW] / fmax(1, (double)(n[ROWS] + n[UNRESOLVED] + n[LEFT_OUT])),
          n[UNRESOLVED], n[NOT_TAKEN], n[LEFT_OUT]);
}

/* The numbers of an impact, in the order of its struct. */
static void print_numbers(FILE *out, const drawn *c) {
  const double *number = (const double *)&c->balls;
  int count = 26;
  char text[NUMBER_TEXT];
  if (c->cushion) {
    number = (const double *)&c->rail;
    count = 15;
  }
  for (int k = 0; k < count; k++)
    fprintf(out, "%s%s", text_if(k > 0, ","), number_text(number[k], text));
}

static void print_table(const stress *s, FILE *out) {
  static const char *const kinds[] = {"realistic collisions", "regimes collisions",
                                      "extreme collisions", "impacts on a cushion", "coincidences"};
  fprintf(out, "%s, %llu drawn of each kind with seed %llu, instruction set %s\n\n", kinds[s->kind],
          (unsigned long long)s->draws, (unsigned long long)s->seed,
          carom_word(CAROM_WORDS_ISA, (int)carom_isa_in_force()));
  fprintf(out,
          "%-9s %-20s %9s   median      99 %%    99.9 %%   99.99 %%  largest  of play   > 1e-6   > "
          "1e-5   > 2e-5  fallback  unresolved  refused  left out\n",
          "precision", "kind", "rows");
  for (int single = 0; single < 2; single++)
    for (int group = 0; group < draw_groups(s->kind); group++)
      if (single == 0 || !draw(s->kind, group, 0, 0).cushion)
        print_row(out, precision_name(single == 1), draw_name(s->kind, group),
                  &s->tally[group][single]);
  fprintf(out,
          "\nrows of batches whose bits or status differ from single calls: %ld\n"
          "precise solver against the reference, where calls differ from it by more than %g, and "
          "1 row in 1000: %ld rows, largest error %.1e, %ld above %s\n"
          "\nlargest errors:\n",
          s->other_bits, REFERENCE_FROM, s->request, s->precise_largest, s->precise_wrong,
          "1e-9, on a cushion 1e-8");
  for (int group = 0; group < draw_groups(s->kind); group++) {
    const tally *const t = &s->tally[group][0];
    if (t->count[ROWS] > 0) {
      const drawn c = draw(s->kind, group, s->seed, t->worst);
      const char *slip = carom_word(CAROM_WORDS_SLIP, (int)c.slip);
      if (c.cushion)
        slip = "cushion";
      fprintf(out, "%s, %s %llu, %.2g of its bound: ", slip, draw_name(s->kind, group),
              (unsigned long long)t->worst, t->worst_share);
      print_numbers(out, &c);
      fputc('\n', out);
    }
  }
}

/* The contract of carom.h: in double precision rows of play within 1e-6, all within 1e-5; in
 * single precision rows of play within 2e-5. And half of the realistic ones are within 3e-9; half
 * of these and of the regimes do without the precise solver. */
static bool holds(const stress *s) {
  bool good = s->other_bits == 0;
  for (int group = 0; group < draw_groups(s->kind); group++) {
    const tally *t = s->tally[group];
    good &= t[0].largest_of_play <= MOST_OF_PLAY && t[0].largest <= MOST;
    good &= t[1].largest_of_play <= MOST_SINGLE;
    good &= s->kind != DRAW_REALISTIC || quantile(t, 0.5) <= 3e-9;
    good &= s->kind == DRAW_EXTREME || s->kind == DRAW_COINCIDENCES ||
            2 * t[0].count[SLOW] <= t[0].count[ROWS];
  }
  return good;
}

OPTION(stress_job, option_draws, "draws", draws, "N", set_count, 1,
       "number of collisions for each slip (default: 100000)", .letter = 'n');
OPTION(stress_job, option_seed, "seed", seed, "S", set_count, 0,
       "seed of the random numbers (default: 1)");
OPTION(stress_job, option_kind, "kind", kind, DRAW_KIND_NAMES, set_choice, 0,
       "realistic: collisions of play (default); regimes: the special cases of the tests; extreme: "
       "everything that carom accepts");
OPTION(stress_job, option_cushions, "cushion", cushions, "N", set_count, 1,
       "instead: number of impacts on a cushion of each kind, impacts of play and arbitrary ones");
OPTION(stress_job, option_coincidences, "coincidences", coincidences, "N", set_count, 1,
       "instead: number of impacts of each kind of coincidence, of two balls and on a cushion: "
       "numbers that are exactly equal, zero or at the edge of a friction cone; planar motion; "
       "slips that are rounding errors; grazing impacts");

static const command_form form = {
    .name = "stress",
    .usage = "[OPTIONS]",
    .about = "Draws random collisions and solves them with single calls and in batches, in double "
             "and in single precision. It compares the results with the precise solver, and where "
             "they differ, with a reference in extended precision.\n",
    .options =
        (const option_row *const[]){&option_draws, &option_seed, &option_kind, &option_cushions,
                                    &option_coincidences, &option_threads, &option_output, NULL},
    .details = "exit code: 0; 1 if an error is larger than carom.h promises, or if a batch has "
               "other bits than single calls; 2 for bad usage\n",
    .example = "carom-lab stress --draws 10000 --kind regimes",
};

int command_stress(int argc, char **argv) {
  stress_job job = {.shared = {.options = COMMAND_OPTIONS}, .seed = 1};
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
  stress *total = allocate(1, sizeof *total);
  total->kind = (draw_kind)job.kind;
  if (job.cushions > 0)
    total->kind = DRAW_CUSHION;
  else if (job.coincidences > 0)
    total->kind = DRAW_COINCIDENCES;
  total->seed = (uint64_t)job.seed;
  total->draws = 100000;
  if (counts > 0)
    total->draws = (uint64_t)(job.draws + job.cushions + job.coincidences);
  carom_in_threads(run_blocks, &total,
                   (size_t)draw_groups(total->kind) * ((total->draws + BLOCK - 1) / BLOCK),
                   job.shared.options.threads, 1);
  progress_clear();
  print_table(total, out);
  const bool good = holds(total);
  free(total);
  if (!output_commit())
    return EXIT_USAGE;
  return exit_of(good);
}
