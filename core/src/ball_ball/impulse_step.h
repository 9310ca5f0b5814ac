/* The step in the normal impulse: the directions of both slips at the nodes of a step, by
 * collocation, and the state behind it. A step ends before the collision does, or near its end,
 * to which a Taylor series leads from there.
 *
 * THE EQUATIONS are in reduced.h. With X from 0 to 1 along the step, L its length in p, c = u_x /
 * |u|, sigma = u_z / |u| and s = sigma t, the slips are linear in the integrals C, Z, S_x, S_y of
 * c, sigma, s_x, s_y over X:
 *
 *     u_x = u_x0 - 7/2 kappa mu_b L C - mu mu_b L S_x
 *     u_z = u_z0 - 5/2 kappa mu_b L Z - 5/2 mu mu_b L S_y
 *     d_x = d_x0 - mu_b L C - (1 - 5/2 s) mu mu_b L S_x
 *     d_y = d_y0 - L X + 5/2 s mu_b L Z - (1 - 5/2 s) mu mu_b L S_y
 *
 * THE PREDICTOR turns u by a series to third order, for a t that turns evenly, and lets d run
 * with the means of the directions so far.
 *
 * THE ITERATION takes the directions at the nodes through the integration matrix to the slips
 * there, and these to new directions. The cloth converges by itself, since mu mu_b is
 * small. An angle rho by which u has moved would turn friction the wrong way, and u back: rho
 * less the integral of D rho, where D = mu_b L kappa (5/2 + sigma^2) / |u|, is nearly the
 * remainder after a step of Newton's method, since |u| falls at about the rate D |u|.
 *
 * A collision's iteration ends when its error estimate is small enough, whatever the other lanes
 * do. */
#ifndef CAROM_SRC_BALL_BALL_IMPULSE_STEP_H
#define CAROM_SRC_BALL_BALL_IMPULSE_STEP_H

#include "ball_ball/problem.h"
#include "ball_ball/quadrature.h"

#include <stdbool.h>

/* ---- The nodes ------------------------------------------------------------------------------- */

/* Where the nodes of a step lie: X, the fraction of its length, over the variable x of the rule. In
 * steps of four and six nodes X is x. Those of eight nodes have one of two maps:
 *
 *     graded    drawn together towards where |u| would reach zero: 1 - q X = (1 - h x)^4
 *     turned    drawn together where the cloth slip turns. There it passes zero at a distance
 *               delta (in p), at p_t, and its direction t turns within a few delta. With p - p_t
 *               = delta sinh(xi), t dp/dxi is nearly a polynomial in xi, which runs evenly with
 *               x. */

always bool is_mapped(int n) {
  return n == MOST_NODES;
}

/* X at the nodes, and dX/dx where it is not 1. */
typedef struct mapped_nodes {
  reg X[MOST_REGS], weight[MOST_REGS];
} mapped_nodes;

/* A step over turned nodes: p_t and delta, its length, and the mean of f on it if d moved along
 * a straight line. */
typedef struct turn_step {
  vreal p_t, delta, length, mean_f;
} turn_step;

/* Graded: q, h, and X / x at x = 1 without the factors that depend on x.
 * Turned: sinh(xi) at x = 0, xi there, its range, delta / (2 L). */
typedef union node_map {
  struct {
    vreal q, h, X_per_x, unused;
  };
  struct {
    vreal sinh_0, xi_0, xi_range, half_width;
  };
} node_map;

static const real MOST_GRADING = REAL(0.995); /* q */

always node_map graded_map(vreal q) {
  node_map m;
  m.q = v_min(q, v_splat(MOST_GRADING));
  /* y = 1 - h at x = 1, where 1 - q X = y^4; then X / x = h (1 + y) (1 + y^2) / q, and h = q /
   * ((1 + y) (1 + y^2)) */
  const vreal y = root(root(1 - m.q));
  m.h = 1 - y;
  m.X_per_x = v_reciprocal((1 + y) * v_fma(y, y, v_splat(1)));
  m.unused = v_splat(0);
  return m;
}

always node_map turned_map(const turn_step *p, vreal length) {
  const vreal per_delta = v_reciprocal(p->delta);
  node_map m;
  m.sinh_0 = -p->p_t * per_delta;
  m.half_width = REAL(0.5) * p->delta * v_reciprocal(length);
  m.xi_0 = inverse_sinh(m.sinh_0);
  m.xi_range = inverse_sinh((length - p->p_t) * per_delta) - m.xi_0;
  return m;
}

