/* Lanes: the small vocabulary in which whatever is done for many collisions at once is written,
 * so that its algebra reads like docs/understanding/physics.md.
 *
 * A `vreal` holds LANES numbers of type `real`, one pair of balls in each. + - * / and unary -
 * are the compiler's own (GNU vector extensions); comparisons, selection and all else that
 * the extensions lack are the functions below. A `vmask` holds a truth value for each lane; masks
 * combine with & and | and v_not().
 *
 * A source is compiled once for each instruction set and precision, with exactly one of
 *
 *     CAROM_LANES_AVX512, CAROM_LANES_AVX2 (with FMA), CAROM_LANES_SSE2, CAROM_LANES_NEON,
 *     CAROM_LANES_PLAIN
 *
 * and CAROM_LANES_F32 for float, or CAROM_LANES_MIXED for rows in double around collocation in
 * float. PLAIN uses nothing but the extensions and runs anywhere. With
 * CAROM_LANES_ONE a vreal is one number: the same text then serves a single collision, with the
 * same bits, since every function here does the same operations on a lane whatever the width.
 */
#ifndef CAROM_SRC_BALL_BALL_LANES_H
#define CAROM_SRC_BALL_BALL_LANES_H

#include "platform/arithmetic.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* With gcc, core/src/CMakeLists.txt precompiles the larger ones of these headers, once for each
 * set. */
#if defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2)
#include <immintrin.h>
#define LANES_X86 1
#elif defined(CAROM_LANES_SSE2)
#include <emmintrin.h>
#define LANES_X86 1
#else
#define LANES_X86 0
#if defined(CAROM_LANES_NEON)
#include <arm_neon.h>
#endif
#endif

/* WebAssembly's vectors are not a separate instruction set: PLAIN has instructions there for the
 * operations that the extensions lack, with the same bits. */
#if defined(CAROM_LANES_PLAIN) && defined(__wasm_simd128__)
#include <wasm_simd128.h>
#define LANES_WASM 1
#else
#define LANES_WASM 0
#endif

#ifdef CAROM_LANES_F32
typedef float real;
typedef int32_t lane_int;
typedef uint32_t lane_bits;
#define REAL_BYTES 4
#else
typedef double real;
typedef int64_t lane_int;
typedef uint64_t lane_bits;
#define REAL_BYTES 8
#endif

/* A number of collocation. */
#if defined(CAROM_LANES_F32) || defined(CAROM_LANES_MIXED)
typedef float collocated;
#else
typedef double collocated;
#endif

/* Before a loop of few turns: arrays of vectors live in registers only if the compiler unrolls
 * it. */
#if defined(__clang__)
#define lanes_unrolled _Pragma("clang loop unroll(full)")
#else
#define lanes_unrolled _Pragma("GCC unroll 16")
#endif
/* Before one whose text is long: unrolled, it would not stay in the cache of instructions. */
#if defined(__clang__)
#define lanes_rolled _Pragma("clang loop unroll(disable)")
#else
#define lanes_rolled _Pragma("GCC unroll 1")
#endif

/* Whether a product is fused with a sum, and whether 1/x and 1/sqrt(x) are estimated. Collisions in
 * double precision do neither: every operation is rounded as IEEE requires, so all instruction sets
 * give equal bits, and an estimate, which has steps, cannot put them into a result. */
#if defined(CAROM_LANES_F32) || defined(CAROM_LANES_MIXED)
#define V_HASTY 1
#else
#define V_HASTY 0
#endif
#if V_HASTY && \
    (defined(CAROM_LANES_AVX512) || defined(CAROM_LANES_AVX2) || defined(CAROM_LANES_NEON))
#define V_FUSES 1
#else
#define V_FUSES 0
#endif
#if V_HASTY && (defined(CAROM_LANES_AVX512) || (LANES_X86 && defined(CAROM_LANES_F32)))
#define V_ESTIMATES 1
#else
#define V_ESTIMATES 0
#endif

#ifdef CAROM_LANES_ONE
#include "ball_ball/scalar.h"
#else

