/* Arcs in lanes: a stretch of a collision, or the whole of it, by collocation.
 *
 * The equations, the turned frame in which u_z >= 0, and the variable λ, which runs from 1 towards 0 where the balls stick, are
 * those at the head of src/exact.c, but for two things. Velocities are in units of |v_n| / κ at the start, so that a collision
 * without friction ends at p = 1 + e. And the unknown beside τ is T, with
 *
 *     W = u_x / λ⁵ = λ² (u_x0 - T)        dT = -2 μ (u_z0 τ_x - 7/2 τ_y W) / λ³  dλ
 *
 * THE METHOD. An arc is a stretch of λ, scaled to start at 1, with 2, 4 or 6 nodes. A sweep takes τ at all nodes at once to T,
 * p, F and d there, by fixed matrices, and d to a new τ. Sweeps gain a factor of about 50 each. Two kinds of rule: gauss, from
 * 1 to 1 - h, Gauss-Legendre nodes; stick, from 1 to 0, nodes for the weight λ⁴, the 1 / λ³ of T integrated exactly.
 *
 * PRECISION. All this is in single precision, whatever the caller's. Friction is a small part of the impulse, and its rounding
 * about 1e-8 of the speeds; what is large, the normal impulse and the velocities before, stays outside (exact_lanes.c).
 *
 * LANES. Every lane is a collision and every node has its own vectors. A lane whose sweeps have converged is frozen, so what it
 * yields does not depend on its neighbours.
 */
#ifndef CAROM_SRC_BATCH_ARCS_H
#define CAROM_SRC_BATCH_ARCS_H

#include "lanes.h"

enum { NODES = 6 };

#define always static inline __attribute__((always_inline)) /* the constants of a rule must reach the inner loops */

/* A rule on an arc. x runs from 0 to 1 along a gauss arc; on a stick arc the node is λ itself. Row j of a matrix belongs to the
 * slope at node j. */
typedef struct rule {
  real node[NODES], away[NODES];              /* the nodes; -log(node) of a stick rule */
  real sum[NODES][NODES], turn[NODES][NODES]; /* integrals up to each node: of p and F, and of T */
  real all[NODES];                            /* the integral over the arc */
  real part[NODES][NODES]; /* the integral up to x, over x, or from λ down, over λ⁵: in powers of 2 x - 1 */
  real tail[NODES];        /* highest coefficient of the interpolant, scaled to a largest weight of 1 */
  real last[NODES], bend[NODES], curl[NODES]; /* gauss: value, first and second derivative of the interpolant at x = 1 */
  real basis[NODES][NODES];                   /* stick: the interpolant at λ, in powers of 2 λ - 1 */
} rule;
#include "arc_rules.h"

#define EACH_NODE(k) lanes_unrolled for (int k = 0; k < n; k++)

/* The sum over the nodes of w v, and out = the sum over the nodes j of M[j] v_j. */
always vreal dot_of(const vreal *w, const vreal *v, int n) {
  vreal sum = w[0] * v[0];
  lanes_unrolled for (int k = 1; k < n; k++) sum = v_fma(w[k], v[k], sum);
  return sum;
}
always vreal dot(const real *w, const vreal *v, int n) {
  vreal sum = w[0] * v[0];
  lanes_unrolled for (int k = 1; k < n; k++) sum = v_fma(v_splat(w[k]), v[k], sum);
  return sum;
}
always void apply(const real (*M)[NODES], const vreal *v, vreal *out, int n) {
  EACH_NODE(k) {
    out[k] = M[0][k] * v[0];
    lanes_unrolled for (int j = 1; j < n; j++) out[k] = v_fma(v_splat(M[j][k]), v[j], out[k]);
  }
}

#define NUMBER(x) v_splat((real)(x))
#define TINY ((real)1e-36)
static const real least_change = 1e-6f; /* of τ, that rounding lets a sweep see */
static const real least_slip = 3e-7f;   /* change of Q_1 that makes no odds */

/* What a collision is, or the rest of one, in units of |v_n| / κ at its start. */
typedef struct problem {
  vreal u_x, u_z; /* slip between the balls, u_z >= 0 */
  vreal d_x, d_y; /* slip of the pressed ball over the cloth */
  vreal kappa, mu, mu_b, e;
  vreal v_n, K; /* -κ and 0 at the start of the collision */
  vreal K_c;    /* K at v_n = 0, */
  vmask seen;   /* if that is past */
  real s;       /* -1: the paper's cloth slip */
  real slack;   /* 1, or how many times larger errors may be */
} problem;

/* What lies within `reach` (an impulse). */
typedef struct forecast {
  vreal q, z;         /* shares of |u| and of λ lost on the way, to first order */
  vreal p_f;          /* the impulse at the end */
  vreal tau_x, tau_y; /* τ half way */
  vreal g_x, g_y;     /* rate of the cloth slip, but for cloth friction */
  vreal pull;         /* |f| at the start */
} forecast;

