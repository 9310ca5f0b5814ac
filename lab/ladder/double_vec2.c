/* double_vec2: the second stage: compares and masks in place of the branches.
 *
 * The impulses of both cloth contacts are computed in every step, and the mask lets one of them pass.
 *
 * Paper: slower. Here: 1.23; the branches were always predicted and cost nothing, the masks are instructions.
 */
#include "double_vec.h"

/* About 1/sqrt of the sum of the squares of both lanes, to 12 bits, in both lanes; infinity for 0. */
CAROM_TARGET_AVX2 static inline __m128d rlength(__m128d x) {
  const __m128d squares = _mm_mul_pd(x, x);
  return _mm_cvtps_pd(_mm_rsqrt_ps(_mm_cvtpd_ps(_mm_hadd_pd(squares, squares))));
}

/* The same for the lower and the upper pair of lanes. */
CAROM_TARGET_AVX2 static inline __m256d rlengths(__m256d x) {
  const __m256d squares = _mm256_mul_pd(x, x);
  return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(_mm256_hadd_pd(squares, squares))));
}

/* i is pressed where u_z > 0, j where u_z < 0 */
#define FRICTION                                                          \
  const __m256d mu_ij = _mm256_setr_pd(c.mu_i, c.mu_i, -c.mu_j, -c.mu_j); \
  const __m256d sign = _mm256_setr_pd(1.0, 1.0, -1.0, -1.0)

/* One step; in restitution the pressed ball has been slipping for a while, and is not asked. */
#define STEP(may_not_slip)                                                                                             \
  const __m128d slips = _mm_cmp_pd(ru, _mm_set1_pd(1e16), _CMP_LE_OQ);                                                 \
  const __m128d DP12 = _mm_and_pd(slips, _mm_mul_pd(_mm_mul_pd(mu_b_DP, ru), u));                                      \
  const __m256d DP1 = _mm256_broadcastsd_pd(DP12);                                                                     \
  v = _mm256_fmadd_pd(DP1, v_of_DP1, v);                                                                               \
  w_z = _mm_fmadd_pd(_mm256_castpd256_pd128(DP1), w_z_of_DP1, w_z);                                                    \
  const __m256d u_z = _mm256_permute4x64_pd(_mm256_castpd128_pd256(u), 0x55);                                          \
  const __m256d turns = _mm256_cmp_pd(_mm256_andnot_pd(_mm256_set1_pd(-0.0), u_z), _mm256_set1_pd(1e-16), _CMP_GE_OQ); \
  const __m256d DP2 = _mm256_and_pd(turns, _mm256_permute4x64_pd(_mm256_castpd128_pd256(DP12), 0x55));                 \
  w = _mm256_fmadd_pd(DP2, w_of_DP2, w);                                                                               \
  const __m256d pressed = _mm256_cmp_pd(_mm256_mul_pd(u_z, sign), _mm256_setzero_pd(), _CMP_GT_OQ);                    \
  const __m256d rdb = rlengths(db);                                                                                    \
  const __m256d finite = _mm256_cmp_pd(rdb, _mm256_set1_pd(INFINITY), _CMP_LT_OQ);                                     \
  const __m256d DP_db = _mm256_mul_pd(_mm256_mul_pd(_mm256_mul_pd(mu_ij, rdb), db), DP2);                              \
  const __m256d cloth = _mm256_and_pd(may_not_slip ? _mm256_and_pd(pressed, finite) : pressed, DP_db);                 \
  v = _mm256_fmadd_pd(cloth, v_of_cloth, v);                                                                           \
  w = _mm256_fmadd_pd(_mm256_permute_pd(cloth, 0x5), w_of_cloth, w);                                                   \
  u = slip_of_balls(v, w, w_z, R);                                                                                     \
  ru = rlength(u);                                                                                                     \
  v = _mm256_add_pd(v, v_of_DP);                                                                                       \
  db = slip_on_cloth(v, w, sR)

CAROM_TARGET_AVX2 void carom_rung_double_vec2(carom_local *state, int N) {
#include "double_vec_body.h"
}
