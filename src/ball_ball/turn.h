/* Nodes drawn together where the cloth slip turns.
 *
 * There the cloth slip passes zero at a distance delta (in p), at p_t; its direction t turns within a few delta. With
 * p - p_t = delta sinh(xi), t dp/dxi is nearly a polynomial in xi, the variable of the rule. */
#ifndef CAROM_SRC_BALL_BALL_TURN_H
#define CAROM_SRC_BALL_BALL_TURN_H

#include "ball_ball/directions.h"

/* A turn, as seen from a state: p_t and delta; the length of the step; what f will be on it, in the mean, were the way straight. */
typedef struct turn_plan {
  vreal at, width, length, mean_f;
} turn_plan;

/* sinh(xi) runs from `from` on along the step, and xi by `range` from `low` on. */
typedef struct turn_range {
  vreal from, low, range, per_width; /* per_width: L / delta */
} turn_range;

always turn_range lay_nodes(const gauss_rule *r, const turn_plan *p, vreal length, mesh *nodes) {
  const vreal per_delta = v_reciprocal(p->width), half = 0.5f * p->width * v_reciprocal(length);
  turn_range m = {.from = -p->at * per_delta, .per_width = length * per_delta};
  m.low = inverse_sinh(m.from);
  m.range = inverse_sinh((length - p->at) * per_delta) - m.low;
  const vreal slope = m.range * half, start = 2 * m.from * half;
  EACH_REG(k, MOST_NODES) {
    const reg e = exponential(MADD(m.range, AT(r->node, k), m.low)), i = reg_reciprocal(e);
    nodes->X[k] = MADD(half, e - i, -start);
    nodes->weight[k] = slope * (e + i);
  }
  return m;
}

/* The node variable where X is `share`. */
always vreal node_of_share(const turn_range *m, vreal share) {
  return (inverse_sinh(v_fma(share, m->per_width, m->from)) - m->low) * v_reciprocal(m->range);
}

#endif
