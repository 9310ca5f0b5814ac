/* The exact collision in lanes: whole collisions as one arc of collocation.
 *
 * Most collisions are smooth enough in λ (see march.h for the equations) to be one polynomial arc. With the direction
 * τ = t/(κ + μ_s t_y) of the cloth's friction known at the n nodes of an arc, matrices of the rule give W = u_x/λ⁵, p and F
 * there, those the slip d, and d a new τ. Such sweeps gain a factor of about 50 each; they begin with a constant τ. The rules
 * and their use are those of src/exact.c, whose head has the reasons, but here a vector holds LANES collisions and every node
 * has its own vectors:
 *
 *     gauss_2, gauss_4, gauss_6   from λ = 1 to 1 - h, the end of the collision, foreseen within 2 %
 *     stick_4, stick_6            from λ = 1 to 0, where the balls stick
 *
 * An arc is tried where the forecast is good; where what comes out contradicts the forecast (sweeps that go on, coefficients
 * that do not fall, an end elsewhere) the lane is left to the march. A lane whose sweeps have converged is frozen.
 */
#ifndef CAROM_SRC_BATCH_ARCS_H
#define CAROM_SRC_BATCH_ARCS_H

#include "march.h"

enum { NODES = 6 };

#define always static inline __attribute__((always_inline)) /* the constants of a rule must reach the inner loops */

/* What src/exact.c calls a rule; node k is [k / 2][k % 2]. */
typedef double rule_row[NODES / 2][2];
typedef struct rule {
  rule_row node, away, sum[NODES], turn[NODES], all, part[NODES], tail, last, bend, curl;
} rule;
#include "../exact_rules.h"

#define EACH_NODE(k) lanes_unrolled for (int k = 0; k < n; k++)
#define ROW(row, k) ((real)(row)[(k) / 2][(k) % 2])

#ifdef CAROM_LANES_SINGLE
static const real slack = 20; /* of the limits below, which are for double */
#else
static const real slack = 1;
#endif

/* The classes of collisions, in the order in which a block does them. */
enum { COARSE, MIDDLE, FINE, EARLY_STICK, LATE_STICK, MARCHED, CLASSES };

/* The least e of an arc: below it the end is where v_n says, not the work. */
static const real least_e = (real)0.05;

/* Which class a collision is tried in. The limits are those of src/exact.c. */
always vreal class_of(const problem *c, const forecast *f) {
  const vreal pull = c->mu * c->mu_b;
  const vmask mild = v_less(pull, v_splat((real)0.15)) & v_less(c->mu_b, v_splat((real)0.25)) & v_less(v_splat(least_e), c->e) &
                     v_less(v_splat((real)MARCH_NO_FRICTION), c->mu_b) &
                     v_less(v_splat((real)1e-6) * c->mu_b * -c->v_n, c->u_z);
  const vreal room = v_select(f->at_rest, v_splat(100), f->room);
#define BELOW(x, y) v_less(x, v_splat((real)(y)))
#define ABOVE(x, y) v_less(v_splat((real)(y)), x)
  const vmask coarse = mild & BELOW(f->q, 0.1) & BELOW(pull, 0.06) & BELOW(c->mu, 0.55) & ABOVE(c->e, 0.85) & ABOVE(room, 8);
  const vmask middle = mild & BELOW(f->q, 0.45) & ABOVE(room, 2.5);
  const vmask fine = mild & BELOW(f->q, 0.95) & ABOVE(room, 1.5);
  const vmask early = mild & ABOVE(f->q, 8) & ABOVE(room, 2.5);
  const vmask late = mild & ABOVE(f->q, 0.95) & ABOVE(room, 2);
#undef BELOW
#undef ABOVE
  const vreal slips = v_select(coarse, v_splat(COARSE), v_select(middle, v_splat(MIDDLE), v_splat(FINE)));
  const vreal sticks = v_select(early, v_splat(EARLY_STICK), v_splat(LATE_STICK));
  return v_select(fine, slips, v_select(early | late, sticks, v_splat(MARCHED)));
}

/* How an arc is swept. */
typedef struct plan {
  const rule *r;
  int n, most; /* nodes, sweeps at most */
  bool sticks;
  bool bowed; /* p is foreseen as a parabola */
  bool aimed; /* h is corrected once */
} plan;

