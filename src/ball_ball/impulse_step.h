/* The step in the normal impulse, over Gauss nodes that lie as directions.h says. It leaves a part of the way, or comes near
 * the end of the collision, and from there by a Taylor series to the end. */
#ifndef CAROM_SRC_BALL_BALL_IMPULSE_STEP_H
#define CAROM_SRC_BALL_BALL_IMPULSE_STEP_H

#include "ball_ball/directions.h"
#include "ball_ball/rules.h"

/* ---- From a state near the end of the collision to the end: a Taylor series, with slopes by the equations ---- */

/* The directions c, sigma and s = sigma t at a state, and their slopes in p, by the equations. bend_u, bend_d: a sixth of the
 * second derivatives of the direction of u, about, and of s, at most. fall: share of |u| that is lost per p. */
typedef struct end_slopes {
  vreal c, z, x, y, dc, dz, dx, dy, bend_u, bend_d, fall;
} end_slopes;

always end_slopes slopes_at_end(const problem *a, const state *s) {
  const vreal i_u = inverse_length(s->u_x, s->u_z), i_d = inverse_length(s->d_x, s->d_y);
  const vreal c = s->u_x * i_u, z = s->u_z * i_u, t_x = s->d_x * i_d, t_y = s->d_y * i_d;
  end_slopes end = {.c = c, .z = z, .x = z * t_x, .y = z * t_y};
  const vreal turn_z = 2.5f * (a->kappa * z + a->mu * end.y), turn_x = 3.5f * a->kappa * c + a->mu * end.x;
  const vreal turn_u = -a->mu_b * (z * turn_x - c * turn_z) * i_u;
  const vreal d_x = a->mu_b * c, d_y = v_fma(a->spin * a->mu_b, z, v_splat(-1)); /* d', without the cloth's own pull */
  const vreal turn_d = (t_x * d_y + t_y * d_x) * i_d;
  const vreal most_fall = 3.5f * a->kappa * a->mu_b * i_u, turn_rate = v_abs(turn_u);
  end.bend_u = (1 / 6.0f) * turn_rate * v_fma(v_splat(2), most_fall, turn_rate);
  end.fall = a->mu_b * v_fma(c, turn_x, z * turn_z) * i_u;
  end.bend_d = v_select(has_no_slip(a, s), v_splat(0), 0.5f * z * v_fma(d_x, d_x, d_y * d_y) * (i_d * i_d));
  end.dc = z * turn_u;
  end.dz = -c * turn_u;
  end.dx = end.dz * t_x - end.y * turn_d;
  end.dy = end.dz * t_y + end.x * turn_d;
  return end;
}

/* From *s, with s = (x, y) and its slopes in *here and a sixth of its second derivative in third_x and third_y, to the end of
 * the collision. Returns the way there, which may be negative.
 *
 * For a constant f the balance of work is a linear equation for v^2; the slope of f, and of that, are taken along the way that
 * the constant f leaves. */
always vreal extrapolate_to_end(const problem *a, const state *s, const end_slopes *here, vreal third_x, vreal third_y,
                                solution *out) {
  const vreal f = -a->mu_mu_b_y * here->y, half_df = (-0.5f * a->mu_mu_b_y) * here->dy,
              returned = work_returned(a, s->K_c, s->K);
  const vreal half_excess = 0.5f * v_fma(-s->v, s->v, v_fma(a->e, a->e, returned));
  const vreal near = half_excess * v_reciprocal(v_max(s->v, v_splat(TINY)));
  const vreal bend = (near * near) * v_fma(near, -a->mu_mu_b_y * third_y, half_df), K = v_fma(f, half_excess, bend * s->v);
  const vreal left = v_fma(v_splat(-2), K, returned), v = root(v_max(v_fma(a->e, a->e, left), v_splat(TINY)));
  const vreal way = ((v - s->v) + bend) * v_reciprocal(1 - f), half = 0.5f * way;
  out->I_x = v_fma(way, v_fma(way, v_fma(way, third_x, 0.5f * here->dx), here->x), s->I_x);
  out->I_y = v_fma(way, v_fma(way, v_fma(way, third_y, 0.5f * here->dy), here->y), s->I_y);
  out->J_c = v_fma(way, v_fma(half, here->dc, here->c - s->c_0), s->J_c);
  out->J_z = v_fma(way, v_fma(half, here->dz, here->z - s->z_0), s->J_z);
  out->overshoot = v_fma(-a->mu_mu_b_y, out->I_y, left * v_reciprocal(v + a->e));
  out->K_c = s->K_c;
  out->stick = v_splat(-1);
  return way;
}

