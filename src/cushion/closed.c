/* Two closed forms. Neither knows the cloth.
 *
 * HAN. Coulomb's impact of a ball on a rigid point: normal impulse P = (1 + e) v_y cos(theta). The slip at the nose falls by
 * 7/2 of the friction's impulse, whatever its direction, so friction either stops it, f = -2/7 s, or slides to the end, f =
 * -mu_w P s/|s|. The vertical velocity that this gives is dropped. Source: I. Han, J. Mech. Sci. Technol. 19 (2005) 976-984,
 * equations 14 to 23; his x, y are y, -x here.
 *
 * MIRROR. v_y becomes -e v_y. */
#include "cushion/models.h"
#include "platform/elementary.h"

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

carom_status carom_mirror(carom_contact *c) {
  c->v_y *= -c->e;
  return CAROM_OK;
}
