/* Three closed forms. None knows the cloth.
 *
 * HAN. Coulomb's impact of a ball on a rigid point: normal impulse P = (1 + e) v_y cos(theta).
 * The slip at the nose falls by 7/2 of the friction's impulse, whatever its direction, so
 * friction either stops it, f = -2/7 s, or slides to the end, f = -mu_w P s/|s|. The vertical
 * velocity that this gives is dropped. Source: I. Han, J. Mech. Sci. Technol. 19 (2005) 976-984,
 * equations 14 to 23; his x, y are y, -x here.
 *
 * SMOOTH. Recorded balls pass from sticking to sliding gradually, and the nose returns some of the
 * slip (C > 1). With c = v_y cos(theta) and L = ln(v_y):
 *
 *     e      += e_d d,  d = -s_t / sqrt(s_t^2 + v_y^2)       a ball that rolls rebounds more
 *     F      = 2/7 (C_x s_x, C_t s_t)                        impulse of friction without a limit
 *     rho    = |(F_x, F_t/(1 + a))| / (mu_w P)               the part of friction that this needs
 *     sigma  = (1 + rho^(1/q))^-q                            the part that is done: 1 for small
 *                                                            rho, 1/rho for large
 *     f      = -sigma F
 *     P'     = min(P (1 + k rho sigma), 2 c)                 more rebound where friction ends,
 *              + P (g + g_log L) rho^2/(4 + rho^2)           the slower the more for g_log < 0,
 *              within 0 and c + sqrt(c^2 + 2 D)              and no more than energy allows
 *     D      = sum of s^2/7 sigma C (2 - sigma C)            what friction takes, over the mass
 *
 * q -> 0, C = 1, the others 0 is Han's. Energy never rises: P' and f act at one point where
 * the inverse masses are 1, 7/2 and 7/2, so the energy changes by P'^2/2 - c P' - D, which is
 * not above 0 for 0 <= P' <= c + sqrt(c^2 + 2 D), and D >= 0 for 0 < sigma C <= 2; sigma is at
 * most 1. Dropping the vertical velocity takes energy. The constants were read off one table:
 * docs/reference/constants.md.
 *
 * MIRROR. v_y becomes -e v_y. */
#include "cushion/models.h"
#include "platform/elementary.h"
#include "platform/ranges.h"

#include <stdbool.h>

void carom_apply_han(carom_contact *contact) {
  /* fits by the speed into the cushion, m/s, and by the angle of incidence, rad */
  const double speed = contact->v_y;
  contact->e = carom_limited(0.0, 0.39 + 0.257 * speed - 0.044 * speed * speed);
  const double angle = carom_atan(fabs(contact->v_x) / speed);
  contact->mu_w = carom_limited(0.0, 0.471 - 0.241 * angle);
}

carom_status carom_han(carom_contact *contact) {
  /* friction stops the slip, or slides to the end */
  const double s_x = carom_slip_x(contact), s_t = carom_slip_t(contact);
  const double slip = sqrt(s_x * s_x + s_t * s_t);
  const double P = (1 + contact->e) * (contact->v_y * contact->cosine), most = contact->mu_w * P;
  const double share = slip <= 3.5 * most ? 2.0 / 7.0 : most / slip;
  const carom_impulse impulse = {.P = P, .f_x = -share * s_x, .f_t = -share * s_t};
  carom_push(contact, &impulse);
  return CAROM_OK;
}

void carom_apply_speed(carom_contact *contact, const carom_cushion_options *opt) {
  const double log_speed = contact->log_v;
  if (!carom_absent(opt->restitution_log) || !carom_absent(opt->restitution_log2))
    contact->e = carom_limited(contact->e,
                               contact->e + opt->restitution_log * log_speed +
                                   opt->restitution_log2 * carom_lesser(log_speed * log_speed, 1));
  if (!carom_absent(opt->mu_log))
    contact->mu_w = carom_limited(contact->mu_w, contact->mu_w + opt->mu_log * log_speed);
}

carom_status carom_smooth(carom_contact *contact, const carom_cushion_options *opt) {
  /* the constants of the caller, or those that were measured */
  const bool has_width = opt->smooth_q > 0;
#define NUMBER(member, usual) const double member = opt->member + (has_width ? 0 : (usual));
  CAROM_USUAL_SMOOTH(NUMBER)
#undef NUMBER
  const double q = smooth_q, k = smooth_k, C_x = smooth_x, C_t = smooth_t, a = smooth_a,
               g = smooth_g, g_log = smooth_g_log, e_d = smooth_e;

  /* the slips, and restitution by how far the surface moves down the nose, -1 to 1 */
  const double s_x = carom_slip_x(contact), s_t = carom_slip_t(contact);
  double e = contact->e;
  if (!carom_absent(e_d))
    e = carom_limited(e, e - e_d * s_t / sqrt(s_t * s_t + contact->v_y * contact->v_y));

  /* friction without a limit, and the limit */
  const double once = contact->v_y * contact->cosine, P = (1 + e) * once, most = contact->mu_w * P;
  const double F_x = 2.0 / 7.0 * C_x * s_x, F_t = 2.0 / 7.0 * C_t * s_t;
  const double across = F_t / (1 + a), square = F_x * F_x + across * across, limit = most * most;

  /* sigma, by rho or 1/rho, whichever is below 1 */
  const bool sticks = square < limit;
  const double small = sticks ? square : limit, large = sticks ? limit : square,
               ratio = large > 0 ? small / large : 0, corner = carom_bend(ratio, q);
  double sigma = 0;
  if (sticks)
    sigma = corner;
  else if (square > 0)
    sigma = most / sqrt(square) * corner;

  /* the rebound, the larger the further friction is from sticking; no more than energy allows,
   * which is never less than 2 c */
  double more = P;
  if (!carom_absent(k))
    more = carom_lesser(P * (1 + k * (sticks ? sqrt(ratio) * corner : corner)), 2 * once);
  if (!carom_absent(g) || !carom_absent(g_log)) {
    const double least = 4 * limit;
    const double slides = square + least > 0 ? square / (square + least) : 0;
    more += P * (g + g_log * contact->log_v) * slides;
    if (more > 2 * once) {
      const double D_x = sigma * C_x, D_t = sigma * C_t;
      const double lost = (s_x * s_x * D_x * (2 - D_x) + s_t * s_t * D_t * (2 - D_t)) / 7;
      more = carom_lesser(more, once + sqrt(once * once + 2 * lost));
    }
    more = carom_greater(more, 0);
  }
  const carom_impulse impulse = {.P = more, .f_x = -sigma * F_x, .f_t = -sigma * F_t};
  carom_push(contact, &impulse);
  return CAROM_OK;
}

carom_status carom_mirror(carom_contact *contact) {
  contact->v_y *= -contact->e;
  return CAROM_OK;
}
