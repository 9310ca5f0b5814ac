/* double_lanes_avx512: `double` on many collisions at once, eight in each 512-bit vector.
 *
 * Vectors inside one collision spend their time on moving numbers between lanes. With one
 * collision in each lane nothing moves, and all lanes share the instructions of a step
 * (lanes.h). The estimate takes and gives double precision, as in double_rsqrt14.
 *
 * Paper: not in it; its discussion proposes to look for other ways of working in parallel.
 */
#include "rung.h"

#include <immintrin.h>
#include <math.h>
#include <stdbool.h>

#define LANES_TARGET CAROM_TARGET_AVX512
typedef double real;
typedef __m512d vector;
typedef __mmask8 mask;
enum { LANES = 8, WIDTH = CAROM_WIDTH_double_lanes_avx512 };

LANES_TARGET static inline vector every(real x) {
  return _mm512_set1_pd(x);
}

LANES_TARGET static inline mask less(vector a, vector b) {
  return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}

LANES_TARGET static inline mask at_most(vector a, vector b) {
  return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ);
}

LANES_TARGET static inline bool any(mask m) {
  return m != 0;
}

LANES_TARGET static inline mask all_lanes(void) {
  return (mask)-1;
}

LANES_TARGET static inline vector keep(mask m, vector a) {
  return _mm512_maskz_mov_pd(m, a);
}

LANES_TARGET static inline vector choose(mask m, vector a, vector b) {
  return _mm512_mask_blend_pd(m, b, a);
}

LANES_TARGET static inline vector magnitude(vector x) {
  return _mm512_abs_pd(x);
}

LANES_TARGET static inline vector plus_product(vector sum, vector a, vector b) {
  return _mm512_fmadd_pd(a, b, sum);
}

LANES_TARGET static inline vector minus_product(vector sum, vector a, vector b) {
  return _mm512_fnmadd_pd(a, b, sum);
}

/* To 14 bits. */
LANES_TARGET static inline vector rsqrt(vector x) {
  return _mm512_rsqrt14_pd(x);
}

#include "lanes.h"

LANES_TARGET void carom_rung_double_lanes_avx512(carom_local *state, int N) {
  run_lanes(state, N);
}
