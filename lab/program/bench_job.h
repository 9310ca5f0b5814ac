/* One run of `carom-lab bench`, and the parts of the command that work on it.
 *
 * The benchmark is one: what is timed is verified, then timed in turns by the engine, then printed. There are three tables of
 * work: collisions of two balls (bench_choice.c), impacts on cushions (bench_cushions.c), whole shots (bench_shots.c). */
#ifndef CAROM_LAB_BENCH_JOB_H
#define CAROM_LAB_BENCH_JOB_H

#include "counters.h"
#include "lists.h"
#include "workload.h"

#include <stdio.h>

typedef struct bench_job bench_job;
typedef struct timed_shot timed_shot;
typedef struct cushion_work cushion_work;

/* A table of work. `choose` makes and verifies job->subject, and sets the default budget; false after a complaint. */
typedef struct bench_table {
  bool (*choose)(bench_job *job);
  void (*note)(const bench_job *job, FILE *out); /* lines on the work, for bench_print() */
  void (*print)(const bench_job *job, FILE *out);
  void (*release)(bench_job *job);
} bench_table;
extern const bench_table bench_of_collisions, bench_of_cushions, bench_of_shots;

struct bench_job {
  shared_options shared;            /* the precision: ANY_PRECISION for both */
  name_list kernels, configs, isas; /* none: all; the default one; all */
  count_list steps;
  bool batch;         /* batches only */
  count_list pairs;   /* in a batch; none: the default */
  count_list threads; /* of a batch; none: the default */
  double budget;      /* 0: the table's own */
  bool csv, spread, errors, counters, show_pairs;
  bool cushion;      /* time impacts on cushions instead */
  const char *shots; /* or a file of shots */
  int models;        /* carom_world of theirs */
  int cushion_model; /* and the model of their cushions, as in carom_shot_options */
  const bench_table *table;
  double (*now)(void); /* the clock; NULL: the engine's */
  cushion_work *cushions;
  struct shot_file *shot_file; /* open as long as its tables are needed */
  timed_shot *shot;
  size_t shot_count;
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
};

/* Does this processor have it, and is it not above what CAROM_ISA allows? */
bool bench_isa_here(carom_isa isa);

/* Prints a row for each subject, for people or as CSV. */
void bench_print(const bench_job *job, FILE *out);

#endif