/* X and its slope at the nodes of a rule from 0 to a fraction of x. */
always void lay_nodes(bool turned, const gauss_rule *r, int n, const node_map *m, vreal share,
                      mapped_nodes *target) {
  if (!turned) {
    /* X = x X_per_x (1 + y) (1 + y^2) and dX/dx = 4 X_per_x y^3, with y = 1 - h x */
    const vreal h = share * m->h, to_X = share * m->X_per_x;
    EACH_REG(k, n) {
      const reg x = SPREAD(AT(r->node, k)), y = MADD(-h, x, REAL(1.0)), y2 = y * y;
      target->X[k] = (to_X * x) * ((1 + y) * (1 + y2));
      target->weight[k] = (4 * to_X) * (y2 * y);
    }
  } else {
    /* X = (sinh(xi) - sinh_0) delta / L, by e^xi */
    const vreal range = share * m->xi_range, slope = range * m->half_width,
                start = 2 * m->sinh_0 * m->half_width;
    EACH_REG(k, n) {
      const reg e = exponential(MADD(range, AT(r->node, k), m->xi_0)), i = reg_reciprocal(e);
      target->X[k] = MADD(m->half_width, e - i, -start);
      target->weight[k] = slope * (e + i);
    }
  }
}

/* x at which X has a value. */
always vreal x_at(bool turned, const node_map *m, vreal X) {
  if (!turned) {
    const vreal y = root(root(v_fma(-m->q, X, v_splat(1))));
    return X * v_reciprocal(m->X_per_x * (1 + y) * v_fma(y, y, v_splat(1)));
  }
  return (inverse_sinh(v_fma(X, v_reciprocal(2 * m->half_width), m->sinh_0)) - m->xi_0) *
         v_reciprocal(m->xi_range);
}

/* ---- The directions -------------------------------------------------------------------------- */

/* An iteration leaves an error of at least CONTRACTION times its last move, and more by mu mu_b,
 * for the cloth, and by q^2, for u. */
/* Found by trial with `carom-lab stress --draws 60000`. With half of CONTRACTION errors reach
 * 3.8e-7 instead of 3.5e-7, with half of CONTRACTION_CLOTH 8.1e-7; at twice, or with other
 * CONTRACTION_Q, the largest errors do not grow. */
static const real CONTRACTION = REAL(0.02);
static const real CONTRACTION_CLOTH = REAL(1.2);
static const real CONTRACTION_Q = REAL(0.1);
/* The factor of that estimate: it is too small where d passes near zero, and too large for the
 * few nodes of smooth steps. */
always real estimate_scale(int n, bool turned) {
  if (turned)
    return 4;
  if (n == 4)
    return REAL(0.33);
  return n == 6 ? REAL(0.4) : 1;
}

/* Coefficients of the equations, times L (S_in_d: of S_x in u_x and S in d; ...); and q, the
 * fraction of |u| that the step loses at its first rate. */
typedef struct coefficients {
  vreal length, mu_b, mu_mu_b, mu_mu_b_y, S_in_d, Z_in_d_y, C_in_u_x, Z_in_u_z, S_in_u_z, q;
} coefficients;

always coefficients coefficients_of(const problem *a, const prediction *g, vreal length) {
  coefficients l = {.length = length,
                    .mu_b = a->mu_b * length,
                    .mu_mu_b = a->mu_mu_b * length,
                    .mu_mu_b_y = a->mu_mu_b_y * length};
  l.S_in_d = (a->spin - 1) * l.mu_mu_b;
  l.Z_in_d_y = a->spin * l.mu_b;
  l.C_in_u_x = REAL(-3.5) * (a->kappa * l.mu_b);
  l.Z_in_u_z = REAL(-2.5) * (a->kappa * l.mu_b);
  l.S_in_u_z = REAL(-2.5) * l.mu_mu_b;
  l.q = g->rate * length;
  return l;
}

/* At the nodes: the directions c, z of u and s = z t; s times the weight of the node; the
 * integral of s_y up to there. And of the last iteration: the change of u, 1 / |u|, the angle by
 * which u was turned back. */
typedef struct directions {
  reg c[MOST_REGS], z[MOST_REGS], s_x[MOST_REGS], s_y[MOST_REGS], w_x[MOST_REGS], w_y[MOST_REGS],
      S_y[MOST_REGS];
  reg dx[MOST_REGS], dz[MOST_REGS], per_u[MOST_REGS], back[MOST_REGS];
  vmask going; /* lanes that have not converged */
  vreal error; /* estimate of the error after the iteration, in p */
} directions;

/* A step from *s, for which *g has been predicted. map: of nodes that are not even. */
typedef struct impulse_step {
  const problem *a;
  const prediction *g;
  const state *s;
  coefficients l;
  node_map map;
  mapped_nodes nodes;
  directions f;
} impulse_step;

