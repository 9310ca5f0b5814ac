/* Friction between the balls as a function of how fast they slip on each other at first contact. */
#include "carom.h"

#include "frame.h"

#include <math.h>

carom_speed_law carom_alciatore(void) {
  return (carom_speed_law){.a = 0.009951, .b = 0.108, .c = 1.088};
}

double carom_mu_ball(const carom_impact *in, carom_speed_law law) {
  const carom_frame frame = carom_frame_of(in);
  const carom_local c = carom_to_frame(&frame, in, CAROM_SLIP_PAPER);
  const double u_x = c.v_ix - c.v_jx - c.R * (c.w_iz + c.w_jz);
  const double u_z = c.R * (c.w_ix + c.w_jx);
  return law.a + law.b * exp(-law.c * sqrt(u_x * u_x + u_z * u_z));
}
