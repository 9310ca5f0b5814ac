/* The carrier of the collocation text: the content of a register, and the operations that this
 * decides.
 *
 * The text (collocate.c and its headers) is written once, over two types:
 *
 *     vreal    a number of a collision                      lanes.h has its operations
 *     reg      a number at the nodes of a step; n nodes take REGS(n) of them
 *
 * A batch computes LANES collisions at once: a vreal has a lane for each, and so has a reg,
 * which holds one node of each of them. A single call (CAROM_LANES_ONE) computes one: a vreal is
 * a float, and a reg or two hold all nodes, so that the chain of dependent operations, which
 * bounds the time of a single call, is gone through once for all of them. Sums over nodes are taken
 * in the same order in both, so the bits are the same. In a step of four nodes a reg of eight
 * has four to spare, whose junk no sum and no maximum takes in.
 */
#ifndef CAROM_SRC_BALL_BALL_CARRIER_H
#define CAROM_SRC_BALL_BALL_CARRIER_H

#include "ball_ball/lanes.h"

/* the constants of a rule must reach the inner loops */
#define always static inline __attribute__((always_inline))

enum { MOST_NODES = 8 };
/* Numbers at the nodes, in memory. */
typedef float node_row[MOST_NODES];

#ifdef CAROM_LANES_ONE
#if defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)
#define REG_NODES 8
#define REGS(n) ((n) > 0) /* 1 */
#else
#define REG_NODES 4
#define REGS(n) (((n) + 3) / 4)
#endif
typedef float reg __attribute__((vector_size(4 * REG_NODES)));
typedef int32_t reg_int __attribute__((vector_size(4 * REG_NODES)));
typedef uint32_t reg_bits __attribute__((vector_size(4 * REG_NODES))); /* sums of junk may wrap */
typedef float reg_unaligned __attribute__((vector_size(4 * REG_NODES), aligned(4), may_alias));
typedef float quad __attribute__((vector_size(16)));
typedef float quad_unaligned __attribute__((vector_size(16), aligned(4), may_alias));
enum { MOST_REGS = MOST_NODES / REG_NODES };
/* Register k of a row. */
#define AT(row, k) ((reg) * (const reg_unaligned *)((row) + REG_NODES * (k)))
#define QUAD_AT(row) ((quad) * (const quad_unaligned *)(row))
/* Any of its numbers, where all are the same. */
#define ONE_OF(x) ((x)[0])
/* A number at nodes replaced: in the lanes of a mask, where a collision is in a lane of its own;
 * a single call does not come here if not. */
#define REG_MOVE(m, to, x) (*(to) = (x))
#else
typedef vreal reg;
typedef vint reg_int;
typedef uint32_t reg_bits __attribute__((vector_size(VECTOR_BYTES)));
#define REGS(n) (n)
enum { MOST_REGS = MOST_NODES };
#define AT(row, k) ((row)[k])
#define ONE_OF(x) (x)
#define REG_MOVE(m, to, x) (*(to) = v_select(m, x, *(to)))
#endif

/* For every register of n nodes. Eight registers in turn would not stay in the
 * cache of instructions. */
#define EACH_REG(k, n) EACH_REG_(k, n)
#define EACH_REG_(k, n) _Pragma("GCC unroll 4") for (int k = 0; k < REGS(n); k++)

/* The same number at every node of a register; of a reg, itself. */
#define SPREAD(x) _Generic((x), reg : reg_itself, default : reg_of)(x)
always reg reg_itself(reg x) {
  return x;
}
#ifdef CAROM_LANES_ONE
always reg reg_of(float x) {
#if defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)
  return (reg){x, x, x, x, x, x, x, x};
#else
  return (reg){x, x, x, x};
#endif
}
#else
always reg reg_of(real x) {
  return v_splat(x);
}
#endif
/* a b + c as a reg, each of them a reg or one number. */
#define MADD(a, b, c) reg_fma(SPREAD(a), SPREAD(b), SPREAD(c))

/* ---- Single calls ---------------------------------------------------------------------------- */

#ifdef CAROM_LANES_ONE

always reg reg_fma(reg a, reg b, reg c) {
#if defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)
  return (reg)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c);
#elif defined(CAROM_LANES_NEON)
  return (reg)vfmaq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
#else
  return a * b + c;
#endif
}