/* The angle w by which u turns up to X, as a series to third order. Let r = |u| / |u_0| and b =
 * mu_b L / |u_0|. While t stays constant, w' = -b f_0(w) / r and r' = -b h(w), where f_1 is
 * -f_0' and f_2 is -(f_1 + h)' by w. Differentiated,
 *
 *     w'' / w' = b (f_1 + h) / r       w^(3) / w' = b^2 ((f_1 + h) (f_1 + 2 h) + f_0 f_2) / r^2
 *
 * and so w = w_1 X (1 + X b (f_1 + h) / 2 + X^2 w^(3) / (6 w')). In powers of x = X / (1 - alpha
 * X) with alpha = b h / 2 about, whose singularity represents that of 1 / r, the series w_1 x (1
 * + x (second + x third)) converges faster. by_t: the term of a turning t, by_t X (X - 1). */
typedef struct turning {
  vreal alpha, w_1, second, third, by_t;
} turning;

always turning predict_turning(bool turn, const problem *a, const prediction *g, const state *s,
                               vreal b) {
  /* u' = -mu_b (A c + E z, B z): friction of the balls, and of the cloth along the mean t */
  const vreal A = REAL(3.5) * a->kappa, B = REAL(2.5) * v_fma(a->mu, g->t_y, a->kappa),
              E = a->mu * g->t_x;
  const vreal c2 = g->c * g->c, z2 = g->z * g->z, cs = g->c * g->z, D = A - B;
  /* f_0, f_1, f_2 at the start */
  const vreal f_0 = g->z * v_fma(D, g->c, E * g->z), f_1 = v_fma(D, c2 - z2, 2 * E * cs),
              f_2 = v_fma(3 * E, c2 - z2, -6 * cs * D);
  const vreal h = v_fma(A, c2, v_fma(E, cs, B * z2)), both = f_1 + h;
  /* the coefficients, in powers of x */
  turning w = {.alpha = b * a->kappa * v_fma(v_splat(REAL(0.5)), c2, v_splat(REAL(1.25))),
               .w_1 = -b * f_0,
               .by_t = v_splat(0)};
  const vreal b_both = b * both;
  w.second = v_fma(v_splat(REAL(0.5)), b_both, -w.alpha);
  w.third = v_fma((1 / REAL(6.0)) * b, b * v_fma(both, v_fma(v_splat(2), h, f_1), f_0 * f_2),
                  w.alpha * (w.alpha - b_both));
  if (!turn) {
    /* t differs from its mean by (2 X - 1) times half of its change, which acts across u;
     * without slip t does not turn */
    const vreal i_d =
        v_rough_reciprocal_sqrt(v_fma(s->d_x, s->d_x, v_fma(s->d_y, s->d_y, v_splat(REAL(1e-12)))));
    const vreal half_x = v_fma(-s->d_x, i_d, g->t_x), half_y = v_fma(-s->d_y, i_d, g->t_y);
    w.by_t = v_select(has_no_slip(a, s), w.by_t,
                      b * g->z * a->mu * v_fma(REAL(2.5) * half_y, g->c, -half_x * g->z));
  }
  return w;
}

/* The directions at the nodes, before any iteration. turned: d passes near zero, so that its
 * direction half way is not informative.
 */
always void predict_directions(int n, bool turned, impulse_step *p) {
  const prediction *const g = p->g;
  const state *const s = p->s;
  const coefficients *const l = &p->l;
  directions *const f = &p->f;
  const turning turns = predict_turning(turned, p->a, g, s, l->mu_b * g->inverse_u);
  /* the cloth's own pull on d, along its direction half way */
  const vreal turn = turned ? v_splat(0) : l->S_in_d * g->z, own_x = turn * g->t_x,
              own_y = l->length - turn * g->t_y;
  const vreal half_b = REAL(0.5) * l->mu_b, half_y = REAL(0.5) * l->Z_in_d_y;
  EACH_REG(k, n) {
    /* u turned by w: cosine and sine to second order; sums begin with the first known */
    const reg X = p->nodes.X[k], x = X * rough_reciprocal(MADD(-turns.alpha, X, REAL(1.0)));
    const reg w = MADD(turns.w_1 * x, MADD(x * x, turns.third, MADD(x, turns.second, REAL(1.0))),
                       turns.by_t * (X * (X - 1)));
    f->c[k] = MADD(w, MADD(REAL(-0.5) * g->c, w, g->z), g->c);
    f->z[k] = MADD(w, MADD(REAL(-0.5) * g->z, w, -g->c), g->z);
    /* d along the means of the directions at the start and here */
    const reg d_x = MADD(-half_b * X, f->c[k], MADD(-X, half_b * g->c - own_x, s->d_x));
    const reg d_y = MADD(half_y * X, f->z[k], MADD(-X, own_y - half_y * g->z, s->d_y));
    const reg sigma_d = f->z[k] * reg_reciprocal_sqrt(MADD(d_x, d_x, MADD(d_y, d_y, TINY)));
    f->s_x[k] = sigma_d * d_x;
    f->s_y[k] = sigma_d * d_y;
    f->dx[k] = f->dz[k] = f->per_u[k] = f->back[k] = f->S_y[k] = SPREAD(REAL(0.0));
  }
  f->error = v_splat(0);
}

