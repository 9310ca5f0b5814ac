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
 * a number, and a few regs hold all nodes, so that the chain of dependent operations, which
 * bounds the time of a single call, is gone through once for all of them. Sums over nodes are taken
 * in the same order in both, so the bits are the same. In a step of four nodes a reg of eight
 * has four to spare, whose junk no sum and no maximum takes in.
 *
 * The text is compiled in two precisions. Its numbers are written REAL(), because one that is not
 * a sum of powers of two has other digits in each. */
#ifndef CAROM_SRC_BALL_BALL_CARRIER_H
#define CAROM_SRC_BALL_BALL_CARRIER_H

#include "ball_ball/lanes.h"

/* A number of the text, in the precision of the build. */
#define REAL(x) ((real)(x))

/* the constants of a rule must reach the inner loops */
#define always static inline __attribute__((always_inline))

enum { MOST_NODES = 8 };
/* Numbers at the nodes, in memory. */
typedef real node_row[MOST_NODES];

#ifdef CAROM_LANES_ONE
#if (defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)) && defined(CAROM_LANES_F32)
#define REG_NODES 8
#define REGS(n) ((n) > 0) /* 1 */
#elif defined(CAROM_LANES_F32) || defined(CAROM_LANES_AVX2) || defined(CAROM_LANES_AVX512)
#define REG_NODES 4
#define REGS(n) (((n) + 3) / 4)
#else
#define REG_NODES 2
#define REGS(n) (((n) + 1) / 2)
#endif
#define REG_BYTES (REAL_BYTES * REG_NODES)
typedef real reg __attribute__((vector_size(REG_BYTES)));
typedef lane_int reg_int __attribute__((vector_size(REG_BYTES)));
typedef lane_bits reg_bits __attribute__((vector_size(REG_BYTES))); /* sums of junk may wrap */
typedef real reg_unaligned __attribute__((vector_size(REG_BYTES), aligned(REAL_BYTES), may_alias));
typedef real quad __attribute__((vector_size(4 * REAL_BYTES)));
typedef real quad_unaligned
    __attribute__((vector_size(4 * REAL_BYTES), aligned(REAL_BYTES), may_alias));
enum { MOST_REGS = MOST_NODES / REG_NODES };
/* Register k of a row. */
#define AT(row, k) ((reg) * (const reg_unaligned *)((row) + REG_NODES * (k)))
#define QUAD_AT(row) ((quad) * (const quad_unaligned *)(row))
/* Any of its numbers, where all are the same. */
#define ONE_OF(x) ((x)[0])
/* A number at nodes replaced: in the lanes of a mask, if a collision has its own lane; a single
 * call only gets here if so. */
#define REG_MOVE(m, to, x) (*(to) = (x))
#else
typedef vreal reg;
typedef vint reg_int;
typedef lane_bits reg_bits __attribute__((vector_size(VECTOR_BYTES)));
#define REGS(n) (n)
enum { MOST_REGS = MOST_NODES };
#define AT(row, k) ((row)[k])
#define ONE_OF(x) (x)
#define REG_MOVE(m, to, x) (*(to) = v_select(m, x, *(to)))
#endif

/* For every register of n nodes. Code for eight registers in sequence would not stay in the
 * instruction cache. */
#define EACH_REG(k, n) EACH_REG_(k, n)
#define EACH_REG_(k, n) _Pragma("GCC unroll 4") for (int k = 0; k < REGS(n); k++)

/* The same number at every node of a register; of a reg, itself. */
#define SPREAD(x) _Generic((x), reg : reg_itself, default : reg_of)(x)
always reg reg_itself(reg x) {
  return x;
}
#ifdef CAROM_LANES_ONE
always reg reg_of(real x) {
#if REG_NODES == 8
  return (reg){x, x, x, x, x, x, x, x};
#elif REG_NODES == 4
  return (reg){x, x, x, x};
#else
  return (reg){x, x};
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
#if !V_FUSES
  return a * b + c;
#elif LANES_X86
  return (reg)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c);
#else
  return (reg)vfmaq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
#endif
}

/* The square root, as IEEE requires. */
always reg reg_sqrt(reg x) {
#if LANES_X86 && defined(CAROM_LANES_F32) && REG_NODES == 8
  return (reg)_mm256_sqrt_ps((__m256)x);
#elif LANES_X86 && defined(CAROM_LANES_F32)
  return (reg)_mm_sqrt_ps((__m128)x);
#elif LANES_X86 && REG_NODES == 4
  return (reg)_mm256_sqrt_pd((__m256d)x);
#elif LANES_X86
  return (reg)_mm_sqrt_pd((__m128d)x);
#elif defined(CAROM_LANES_NEON) && defined(CAROM_LANES_F32)
  return (reg)vsqrtq_f32((float32x4_t)x);
#elif defined(CAROM_LANES_NEON)
  return (reg)vsqrtq_f64((float64x2_t)x);
#else
  for (int k = 0; k < REG_NODES; k++)
    x[k] = LANE(sqrt)(x[k]);
  return x;
#endif
}

