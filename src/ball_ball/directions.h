/* Collocation in the normal impulse: the directions of both slips at the nodes of a stretch of the collision.
 *
 * THE EQUATIONS are those of reduced.h. With X from 0 to 1 along the stretch, L its length in p, c = u_x / |u|,
 * sigma = u_z / |u| and s = sigma t, the slips are linear in the integrals C, Z, S_x, S_y of c, sigma, s_x, s_y over X:
 *
 *     u_x = u_x0 - 7/2 kappa mu_b L C - mu mu_b L S_x        u_z = u_z0 - 5/2 kappa mu_b L Z - 5/2 mu mu_b L S_y
 *     d_x = d_x0 - mu_b L C - (1 - 5/2 s) mu mu_b L S_x      d_y = d_y0 - L X + 5/2 s mu_b L Z - (1 - 5/2 s) mu mu_b L S_y
 *
 * THE PREDICTOR turns u by a series to third order, for a t that turns evenly, and lets d run with the means of the directions
 * so far.
 *
 * THE ITERATION takes the directions at the nodes through the integration matrix to the slips there, and these to new
 * directions. What the cloth does converges by itself, since mu mu_b is small. What u does to its own direction is damped: the
 * new direction is mixed with the old one, by a share of the diagonal that the derivative of the equations has. */
#ifndef CAROM_SRC_BALL_BALL_DIRECTIONS_H
#define CAROM_SRC_BALL_BALL_DIRECTIONS_H

#include "ball_ball/problem.h"

/* What an iteration leaves of what it moved, at least; by mu mu_b, for the cloth; by q^2, for u. */
static const float CONTRACTION = 0.02f, CONTRACTION_CLOTH = 1.2f, CONTRACTION_Q = 0.24f;
/* Of the old direction, over the diagonal of the derivative; for 4 nodes, which are for small q, and for 8. */
static const float KEEP_4 = 0.25f, KEEP_8 = 0.15f;

/* Where the nodes lie: X, and X' for those of a rule in another variable. */
typedef struct mesh {
  reg X[MOST_REGS], weight[MOST_REGS];
} mesh;

/* Coefficients of the equations, times L; and q, the share of |u| that the stretch loses at its first rate. */
typedef struct step_law {
  vreal length, mu_b, pull, pull_y, on_d, on_y, k_x, k_z, k_y, q;
} step_law;

always step_law law_of(const problem *a, const prediction *g, vreal length) {
  step_law l = {.length = length, .mu_b = a->mu_b * length, .pull = a->pull * length, .pull_y = a->pull_y * length};
  l.on_d = (a->spin - 1) * l.pull;
  l.on_y = a->spin * l.mu_b;
  l.k_x = -3.5f * (a->kappa * l.mu_b);
  l.k_z = -2.5f * (a->kappa * l.mu_b);
  l.k_y = -2.5f * l.pull;
  l.q = g->rate * length;
  return l;
}

/* At the nodes, times their weight: s and both ways in which u has turned away from its direction at first, the sine of the
 * angle and 1 - its cosine. Without weight: the directions, and the integral of s_y up to there. */
typedef struct directions {
  reg c[MOST_REGS], z[MOST_REGS], s_x[MOST_REGS], s_y[MOST_REGS];
  reg w_x[MOST_REGS], w_y[MOST_REGS], turned[MOST_REGS], lost[MOST_REGS], S_y[MOST_REGS];
  vreal moved; /* at most, by the last iteration */
} directions;

/* The angle w by which u turns on the way to X: powers of x = X / (1 - alpha X), which has its logarithm built in, and what a
 * turning t adds. */
typedef struct turning {
  vreal alpha, w_1, w_2, w_3, by_t;
} turning;