#if defined(CAROM_LANES_AVX512)
#define VECTOR_BYTES 64
#elif defined(CAROM_LANES_AVX2)
#define VECTOR_BYTES 32
#else
#define VECTOR_BYTES 16
#endif
#define LANES (VECTOR_BYTES / REAL_BYTES)

typedef real vreal __attribute__((vector_size(VECTOR_BYTES)));
typedef lane_int vint __attribute__((vector_size(VECTOR_BYTES)));
typedef real vreal_unaligned
    __attribute__((vector_size(VECTOR_BYTES), aligned(sizeof(real)), may_alias));

/* x86 intrinsics of the build's width and precision: SIMD(sqrt) is _mm512_sqrt_pd, _mm_sqrt_ps,
 * ... */
#define LANES_PASTE3(a, b, c) a##b##c
#define LANES_PASTE(a, b, c) LANES_PASTE3(a, b, c)
#if defined(CAROM_LANES_AVX512)
#define SIMD_PREFIX _mm512_
#elif defined(CAROM_LANES_AVX2)
#define SIMD_PREFIX _mm256_
#else
#define SIMD_PREFIX _mm_
#endif
#ifdef CAROM_LANES_F32
#define SIMD(name) LANES_PASTE(SIMD_PREFIX, name, _ps)
#else
#define SIMD(name) LANES_PASTE(SIMD_PREFIX, name, _pd)
#endif
#define SIMD_SET1(x) ((vreal)SIMD(set1)(x))

static inline vreal v_splat(real x) {
#if LANES_X86
  return SIMD_SET1(x); /* folded into the instruction that uses it, if it is loaded from memory */
#else
  return x - (vreal){0}; /* keeps the sign of a zero, which 0 + x would not */
#endif
}

static inline vreal v_load(const real *source) {
  return (vreal) * (const vreal_unaligned *)source;
}

static inline void v_store(real *target, vreal x) {
  *(vreal_unaligned *)target = (vreal_unaligned)x;
}

/* ---- Masks ----------------------------------------------------------------------------------- */

#ifdef CAROM_LANES_AVX512

#ifdef CAROM_LANES_F32
typedef __mmask16 vmask;
#define SIMD_COMPARE(a, b, how) _mm512_cmp_ps_mask(a, b, how)
#else
typedef __mmask8 vmask;
#define SIMD_COMPARE(a, b, how) _mm512_cmp_pd_mask(a, b, how)
#endif

static inline vmask v_less(vreal a, vreal b) {
  return SIMD_COMPARE(a, b, _CMP_LT_OQ);
}
static inline vmask v_less_equal(vreal a, vreal b) {
  return SIMD_COMPARE(a, b, _CMP_LE_OQ);
}
static inline vmask v_equal(vreal a, vreal b) {
  return SIMD_COMPARE(a, b, _CMP_EQ_OQ);
}
static inline vmask v_not(vmask m) {
  return (vmask)~m;
}
static inline vreal v_select(vmask m, vreal yes, vreal no) {
  return SIMD(mask_blend)(m, no, yes);
}
/* One bit per lane, lane 0 lowest. */
static inline unsigned v_bits(vmask m) {
  return m;
}
static inline vmask v_from_bits(unsigned bits) {
  return (vmask)bits;
}

#else

typedef vint vmask;

static inline vmask v_less(vreal a, vreal b) {
  return (vmask)(a < b);
}
static inline vmask v_less_equal(vreal a, vreal b) {
  return (vmask)(a <= b);
}
static inline vmask v_equal(vreal a, vreal b) {
  return (vmask)(a == b);
}
static inline vmask v_not(vmask m) {
  return ~m;
}
static inline vreal v_select(vmask m, vreal yes, vreal no) {
#ifdef CAROM_LANES_AVX2
  return SIMD(blendv)(no, yes, (vreal)m);
#elif LANES_WASM
  return (vreal)wasm_v128_bitselect((v128_t)yes, (v128_t)no, (v128_t)m);
#else
  return (vreal)((m & (vint)yes) | (~m & (vint)no));
#endif
}
static inline unsigned v_bits(vmask m) {
#if defined(CAROM_LANES_AVX2) || defined(CAROM_LANES_SSE2)
  return (unsigned)SIMD(movemask)((vreal)m);
#elif LANES_WASM && defined(CAROM_LANES_F32)
  return wasm_i32x4_bitmask((v128_t)m);
#elif LANES_WASM
  return wasm_i64x2_bitmask((v128_t)m);
#else
  unsigned bits = 0;
  lanes_unrolled for (int k = 0; k < LANES; k++) bits |= (unsigned)(m[k] & 1) << k;
  return bits;
#endif
}
static inline vmask v_from_bits(unsigned bits) {
  vmask m = {0};
  lanes_unrolled for (int k = 0; k < LANES; k++) m[k] = -(lane_int)(bits >> k & 1);
  return m;
}

