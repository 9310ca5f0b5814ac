/* A block of collisions on their way between the rows of the caller and the arcs: columns of numbers in single precision. */
#ifndef CAROM_SRC_BATCH_ARC_BLOCK_H
#define CAROM_SRC_BATCH_ARC_BLOCK_H

#include "batch.h"

#include <stddef.h>

enum { ARC_PAIRS = 1024, ARC_WIDEST = 16, ARC_IN = 8, ARC_OUT = 5 };

/* The rows of the next block, brought nearer while this one is being solved: memory is slower than the solver. */
typedef struct carom_fetcher {
  const char *in;
  char *out;
  size_t in_at, in_bytes, out_at, out_bytes;
} carom_fetcher;

/* One collision is one place in each column. Columns may be read and written up to a whole vector beyond the last. */
typedef struct carom_arc_block {
  float in[ARC_IN][ARC_PAIRS + ARC_WIDEST];   /* u_x, u_z, d_x, d_y, kappa, mu, mu_b, e: see `problem` in arcs.h */
  float out[ARC_OUT][ARC_PAIRS + ARC_WIDEST]; /* Q_1, Q_2, F_x, F_y, excess: see `outcome` */
  float good[ARC_PAIRS + ARC_WIDEST];         /* before: 1 if it is to be solved; after: 1 if it was */
  carom_fetcher ahead;
} carom_arc_block;

/* Solves the first n collisions of the block; s is the sign of the spin in the cloth slip, `slack` 1 for errors as double
 * precision wants them, more for larger ones. */
typedef void carom_arcs(carom_arc_block *b, size_t n, float s, float slack);

#define CAROM_ARCS_PROTOTYPE(NAME, suffix) carom_arcs carom_arcs_##suffix;
CAROM_BUILT_ISAS(CAROM_ARCS_PROTOTYPE)
#undef CAROM_ARCS_PROTOTYPE

#endif
