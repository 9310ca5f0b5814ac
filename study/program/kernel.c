/* The kernels that the program knows. */
#include "kernel.h"

#include "program/program.h"

/* Euler at N = 1000 has an error of at most 1.3e-3 on the cases, with either slip. */
static const kernel_claim claims_exact[] = {
    {CAROM_SLIP_PAPER, 1000, "reference-exact-paper.csv", 1e-6},
    {CAROM_SLIP_POOLTOOL, 1000, "reference-exact-pooltool.csv", 1e-6},
    {.reference = NULL},
};
static const kernel_claim claims_euler[] = {
    {CAROM_SLIP_POOLTOOL, 1000, "reference-pooltool-n1000.csv", 0.0},
    {CAROM_SLIP_POOLTOOL, 1000, "reference-exact-pooltool.csv", 2e-3},
    {CAROM_SLIP_PAPER, 1000, "reference-exact-paper.csv", 2e-3},
    {.reference = NULL},
};

static const kernel kernels[] = {
    {"exact", "double",
     "the limit of infinitely many steps, by collocation: the physics of the model itself",
     CAROM_SOLVER_EXACT, false, claims_exact},
    {"fast", "double", "the same with single precision inside: in less time, but not smooth",
     CAROM_SOLVER_FAST, false, claims_exact},
    {"euler", "double",
     "Mathavan's N steps of equal normal impulse; with the pooltool slip, pooltool's result to the "
     "last bit",
     CAROM_SOLVER_EULER, false, claims_euler},
/* Rungs are compared with what the paper compared with. */
#define PRECISION_DOUBLE "double"
#define PRECISION_SINGLE "single"
#define RUNG(name, parent, precision, isa, width, bound, paper, over_1e3, over_1e2, idea)     \
  {#name,                                                                                     \
   PRECISION_##precision,                                                                     \
   idea,                                                                                      \
   CAROM_SOLVER_EXACT,                                                                        \
   true,                                                                                      \
   (const kernel_claim[]){{CAROM_SLIP_POOLTOOL, 1000, "reference-pooltool-n1000.csv", bound}, \
                          {.reference = NULL}}},
#include "kernels.def"
#undef RUNG
};

const kernel *kernel_at(size_t k) {
  if (k >= COUNT_OF(kernels))
    return NULL;
  return &kernels[k];
}

const char *config_name(const ladder_module *module) {
  return module != NULL ? module->name : "library";
}

const char *precision_name(bool single) {
  return single ? "single" : "double";
}

const kernel *kernel_find(const char *name) {
  const kernel *candidate;
  for (size_t k = 0; (candidate = kernel_at(k)) != NULL; k++)
    if (same_text(candidate->name, name))
      return candidate;
  return NULL;
}

bool kernel_takes_steps(const kernel *k) {
  return k->is_rung || k->solver == CAROM_SOLVER_EULER;
}

double kernel_bound(double bound, const kernel_claim *claim, int steps) {
  if (bound == 0.0 || steps == claim->steps)
    return bound;
  return 2.0 / steps + bound * fmax(1.0, (double)steps / claim->steps);
}

OPTION_SET(set_kernel) {
  const kernel *candidate = kernel_find(text);
  if (candidate == NULL)
    complain("no %s '%s'; `%s kernels` lists them", row->name, text, program_name);
  else
    *(const kernel **)field = candidate;
  return candidate != NULL;
}

carom_status kernel_resolve(const kernel *k, const ladder_module *module, const carom_impact *in,
                            size_t n, const carom_options *options, carom_result *out,
                            int8_t *status) {
  if (k->is_rung)
    return ladder_resolve_batch(module, ladder_rung_find(k->name), in, n, options, out, status);
  carom_options changed = *options;
  changed.solver = k->solver;
  return carom_collide_batch(in, n, &changed, out, status);
}

carom_status kernel_resolve_f32(const kernel *k, const carom_impact_f32 *in, size_t n,
                                const carom_options *options, carom_result_f32 *out,
                                int8_t *status) {
  carom_options changed = *options;
  changed.solver = k->solver;
  return carom_collide_batch_f32(in, n, &changed, out, status);
}

bool kernel_module(const kernel *k, const char *config, const ladder_module **module) {
  *module = NULL;
  if (!k->is_rung) {
    if (config != NULL)
      complain("--config is for the kernels of the ladder; %s is built into the library in one way",
               k->name);
    return config == NULL;
  }
  if (!ladder_rung_runs(ladder_rung_find(k->name))) {
    complain("%s needs instructions that this processor does not have", k->name);
    return false;
  }
  char why[LADDER_WHY_SIZE];
  *module = ladder_module_find(config != NULL ? config : "default", why);
  if (*module == NULL)
    complain("%s", why);
  return *module != NULL;
}