#endif

enum { ALL_LANES = (int)((1u << LANES) - 1u) };

static inline vmask v_all(void) {
  return v_from_bits(ALL_LANES);
}
static inline bool v_any(vmask m) {
  return v_bits(m) != 0;
}
/* Does it hold in more than so many lanes? */
static inline bool v_more(vmask m, int count) {
  return __builtin_popcount(v_bits(m)) > count;
}
/* ---- Arithmetic ------------------------------------------------------------------------------ */

static inline vreal v_abs(vreal x) {
  const vint sign = (vint)v_splat((real)-0.0);
  return (vreal)((vint)x & ~sign);
}

static inline vreal v_max(vreal a, vreal b) {
#if LANES_X86
  return SIMD(max)(a, b);
#else
  return v_select(v_less(b, a), a, b);
#endif
}

static inline vreal v_min(vreal a, vreal b) {
#if LANES_X86
  return SIMD(min)(a, b);
#else
  return v_select(v_less(a, b), a, b);
#endif
}

/* Correctly rounded, as IEEE requires. */
static inline vreal v_sqrt(vreal x) {
#if LANES_X86
  return SIMD(sqrt)(x);
#elif defined(CAROM_LANES_NEON) && defined(CAROM_LANES_F32)
  return (vreal)vsqrtq_f32((float32x4_t)x);
#elif defined(CAROM_LANES_NEON)
  return (vreal)vsqrtq_f64((float64x2_t)x);
#elif LANES_WASM && defined(CAROM_LANES_F32)
  return (vreal)wasm_f32x4_sqrt((v128_t)x);
#elif LANES_WASM
  return (vreal)wasm_f64x2_sqrt((v128_t)x);
#elif defined(CAROM_LANES_F32)
  for (int k = 0; k < LANES; k++)
    x[k] = sqrtf(x[k]);
  return x;
#else
  for (int k = 0; k < LANES; k++)
    x[k] = sqrt(x[k]);
  return x;
#endif
}

/* a b + c: rounded once where the instruction set fuses (V_FUSES), twice elsewhere. */
static inline vreal v_fma(vreal a, vreal b, vreal c) {
#if !V_FUSES
  return a * b + c;
#elif LANES_X86
  return SIMD(fmadd)(a, b, c);
#elif defined(CAROM_LANES_F32)
  return (vreal)vfmaq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
#else
  return (vreal)vfmaq_f64((float64x2_t)c, (float64x2_t)a, (float64x2_t)b);
#endif
}

/* c - a b. */
static inline vreal v_fnma(vreal a, vreal b, vreal c) {
  return v_fma(-a, b, c);
}

#if V_ESTIMATES
static inline vreal v_estimate_reciprocal(vreal x) {
#ifdef CAROM_LANES_AVX512
  return SIMD(rcp14)(x);
#else
  return SIMD(rcp)(x);
#endif
}
static inline vreal v_estimate_reciprocal_sqrt(vreal x) {
#ifdef CAROM_LANES_AVX512
  return SIMD(rsqrt14)(x);
#else
  return SIMD(rsqrt)(x);
#endif
}
#endif

/* ---- Transposition --------------------------------------------------------------------------- */

/* A chunk is 16 bytes: CHUNK numbers side by side in a row of memory. Vectors are made of chunks
 * of different rows, so that all shuffling stays inside 16 bytes, where it is cheap on every
 * instruction set. */
#define CHUNK (16 / REAL_BYTES)

typedef real chunk __attribute__((vector_size(16)));
typedef real chunk_unaligned __attribute__((vector_size(16), aligned(sizeof(real)), may_alias));

