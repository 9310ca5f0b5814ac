/* Nodes drawn together where the cloth slip turns.
 *
 * There the cloth slip passes zero at a distance delta (in p), at p_t; its direction t turns within a few delta. With
 * p - p_t = delta sinh(xi), t dp/dxi is nearly a polynomial in xi, the variable of the rule. */
#ifndef CAROM_SRC_BALL_BALL_TURN_H
#define CAROM_SRC_BALL_BALL_TURN_H

#include "ball_ball/directions.h"

/* A turn, as seen from a state: p_t and delta; the length of the step; what f will be on it, in the mean, were the way
 * straight. */
typedef struct turn_plan {
  vreal at, width, length, mean_f;
} turn_plan;

/* sinh(xi) runs from `from` on along the step, and xi by `range` from `low` on; half: delta / (2 L). */
typedef struct turn_range {
  vreal from, low, range, half;
} turn_range;

always turn_range range_of(const turn_plan *p, vreal length) {
  const vreal per_delta = v_reciprocal(p->width);
  turn_range m = {.from = -p->at * per_delta, .half = 0.5f * p->width * v_reciprocal(length)};
  m.low = inverse_sinh(m.from);
  m.range = inverse_sinh((length - p->at) * per_delta) - m.low;
  return m;
}

/* X and its slope at the nodes of a rule from 0 to a share of the range. */
always void lay_nodes(const gauss_rule *r, const turn_range *m, vreal share, mesh *nodes) {
  const vreal range = share * m->range, slope = range * m->half, start = 2 * m->from * m->half;
  EACH_REG(k, MOST_NODES) {
    const reg e = exponential(MADD(range, AT(r->node, k), m->low)), i = reg_reciprocal(e);
    nodes->X[k] = MADD(m->half, e - i, -start);
    nodes->weight[k] = slope * (e + i);
  }
}

/* The share of the range at which X has a value. */
always vreal share_at(const turn_range *m, vreal X) {
  return (inverse_sinh(v_fma(X, v_reciprocal(2 * m->half), m->from)) - m->low) * v_reciprocal(m->range);
}

#endif