/* An arc and what a sweep needs at its nodes. */
typedef struct arc {
  vreal h;
  vreal l2[NODES], l5[NODES];
  vreal c_p[NODES], c_F[NODES], c_W[NODES]; /* factors of the slopes of p, F and W */
  vreal damp[NODES];                        /* about the inverse of 1 - (change of W's integral with W) */
  vreal own[NODES]; /* the cloth's own pull on d along τ: it turns nothing; without it sweeps gain more */
  vreal W[NODES], tau_x[NODES], tau_y[NODES], P[NODES];
  vreal dp[NODES], dF_x[NODES], dF_y[NODES], dW[NODES]; /* slopes */
  vreal change;
  vmask left; /* the lanes whose sweeps have not converged; the others are frozen */
} arc;

always vreal dot(const rule_row w, const vreal *v, int n) {
  vreal sum = v_splat(0);
  EACH_NODE(k) sum = v_fma(v_splat(ROW(w, k)), v[k], sum);
  return sum;
}

/* out = the sum over the nodes j of M[j] v_j */
always void apply(const rule_row *M, const vreal *v, vreal *out, int n) {
  EACH_NODE(k) {
    out[k] = ROW(M[0], k) * v[0];
    lanes_unrolled for (int j = 1; j < n; j++) out[k] = v_fma(v_splat(ROW(M[j], k)), v[j], out[k]);
  }
}

/* Nodes, factors and a first W, for τ constant along the arc; to second order in log(λ) on a gauss arc. */
always void lay(const plan *way, arc *a, const problem *c, const forecast *f, vreal h) {
  const int n = way->n;
  const vreal per = 2 * v_reciprocal(c->kappa * c->mu_b + (real)MARCH_NO_FRICTION), c_F = -2 * c->mu * c->u_z;
  const vreal a_0 = 2 * c->mu * (c->u_z * f->tau_x - (real)3.5 * f->tau_y * c->u_x);
  const vreal a_1 = c->mu * (-2 * c->u_z * f->tau_x - (real)3.5 * f->tau_y * a_0);
  a->h = h;
  EACH_NODE(k) {
    if (way->sticks) {
      const real l = ROW(way->r->node, k), l2 = l * l;
      a->l2[k] = v_splat(l2);
      a->l5[k] = v_splat(l2 * l2 * l);
      a->c_p[k] = per; /* the rule holds the λ⁴ itself */
      a->c_F[k] = c_F;
      a->c_W[k] = c->mu;
      a->W[k] = l2 * c->u_x;
      a->damp[k] = v_reciprocal(1 - (real)2.5 * c->mu * f->tau_y * ROW(way->r->away, k));
    } else {
      const vreal x = h * ROW(way->r->node, k), l = 1 - x;
      const vreal log_l = x * (1 + x * ((real)0.5 + (real)(1 / 3.0) * x)); /* its negative */
      const vreal E = (real)3.5 * c->mu * f->tau_y * log_l;
      a->l2[k] = l * l;
      a->l5[k] = a->l2[k] * a->l2[k] * l;
      a->c_p[k] = per * h * (a->l2[k] * a->l2[k]);
      a->c_F[k] = c_F * h * (a->l2[k] * a->l2[k]);
      a->c_W[k] = 2 * h * c->mu * v_reciprocal(a->l2[k] * l);
      a->W[k] = a->l2[k] * (c->u_x - log_l * (a_0 - log_l * a_1));
      a->damp[k] = 1 + E * (1 + E * (1 + E));
    }
    a->tau_x[k] = f->tau_x;
    a->tau_y[k] = f->tau_y;
  }
}

/* A new W from τ and the old W, in the lanes that are left. */
always void renew_slip(const plan *way, arc *a, const problem *c) {
  const int n = way->n;
  vreal change[NODES];
  EACH_NODE(k) a->dW[k] = a->c_W[k] * (c->u_z * a->tau_x[k] - (real)3.5 * a->tau_y[k] * a->W[k]);
  apply(way->r->turn, a->dW, change, n);
  EACH_NODE(k) {
    const vreal W = way->sticks ? a->l2[k] * c->u_x - change[k] : a->l2[k] * (c->u_x - change[k]);
    a->W[k] = v_select(a->left, a->W[k] + a->damp[k] * (W - a->W[k]), a->W[k]);
  }
}