/* 1/sqrt(x) and 1/x: to three digits where there are estimates, for predictors; and properly. */
always reg rough_reciprocal_sqrt(reg x) {
#if V_ESTIMATES && defined(CAROM_LANES_AVX512)
  return (reg)_mm256_rsqrt14_ps((__m256)x);
#elif V_ESTIMATES && defined(CAROM_LANES_AVX2)
  return (reg)_mm256_rsqrt_ps((__m256)x);
#elif V_ESTIMATES
  return (reg)_mm_rsqrt_ps((__m128)x);
#else
  return 1 / reg_sqrt(x);
#endif
}
always reg rough_reciprocal(reg x) {
#if V_ESTIMATES && defined(CAROM_LANES_AVX512)
  return (reg)_mm256_rcp14_ps((__m256)x);
#elif V_ESTIMATES && defined(CAROM_LANES_AVX2)
  return (reg)_mm256_rcp_ps((__m256)x);
#elif V_ESTIMATES
  return (reg)_mm_rcp_ps((__m128)x);
#else
  return 1 / x;
#endif
}
always reg reg_reciprocal_sqrt(reg x) {
  const reg y = rough_reciprocal_sqrt(x);
  return V_ESTIMATES ? reg_fma(REAL(0.5) * y, reg_fma(-(x * y), y, SPREAD(REAL(1.0))), y) : y;
}
always reg reg_reciprocal(reg x) {
  const reg y = rough_reciprocal(x);
  return V_ESTIMATES ? reg_fma(y, reg_fma(-x, y, SPREAD(REAL(1.0))), y) : y;
}

always reg reg_abs(reg x) {
  const reg_int sign = (reg_int)SPREAD(REAL(-0.0));
  return (reg)((reg_int)x & ~sign);
}

/* Nodes 0 to 3 and, of six or eight, 4 to 7. */
always quad first_half(const reg *x) {
#if REG_NODES == 8
  return __builtin_shufflevector(x[0], x[0], 0, 1, 2, 3);
#elif REG_NODES == 4
  return x[0];
#else
  return (quad){x[0][0], x[0][1], x[1][0], x[1][1]};
#endif
}
always quad second_half(const reg *x, int n) {
#if REG_NODES == 8
  (void)n;
  return __builtin_shufflevector(x[0], x[0], 4, 5, 6, 7);
#elif REG_NODES == 4
  (void)n;
  return x[1];
#else
  const int last = n == 8 ? 3 : 2;
  return (quad){x[2][0], x[2][1], x[last][0], x[last][1]};
#endif
}

/* The largest of the numbers at n nodes. */
always vreal largest(const reg *x, int n) {
  const quad low = first_half(x);
  quad high = low;
  if (n == 8)
    high = second_half(x, n);
  else if (n == 6)
    high = __builtin_shufflevector(second_half(x, n), low, 0, 1, 6, 7);
#if LANES_X86 && defined(CAROM_LANES_F32)
  const quad most = (quad)_mm_max_ps((__m128)low, (__m128)high);
#elif defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)
  const quad most = (quad)_mm256_max_pd((__m256d)low, (__m256d)high);
#else
  quad most;
  lanes_unrolled for (int k = 0; k < 4; k++) most[k] = v_max(low[k], high[k]);
#endif
  return v_max(v_max(most[0], most[2]), v_max(most[1], most[3]));
}

