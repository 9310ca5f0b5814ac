/* One run of `carom bench`, and the parts of the command that work on it. */
#ifndef CAROM_CLI_BENCH_JOB_H
#define CAROM_CLI_BENCH_JOB_H

#include "counters.h"
#include "workload.h"

#include <stdio.h>

enum { MOST_NAMES = 64, MOST_STEPS = 64, MOST_PAIRS = 64, MOST_THREADS = 64 };

typedef struct name_list {
  const char *name[MOST_NAMES];
  size_t count;
} name_list;

typedef struct bench_job {
  name_list kernels, configs, isas; /* none: all; the default one; all */
  int steps[MOST_STEPS];
  size_t steps_count;
  bool batch;                /* batches only */
  const char *precision;     /* NULL: both */
  size_t pairs[MOST_PAIRS];  /* in a batch; none: the default */
  int threads[MOST_THREADS]; /* of a batch; none: the default */
  size_t pairs_count, threads_count;
  double budget;
  bool csv, spread, errors, counters, show_pairs;
  const char *folder, *out;
  case_set cases;
  case_tiles tiles;
  struct {
    const kernel *kernel;
    const ladder_module *module;
  } yardstick;
  workload *work; /* the yardsticks, then all that is asked for */
  size_t work_count, work_space;
  bench_subject *subject; /* those that passed */
  bench_figure *figure;
  double (*count)[COUNTER_COUNT]; /* per collision */
  size_t subject_count;
  int code;
  char *machine; /* lines about it, from before the run */
  const char *pinning, *counters_text;
  carom_isa isa; /* in force before the run */
} bench_job;

/* Fills job->work from the options; what cannot run here is left out where it was not named. Complains and returns false if
 * there is nothing of a name. */
bool bench_choose(bench_job *job);

/* The subject that `of` is compared with, or SIZE_MAX. */
size_t bench_yardstick(const bench_job *job, const workload *of);

/* Does this processor have it, and is it not above what CAROM_ISA allows? */
bool bench_isa_here(carom_isa isa);

/* Prints the figures, for people or as CSV. */
void bench_print(const bench_job *job, FILE *out);

#endif
