/* The kernels that the command knows: one table, over which resolve, verify and kernels iterate. */
#ifndef CAROM_CLI_KERNEL_H
#define CAROM_CLI_KERNEL_H

#include "carom.h"

/* What a kernel must reach on the reference cases, checked by `carom verify`. */
typedef struct kernel_claim {
  carom_slip slip;
  int steps;
  const char *reference; /* a file of data/ */
  double bound;          /* on the largest pair error; 0 asks for the same bits in every component */
} kernel_claim;

typedef struct kernel kernel;
struct kernel {
  const char *name;
  const char *precision; /* "double" or "single" */
  const char *text;      /* what it is, in a line */
  carom_solver solver;
  const kernel_claim *claims; /* ends with a NULL reference */
};

/* The kernel of that name, or NULL. */
const kernel *kernel_find(const char *name);

/* The k-th kernel, or NULL behind the last; the first is the default. */
const kernel *kernel_at(size_t k);

/* Resolves n pairs as carom_collide_batch() does. */
carom_status kernel_resolve(const kernel *k, const carom_impact *in, size_t n, const carom_options *options, carom_result *out,
                            uint8_t *status);

#endif
