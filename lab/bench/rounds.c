/* The engine. How a budget becomes rounds and loops: a sample should last about 20 ms, so that
 * clocks and the change from one subject to the next cost nothing, and an interruption spoils
 * one sample of many; 101 rounds or more are wanted. Where the budget is short, samples shrink
 * first, down to a millisecond or one pass over the workload, then the rounds, down to 5. Less
 * than a millisecond would time caches and branch predictors that are still full of the subject
 * before. */
#include "rounds.h"

#include "monotonic.h"
#include "pinning.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double fewest_rounds = 5.0, wanted_rounds = 101.0, most_rounds = 10001.0;
static const double long_sample = 20e6, short_sample = 1e6; /* ns */

typedef struct lane {
  double pass; /* estimated ns for one pass over the workload */
  size_t loops;
  double *ns, *empty; /* by round, per pair */
} lane;

typedef struct engine {
  const bench_subject *subject;
  size_t n;
  bench_settings settings;
  lane *lane;
  size_t rounds;
  double start, *scratch;
} engine;

static double sample(const engine *e, void (*work)(void *), void *context, size_t loops) {
  const double start = e->settings.now();
  for (size_t k = 0; k < loops; k++)
    work(context);
  return e->settings.now() - start;
}

/* Warm-up, and what one pass costs: the fastest of ever more loops until they take a
 * millisecond. */
static double estimate(const engine *e, const bench_subject *s) {
  double pass = INFINITY, elapsed = 0.0;
  for (size_t loops = 1; elapsed < short_sample && loops < SIZE_MAX / 2; loops *= 2) {
    elapsed = sample(e, s->resolve, s->context, loops);
    pass = fmin(pass, elapsed / (double)loops);
  }
  return pass;
}

/* A sample of more than one loop begins with a pass that is not timed. */
static double cost_of_sample(double pass, double length) {
  return length < 2.0 * pass ? pass : length + pass;
}

static double cost_of_round(const engine *e, double length) {
  double sum = 0.0;
  for (size_t k = 0; k < e->n; k++)
    sum += cost_of_sample(e->lane[k].pass, length);
  return sum;
}

/* Chooses the number of rounds and the loops of each subject. */
static void plan(engine *e) {
  /* A tenth for what lies between samples. */
  const double left = 0.9 * fmax(0.0, e->settings.budget * 1e9 - (e->settings.now() - e->start));
  double length = long_sample;
  double rounds = floor(left / cost_of_round(e, length));
  if (rounds < wanted_rounds) {
    rounds = fmin(wanted_rounds, floor(left / cost_of_round(e, short_sample)));
    rounds = fmax(rounds, fewest_rounds);
    double low = short_sample, high = long_sample;
    for (int k = 0; k < 40; k++) {
      length = 0.5 * (low + high);
      *(cost_of_round(e, length) * rounds > left ? &high : &low) = length;
    }
    length = low;
  }
  e->rounds = (size_t)fmin(rounds, most_rounds);
  e->rounds -= e->rounds % 2 == 0; /* an odd number has a sample in the middle */
  for (size_t k = 0; k < e->n; k++)
    e->lane[k].loops = (size_t)fmax(1.0, floor(length / e->lane[k].pass));
}

static void take_sample(engine *e, size_t k, size_t round) {
  const bench_subject *s = &e->subject[k];
  lane *l = &e->lane[k];
  if (s->threads > 1)
    pinning_suspend();
  if (l->loops > 1)
    s->resolve(s->context);
  const double collisions = (double)l->loops * (double)s->pairs;
  const double full = sample(e, s->resolve, s->context, l->loops);
  l->ns[round] = full / collisions;
  l->empty[round] =
      s->empty != NULL ? sample(e, s->empty, s->context, 8) / (8.0 * (double)s->pairs) : 0.0;
  if (s->threads > 1)
    pinning_resume();
  pinning_breathe(full);
}

static void take_rounds(engine *e) {
  for (size_t round = 0; round < e->rounds; round++) {
    for (size_t k = 0; k < e->n; k++) {
      take_sample(e, k, round);
      if (e->settings.progress != NULL)
        e->settings.progress((double)(round * e->n + k + 1), (double)(e->rounds * e->n));
    }
    /* The machine may have become slower than it was when the rounds were planned. */
    if (e->settings.now() - e->start > e->settings.budget * 1e9 &&
        (double)(round + 1) >= fewest_rounds && round + 1 < e->rounds)
      e->rounds = round + 1;
  }
}

/* The empty call's cost is the median over the rounds: it is small, and single samples of it are
 * all noise. */
static void subtract_empty(engine *e, bench_figure *figure) {
  for (size_t k = 0; k < e->n; k++) {
    lane *l = &e->lane[k];
    memcpy(e->scratch, l->empty, e->rounds * sizeof(double));
    figure[k].empty_ns = summarise(e->scratch, e->rounds).median;
    for (size_t round = 0; round < e->rounds; round++)
      l->ns[round] -= figure[k].empty_ns;
  }
}

static void evaluate(engine *e, bench_figure *figure) {
  subtract_empty(e, figure);
  for (size_t k = 0; k < e->n; k++) {
    const size_t reference = e->subject[k].reference;
    figure[k].speedup = reference < e->n ? summarise_ratios(e->lane[reference].ns, e->lane[k].ns,
                                                            e->rounds, e->scratch)
                                         : summarise(e->scratch, 0);
  }
  for (size_t k = 0; k < e->n; k++) {
    figure[k].ns = summarise(e->lane[k].ns, e->rounds);
    figure[k].loops = e->lane[k].loops;
    figure[k].unchanged =
        e->subject[k].fingerprint(e->subject[k].context) == e->subject[k].verified;
  }
}

bool bench_rounds(const bench_subject *subject, size_t n, const bench_settings *settings,
                  bench_figure *figure) {
  engine e = {.subject = subject, .n = n, .settings = *settings};
  if (e.settings.now == NULL)
    e.settings.now = clock_ns;
  e.start = e.settings.now();
  e.lane = calloc(n, sizeof *e.lane);
  double *block = NULL;
  if (e.lane != NULL) {
    for (size_t k = 0; k < n; k++)
      e.lane[k].pass = estimate(&e, &subject[k]);
    plan(&e);
    block = calloc((2 * n + 1) * e.rounds, sizeof *block);
  }
  if (block != NULL) {
    e.scratch = block + 2 * n * e.rounds;
    for (size_t k = 0; k < n; k++) {
      e.lane[k].ns = block + 2 * k * e.rounds;
      e.lane[k].empty = block + (2 * k + 1) * e.rounds;
    }
    take_rounds(&e);
    evaluate(&e, figure);
  }
  free(block);
  free(e.lane);
  return block != NULL;
}

uint64_t bench_fingerprint(const void *results, size_t bytes) {
  const char *from = results;
  uint64_t hash = 0xcbf29ce484222325u, word;
  for (size_t k = 0; k + sizeof word <= bytes; k += sizeof word) {
    memcpy(&word, from + k, sizeof word);
    hash = (hash ^ word) * 0x100000001b3u;
  }
  return hash;
}
