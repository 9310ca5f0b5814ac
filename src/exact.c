/* exact.c - one ball-ball collision in the limit of infinitely many steps of Mathavan's model.
 *
 * THE EQUATIONS. Frame: x along the table, y from ball i to ball j, z up; at the contact of the balls the slip is (u_x, u_z).
 * The sign of u_z never changes and decides which ball is pressed into the cloth: i if u_z > 0, j if u_z < 0. The second case
 * is the first seen from the other side: turned by 180 degrees about z with the balls exchanged, u_x stays while u_z and the
 * slip (d_x, d_y) of the pressed ball on the cloth change sign. So let u_z >= 0, and let "pressed" and "other" name the balls.
 * With p = (normal impulse) / M_pressed as the variable, kappa = 1 + M_pressed / M_other, (c, sigma) = (u_x, u_z) / |u|,
 * t = d / |d|, mu the cloth friction under the pressed ball, mu_b that between the balls, and s = -1 for the paper's cloth
 * slip:
 *
 *     f       = -mu mu_b sigma t                                     cloth friction
 *     u_x'    = -7/2 kappa mu_b c + f_x        u_z' = -5/2 kappa mu_b sigma + 5/2 f_y        v_n' = kappa - f_y
 *     d'      = (-mu_b c + (1 - 5/2 s) f_x, -1 + 5/2 s mu_b sigma + (1 - 5/2 s) f_y)
 *
 * All of it is linear in p, F = int f dp, Q_1 = int mu_b c dp and Q_2 = int mu_b sigma dp; Q_1 and Q_2 follow from u and F, and
 * the twelve velocities from Q_1, Q_2, F and p, which makes the momentum balance exact. Equal masses: kappa = 2.
 * Source: S. Mathavan, M. R. Jackson, R. M. Parkin, Sports Engineering 17 (2014) 227-237; Stronge's energetic restitution.
 *
 * THE VARIABLE. lambda with u_z = u_z0 lambda^5 runs from 1 towards 0, where the balls stick: no step can overshoot. There
 *
 *     tau      = t / (kappa + mu t_y)                                       (so 1 / (kappa + mu t_y) = (1 - mu tau_y) / kappa)
 *     dp       = -2 / mu_b  lambda^4 sqrt(u_z0^2 + W^2) (1 - mu tau_y) / kappa  dlambda              W = u_x / lambda^5
 *     dF       =  2 mu u_z0 lambda^4 tau  dlambda
 *     d(W / lambda^2) = 2 mu (u_z0 tau_x - 7/2 tau_y W) / lambda^3  dlambda
 *
 * and, without cloth friction, W = u_x0 lambda^2 and everything is one quadrature. With it tau(lambda) is the only unknown.
 *
 * THE METHOD. An arc is a stretch of lambda, scaled to start at 1, with 6 nodes. A sweep takes tau at all nodes at once
 * to W, p, F and d there, by fixed matrices, and d to a new tau (one square root for p', one and a division for tau a node).
 * Sweeps gain a factor of about 50 each. Two kinds of rule: gauss, from 1 to 1 - h, Gauss-Legendre nodes; stick, from 1 to 0,
 * nodes for the weight lambda^4, the 1 / lambda^3 of W integrated exactly. No node is an end point, so a pressed ball that
 * starts from rest needs no care: its first node already sees it move in the right direction.
 *
 * THE END. S = int v_n dp = (v_n0 + kappa p / 2 - F_y) p + H with H = int p dF_y. Its minimum -W_c lies at v_n = 0 and is found
 * to third order from any point near it; the collision ends at S = (1 - e^2) S_min, an error of the predicted h being made good
 * by three terms of a Taylor series. After stick v_n has slope kappa and the end is a closed form.
 *
 * WHICH ARC. This is the patient way, for what the swift solver (swift/swift.c) leaves: strong friction, hardly any
 * restitution, very unequal masses, and whatever else it did not settle. A forecast tells q, the share of ball slip lost at the
 * end at the rate of the start, and the straight line on which the cloth slip will run. If the balls will stick and the line is
 * clear of zero, an arc to stick is tried; else arcs follow each other, graded towards the turn, each as long as its
 * polynomials carry. */
#include "exact.h"
#include <float.h>
#include <math.h>
#include <stddef.h>

#define always static inline __attribute__((always_inline)) /* the constants of a rule must reach the inner loops */

enum { NODES = 6, PAIRS = NODES / 2 };
typedef double pair __attribute__((vector_size(16))); /* two nodes at once */

/* A rule on an arc. x runs from 0 to 1 along a gauss arc (lambda = 1 - h x); on a stick arc the node is lambda itself.
 * Row j of a matrix belongs to the slope at node j. */
