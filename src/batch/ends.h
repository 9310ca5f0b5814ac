/* Where an arc leads: to the end of the collision, to stick, or only on.
 *
 * v_n' = κ - f_y, times v_n, is κ d(∫ v_n dp) = d(v_n² / 2 + K) with K = ∫ v_n dF_y. So where the work of the normal force is
 * e² times that of compression,
 *
 *     v_n² = e² κ² + 2 (1 - e²) K_c - 2 K        K_c: K at v_n = 0
 *
 * K is small beside κ², and stationary at v_n = 0, so a rough place of v_n = 0 will do. `excess`, which is v_n² / κ² - e²,
 * is what leaves the arcs: the caller adds it to e² in its own precision, and p = 1 + sqrt(e² + excess) + F_y / κ. An error of
 * the foreseen h is made good on the arc's polynomials. After stick, F and K stay as they are.
 */
#ifndef CAROM_SRC_BATCH_ENDS_H
#define CAROM_SRC_BATCH_ENDS_H

#include "arcs.h"

static const real fade = 3e-6f; /* e⁴ under which the end is found from v_n, not from the work */

/* What an arc comes to. */
typedef struct outcome {
  vreal Q_1, Q_2, F_x, F_y; /* of this arc */
  vreal excess;             /* v_n²/κ² - e² at the end of the collision */
  vreal K_c;                /* K at v_n = 0 */
  vreal h;                  /* if > 0: the arc that should have been tried ends here */
  vmask good;
} outcome;

always void add(outcome *total, const outcome *o, vmask mask) {
  total->Q_1 = v_select(mask, total->Q_1 + o->Q_1, total->Q_1);
  total->Q_2 = v_select(mask, total->Q_2 + o->Q_2, total->Q_2);
  total->F_x = v_select(mask, total->F_x + o->F_x, total->F_x);
  total->F_y = v_select(mask, total->F_y + o->F_y, total->F_y);
  total->excess = v_select(mask, o->excess, total->excess);
  total->K_c = v_select(mask, o->K_c, total->K_c);
  total->good |= mask;
}

/* The weights of the integral from the start of the arc to x, or to λ. */
always void weights_upto(const plan *way, vreal x, vreal *w) {
  const int n = way->n;
  const vreal t = 2 * x - 1, x2 = x * x, x5 = x2 * x2 * x;
  EACH_NODE(j) {
    vreal sum = v_splat(way->r->part[n - 1][j]);
    lanes_unrolled for (int i = n - 2; i >= 0; i--) sum = v_fma(sum, t, v_splat(way->r->part[i][j]));
    w[j] = way->sticks ? way->r->all[j] - sum * x5 : sum * x;
  }
}
always void basis_at(const plan *way, vreal l, vreal *w) {
  const int n = way->n;
  const vreal t = 2 * l - 1;
  EACH_NODE(j) {
    w[j] = v_splat(way->r->basis[n - 1][j]);
    lanes_unrolled for (int i = n - 2; i >= 0; i--) w[j] = v_fma(w[j], t, v_splat(way->r->basis[i][j]));
  }
}

/* How far works decide where the collision ends, and not v_n: all but for e near 0. */
always vreal trust(vreal e) {
  const vreal e4 = square(e * e);
  return e4 * v_reciprocal(e4 + fade);
}

/* v_n²/κ² - e² at the end, if F_y and K stay as they are. For e = 0 the end is where v_n = 0, whatever the works say: their
 * difference, mostly noise there, is faded out. f_y is the mean of cloth friction since v_n = 0. */
always vreal excess_of(const problem *c, vreal K_c, vreal K, vreal f_y) {
  const vreal e2 = c->e * c->e, square_k = c->kappa * c->kappa;
  const vreal A = e2 * (square_k - 2 * K_c), since = (real)0.5 * A * f_y * v_reciprocal(c->kappa);
  const vreal J = since + (K - K_c - since) * trust(c->e);
  return -2 * (e2 * K_c + J) * v_reciprocal(square_k);
}

typedef struct mark {
  vreal p, F_y, K, v_n;
} mark;
always mark mark_of(const problem *c, const vreal *w, const arc *a, const vreal *dK, int n) {
  mark m;
  m.p = dot_of(w, a->dp, n);
  m.F_y = dot_of(w, a->dF_y, n);
  m.K = c->K + dot_of(w, dK, n);
  m.v_n = c->v_n + c->kappa * m.p - m.F_y;
  return m;
}
always void slopes_of_K(const plan *way, const arc *a, const problem *c, vreal *dK) {
  const int n = way->n;
  EACH_NODE(k) dK[k] = (c->v_n + c->kappa * a->P[k] - a->Y[k]) * a->dF_y[k];
}

