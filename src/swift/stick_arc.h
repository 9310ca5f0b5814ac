/* An arc to where the balls stick: lambda with u_z = u_z0 lambda^5 from 1 to 0, as exact.c has it, 4 or 8 nodes.
 *
 * At the nodes stand tau = t / (kappa + mu t_y) and W = u_x / lambda^5. A sweep takes them to the integrals
 *
 *     p = 2 / (kappa mu_b) int lambda^4 sqrt(u_z0^2 + W^2) (1 - mu tau_y)          F = -2 mu u_z0 int lambda^4 tau
 *     W = lambda^2 (u_x0 - int 2 mu (u_z0 tau_x - 7/2 tau_y W) / lambda^3)
 *
 * from each node up to 1, these to d, and d to a new tau. All integrals are of the old tau and W, so that the chain is that of
 * d alone; 1 / (kappa + mu t_y) follows by one step of Newton's method a sweep. Where the balls stick, what friction has done
 * follows from u = 0 and F, and only F is felt; where the collision ends before, the polynomials tell lambda there, and W. */
#ifndef CAROM_SRC_SWIFT_STICK_ARC_H
#define CAROM_SRC_SWIFT_STICK_ARC_H

#include "law.h"

/* Of n quads of nodes. part, basis: coefficients of Chebyshev polynomials of 2 lambda - 1, of the integrals from lambda to 0
 * over lambda^5 and of the interpolation; tail: the highest coefficient of the interpolation */
typedef struct stick_rule {
  const quad *node, *away, *sum, *turn, *all, *part, *basis, *tail;
} stick_rule;

enum { QUADS = 2 };

typedef struct stick_arc {
  quad tau_x[QUADS], tau_y[QUADS], W[QUADS]; /* at the nodes */
  quad slope[QUADS];                         /* of p, over lambda^4 and per_p */
  quad work[QUADS];                          /* and of int v_n dF_y */
  quad l2[QUADS], damp[QUADS];               /* lambda^2; about the inverse of 1 - (change of W's integral with W) */
  float per_p, per_F;                        /* factors of the integrals */
  quad all;                                  /* integrals of slope, tau_x, tau_y, work over the arc */
  int sweeps, settled;
} stick_arc;

static const float STICK_ENOUGH = 1e-6f; /* last change of F, over the approach, and by that of |u|: the next is a thirtieth */
static const float LEAST_SLIP = 3e-7f;   /* and of u_x */
enum { STICK_SWEEPS = 8 };

/* sqrt(a^2 + b^2); *i: about its inverse */
always quad root_of_squares(float a, quad b, quad *i) {
  const quad square = a * a + b * b + NOTHING;
  *i = rough_inverse_root(square);
  return (square * *i) * finer(square, *i);
}
/* How far W is from what it should be, given tau. */
always void lag_of_W(const law *m, const glance *g, const stick_rule *r, int n, const stick_arc *q, quad *lag) {
  quad slope[QUADS], turned[QUADS];
  for (int k = 0; k < n; k++)
    slope[k] = m->mu * (g->u_z * q->tau_x[k] - (3.5f * q->tau_y[k]) * q->W[k]);
  apply(r->turn, slope, turned, n);
  for (int k = 0; k < n; k++)
    lag[k] = (q->l2[k] * g->u_x - turned[k]) - q->W[k];
}

/* The integrals over the arc, given p and F_y at its nodes. */
always void sum_up(const law *m, const glance *g, const stick_rule *r, int n, const quad *p, const quad *F_y, stick_arc *q) {
  for (int k = 0; k < n; k++)
    q->work[k] = (q->per_F * q->tau_y[k]) * (g->v + (m->kappa * q->per_p) * p[k] - F_y[k]);
  q->all = dots(r->all, q->slope, q->tau_x, q->tau_y, q->work, n);
}

