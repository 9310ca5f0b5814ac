/* What double_vec1, double_vec2 and double_vec share: v and w hold (x, y) of ball i and of ball j, w_z that of both balls. */
#include "rung.h"

#include <immintrin.h>
#include <math.h>

/* (u_x, u_z) at contact A. */
CAROM_TARGET_AVX2 static inline __m128d slip_of_balls(__m256d v, __m256d w, __m128d w_z, __m128d R) {
  const __m128d v_ij = _mm_sub_pd(_mm256_castpd256_pd128(v), _mm256_extractf128_pd(v, 1));
  const __m128d w_ij = _mm_add_pd(_mm256_castpd256_pd128(w), _mm256_extractf128_pd(w, 1));
  const __m128d w_zij = _mm_hadd_pd(w_z, w_z);
  return _mm_addsub_pd(_mm_unpacklo_pd(v_ij, _mm_setzero_pd()), _mm_mul_pd(R, _mm_unpacklo_pd(w_zij, w_ij)));
}

/* (d_x, d_y, b_x, b_y) at contacts D and B. */
CAROM_TARGET_AVX2 static inline __m256d slip_on_cloth(__m256d v, __m256d w, __m256d sR) {
  return _mm256_fmadd_pd(sR, _mm256_permute_pd(w, 0x5), v);
}