typedef struct rule {
  pair node[PAIRS], away[PAIRS];              /* the nodes; -log(node) of a stick rule */
  pair sum[NODES][PAIRS], turn[NODES][PAIRS]; /* integrals up to each node: of p, F and of W's */
  pair all[PAIRS];                            /* the integral over the arc */
  pair part[NODES][PAIRS];                    /* its coefficients as a polynomial in the upper bound */
  pair tail[PAIRS];                           /* highest coefficient of the interpolant, scaled to a largest weight of 1 */
  pair last[PAIRS], bend[PAIRS], curl[PAIRS]; /* gauss: value, first and second derivative of the interpolant at x = 1 */
} rule;
#include "exact_rules.h"

/* Limits, each tried on 50,000 random collisions of 33 kinds: see numerics.md. */
static const double TINY = 1e-300;      /* keeps 0 / 0 away */
static const double ENOUGH = 2e-8;      /* a sweep was the last when its next change, times the pull of the cloth, is below */
static const double ARC_ROOM = 1.4;     /* how clear of zero d keeps on an arc: see `clear_way` */
static const double STRONG_PULL = 0.15; /* mu mu_b from which d may change its direction by the cloth alone */
static const double BEYOND = 0.006;     /* share of an arc that its polynomials are trusted beyond its end */
static const double LEAST_SLIP = 3e-7;  /* change of u_x, over the approach, that makes no odds */
static const double LONGEST = 0.45;     /* largest h of an arc */
enum { MOST_SWEEPS = 8 };
static const double SEPARATE = 0.5; /* e under which an arc ends where v_n = 0: the end hangs on the work until there */
static const double FADE = 3e-7;    /* e^4 under which the end is found from v_n, not from S */

typedef struct law {
  double kappa, mu, mu_b, s, v_n0, e;
} law; /* what stays */
typedef struct state {
  double u_x, u_z, d_x, d_y, p, F_x, F_y, H;
} state; /* what moves */
typedef struct forecast {
  double u, p_f;       /* |u|; the p to reach */
  double tau_x, tau_y; /* tau half way */
  double q, z;         /* shares of |u| and of lambda lost on the way, to first order */
  double g_x, g_y;     /* rate of the cloth slip, but for cloth friction */
  double pull;         /* |f| */
} forecast;
typedef struct plan {
  double h, aim; /* length of a gauss arc; if aim > 0, h is corrected once so that the arc ends about there */
  double enough; /* change of tau that ends the sweeps */
} plan;
typedef struct arc {
  double h, change;
  double p_end, dp, ddp, dddp, per; /* p and its derivatives by x at the end, one sweep old; per = 1 / dp */
  int evaluations;
  pair p[PAIRS], dp_dx[PAIRS], dF_x[PAIRS], dF_y[PAIRS], dW[PAIRS]; /* p and slopes at the nodes */
} arc;
typedef struct ending {
  double S_min, p_c, slope_c; /* at v_n = 0, once seen; slope of v_n there */
  double p_stick;
  int seen, stuck, evaluations;
} ending;

always double square(double x) {
  return x * x;
}
always double high(double x, double y) {
  return x > y ? x : y;
} /* fmax would be a call */
always double low(double x, double y) {
  return x < y ? x : y;
}

#ifdef __SSE2__
#include <emmintrin.h>
always pair root(pair x) {
  return (pair)_mm_sqrt_pd((__m128d)x);
}
always pair larger(pair x, pair y) {
  return (pair)_mm_max_pd((__m128d)x, (__m128d)y);
}
always pair size(pair x) {
  return (pair)_mm_andnot_pd(_mm_set1_pd(-0.0), (__m128d)x);
}
#else
always pair root(pair x) {
  return (pair){sqrt(x[0]), sqrt(x[1])};
}
always pair larger(pair x, pair y) {
  return (pair){high(x[0], y[0]), high(x[1], y[1])};
}
always pair size(pair x) {
  return (pair){fabs(x[0]), fabs(x[1])};
}
#endif
always pair both(double x) {
  return (pair){x, x};
}

/* out = sum over the nodes j of M[j] v_j, added in pairs so that the chain stays short */
always void apply(const pair (*M)[PAIRS], const pair *v, pair *out) {
  for (int j = 0; j < PAIRS; j++) {
    const pair a = both(v[j][0]), b = both(v[j][1]);
    for (int k = 0; k < PAIRS; k++) {
      const pair add = M[2 * j][k] * a + M[2 * j + 1][k] * b;
      out[k] = j ? out[k] + add : add;
    }
  }
}
always double dot(const pair *a, const pair *b) {
  pair r = a[0] * b[0];
  for (int j = 1; j < PAIRS; j++)
    r += a[j] * b[j];
  return r[0] + r[1];
}

always double work_of(const law *m, const state *a) {
  return (m->v_n0 + 0.5 * m->kappa * a->p - a->F_y) * a->p + a->H;
}
always double speed_of(const law *m, const state *a) {
  return m->v_n0 + m->kappa * a->p - a->F_y;
}