always vreal square(vreal x) {
  return x * x;
}
always vreal clamp(vreal x, real low, real high) {
  return v_min(v_max(x, v_splat(low)), v_splat(high));
}

always forecast foresee(const problem *c, vreal reach) {
  forecast f;
  const vreal mid_y = c->d_y - (real)0.5 * reach, r = v_reciprocal_sqrt(c->d_x * c->d_x + mid_y * mid_y + TINY);
  const vreal t_x = c->d_x * r, t_y = mid_y * r, D = c->kappa + c->mu * t_y, per_D = v_reciprocal(D);
  const vreal u_2 = c->u_x * c->u_x + c->u_z * c->u_z + TINY;
  const vreal i = v_reciprocal_sqrt(u_2);
  const vreal cosine = c->u_x * i, sigma = c->u_z * i;
  f.g_x = -c->mu_b * cosine;
  f.g_y = (real)2.5 * c->s * c->mu_b * sigma - 1;
  f.pull = c->mu * c->mu_b * sigma;
  f.tau_x = t_x * per_D;
  f.tau_y = t_y * per_D;
  const vreal back = f.pull * f.tau_y;
  f.p_f = reach * (1 - back * (1 - back));
  const vreal rate = (real)3.5 * c->kappa * cosine * cosine + sigma * ((real)2.5 * D * sigma + c->mu * cosine * t_x);
  const vreal scaled = c->mu_b * f.p_f * i;
  f.q = rate * scaled;
  f.z = (real)0.5 * D * scaled;
  return f;
}

/* 1 - (1 - q)^(z/q), the share of λ lost on the way: for q up to 0.4, and for any. */
always vreal power_share(vreal q, vreal z) {
  return z * (1 + (q - z) * ((real)0.5 + (2 * q - z) * ((real)(1 / 6.0) +
                                                        (3 * q - z) * ((real)(1 / 24.0) + (4 * q - z) * (real)(1 / 120.0)))));
}
always vreal share_of_lambda(vreal q, vreal z) {
  const vmask near = v_less(q, NUMBER(0.4));
  const vreal less = 1 - v_root(v_root(v_root(v_max(1 - q, NUMBER(1e-6)))));
  return power_share(v_select(near, q, less), v_select(near, z, 8 * z * less * v_reciprocal(v_max(q, NUMBER(0.1)))));
}

/* How a class of arcs is done. */
typedef struct plan {
  const rule *r;
  int n, most; /* nodes, sweeps at most */
  bool sticks;
  bool aimed; /* h is corrected once */
} plan;

/* An arc and what a sweep needs at its nodes. */
typedef struct arc {
  vreal h;
  vreal l2[NODES], l5[NODES];               /* λ², λ⁵ */
  vreal lost_5[NODES], lost_7[NODES];       /* 1 - λ⁵, 1 - λ⁷ */
  vreal c_p[NODES], c_F[NODES], c_T[NODES]; /* factors of the slopes of p, F and T */
  vreal damp[NODES];                        /* about the inverse of 1 - (change of W's integral with W) */
  vreal own[NODES]; /* the cloth's own pull on d along τ: it turns nothing; without it sweeps gain more */
  vreal T[NODES], W[NODES], tau_x[NODES], tau_y[NODES], P[NODES], X[NODES], Y[NODES];
  vreal dp[NODES], dF_x[NODES], dF_y[NODES], dT[NODES]; /* slopes */
  vreal per_kappa, per_35, on_x, on_y, on_z;
  vreal change;
  vmask left; /* the lanes whose sweeps have not converged; the others are frozen */
} arc;

