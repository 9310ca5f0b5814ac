/* The step in the normal impulse to the end of the collision, where the direction of the cloth slip is smooth: Gauss nodes in p.
 *
 * The step is laid to where the end would be for the friction half way; the little beyond follows by two terms of a Taylor
 * series, whose coefficients are those of the polynomials through the nodes. */
#ifndef CAROM_SRC_BALL_BALL_END_STEP_H
#define CAROM_SRC_BALL_BALL_END_STEP_H

#include "ball_ball/directions.h"
#include "ball_ball/rules.h"

/* How far beyond its end, over its length, the Taylor series is trusted; how much v^2 may differ from e^2, over e^2. */
static const float MOST_BEYOND = 0.03f, MOST_RISE = 0.05f;

/* sqrt(1 + x) - 1 for |x| < 0.05. */
always vreal root_beyond_1(vreal x) {
  return x * v_fma(x * x, v_fma(x, v_splat(-5 / 128.0f), v_splat(1 / 16.0f)), v_fma(x, v_splat(-1 / 8.0f), v_splat(0.5f)));
}

/* From *s, where *g has been predicted for the way `to_end` that would be left without work on friction. Returns the estimate of
 * the error of the iteration, in p; infinite if the step does not end near the end of the collision. */
always vreal end_step(int n, int iterations, const problem *a, const prediction *g, const state *s, vreal to_end, solution *out) {
  const gauss_rule *r = n == 8 ? &gauss_8 : &gauss_4;
  const vreal f_0 = -a->pull_y * g->z * g->t_y, length = to_end * v_fma(f_0, 1 + f_0, v_splat(1));
  const step_law l = law_of(a, g, length);
  mesh m;
  EACH_REG(k, n) m.X[k] = SPREAD(AT(r->node, k));
  directions f;
  find_directions(n, iterations, false, r, a, g, s, &l, &m, &f);

  /* the whole step */
  reg work[MOST_REGS];
  EACH_REG(k, n) work[k] = -(l.pull_y * f.s_y[k]) * MADD(l.pull_y, f.S_y[k], MADD(length, m.X[k], s->v));
  const vreal X = dot(r->all, f.s_x, n), Y = dot(r->all, f.s_y, n), K = s->K + dot(r->all, work, n);
  const vreal v = s->v + v_fma(l.pull_y, Y, length);
  vreal c, z;
  mean_turning(r, n, g, &f, &c, &z);

  /* K at v = 0: at x_c near it, by parts, so that nothing but s_y is interpolated: int v s dx = v S - int S v' dx with S for
   * int s dx and v' = L + pull_y s; from there by one more term */
  const vreal per = v_reciprocal((1 - f_0) * length), x_c = v_min(v_max(-s->v * per, v_splat(0)), v_splat(1));
  reg once[MOST_REGS], twice[MOST_REGS];
  integrals_up_to(r, n, x_c, once);
  polynomials_at(r->twice, n, 2 * x_c - 1, twice);
  const vreal S_c = sum_of_products(once, f.s_y, n), int_S = (x_c * x_c) * sum_of_products(twice, f.s_y, n);
  const vreal v_c = v_fma(length, x_c, v_fma(l.pull_y, S_c, s->v));
  const vreal by_parts = v_fma(v_fma(0.5f * l.pull_y, S_c, -v_c), S_c, length * int_S);
  const vreal on_step = v_fma(l.pull_y, by_parts, v_fma(-0.5f * f_0 * (1 + f_0), v_c * v_c, s->K));
  out->K_c = v_select(s->restitution, s->K_c, on_step);

  /* beyond it: for a constant f the balance of work is a quadratic equation, whose root leaves v^2 = aim - f (aim - v^2) with
   * aim for v^2 at the end if no more work is done; the slope of f adds its part */
  const vreal per_e = v_reciprocal(a->e), per_length = per * (1 - f_0);
  const vreal x = work_returned(a, out->K_c, K), excess = v_fma(a->e, a->e, x) - v * v, near = 0.5f * excess * per_e;
  const vreal y_1 = dot(r->end, f.s_y, n), y_2 = dot(r->bend, f.s_y, n), f_1 = -a->pull_y * y_1;
  const vreal bend = -a->pull_y * per_length * y_2 * (near * near), work_beyond = v_fma(0.5f * f_1, excess, bend * a->e);
  const vreal rise = v_fma(v_splat(-2), work_beyond, x) * (per_e * per_e), gain = a->e * root_beyond_1(rise);
  const vreal beyond = ((a->e + gain) - v + bend) * v_fma(f_1, 1 + f_1, v_splat(1)), xi = beyond * per_length;

  out->I_x = s->I_x + v_fma(beyond, v_fma(xi, dot(r->bend, f.s_x, n), dot(r->end, f.s_x, n)), length * X);
  out->I_y = s->I_y + v_fma(beyond, v_fma(xi, y_2, y_1), length * Y);
  out->extra = v_fma(-a->pull_y, out->I_y, gain);
  const vreal c_1 = v_fma(xi, dot(r->bend, f.c, n), dot(r->end, f.c, n)), z_1 = v_fma(xi, dot(r->bend, f.z, n), dot(r->end, f.z, n));
  out->J_c = s->J_c + v_fma(length, (g->c - s->c_0) + c, beyond * (c_1 - s->c_0));
  out->J_z = s->J_z + v_fma(length, (g->z - s->z_0) + z, beyond * (z_1 - s->z_0));
  out->stick = v_splat(-1);
  const vmask in_reach = v_less(v_abs(xi), v_splat(MOST_BEYOND)) & v_less(v_abs(rise), v_splat(MOST_RISE));
  return v_select(in_reach, iteration_error(a, &l, f.moved), v_splat(HUGE_VALF));
}

#endif