/* What lies within `reach` (an impulse): the end, the direction of the cloth slip half way, the share q of the ball slip lost.
 */
always forecast predict(const law *m, const state *a, double reach) {
  forecast f;
  const double mid_x = a->d_x, mid_y = a->d_y - 0.5 * reach, r = 1 / (sqrt(mid_x * mid_x + mid_y * mid_y) + TINY);
  const double t_x = mid_x * r, t_y = mid_y * r, D = m->kappa + m->mu * t_y;
  f.u = sqrt(a->u_x * a->u_x + a->u_z * a->u_z);
  const double i = 1 / (f.u + TINY), c = a->u_x * i, sigma = a->u_z * i;
  f.g_x = -m->mu_b * c;
  f.g_y = -1 + 2.5 * m->s * m->mu_b * sigma;
  f.pull = m->mu * m->mu_b * sigma;
  f.tau_x = t_x / D;
  f.tau_y = t_y / D;
  const double back = f.pull * f.tau_y;
  f.p_f = reach * (1 - back * (1 - back));
  const double rate = 3.5 * m->kappa * c * c + sigma * (2.5 * D * sigma + m->mu * c * t_x);
  f.q = rate * m->mu_b * f.p_f * i;
  f.z = 0.5 * D * m->mu_b * f.p_f * i;
  return f;
}
/* The direction half way once more, now with the drift of the slip along x and its spin: with the pooltool sign and strong
 * friction the slip may set out along +y, and a start along -y would settle on a branch that nothing real follows. */
always void face(const law *m, const state *a, double reach, forecast *f) {
  const double mid_x = a->d_x + 0.5 * reach * f->g_x, mid_y = a->d_y + 0.5 * reach * f->g_y;
  const double i = 1 / (m->kappa * sqrt(mid_x * mid_x + mid_y * mid_y) + m->mu * mid_y + TINY);
  f->tau_x = mid_x * i;
  f->tau_y = mid_y * i;
}

/* 1 - (1 - q)^(z/q), the share of lambda lost on the way; q up to 0.4 */
always double power_share(double q, double z) {
  return z * (1 + (q - z) * (0.5 + (2 * q - z) * (1 / 6.0 + (3 * q - z) * (1 / 24.0 + (4 * q - z) * (1 / 120.0)))));
}
always double share_of_lambda(double q, double z) {
  if (q < 0.4)
    return power_share(q, z);
  const double less = 1 - sqrt(sqrt(sqrt(1 - q)));
  return power_share(less, 8 * z * less / q);
}

/* What a sweep needs at the nodes of an arc. */
typedef struct mesh {
  pair l2[PAIRS], l5[PAIRS];               /* lambda^2, lambda^5 */
  pair c_p[PAIRS], c_f[PAIRS], c_W[PAIRS]; /* factors of the slopes of p, F and W */
  pair damp[PAIRS];                        /* about the inverse of 1 - (change of W's integral with W) */
  pair own[PAIRS];             /* the cloth's own pull on d along tau: it turns nothing, and leaving it out speeds the sweeps */
  pair W[PAIRS], speed[PAIRS]; /* u_x / lambda^5 and |u| / lambda^5 */
  pair tau_x[PAIRS], tau_y[PAIRS];
} mesh;

/* Nodes, factors and a first W, for tau constant along the arc; to second order in log(lambda) on a gauss arc. */
always void lay_mesh(const law *m, const state *a, const rule *r, int sticks, double h, const forecast *f, mesh *g) {
  const pair one = both(1), u_x = both(a->u_x), per = both(2 / (m->kappa * m->mu_b));
  const double c_F = -2 * m->mu * a->u_z;
  const double a_0 = 2 * m->mu * (a->u_z * f->tau_x - 3.5 * f->tau_y * a->u_x),
               a_1 = m->mu * (-2 * a->u_z * f->tau_x - 3.5 * f->tau_y * a_0);
  for (int k = 0; k < PAIRS; k++) {
    const pair x = h * r->node[k], l = sticks ? r->node[k] : one - x;
    const pair log_l = x * (one + x * (0.5 + (1 / 3.0) * x)); /* its negative */
    g->l2[k] = l * l;
    g->l5[k] = g->l2[k] * g->l2[k] * l;
    const pair weight = sticks ? one : h * (g->l2[k] * g->l2[k]); /* a stick rule holds the lambda^4 itself */
    g->c_p[k] = per * weight;
    g->c_f[k] = c_F * weight;
    g->c_W[k] = sticks ? both(m->mu) : (2 * h * m->mu) / (g->l2[k] * l);
    g->tau_x[k] = both(f->tau_x);
    g->tau_y[k] = both(f->tau_y);
    if (sticks) {
      g->W[k] = g->l2[k] * u_x;
      g->damp[k] = one / (one - (2.5 * m->mu * f->tau_y) * r->away[k]);
    } else {
      const pair E = (3.5 * m->mu * f->tau_y) * log_l;
      g->W[k] = g->l2[k] * (u_x - log_l * (a_0 - log_l * a_1));
      g->damp[k] = one + E * (one + E * (one + E));
    }
  }
}

