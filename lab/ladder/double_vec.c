/* double_vec: the third stage: the masks leave the chain or go.
 *
 * What does not slip: 1e-32 is added to the square of each slip, in the multiply-add that squares it, so that its reciprocal is
 * at most 1e16 and no compare is needed. Which ball is pressed is taken from u_z and multiplied into the coefficient of
 * friction while the estimate is still under way. The step of DP is added to v before the rest, which comes late.
 *
 * Paper: slower. Here: 1.17 in default, where clang's fast-math regroups the products, 1.33 to 1.37 in all other
 * configurations.
 */
#include "double_vec.h"

/* About 1/sqrt of the sum of the squares of both lanes, to 12 bits, in both lanes. The least is added so that what does not
 * slip gets a finite number: times the slip, that is no friction. */
CAROM_TARGET_AVX2 static inline __m128d rlength(__m128d x) {
  const __m128d squares = _mm_fmadd_pd(x, x, _mm_set1_pd(1e-32));
  return _mm_cvtps_pd(_mm_rsqrt_ps(_mm_cvtpd_ps(_mm_hadd_pd(squares, squares))));
}

/* The same for the lower and the upper pair of lanes. */
CAROM_TARGET_AVX2 static inline __m256d rlengths(__m256d x) {
  const __m256d squares = _mm256_fmadd_pd(x, x, _mm256_set1_pd(1e-32));
  return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(_mm256_hadd_pd(squares, squares))));
}

/* i is pressed where u_z > 0, j where u_z < 0 */
#define FRICTION                                                          \
  const __m256d mu_ij = _mm256_setr_pd(c.mu_i, c.mu_i, -c.mu_j, -c.mu_j); \
  const __m256d sign = _mm256_setr_pd(1.0, 1.0, -1.0, -1.0)

#define STEP(unused)                                                                                 \
  const __m256d u_z = _mm256_permute4x64_pd(_mm256_castpd128_pd256(u), 0x55);                        \
  const __m256d pressed = _mm256_cmp_pd(_mm256_mul_pd(u_z, sign), _mm256_setzero_pd(), _CMP_GT_OQ);  \
  const __m256d mu = _mm256_and_pd(pressed, mu_ij);                                                  \
  const __m256d rdb = rlengths(db);                                                                  \
  const __m128d DP12 = _mm_mul_pd(_mm_mul_pd(mu_b_DP, u), ru);                                       \
  const __m256d DP1 = _mm256_broadcastsd_pd(DP12);                                                   \
  const __m256d DP2 = _mm256_permute4x64_pd(_mm256_castpd128_pd256(DP12), 0x55);                     \
  const __m256d cloth = _mm256_mul_pd(_mm256_mul_pd(_mm256_mul_pd(mu, rdb), db), DP2);               \
  v = _mm256_fmadd_pd(cloth, v_of_cloth, _mm256_fmadd_pd(DP1, v_of_DP1, _mm256_add_pd(v, v_of_DP))); \
  w = _mm256_fmadd_pd(_mm256_permute_pd(cloth, 0x5), w_of_cloth, _mm256_fmadd_pd(DP2, w_of_DP2, w)); \
  w_z = _mm_fmadd_pd(_mm256_castpd256_pd128(DP1), w_z_of_DP1, w_z);                                  \
  u = slip_of_balls(v, w, w_z, R);                                                                   \
  ru = rlength(u);                                                                                   \
  db = slip_on_cloth(v, w, sR)

CAROM_TARGET_AVX2 void carom_rung_double_vec(carom_local *state, int N) {
#include "double_vec_body.h"
}
