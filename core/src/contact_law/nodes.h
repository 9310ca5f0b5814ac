/* Numbers at the eight Gauss nodes of a step, and the operations on them.
 *
 * Eight numbers are PARTS vectors: two of four numbers with AVX2, else four of two. What happens
 * at every node alike is a loop over the parts; only integrals join nodes. Each operation is one
 * of IEEE 754 on each number, so that all builds without AVX2 have the same bits. `madd` fuses a
 * product and a sum where the instruction set can. */
#ifndef CAROM_SRC_CONTACT_LAW_NODES_H
#define CAROM_SRC_CONTACT_LAW_NODES_H

#include "platform/arithmetic.h"

#include "contact_law/quadrature.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef CAROM_LANES_AVX2
#include <immintrin.h>
#define PART_BYTES 32
#define SIMD(name) _mm256_##name##_pd
typedef __m256d simd;
#else
#define PART_BYTES 16
#ifdef __SSE2__
#include <emmintrin.h>
#define SIMD(name) _mm_##name##_pd
typedef __m128d simd;
#endif
#endif

#define always static inline __attribute__((always_inline))

enum { PARTS = NODES * 8 / PART_BYTES };
typedef double part __attribute__((vector_size(PART_BYTES)));
typedef double pair_of_row __attribute__((vector_size(16), may_alias));
typedef double part_of_row __attribute__((vector_size(PART_BYTES), may_alias));
typedef int64_t part_int __attribute__((vector_size(PART_BYTES)));
typedef part nodes[PARTS];

/* Before a loop over parts or nodes: arrays of vectors live in registers only if the compiler
 * unrolls it. */
#ifdef __clang__
#define unrolled _Pragma("clang loop unroll(full)")
#else
#define unrolled _Pragma("GCC unroll 8")
#endif
/* For each part, whose number is i. */
#define EACH unrolled for (int i = 0; i < PARTS; i++)

/* Part i of a row of numbers at the nodes. */
#define PART(row, i) ((part)((const part_of_row *)(row))[i])
/* The number at node k, and at the last one. */
#define AT(f, k) ((f)[(k) / (NODES / PARTS)][(k) % (NODES / PARTS)])
#define LAST(f) AT(f, NODES - 1)

always part splat(double x) {
  return x - (part){0};
}

/* a b + c */
always part madd(part a, part b, part c) {
#ifdef CAROM_LANES_AVX2
  return (part)SIMD(fmadd)((simd)a, (simd)b, (simd)c);
#else
  return a * b + c;
#endif
}

always part square_root(part x) {
#ifdef SIMD
  return (part)SIMD(sqrt)((simd)x);
#else
  return (part){sqrt(x[0]), sqrt(x[1])};
#endif
}

always part magnitude(part x) {
  return (part)((part_int)x & INT64_MAX);
}

always part lesser(part a, part b) {
#ifdef SIMD
  return (part)SIMD(min)((simd)a, (simd)b);
#else
  const part_int mask = a < b;
  return (part)(((part_int)a & mask) | ((part_int)b & ~mask));
#endif
}

always part greater(part a, part b) {
#ifdef SIMD
  return (part)SIMD(max)((simd)a, (simd)b);
#else
  const part_int mask = a > b;
  return (part)(((part_int)a & mask) | ((part_int)b & ~mask));
#endif
}

/* x, limited to [-most, most]. */
always part within(part x, double most) {
  return lesser(greater(x, splat(-most)), splat(most));
}

/* The sum of weight[k] f[k], added in the same order whatever the width. */
always double dot(const double *weight, const part *f) {
  double products[NODES] __attribute__((aligned(PART_BYTES)));
  EACH *(part_of_row *)(products + NODES / PARTS * i) = (part_of_row)(PART(weight, i) * f[i]);
  const pair_of_row *pairs = (const pair_of_row *)products,
                    sum = (pairs[0] + pairs[2]) + (pairs[1] + pairs[3]);
  return sum[0] + sum[1];
}

