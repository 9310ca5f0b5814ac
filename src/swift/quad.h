/* Four floats side by side, and two doubles: the words in which the swift solver is written.
 *
 * Plain C with vectors of gcc and clang; what these lack comes from the instruction set, or else from a loop. */
#ifndef CAROM_SRC_SWIFT_QUAD_H
#define CAROM_SRC_SWIFT_QUAD_H

#include <math.h>
#include <string.h>
#if defined(__SSE2__) && !defined(CAROM_SWIFT_PLAIN)
#define CAROM_SWIFT_SSE2 1
#include <emmintrin.h>
#elif defined(CAROM_SWIFT_NEON)
#include <arm_neon.h>
#endif

#define always static inline __attribute__((always_inline))

typedef float quad __attribute__((vector_size(16)));
typedef int quad_mask __attribute__((vector_size(16)));
typedef double pair __attribute__((vector_size(16)));
typedef long long pair_mask __attribute__((vector_size(16)));

/* fminf would be a call */
always float at_most(float x, float most) {
  return x < most ? x : most;
}
always quad all4(float x) {
  return (quad){x, x, x, x};
}
always pair both(double x) {
  return (pair){x, x};
}
always quad size4(quad a) {
  return (quad)((quad_mask)a & 0x7fffffff);
}
always pair load(const double *x) {
  pair v;
  memcpy(&v, x, sizeof v);
  return v;
}
always void store(double *x, pair v) {
  memcpy(x, &v, sizeof v);
}
always pair first(pair v) {
  return (pair){v[0], v[0]};
}
always pair second(pair v) {
  return (pair){v[1], v[1]};
}
always pair exchanged(pair v) {
  return (pair){v[1], v[0]};
}
/* b where the mask is set, a elsewhere */
always pair chosen(pair_mask mask, pair a, pair b) {
  return (pair)((~mask & (pair_mask)a) | (mask & (pair_mask)b));
}
always pair flipped(pair a, pair_mask sign) {
  return (pair)((pair_mask)a ^ sign);
}
/* Keeps a product from being fused with the sum that it goes into: of two products in a sum one would be rounded and the other
 * not, and a table turned by 90 degrees would give other bits. */
always pair rounded(pair product) {
#if defined(__SSE2__)
  __asm__("" : "+x"(product));
#elif defined(__aarch64__)
  __asm__("" : "+w"(product));
#endif
  return product;
}
/* e^x to a per cent or so, for |x| < 4 */
always quad rough_exp(quad x) {
  const quad y = (1 / 16.0f) * x;
  quad p = 1 + y * (1 + y * (0.5f + (1 / 6.0f) * y));
  p *= p;
  p *= p;
  p *= p;
  return p * p;
}
/* of two quads, element by element */
always quad larger4(quad a, quad b) {
  const quad_mask less = a < b;
  return (quad)((~less & (quad_mask)a) | (less & (quad_mask)b));
}

#ifdef CAROM_SWIFT_SSE2
/* 1 / sqrt(x), to 12 bits; finer(x, y) makes 23 of them by one step of Newton's method: y finer(x, y). */
always quad rough_inverse_root(quad x) {
  return (quad)_mm_rsqrt_ps((__m128)x);
}
always quad finer(quad x, quad y) {
  return 1.5f - (0.5f * x) * (y * y);
}
always quad root4(quad x) {
  return (quad)_mm_sqrt_ps((__m128)x);
}
always int any4(quad_mask mask) {
  return _mm_movemask_ps((__m128)mask) != 0;
}
always int all2(pair_mask mask) {
  return _mm_movemask_pd((__m128d)mask) == 3;
}
/* { sum of a, of b, of c, of d } */
always quad sums4(quad a, quad b, quad c, quad d) {
  const __m128 ab = _mm_add_ps(_mm_unpacklo_ps((__m128)a, (__m128)b), _mm_unpackhi_ps((__m128)a, (__m128)b)),
               cd = _mm_add_ps(_mm_unpacklo_ps((__m128)c, (__m128)d), _mm_unpackhi_ps((__m128)c, (__m128)d));
  return (quad)_mm_add_ps(_mm_movelh_ps(ab, cd), _mm_movehl_ps(cd, ab));
}
/* { a[0], a[1], b[0], b[1] } in single precision */
always quad narrow(pair a, pair b) {
  return (quad)_mm_movelh_ps(_mm_cvtpd_ps((__m128d)a), _mm_cvtpd_ps((__m128d)b));
}
always pair wide_low(quad a) {
  return (pair)_mm_cvtps_pd((__m128)a);
}
always pair wide_high(quad a) {
  return (pair)_mm_cvtps_pd(_mm_movehl_ps((__m128)a, (__m128)a));
}
#else
always quad root4(quad x) {
#ifdef CAROM_SWIFT_NEON
  return (quad)vsqrtq_f32((float32x4_t)x);
#else
  return (quad){sqrtf(x[0]), sqrtf(x[1]), sqrtf(x[2]), sqrtf(x[3])};
#endif
}
always quad rough_inverse_root(quad x) {
  return 1 / root4(x);
}
always quad finer(quad x, quad y) {
  (void)x, (void)y;
  return all4(1);
}
always int any4(quad_mask mask) {
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}
always int all2(pair_mask mask) {
  return (mask[0] & mask[1]) != 0;
}
always quad sums4(quad a, quad b, quad c, quad d) {
  return (quad){(a[0] + a[2]) + (a[1] + a[3]), (b[0] + b[2]) + (b[1] + b[3]), (c[0] + c[2]) + (c[1] + c[3]),
                (d[0] + d[2]) + (d[1] + d[3])};
}
always quad narrow(pair a, pair b) {
  return (quad){(float)a[0], (float)a[1], (float)b[0], (float)b[1]};
}
always pair wide_low(quad a) {
  return (pair){a[0], a[1]};
}
always pair wide_high(quad a) {
  return (pair){a[2], a[3]};
}
#endif

/* out[k] = sum over the 4 n nodes j of M[j][k] v_j */
always void apply(const quad *M, const quad *v, quad *out, int n) {
  for (int j = 0; j < n; j++) {
    const quad a = all4(v[j][0]), b = all4(v[j][1]), c = all4(v[j][2]), d = all4(v[j][3]);
    for (int k = 0; k < n; k++) {
      const quad *row = M + 4 * j * n + k;
      const quad add = (row[0] * a + row[n] * b) + (row[2 * n] * c + row[3 * n] * d);
      out[k] = j ? out[k] + add : add;
    }
  }
}
/* { w a, w b, w c, w d }, each summed over the nodes */
always quad dots(const quad *w, const quad *a, const quad *b, const quad *c, const quad *d, int n) {
  quad x = w[0] * a[0], y = w[0] * b[0], z = w[0] * c[0], t = w[0] * d[0];
  for (int k = 1; k < n; k++) {
    x += w[k] * a[k];
    y += w[k] * b[k];
    z += w[k] * c[k];
    t += w[k] * d[k];
  }
  return sums4(x, y, z, t);
}

#endif
