/* The kernels that the command knows. */
#include "kernel.h"

#include <string.h>

/* claims_NAME for each NAME of CAROM_SOLVER_LIST.
 * Euler at N = 1000 errs by at most 1.3e-3 on the cases, with either slip. */
static const kernel_claim claims_EULER[] = {
    {CAROM_SLIP_POOLTOOL, 1000, "reference-pooltool-n1000.csv", 0.0},
    {CAROM_SLIP_POOLTOOL, 1000, "reference-exact-pooltool.csv", 2e-3},
    {CAROM_SLIP_PAPER, 1000, "reference-exact-paper.csv", 2e-3},
    {.reference = NULL},
};

static const kernel kernels[] = {
#define ROW(NAME, name, text) {name, "double", text, CAROM_SOLVER_##NAME, claims_##NAME},
    CAROM_SOLVER_LIST(ROW)
#undef ROW
};

const kernel *kernel_at(size_t k) {
  return k < sizeof kernels / sizeof kernels[0] ? &kernels[k] : NULL;
}

const kernel *kernel_find(const char *name) {
  const kernel *one;
  for (size_t k = 0; (one = kernel_at(k)) != NULL; k++)
    if (strcmp(one->name, name) == 0)
      return one;
  return NULL;
}

carom_status kernel_resolve(const kernel *k, const carom_impact *in, size_t n, const carom_options *options, carom_result *out,
                            uint8_t *status) {
  carom_options own = *options;
  own.solver = k->solver;
  return carom_collide_batch(in, n, &own, out, status);
}