/* The end of a gauss arc: the state there, what v_n = 0 left if it was passed, and by how much of the arc the end of the
 * collision lies beyond. If that is little, the outcome is that of the end of the collision. */
always vreal arrive_by_arc(const plan *way, const arc *a, const problem *c, real most, outcome *o, mark *m) {
  const int n = way->n;
  const rule *r = way->r;
  vreal w[NODES], dK[NODES];
  slopes_of_K(way, a, c, dK);
  EACH_NODE(k) w[k] = v_splat(r->all[k]);
  *m = mark_of(c, w, a, dK, n);
  const vreal dp = dot(r->last, a->dp, n), ddp = dot(r->bend, a->dp, n), per = v_reciprocal(dp), per_kappa = a->per_kappa;
  const vreal f_y = clamp(dot(r->last, a->dF_y, n) * per, -1, 1), per_slope = v_reciprocal(c->kappa - f_y),
              per_p = v_reciprocal(m->p);
  /* v_n = 0 where p, a parabola in x, is p_c */
  const vreal xi = -c->v_n * per_kappa * per_p, bow = clamp(1 - dp * per_p, -1, 1);
  vreal x =
      clamp(2 * xi * v_reciprocal(1 + bow + v_root(v_max((1 + bow) * (1 + bow) - 4 * bow * xi, NUMBER(1e-12)))), 0, (real)1.1);
  weights_upto(way, x, w);
  mark at_c = mark_of(c, w, a, dK, n);
  if (n > 4) { /* once more, by the slope of the parabola at x */
    const vreal slope = v_max(m->p * (1 + bow - 2 * bow * x), (real)0.2 * m->p);
    x = clamp(x - at_c.v_n * per_slope * v_reciprocal(slope), 0, (real)1.1);
    weights_upto(way, x, w);
    at_c = mark_of(c, w, a, dK, n);
  }
  const vmask passed = v_not(c->seen) & v_less_equal((real)-0.01 * c->kappa * m->p, m->v_n);
  o->K_c = v_select(passed, at_c.K - (real)0.5 * f_y * at_c.v_n * at_c.v_n * per_slope, c->K_c);
  o->excess = excess_of(c, o->K_c, m->K, f_y);
  const vreal v_e = c->kappa * v_root(v_max(c->e * c->e + o->excess, v_splat(TINY)));
  const vreal sure = trust(c->e), straight = (v_e - m->v_n) * v_reciprocal(c->kappa - f_y * (1 - sure));
  /* v_n and K both move on the way there; to first order it makes no difference, this is the second */
  const vreal more = straight * (1 + (real)0.5 * sure * f_y * straight * v_reciprocal(v_max(v_e, NUMBER(0.1))));
  const vreal first = more * per;
  /* reversion of the series of p(x) */
  const vreal b_2 = (real)0.5 * ddp * per, x_0 = clamp(first, (real)-0.1, (real)0.1);
  const vreal b_3 = (real)(1 / 6.0) * dot(r->curl, a->dp, n) * per;
  vreal dx = first * (1 - x_0 * (b_2 - x_0 * (2 * b_2 * b_2 - b_3)));
  const vmask ends = (c->seen | passed) & v_less_equal(v_abs(dx), v_splat(most));
  const vreal beyond = v_select(c->seen | passed, dx, v_splat(1));
  dx = v_select(ends, dx, v_splat(0));
  weights_upto(way, 1 + dx, w);
  /* what the series left of p, to first order */
  const vreal rest = v_select(ends, (m->p + more - dot_of(w, a->dp, n)) * per, v_splat(0));
  const vreal far = a->h * (1 + dx + rest), l = 1 - far, l2 = l * l, l5 = l2 * l2 * l;
  const vreal lost_5 = far * (5 - far * (10 - far * (10 - far * (5 - far)))), lost_7 = lost_5 + l5 * (far * (2 - far));
  o->F_x = dot_of(w, a->dF_x, n) + rest * dot(r->last, a->dF_x, n);
  o->F_y = dot_of(w, a->dF_y, n) + rest * f_y * dp;
  const vreal T = dot_of(w, a->dT, n) + rest * dot(r->last, a->dT, n);
  o->Q_1 = (c->u_x * lost_7 + (l5 * l2) * T + o->F_x) * a->per_35;
  o->Q_2 = (c->u_z * lost_5 + (real)2.5 * o->F_y) * ((real)0.4 * per_kappa);
  o->excess -= (v_e + m->v_n) * (o->F_y - m->F_y) * (per_kappa * per_kappa) * sure; /* K on the way there */
  o->good = ends;
  return beyond;
}