/* A new W from tau and the old W, and how far that moves u_x. */
always pair renew_slip(const state *a, const rule *r, int sticks, mesh *g, arc *q) {
  pair change[PAIRS], moved = both(0);
  for (int k = 0; k < PAIRS; k++)
    q->dW[k] = g->c_W[k] * (a->u_z * g->tau_x[k] - 3.5 * (g->tau_y[k] * g->W[k]));
  apply(r->turn, q->dW, change);
  for (int k = 0; k < PAIRS; k++) {
    const pair W = sticks ? g->l2[k] * a->u_x - change[k] : g->l2[k] * (a->u_x - change[k]);
    const pair step = g->damp[k] * (W - g->W[k]);
    moved = larger(moved, size(step) * g->l5[k]);
    g->W[k] += step;
    g->speed[k] = root(both(a->u_z * a->u_z) + g->W[k] * g->W[k]);
  }
  return moved;
}

always void slope_of_p(const law *m, const mesh *g, arc *q) {
  for (int k = 0; k < PAIRS; k++)
    q->dp_dx[k] = g->c_p[k] * (1 - m->mu * g->tau_y[k]) * g->speed[k];
}
always void slope_of_F(const mesh *g, arc *q) {
  for (int k = 0; k < PAIRS; k++) {
    q->dF_x[k] = g->c_f[k] * g->tau_x[k];
    q->dF_y[k] = g->c_f[k] * g->tau_y[k];
  }
}

/* New cloth slips from P = p - a->p and X, Y = F - F_a at the nodes, and from them a new tau. Returns its largest change. */
always pair renew_tau(const law *m, const state *a, const pair *P, const pair *X, const pair *Y, mesh *g) {
  const double per = 1 / m->kappa, spin = 2.5 * m->s;
  const pair one = both(1), per35 = both(per / 3.5), u_x = both(a->u_x);
  const pair on_x = both(1 - spin - per / 3.5), on_y = both(1 - spin + spin * per), on_z = both(spin * per * 0.4 * a->u_z);
  pair change = both(0);
  for (int k = 0; k < PAIRS; k++) {
    const pair d_x = a->d_x + on_x * X[k] - per35 * (u_x - g->l5[k] * g->W[k]) - g->own[k] * g->tau_x[k];
    const pair d_y = a->d_y + on_y * Y[k] + on_z * (one - g->l5[k]) - P[k] - g->own[k] * g->tau_y[k];
    const pair i = one / (m->kappa * root(d_x * d_x + d_y * d_y) + (m->mu * d_y + TINY));
    const pair x = d_x * i, y = d_y * i;
    change = larger(change, larger(size(x - g->tau_x[k]), size(y - g->tau_y[k])));
    g->tau_x[k] = x;
    g->tau_y[k] = y;
  }
  return change;
}

