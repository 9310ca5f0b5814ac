/* The step in the normal impulse that leaves a part of the way, over eight Gauss nodes. Where the cloth slip turns (TURN), the nodes are
 * drawn together there, and the step may also be the last.
 *
 * At a turn, the cloth slip passes zero at a distance delta (in p), at p_t; its direction t turns there within a few delta. With
 * p - p_t = delta sinh(xi), t dp/dxi is nearly a polynomial in xi, the variable of the rule. */
#ifndef CAROM_SRC_BALL_BALL_PART_STEP_H
#define CAROM_SRC_BALL_BALL_PART_STEP_H

#include "ball_ball/directions.h"
#include "ball_ball/rules.h"

enum { PART_NODES = 8 };

/* A turn, as seen from a state: p_t and delta; the length of the step; what f will be on it, in the mean, were the way straight. */
typedef struct turn_plan {
  vreal at, width, length, mean_f;
} turn_plan;

/* sinh(xi) runs from `from` to `to` along the step, and xi by `range` from `low` on. */
typedef struct turn_mesh {
  mesh nodes;
  vreal from, low, range, per_width; /* per_width: L / delta */
} turn_mesh;

always turn_mesh lay_nodes(const gauss_rule *r, const turn_plan *p) {
  const vreal per_delta = v_reciprocal(p->width), half = 0.5f * p->width * v_reciprocal(p->length);
  turn_mesh m = {.from = -p->at * per_delta, .per_width = p->length * per_delta};
  m.low = inverse_sinh(m.from);
  m.range = inverse_sinh((p->length - p->at) * per_delta) - m.low;
  const vreal slope = m.range * half, start = 2 * m.from * half;
  EACH_REG(k, PART_NODES) {
    const reg e = exponential(MADD(m.range, AT(r->node, k), m.low)), i = reg_reciprocal(e);
    m.nodes.X[k] = MADD(half, e - i, -start);
    m.nodes.weight[k] = slope * (e + i);
  }
  return m;
}

/* The node variable where X is `share`. */
always vreal node_of_share(const turn_mesh *m, vreal share) {
  return (inverse_sinh(v_fma(share, m->per_width, m->from)) - m->low) * v_reciprocal(m->range);
}

/* The directions at the end of the step, and their slopes, by the equations. */
typedef struct arrival {
  vreal c, z, x, y, dc, dz, dx, dy;
} arrival;

always arrival arrive(const problem *a, const state *s) {
  const vreal i_u = inverse_length(s->u_x, s->u_z), i_d = inverse_length(s->d_x, s->d_y);
  const vreal c = s->u_x * i_u, z = s->u_z * i_u, t_x = s->d_x * i_d, t_y = s->d_y * i_d;
  arrival end = {.c = c, .z = z, .x = z * t_x, .y = z * t_y};
  const vreal turn_z = 2.5f * (a->kappa * z + a->mu * end.y), turn_x = 3.5f * a->kappa * c + a->mu * end.x;
  const vreal turn_u = -a->mu_b * (z * turn_x - c * turn_z) * i_u, turn_d = (t_x * (a->spin * a->mu_b * z - 1) + t_y * a->mu_b * c) * i_d;
  end.dc = z * turn_u;
  end.dz = -c * turn_u;
  end.dx = end.dz * t_x - end.y * turn_d;
  end.dy = end.dz * t_y + end.x * turn_d;
  return end;
}

/* From *s on for the length of the plan, for which *g has been predicted. *next becomes the state behind the step; in the lanes of
 * `last` the length is that to the end without work on friction, and *out becomes the solution. `turn`: by nodes drawn together, which
 * may be the last step. Returns an estimate of the error, in p. */