always turning predict_turning(bool turn, const problem *a, const prediction *g, const state *s, vreal b) {
  const vreal A = 3.5f * a->kappa, B = 2.5f * v_fma(a->mu, g->t_y, a->kappa), E = a->mu * g->t_x;
  const vreal c2 = g->c * g->c, z2 = g->z * g->z, cs = g->c * g->z, D = A - B;
  /* the derivative of the angle and its derivatives, over -b */
  const vreal f_0 = g->z * v_fma(D, g->c, E * g->z), f_1 = v_fma(D, c2 - z2, 2 * E * cs),
              f_2 = v_fma(3 * E, c2 - z2, -6 * cs * D);
  const vreal h = v_fma(A, c2, v_fma(E, cs, B * z2)), both = f_1 + h; /* h: |u|', over -mu_b */
  const vreal W_1 = -b * f_0, W_2 = 0.5f * b * W_1 * both;
  const vreal W_3 = (b * b) * W_1 * (1 / 6.0f) * v_fma(both, v_fma(v_splat(2), h, f_1), f_0 * f_2);
  turning w = {.alpha = 0.5f * b * h, .w_1 = W_1, .by_t = v_splat(0)};
  w.w_2 = v_fma(-w.alpha, W_1, W_2);
  w.w_3 = v_fma(w.alpha, v_fma(w.alpha, W_1, -2 * W_2), W_3);
  if (!turn) {
    const vreal i_d = v_rough_reciprocal_sqrt(v_fma(s->d_x, s->d_x, v_fma(s->d_y, s->d_y, v_splat(1e-12f))));
    const vreal half_x = v_fma(-s->d_x, i_d, g->t_x), half_y = v_fma(-s->d_y, i_d, g->t_y);
    w.by_t = v_select(is_at_rest(a, s), w.by_t, b * g->z * a->mu * v_fma(2.5f * half_y, g->c, -half_x * g->z));
  }
  return w;
}