/* 1/sqrt(x) and 1/x: to three digits, for predictors; and properly. */
always reg rough_reciprocal_sqrt(reg x) {
#if defined(CAROM_LANES_AVX512)
  return (reg)_mm256_rsqrt14_ps((__m256)x);
#elif defined(CAROM_LANES_AVX2)
  return (reg)_mm256_rsqrt_ps((__m256)x);
#elif defined(CAROM_LANES_SSE2)
  return (reg)_mm_rsqrt_ps((__m128)x);
#elif defined(CAROM_LANES_NEON)
  return 1 / (reg)vsqrtq_f32((float32x4_t)x);
#else
  reg y = x;
  for (int k = 0; k < REG_NODES; k++)
    y[k] = sqrtf(x[k]);
  return 1 / y;
#endif
}
always reg rough_reciprocal(reg x) {
#if defined(CAROM_LANES_AVX512)
  return (reg)_mm256_rcp14_ps((__m256)x);
#elif defined(CAROM_LANES_AVX2)
  return (reg)_mm256_rcp_ps((__m256)x);
#elif defined(CAROM_LANES_SSE2)
  return (reg)_mm_rcp_ps((__m128)x);
#else
  return 1 / x;
#endif
}
always reg reg_reciprocal_sqrt(reg x) {
  const reg y = rough_reciprocal_sqrt(x);
  return V_ESTIMATES ? reg_fma(0.5f * y, reg_fma(-(x * y), y, SPREAD(1.0f)), y) : y;
}
always reg reg_reciprocal(reg x) {
  const reg y = rough_reciprocal(x);
  return V_ESTIMATES ? reg_fma(y, reg_fma(-x, y, SPREAD(1.0f)), y) : y;
}

always reg reg_abs(reg x) {
  return (reg)((reg_int)x & 0x7fffffff);
}

/* Nodes 0 to 3 and 4 to 7. */
#if defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)
#define FIRST_HALF(x) __builtin_shufflevector((x)[0], (x)[0], 0, 1, 2, 3)
#define SECOND_HALF(x) __builtin_shufflevector((x)[0], (x)[0], 4, 5, 6, 7)
#else
#define FIRST_HALF(x) ((x)[0])
#define SECOND_HALF(x) ((x)[1])
#endif

/* The largest of the numbers at n nodes. */
always vreal largest(const reg *x, int n) {
  const quad low = FIRST_HALF(x),
             high = n == 8   ? SECOND_HALF(x)
                    : n == 6 ? __builtin_shufflevector(SECOND_HALF(x), low, 0, 1, 6, 7)
                             : low;
#if LANES_X86
  const quad most = (quad)_mm_max_ps((__m128)low, (__m128)high);
#else
  quad most;
  lanes_unrolled for (int k = 0; k < 4; k++) most[k] = v_max(low[k], high[k]);
#endif
  return v_max(v_max(most[0], most[2]), v_max(most[1], most[3]));
}

/* The sum of numbers at n nodes. */
always vreal sum_of(const reg *x, int n) {
  const quad low = FIRST_HALF(x), both = n > 4 ? low + SECOND_HALF(x) : low;
  const quad sum = n == 6 ? __builtin_shufflevector(both, low, 0, 1, 6, 7) : both;
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}
/* Sum over the nodes of weight times x; the weights those of a rule, or computed. */
always vreal dot(const float *weight, const reg *x, int n) {
  reg product[MOST_REGS];
  EACH_REG(k, n) product[k] = AT(weight, k) * x[k];
  return sum_of(product, n);
}
always vreal sum_of_products(const reg *weight, const reg *x, int n) {
  reg product[MOST_REGS];
  EACH_REG(k, n) product[k] = weight[k] * x[k];
  return sum_of(product, n);
}

/* The number at node j. */
#define NODE(x, j) ((x)[(j) / REG_NODES][(j) % REG_NODES])
#if defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)
/* The number at node j, at every node. */
always reg at_all_nodes(const reg *x, int j) {
  return (reg)_mm256_permutevar8x32_ps((__m256)x[0], _mm256_set1_epi32(j));
}
/* Four nodes need half a register, inside of which numbers move faster. */
always quad quad_at_all_nodes(quad x, int j) {
  return (quad)_mm_permutevar_ps((__m128)x, _mm_set1_epi32(j));
}
always void apply_to_four(const node_row *M, const reg *x, reg *out) {
  const quad low = FIRST_HALF(x);
  quad pair[2];
  lanes_unrolled for (int j = 0; j < 4; j += 2) pair[j / 2] =
      (quad)_mm_fmadd_ps((__m128)QUAD_AT(M[j + 1]), (__m128)quad_at_all_nodes(low, j + 1),
                         (__m128)(QUAD_AT(M[j]) * quad_at_all_nodes(low, j)));
  out[0] = (reg)_mm256_castps128_ps256((__m128)(pair[0] + pair[1]));
}
#else
always reg at_all_nodes(const reg *x, int j) {
  return SPREAD(NODE(x, j));
}
#endif

/* out = M' x: out at node k is the sum over the nodes j of M[j][k] x at j. */
always void apply(const node_row *M, const reg *x, reg *out, int n) {
#if defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)
  if (n == 4) {
    apply_to_four(M, x, out);
    return;
  }
#endif
  EACH_REG(k, n) {
    reg low = AT(M[0], k) * at_all_nodes(x, 0), high = AT(M[n / 2], k) * at_all_nodes(x, n / 2);
    lanes_unrolled for (int j = 1; j < n / 2; j++) {
      low = MADD(AT(M[j], k), at_all_nodes(x, j), low);
      high = MADD(AT(M[n / 2 + j], k), at_all_nodes(x, n / 2 + j), high);
    }
    out[k] = low + high;
  }
}

/* ---- Batches --------------------------------------------------------------------------------- */

