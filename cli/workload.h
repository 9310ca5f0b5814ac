/* What `carom bench` times: a kernel on collisions, by the path that a user has, with the results it has been verified by. */
#ifndef CAROM_CLI_WORKLOAD_H
#define CAROM_CLI_WORKLOAD_H

#include "cases.h"
#include "kernel.h"
#include "rounds.h"

/* How far a workload's results are from a reference, over the cases. */
typedef struct workload_error {
  double max, median;
} workload_error;

typedef struct workload {
  const kernel *kernel;
  const ladder_module *module; /* of a rung; NULL for a solver of the library */
  const ladder_rung *rung;     /* likewise */
  const char *isa;             /* "scalar" for one call per collision */
  carom_options options;
  const case_set *cases;
  const carom_impact *in; /* the cases, as often over as makes `pairs` */
  size_t pairs;
  carom_result *result;            /* one for each pair */
  void (*resolve)(void *workload); /* all pairs */
  void (*empty)(void *workload);   /* the same calls of a kernel that does nothing */
  workload_error own;              /* against the kernel's own reference */
  workload_error exact;            /* against the limit N -> infinity with the same slip; set by workload_compare_exact() */
} workload;

/* Makes a workload of the cases, one call each, of kernel `one` as `module` has built it, with `steps` steps and the slip of
 * its first claim. Complains and returns false if memory runs out. */
bool workload_of_calls(workload *w, const kernel *one, const ladder_module *module, int steps, const case_set *cases);
void workload_free(workload *w);

/* Resolves the cases and compares. At the claim's steps the reference is the claim's file and the bound is the claim's. At
 * other steps there is no file: the reference is then the library's Euler with as many steps, which has pooltool's bits, and
 * the bound grows with the share of a step or with the number of roundings: bound * max(claim's steps / steps, its inverse).
 * `message` becomes "" or, when the kernel is not to be timed, a sentence. False if data could not be read. */
enum { WORKLOAD_MESSAGE = 256 };
bool workload_verify(workload *w, const char *folder, char message[WORKLOAD_MESSAGE]);

/* Sets w->exact. False if the reference could not be read. */
bool workload_compare_exact(workload *w, const char *folder);

/* The workload as a subject of the engine; labels point into the kernel's row. */
bench_subject workload_subject(workload *w);

/* The build: "clang-default", or "library". */
const char *workload_config(const workload *w);

/* The speedup that the seed paper gives, as text; "-" for what is not in it. */
const char *workload_paper(const workload *w);

#endif