always void slopes_of_p(const plan *way, arc *a, const problem *c) {
  const int n = way->n;
  const vreal u_z2 = c->u_z * c->u_z + (real)MARCH_TINY;
  EACH_NODE(k) {
    a->dp[k] = a->c_p[k] * (1 - c->mu * a->tau_y[k]) * v_root(u_z2 + a->W[k] * a->W[k]);
  }
}

always void slopes_of_F(const plan *way, arc *a) {
  const int n = way->n;
  EACH_NODE(k) {
    a->dF_x[k] = a->c_F[k] * a->tau_x[k];
    a->dF_y[k] = a->c_F[k] * a->tau_y[k];
  }
}

/* New cloth slips from F = (X, Y) and p at the nodes, and from them a new τ in the lanes that are left. */
always void renew_tau(const plan *way, arc *a, const problem *c, const march_law *m, const vreal *X, const vreal *Y) {
  const int n = way->n;
  const vreal base_x = c->d_x - m->per_35 * c->u_x, base_y = c->d_y + m->Z;
  vreal change = v_splat(0);
  EACH_NODE(k) {
    const vreal d_x = base_x + m->X * X[k] + m->per_35 * (a->l5[k] * a->W[k]) - a->own[k] * a->tau_x[k];
    const vreal d_y = base_y + m->Y * Y[k] - m->Z * a->l5[k] - a->P[k] - a->own[k] * a->tau_y[k];
    const vreal size = v_root(d_x * d_x + d_y * d_y + (real)MARCH_TINY);
    const vreal i = v_reciprocal(c->kappa * size + c->mu * d_y), x = d_x * i, y = d_y * i;
    change = v_max(change, v_max(v_abs(x - a->tau_x[k]), v_abs(y - a->tau_y[k])));
    a->tau_x[k] = v_select(a->left, x, a->tau_x[k]);
    a->tau_y[k] = v_select(a->left, y, a->tau_y[k]);
  }
  a->change = v_select(a->left, change, a->change);
}

/* Lays the arc and makes the first sweep. */
always void begin_arc(const plan *way, arc *a, const problem *c, const march_law *m, const forecast *f, vmask mask) {
  const int n = way->n;
  const vreal c_F = (real)-0.4 * c->mu * c->u_z;
  vreal X[NODES], Y[NODES];
  a->change = v_splat(0);
  a->left = mask;
  lay(way, a, c, f, f->x);
  if (way->sticks)
    renew_slip(way, a, c);
  if (!way->bowed)
    slopes_of_p(way, a, c);
  if (way->aimed) {
    const vreal per = v_reciprocal(dot(way->r->last, a->dp, n)), ddp = dot(way->r->bend, a->dp, n);
    const vreal dx = (f->p_f - dot(way->r->all, a->dp, n)) * per;
    lay(way, a, c, f, v_min(a->h * (1 + dx * (1 - (real)0.5 * dx * ddp * per)), v_splat((real)0.7)));
    slopes_of_p(way, a, c);
  }
  const vreal x2 = f->tau_x * f->tau_x, y2 = f->tau_y * f->tau_y;
  const vreal own = c_F * (m->X + (m->Y - m->X) * (x2 * v_reciprocal(x2 + y2 + (real)MARCH_TINY)));
  EACH_NODE(k) {
    const vreal lost = 1 - a->l5[k];
    a->own[k] = own * lost;
    X[k] = c_F * f->tau_x * lost;
    Y[k] = c_F * f->tau_y * lost;
  }
  if (way->bowed) {
    const vreal bow = (real)0.5 * (f->q - f->z) * (1 + (real)0.5 * (f->q - f->z));
    EACH_NODE(k) a->P[k] = f->p_f * ROW(way->r->node, k) * (1 + bow * (1 - ROW(way->r->node, k)));
  } else
    apply(way->r->sum, a->dp, a->P, n);
  renew_tau(way, a, c, m, X, Y);
}

