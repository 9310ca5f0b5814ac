/* The batch: who computes how many pairs with which instructions. See dispatch.c. */
#ifndef CAROM_SRC_BATCH_H
#define CAROM_SRC_BATCH_H

#include "carom.h"

/* Resolves n pairs of one precision with checked options; in, out and status as in carom_collide_batch(), status may be NULL.
 * Returns the index of the first pair in error, or n. */
typedef size_t carom_batch_solver(const void *in, size_t n, const carom_options *opt, void *out, uint8_t *status);

typedef enum carom_precision { CAROM_DOUBLE, CAROM_SINGLE, CAROM_PRECISIONS } carom_precision;

/* X(NAME, suffix) for the instruction sets that this build has; see CMakeLists.txt. */
#if defined(__x86_64__)
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain) X(SSE2, sse2) X(AVX2, avx2) X(AVX512, avx512)
#elif defined(__aarch64__)
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain) X(NEON, neon)
#else
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain)
#endif

/* Without vectors single calls are faster than lanes for any number of pairs in double precision. */
#define carom_exact_lanes_plain_double carom_singles_double
#define CAROM_BATCH_PROTOTYPE(NAME, suffix)                                                    \
  carom_batch_solver carom_euler_lanes_##suffix##_double, carom_euler_lanes_##suffix##_single, \
      carom_exact_lanes_##suffix##_double, carom_exact_lanes_##suffix##_single;
CAROM_BUILT_ISAS(CAROM_BATCH_PROTOTYPE)
#undef CAROM_BATCH_PROTOTYPE

/* One pair by a single call, with the checks and the status of carom_collide(): what lanes fall back to for a row that is not
 * plainly good. `in` and `out` are of the precision. */
carom_status carom_collide_one(carom_precision precision, const void *in, const carom_options *opt, void *out);

/* Splits n pairs over threads (opt->threads) and runs `solver` on each part; returns as `solver` does. */
size_t carom_batch_in_threads(carom_batch_solver *solver, carom_precision precision, const void *in, size_t n,
                              const carom_options *opt, void *out, uint8_t *status);

/* By single calls; see singles.c. */
carom_batch_solver carom_singles_double, carom_singles_single;

/* The solver of n pairs for the instruction set in force. */
carom_batch_solver *carom_batch_solver_for(carom_solver solver, carom_precision precision, size_t n);

#endif
