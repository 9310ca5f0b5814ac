/* The kernels that the program knows: one table, over which resolve, verify, bench and kernels
 * iterate. */
#ifndef CAROM_LAB_KERNEL_H
#define CAROM_LAB_KERNEL_H

#include "carom.h"
#include "ladder.h"
#include "program/options.h"

/* What a kernel must reach on the reference cases, checked by `carom-lab verify`. */
typedef struct kernel_claim {
  carom_slip slip;
  int steps;
  const char *reference; /* a file of data/ */
  double bound;          /* on the largest pair error; 0 requires the same bits in every
                            component */
} kernel_claim;

/* A solver of the library, or a rung of the ladder. */
typedef struct kernel {
  const char *name;
  const char *precision; /* "double" or "single" */
  const char *text;      /* what it is, in a line */
  carom_solver solver;
  bool is_rung;               /* resolved by a module of the ladder; `solver` is then without
                                 meaning */
  const kernel_claim *claims; /* ends with a NULL reference */
} kernel;

/* The kernel of that name, or NULL. */
const kernel *kernel_find(const char *name);

/* The k-th kernel, or NULL behind the last; the first is the default. */
const kernel *kernel_at(size_t k);

/* Whether the kernel takes steps: the rungs and Euler's method do. */
bool kernel_takes_steps(const kernel *k);

/* The claim's bound, for other numbers of steps than the claim's. A kernel that rounds differently
 * may end one step sooner or later, and a step changes a velocity by (1 + e)|v_n|/(2N), at most
 * 2/N of the pair's scale; so the bound is 2/N + bound * max(1, N / claim's N). A bound of 0 stays
 * 0. */
double kernel_bound(double bound, const kernel_claim *claim, int steps);

/* For a `const kernel *`: --kernel, a name in the table. */
OPTION_SET(set_kernel);

/* Resolves n pairs as carom_collide_batch() does. `module` is the build of the ladder to take;
 * NULL for a solver. */
carom_status kernel_resolve(const kernel *k, const ladder_module *module, const carom_impact *in,
                            size_t n, const carom_options *options, carom_result *out,
                            int8_t *status);

/* The same in single precision, for a solver. */
carom_status kernel_resolve_f32(const kernel *k, const carom_impact_f32 *in, size_t n,
                                const carom_options *options, carom_result_f32 *out,
                                int8_t *status);

/* Finds the module for `config` ("o3", "gcc-o3"; NULL for the default) if `k` is a rung.
 * Complains and returns false if there is none, if the rung cannot run here, or if a solver is
 * given a configuration. */
bool kernel_module(const kernel *k, const char *config, const ladder_module **module);

/* The build of the ladder, or the library where it is NULL. */
const char *config_name(const ladder_module *module);

const char *precision_name(bool single);

#endif
