/* Two balls for the precise solver of src/impact: reduced.h in the terms of impact/law.h. The fast steps leave to it what they
 * cannot solve, and it follows traces. */
#ifndef CAROM_SRC_BALL_BALL_PRECISE_H
#define CAROM_SRC_BALL_BALL_PRECISE_H

#include "ball_ball/reduced.h"
#include "impact/impact.h"

/* Puts a collision at its start; tolerance: see impact.h. */
static inline void carom_precise_begin(const carom_reduced *c, double tolerance, carom_trajectory *path) {
  const double per = -1 / c->v_n;
  const carom_law law = {.K_x = 3.5 * c->kappa,
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
  carom_impact_begin(&law, tolerance, per * c->u_x, per * c->u_z, per * c->d_x, per * c->d_y, path);
}

/* The integrals of reduced.h so far. */
static inline carom_integrals carom_precise_integrals(const carom_reduced *c, const carom_trajectory *path) {
  const carom_impulses q = carom_impact_impulses(path);
  const double unit = -c->v_n;
  return (carom_integrals){
      .p = unit * q.p, .Q_1 = -unit * q.f_x, .Q_2 = -unit * q.f_y, .F_x = unit * q.F_x, .F_y = unit * q.F_y};
}

/* The whole collision, at the cost that a call may have. */
static inline carom_status carom_precise(const carom_reduced *c, double tolerance, carom_trajectory *path) {
  carom_precise_begin(c, tolerance, path);
  return carom_impact_advance(path, INFINITY, CAROM_IMPACT_ITERATIONS);
}

/* The tolerance of calls: errors of two balls are well below what carom.h promises. */
static const double CAROM_PRECISE_TOLERANCE = 1e-3;

#endif