/* x dX/dx at node k. */
always reg weighed(int n, const mapped_nodes *nodes, int k, reg x) {
  return is_mapped(n) ? nodes->weight[k] * x : x;
}

/* One iteration, in the lanes that have not converged. */
always void iterate_directions(int n, bool turned, const gauss_rule *r, impulse_step *p) {
  const problem *const a = p->a;
  const state *const s = p->s;
  const coefficients *const l = &p->l;
  const mapped_nodes *const nodes = &p->nodes;
  directions *const f = &p->f;
  const vmask going = f->going;
  const vreal no_x = -l->mu_mu_b, no_b = -l->mu_b, mu_b_kappa = l->mu_b * a->kappa;
  reg w_c[MOST_REGS], w_z[MOST_REGS], C[MOST_REGS], Z[MOST_REGS], S_x[MOST_REGS], S_y[MOST_REGS];

  /* the integrals of the directions up to each node */
  EACH_REG(k, n) {
    w_c[k] = weighed(n, nodes, k, f->c[k]);
    w_z[k] = weighed(n, nodes, k, f->z[k]);
    f->w_x[k] = weighed(n, nodes, k, f->s_x[k]);
    f->w_y[k] = weighed(n, nodes, k, f->s_y[k]);
  }
  apply(r->sum, w_c, C, n);
  apply(r->sum, w_z, Z, n);
  apply(r->sum, f->w_x, S_x, n);
  apply(r->sum, f->w_y, S_y, n);

  /* the slips that they give, and the directions of these */
  reg u_c[MOST_REGS], u_z[MOST_REGS], t_x[MOST_REGS], t_y[MOST_REGS], rate[MOST_REGS],
      back[MOST_REGS], moved[MOST_REGS];
  EACH_REG(k, n) {
    const reg du_x = MADD(l->C_in_u_x, C[k], no_x * S_x[k]),
              du_z = MADD(l->Z_in_u_z, Z[k], l->S_in_u_z * S_y[k]);
    const reg u_x_k = s->u_x + du_x, u_z_k = s->u_z + du_z;
    const reg d_x = MADD(l->S_in_d, S_x[k], MADD(no_b, C[k], s->d_x)),
              d_y = MADD(l->S_in_d, S_y[k],
                         MADD(l->Z_in_d_y, Z[k], MADD(-l->length, nodes->X[k], s->d_y)));
    const reg i_u = reg_reciprocal_sqrt(MADD(u_x_k, u_x_k, MADD(u_z_k, u_z_k, TINY)));
    const reg i_d = reg_reciprocal_sqrt(MADD(d_x, d_x, MADD(d_y, d_y, TINY)));
    u_c[k] = u_x_k * i_u;
    u_z[k] = u_z_k * i_u;
    t_x[k] = d_x * i_d;
    t_y[k] = d_y * i_d;
    /* rho, the sine of the angle by which u has moved, and D rho: see the head */
    const reg rho = MADD(f->c[k], u_z[k], -(f->z[k] * u_c[k]));
    const reg D = (mu_b_kappa * i_u) * MADD(f->z[k], f->z[k], REAL(2.5));
    rate[k] = weighed(n, nodes, k, D * rho);
    REG_MOVE(going, &f->S_y[k], S_y[k]);
    REG_MOVE(going, &f->dx[k], du_x);
    REG_MOVE(going, &f->dz[k], du_z);
    REG_MOVE(going, &f->per_u[k], i_u);
  }

  /* u moves by rho less the integral of D rho: it is turned back by that; s follows. How far all
   * has moved */
  apply(r->sum, rate, back, n);
  EACH_REG(k, n) {
    const reg c = MADD(u_z[k], back[k], u_c[k]), z = MADD(-u_c[k], back[k], u_z[k]), x = z * t_x[k],
              y = z * t_y[k];
    moved[k] = MADD(a->mu, reg_abs(x - f->s_x[k]) + reg_abs(y - f->s_y[k]),
                    reg_abs(c - f->c[k]) + reg_abs(z - f->z[k]));
    REG_MOVE(going, &f->back[k], back[k]);
    REG_MOVE(going, &f->c[k], c);
    REG_MOVE(going, &f->z[k], z);
    REG_MOVE(going, &f->s_x[k], x);
    REG_MOVE(going, &f->s_y[k], y);
  }

  /* the error that is left, and the lanes where it is too large */
  const vreal per_moved = estimate_scale(n, turned) * l->mu_b *
                          v_fma(v_splat(CONTRACTION_CLOTH), a->mu_mu_b,
                                v_fma(CONTRACTION_Q * l->q, l->q, v_splat(CONTRACTION)));
  const vreal error = per_moved * largest(moved, n);
  f->error = v_select(going, error, f->error);
  f->going = going & v_not(v_less(error, ITERATION_SHARE * a->tolerance));
}

