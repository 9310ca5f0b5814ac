/* double_lanes_avx2: `double` on many collisions at once, four in each 256-bit vector.
 *
 * As double_lanes_avx512, for processors with AVX2: half as many lanes, 16 registers in place of
 * 32, and an estimate in single precision, with two conversions as in `rsqrt`.
 *
 * Paper: not in it; its discussion proposes to look for other ways of working in parallel.
 */
#include "rung.h"

#include <immintrin.h>
#include <math.h>
#include <stdbool.h>

#define LANES_TARGET CAROM_TARGET_AVX2
typedef double real;
typedef __m256d vector;
typedef __m256i mask; /* all bits of a lane, or none */
enum { LANES = 4, WIDTH = CAROM_WIDTH_double_lanes_avx2 };

LANES_TARGET static inline vector every(real x) {
  return _mm256_set1_pd(x);
}

LANES_TARGET static inline mask less(vector a, vector b) {
  return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LT_OQ));
}

LANES_TARGET static inline mask at_most(vector a, vector b) {
  return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LE_OQ));
}

LANES_TARGET static inline bool any(mask m) {
  return _mm256_movemask_pd(_mm256_castsi256_pd(m)) != 0;
}

LANES_TARGET static inline mask all_lanes(void) {
  return _mm256_set1_epi64x(-1);
}

LANES_TARGET static inline vector keep(mask m, vector a) {
  return _mm256_and_pd(_mm256_castsi256_pd(m), a);
}

LANES_TARGET static inline vector choose(mask m, vector a, vector b) {
  return _mm256_blendv_pd(b, a, _mm256_castsi256_pd(m));
}

LANES_TARGET static inline vector magnitude(vector x) {
  return _mm256_andnot_pd(every(-0.0), x);
}

LANES_TARGET static inline vector plus_product(vector sum, vector a, vector b) {
  return _mm256_fmadd_pd(a, b, sum);
}

LANES_TARGET static inline vector minus_product(vector sum, vector a, vector b) {
  return _mm256_fnmadd_pd(a, b, sum);
}

/* To 12 bits. */
LANES_TARGET static inline vector rsqrt(vector x) {
  return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(x)));
}

#include "lanes.h"

LANES_TARGET void carom_rung_double_lanes_avx2(carom_local *state, int N) {
  run_lanes(state, N);
}