always vreal part_step(int iterations, bool turn, const problem *a, const prediction *g, const turn_plan *p, vmask last, const state *s,
                       state *next, solution *out) {
  enum { n = PART_NODES };
  const gauss_rule *r = &gauss_8;
  const vreal length = turn ? v_select(last, p->length * v_fma(p->mean_f, 1 + p->mean_f, v_splat(1)), p->length) : p->length;
  turn_mesh m;
  if (turn) {
    const turn_plan laid = {.at = p->at, .width = p->width, .length = length};
    m = lay_nodes(r, &laid);
  } else
    EACH_REG(k, n) m.nodes.X[k] = SPREAD(AT(r->node, k));
  const step_law l = law_of(a, g, length);
  directions f;
  find_directions(n, iterations, turn, r, a, g, s, &l, &m.nodes, &f);

  /* the whole step */
  reg work[MOST_REGS];
  EACH_REG(k, n) work[k] = -(l.pull_y * f.w_y[k]) * (s->v + MADD(length, m.nodes.X[k], l.pull_y * f.S_y[k]));
  const vreal X = dot(r->all, f.w_x, n), Y = dot(r->all, f.w_y, n);
  vreal dC, dZ;
  mean_turning(r, n, g, &f, &dC, &dZ);
  const vreal C = g->c + dC, Z = g->z + dZ;
  state end = *s;
  end.u_x = s->u_x + (l.k_x * C - l.pull * X);
  end.u_z = s->u_z + (l.k_z * Z + l.k_y * Y);
  end.d_x = s->d_x + (l.on_d * X - l.mu_b * C);
  end.d_y = (s->d_y - length) + (l.on_y * Z + l.on_d * Y);
  end.v = s->v + (length + l.pull_y * Y);
  end.K = s->K + dot(r->all, work, n);
  end.J_c = s->J_c + length * ((g->c - s->c_0) + dC);
  end.J_z = s->J_z + length * ((g->z - s->z_0) + dZ);
  end.I_x = s->I_x + length * X;
  end.I_y = s->I_y + length * Y;

  /* K at v = 0: on the polynomials, at the second of Newton's points, and from there by one more term */
  vmask passes = v_not(s->restitution) & v_less(v_splat(0), end.v);
  if (turn)
    passes = passes | (v_not(s->restitution) & last);
  if (v_any(passes)) {
    const vreal mean = -a->pull_y * Y, per = v_reciprocal((1 - mean) * length);
    vreal share = -s->v * per, v_c;
    reg up_to[MOST_REGS];
    lanes_rolled for (int i = 0; i < 2; i++) {
      share = v_min(v_max(share, v_splat(0)), v_splat(1));
      integrals_up_to(r, n, turn ? node_of_share(&m, share) : share, up_to);
      v_c = s->v + (length * share + l.pull_y * sum_of_products(up_to, f.w_y, n));
      share = i == 0 ? share - v_c * per : share;
    }
    const vreal K_c = s->K + (sum_of_products(up_to, work, n) - 0.5f * mean * v_c * v_c);
    end.K_c = v_select(passes, K_c, s->K_c);
  }
  end.restitution = s->restitution | passes;
  *next = end;

  /* the defect of the polynomials at the end, which is the first coefficient that the nodes leave out */
  const arrival at_end = arrive(a, &end);
  const vreal defect = v_abs(dot(r->end, f.c, n) - at_end.c) + v_abs(dot(r->end, f.z, n) - at_end.z);
  vreal error = iteration_error(a, &l, f.moved) + 4 * l.mu_b * defect * defect;
  if (turn && v_any(last)) {
    /* to the end of the collision: as in end_step.h, with slopes by the equations, since t may be turning */
    const vreal f_1 = -a->pull_y * at_end.y, df = -a->pull_y * at_end.dy, aim = v_fma(a->e, a->e, work_returned(a, end.K_c, end.K));
    const vreal half_excess = 0.5f * (aim - end.v * end.v), near = half_excess * v_reciprocal(v_max(end.v, v_splat(TINY)));
    const vreal bend = 0.5f * df * (near * near), K = f_1 * half_excess + bend * end.v;
    const vreal square = v_max(aim - 2 * K, v_splat(TINY)), v = square * v_reciprocal_sqrt(square);
    const vreal beyond = ((v - end.v) + bend) * v_reciprocal(1 - f_1), half = 0.5f * beyond;
    out->I_x = end.I_x + beyond * (at_end.x + half * at_end.dx);
    out->I_y = end.I_y + beyond * (at_end.y + half * at_end.dy);
    out->J_c = end.J_c + beyond * ((at_end.c - s->c_0) + half * at_end.dc);
    out->J_z = end.J_z + beyond * ((at_end.z - s->z_0) + half * at_end.dz);
    out->extra = (work_returned(a, end.K_c, end.K) - 2 * K) * v_reciprocal(v + a->e) - a->pull_y * out->I_y;
    out->K_c = end.K_c;
    out->stick = v_splat(-1);
    /* the third term, as large as the distance from the turn lets it be */
    const vreal apart = length - p->at, far2 = v_fma(apart, apart, p->width * p->width), size = v_abs(beyond);
    const vreal left_out = a->pull * size * (beyond * beyond) * v_reciprocal(far2);
    error = error + v_select(last, v_select(v_less(size, 0.1f * length), left_out, v_splat(HUGE_VALF)), v_splat(0));
  }
  return error;
}

#endif
