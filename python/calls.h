/* Single calls whose options are plain arguments, for code that Numba compiles: see src/carom/numba.py. Options are the values
 * of the enumerations; what is returned is a carom_status. */
#ifndef CAROM_PYTHON_CALLS_H
#define CAROM_PYTHON_CALLS_H

#include <carom_shot.h>

/* carom_collide() of 26 doubles to 12. */
int32_t carom_python_collide(const double *impact, int32_t solver, int32_t slip, int32_t steps, double *out);

/* carom_mu_ball() of 26 doubles by the law a + b exp(-c |u|). */
double carom_python_mu_ball_one(const double *impact, double a, double b, double c);

/* carom_cushion() of 15 doubles to 6. */
int32_t carom_python_cushion(const double *impact, int32_t model, int32_t convention, int32_t law, int32_t steps,
                             double least_step, double omega_ratio, double *out);

#endif