/* One more sweep of the lanes that are left. */
always void sweep(const plan *way, arc *a, const problem *c, const march_law *m, vreal enough) {
  const int n = way->n;
  vreal P[NODES], X[NODES], Y[NODES];
  renew_slip(way, a, c);
  slopes_of_p(way, a, c);
  slopes_of_F(way, a);
  apply(way->r->sum, a->dp, P, n);
  apply(way->r->sum, a->dF_x, X, n);
  apply(way->r->sum, a->dF_y, Y, n);
  EACH_NODE(k) a->P[k] = v_select(a->left, P[k], a->P[k]);
  renew_tau(way, a, c, m, X, Y);
  a->left &= v_less_equal(enough, a->change);
}

/* The weights of the integral from the start of the arc to x (gauss). */
always void weights_upto(const plan *way, vreal x, vreal *w) {
  const int n = way->n;
  EACH_NODE(j) {
    vreal sum = v_splat(ROW(way->r->part[n - 1], j));
    lanes_unrolled for (int i = n - 2; i >= 0; i--) sum = v_fma(sum, x, v_splat(ROW(way->r->part[i], j)));
    w[j] = sum * x;
  }
}

always vreal mix(const vreal *w, const vreal *v, int n) {
  vreal sum = w[0] * v[0];
  lanes_unrolled for (int k = 1; k < n; k++) sum = v_fma(w[k], v[k], sum);
  return sum;
}

always vreal clamp(vreal x, real low, real high) {
  return v_min(v_max(x, v_splat(low)), v_splat(high));
}

/* The collision ends near the end of a gauss arc: where, is found by Taylor series. */
always void arrive_by_arc(const plan *way, const arc *a, const problem *c, outcome *o) {
  const int n = way->n;
  const rule *r = way->r;
  vreal w[NODES], H[NODES];
  EACH_NODE(k) H[k] = a->P[k] * a->dF_y[k];
  const vreal p = dot(r->all, a->dp, n), F_y = dot(r->all, a->dF_y, n);
  const vreal dp = dot(r->last, a->dp, n), ddp = dot(r->bend, a->dp, n), per = 1 / dp;
  const vreal slope = c->kappa - dot(r->last, a->dF_y, n) * per, per_slope = 1 / slope;
  const vreal v_n = c->v_n + c->kappa * p - F_y;
  const vreal S = (c->v_n + (real)0.5 * c->kappa * p - F_y) * p + dot(r->all, H, n);
  /* v_n = 0 where p, a parabola in x, is -v_n0 / κ */
  const vreal i_p = 1 / p, xi = v_min(-c->v_n / (c->kappa * p), v_splat((real)1.1)), bow = clamp(1 - dp * i_p, -1, 1);
  vreal x = 2 * xi / (1 + bow + v_sqrt(v_max((1 + bow) * (1 + bow) - 4 * bow * xi, v_splat(0))));
  weights_upto(way, x, w);
  vreal p_c = mix(w, a->dp, n), F_c = mix(w, a->dF_y, n), v_c = c->v_n + c->kappa * p_c - F_c;
  if (n > 2) {
    x = clamp(x - v_c * per_slope / (p * v_max(1 + bow - 2 * bow * x, v_splat((real)0.1))), 0, (real)1.1);
    weights_upto(way, x, w);
    p_c = mix(w, a->dp, n);
    F_c = mix(w, a->dF_y, n);
    v_c = c->v_n + c->kappa * p_c - F_c;
  }
  const vreal S_min = (c->v_n + (real)0.5 * c->kappa * p_c - F_c) * p_c + mix(w, H, n) - (real)0.5 * v_c * v_c * per_slope;
  const vreal more = to_go(v_n, slope, S, S_min, c->e * c->e), first = more * per;
  /* reversion of the series of p(x) */
  const vreal b_2 = (real)0.5 * ddp * per, x_0 = clamp(first, (real)-0.1, (real)0.1);
  const vreal b_3 = n > 2 ? (real)(1 / 6.0) * dot(r->curl, a->dp, n) * per : v_splat(0);
  const vreal dx = first * (1 - x_0 * (b_2 - x_0 * (2 * b_2 * b_2 - b_3)));
  const vreal half = (real)0.5 * dx * dx, sixth = (real)(1 / 3.0) * dx * half;
  EACH_NODE(k) {
    w[k] = v_fma(dx, v_splat(ROW(r->last, k)), v_fma(half, v_splat(ROW(r->bend, k)), v_splat(ROW(r->all, k))));
    if (n > 2)
      w[k] = v_fma(sixth, v_splat(ROW(r->curl, k)), w[k]);
  }
  const vreal l = 1 - a->h * (1 + dx), l2 = l * l, l5 = l2 * l2 * l;
  o->p = p + more;
  o->F_x = mix(w, a->dF_x, n);
  o->F_y = mix(w, a->dF_y, n);
  o->u_z = c->u_z * l5;
  o->u_x = l5 * l2 * (c->u_x - mix(w, a->dW, n));
  o->good &= v_less_equal(v_abs(dx), v_splat((real)0.02)) & v_less_equal((real)-0.01 * c->kappa * p, v_n);
}