/* After the last iteration: the means over the step of c and sigma less their values at its start,
 * and w_x, w_y. They are computed from the change of u, not from its direction, so that small ones
 * keep their digits. */
always void end_iterations(int n, const gauss_rule *r, impulse_step *p, vreal *dc, vreal *dz) {
  const prediction *const g = p->g;
  const state *const s = p->s;
  directions *const f = &p->f;
  reg turned[MOST_REGS], lost[MOST_REGS];
  EACH_REG(k, n) {
    /* the sine of the angle by which u has turned since the start, and 1 - its cosine; turned
     * back as the iteration did */
    const reg u_x_k = s->u_x + f->dx[k], u_z_k = s->u_z + f->dz[k];
    const reg sine = MADD(g->c, f->dz[k], -g->z * f->dx[k]) * f->per_u[k],
              e_c = MADD(u_x_k, f->per_u[k], -g->c), e_z = MADD(u_z_k, f->per_u[k], -g->z);
    const reg drop = REAL(0.5) * MADD(e_c, e_c, e_z * e_z);
    turned[k] = weighed(n, &p->nodes, k, MADD(-f->back[k], 1 - drop, sine));
    lost[k] = weighed(n, &p->nodes, k, MADD(-f->back[k], sine, drop));
    f->w_x[k] = weighed(n, &p->nodes, k, f->s_x[k]);
    f->w_y[k] = weighed(n, &p->nodes, k, f->s_y[k]);
  }
  /* their means, as changes of c and z */
  const vreal sine = dot(r->whole, turned, n), drop = dot(r->whole, lost, n);
  *dc = v_fma(-g->z, sine, -g->c * drop);
  *dz = v_fma(g->c, sine, -g->z * drop);
}

/* ---- To the end of the collision, from a state nearby: a Taylor series, with slopes by the
 * equations ---- */

/* The directions c, sigma and s = sigma t at a state, and their slopes in p, by the equations.
 * bend_u, bend_d: a sixth of the second derivatives of the direction of u, about, and of s, at
 * most. fall: fraction of |u| that is lost per p. */
typedef struct end_slopes {
  vreal c, z, x, y, dc, dz, dx, dy, bend_u, bend_d, fall;
} end_slopes;

always end_slopes slopes_at_end(const problem *a, const state *s) {
  /* the directions */
  const vreal i_u = inverse_length(s->u_x, s->u_z), i_d = inverse_length(s->d_x, s->d_y);
  const vreal c = s->u_x * i_u, z = s->u_z * i_u, t_x = s->d_x * i_d, t_y = s->d_y * i_d;
  end_slopes end = {.c = c, .z = z, .x = z * t_x, .y = z * t_y};
  /* u' = -mu_b (turn_x, turn_z); the rate at which u turns */
  const vreal turn_z = REAL(2.5) * (a->kappa * z + a->mu * end.y),
              turn_x = REAL(3.5) * a->kappa * c + a->mu * end.x;
  const vreal turn_u = -a->mu_b * (z * turn_x - c * turn_z) * i_u;
  /* d' = (-d_x, d_y) but for the cloth's own friction, which is along d; the rate at which t
   * turns */
  const vreal d_x = a->mu_b * c, d_y = v_fma(a->spin * a->mu_b, z, v_splat(-1));
  const vreal turn_d = (t_x * d_y + t_y * d_x) * i_d;
  /* bounds of the second derivatives, and the rate at which |u| falls */
  const vreal most_fall = REAL(3.5) * a->kappa * a->mu_b * i_u, turn_rate = v_abs(turn_u);
  end.bend_u = (1 / REAL(6.0)) * turn_rate * v_fma(v_splat(2), most_fall, turn_rate);
  end.fall = a->mu_b * v_fma(c, turn_x, z * turn_z) * i_u;
  end.bend_d = v_select(has_no_slip(a, s), v_splat(0),
                        REAL(0.5) * z * v_fma(d_x, d_x, d_y * d_y) * (i_d * i_d));
  /* the slopes of c, z and of s = z t */
  end.dc = z * turn_u;
  end.dz = -c * turn_u;
  end.dx = end.dz * t_x - end.y * turn_d;
  end.dy = end.dz * t_y + end.x * turn_d;
  return end;
}