/* Factors and a first T, for τ constant along the arc; to second order in log(λ) on a gauss arc. */
always void lay(const plan *way, arc *a, const problem *c, const forecast *f) {
  const int n = way->n;
  const vreal per = 2 * a->per_kappa * v_reciprocal(c->mu_b), c_F = -2 * c->mu * c->u_z;
  const vreal a_0 = 2 * c->mu * (c->u_z * f->tau_x - (real)3.5 * f->tau_y * c->u_x);
  const vreal a_1 = c->mu * (-2 * c->u_z * f->tau_x - (real)3.5 * f->tau_y * a_0);
  EACH_NODE(k) {
    const vreal x = way->sticks ? v_splat(1 - way->r->node[k]) : a->h * way->r->node[k], l = 1 - x;
    a->l2[k] = l * l;
    a->l5[k] = a->l2[k] * a->l2[k] * l;
    a->lost_5[k] = x * (5 - x * (10 - x * (10 - x * (5 - x))));
    a->lost_7[k] = a->lost_5[k] + a->l5[k] * (x * (2 - x));
    if (way->sticks) { /* the rule holds the λ⁴ itself, and the 1/λ³ of T */
      a->c_p[k] = per;
      a->c_F[k] = c_F;
      a->c_T[k] = c->mu;
      a->T[k] = v_splat(0);
      a->damp[k] = v_reciprocal(1 - v_min((real)2.5 * c->mu * f->tau_y * way->r->away[k], NUMBER(0.35)));
    } else {
      const vreal log_l = x * (1 + x * ((real)0.5 + (real)(1 / 3.0) * x)); /* its negative */
      const vreal E = (real)3.5 * c->mu * f->tau_y * log_l, weight = a->h * (a->l2[k] * a->l2[k]);
      a->c_p[k] = per * weight;
      a->c_F[k] = c_F * weight;
      a->c_T[k] = 2 * c->mu * a->h * v_reciprocal(a->l2[k] * l);
      a->T[k] = log_l * (a_0 - log_l * a_1);
      a->damp[k] = 1 + E * (1 + E * (1 + E));
    }
    a->W[k] = a->l2[k] * (c->u_x - a->T[k]);
    a->tau_x[k] = f->tau_x;
    a->tau_y[k] = f->tau_y;
  }
}

always void slopes_of_T(const plan *way, arc *a, const problem *c) {
  const int n = way->n;
  EACH_NODE(k) a->dT[k] = a->c_T[k] * (c->u_z * a->tau_x[k] - (real)3.5 * (a->tau_y[k] * a->W[k]));
}
/* A new T and W from τ and the old ones, and how far that moved Q_1, of which T is a part. */
always vreal renew_slip(const plan *way, arc *a, const problem *c) {
  const int n = way->n;
  vreal T[NODES], moved = v_splat(0);
  slopes_of_T(way, a, c);
  apply(way->r->turn, a->dT, T, n);
  EACH_NODE(k) {
    const vreal step = a->damp[k] * (T[k] - a->T[k]);
    a->T[k] = v_select(a->left, a->T[k] + step, a->T[k]);
    a->W[k] = a->l2[k] * (c->u_x - a->T[k]);
    moved = v_max(moved, v_abs(step) * (a->l2[k] * a->l5[k]));
  }
  return moved * a->per_35;
}
always void slopes_of_p(const plan *way, arc *a, const problem *c) {
  const int n = way->n;
  const vreal u_z2 = c->u_z * c->u_z + TINY;
  EACH_NODE(k) a->dp[k] = a->c_p[k] * (1 - c->mu * a->tau_y[k]) * v_root(v_fma(a->W[k], a->W[k], u_z2));
}
always void slopes_of_F(const plan *way, arc *a) {
  const int n = way->n;
  EACH_NODE(k) {
    a->dF_x[k] = a->c_F[k] * a->tau_x[k];
    a->dF_y[k] = a->c_F[k] * a->tau_y[k];
  }
}

/* New cloth slips from T, P and X, Y = F at the nodes, and from them a new τ. */
always void renew_tau(const plan *way, arc *a, const problem *c) {
  const int n = way->n;
  vreal change = v_splat(0);
  EACH_NODE(k) {
    const vreal slid = c->u_x * a->lost_7[k] + (a->l2[k] * a->l5[k]) * a->T[k];
    const vreal d_x = c->d_x + a->on_x * a->X[k] - a->per_35 * slid - a->own[k] * a->tau_x[k];
    const vreal d_y = c->d_y + a->on_y * a->Y[k] + a->on_z * a->lost_5[k] - a->P[k] - a->own[k] * a->tau_y[k];
    const vreal size = v_root(d_x * d_x + d_y * d_y + TINY);
    const vreal i = v_reciprocal(c->kappa * size + c->mu * d_y + TINY), x = d_x * i, y = d_y * i;
    change = v_max(change, v_max(v_abs(x - a->tau_x[k]), v_abs(y - a->tau_y[k])));
    a->tau_x[k] = v_select(a->left, x, a->tau_x[k]);
    a->tau_y[k] = v_select(a->left, y, a->tau_y[k]);
  }
  a->change = v_select(a->left, change, a->change);
}

/* One more sweep of the lanes that are left. */
always void sweep(const plan *way, arc *a, const problem *c) {
  const int n = way->n;
  vreal P[NODES], Y[NODES];
  renew_slip(way, a, c);
  slopes_of_p(way, a, c);
  slopes_of_F(way, a);
  apply(way->r->sum, a->dp, P, n);
  apply(way->r->sum, a->dF_x, a->X, n);
  apply(way->r->sum, a->dF_y, Y, n);
  EACH_NODE(k) {
    a->P[k] = v_select(a->left, P[k], a->P[k]);
    a->Y[k] = v_select(a->left, Y[k], a->Y[k]);
  }
  renew_tau(way, a, c);
}