/* One arc from *a. */
always void run_arc(const law *m, const state *a, const rule *r, int sticks, const plan *way, const forecast *f, arc *q) {
  mesh g;
  pair P[PAIRS], X[PAIRS], Y[PAIRS];
  const double per = 1 / m->kappa, spin = 2.5 * m->s, c_F = -0.4 * m->mu * a->u_z;
  double h = way->h;
  lay_mesh(m, a, r, sticks, h, f, &g);
  if (sticks)
    renew_slip(a, r, 1, &g, q);
  else
    for (int k = 0; k < PAIRS; k++)
      g.speed[k] = root(both(a->u_z * a->u_z) + g.W[k] * g.W[k]);
  if (!sticks && way->aim > 0) {
    slope_of_p(m, &g, q);
    const double dp = dot(r->last, q->dp_dx), ddp = dot(r->bend, q->dp_dx), dx = (way->aim - dot(r->all, q->dp_dx)) / dp;
    h = low(h * (1 + dx * (1 - 0.5 * dx * ddp / dp)), 0.7);
    lay_mesh(m, a, r, 0, h, f, &g);
    for (int k = 0; k < PAIRS; k++)
      g.speed[k] = root(both(a->u_z * a->u_z) + g.W[k] * g.W[k]);
  }
  /* With the pooltool sign and strong friction, d without its own pull might change its direction. */
  const double flat = square(f->tau_x) / (square(f->tau_x) + square(f->tau_y) + TINY), along_x = 1 - spin - per / 3.5,
               along_y = 1 - spin + spin * per;
  const double share = spin > 0 && m->mu * m->mu_b > STRONG_PULL ? 0 : along_x * (1 - flat) + along_y * flat;
  for (int k = 0; k < PAIRS; k++)
    g.own[k] = (c_F * share) * (1 - g.l5[k]);

  pair change = both(0);
  int sweep = 0;
  slope_of_p(m, &g, q);
  for (int last = 0; !last; sweep++) {
    if (sweep) {
      renew_slip(a, r, sticks, &g, q);
      slope_of_p(m, &g, q);
    }
    apply(r->sum, q->dp_dx, P);
    if (sweep) {
      slope_of_F(&g, q);
      apply(r->sum, q->dF_x, X);
      apply(r->sum, q->dF_y, Y);
    } else
      for (int k = 0; k < PAIRS; k++) {
        X[k] = (c_F * f->tau_x) * (1 - g.l5[k]);
        Y[k] = (c_F * f->tau_y) * (1 - g.l5[k]);
      }
    change = renew_tau(m, a, P, X, Y, &g);
    last = sweep > 0 && (sweep + 1 >= MOST_SWEEPS || high(change[0], change[1]) < way->enough);
  }
  for (int k = 0; k < PAIRS; k++)
    q->p[k] = a->p + P[k];
  if (!sticks) {
    q->p_end = a->p + dot(r->all, q->dp_dx);
    q->dp = dot(r->last, q->dp_dx);
    q->ddp = dot(r->bend, q->dp_dx);
    q->dddp = dot(r->curl, q->dp_dx);
    q->per = 1 / (q->dp > 0 ? q->dp : q->p_end - a->p);
  }
  /* Where the cloth pulls little, tau has converged before W. */
  const double least = -m->v_n0 * LEAST_SLIP;
  double last = HUGE_VAL;
  for (int k = 0; k < (sticks ? 1 : 8); k++) {
    const pair moved = renew_slip(a, r, sticks, &g, q);
    const double most = high(moved[0], moved[1]);
    if (most < least || most > 0.5 * last)
      break;
    last = most;
  }
  slope_of_p(m, &g, q);
  slope_of_F(&g, q);
  q->h = h;
  q->change = high(change[0], change[1]);
  q->evaluations = NODES * (sweep + 1);
}

/* weights of the integral over the arc up to x in (0, 1] (gauss) or from lambda 1 down to x (stick) */
always void weights_upto(const rule *r, int sticks, double x, pair *w) {
  for (int j = 0; j < PAIRS; j++)
    w[j] = r->part[NODES - 1][j];
  for (int i = NODES - 2; i >= 0; i--)
    for (int j = 0; j < PAIRS; j++)
      w[j] = w[j] * x + r->part[i][j];
  const double x2 = x * x, x5 = x2 * x2 * x;
  for (int j = 0; j < PAIRS; j++)
    w[j] = sticks ? r->all[j] - w[j] * x5 : w[j] * x;
}
/* where the arc stands after the integral weights w; y: share of the direction integral, lambda given */
always state stand(const state *a, const arc *q, const pair *w) {
  state b = *a;
  pair H[PAIRS];
  for (int j = 0; j < PAIRS; j++)
    H[j] = q->p[j] * q->dF_y[j];
  b.p = a->p + dot(w, q->dp_dx);
  b.F_x = a->F_x + dot(w, q->dF_x);
  b.F_y = a->F_y + dot(w, q->dF_y);
  b.H = a->H + dot(w, H);
  return b;
}
always void put_slips(const law *m, const state *a, state *b, double lambda, double y) {
  const double l2 = lambda * lambda, l5 = l2 * l2 * lambda;
  b->u_z = a->u_z * l5;
  b->u_x = l5 * l2 * (a->u_x - y);
  const double X = b->F_x - a->F_x, Y = b->F_y - a->F_y, per = 1 / m->kappa;
  const double Q_1 = (a->u_x - b->u_x + X) * per / 3.5, Q_2 = (a->u_z - b->u_z + 2.5 * Y) * per * 0.4;
  b->d_x = a->d_x - Q_1 + (1 - 2.5 * m->s) * X;
  b->d_y = a->d_y - (b->p - a->p) + 2.5 * m->s * Q_2 + (1 - 2.5 * m->s) * Y;
}
/* *b is near v_n = 0, where v_n has slope 1 / per_slope. */
always void mark_compression(const law *m, const state *b, double per_slope, double slope_c, ending *end) {
  const double v_n = speed_of(m, b);
  end->S_min = work_of(m, b) - 0.5 * v_n * v_n * per_slope;
  end->p_c = b->p - v_n * per_slope;
  end->slope_c = slope_c;
  end->seen = 1;
}
/* The impulse still to go while v_n has constant slope. For e = 0 the end is where v_n = 0, whatever the works say: their
 * difference, mostly noise there, is faded out. */
