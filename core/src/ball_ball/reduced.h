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
 * dp; the collision ends once e^2 of the work of compression has been given back.
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

static inline carom_reduced carom_reduce(const carom_local *c) {
  const double sR = c->s * c->R, u_z = c->R * (c->w_ix + c->w_jx);
  const int on_j = u_z < 0;
  return (carom_reduced){.u_x = c->v_ix - c->v_jx - c->R * (c->w_iz + c->w_jz),
                         .u_z = fabs(u_z),
                         .d_x = on_j ? -(c->v_jx + sR * c->w_jy) : c->v_ix + sR * c->w_iy,
                         .d_y = on_j ? -(c->v_jy - sR * c->w_jx) : c->v_iy - sR * c->w_ix,
                         .v_n = c->v_jy - c->v_iy,
                         .kappa = 1 + (on_j ? c->M_j / c->M_i : c->M_i / c->M_j),
                         .mu = on_j ? c->mu_j : c->mu_i,
                         .mu_b = c->mu_b,
                         .e = c->e,
                         .s = c->s,
                         .rounding = c->rounding,
                         .j_pressed = on_j};
}

/* Adds to *c the change of its velocities by the integrals. */
static inline void carom_restore(const carom_reduced *r, const carom_integrals *g, carom_local *c) {
  const double sign = r->j_pressed ? -1 : 1, ratio = r->kappa - 1, C = 2.5 / c->R;
  const double p_x = sign * (g->F_x - g->Q_1), p_y = sign * (g->F_y - g->p),
               o_x = sign * ratio * g->Q_1, o_y = sign * ratio * g->p;
  const double p_wx = sign * C * (g->F_y - g->Q_2), p_wy = -sign * C * g->F_x,
               o_wx = -sign * C * ratio * g->Q_2;
  const double p_wz = C * g->Q_1, o_wz = ratio * p_wz;
  c->v_ix += r->j_pressed ? o_x : p_x;
  c->v_jx += r->j_pressed ? p_x : o_x;
  c->v_iy += r->j_pressed ? o_y : p_y;
  c->v_jy += r->j_pressed ? p_y : o_y;
  c->w_ix += r->j_pressed ? o_wx : p_wx;
  c->w_jx += r->j_pressed ? p_wx : o_wx;
  c->w_iy += r->j_pressed ? 0 : p_wy;
  c->w_jy += r->j_pressed ? p_wy : 0;
  c->w_iz += r->j_pressed ? o_wz : p_wz;
  c->w_jz += r->j_pressed ? p_wz : o_wz;
}

/* ---- In the terms of contact_law/law.h, for the precise solver: it solves inputs that the fast
 * steps refuse, and follows traces ---- */

static inline carom_law carom_law_of_balls(const carom_reduced *c) {
  return (carom_law){.K_x = 3.5 * c->kappa,
                     .K_y = 2.5 * c->kappa,
                     .C_x = 1,
                     .C_y = 2.5,
                     .B_0 = -1,
                     .L_x = 1,
                     .L_y = -2.5 * c->s,
                     .H = 1 - 2.5 * c->s,
                     .g_1 = -1,
                     .V_0 = -c->kappa,
                     .V_F = 1,
                     .mu = c->mu_b,
                     .mu_c = c->u_z > 0 ? c->mu : 0, /* no ball is pressed into the cloth */
                     .e = c->e};
}

/* Puts a collision at its start; tolerance, plain: see impact.h. */
static inline void carom_precise_begin(const carom_reduced *c, double tolerance, int plain,
                                       carom_trajectory *path) {
  const double per = -1 / c->v_n;
  const carom_law law = carom_law_of_balls(c);
  carom_impact_begin(&law, tolerance, plain, per * c->u_x, per * c->u_z, per * c->d_x, per * c->d_y,
                     per * c->rounding, path);
}

/* The integrals of reduced.h so far. */
static inline carom_integrals carom_precise_integrals(const carom_reduced *c,
                                                      const carom_trajectory *path) {
  const carom_impulses q = carom_impact_impulses(path);
  const double unit = -c->v_n;
  return (carom_integrals){.p = unit * q.p,
                           .Q_1 = -unit * q.f_x,
                           .Q_2 = -unit * q.f_y,
                           .F_x = unit * q.F_x,
                           .F_y = unit * q.F_y};
}

/* The whole collision, at the cost that a call may have. */
static inline carom_status carom_precise(const carom_reduced *c, double tolerance, int plain,
                                         carom_trajectory *path) {
  carom_precise_begin(c, tolerance, plain, path);
  return carom_impact_advance(path, INFINITY, CAROM_IMPACT_ITERATIONS);
}

/* The tolerance of calls: errors of two balls are well below those that carom.h promises. */
static const double CAROM_PRECISE_TOLERANCE = 1e-3;

#endif