#else

#define NODE(x, j) ((x)[j])

always reg reg_fma(reg a, reg b, reg c) {
  return v_fma(a, b, c);
}
always reg rough_reciprocal_sqrt(reg x) {
  return v_rough_reciprocal_sqrt(x);
}
always reg rough_reciprocal(reg x) {
  return v_rough_reciprocal(x);
}
always reg reg_reciprocal_sqrt(reg x) {
  return v_reciprocal_sqrt(x);
}
always reg reg_reciprocal(reg x) {
  return v_reciprocal(x);
}
always reg reg_abs(reg x) {
  return v_abs(x);
}

always vreal largest(const reg *x, int n) {
  vreal most[4];
  lanes_unrolled for (int k = 0; k < 4; k++) most[k] = k + 4 < n ? v_max(x[k], x[k + 4]) : x[k];
  return v_max(v_max(most[0], most[2]), v_max(most[1], most[3]));
}

always vreal dot(const float *weight, const reg *x, int n) {
  vreal sum[4];
  lanes_unrolled for (int k = 0; k < 4; k++) sum[k] =
      k + 4 < n ? weight[k] * x[k] + weight[k + 4] * x[k + 4] : weight[k] * x[k];
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}
always vreal sum_of_products(const reg *weight, const reg *x, int n) {
  vreal sum[4];
  lanes_unrolled for (int k = 0; k < 4; k++) sum[k] =
      k + 4 < n ? weight[k] * x[k] + weight[k + 4] * x[k + 4] : weight[k] * x[k];
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

always void apply(const node_row *M, const reg *x, reg *out, int n) {
  lanes_unrolled for (int k = 0; k < n; k++) { /* rolled, gcc would move each weight through a
                                                  register to spread it */
    reg low = M[0][k] * x[0], high = M[n / 2][k] * x[n / 2];
    lanes_unrolled for (int j = 1; j < n / 2; j++) {
      low = MADD(M[j][k], x[j], low);
      high = MADD(M[n / 2 + j][k], x[n / 2 + j], high);
    }
    out[k] = low + high;
  }
}

#endif

/* ---- Functions over both --------------------------------------------------------------------- */

/* sqrt(x) for x > 0, to the precision of its reciprocal. */
always vreal root(vreal x) {
  return x * v_reciprocal_sqrt(x);
}
always reg reg_root(reg x) {
  return x * reg_reciprocal_sqrt(x);
}

/* e^x for |x| < 80, to about 2e-7: 2^n times a polynomial in the rest of x. */
always reg exponential(reg x) {
  const float rounder = 12582912.0f; /* 1.5 2^23: adding it rounds to an integer, which then
                                        stands in the lowest bits */
  const reg shifted = MADD(x, 1.44269504f, rounder), n = shifted - rounder;
  /* log(2) in two parts, the first of few digits */
  const reg r = MADD(n, -1.42860677e-6f, MADD(n, -0.693145752f, x));
  const reg p =
      MADD(r, MADD(r, MADD(r, MADD(r, MADD(r, 1 / 720.0f, 1 / 120.0f), 1 / 24.0f), 1 / 6.0f), 0.5f),
           1.0f);
  return (reg)((reg_bits)MADD(r, p, 1.0f) + ((reg_bits)shifted << 23));
}

/* log(x) for x > 0, to about 6e-7: the exponent, and the series of 2 artanh in the rest. */
always reg logarithm(reg x) {
  /* of sqrt(1/2): the rest is between that and sqrt(2) */
  const reg_int bits = (reg_int)((reg_bits)x - 0x3f3504f3);
  const reg exponent = __builtin_convertvector(bits >> 23, reg),
            m = (reg)((bits & 0x7fffff) + 0x3f3504f3);
  const reg t = (m - 1) * reg_reciprocal(m + 1), t2 = t * t;
  const reg series = MADD(t2, MADD(t2, MADD(t2, 2 / 7.0f, 2 / 5.0f), 2 / 3.0f), 2.0f);
  return MADD(exponent, 0.693147181f, t * series);
}

/* The inverse hyperbolic sine. */
always vreal inverse_sinh(vreal x) {
  const vreal size = v_abs(x),
              y = ONE_OF(logarithm(SPREAD(size + root(v_fma(size, size, v_splat(1))))));
  return v_select(v_less(x, v_splat(0)), -y, y);
}

/* ---- Quadrature rules on the nodes of a step (quadrature.h), and the polynomials through numbers
 * at the nodes */

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
    lanes_unrolled for (int m = n - 2; m >= 0; m--) value[k] =
        MADD(value[k], t, AT(coefficient[m], k));
  }
}

/* Weights of the nodes in an integral from 0 to x. */
always void integrals_up_to(const gauss_rule *r, int n, vreal x, reg *weight) {
  polynomials_at(r->part, n, 2 * x - 1, weight);
  EACH_REG(k, n) weight[k] = weight[k] * x;
}

/* The coefficients of one polynomial in t: the sum of those polynomials, a row for each node,
 * times numbers at the nodes. */
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