/* The sum of numbers at n nodes. */
always vreal sum_of(const reg *x, int n) {
  const quad low = first_half(x), both = n > 4 ? low + second_half(x, n) : low;
  const quad sum = n == 6 ? __builtin_shufflevector(both, low, 0, 1, 6, 7) : both;
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}
/* Sum over the nodes of weight times x; the weights of a rule, or computed ones. */
always vreal dot(const real *weight, const reg *x, int n) {
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
#if REG_NODES == 8 && defined(CAROM_LANES_F32)
/* The number at node j, at every node. */
always reg at_all_nodes(const reg *x, int j) {
  return (reg)_mm256_permutevar8x32_ps((__m256)x[0], _mm256_set1_epi32(j));
}
/* Four nodes need half a register, inside of which numbers move faster. */
always quad quad_at_all_nodes(quad x, int j) {
  return (quad)_mm_permutevar_ps((__m128)x, _mm_set1_epi32(j));
}
always void apply_to_four(const node_row *M, const reg *x, reg *out) {
  const quad low = first_half(x);
  quad pair[2];
  lanes_unrolled for (int j = 0; j < 4; j += 2) pair[j / 2] =
      (quad)_mm_fmadd_ps((__m128)QUAD_AT(M[j + 1]), (__m128)quad_at_all_nodes(low, j + 1),
                         (__m128)(QUAD_AT(M[j]) * quad_at_all_nodes(low, j)));
  out[0] = (reg)_mm256_castps128_ps256((__m128)(pair[0] + pair[1]));
}
#elif defined(CAROM_LANES_AVX512)
always reg at_all_nodes(const reg *x, int j) {
  return (reg)_mm256_permutexvar_pd(_mm256_set1_epi64x(j % 4), (__m256d)x[j / 4]);
}
#elif defined(CAROM_LANES_AVX2) && !defined(CAROM_LANES_F32)
always reg at_all_nodes(const reg *x, int j) {
  const int column = 2 * (j % 4);
  return (reg)_mm256_permutevar8x32_ps((__m256)x[j / 4],
                                       _mm256_setr_epi32(column, column + 1, column, column + 1,
                                                         column, column + 1, column, column + 1));
}
#else
always reg at_all_nodes(const reg *x, int j) {
  return SPREAD(NODE(x, j));
}
#endif

/* out = M' x: out at node k is the sum over the nodes j of M[j][k] x at j. */
always void apply(const node_row *M, const reg *x, reg *out, int n) {
#if REG_NODES == 8
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
always reg reg_sqrt(reg x) {
  return v_sqrt(x);
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

always vreal dot(const real *weight, const reg *x, int n) {
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

/* sqrt(x) for x > 0, in single precision as accurate as its reciprocal. */
always vreal root(vreal x) {
  return V_HASTY ? x * v_reciprocal_sqrt(x) : v_sqrt(x);
}
always reg reg_root(reg x) {
  return V_HASTY ? x * reg_reciprocal_sqrt(x) : reg_sqrt(x);
}

/* Of numbers as bits, for exponential() and logarithm(). */
#ifdef CAROM_LANES_F32
enum { FRACTION_BITS = 23 };
static const lane_int BITS_OF_ROOT_HALF = 0x3f3504f3; /* sqrt(1/2) */
/* log(2) in two parts, the first of few digits */
static const real LOG_2_HIGH = REAL(0.693145752);
static const real LOG_2_LOW = REAL(1.42860677e-6);
/* terms of the series of e^x, and of log(x) */
enum { EXPONENTIAL_TERMS = 6, LOGARITHM_TERMS = 4 };
#else
enum { FRACTION_BITS = 52 };
static const lane_int BITS_OF_ROOT_HALF = 0x3fe6a09e667f3bcd;
static const real LOG_2_HIGH = 0x1.62e42fefa38p-1;
static const real LOG_2_LOW = 0x1.ef35793c7673p-45;
enum { EXPONENTIAL_TERMS = 13, LOGARITHM_TERMS = 11 };
#endif

/* e^x for |x| < 80, to about 2e-7 or 4e-16: 2^n times a polynomial in the rest of x. */
always reg exponential(reg x) {
  static const real per_factorial[] = {
      1 / REAL(1.0),         1 / REAL(1.0),         1 / REAL(2.0),       1 / REAL(6.0),
      1 / REAL(24.0),        1 / REAL(120.0),       1 / REAL(720.0),     1 / REAL(5040.0),
      1 / REAL(40320.0),     1 / REAL(362880.0),    1 / REAL(3628800.0), 1 / REAL(39916800.0),
      1 / REAL(479001600.0), 1 / REAL(6227020800.0)};
  /* adding 1.5 2^FRACTION_BITS rounds to an integer, which then is in the lowest bits */
  const real rounder = REAL(1.5) * (real)((lane_int)1 << FRACTION_BITS);
  const reg shifted = MADD(x, REAL(1.4426950408889634), rounder), n = shifted - rounder;
  const reg r = MADD(n, -LOG_2_LOW, MADD(n, -LOG_2_HIGH, x));
  reg p = SPREAD(per_factorial[EXPONENTIAL_TERMS]);
  lanes_unrolled for (int k = EXPONENTIAL_TERMS - 1; k > 0; k--) p = MADD(r, p, per_factorial[k]);
  return (reg)((reg_bits)MADD(r, p, REAL(1.0)) + ((reg_bits)shifted << FRACTION_BITS));
}

/* log(x) for x > 0, to about 6e-7 or 4e-16: the exponent, and the series of 2 artanh in the rest,
 * which is between sqrt(1/2) and sqrt(2). */
always reg logarithm(reg x) {
  const lane_int fraction = ((lane_int)1 << FRACTION_BITS) - 1;
  const reg_int bits = (reg_int)x - BITS_OF_ROOT_HALF;
  const reg exponent = __builtin_convertvector(bits >> FRACTION_BITS, reg),
            m = (reg)((bits & fraction) + BITS_OF_ROOT_HALF);
  const reg t = (m - 1) * reg_reciprocal(m + 1), t2 = t * t;
  reg series = SPREAD(2 / REAL(2 * LOGARITHM_TERMS - 1));
  lanes_unrolled for (int k = LOGARITHM_TERMS - 2; k >= 0; k--) series =
      MADD(t2, series, 2 / REAL(2 * k + 1));
  return MADD(exponent, REAL(0.69314718055994531), t * series);
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
  node_row node, whole, end, bend, third;
  node_row sum[MOST_NODES], part[MOST_NODES], twice[MOST_NODES], powers[MOST_NODES];
} gauss_rule;
typedef struct stick_rule {
  node_row whole, lambda, lambda_2, lambda_5, log, gone, gone_mean;
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
