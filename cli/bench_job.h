/* One run of `carom bench`, and the parts of the command that work on it. */
#ifndef CAROM_CLI_BENCH_JOB_H
#define CAROM_CLI_BENCH_JOB_H

#include "counters.h"
#include "workload.h"

#include <stdio.h>

enum { MOST_NAMES = 64, MOST_STEPS = 64 };

typedef struct name_list {
  const char *name[MOST_NAMES];
  size_t count;
} name_list;

typedef struct bench_job {
  name_list kernels, configs; /* none: all; the default one */
  int steps[MOST_STEPS];
  size_t steps_count;
  double budget;
  bool csv, spread, errors, counters;
  const char *folder, *out;
  case_set cases;
  workload *work; /* the yardsticks, then all that is asked for */
  size_t work_count, work_space;
  bench_subject *subject; /* those that passed */
  bench_figure *figure;
  double (*count)[COUNTER_COUNT]; /* per collision */
  size_t subject_count;
  int code;
  char *machine; /* lines about it, from before the run */
  const char *pinning, *counters_text;
} bench_job;

/* Fills job->work from the options; what cannot run here is left out where it was not named. Complains and returns false if
 * there is nothing of a name. */
bool bench_choose(bench_job *job);

/* The subject that those with as many steps are compared with, or SIZE_MAX. */
size_t bench_yardstick(const bench_job *job, int steps);

/* Prints the figures, for people or as CSV. */
void bench_print(const bench_job *job, FILE *out);

#endif
