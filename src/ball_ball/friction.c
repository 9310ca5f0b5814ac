/* Friction around the collision: that between the balls by the speed of their slip, and what the cloth's makes of a ball
 * afterwards. */
#include "carom.h"
#include "platform/arithmetic.h"

#include "ball_ball/frame.h"
#include "platform/elementary.h"

#include <math.h>

carom_speed_law carom_alciatore(void) {
  return (carom_speed_law){.a = 0.009951, .b = 0.108, .c = 1.088};
}

double carom_mu_ball(const carom_impact *in, carom_speed_law law) {
  if (in == NULL)
    return NAN;
  const carom_frame frame = carom_frame_of(in);
  const carom_local c = carom_to_frame(&frame, in, CAROM_SLIP_PAPER);
  const double u_x = c.v_ix - c.v_jx - c.R * (c.w_iz + c.w_jz);
  const double u_z = c.R * (c.w_ix + c.w_jx);
  return law.a + law.b * carom_exp(-law.c * sqrt(u_x * u_x + u_z * u_z));
}

void carom_rolling_velocity(const double v[3], const double w[3], double radius, double rolling[3]) {
  const double x = (5.0 * v[0] + 2.0 * radius * w[1]) / 7.0; /* first both: `rolling` may be v or w */
  rolling[1] = (5.0 * v[1] - 2.0 * radius * w[0]) / 7.0;
  rolling[0] = x;
  rolling[2] = 0.0;
}