/* From *s, with s = (x, y) and its slopes in *here and a sixth of its second derivative in
 * third_x and third_y, to the end of the collision. Returns p from *s to there, which may be
 * negative.
 *
 * For a constant f, v' = 1 - f makes the balance of work a linear equation for v^2. The slope of
 * f, and the slope of that, are integrated over the p that the constant f leaves. */
always vreal extrapolate_to_end(const problem *a, const state *s, const end_slopes *slopes,
                                vreal third_x, vreal third_y, solution *out) {
  /* f and half of its slope here; the work to be returned if no more were done on friction, and
   * p to the end then */
  const vreal f = -a->mu_mu_b_y * slopes->y, half_df = (REAL(-0.5) * a->mu_mu_b_y) * slopes->dy,
              returned = work_returned(a, s->K_c, s->K);
  const vreal half_excess = REAL(0.5) * v_fma(-s->v, s->v, v_fma(a->e, a->e, returned));
  const vreal series = half_excess * v_reciprocal(v_max(s->v, v_splat(TINY)));
  /* the term of the change of f in int f dp; K, all further work on friction; v at the end */
  const vreal bend = (series * series) * v_fma(series, -a->mu_mu_b_y * third_y, half_df),
              K = v_fma(f, half_excess, bend * s->v);
  const vreal left = v_fma(v_splat(-2), K, returned),
              v = root(v_max(v_fma(a->e, a->e, left), v_splat(TINY)));
  /* p to the end, and the integrals up to there */
  const vreal dp = ((v - s->v) + bend) * v_reciprocal(1 - f), half = REAL(0.5) * dp;
  out->I_x = v_fma(dp, v_fma(dp, v_fma(dp, third_x, REAL(0.5) * slopes->dx), slopes->x), s->I_x);
  out->I_y = v_fma(dp, v_fma(dp, v_fma(dp, third_y, REAL(0.5) * slopes->dy), slopes->y), s->I_y);
  out->J_c = v_fma(dp, v_fma(half, slopes->dc, slopes->c - s->c_0), s->J_c);
  out->J_z = v_fma(dp, v_fma(half, slopes->dz, slopes->z - s->z_0), s->J_z);
  out->overshoot = v_fma(-a->mu_mu_b_y, out->I_y, left * v_reciprocal(v + a->e));
  out->K_c = s->K_c;
  out->stick = v_splat(-1);
  return dp;
}

/* ---- The step ---- */

/* p that the Taylor series may cover, over the length of the step before it. */
/* With twice or half of each, `carom-lab stress --draws 60000` shows the same errors; with half
 * of the second, 1 % more collisions of its regimes go to the precise solver. */
static const real MOST_EXTRAPOLATION = REAL(0.03);
static const real MOST_EXTRAPOLATION_TURN = REAL(0.1);
/* The fraction of |u| that may be lost there. After a step with four nodes, much more of |u| is
 * left. */
static const real MOST_FALL = REAL(0.5);

/* The state after a step of the length in *l, with the integrals of s_x and s_y over it, and of c
 * and sigma against their initial values; K at v = 0 does not change. */
always state state_after(const prediction *g, const coefficients *l, const state *s, vreal X,
                         vreal Y, vreal dC, vreal dZ, vreal K) {
  const vreal C = g->c + dC, Z = g->z + dZ;
  state end = *s;
  end.u_x = s->u_x + v_fma(l->C_in_u_x, C, -l->mu_mu_b * X);
  end.u_z = s->u_z + v_fma(l->Z_in_u_z, Z, l->S_in_u_z * Y);
  end.d_x = s->d_x + v_fma(l->S_in_d, X, -l->mu_b * C);
  end.d_y = (s->d_y - l->length) + v_fma(l->Z_in_d_y, Z, l->S_in_d * Y);
  end.v = s->v + v_fma(l->mu_mu_b_y, Y, l->length);
  end.K = s->K + K;
  end.J_c = v_fma(l->length, (g->c - s->c_0) + dC, s->J_c);
  end.J_z = v_fma(l->length, (g->z - s->z_0) + dZ, s->J_z);
  end.I_x = v_fma(l->length, X, s->I_x);
  end.I_y = v_fma(l->length, Y, s->I_y);
  return end;
}

/* K at v = 0 by parts, so that only w_y is interpolated, given v and the integral S of w_y up to a
 * point near v = 0, and that of S: int v w_y dX = v S - int S v' dX with v' = L + pull_y w_y. The
 * little that is left for a mean f. */
always vreal K_by_parts(const coefficients *l, const state *s, vreal f, vreal v, vreal S,
                        vreal int_S) {
  const vreal by_parts = v_fma(v_fma(REAL(0.5) * l->mu_mu_b_y, S, -v), S, l->length * int_S);
  return v_fma(l->mu_mu_b_y, by_parts, v_fma(REAL(-0.5) * f * (1 + f), v * v, s->K));
}