always double to_go(const law *m, const state *b, double slope, double per_slope, const ending *end) {
  const double v_n = speed_of(m, b), e2 = m->e * m->e;
  const double local = v_n * v_n + 2 * slope * ((1 - e2) * end->S_min - work_of(m, b));
  const double since = (-2 / 3.0) * (end->slope_c + 2 * slope) * e2 * end->S_min;
  const double square_end = since + (local - since) * (e2 * e2 / (e2 * e2 + FADE));
  return (sqrt(high(square_end, 0)) - v_n) * per_slope;
}
always void glide(const law *m, state *b, ending *end) {
  end->p_stick = b->p;
  b->u_x = b->u_z = 0;
  if (!end->seen)
    mark_compression(m, b, 1 / m->kappa, m->kappa, end);
  end->stuck = b->p <= end->p_c ? 1 : 2;
  b->p += to_go(m, b, m->kappa, 1 / m->kappa, end);
}

/* Where the arc has arrived. Returns the share of the arc by which the end of the collision lies beyond its end: 0 if it
 * was near enough (`trusted`) to be reached by two terms of Taylor's series, and the end is then in *b; else *b is the end of
 * the arc. */
always double arrive(const law *m, const state *a, const rule *r, const arc *q, double trusted, state *b, ending *end) {
  *b = stand(a, q, r->all);
  const double y = dot(r->all, q->dW), most = m->mu * m->mu_b; /* |f| is never more */
  const double f_y = high(low(dot(r->last, q->dF_y) * q->per, most), -most), slope = m->kappa - f_y, per_slope = 1 / slope;
  const double v_n = speed_of(m, b), way = b->p - a->p;
  if (!end->seen && v_n >= -0.01 * m->kappa * way) {
    /* v_n = 0 where p, a parabola in x, is p_c */
    const double guess = q->p_end - a->p, v_0 = speed_of(m, a);
    const double xi = low(-v_0 / (m->kappa * guess), 1.1), bow = high(low(1 - q->dp / guess, 1), -1);
    double x = 2 * xi / (1 + bow + sqrt(high(square(1 + bow) - 4 * bow * xi, 0))); /* (1 + bow) x - bow x^2 = xi */
    pair w[PAIRS];
    weights_upto(r, 0, x, w);
    state c = stand(a, q, w);
    for (int again = 0; again < 3; again++) {
      x = low(high(x - speed_of(m, &c) * per_slope / (guess * high(1 + bow - 2 * bow * x, 0.1)), 0), 1.1);
      weights_upto(r, 0, x, w);
      c = stand(a, q, w);
    }
    const double rise = (dot(r->bend, q->dF_y) - f_y * q->ddp) * square(q->per);
    mark_compression(m, &c, per_slope, slope + rise * (b->p - c.p), end);
  }
  double dx = 1, more = 0;
  if (end->seen) {
    more = to_go(m, b, slope, per_slope, end);
    dx = more * q->per;
    const double b_2 = 0.5 * q->ddp * q->per, x_0 = low(high(dx, -0.1), 0.1); /* reversion of the series of p(x) */
    const double reverted = 1 - x_0 * (b_2 - x_0 * (2 * b_2 * b_2 - (1 / 6.0) * q->dddp * q->per));
    dx *= low(high(reverted, 0.3), 3); /* where p is rough, at least the way must not turn round */
  }
  if (fabs(dx) > trusted) {
    put_slips(m, a, b, 1 - q->h, y);
    return dx;
  }
  const double half = 0.5 * dx * dx, sixth = (1 / 3.0) * dx * half;
  const double X = dx * dot(r->last, q->dF_x) + half * dot(r->bend, q->dF_x) + sixth * dot(r->curl, q->dF_x);
  const double Y = dx * dot(r->last, q->dF_y) + half * dot(r->bend, q->dF_y) + sixth * dot(r->curl, q->dF_y);
  const double turned = y + dx * dot(r->last, q->dW) + half * dot(r->bend, q->dW) + sixth * dot(r->curl, q->dW);
  b->p += more;
  b->F_x += X;
  b->F_y += Y;
  b->H += (b->p - 0.5 * more) * Y;
  const double l = 1 - q->h * (1 + dx), l2 = l * l, l5 = l2 * l2 * l;
  b->u_z = a->u_z * l5;
  b->u_x = l5 * l2 * (a->u_x - turned);
  end->p_stick = b->p;
  return 0;
}

