/* The speed law of the friction between the balls. */
#include "support.h"

#include <math.h>

TEST(known_slips) {
  carom_impact in = {.a = {.radius = 0.03}, .b = {.r = {0.0, 0.06, 0.0}, .radius = 0.03}};
  const carom_speed_law law = carom_alciatore();
  ck_assert_double_eq_tol(carom_mu_ball(&in, law), 0.009951 + 0.108, 1e-15); /* no slip */
  /* across the line of centres */
  in.a.v[0] = 3.0;
  ck_assert_double_eq_tol(carom_mu_ball(&in, law), 0.009951 + 0.108 * exp(-1.088 * 3.0), 1e-15);
  in.b.w[0] = 4.0 / 0.03; /* and a surface that rises at 4 m/s: 5 m/s in all */
  ck_assert_double_eq_tol(carom_mu_ball(&in, law), 0.009951 + 0.108 * exp(-1.088 * 5.0), 1e-15);
  in.a.v[1] = 7.0; /* along it: no slip */
  ck_assert_double_eq_tol(carom_mu_ball(&in, law), 0.009951 + 0.108 * exp(-1.088 * 5.0), 1e-15);
  ck_assert_double_eq(carom_mu_ball(&in, (carom_speed_law){0.07, 0.0, 1.0}), 0.07);
  in.a.v[0] = NAN;
  ck_assert(isnan(carom_mu_ball(&in, law)));
  ck_assert(isnan(carom_mu_ball(NULL, law)));
}

TEST(rolling) {
  const double v[3] = {1.4, -0.7, 0.0}, still[3] = {0.0, 0.0, 5.0},
               rolls[3] = {0.7 / 0.03, 1.4 / 0.03, 0.0};
  double end[3];
  carom_rolling_velocity(v, still, 0.03, end);
  ck_assert_double_eq_tol(end[0], 1.0, 1e-15);
  ck_assert_double_eq_tol(end[1], -0.5, 1e-15);
  carom_rolling_velocity(v, rolls, 0.03, end); /* what rolls already goes on */
  for (int k = 0; k < 3; k++)
    ck_assert_double_eq_tol(end[k], v[k], 1e-15);
  double in_place[3] = {rolls[0], rolls[1], rolls[2]};
  carom_rolling_velocity(v, in_place, 0.03, in_place);
  ck_assert_mem_eq(in_place, end, sizeof end);
}