/* Chunk k of the vector is read from row[k * CHUNK] + offset. */
static inline vreal v_load_chunks(const real *const row[], int offset) {
#define CHUNK_OF(k) ((chunk) * (const chunk_unaligned *)(row[(k)*CHUNK] + offset))
#if defined(CAROM_LANES_AVX512) && defined(CAROM_LANES_F32)
  __m512 x = _mm512_castps128_ps512((__m128)CHUNK_OF(0));
  x = _mm512_mask_broadcast_f32x4(x, 0x00f0, (__m128)CHUNK_OF(1));
  x = _mm512_mask_broadcast_f32x4(x, 0x0f00, (__m128)CHUNK_OF(2));
  return (vreal)_mm512_mask_broadcast_f32x4(x, 0xf000, (__m128)CHUNK_OF(3));
#elif defined(CAROM_LANES_AVX512)
  __m512d x = _mm512_castpd128_pd512((__m128d)CHUNK_OF(0));
  x = _mm512_mask_broadcast_f64x2(x, 0x0c, (__m128d)CHUNK_OF(1));
  x = _mm512_mask_broadcast_f64x2(x, 0x30, (__m128d)CHUNK_OF(2));
  return (vreal)_mm512_mask_broadcast_f64x2(x, 0xc0, (__m128d)CHUNK_OF(3));
#elif defined(CAROM_LANES_AVX2) && defined(CAROM_LANES_F32)
  return (vreal)_mm256_insertf128_ps(_mm256_castps128_ps256((__m128)CHUNK_OF(0)),
                                     (__m128)CHUNK_OF(1), 1);
#elif defined(CAROM_LANES_AVX2)
  return (vreal)_mm256_insertf128_pd(_mm256_castpd128_pd256((__m128d)CHUNK_OF(0)),
                                     (__m128d)CHUNK_OF(1), 1);
#else
  return (vreal)CHUNK_OF(0);
#endif
#undef CHUNK_OF
}

/* The reverse. */
static inline void v_store_chunks(real *const row[], int offset, vreal x) {
#define CHUNK_TO(k) *(chunk_unaligned *)(row[(k)*CHUNK] + offset)
#if defined(CAROM_LANES_AVX512) && defined(CAROM_LANES_F32)
  CHUNK_TO(0) = (chunk_unaligned)_mm512_castps512_ps128(x);
  CHUNK_TO(1) = (chunk_unaligned)_mm512_extractf32x4_ps(x, 1);
  CHUNK_TO(2) = (chunk_unaligned)_mm512_extractf32x4_ps(x, 2);
  CHUNK_TO(3) = (chunk_unaligned)_mm512_extractf32x4_ps(x, 3);
#elif defined(CAROM_LANES_AVX512)
  CHUNK_TO(0) = (chunk_unaligned)_mm512_castpd512_pd128(x);
  CHUNK_TO(1) = (chunk_unaligned)_mm512_extractf64x2_pd(x, 1);
  CHUNK_TO(2) = (chunk_unaligned)_mm512_extractf64x2_pd(x, 2);
  CHUNK_TO(3) = (chunk_unaligned)_mm512_extractf64x2_pd(x, 3);
#elif defined(CAROM_LANES_AVX2) && defined(CAROM_LANES_F32)
  CHUNK_TO(0) = (chunk_unaligned)_mm256_castps256_ps128(x);
  CHUNK_TO(1) = (chunk_unaligned)_mm256_extractf128_ps(x, 1);
#elif defined(CAROM_LANES_AVX2)
  CHUNK_TO(0) = (chunk_unaligned)_mm256_castpd256_pd128(x);
  CHUNK_TO(1) = (chunk_unaligned)_mm256_extractf128_pd(x, 1);
#else
  CHUNK_TO(0) = (chunk_unaligned)x;
#endif
#undef CHUNK_TO
}