/* Over even nodes; the point near v = 0 is where a constant f, its mean, would put it. */
always vreal K_at_v_0(const gauss_rule *r, int n, const coefficients *l, const state *s, vreal f,
                      const reg *w_y) {
  const vreal x = v_min(v_max(-s->v * v_reciprocal((1 - f) * l->length), v_splat(0)), v_splat(1));
  reg once[MOST_REGS], twice[MOST_REGS];
  integrals_up_to(r, n, x, once);
  polynomials_at(r->twice, n, 2 * x - 1, twice);
  const vreal S = sum_of_products(once, w_y, n),
              v = v_fma(l->length, x, v_fma(l->mu_mu_b_y, S, s->v));
  return K_by_parts(l, s, f, v, S, (x * x) * sum_of_products(twice, w_y, n));
}

/* Over mapped nodes: S is a polynomial in x, the point is one step of Newton's method from
 * there, and the integral of S over X is taken by Gauss's rule up to it. */
always vreal K_at_v_0_mapped(bool turned, const gauss_rule *r, int n, const node_map *map,
                             const coefficients *l, const state *s, vreal f, const reg *w_y) {
  const vreal per = v_reciprocal((1 - f) * l->length), zero = v_splat(0), unit = v_splat(1);
  vreal S_power[MOST_NODES], X = v_min(v_max(-s->v * per, zero), unit), x, S, v;
  sum_polynomials(r->powers, n, w_y, S_power);
  /* the point: x, S and v there */
  lanes_rolled for (int i = 0; i < 2; i++) {
    x = x_at(turned, map, X);
    S = x * polynomial(S_power, n, 2 * x - 1);
    v = v_fma(l->length, X, v_fma(l->mu_mu_b_y, S, s->v));
    X = i == 0 ? v_min(v_max(X - v * per, zero), unit) : X;
  }
  /* the rule from 0 to x: int S dX */
  mapped_nodes up_to;
  lay_nodes(turned, r, n, map, x, &up_to);
  reg slope[MOST_REGS];
  EACH_REG(k, n) {
    const reg xi = x * AT(r->node, k);
    slope[k] = up_to.weight[k] * (xi * polynomial_at_nodes(S_power, n, 2 * xi - 1));
  }
  return K_by_parts(l, s, f, v, S, dot(r->whole, slope, n));
}

/* The same at the end of a step of four nodes, on which t hardly turns: by the polynomials,
 * without roots. */
always end_slopes slopes_by_nodes(const gauss_rule *r, int n, vreal per_length,
                                  const directions *f) {
  const vreal twice = 2 * per_length; /* `bend` is half a slope */
  return (end_slopes){.c = dot(r->end, f->c, n),
                      .z = dot(r->end, f->z, n),
                      .x = dot(r->end, f->s_x, n),
                      .y = dot(r->end, f->s_y, n),
                      .dc = twice * dot(r->bend, f->c, n),
                      .dz = twice * dot(r->bend, f->z, n),
                      .dx = twice * dot(r->bend, f->s_x, n),
                      .dy = twice * dot(r->bend, f->s_y, n)};
}

always const gauss_rule *rule_of(int n) {
  if (n == 8)
    return &gauss_8;
  return n == 6 ? &gauss_6 : &gauss_4;
}

/* A step from *s, with its first directions. turn: of turned nodes, else NULL. */
always void start_step(int n, const problem *a, const prediction *g, const state *s, vreal length,
                       const turn_step *turn, impulse_step *p) {
  p->a = a;
  p->g = g;
  p->s = s;
  p->l = coefficients_of(a, g, length);
  if (!is_mapped(n))
    EACH_REG(k, n) p->nodes.X[k] = SPREAD(AT(rule_of(n)->node, k));
  else {
    p->map = turn != NULL ? turned_map(turn, length) : graded_map(p->l.q);
    lay_nodes(turn != NULL, rule_of(n), n, &p->map, v_splat(1), &p->nodes);
  }
  predict_directions(n, turn != NULL, p);
  p->f.going = v_all();
}

/* After the iteration: *next becomes the state behind the step. In the lanes of `last` that is
 * near the end of the collision, and *out becomes the solution. Returns an estimate of the
 * error, in p; infinite if the end of the collision is not near. next, out: NULL if not needed. */
