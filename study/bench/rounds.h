/* The engine: subjects timed in turns, A B C A B C ..., so that what drifts (frequency,
 * neighbours, heat) meets all alike.
 *
 *     sample   one subject resolves its whole workload `loops` times; the figure is ns per pair
 *     round    one sample of every subject
 *     result   median, extremes and spread over the rounds; speedup is the median of the ratios
 *              within each round */
#ifndef CAROM_BENCH_ROUNDS_H
#define CAROM_BENCH_ROUNDS_H

#include "counters.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Makes the compiler assume that the target of `pointer` is read, so that it must be computed. */
#define BENCH_CONSUME(pointer) __asm__ volatile("" : : "r"(pointer) : "memory")

/* What is timed. Its results are there, verified by whoever made it. */
typedef struct bench_subject {
  const char *name;
  void *context;
  void (*prepare)(void *context);               /* before each sample, not timed; or NULL */
  void (*resolve)(void *context);               /* resolves the workload once */
  uint64_t (*fingerprint)(const void *context); /* of the results */
  size_t pairs;                                 /* in the workload */
  int threads;                                  /* more than one: timed on all cores */
  size_t reference; /* index of the subject that speedup is relative to; SIZE_MAX: none */
} bench_subject;

typedef struct bench_settings {
  double budget;                               /* seconds for all; at least 5 rounds are run
                                                  whatever it is */
  double (*clock)(void);                       /* nanoseconds; NULL for the monotonic clock */
  double (*processor)(void);                   /* the same of the thread's processor time, for
                                                  cycles; NULL for Linux's clock of it */
  double (*cycle)(void);                       /* a core cycle just now, ns; NULL: not wanted */
  void (*progress)(double done, double total); /* called after each sample; NULL for none */
  const counter_set *counters;                 /* read around each sample; NULL for none */
} bench_settings;

typedef struct sample_summary {
  size_t count;
  double median, min, max;
  double spread; /* median absolute deviation from the median: half of the samples lie within it */
} sample_summary;

typedef struct bench_figure {
  sample_summary ns;      /* per pair */
  sample_summary speedup; /* the reference's time over this one's */
  double core_cycles;     /* per pair: the processor time of each sample over the core cycle just
                         before it, the median; NAN where that is not wanted or not known, and
                         with several threads */
  size_t loops;           /* workloads in a sample */
  double counted[COUNTER_COLUMNS]; /* per pair: medians over the rounds in which they were counted;
                                      NAN where they are not, as with several threads */
  bool unchanged;                  /* the results after the last round are those before the first */
} bench_figure;

/* Times n subjects; figure[k] belongs to subject[k]. */
void bench_rounds(const bench_subject *subject, size_t n, const bench_settings *settings,
                  bench_figure *figure);

/* FNV-1a over the 64-bit words of results, for fingerprints. `bytes` is a multiple of 8. */
uint64_t bench_fingerprint(const void *results, size_t bytes);

/* Sorts n samples, which are no NaN. */
void sort_samples(double *sample, size_t n);

/* Of n > 0 sorted samples the one in the middle, or the mean of the two. */
double median_of_sorted(const double *sample, size_t n);

/* Summarises n samples; reorders and overwrites them. All is NAN for n = 0 or where a sample is
 * NAN. */
sample_summary summarise(double *sample, size_t n);

#endif
