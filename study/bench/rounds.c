/* The engine. A sample should last about 20 ms, so that clocks and the change from one subject to
 * the next cost nothing, and an interruption spoils one sample of many; 101 rounds or more are
 * wanted. Where the budget is short, samples shrink, down to a millisecond or one pass over the
 * workload, and then the rounds, down to 5. Less than a millisecond would time caches and branch
 * predictors that are still full of the subject before.
 *
 * Median and median absolute deviation, because a busy machine makes outliers on one side only: an
 * interrupted sample is too long, none is ever too short. */
#include "rounds.h"

#include "pinning.h"
#include "program/program.h"

enum { FEWEST_ROUNDS = 5, WANTED_ROUNDS = 101, MOST_ROUNDS = 10001 };
static const double long_sample = 20e6, short_sample = 1e6; /* ns */

/* ---- Statistics */

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

void sort_samples(double *sample, size_t n) {
  qsort(sample, n, sizeof *sample, ascending);
}

double median_of_sorted(const double *sample, size_t n) {
  return n % 2 == 1 ? sample[n / 2] : 0.5 * (sample[n / 2 - 1] + sample[n / 2]);
}

sample_summary summarise(double *sample, size_t n) {
  sample_summary s = {.count = n, .median = NAN, .min = NAN, .max = NAN, .spread = NAN};
  bool known = n > 0;
  for (size_t k = 0; k < n; k++)
    known &= !isnan(sample[k]);
  if (!known)
    return s;
  sort_samples(sample, n);
  s.median = median_of_sorted(sample, n);
  s.min = sample[0];
  s.max = sample[n - 1];
  for (size_t k = 0; k < n; k++)
    sample[k] = fabs(sample[k] - s.median);
  sort_samples(sample, n);
  s.spread = median_of_sorted(sample, n);
  return s;
}

uint64_t bench_fingerprint(const void *results, size_t bytes) {
  const char *next = results;
  uint64_t hash = 0xcbf29ce484222325u, word;
  for (size_t k = 0; k + sizeof word <= bytes; k += sizeof word) {
    memcpy(&word, next + k, sizeof word);
    hash = (hash ^ word) * 0x100000001b3u;
  }
  return hash;
}

/* ---- Interleaved samples */

/* The counters that run in a sample. */
typedef struct counting {
  const counter_set *set; /* NULL: none */
  size_t group;
  double *count; /* of each event */
} counting;

/* What a sample takes, ns: of the clock, which a user waits for, and of the processor, which other
 * programs do not lengthen. */
typedef struct duration {
  double clock, processor;
} duration;

typedef struct clocks {
  double (*clock)(void), (*processor)(void);
} clocks;

/* The counters start and stop just outside the clocks, so that starting them is not timed. */
static duration sample(const bench_subject *s, size_t loops, const clocks *by,
                       const counting *counters) {
  if (s->prepare != NULL)
    s->prepare(s->context);
  if (counters->set != NULL)
    counters_start(counters->set, counters->group);
  const duration start = {.processor = by->processor(), .clock = by->clock()};
  for (size_t k = 0; k < loops; k++)
    s->resolve(s->context);
  duration elapsed = {.clock = by->clock() - start.clock};
  elapsed.processor = by->processor() - start.processor;
  if (counters->set != NULL)
    counters_stop(counters->set, counters->group, counters->count);
  return elapsed;
}

/* Warm-up, and what one pass costs: the fastest of ever more loops until they take a
 * millisecond. */
static double estimate(const bench_subject *s, const clocks *by) {
  double pass = INFINITY, elapsed = 0.0;
  for (size_t loops = 1; elapsed < short_sample && loops < SIZE_MAX / 2; loops *= 2) {
    elapsed = sample(s, loops, by, &(counting){.set = NULL}).clock;
    pass = fmin(pass, elapsed / (double)loops);
  }
  return pass;
}

/* ns per pair. A sample of more than one loop begins with a pass that is not timed. Counters and
 * processor time belong to this thread, so they do not count a subject that has more of them. */
static duration take_sample(const bench_subject *s, size_t loops, const clocks *by,
                            counting counters) {
  if (s->threads > 1) {
    pinning_suspend();
    counters.set = NULL;
  }
  if (loops > 1)
    sample(s, 1, by, &(counting){.set = NULL});
  duration full = sample(s, loops, by, &counters);
  if (s->threads > 1) {
    pinning_resume();
    full.processor = NAN;
  }
  pinning_breathe(full.clock);
  const double pairs = (double)loops * (double)s->pairs;
  return (duration){.clock = full.clock / pairs, .processor = full.processor / pairs};
}

/* The columns of subject k from its counts of each event in each round, of which those are NAN that
 * were not counted; they are per sample of so many pairs. */
