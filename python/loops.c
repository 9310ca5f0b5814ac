#include "loops.h"

void carom_python_mu_ball(const carom_impact *in, size_t n, carom_speed_law law, double *mu) {
  for (size_t k = 0; k < n; k++)
    mu[k] = carom_mu_ball(&in[k], law);
}

carom_status carom_python_shot_at(const carom_shot_ball *balls, int count, const carom_shot *shot, size_t n,
                                  const double *times, carom_ball_state *states) {
  carom_status status = CAROM_OK;
  for (size_t k = 0; k < n && status == CAROM_OK; k++)
    status = carom_shot_at(balls, count, shot, times[k], &states[k * (size_t)count]);
  return status;
}
