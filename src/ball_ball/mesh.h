/* Where the nodes of a step lie: X, the share of its length, over the variable x of the rule. In steps of four and six nodes X
 * is x. Those of eight nodes have one of two maps:
 *
 *     graded    drawn together towards where |u| would reach zero: 1 - q X = (1 - h x)^4
 *     turned    drawn together where the cloth slip turns. There it passes zero at a distance delta (in p), at p_t, and its
 *               direction t turns within a few delta. With p - p_t = delta sinh(xi), t dp/dxi is nearly a polynomial in xi,
 *               which runs evenly with x. */
#ifndef CAROM_SRC_BALL_BALL_MESH_H
#define CAROM_SRC_BALL_BALL_MESH_H

#include "ball_ball/problem.h"

#include <stdbool.h>

always bool is_mapped(int n) {
  return n == MOST_NODES;
}

/* X at the nodes, and dX/dx where it is not 1. */
typedef struct mesh {
  reg X[MOST_REGS], weight[MOST_REGS];
} mesh;

/* A turn, as seen from a state: p_t and delta; the length of the step; what f will be on it, in the mean, were the way
 * straight. */
typedef struct turn_plan {
  vreal at, width, length, mean_f;
} turn_plan;

/* Graded: q, h, and X / x at x = 1 without the factors that depend on x.
 * Turned: sinh(xi) at x = 0, xi there, its range, delta / (2 L). */
typedef union node_map {
  struct {
    vreal q, h, per, unused;
  };
  struct {
    vreal from, low, range, half;
  };
} node_map;

static const float MOST_GRADING = 0.995f; /* q */

always node_map graded_map(vreal q) {
  node_map m;
  m.q = v_min(q, v_splat(MOST_GRADING));
  const vreal y = root(root(1 - m.q));
  m.h = 1 - y;
  m.per = v_reciprocal((1 + y) * v_fma(y, y, v_splat(1)));
  m.unused = v_splat(0);
  return m;
}

always node_map turned_map(const turn_plan *p, vreal length) {
  const vreal per_delta = v_reciprocal(p->width);
  node_map m;
  m.from = -p->at * per_delta;
  m.half = 0.5f * p->width * v_reciprocal(length);
  m.low = inverse_sinh(m.from);
  m.range = inverse_sinh((length - p->at) * per_delta) - m.low;
  return m;
}

/* X and its slope at the nodes of a rule from 0 to a share of x. */
always void lay_nodes(bool turned, const gauss_rule *r, int n, const node_map *m, vreal share, mesh *to) {
  if (!turned) {
    const vreal h = share * m->h, to_X = share * m->per;
    EACH_REG(k, n) {
      const reg x = SPREAD(AT(r->node, k)), y = MADD(-h, x, 1.0f), y2 = y * y;
      to->X[k] = (to_X * x) * ((1 + y) * (1 + y2));
      to->weight[k] = (4 * to_X) * (y2 * y);
    }
  } else {
    const vreal range = share * m->range, slope = range * m->half, start = 2 * m->from * m->half;
    EACH_REG(k, n) {
      const reg e = exponential(MADD(range, AT(r->node, k), m->low)), i = reg_reciprocal(e);
      to->X[k] = MADD(m->half, e - i, -start);
      to->weight[k] = slope * (e + i);
    }
  }
}

/* x at which X has a value. */
always vreal x_at(bool turned, const node_map *m, vreal X) {
  if (!turned) {
    const vreal y = root(root(v_fma(-m->q, X, v_splat(1))));
    return X * v_reciprocal(m->per * (1 + y) * v_fma(y, y, v_splat(1)));
  }
  return (inverse_sinh(v_fma(X, v_reciprocal(2 * m->half), m->from)) - m->low) * v_reciprocal(m->range);
}

#endif