/* The largest number. */
always double largest(const part *f) {
  part most = f[0];
  unrolled for (int i = 1; i < PARTS; i++) most = greater(most, f[i]);
  double found = most[0];
  unrolled for (int node = 1; node < NODES / PARTS; node++) {
    found = found > most[node] ? found : most[node];
  }
  return found;
}

/* out = matrix f, of a matrix by columns. */
always void apply(const double (*matrix)[NODES], const part *f, part *out) {
  double numbers[NODES] __attribute__((aligned(PART_BYTES)));
  nodes even, odd;
  EACH *(part_of_row *)(numbers + NODES / PARTS * i) = (part_of_row)f[i];
  EACH {
    even[i] = PART(matrix[0], i) * splat(numbers[0]);
    odd[i] = PART(matrix[1], i) * splat(numbers[1]);
  }
  unrolled for (int column = 2; column < NODES; column += 2) EACH {
    even[i] = madd(PART(matrix[column], i), splat(numbers[column]), even[i]);
    odd[i] = madd(PART(matrix[column + 1], i), splat(numbers[column + 1]), odd[i]);
  }
  EACH out[i] = even[i] + odd[i];
}

/* Integrals of f from the beginning of the step to the nodes. */
always void integrate(const part *f, part *out) {
  apply(INTEGRAL, f, out);
}

/* Replaces a matrix, given by columns, by its inverse: Gauss and Jordan's method without pivots. */
always void invert(double (*matrix)[NODES]) {
#define ROW(x, i) (((part_of_row *)(x))[i])
  double diagonal = matrix[0][0];
  unrolled for (int step = 0; step < NODES; step++) {
    /* the part of row `step` for every row: the entries of that column vanish, the row's own
     * becomes 1. The next element of the diagonal is first, because the next row waits for its
     * division */
    const double pivot = 1 / diagonal;
    if (step + 1 < NODES)
      diagonal = madd(splat(matrix[step][step + 1] * -pivot), splat(matrix[step + 1][step]),
                      splat(matrix[step + 1][step + 1]))[0];
    nodes column;
    EACH column[i] = (part)ROW(matrix[step], i) * -pivot;
    AT(column, step) = pivot - 1;
    for (int other = 0; other < NODES; other++)
      if (other != step) {
        const double row = matrix[other][step];
        EACH ROW(matrix[other], i) =
            (part_of_row)madd(column[i], splat(row), PART(matrix[other], i));
      }
    /* that column of the inverse takes its position */
    AT(column, step) = pivot;
    EACH ROW(matrix[step], i) = (part_of_row)column[i];
  }
#undef ROW
}

/* exp(x) to a few units in the last place; 1e-304 below -700. */
always part exponential(part x) {
  /* ln 2 in two parts, of which the first times an integer is exact */
  const double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10,
               per_ln2 = 1.4426950408889634;
  const double round = 6755399441055744.0; /* 3 2^51: a number added to it is rounded to an
                                              integer */
  x = greater(x, splat(-700));
  /* exp(x) = 2^k exp(r), |r| < 0.35 */
  const part shifted = madd(x, splat(per_ln2), splat(round)), power = shifted - round;
  const part r = madd(power, splat(-ln2_low), madd(power, splat(-ln2_high), x)), r_2 = r * r,
             r_4 = r_2 * r_2;
  /* the Taylor polynomial of degree 10: pairs of its terms, and their sum by powers of r^2 */
  const part degree_0 = 1 + r, degree_2 = madd(r, splat(1.0 / 6), splat(1.0 / 2)),
             degree_4 = madd(r, splat(1.0 / 120), splat(1.0 / 24)),
             degree_6 = madd(r, splat(1.0 / 5040), splat(1.0 / 720)),
             degree_8 = madd(r, splat(1.0 / 362880), splat(1.0 / 40320));
  const part low = madd(degree_2, r_2, degree_0), mid = madd(degree_6, r_2, degree_4),
             high = madd(r_2, splat(1.0 / 3628800), degree_8);
  return (part)((part_int)madd(madd(high, r_4, mid), r_4, low) + ((part_int)shifted << 52));
}

#endif