/* Lays the arc from the start of *c in the lanes of `mask`, of length h if it is a gauss arc, corrected to end about at p = aim
 * where aim > 0, and makes the first sweep. */
always void begin_arc(const plan *way, arc *a, const problem *c, const forecast *f, vreal h, vreal aim, vmask mask) {
  const int n = way->n;
  const real spin = (real)2.5 * c->s;
  a->per_kappa = v_reciprocal(c->kappa);
  a->per_35 = a->per_kappa * (real)(1 / 3.5);
  a->on_x = 1 - spin - a->per_35;
  a->on_y = 1 - spin + spin * a->per_kappa;
  a->on_z = spin * (real)0.4 * a->per_kappa * c->u_z;
  a->h = h;
  a->change = v_splat(0);
  a->left = mask;
  if (way->aimed) {
    lay(way, a, c, f);
    slopes_of_p(way, a, c);
    const vreal p = dot(way->r->all, a->dp, n), per = v_reciprocal(dot(way->r->last, a->dp, n));
    const vreal dx = clamp((aim - p) * per, (real)-0.4, (real)0.4),
                longer = h * (1 + dx * (1 - (real)0.5 * dx * dot(way->r->bend, a->dp, n) * per));
    a->h = v_select(v_less(v_splat(0), aim), v_min(v_max(longer, (real)0.3 * h), NUMBER(0.8)), h);
  }
  lay(way, a, c, f);
  const vreal x2 = f->tau_x * f->tau_x, y2 = f->tau_y * f->tau_y, c_F = (real)-0.4 * c->mu * c->u_z;
  const vreal along = a->on_x + (a->on_y - a->on_x) * (x2 * v_reciprocal(x2 + y2 + TINY));
  /* With the pooltool sign and strong friction, d without its own pull might change its direction. */
  const vmask reverses = v_less(NUMBER(0.15), c->mu * c->mu_b * (spin > 0 ? (real)1 : (real)0));
  const vreal own = v_select(reverses, v_splat(0), c_F * along);
  EACH_NODE(k) {
    a->own[k] = own * a->lost_5[k];
    a->X[k] = c_F * f->tau_x * a->lost_5[k];
    a->Y[k] = c_F * f->tau_y * a->lost_5[k];
  }
  if (way->sticks)
    renew_slip(way, a, c);
  slopes_of_p(way, a, c);
  apply(way->r->sum, a->dp, a->P, n);
  renew_tau(way, a, c);
}

/* All that a sweep left behind once more, from the last τ. Where the cloth pulls little, τ has converged before T. */
always void close_arc(const plan *way, arc *a, const problem *c, vmask mask) {
  vreal last = v_splat((real)INFINITY);
  a->left = mask;
  for (int k = 0; k < 6 && v_any(a->left); k++) {
    const vreal moved = renew_slip(way, a, c);
    a->left &= v_less(v_splat(least_slip), moved) & v_less(moved, (real)0.5 * last);
    last = moved;
  }
  slopes_of_p(way, a, c);
  slopes_of_F(way, a);
  slopes_of_T(way, a, c);
}

/* The arcs of `abreast` vectors, swept until τ changes by less than `enough`. Vectors keep each other from waiting: the next
 * operation of one seldom needs the last of the other. */
#define EACH_VECTOR(b) lanes_rolled for (int b = 0; b < abreast; b++)
enum { MOST_ABREAST = 2 };
always void run_arcs(const plan *way, int abreast, arc *a, const problem *c, const forecast *f, const vreal *h,
                     const vreal *aim, const vreal *enough, const vmask *mask) {
  EACH_VECTOR(b) begin_arc(way, &a[b], &c[b], &f[b], h[b], aim[b], mask[b]);
  for (int k = 1; k < way->most; k++) {
    bool any = false;
    EACH_VECTOR(b) {
      a[b].left &= v_less(enough[b], a[b].change);
      any |= v_any(a[b].left);
    }
    if (!any)
      break;
    EACH_VECTOR(b) sweep(way, &a[b], &c[b]);
  }
  EACH_VECTOR(b) close_arc(way, &a[b], &c[b], mask[b]);
}

/* Do the polynomials of the arc fit? The sum without its last node would differ by so much; what that costs was measured. */
always vmask fits(const plan *way, const arc *a, real limit, vreal weight_p, real limit_p) {
  const int n = way->n;
  const real scale = way->r->all[n - 1] / way->r->tail[n - 1];
  const vreal F = v_abs(dot(way->r->tail, a->dF_x, n)) + v_abs(dot(way->r->tail, a->dF_y, n)),
              p = v_abs(dot(way->r->tail, a->dp, n));
  return v_less(v_abs(scale * F), v_splat(limit)) & v_less(v_abs(scale * p) * weight_p, v_splat(limit_p));
}

#endif