/* ---- The step ---- */

/* How far the Taylor series is trusted, over the length of the step before it. */
static const float MOST_EXTRAPOLATION = 0.03f, MOST_EXTRAPOLATION_TURN = 0.1f;
/* The share of |u| that may be lost on the way of that series. After a step with four nodes, much more of |u| is left. */
static const float MOST_FALL = 0.5f;

/* The state behind a step of the length in *l, with the integrals of s_x and s_y over it, and those of c and sigma against
 * their values at first; K at v = 0 stays what it is. */
always state state_after(const prediction *g, const coefficients *l, const state *s, vreal X, vreal Y, vreal dC, vreal dZ,
                         vreal K) {
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

/* K at v = 0 by parts, so that nothing but w_y is interpolated, given v and the integral S of w_y up to a point near v = 0, and
 * that of S: int v w_y dX = v S - int S v' dX with v' = L + pull_y w_y. The little that is left for a mean f. */
always vreal K_by_parts(const coefficients *l, const state *s, vreal f, vreal v, vreal S, vreal int_S) {
  const vreal by_parts = v_fma(v_fma(0.5f * l->mu_mu_b_y, S, -v), S, l->length * int_S);
  return v_fma(l->mu_mu_b_y, by_parts, v_fma(-0.5f * f * (1 + f), v * v, s->K));
}

/* Over even nodes, that point being where the mean f lets v = 0 be. */
always vreal K_at_v_0(const gauss_rule *r, int n, const coefficients *l, const state *s, vreal f, const reg *w_y) {
  const vreal x = v_min(v_max(-s->v * v_reciprocal((1 - f) * l->length), v_splat(0)), v_splat(1));
  reg once[MOST_REGS], twice[MOST_REGS];
  integrals_up_to(r, n, x, once);
  polynomials_at(r->twice, n, 2 * x - 1, twice);
  const vreal S = sum_of_products(once, w_y, n), v = v_fma(l->length, x, v_fma(l->mu_mu_b_y, S, s->v));
  return K_by_parts(l, s, f, v, S, (x * x) * sum_of_products(twice, w_y, n));
}

/* Over others: S is a polynomial in x, that point one of Newton's steps from there, and the integral of S over X is taken by
 * Gauss's rule up to it. */
always vreal K_at_v_0_mapped(bool turned, const gauss_rule *r, int n, const node_map *map, const coefficients *l,
                             const state *s, vreal f, const reg *w_y) {
  const vreal per = v_reciprocal((1 - f) * l->length), zero = v_splat(0), one = v_splat(1);
  vreal S_power[MOST_NODES], X = v_min(v_max(-s->v * per, zero), one), x, S, v;
  sum_polynomials(r->powers, n, w_y, S_power);
  lanes_rolled for (int i = 0; i < 2; i++) {
    x = x_at(turned, map, X);
    S = x * polynomial(S_power, n, 2 * x - 1);
    v = v_fma(l->length, X, v_fma(l->mu_mu_b_y, S, s->v));
    X = i == 0 ? v_min(v_max(X - v * per, zero), one) : X;
  }
  mapped_nodes up_to;
  lay_nodes(turned, r, n, map, x, &up_to);
  reg slope[MOST_REGS];
  EACH_REG(k, n) {
    const reg xi = x * AT(r->node, k);
    slope[k] = up_to.weight[k] * (xi * polynomial_at_nodes(S_power, n, 2 * xi - 1));
  }
  return K_by_parts(l, s, f, v, S, dot(r->all, slope, n));
}

/* At the end of a step whose four nodes will do, since t hardly turns: arrive() without its roots, by the polynomials. */
always end_slopes slopes_by_nodes(const gauss_rule *r, int n, vreal per_length, const directions *f) {
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
  return n == 8 ? &gauss_8 : n == 6 ? &gauss_6 : &gauss_4;
}

/* `turn`: the plan of turned nodes, else NULL. */
always void start_step(int n, const problem *a, const prediction *g, const state *s, vreal length, const turn_step *turn,
                       impulse_step *p) {
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

/* *next becomes the state behind the step; in the lanes of `last` that is near the end of the collision, and *out becomes the
 * solution. Returns an estimate of the error, in p; infinite if the end is not near. */
always vreal end_step(int n, bool turned, impulse_step *p, vmask last, state *next, solution *out) {
  const gauss_rule *r = rule_of(n);
  const problem *const a = p->a;
  const prediction *const g = p->g;
  const state *const s = p->s;
  const coefficients l = p->l;
  directions *const f = &p->f;
  vreal dC, dZ;
  end_iterations(n, r, p, &dC, &dZ);

  /* the whole step */
  reg work[MOST_REGS];
  EACH_REG(k, n) work[k] = -(l.mu_mu_b_y * f->w_y[k]) * MADD(l.mu_mu_b_y, f->S_y[k], MADD(l.length, p->nodes.X[k], s->v));
  const vreal X = dot(r->all, f->w_x, n), Y = dot(r->all, f->w_y, n);
  state end = state_after(g, &l, s, X, Y, dC, dZ, dot(r->all, work, n));

  /* K at v = 0 */
  vmask passes = v_not(s->restitution) & v_less(v_splat(0), end.v);
  if (out != NULL)
    passes = passes | (v_not(s->restitution) & last);
  if (!is_mapped(n) || v_any(passes)) {
    const vreal f_mean =
        -a->mu_mu_b_y * (!is_mapped(n) ? g->z * g->t_y : Y); /* that of the prediction is known before the nodes */
    const vreal K_c =
        !is_mapped(n) ? K_at_v_0(r, n, &l, s, f_mean, f->w_y) : K_at_v_0_mapped(turned, r, n, &p->map, &l, s, f_mean, f->w_y);
    end.K_c = v_select(passes, K_c, s->K_c);
  }
  end.restitution = s->restitution | passes;

  const vreal per_length = v_reciprocal(l.length);
  const end_slopes at_end = n > 4 ? slopes_at_end(a, &end) : slopes_by_nodes(r, n, per_length, f);
  vreal error = f->error;
  if (n > 4) {
    /* the defect of the polynomials at the end, which is the first coefficient that the nodes leave out */
    const vreal defect = v_abs(dot(r->end, f->c, n) - at_end.c) + v_abs(dot(r->end, f->z, n) - at_end.z);
    error = v_fma(4 * l.mu_b, defect * defect, error);
  }
  if (next != NULL)
    *next = end;
  if (out == NULL || !v_any(last))
    return error;

  /* to the end of the collision */
  vreal third_x = v_splat(0), third_y = third_x;
  if (!is_mapped(n)) {
    third_x = per_length * per_length * dot(r->third, f->s_x, n);
    third_y = per_length * per_length * dot(r->third, f->s_y, n);
  }
  const vreal way = v_abs(extrapolate_to_end(a, &end, &at_end, third_x, third_y, out));
  /* what the series leaves out: of four nodes, by how far their polynomials miss s; else its third terms for u and s */
  vreal left_out;
  if (n == 4) {
    const vreal sigma_d = at_end.z * v_rough_reciprocal_sqrt(v_fma(end.d_x, end.d_x, v_fma(end.d_y, end.d_y, v_splat(TINY))));
    const vreal missed = v_abs(v_fma(-sigma_d, end.d_x, at_end.x)) + v_abs(v_fma(-sigma_d, end.d_y, at_end.y));
    left_out = way * v_select(has_no_slip(a, &end), v_splat(0), a->mu_mu_b * missed);
  } else
    left_out = way * (way * way) * v_fma(a->mu_b, at_end.bend_u, a->mu_mu_b * at_end.bend_d);
  error = error + v_select(last, left_out, v_splat(0));
  vmask in_reach = v_less(way, (turned ? MOST_EXTRAPOLATION_TURN : MOST_EXTRAPOLATION) * l.length);
  /* The balls must not stick before the end. In planar motion u does not turn, so bend_u is 0 up to there. */
  if (n > 4)
    in_reach = in_reach & v_less(way * at_end.fall, v_splat(MOST_FALL));
  return v_select(in_reach | v_not(last), error, v_splat(HUGE_VALF));
}

/* All of it, with so many iterations at most. */
always vreal take_impulse_step(int n, int most, const problem *a, const prediction *g, const state *s, vreal length,
                               const turn_step *turn, vmask last, state *next, solution *out) {
  impulse_step p;
  start_step(n, a, g, s, length, turn, &p);
  for (int i = 0; i < most && v_any(p.f.going); i++)
    iterate_directions(n, turn != NULL, rule_of(n), &p);
  return end_step(n, turn != NULL, &p, last, next, out);
}

/* The length of a step to the end, of which `to_end` is the way that would be left without work on friction. */
always vreal length_to_end(const problem *a, const prediction *g, vreal to_end) {
  const vreal f = -a->mu_mu_b_y * g->z * g->t_y;
  return to_end * v_fma(f, 1 + f, v_splat(1));
}

#endif