/* The low, or the high, halves of the chunks of a and b, alternating. */
#if LANES == 2
#define LANES_LOW 0, 2
#define LANES_HIGH 1, 3
#elif LANES == 4 && defined(CAROM_LANES_F32)
#define LANES_LOW 0, 4, 1, 5
#define LANES_HIGH 2, 6, 3, 7
#elif LANES == 4
#define LANES_LOW 0, 4, 2, 6
#define LANES_HIGH 1, 5, 3, 7
#elif LANES == 8 && defined(CAROM_LANES_F32)
#define LANES_LOW 0, 8, 1, 9, 4, 12, 5, 13
#define LANES_HIGH 2, 10, 3, 11, 6, 14, 7, 15
#elif LANES == 8
#define LANES_LOW 0, 8, 2, 10, 4, 12, 6, 14
#define LANES_HIGH 1, 9, 3, 11, 5, 13, 7, 15
#else
#define LANES_LOW 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29
#define LANES_HIGH 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31
#endif

/* Transposes the squares of CHUNK x CHUNK that the chunks of CHUNK vectors make. */
static inline void v_transpose_chunks(vreal m[]) {
#ifdef CAROM_LANES_F32
  const vreal a = __builtin_shufflevector(m[0], m[2], LANES_LOW),
              b = __builtin_shufflevector(m[0], m[2], LANES_HIGH);
  const vreal c = __builtin_shufflevector(m[1], m[3], LANES_LOW),
              d = __builtin_shufflevector(m[1], m[3], LANES_HIGH);
  m[0] = __builtin_shufflevector(a, c, LANES_LOW);
  m[1] = __builtin_shufflevector(a, c, LANES_HIGH);
  m[2] = __builtin_shufflevector(b, d, LANES_LOW);
  m[3] = __builtin_shufflevector(b, d, LANES_HIGH);
#else
  const vreal a = m[0], b = m[1];
  m[0] = __builtin_shufflevector(a, b, LANES_LOW);
  m[1] = __builtin_shufflevector(a, b, LANES_HIGH);
#endif
}

/* Columns [at, at + CHUNK) of LANES rows of memory, one vector each; lane k is row k. */
static inline void v_load_columns(const real *const row[LANES], int offset, vreal column[]) {
  lanes_unrolled for (int k = 0; k < CHUNK; k++) column[k] = v_load_chunks(row + k, offset);
  v_transpose_chunks(column);
}

static inline void v_store_columns(real *const row[LANES], int offset, const vreal column[]) {
  vreal m[16 / sizeof(real)];
  lanes_unrolled for (int k = 0; k < CHUNK; k++) m[k] = column[k];
  v_transpose_chunks(m);
  lanes_unrolled for (int k = 0; k < CHUNK; k++) v_store_chunks(row + k, offset, m[k]);
}

#endif /* not CAROM_LANES_ONE */

/* 1/x and 1/sqrt(x) for positive normal x: an estimate of the processor's, corrected by as many
 * terms of the series in its error as reach the precision of the type; the quotient and the root
 * proper where there is no estimate. */
static inline vreal v_reciprocal(vreal x) {
#if V_ESTIMATES
  const vreal y = v_estimate_reciprocal(x), error = v_fnma(x, y, v_splat(1));
#ifdef CAROM_LANES_F32
  return v_fma(y, error, y);
#else
  return v_fma(y * error, v_fma(error, error, 1 + error), y);
#endif
#else
  return 1 / x;
#endif
}

/* To three digits. */
static inline vreal v_rough_reciprocal(vreal x) {
#if V_ESTIMATES
  return v_estimate_reciprocal(x);
#else
  return 1 / x;
#endif
}
static inline vreal v_rough_reciprocal_sqrt(vreal x) {
#if V_ESTIMATES
  return v_estimate_reciprocal_sqrt(x);
#else
  return 1 / v_sqrt(x);
#endif
}

static inline vreal v_reciprocal_sqrt(vreal x) {
#if V_ESTIMATES
  const vreal y = v_estimate_reciprocal_sqrt(x), error = v_fnma(x * y, y, v_splat(1));
#ifdef CAROM_LANES_F32
  return v_fma((real)0.5 * y, error, y);
#else
  return v_fma(
      y * error,
      v_fma(error, v_fma(v_splat((real)0.3125), error, v_splat((real)0.375)), v_splat((real)0.5)),
      y);
#endif
#else
  return 1 / v_sqrt(x);
#endif
}

#endif