/* A quantity on a stick arc as a polynomial of λ: with v its slope over λ⁴ at the nodes and k its coefficients, the integral
 * from λ to 0 is λ⁵ Σ k_i λ^i, and the interpolant of v is Σ (5 + i) k_i λ^i. */
always void coefficients(const plan *way, const vreal *v, vreal *k) {
  const int n = way->n;
  EACH_NODE(i) k[i] = dot(way->r->part[i], v, n);
}
always vreal remainder_at(const vreal *k, vreal l, vreal l5, int n) {
  vreal sum = k[n - 1];
  lanes_unrolled for (int i = n - 2; i >= 0; i--) sum = v_fma(sum, l, k[i]);
  return sum * l5;
}
always vreal interpolant_at(const vreal *k, vreal l, int n) {
  vreal sum = (real)(n + 4) * k[n - 1];
  lanes_unrolled for (int i = n - 2; i >= 0; i--) sum = v_fma(sum, l, (real)(5 + i) * k[i]);
  return sum;
}

/* The λ at which a share of p is still to come, about: it falls as λ⁶. */
always vreal lambda_of_share(vreal share) {
  const vreal fourth = v_sqrt(v_sqrt(clamp(share, (real)1e-6, 1)));
  return v_sqrt(fourth * v_sqrt(fourth));
}

/* The balls stick at the end of a stick arc, unless the collision ends before. */
always void arrive_stuck(const plan *way, const arc *a, const problem *c, outcome *o) {
  const int n = way->n;
  const rule *r = way->r;
  const vreal e2 = c->e * c->e, zero = v_splat(0);
  vreal slope_H[NODES];
  EACH_NODE(k) slope_H[k] = a->P[k] * a->dF_y[k];
  const vreal p = dot(r->all, a->dp, n), F_y = dot(r->all, a->dF_y, n), H = dot(r->all, slope_H, n);
  const vreal v_n = c->v_n + c->kappa * p - F_y;
  const vreal S = (c->v_n + (real)0.5 * c->kappa * p - F_y) * p + H;
  vreal S_min = S - (real)0.5 * v_n * v_n * v_reciprocal(c->kappa);
  o->F_x = dot(r->all, a->dF_x, n);
  o->F_y = F_y;
  o->u_x = zero;
  o->u_z = zero;
  const vmask passed = v_less(zero, v_n) & o->good;
  if (v_any(passed)) { /* v_n = 0 on the way: Newton's method in λ */
    const vreal per_slope = v_reciprocal(c->kappa - F_y * v_reciprocal(p));
    vreal k_p[NODES], k_F[NODES], k_H[NODES], p_l, F_l, H_l, v_l;
    coefficients(way, a->dp, k_p);
    coefficients(way, a->dF_y, k_F);
    coefficients(way, slope_H, k_H);
    vreal l = lambda_of_share(v_n / (v_n - c->v_n));
    for (int again = 0;; again++) {
      const vreal l4 = l * l * (l * l), l5 = l4 * l;
      p_l = p - remainder_at(k_p, l, l5, n);
      F_l = F_y - remainder_at(k_F, l, l5, n);
      H_l = H - remainder_at(k_H, l, l5, n);
      v_l = c->v_n + c->kappa * p_l - F_l;
      if (again == 3)
        break;
      l = clamp(l + v_l * per_slope * v_reciprocal(l4 * interpolant_at(k_p, l, n)), (real)0.05, 1);
    }
    const vreal least = (c->v_n + (real)0.5 * c->kappa * p_l - F_l) * p_l + H_l - (real)0.5 * v_l * v_l * per_slope;
    S_min = v_select(passed, least, S_min);
    o->good &= v_not(passed & v_less((real)0.05 * v_abs(c->v_n), v_abs(v_l)));
    o->good &= v_not(passed & v_less((1 - e2) * S_min, S)); /* the end comes first */
  }
  o->p = p + to_go(v_n, c->kappa, S, S_min, e2);
}

