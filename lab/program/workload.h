/* What `carom-lab bench` times: a kernel on collisions, by the path that a user has, with the results it has been verified by.
 *
 *     calls   the cases, one call each                               any kernel       isa "scalar"
 *     batch   the cases over and over, many in a call                solvers only     isa "avx512", ...
 *     copy    a batch's bytes, read and written, nothing computed    no kernel        what no batch can be faster than
 */
#ifndef CAROM_LAB_WORKLOAD_H
#define CAROM_LAB_WORKLOAD_H

#include "cases.h"
#include "kernel.h"
#include "rounds.h"

/* How far a workload's results are from a reference, over the cases. */
typedef struct workload_error {
  double max, median;
} workload_error;

/* The cases over and over, in both precisions; row k is case k modulo the number of cases. */
typedef struct case_tiles {
  size_t rows;
  carom_impact *in;
  carom_impact_f32 *in_f32;
} case_tiles;

/* What is particular to batches and copies. */
typedef struct workload_batch {
  size_t size;                /* pairs in a call; 0: single calls */
  size_t calls;               /* in a pass, each beginning `size` cases further on */
  carom_isa isa;              /* of a batch */
  bool single;                /* precision */
  const case_tiles *tiles;    /* where the input is */
  carom_result_f32 *result32; /* the results in single precision */
} workload_batch;

typedef struct workload {
  const kernel *kernel;        /* NULL for a copy */
  const ladder_module *module; /* of a rung; NULL for a solver of the library */
  const ladder_rung *rung;     /* likewise */
  const char *isa;             /* as in the CSV */
  carom_options options;
  const case_set *cases;
  const carom_impact *in; /* the rows */
  size_t *case_of;        /* row k is case number case_of[k]; NULL: k modulo the number of cases */
  size_t rows;            /* of `in` and `result` */
  size_t pairs;           /* collisions in a pass; in batches a row may be resolved more than once */
  size_t left_out;        /* cases that the kernel refuses as too slow for as many steps, and that are not in `in` */
  carom_result *result;   /* one for each row */
  workload_batch batch;
  void (*resolve)(void *workload); /* one pass */
  void (*empty)(void *workload);   /* the same calls of a kernel that does nothing; NULL where a call costs nothing */
  workload_error own;              /* against the kernel's own reference */
  workload_error exact;            /* against the limit N -> infinity with the same slip; set by workload_compare_exact() */
} workload;

/* Makes a workload of the cases, one call each, of kernel `one` as `module` has built it, with `steps` steps (read only if it
 * takes any) and the slip of its first claim. */
void workload_of_calls(workload *w, const kernel *one, const ladder_module *module, int steps, const case_set *cases);
void workload_free(workload *w);

/* The rows that batches of up to `size` pairs are cut from. */
void case_tiles_make(case_tiles *tiles, const case_set *cases, size_t size);
void case_tiles_free(case_tiles *tiles);

/* Makes a workload of batches of `size` pairs, by a solver in lanes of `isa`, with `threads` threads. A small batch is repeated
 * until every case has been in as many batches as any other. */
void workload_of_batch(workload *w, const kernel *one, carom_isa isa, bool single, int threads, int steps, size_t size,
                       const case_set *cases, const case_tiles *tiles);

/* Makes a workload that moves what a batch of `size` pairs moves: all input is read, as much as the results take is written. */
void workload_of_copy(workload *w, bool single, int threads, size_t size, const case_set *cases, const case_tiles *tiles);

/* Bytes that a solver reads and writes for a pair. */
size_t workload_bytes(bool single);

/* Resolves the cases and compares. At the claim's steps the reference is the claim's file and the bound is the claim's, or, for
 * batches, that of their solver and precision.
 *
 * At other steps there is no file: the reference is the library's Euler with as many steps, which has pooltool's bits, and
 * cases that a rung's precision does not resolve are left out. A rung that rounds differently may end one step sooner or later.
 * A step changes a velocity by (1 + e)|v_n|/(2N), at most 2/N of the pair's scale, so allowed is 2/N + bound * max(1, N /
 * claim's N); but a bound of 0 stays 0. A copy has to be one.
 *
 * `message` becomes "" or, when the kernel is not to be timed, a sentence. False if data could not be read. */
enum { WORKLOAD_MESSAGE = 256 };
bool workload_verify(workload *w, const char *folder, char message[WORKLOAD_MESSAGE]);

/* Sets w->exact; to be called when it has been verified. False if the reference could not be read. */
bool workload_compare_exact(workload *w, const char *folder);

/* The workload as a subject of the engine; labels point into the kernel's row. */
bench_subject workload_subject(workload *w);

/* Does the kernel take steps? */
bool workload_takes_steps(const kernel *one);

/* Its steps, 0 if it takes none. */
int workload_steps(const workload *w);

/* The bound on the pair error of a batch; 0 asks for the same bits. */
double workload_batch_bound(const workload *w);

/* Is what a copy has written a copy? */
bool workload_is_copy(const workload *w);

/* The kernel's name, or "copy". */
const char *workload_name(const workload *w);

/* The build: "clang-default", or "library"; for a copy where its arrays lie: "L2", "memory". */
const char *workload_config(const workload *w);

const char *workload_precision(const workload *w);

#endif
