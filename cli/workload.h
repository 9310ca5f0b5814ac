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
  carom_impact *in; /* of the cases */
  size_t *case_of;  /* in[k] is case number case_of[k] */
  size_t pairs;
  size_t left_out;                 /* cases that the kernel refuses as too slow for as many steps, and that are not in `in` */
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

/* Resolves the cases and compares. At the claim's steps the reference is the claim's file and the bound is the claim's.
 *
 * At other steps there is no file: the reference is the library's Euler with as many steps, which has pooltool's bits, and
 * cases that a rung's precision does not resolve are left out. A rung that rounds differently may end one step sooner or later.
 * A step changes a velocity by (1 + e)|v_n|/(2N), at most 2/N of the pair's scale, so allowed is 2/N + bound * max(1, N /
 * claim's N); but a bound of 0 stays 0.
 *
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