/* The end of a stick arc, or 0 (and *end untouched) if the collision ends before it. */
always int finish_stick(const law *m, const state *a, const rule *r, const arc *q, state *b, ending *end) {
  ending story = *end;
  *b = stand(a, q, r->all);
  b->u_x = b->u_z = 0;
  if (!story.seen && speed_of(m, b) > 0) { /* v_n = 0 on the way: Newton's method from p ~ 1 - lambda^6 */
    const double way = b->p - a->p, f_y = (b->F_y - a->F_y) / way, p_c = a->p - speed_of(m, a) / (m->kappa - f_y);
    double x = pow(high(1 - (p_c - a->p) / way, 0), 1 / 6.0);
    pair w[PAIRS], w_near[PAIRS];
    for (int k = 0; k < 8; k++) {
      const double step = x > 0.5 ? -1e-5 : 1e-5;
      weights_upto(r, 1, x, w);
      weights_upto(r, 1, x + step, w_near);
      const double p = dot(w, q->dp_dx), dx = (p_c - a->p - p) * step / (dot(w_near, q->dp_dx) - p);
      x = low(high(x + dx, 0), 1);
      if (fabs(dx) < 1e-6)
        break;
    }
    weights_upto(r, 1, x, w);
    const state c = stand(a, q, w);
    mark_compression(m, &c, 1 / (m->kappa - f_y), m->kappa - f_y, &story);
  }
  if (story.seen && work_of(m, b) > (1 - m->e * m->e) * story.S_min)
    return 0;
  *end = story;
  glide(m, b, end);
  return 1;
}
/* Do the polynomials of the arc fit? Their highest coefficients measure what they leave out; what an error of F costs grows
 * with the pull of the cloth, one of p counts through `weight_p`. */
always int smooth(const rule *r, const arc *q, double pull, double limit, double weight_p, double limit_p) {
  const double F = fabs(dot(r->tail, q->dF_x)) + fabs(dot(r->tail, q->dF_y)), p = fabs(dot(r->tail, q->dp_dx));
  return F * (pull + 0.003) < limit && p * weight_p < limit_p;
}

/* The longest way along d' on which its direction is smooth: the sum of the distances of zero from both ends, over the length
 * of the way, is 1 on the way itself and measures the ellipse on which t is analytic; it is to be ARC_ROOM. */
static double clear_way(const law *m, const state *a, const forecast *f, double unit) {
  const double d = sqrt(a->d_x * a->d_x + a->d_y * a->d_y), pull = m->mu * m->mu_b;
  if (pull * d <= 1e-9 * unit)
    return DBL_MAX; /* at rest, or so near that it makes no odds */
  const double drag = (1 - 2.5 * m->s) * f->pull / d, g_x = f->g_x - drag * a->d_x, g_y = f->g_y - drag * a->d_y;
  const double g = sqrt(g_x * g_x + g_y * g_y) + TINY, a2 = ARC_ROOM * ARC_ROOM;
  return high(2 * ((a->d_x * g_x + a->d_y * g_y) / g + ARC_ROOM * d) / ((a2 - 1) * g), 1e-8 * unit / pull);
}

/* Arc after arc, from *a. Bounded: 300 arcs, each halved at most 40 times. */
static void solve(const law *m, state a, state *b, ending *end) {
  *end = (ending){0};
  const double unit = -m->v_n0 / m->kappa, pull = m->mu * m->mu_b, enough = ENOUGH / ((pull + TINY) * (pull + 0.03));
  double longest = LONGEST;
  for (int count = 0; count < 300; count++) {
    const double left = end->seen ? to_go(m, &a, m->kappa, 1 / m->kappa, end)
                                  : (m->e > 0.1 && m->e < SEPARATE ? 0 : m->e) * unit - speed_of(m, &a) / m->kappa;
    forecast f = predict(m, &a, high(left, 1e-9 * unit));
    if (!(f.u + square(m->v_n0) + square(a.d_x) + square(a.d_y) < HUGE_VAL)) {
      *b = a;
      b->p = HUGE_VAL; /* too fast for a double: the result overflows */
      return;
    }
    if (f.u <= 1e-13 * m->mu_b * unit)
      break; /* as good as stuck */
    if (end->seen && left < 1e-10 * unit) {
      *b = a;
      end->p_stick = b->p;
      return;
    }
    const double turn = clear_way(m, &a, &f, unit), p_stick = f.p_f / f.q;
    face(m, &a, low(f.p_f, turn), &f);
    arc q;
    if (f.q >= 1 && 2 * p_stick < turn) {
      const plan way = {.h = 1, .enough = enough};
      run_arc(m, &a, &stick_6, 1, &way, &f, &q);
      end->evaluations += q.evaluations;
      if (q.change * pull * p_stick < 1e-6 * unit && smooth(&stick_6, &q, pull, 1e-6 * unit, pull, 3e-4 * unit) &&
          finish_stick(m, &a, &stick_6, &q, b, end))
        return;
    }
    double aim = f.p_f;
    if (aim > turn) {
      f = predict(m, &a, turn);
      face(m, &a, turn, &f);
      aim = 0;
    }
    double h = f.q < 0.95 ? share_of_lambda(f.q, f.z) : longest;
    if (h >= longest) {
      h = longest;
      aim = 0;
    }
    for (int half = 0;; half++) {
      const plan way = {.h = h, .aim = aim, .enough = enough};
      run_arc(m, &a, &gauss_6, 0, &way, &f, &q);
      end->evaluations += q.evaluations;
      aim = 0;
      if (half < 40 &&
          !(q.change * pull * (q.p_end - a.p) < 1e-6 * unit && smooth(&gauss_6, &q, pull, 1e-6 * unit, m->mu_b, 3e-4 * unit))) {
        h = 0.5 * q.h;
        continue;
      }
      const ending before = *end;
      const double beyond = arrive(m, &a, &gauss_6, &q, BEYOND, b, end);
      if (beyond == 0)
        return;
      if (beyond > 0 || half >= 40)
        break;
      *end = before; /* the end lies well inside: shorten */
      h = q.h * high(1 + beyond, 0.3);
    }
    longest = low(8 * q.h, LONGEST);
    a = *b;
  }
  *b = a;
  glide(m, b, end);
}

