/* Three closed forms. None knows the cloth.
 *
 * HAN. Coulomb's impact of a ball on a rigid point: normal impulse P = (1 + e) v_y cos(theta).
 * The slip at the nose falls by 7/2 of the friction's impulse, whatever its direction, so
 * friction either stops it, f = -2/7 s, or slides to the end, f = -mu_w P s/|s|. The vertical
 * velocity that this gives is dropped. Source: I. Han, J. Mech. Sci. Technol. 19 (2005) 976-984,
 * equations 14 to 23; his x, y are y, -x here.
 *
 * SMOOTH. Recorded balls pass from sticking to sliding gradually, and the nose gives back a part
 * of the slip (C > 1):
 *
 *     F      = 2/7 (C_x s_x, C_t s_t)                        impulse of friction without a limit
 *     rho    = |(F_x, F_t/(1 + a))| / (mu_w P)               the part of friction that this needs
 *     sigma  = (1 + rho^(1/q))^-q                            the part that is done: 1 for small
 *                                                            rho, 1/rho for large
 *     f      = -sigma F
 *     P'     = min(P (1 + k rho sigma), 2 v_y cos(theta))    more rebound where friction is used up
 *
 * q -> 0, C = 1, a = k = 0 is Han's. Energy never rises. Before the vertical velocity is
 * dropped, which takes energy, it changes by P' (P'/2 - v_y cos(theta)) <= 0 through P', and
 * through each part of f by s^2/7 ((sigma C)^2 - 2 sigma C), which is not above 0 for 0 < sigma
 * C <= 2; sigma is at most 1. The constants were read off one table:
 * docs/understanding/constants.md.
 *
 * MIRROR. v_y becomes -e v_y. */
#include "cushion/models.h"
#include "platform/elementary.h"
#include "platform/ranges.h"

#include <stdbool.h>

static double limited(double x) {
  return fmin(fmax(x, 0), 1);
}

void carom_apply_han(carom_contact *c) {
  const double v = c->v_y;
  c->e = limited(0.39 + 0.257 * v - 0.044 * v * v);
  c->mu_w = limited(0.471 - 0.241 * carom_atan(fabs(c->v_x) / v));
}

carom_status carom_han(carom_contact *c) {
  const double s_x = carom_slip_x(c), s_t = carom_slip_t(c), slip = sqrt(s_x * s_x + s_t * s_t);
  const double P = (1 + c->e) * (c->v_y * c->cosine), most = c->mu_w * P;
  const double share = slip <= 3.5 * most ? 2.0 / 7.0 : most / slip;
  const carom_impulse q = {.P = P, .f_x = -share * s_x, .f_t = -share * s_t};
  carom_push(c, &q);
  return CAROM_OK;
}

void carom_apply_speed(carom_contact *c, double restitution_log, double mu_log) {
  if (restitution_log == 0 && mu_log == 0)
    return;
  const double logarithm = carom_log(carom_greater(c->v_y, 0.1));
  c->e = limited(c->e + restitution_log * logarithm);
  c->mu_w = limited(c->mu_w + mu_log * logarithm);
}

carom_status carom_smooth(carom_contact *c, const carom_cushion_options *opt) {
  /* the constants of the caller, or those that were measured */
  const bool own = opt->smooth_q > 0;
  const double q = own ? opt->smooth_q : 0.35, C_x = own ? opt->smooth_x : 1.3,
               C_t = own ? opt->smooth_t : 1.2;
  const double a = own ? opt->smooth_a : 0.13, k = own ? opt->smooth_k : 0.047;

  /* friction without a limit, and the limit */
  const double once = c->v_y * c->cosine, P = (1 + c->e) * once, most = c->mu_w * P;
  const double F_x = 2.0 / 7.0 * C_x * carom_slip_x(c), F_t = 2.0 / 7.0 * C_t * carom_slip_t(c);
  const double across = F_t / (1 + a), wanted = sqrt(F_x * F_x + across * across);

  /* sigma and rho sigma, by rho or 1/rho, whichever is below 1 */
  const bool sticks = wanted < most;
  const double ratio = sticks ? wanted / most : wanted > 0 ? most / wanted : 0;
  const double corner = carom_power(1 + carom_power(ratio, 1 / q), -q);
  const double sigma = sticks ? corner : ratio * corner, used = sticks ? ratio * corner : corner;
  const carom_impulse all = {
      .P = carom_lesser(P * (1 + k * used), 2 * once), .f_x = -sigma * F_x, .f_t = -sigma * F_t};
  carom_push(c, &all);
  return CAROM_OK;
}

carom_status carom_mirror(carom_contact *c) {
  c->v_y *= -c->e;
  return CAROM_OK;
}
