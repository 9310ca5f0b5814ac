/* The engine: subjects timed in turns, A B C A B C ..., so that what drifts (frequency,
 * neighbours, heat) meets all alike.
 *
 *     sample   one subject resolves its whole workload `loops` times; the figure is ns per pair,
 *              less the cost of empty calls
 *     round    one sample of every subject
 *     result   median, extremes and spread over the rounds; speedup is the median of the ratios
 *              within each round */
#ifndef CAROM_BENCH_ROUNDS_H
#define CAROM_BENCH_ROUNDS_H

#include "statistics.h"

#include <stdbool.h>
#include <stdint.h>

/* Tells the compiler that somebody reads what `pointer` points to, so that it must have been
 * computed. */
#define BENCH_CONSUME(pointer) __asm__ volatile("" : : "r"(pointer) : "memory")

/* What is timed. Whoever makes a subject has verified it: the engine only sees to it that what
 * was timed gave the results that were verified. */
typedef struct bench_subject {
  const char *kernel, *config, *isa, *precision; /* labels, as in the CSV */
  int threads;                                   /* more than one: timed on all cores */
  int steps;                                     /* 0 where the kernel takes none */
  const char *paper;                             /* the speedup that the seed paper gives, as
                                                    text; NULL: none */
  size_t pairs;                                  /* collisions in the workload */
  size_t in_a_call;                              /* and in a call of a batch; 0 for single calls */
  void (*resolve)(void *context);                /* resolves the workload once */
  void (*empty)(void *context);                  /* the same calls of a kernel that does nothing;
                                                    NULL: nothing to subtract */
  uint64_t (*fingerprint)(const void *context);  /* of the results */
  void *context;
  uint64_t verified;     /* the fingerprint of the verified results */
  double pair_error_max; /* of the verified results */
  const char *slip;      /* of the CSV's further columns, with the errors against the exact limit */
  double error_exact_median, error_exact_max;
  size_t reference; /* index of the subject that speedup is relative to; SIZE_MAX for none: NAN */
} bench_subject;

typedef struct bench_settings {
  double budget;                               /* seconds for all; at least 5 rounds are run
                                                  whatever it is */
  double (*now)(void);                         /* nanoseconds; NULL for the monotonic clock */
  void (*progress)(double done, double total); /* called after each sample; NULL for none */
} bench_settings;

typedef struct bench_figure {
  sample_summary ns;      /* per pair */
  sample_summary speedup; /* the reference's time over this one's */
  double empty_ns;        /* what has been subtracted, per pair */
  size_t loops;           /* workloads in a sample */
  bool unchanged;         /* the results after the last round are the verified ones */
} bench_figure;

/* Times n subjects; figure[k] is that of subject[k]. False if memory runs out. */
bool bench_rounds(const bench_subject *subject, size_t n, const bench_settings *settings,
                  bench_figure *figure);

/* FNV-1a over the 64-bit words of results, for subjects' fingerprints. `bytes` is a multiple of
 * 8. */
uint64_t bench_fingerprint(const void *results, size_t bytes);

#endif
