/* One run of `carom-lab bench`: what is timed is verified, then timed interleaved by the engine,
 * then printed. There are three tables of work: collisions of two balls, complete shots,
 * cushions. */
#ifndef CAROM_LAB_BENCH_JOB_H
#define CAROM_LAB_BENCH_JOB_H

#include "program/options.h"
#include "rounds.h"

#include <stdio.h>

/* Names, or integers as text, with commas between; repeating an option adds to its list. They
 * point into the argument vector, whose commas become ends. */
typedef struct name_list {
  const char **name;
  size_t count, room;
} name_list;

typedef struct bench_job bench_job;

/* A table of work. `choose` makes and verifies job->subject; false after a complaint. */
typedef struct bench_table {
  bool (*choose)(bench_job *job);
  void (*print)(const bench_job *job, FILE *out);
} bench_table;
extern const bench_table bench_of_shots, bench_of_cushions;

struct bench_job {
  shared_options shared;            /* the precision: ANY_PRECISION for both */
  name_list kernels, configs, isas; /* none: all; the default one; all */
  name_list steps, pairs, threads;  /* of Euler's method; in a batch; of a batch */
  name_list slips;                  /* none: the kernel's own */
  bool batch;                       /* batches only */
  double budget;                    /* 0: the table's own */
  bool csv, spread, errors, counters;
  const char *shots; /* time a file of shots instead */
  bool cushions;     /* time impacts on a cushion instead */
  const bench_table *table;
  double (*clock)(void);  /* the clock; NULL: the engine's */
  bench_subject *subject; /* those that passed */
  bench_figure *figure;
  size_t subject_count;
  int code;
  const char *pinning;
};

#endif
