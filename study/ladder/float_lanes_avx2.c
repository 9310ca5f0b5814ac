/* float_lanes_avx2: `float` on many collisions at once, eight in each 256-bit vector.
 *
 * As double_lanes_avx2, with twice as many lanes and without conversions. The paper's processor
 * could run it.
 *
 * Paper: not in it; its discussion proposes to look for other ways of working in parallel.
 */
#include "rung.h"

#include <immintrin.h>
#include <math.h>
#include <stdbool.h>

#define LANES_TARGET CAROM_TARGET_AVX2
typedef float real;
typedef __m256 vector;
typedef __m256i mask; /* all bits of a lane, or none */
enum { LANES = 8, WIDTH = CAROM_WIDTH_float_lanes_avx2 };

LANES_TARGET static inline vector every(real x) {
  return _mm256_set1_ps(x);
}

LANES_TARGET static inline mask less(vector a, vector b) {
  return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
}

LANES_TARGET static inline mask at_most(vector a, vector b) {
  return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LE_OQ));
}

LANES_TARGET static inline bool any(mask m) {
  return _mm256_movemask_ps(_mm256_castsi256_ps(m)) != 0;
}

LANES_TARGET static inline mask all_lanes(void) {
  return _mm256_set1_epi64x(-1);
}

LANES_TARGET static inline vector keep(mask m, vector a) {
  return _mm256_and_ps(_mm256_castsi256_ps(m), a);
}

LANES_TARGET static inline vector choose(mask m, vector a, vector b) {
  return _mm256_blendv_ps(b, a, _mm256_castsi256_ps(m));
}

LANES_TARGET static inline vector magnitude(vector x) {
  return _mm256_andnot_ps(every(-0.0f), x);
}

LANES_TARGET static inline vector plus_product(vector sum, vector a, vector b) {
  return _mm256_fmadd_ps(a, b, sum);
}

LANES_TARGET static inline vector minus_product(vector sum, vector a, vector b) {
  return _mm256_fnmadd_ps(a, b, sum);
}

/* To 12 bits. */
LANES_TARGET static inline vector rsqrt(vector x) {
  return _mm256_rsqrt_ps(x);
}

#include "lanes.h"

LANES_TARGET void carom_rung_float_lanes_avx2(carom_local *state, int N) {
  run_lanes(state, N);
}
