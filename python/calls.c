#include "calls.h"

#include <string.h>

/* Arrays of doubles become the structs by a copy, which compilers leave out: no struct is read through a pointer to another
 * type. */
_Static_assert(sizeof(carom_impact) == 26 * sizeof(double) && sizeof(carom_result) == 12 * sizeof(double), "rows of doubles");
_Static_assert(sizeof(carom_cushion_impact) == 15 * sizeof(double) && sizeof(carom_motion) == 6 * sizeof(double),
               "rows of doubles");

int32_t carom_python_collide(const double *impact, int32_t solver, int32_t slip, int32_t steps, double *out) {
  carom_impact in;
  carom_result result;
  carom_options options = {.solver = (carom_solver)solver, .slip = (carom_slip)slip, .steps = steps};
  memcpy(&in, impact, sizeof in);
  carom_status status = carom_collide(&in, &options, &result);
  memcpy(out, &result, sizeof result);
  return status;
}

double carom_python_mu_ball_one(const double *impact, double a, double b, double c) {
  carom_impact in;
  memcpy(&in, impact, sizeof in);
  return carom_mu_ball(&in, (carom_speed_law){a, b, c});
}

int32_t carom_python_cushion(const double *impact, int32_t model, int32_t convention, int32_t law, int32_t steps,
                             double least_step, double omega_ratio, double *out) {
  carom_cushion_impact in;
  carom_motion motion;
  carom_cushion_options options = {.model = (carom_cushion_model)model,
                                   .convention = (carom_cushion_convention)convention,
                                   .law = (carom_cushion_law)law,
                                   .steps = steps,
                                   .least_step = least_step,
                                   .omega_ratio = omega_ratio};
  memcpy(&in, impact, sizeof in);
  carom_status status = carom_cushion(&in, &options, &motion);
  memcpy(out, &motion, sizeof motion);
  return status;
}