/* `p_s`: about where the balls stick. */
always void run_stick_arc(const law *m, const glance *g, const stick_rule *r, int n, float p_s, stick_arc *q) {
  const float mu = m->mu, per = m->per, on = 1 - m->spin, per_p = 2 * per / m->mu_b, per_F = -2 * mu * g->u_z;
  quad l5[QUADS], h[QUADS], speed[QUADS], inverse[QUADS], p[QUADS], F_y[QUADS];
  for (int k = 0; k < n; k++) {
    const quad l = r->node[k], l2 = l * l, l4 = l2 * l2, way = p_s * (1 - l4 * l2);
    q->l2[k] = l2;
    l5[k] = l4 * l;
    const quad f_x = g->d_x - (m->mu_b * g->c) * way, f_y = g->d_y + (m->spin * m->mu_b * g->z - 1) * way;
    const quad f_i = rough_inverse_root(f_x * f_x + f_y * f_y + NOTHING), t_y = f_y * f_i, D = m->kappa + mu * t_y;
    h[k] = per - (mu * per * per) * t_y;
    h[k] = h[k] * (2 - D * h[k]);
    h[k] = h[k] * (2 - D * h[k]);
    q->tau_x[k] = (f_x * f_i) * h[k];
    q->tau_y[k] = t_y * h[k];
    /* W for this tau all the way: A + (u_x0 - A) lambda^(2 - b) */
    const quad b = (7 * mu) * q->tau_y[k], A = (2 * mu * g->u_z) * q->tau_x[k] / (b - 2);
    q->W[k] = A + (g->u_x - A) * (l2 * rough_exp(b * r->away[k]));
    q->damp[k] = 1 / (1 - (2.5f * mu * q->tau_y[k]) * r->away[k]);
    speed[k] = root_of_squares(g->u_z, q->W[k], &inverse[k]);
  }
  const quad limit = all4(STICK_ENOUGH * m->unit);
  quad moved;
  q->sweeps = 0;
  do {
    quad X[QUADS], slope[QUADS], lag[QUADS];
    for (int k = 0; k < n; k++)
      slope[k] = speed[k] * (1 - mu * q->tau_y[k]);
    lag_of_W(m, g, r, n, q, lag);
    apply(r->sum, q->tau_x, X, n);
    apply(r->sum, q->tau_y, F_y, n);
    apply(r->sum, slope, p, n);
    for (int k = 0; k < n; k++) {
      const quad F_x = per_F * X[k];
      F_y[k] = per_F * F_y[k];
      const quad step = q->damp[k] * lag[k];
      q->W[k] += step;
      const quad d_x = g->d_x - (g->u_x - l5[k] * q->W[k] + F_x) * (per / 3.5f) + on * F_x,
                 d_y = g->d_y - per_p * p[k] + (m->spin * 0.4f * per) * (g->u_z * (1 - l5[k]) + 2.5f * F_y[k]) + on * F_y[k];
      const quad d2 = d_x * d_x + d_y * d_y + NOTHING, rough = rough_inverse_root(d2), i = rough * finer(d2, rough);
      const quad t_x = d_x * i, t_y = d_y * i;
      h[k] = h[k] * (2 - (m->kappa + mu * t_y) * h[k]);
      const quad tau_x = t_x * h[k], tau_y = t_y * h[k],
                 by = size4(tau_x - q->tau_x[k]) + size4(tau_y - q->tau_y[k]) + (size4(step) * inverse[k]) * l5[k];
      moved = k ? larger4(moved, by) : by;
      q->tau_x[k] = tau_x;
      q->tau_y[k] = tau_y;
      speed[k] = root_of_squares(g->u_z, q->W[k], &inverse[k]);
    }
    q->sweeps++;
    q->settled = !any4((mu * g->u_z) * moved > limit);
  } while (q->sweeps < 2 || (!q->settled && q->sweeps < STICK_SWEEPS));
  q->per_p = per_p;
  q->per_F = per_F;
  for (int k = 0; k < n; k++)
    q->slope[k] = speed[k] * (1 - mu * q->tau_y[k]);
  sum_up(m, g, r, n, p, F_y, q);
}

