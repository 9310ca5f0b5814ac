/* The collision reduced to five quantities that evolve, instead of ten velocities.
 *
 * Frame: x along the table, y from ball i to ball j, z up; at the contact of the balls the slip
 * is (u_x, u_z). The sign of u_z never changes and decides which ball is pressed into the cloth:
 * i if u_z > 0, j if u_z < 0. The second case is the first seen from the other side: turned by
 * 180 degrees about z with the balls exchanged, u_x stays while u_z and the slip (d_x, d_y) of
 * the pressed ball on the cloth change sign. So let u_z >= 0, and let "pressed" and "other" name
 * the balls. With p = (normal impulse) / M_pressed as the variable, kappa = 1 + M_pressed /
 * M_other, (c, sigma) = (u_x, u_z) / |u|, t = d / |d|, mu the friction of the cloth under the
 * pressed ball, mu_b that between the balls, and s = -1 for the paper's slip over the cloth:
 *
 *     f     = -mu mu_b sigma t                                       friction of the cloth per unit
 *                                                                    p
 *     u_x'  = -7/2 kappa mu_b c + f_x        u_z' = -5/2 kappa mu_b sigma + 5/2 f_y
 *     v_n' = kappa - f_y
 *     d'    = (-mu_b c + (1 - 5/2 s) f_x,  -1 + 5/2 s mu_b sigma + (1 - 5/2 s) f_y)
 *
 * Everything is linear in p, F = int f dp, Q_1 = int mu_b c dp and Q_2 = int mu_b sigma dp:
 *
 *     u_x = u_x0 - 7/2 kappa Q_1 + F_x       u_z = u_z0 - 5/2 kappa Q_2 + 5/2 F_y
 *     v_n = v_n0 + kappa p - F_y
 *     d   = (d_x0 - Q_1 + (1 - 5/2 s) F_x,  d_y0 - p + 5/2 s Q_2 + (1 - 5/2 s) F_y)
 *
 * and with C = 5/2 / R and r = kappa - 1 the velocities change by
 *
 *     pressed:  v (F_x - Q_1, F_y - p)    w C (F_y - Q_2, -F_x, Q_1)       other:  v r (Q_1, p)
 *     w C r (-Q_2, 0, Q_1)
 *
 * which makes the balance of momentum exact. The work of the normal force is M_pressed int |v_n|
 * dp; the collision ends once e^2 of the work of compression has been returned.
 *
 * Source: the 2014 paper named in carom.h; the reduction is derived in
 * docs/understanding/method.md. */
#ifndef CAROM_SRC_BALL_BALL_REDUCED_H
#define CAROM_SRC_BALL_BALL_REDUCED_H

#include "ball_ball/frame.h"
#include "contact_law/impact.h"
#include "platform/arithmetic.h"

typedef struct carom_reduced {
  double u_x, u_z, d_x, d_y, v_n; /* at the start, m/s; u_z >= 0, v_n < 0 */
  double kappa, mu, mu_b, e, s;
  double rounding; /* of frame.h */
  int j_pressed;   /* 1 if the pressed ball is j */
} carom_reduced;

typedef struct carom_integrals {
  double p, Q_1, Q_2, F_x, F_y; /* m/s */
} carom_integrals;

static inline carom_reduced carom_reduce(const carom_local *local) {
  const double sR = local->s * local->R, u_z = local->R * (local->w_ix + local->w_jx);
  const int on_j = u_z < 0;
  return (carom_reduced){
      .u_x = local->v_ix - local->v_jx - local->R * (local->w_iz + local->w_jz),
      .u_z = fabs(u_z),
      .d_x = on_j ? -(local->v_jx + sR * local->w_jy) : local->v_ix + sR * local->w_iy,
      .d_y = on_j ? -(local->v_jy - sR * local->w_jx) : local->v_iy - sR * local->w_ix,
      .v_n = local->v_jy - local->v_iy,
      .kappa = 1 + (on_j ? local->M_j / local->M_i : local->M_i / local->M_j),
      .mu = on_j ? local->mu_j : local->mu_i,
      .mu_b = local->mu_b,
      .e = local->e,
      .s = local->s,
      .rounding = local->rounding,
      .j_pressed = on_j};
}