/* Do the polynomials of the arc fit? Their highest coefficients measure what they leave out; what an error of F costs grows
 * with the pull of the cloth, one of p counts through `weight_p`. */
always vmask fits(const plan *way, const arc *a, vreal pull, vreal limit, vreal weight_p, vreal limit_p) {
  const int n = way->n;
  const vreal F = v_abs(dot(way->r->tail, a->dF_x, n)) + v_abs(dot(way->r->tail, a->dF_y, n)),
              p = v_abs(dot(way->r->tail, a->dp, n));
  return v_less(F * (pull + (real)0.003), limit) & v_less(p * weight_p, limit_p);
}

/* What an arc may leave: a change in its last sweep, coefficients of F and p. */
typedef struct limits {
  real change, F, p;
} limits;

/* Two vectors abreast, as in the march. */
always void arcs(const plan *way, const limits *most, const problem *const c[ABREAST], const vmask mask[ABREAST], real s,
                 outcome o[ABREAST]) {
  const int n = way->n;
  forecast f[ABREAST];
  march_law m[ABREAST];
  vreal enough[ABREAST];
  arc a[ABREAST];
  EACH(w, b) {
    f[b] = foresee(c[b], s);
    m[b] = law_of(c[b], s);
    const vreal feel = way->sticks ? f[b].pull : f[b].pull + (real)0.2 * c[b]->mu * f[b].z;
    enough[b] = slack * (real)2e-8 * v_reciprocal((feel + (real)1e-15) * (feel + (real)0.003));
    if (way->sticks)
      enough[b] *= f[b].q;
  }
  EACH(w, b) begin_arc(way, &a[b], c[b], &m[b], &f[b], mask[b]);
  for (int k = 1; k < way->most; k++) {
    bool any = false;
    EACH(w, b) any |= v_any(a[b].left);
    if (!any)
      break;
    EACH(w, b) sweep(way, &a[b], c[b], &m[b], enough[b]);
  }
  EACH(w, b) {
    a[b].left = mask[b];
    renew_slip(way, &a[b], c[b]);
    slopes_of_p(way, &a[b], c[b]);
    slopes_of_F(way, &a[b]);
  }
  EACH(w, b) {
    const vreal change = slack * most->change * (way->sticks ? f[b].q : v_splat(1));
    o[b].good = mask[b] & v_less(a[b].change * f[b].pull, change);
    if (n > 2)
      o[b].good &= fits(way, &a[b], f[b].pull, slack * most->F * m[b].unit, way->sticks ? f[b].pull : c[b]->mu_b,
                        slack * most->p * m[b].unit);
    if (way->sticks)
      arrive_stuck(way, &a[b], c[b], &o[b]);
    else
      arrive_by_arc(way, &a[b], c[b], &o[b]);
  }
}

/* The collisions of two vectors, all of one class. The lanes that turn out not to belong to it are not good. */
always void solve_class(int class, const problem *const c[ABREAST], const vmask mask[ABREAST], real s, outcome o[ABREAST]) {
  static const plan way[MARCHED] = {
      [COARSE] = {.r = &gauss_2, .n = 2, .most = 4, .bowed = true},
      [MIDDLE] = {.r = &gauss_4, .n = 4, .most = 6, .bowed = true},
      [FINE] = {.r = &gauss_6, .n = 6, .most = 8, .aimed = true},
      [EARLY_STICK] = {.r = &stick_4, .n = 4, .most = 6, .sticks = true},
      [LATE_STICK] = {.r = &stick_6, .n = 6, .most = 8, .sticks = true},
  };
  static const limits most[MARCHED] = {
      [COARSE] = {(real)3e-6, 0, 0},
      [MIDDLE] = {(real)3e-6, (real)3e-6, (real)3e-4},
      [FINE] = {(real)1e-5, (real)1e-6, (real)2e-5},
      [EARLY_STICK] = {(real)3e-6, (real)4e-6, (real)4e-4},
      [LATE_STICK] = {(real)1e-5, (real)2e-6, (real)5e-4},
  };
  arcs(&way[class], &most[class], c, mask, s, o);
}

#endif
