/* One run of `carom-lab bench`: what is timed is verified, then timed in turns by the engine,
 * then printed. There are two tables of work: collisions of two balls and whole shots. */
#ifndef CAROM_LAB_BENCH_JOB_H
#define CAROM_LAB_BENCH_JOB_H

#include "cases.h"
#include "options.h"
#include "rounds.h"

#include <stdio.h>

/* Lists that options grow: names and whole numbers with commas between; repeating the option
 * adds to them. */
/* Names point into the argument vector, whose commas become ends. */
typedef struct name_list {
  const char **name;
  size_t count, room;
} name_list;

typedef struct count_list {
  int *value;
  size_t count, room;
} count_list;
void add_count(count_list *list, int value);

typedef struct bench_job bench_job;

/* A table of work. `choose` makes and verifies job->subject, and sets the default budget; false
 * after a complaint. */
typedef struct bench_table {
  bool (*choose)(bench_job *job);
  void (*note)(const bench_job *job, FILE *out); /* lines on the work, for bench_print() */
  void (*print)(const bench_job *job, FILE *out);
  void (*release)(bench_job *job);
} bench_table;
extern const bench_table bench_of_collisions, bench_of_shots;

struct bench_job {
  shared_options shared;            /* the precision: ANY_PRECISION for both */
  name_list kernels, configs, isas; /* none: all; the default one; all */
  count_list steps;
  bool batch;         /* batches only */
  count_list pairs;   /* in a batch; none: the default */
  count_list threads; /* of a batch; none: the default */
  double budget;      /* 0: the table's own */
  bool csv, spread, errors, show_pairs;
  const char *shots; /* time a file of shots instead */
  const bench_table *table;
  double (*now)(void); /* the clock; NULL: the engine's */
  const char *folder;
  struct collisions *collisions; /* each table's own part */
  struct timed_shots *timed_shots;
  bench_subject *subject; /* those that passed */
  bench_figure *figure;
  size_t subject_count;
  int code;
  char *machine; /* lines about it, from before the run */
  const char *pinning;
  carom_isa isa; /* in force before the run */
};

/* Does this processor have it, and is it not above what CAROM_ISA allows? */
bool bench_isa_here(carom_isa isa);

/* Prints a row for each subject, for people or as CSV. */
void bench_print(const bench_job *job, FILE *out);

#endif