/* tau has been settled by its effect, which near stick W has little part in: now W, and what follows from it, for
 * one who needs it. Returns the highest coefficient of the slope of p, in units of p, or infinity. */
always float settle_W(const law *m, const glance *g, const stick_rule *r, int n, stick_arc *q) {
  const quad limit = all4(LEAST_SLIP * m->unit);
  int again = 1;
  for (int count = 0; again && count < STICK_SWEEPS; count++) {
    quad lag[QUADS], most = all4(0);
    lag_of_W(m, g, r, n, q, lag);
    for (int k = 0; k < n; k++) {
      const quad step = q->damp[k] * lag[k], l4 = q->l2[k] * q->l2[k];
      q->W[k] += step;
      most = larger4(most, size4(step) * l4);
    }
    again = any4(most > limit);
  }
  quad p[QUADS], F_y[QUADS];
  for (int k = 0; k < n; k++) {
    quad inverse;
    q->slope[k] = root_of_squares(g->u_z, q->W[k], &inverse) * (1 - m->mu * q->tau_y[k]);
  }
  apply(r->sum, q->slope, p, n);
  apply(r->sum, q->tau_y, F_y, n);
  for (int k = 0; k < n; k++)
    F_y[k] = q->per_F * F_y[k];
  sum_up(m, g, r, n, p, F_y, q);
  const quad tail = dots(r->tail, q->slope, q->slope, q->slope, q->slope, n);
  return again ? HUGE_VALF : q->per_p * fabsf(tail[0]);
}

/* At lambda = l: the integrals from there to 0, the slope of the first, the weights of interpolation. */
typedef struct stick_place {
  quad rest;
  float slope;
  quad basis[QUADS];
} stick_place;

always stick_place stand_at(const stick_rule *r, int n, const stick_arc *q, float l) {
  stick_place at;
  const float y = 2 * l - 1, T_2 = 2 * y * y - 1, T_3 = 2 * y * T_2 - y, T_4 = 2 * T_2 * T_2 - 1, T_5 = 2 * T_2 * T_3 - y,
              T_6 = 2 * T_3 * T_3 - 1, T_7 = 2 * T_3 * T_4 - y;
  const float T[8] = {1, y, T_2, T_3, T_4, T_5, T_6, T_7};
  quad part[QUADS];
  for (int k = 0; k < n; k++) {
    part[k] = r->part[k];
    at.basis[k] = r->basis[k];
    for (int j = 1; j < 4 * n; j++) {
      part[k] += T[j] * r->part[j * n + k];
      at.basis[k] += T[j] * r->basis[j * n + k];
    }
  }
  const float l4 = (l * l) * (l * l);
  at.rest = (l4 * l) * dots(part, q->slope, q->tau_x, q->tau_y, q->work, n);
  at.slope = l4 * dots(at.basis, q->slope, q->slope, q->slope, q->slope, n)[0];
  return at;
}
/* lambda where of the integrals what is left of the first, and `weight` times that of tau_y, is `rest`. That falls nearly as a
 * power of lambda, which is found on the way. */
always float lambda_where(const stick_rule *r, int n, const stick_arc *q, float power, float weight, float rest, int steps) {
  const float share = rest / (q->all[0] + weight * q->all[2]);
  if (!(share > 0))
    return 0;
  float l = at_most(powf(share, 1 / power), 1);
  for (int k = 0; k < steps; k++) {
    const stick_place at = stand_at(r, n, q, l);
    const float left = at.rest[0] + weight * at.rest[2], off = rest / left - 1, inverse = left / (l * at.slope);
    if (!(left > 0 && at.slope > 0)) /* next to lambda = 0, where both are noise */
      break;
    l *= fabsf(off) < 0.2f ? 1 + off * inverse * (1 + 0.5f * off * (inverse - 1)) : powf(1 + off, inverse);
    l = at_most(l, 1);
  }
  return l;
}

#endif