always vreal end_step(int n, bool turned, impulse_step *p, vmask last, state *next, solution *out) {
  const gauss_rule *r = rule_of(n);
  const problem *const a = p->a;
  const prediction *const g = p->g;
  const state *const s = p->s;
  const coefficients l = p->l;
  directions *const f = &p->f;
  vreal dC, dZ;
  end_iterations(n, r, p, &dC, &dZ);

  /* the integrals over the whole step: K = int v f dp, S_x, S_y */
  reg work[MOST_REGS];
  EACH_REG(k, n)
  work[k] = -(l.mu_mu_b_y * f->w_y[k]) *
            MADD(l.mu_mu_b_y, f->S_y[k], MADD(l.length, p->nodes.X[k], s->v));
  const vreal X = dot(r->whole, f->w_x, n), Y = dot(r->whole, f->w_y, n);
  state end = state_after(g, &l, s, X, Y, dC, dZ, dot(r->whole, work, n));

  /* K at v = 0, if the step passes it */
  vmask passes = v_not(s->restitution) & v_less(v_splat(0), end.v);
  if (out != NULL)
    passes = passes | (v_not(s->restitution) & last);
  if (!is_mapped(n) || v_any(passes)) {
    const vreal f_mean =
        /* the predicted one is known before the iteration ends */
        -a->mu_mu_b_y * (!is_mapped(n) ? g->z * g->t_y : Y);
    const vreal K_c = !is_mapped(n) ? K_at_v_0(r, n, &l, s, f_mean, f->w_y)
                                    : K_at_v_0_mapped(turned, r, n, &p->map, &l, s, f_mean, f->w_y);
    end.K_c = v_select(passes, K_c, s->K_c);
  }
  end.restitution = s->restitution | passes;

  const vreal per_length = v_reciprocal(l.length);
  const end_slopes at_end = n > 4 ? slopes_at_end(a, &end) : slopes_by_nodes(r, n, per_length, f);
  vreal error = f->error;
  if (n > 4) {
    /* the defect: by how much the polynomials miss the direction of u at the end; its square is
     * the error there */
    const vreal defect =
        v_abs(dot(r->end, f->c, n) - at_end.c) + v_abs(dot(r->end, f->z, n) - at_end.z);
    error = v_fma(4 * l.mu_b, defect * defect, error);
  }
  if (next != NULL)
    *next = end;
  if (out == NULL || !v_any(last))
    return error;

  /* on to the end of the collision, for even nodes with the second derivatives of s */
  vreal third_x = v_splat(0), third_y = third_x;
  if (!is_mapped(n)) {
    third_x = per_length * per_length * dot(r->third, f->s_x, n);
    third_y = per_length * per_length * dot(r->third, f->s_y, n);
  }
  const vreal dp = v_abs(extrapolate_to_end(a, &end, &at_end, third_x, third_y, out));

  /* the truncation error of the series: after four nodes by how much their polynomials miss s,
   * else its next terms for u and s
   */
  vreal left_out;
  if (n == 4) {
    const vreal sigma_d =
        at_end.z *
        v_rough_reciprocal_sqrt(v_fma(end.d_x, end.d_x, v_fma(end.d_y, end.d_y, v_splat(TINY))));
    const vreal missed =
        v_abs(v_fma(-sigma_d, end.d_x, at_end.x)) + v_abs(v_fma(-sigma_d, end.d_y, at_end.y));
    left_out = dp * v_select(has_no_slip(a, &end), v_splat(0), a->mu_mu_b * missed);
  } else
    left_out = dp * (dp * dp) * v_fma(a->mu_b, at_end.bend_u, a->mu_mu_b * at_end.bend_d);
  error = error + v_select(last, left_out, v_splat(0));

  /* the series must not lead far, nor may |u| vanish on it, which the error estimates of a
   * planar motion do not see: there u does not turn, and bend_u is 0 */
  vmask in_reach = v_less(dp, (turned ? MOST_EXTRAPOLATION_TURN : MOST_EXTRAPOLATION) * l.length);
  if (n > 4)
    in_reach = in_reach & v_less(dp * at_end.fall, v_splat(MOST_FALL));
  return v_select(in_reach | v_not(last), error, v_splat(HUGE_VALF));
}

/* A complete step, with at most this many iterations. */
always vreal take_impulse_step(int n, int most, const problem *a, const prediction *g,
                               const state *s, vreal length, const turn_step *turn, vmask last,
                               state *next, solution *out) {
  impulse_step p;
  start_step(n, a, g, s, length, turn, &p);
  for (int i = 0; i < most && v_any(p.f.going); i++)
    iterate_directions(n, turn != NULL, rule_of(n), &p);
  return end_step(n, turn != NULL, &p, last, next, out);
}

/* The length of a step to the end for the mean f, where to_end is p to the end without work on
 * friction. */
always vreal length_to_end(const problem *a, const prediction *g, vreal to_end) {
  const vreal f = -a->mu_mu_b_y * g->z * g->t_y;
  return to_end * v_fma(f, 1 + f, v_splat(1));
}

#endif