/* turn: d turns on the way and has no direction half way, and the nodes have weights. */
always void find_directions(int n, int iterations, bool turn, const gauss_rule *r, const problem *a, const prediction *g,
                            const state *s, const step_law *l, const mesh *m, directions *f) {
  const vreal b = l->mu_b * g->inverse_u;
  const turning turns = predict_turning(turn, a, g, s, b);
  /* the cloth's own pull on d, along its direction half way */
  const vreal own = turn ? v_splat(0) : l->on_d * g->z, own_x = own * g->t_x, own_y = l->length - own * g->t_y;
  const vreal damp = (n == 8 ? KEEP_8 : KEEP_4) * a->kappa * b * v_fma(g->z, g->z, v_splat(2.5f));
  const vreal half_b = 0.5f * l->mu_b, half_y = 0.5f * l->on_y;
  reg keep[MOST_REGS], take[MOST_REGS], straight_y[MOST_REGS], moved[MOST_REGS] = {0};
  const vreal no_x = -l->pull, no_b = -l->mu_b;
  EACH_REG(k, n) {
    const reg X = m->X[k], x = X * rough_reciprocal(MADD(-turns.alpha, X, 1.0f));
    const reg w = MADD(x, MADD(x, MADD(x, turns.w_3, turns.w_2), turns.w_1), turns.by_t * (X * (X - 1))), w2 = (0.5f * w) * w;
    f->c[k] = MADD(-g->c, w2, MADD(g->z, w, g->c));
    f->z[k] = MADD(-g->z, w2, MADD(-g->c, w, g->z));
    const reg d_x = MADD(-X, MADD(half_b, g->c + f->c[k], -own_x), s->d_x);
    const reg d_y = MADD(-X, MADD(-half_y, g->z + f->z[k], own_y), s->d_y);
    const reg sigma_d = f->z[k] * rough_reciprocal_sqrt(MADD(d_x, d_x, MADD(d_y, d_y, TINY)));
    f->s_x[k] = sigma_d * d_x;
    f->s_y[k] = sigma_d * d_y;
    const reg back = damp * X;
    keep[k] = back * rough_reciprocal(MADD(-l->q, X, 1.0f) + back);
    take[k] = 1 - keep[k];
    straight_y[k] = MADD(-l->length, X, s->d_y);
    f->turned[k] = f->lost[k] = SPREAD(0.0f);
  }

  lanes_rolled for (int i = 0; i < iterations; i++) {
    reg w_c[MOST_REGS], w_z[MOST_REGS], C[MOST_REGS], Z[MOST_REGS], S_x[MOST_REGS];
    EACH_REG(k, n) {
      w_c[k] = turn ? m->weight[k] * f->c[k] : f->c[k];
      w_z[k] = turn ? m->weight[k] * f->z[k] : f->z[k];
      f->w_x[k] = turn ? m->weight[k] * f->s_x[k] : f->s_x[k];
      f->w_y[k] = turn ? m->weight[k] * f->s_y[k] : f->s_y[k];
    }
    apply(r->sum, w_c, C, n);
    apply(r->sum, w_z, Z, n);
    apply(r->sum, f->w_x, S_x, n);
    apply(r->sum, f->w_y, f->S_y, n);
    const bool last = i == iterations - 1;
    EACH_REG(k, n) {
      const reg du_x = MADD(l->k_x, C[k], no_x * S_x[k]), du_z = MADD(l->k_z, Z[k], l->k_y * f->S_y[k]);
      const reg u_x = s->u_x + du_x, u_z = s->u_z + du_z;
      const reg d_x = MADD(l->on_d, S_x[k], MADD(no_b, C[k], s->d_x)),
                d_y = MADD(l->on_d, f->S_y[k], MADD(l->on_y, Z[k], straight_y[k]));
      const reg i_u = reg_reciprocal_sqrt(MADD(u_x, u_x, MADD(u_z, u_z, TINY)));
      const reg i_d = reg_reciprocal_sqrt(MADD(d_x, d_x, MADD(d_y, d_y, TINY)));
      const reg u_c = u_x * i_u, u_s = u_z * i_u, t_x = d_x * i_d, t_y = d_y * i_d;
      const reg c = MADD(u_c, take[k], keep[k] * f->c[k]), z = MADD(u_s, take[k], keep[k] * f->z[k]), x = z * t_x, y = z * t_y;
      if (last) {
        /* from the change of u, not from its direction: what is small keeps its digits */
        const reg sine = MADD(g->c, du_z, -g->z * du_x) * i_u, e_c = u_c - g->c, e_z = u_s - g->z;
        const reg drop = 0.5f * MADD(e_c, e_c, e_z * e_z);
        f->turned[k] = MADD(keep[k], MADD(g->c, f->z[k], -g->z * f->c[k]) - sine, sine);
        f->lost[k] = MADD(keep[k], (1 - MADD(g->c, f->c[k], g->z * f->z[k])) - drop, drop);
      }
      if (last)
        moved[k] =
            MADD(a->mu, reg_abs(x - f->s_x[k]) + reg_abs(y - f->s_y[k]), reg_abs(u_c - f->c[k]) + reg_abs(u_s - f->z[k]));
      f->c[k] = c;
      f->z[k] = z;
      f->s_x[k] = x;
      f->s_y[k] = y;
    }
  }
  EACH_REG(k, n) {
    f->w_x[k] = turn ? m->weight[k] * f->s_x[k] : f->s_x[k];
    f->w_y[k] = turn ? m->weight[k] * f->s_y[k] : f->s_y[k];
    f->turned[k] = turn ? m->weight[k] * f->turned[k] : f->turned[k];
    f->lost[k] = turn ? m->weight[k] * f->lost[k] : f->lost[k];
  }
  f->moved = largest(moved, n);
}

/* What the iterations have left, in p. */
always vreal iteration_error(const problem *a, const step_law *l, vreal moved) {
  return l->mu_b * moved * v_fma(v_splat(CONTRACTION_CLOTH), a->pull, v_fma(CONTRACTION_Q * l->q, l->q, v_splat(CONTRACTION)));
}

/* The means over the stretch of c and sigma, against their values at first. */
always void mean_turning(const gauss_rule *r, int n, const prediction *g, const directions *f, vreal *c, vreal *z) {
  const vreal turned = dot(r->all, f->turned, n), lost = dot(r->all, f->lost, n);
  *c = v_fma(-g->z, turned, -g->c * lost);
  *z = v_fma(g->c, turned, -g->z * lost);
}

#endif