static void summarise_counts(const counter_set *set, const double *count, size_t rounds,
                             size_t stride, double pairs, bench_figure *figure) {
  const size_t events = counters_events(set);
  double *median = allocate(events + 1, sizeof *median);
  double *counted = allocate(rounds, sizeof *counted);
  for (size_t e = 0; e < events; e++) {
    size_t n = 0;
    for (size_t r = 0; r < rounds; r++)
      if (!isnan(count[r * stride + e]))
        counted[n++] = count[r * stride + e];
    median[e] = summarise(counted, n).median / pairs;
  }
  counters_columns(set, median, figure->counted);
  free(counted);
  free(median);
}

/* Time, cycles and speedup of subject k of n over the rounds; `scratch` has room for a number a
 * round. */
static void summarise_times(const double *ns, const double *cycles, size_t rounds, size_t n,
                            size_t reference, size_t k, double *scratch, bench_figure *figure) {
  for (size_t r = 0; r < rounds; r++)
    scratch[r] = reference < n ? ns[r * n + reference] / ns[r * n + k] : NAN;
  figure->speedup = summarise(scratch, rounds);
  for (size_t r = 0; r < rounds; r++)
    scratch[r] = ns[r * n + k];
  figure->ns = summarise(scratch, rounds);
  for (size_t r = 0; r < rounds; r++)
    scratch[r] = cycles[r * n + k];
  figure->core_cycles = summarise(scratch, rounds).median;
}

void bench_rounds(const bench_subject *subject, size_t n, const bench_settings *settings,
                  bench_figure *figure) {
  double (*const clock)(void) = settings->clock != NULL ? settings->clock : clock_ns;
  clocks by = {.clock = clock, .processor = thread_ns};
  if (settings->processor != NULL)
    by.processor = settings->processor;
  const double start = clock(), budget = 1e9 * settings->budget;
  const counter_set *counters = settings->counters;
  size_t groups = 0, events = 0;
  if (counters != NULL) {
    groups = counters_groups(counters);
    events = counters_events(counters);
  }
  double *pass = allocate(n, sizeof *pass);
  double *ns = NULL, *cycles = NULL, *count = NULL; /* round after round */
  uint64_t *fingerprints = allocate(n, sizeof *fingerprints);
  double passes = 0.0;
  for (size_t k = 0; k < n; k++) {
    fingerprints[k] = subject[k].fingerprint(subject[k].context);
    passes += pass[k] = estimate(&subject[k], &by);
  }

  /* samples of the length that gives the rounds that are wanted */
  const double a_round = (budget - (clock() - start)) / WANTED_ROUNDS;
  const double length = fmin(fmax((a_round - passes) / (double)n, short_sample), long_sample);
  for (size_t k = 0; k < n; k++)
    figure[k].loops = (size_t)fmax(1.0, floor(length / pass[k]));

  /* rounds until the time is over, an odd number of them: that has a sample in the middle */
  size_t rounds = 0, room = 0, cycles_room = 0, count_room = 0;
  double spent = 0.0, longest = 0.0;
  while (rounds < FEWEST_ROUNDS || rounds < groups || rounds % 2 == 0 ||
         (rounds < MOST_ROUNDS && spent + 2.0 * longest < budget)) {
    const double begin = clock();
    ns = grow(ns, &room, (rounds + 1) * n, sizeof *ns);
    cycles = grow(cycles, &cycles_room, (rounds + 1) * n, sizeof *cycles);
    count = grow(count, &count_room, (rounds + 1) * n * events + 1, sizeof *count);
    for (size_t e = 0; e < n * events; e++)
      count[rounds * n * events + e] = NAN;
    for (size_t k = 0; k < n; k++) {
      counting round = {.set = NULL};
      if (groups > 0) /* they take turns */
        round = (counting){counters, rounds % groups, count + (rounds * n + k) * events};
      /* a shared core changes its pace within seconds, so a cycle is measured for each sample */
      double cycle = NAN;
      if (settings->cycle != NULL)
        cycle = settings->cycle();
      const duration pair = take_sample(&subject[k], figure[k].loops, &by, round);
      ns[rounds * n + k] = pair.clock;
      cycles[rounds * n + k] = pair.processor / cycle;
      if (settings->progress != NULL)
        settings->progress(fmin(clock() - start, budget) * 1e-9, settings->budget);
    }
    spent = clock() - start;
    longest = fmax(longest, clock() - begin);
    rounds++;
  }

  double *scratch = allocate(rounds, sizeof *scratch);
  for (size_t k = 0; k < n; k++) {
    summarise_times(ns, cycles, rounds, n, subject[k].reference, k, scratch, &figure[k]);
    for (int column = 0; column < COUNTER_COLUMNS; column++)
      figure[k].counted[column] = NAN;
    if (counters != NULL)
      summarise_counts(counters, count + k * events, rounds, n * events,
                       (double)figure[k].loops * (double)subject[k].pairs, &figure[k]);
    figure[k].unchanged = subject[k].fingerprint(subject[k].context) == fingerprints[k];
  }
  free(scratch);
  free(fingerprints);
  free(pass);
  free(count);
  free(cycles);
  free(ns);
}