/* The λ at which a share of p is still to come, about: it falls about as λ⁶, here as λ^(16/3). */
always vreal lambda_of_share(vreal share) {
  const vreal fourth = v_root(v_root(clamp(share, (real)1e-6, 1)));
  return v_root(fourth * v_root(fourth));
}

/* The end of a stick arc: the balls stick there, unless the collision ends before. */
always void arrive_stuck(const plan *way, const arc *a, const problem *c, outcome *o) {
  const int n = way->n;
  const rule *r = way->r;
  vreal w[NODES], b[NODES], dK[NODES];
  slopes_of_K(way, a, c, dK);
  EACH_NODE(k) w[k] = v_splat(r->all[k]);
  const mark m = mark_of(c, w, a, dK, n);
  const vreal zero = v_splat(0), per_kappa = a->per_kappa, per_p = v_reciprocal(m.p),
              per_slope = v_reciprocal(c->kappa - m.F_y * per_p);
  o->F_x = dot_of(w, a->dF_x, n);
  o->F_y = m.F_y;
  o->Q_1 = (c->u_x + o->F_x) * a->per_35;
  o->Q_2 = (c->u_z + (real)2.5 * o->F_y) * ((real)0.4 * per_kappa);
  o->K_c = v_select(c->seen, c->K_c, m.K);
  o->good = v_less_equal(zero, m.p);
  o->h = zero;
  vreal f_since = v_splat(0);
  const vmask passed = v_not(c->seen) & v_less(zero, m.v_n);
  if (v_any(passed)) { /* v_n = 0 on the way: Newton's method in λ */
    vreal l = lambda_of_share(m.v_n * v_reciprocal(m.v_n - c->v_n));
    mark at_c;
    vreal f_c = zero;
    for (int again = 0;; again++) {
      weights_upto(way, l, w);
      at_c = mark_of(c, w, a, dK, n);
      basis_at(way, l, b);
      const vreal slope = dot_of(b, a->dp, n);
      const vreal per_way = v_reciprocal(slope);
      f_c = dot_of(b, a->dF_y, n) * per_way;
      if (again == 2)
        break;
      l = clamp(l + at_c.v_n * per_slope * per_way * v_reciprocal(square(l * l)), (real)0.05, 1);
    }
    o->K_c = v_select(passed, at_c.K - (real)0.5 * f_c * at_c.v_n * at_c.v_n * per_slope, o->K_c);
    o->good &= v_not(passed & v_less((real)0.05 * c->kappa, v_abs(at_c.v_n)));
    f_since = v_select(passed, f_c, zero);
  }
  o->excess = excess_of(c, o->K_c, m.K, f_since);
  const vreal v_e2 = square(c->kappa) * (c->e * c->e + o->excess);
  /* The collision ends on the way: a gauss arc will do, which ends about there. */
  const vmask before = v_less(zero, m.v_n) & v_less(v_e2, m.v_n * m.v_n);
  const vreal left = (m.v_n - v_root(v_max(v_e2, v_splat(TINY)))) * per_slope * per_p;
  o->h = v_select(before, 1 - lambda_of_share(left), zero);
  o->good &= v_not(before);
}

/* What is left of a collision after a gauss arc, in the lanes of `mask`. */
always void advance(problem *c, const arc *a, const outcome *o, const mark *m, vmask mask) {
  const real spin = (real)2.5 * c->s;
  const vreal l = 1 - a->h, l2 = l * l;
  const vmask passed = mask & v_not(c->seen) & v_less_equal((real)-0.01 * c->kappa * m->p, m->v_n);
  const vreal d_x = c->d_x - o->Q_1 + (1 - spin) * o->F_x, d_y = c->d_y - m->p + spin * o->Q_2 + (1 - spin) * o->F_y;
  c->K_c = v_select(passed, o->K_c, c->K_c);
  c->seen |= passed;
  c->u_z = v_select(mask, c->u_z * (l2 * l2 * l), c->u_z);
  c->u_x = v_select(mask, c->u_x - ((real)3.5 * c->kappa * o->Q_1 - o->F_x), c->u_x);
  c->d_x = v_select(mask, d_x, c->d_x);
  c->d_y = v_select(mask, d_y, c->d_y);
  c->v_n = v_select(mask, m->v_n, c->v_n);
  c->K = v_select(mask, m->K, c->K);
}

#endif
