/* Loops over single calls, for the Python package: one crossing of the language for many. */
#ifndef CAROM_PYTHON_LOOPS_H
#define CAROM_PYTHON_LOOPS_H

#include <carom_shot.h>

/* mu[k] = carom_mu_ball(&in[k], law), k = 0 ... n - 1. */
void carom_python_mu_ball(const carom_impact *in, size_t n, carom_speed_law law, double *mu);

/* The states of all balls at n times: those of time k go to states[k * count ...]. Returns what carom_shot_at() does; stops at
 * the first error. */
carom_status carom_python_shot_at(const carom_shot_ball *balls, int count, const carom_shot *shot, size_t n,
                                  const double *times, carom_ball_state *states);

#endif
