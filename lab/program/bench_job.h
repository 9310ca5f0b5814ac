/* One run of `carom-lab bench`, and the parts of the command that work on it. */
#ifndef CAROM_LAB_BENCH_JOB_H
#define CAROM_LAB_BENCH_JOB_H

#include "counters.h"
#include "lists.h"
#include "workload.h"

#include <stdio.h>

typedef struct bench_job {
  shared_options shared;            /* the precision: ANY_PRECISION for both */
  name_list kernels, configs, isas; /* none: all; the default one; all */
  count_list steps;
  bool batch;         /* batches only */
  count_list pairs;   /* in a batch; none: the default */
  count_list threads; /* of a batch; none: the default */
  double budget;
  bool csv, spread, errors, counters, show_pairs;
  const char *shots; /* a file of shots to time instead */
  int models;        /* carom_world of theirs */
  int cushion_model; /* and the model of their cushions, as in carom_shot_options */
  const char *folder;
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
