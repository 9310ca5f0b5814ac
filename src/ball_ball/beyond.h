/* From a state near the end of the collision to the end: a Taylor series, whose slopes are those of the equations. */
#ifndef CAROM_SRC_BALL_BALL_BEYOND_H
#define CAROM_SRC_BALL_BALL_BEYOND_H

#include "ball_ball/problem.h"

/* The directions c, sigma and s = sigma t at a state, and their slopes in p, by the equations. bend_u, bend_d: a sixth of the
 * second derivatives of the direction of u, about, and of s, at most. fall: share of |u| that is lost per p. */
typedef struct arrival {
  vreal c, z, x, y, dc, dz, dx, dy, bend_u, bend_d, fall;
} arrival;

always arrival arrive(const problem *a, const state *s) {
  const vreal i_u = inverse_length(s->u_x, s->u_z), i_d = inverse_length(s->d_x, s->d_y);
  const vreal c = s->u_x * i_u, z = s->u_z * i_u, t_x = s->d_x * i_d, t_y = s->d_y * i_d;
  arrival end = {.c = c, .z = z, .x = z * t_x, .y = z * t_y};
  const vreal turn_z = 2.5f * (a->kappa * z + a->mu * end.y), turn_x = 3.5f * a->kappa * c + a->mu * end.x;
  const vreal turn_u = -a->mu_b * (z * turn_x - c * turn_z) * i_u;
  const vreal d_x = a->mu_b * c, d_y = v_fma(a->spin * a->mu_b, z, v_splat(-1)); /* d', without the cloth's own pull */
  const vreal turn_d = (t_x * d_y + t_y * d_x) * i_d;
  const vreal most_fall = 3.5f * a->kappa * a->mu_b * i_u, turning = v_abs(turn_u);
  end.bend_u = (1 / 6.0f) * turning * v_fma(v_splat(2), most_fall, turning);
  end.fall = a->mu_b * v_fma(c, turn_x, z * turn_z) * i_u;
  end.bend_d = v_select(is_at_rest(a, s), v_splat(0), 0.5f * z * v_fma(d_x, d_x, d_y * d_y) * (i_d * i_d));
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
always vreal finish(const problem *a, const state *s, const arrival *here, vreal third_x, vreal third_y, solution *out) {
  const vreal f = -a->pull_y * here->y, half_df = (-0.5f * a->pull_y) * here->dy, returned = work_returned(a, s->K_c, s->K);
  const vreal half_excess = 0.5f * v_fma(-s->v, s->v, v_fma(a->e, a->e, returned));
  const vreal near = half_excess * v_reciprocal(v_max(s->v, v_splat(TINY)));
  const vreal bend = (near * near) * v_fma(near, -a->pull_y * third_y, half_df), K = v_fma(f, half_excess, bend * s->v);
  const vreal left = v_fma(v_splat(-2), K, returned), v = root(v_max(v_fma(a->e, a->e, left), v_splat(TINY)));
  const vreal way = ((v - s->v) + bend) * v_reciprocal(1 - f), half = 0.5f * way;
  out->I_x = v_fma(way, v_fma(way, v_fma(way, third_x, 0.5f * here->dx), here->x), s->I_x);
  out->I_y = v_fma(way, v_fma(way, v_fma(way, third_y, 0.5f * here->dy), here->y), s->I_y);
  out->J_c = v_fma(way, v_fma(half, here->dc, here->c - s->c_0), s->J_c);
  out->J_z = v_fma(way, v_fma(half, here->dz, here->z - s->z_0), s->J_z);
  out->extra = v_fma(-a->pull_y, out->I_y, left * v_reciprocal(v + a->e));
  out->K_c = s->K_c;
  out->stick = v_splat(-1);
  return way;
}

#endif