void carom_exact(carom_local *c, carom_exact_report *report) {
  const double R = c->R, s = c->s;
  const double u_x = c->v_ix - c->v_jx - R * (c->w_iz + c->w_jz), u_z = R * (c->w_ix + c->w_jx), v_n0 = c->v_jy - c->v_iy;
  const int on_j = u_z < 0;
  const double sign = on_j ? -1 : 1, M_p = on_j ? c->M_j : c->M_i, M_o = on_j ? c->M_i : c->M_j, ratio = M_p / M_o;
  const double d_x = on_j ? -(c->v_jx + s * R * c->w_jy) : c->v_ix + s * R * c->w_iy,
               d_y = on_j ? -(c->v_jy - s * R * c->w_jx) : c->v_iy - s * R * c->w_ix;
  /* Speeds scale. In units of a power of two near that of the approach no square over- or underflows that matters. */
  int power, most;
  frexp(v_n0, &power);
  frexp(high(high(fabs(u_x), fabs(u_z)), high(fabs(d_x), fabs(d_y))), &most);
  power = power > most - 400 ? power : most - 400;
  const double unit = ldexp(1, power > -1000 ? power : -1000), in_units = 1 / unit;
  const law m = {1 + ratio, fabs(u_z) <= 1e-10 * -v_n0 ? 0 : on_j ? c->mu_j : c->mu_i, high(c->mu_b, 1e-30), s, v_n0 * in_units,
                 c->e};
  const state a = {u_x * in_units, sign * u_z * in_units, d_x * in_units, d_y * in_units, 0, 0, 0, 0};
  state b;
  ending end;
  solve(&m, a, &b, &end);
  const double per = 1 / m.kappa, Q_1 = (a.u_x - b.u_x + b.F_x) * (per / 3.5) * unit,
               Q_2 = (a.u_z - b.u_z + 2.5 * b.F_y) * (per * 0.4) * unit;
  b.p *= unit;
  b.F_x *= unit;
  b.F_y *= unit;
  const double spin = 2.5 / R;
  const double p_x = sign * (b.F_x - Q_1), p_y = sign * (b.F_y - b.p), o_x = sign * ratio * Q_1, o_y = sign * ratio * b.p;
  const double p_wx = sign * spin * (b.F_y - Q_2), p_wy = -sign * spin * b.F_x, o_wx = -sign * spin * ratio * Q_2;
  const double p_wz = spin * Q_1, o_wz = spin * ratio * Q_1;
  c->v_ix += on_j ? o_x : p_x;
  c->v_jx += on_j ? p_x : o_x;
  c->v_iy += on_j ? o_y : p_y;
  c->v_jy += on_j ? p_y : o_y;
  c->w_ix += on_j ? o_wx : p_wx;
  c->w_jx += on_j ? p_wx : o_wx;
  c->w_iy += on_j ? 0 : p_wy;
  c->w_jy += on_j ? p_wy : 0;
  c->w_iz += on_j ? o_wz : p_wz;
  c->w_jz += on_j ? p_wz : o_wz;
  if (report) {
    report->P = M_p * b.p;
    report->P_ax = -M_p * Q_1;
    report->P_az = -sign * M_p * Q_2;
    report->P_cx = sign * M_p * b.F_x;
    report->P_cy = sign * M_p * b.F_y;
    report->pressed = u_z > 0 ? 1 : on_j ? -1 : 0;
    report->work_compression = -M_p * end.S_min * unit * unit;
    report->work_total = (1 + c->e * c->e) * report->work_compression;
    report->stuck = end.stuck;
    report->P_stick = M_p * end.p_stick * unit;
    report->evaluations = end.evaluations;
  }
}