/* Adds to *local the change of its velocities by the integrals. */
static inline void carom_restore(const carom_reduced *reduced, const carom_integrals *integrals,
                                 carom_local *local) {
  const double sign = reduced->j_pressed ? -1 : 1, ratio = reduced->kappa - 1,
               spin_per_impulse = 2.5 / local->R;
  const double pressed_x = sign * (integrals->F_x - integrals->Q_1),
               pressed_y = sign * (integrals->F_y - integrals->p),
               other_x = sign * ratio * integrals->Q_1, other_y = sign * ratio * integrals->p;
  const double pressed_wx = sign * spin_per_impulse * (integrals->F_y - integrals->Q_2),
               pressed_wy = -sign * spin_per_impulse * integrals->F_x,
               other_wx = -sign * spin_per_impulse * ratio * integrals->Q_2;
  const double pressed_wz = spin_per_impulse * integrals->Q_1, other_wz = ratio * pressed_wz;
  local->v_ix += reduced->j_pressed ? other_x : pressed_x;
  local->v_jx += reduced->j_pressed ? pressed_x : other_x;
  local->v_iy += reduced->j_pressed ? other_y : pressed_y;
  local->v_jy += reduced->j_pressed ? pressed_y : other_y;
  local->w_ix += reduced->j_pressed ? other_wx : pressed_wx;
  local->w_jx += reduced->j_pressed ? pressed_wx : other_wx;
  local->w_iy += reduced->j_pressed ? 0 : pressed_wy;
  local->w_jy += reduced->j_pressed ? pressed_wy : 0;
  local->w_iz += reduced->j_pressed ? other_wz : pressed_wz;
  local->w_jz += reduced->j_pressed ? pressed_wz : other_wz;
}

/* ---- In the terms of contact_law/law.h, for the precise solver: it solves inputs that the fast
 * steps reject, and follows traces ---- */

static inline carom_law carom_law_of_balls(const carom_reduced *reduced) {
  return (carom_law){.K_x = 3.5 * reduced->kappa,
                     .K_y = 2.5 * reduced->kappa,
                     .C_x = 1,
                     .C_y = 2.5,
                     .B_0 = -1,
                     .L_x = 1,
                     .L_y = -2.5 * reduced->s,
                     .H = 1 - 2.5 * reduced->s,
                     .g_1 = -1,
                     .V_0 = -reduced->kappa,
                     .V_F = 1,
                     .mu = reduced->mu_b,
                     .mu_c =
                         reduced->u_z > 0 ? reduced->mu : 0, /* no ball is pressed into the cloth */
                     .e = reduced->e};
}

/* Puts a collision at its start; tolerance, plain: see impact.h. */
static inline void carom_precise_begin(const carom_reduced *reduced, double tolerance, int plain,
                                       carom_trajectory *path) {
  const double per = -1 / reduced->v_n;
  const carom_law law = carom_law_of_balls(reduced);
  carom_impact_begin(&law, tolerance, plain, per * reduced->u_x, per * reduced->u_z,
                     per * reduced->d_x, per * reduced->d_y, per * reduced->rounding, path);
}

/* The integrals of reduced.h so far. */
static inline carom_integrals carom_precise_integrals(const carom_reduced *reduced,
                                                      const carom_trajectory *path) {
  const carom_impulses impulses = carom_impact_impulses(path);
  const double unit = -reduced->v_n;
  return (carom_integrals){.p = unit * impulses.p,
                           .Q_1 = -unit * impulses.f_x,
                           .Q_2 = -unit * impulses.f_y,
                           .F_x = unit * impulses.F_x,
                           .F_y = unit * impulses.F_y};
}

/* The complete collision, at the cost that a call may have. */
static inline carom_status carom_precise(const carom_reduced *reduced, double tolerance, int plain,
                                         carom_trajectory *path) {
  carom_precise_begin(reduced, tolerance, plain, path);
  return carom_impact_advance(path, INFINITY, CAROM_IMPACT_ITERATIONS);
}

/* The tolerance of calls: errors of two balls are well below those that carom.h promises. */
static const double CAROM_PRECISE_TOLERANCE = 1e-3;

#endif
