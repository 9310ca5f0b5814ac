/* Quadrature rules on the nodes of a step, and the polynomials through what stands at the nodes. rules.h has the rules. */
#ifndef CAROM_SRC_BALL_BALL_QUADRATURE_H
#define CAROM_SRC_BALL_BALL_QUADRATURE_H

#include "ball_ball/carrier.h"

/* The fields are explained where they are computed, in tools/collocation_rules.py. */
typedef struct gauss_rule {
  node_row node, all, end, bend, third;
  node_row sum[MOST_NODES], part[MOST_NODES], twice[MOST_NODES], powers[MOST_NODES];
} gauss_rule;
typedef struct stick_rule {
  node_row all, lambda, lambda_2, lambda_5, log, gone, gone_mean;
  node_row sum[MOST_NODES], turn[MOST_NODES], powers[MOST_NODES], basis[MOST_NODES];
} stick_rule;

/* Polynomials in t, one for each node, given by their coefficients; t = 2 x - 1. */
always void polynomials_at(const node_row *coefficient, int n, vreal t, reg *value) {
  EACH_REG(k, n) {
    value[k] = SPREAD(AT(coefficient[n - 1], k));
    lanes_unrolled for (int m = n - 2; m >= 0; m--) value[k] = MADD(value[k], t, AT(coefficient[m], k));
  }
}

/* Weights of the nodes in an integral from 0 to x. */
always void integrals_up_to(const gauss_rule *r, int n, vreal x, reg *weight) {
  polynomials_at(r->part, n, 2 * x - 1, weight);
  EACH_REG(k, n) weight[k] = weight[k] * x;
}

/* The coefficients of one polynomial in t: the sum of those polynomials, a row for each node, times numbers at the nodes. */
always void sum_polynomials(const node_row *coefficient, int n, const reg *value, vreal *sum) {
  reg sums[MOST_REGS];
  apply(coefficient, value, sums, n);
  lanes_unrolled for (int m = 0; m < n; m++) sum[m] = NODE(sums, m);
}
always vreal polynomial(const vreal *coefficient, int n, vreal t) {
  vreal sum = coefficient[n - 1];
  lanes_unrolled for (int m = n - 2; m >= 0; m--) sum = v_fma(t, sum, coefficient[m]);
  return sum;
}
always vreal polynomial_and_slope(const vreal *coefficient, int n, vreal t, vreal *slope) {
  vreal sum = coefficient[n - 1];
  *slope = v_splat(0);
  lanes_unrolled for (int m = n - 2; m >= 0; m--) {
    *slope = v_fma(t, *slope, sum);
    sum = v_fma(t, sum, coefficient[m]);
  }
  return sum;
}
always reg polynomial_at_nodes(const vreal *coefficient, int n, reg t) {
  reg sum = SPREAD(coefficient[n - 1]);
  lanes_unrolled for (int m = n - 2; m >= 0; m--) sum = MADD(t, sum, coefficient[m]);
  return sum;
}

#endif
