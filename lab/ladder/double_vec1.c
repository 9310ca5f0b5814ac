/* double_vec1: intrinsics inside one collision, the first stage: branches kept.
 *
 * v and w hold (x, y) of ball i and of ball j in a 256-bit vector each, w_z that of both balls. An impulse enters by a
 * multiply-add with a constant vector that says which components it acts on, and with what sign.
 *
 * Paper: much slower than double. Here: 1.27; there are as many instructions as in double, 17 of them only move numbers between
 * lanes, with 1 to 4 cycles each in the chain.
 */
#include "double_vec.h"

/* About 1/sqrt of the sum of the squares of both lanes, to 12 bits, in both lanes; infinity for 0. */
CAROM_TARGET_AVX2 static inline __m128d rlength(__m128d x) {
  const __m128d squares = _mm_mul_pd(x, x);
  return _mm_cvtps_pd(_mm_rsqrt_ps(_mm_cvtpd_ps(_mm_hadd_pd(squares, squares))));
}

#define FRICTION const __m128d mu_i = _mm_set1_pd(c.mu_i), mu_j = _mm_set1_pd(-c.mu_j)

/* One step; in restitution the pressed ball has been slipping for a while, and is not asked. */
#define STEP(may_not_slip)                                                           \
  if (_mm_cvtsd_f64(ru) <= 1e16) {                                                   \
    const __m128d DP12 = _mm_mul_pd(_mm_mul_pd(mu_b_DP, ru), u);                     \
    const __m256d DP1 = _mm256_broadcastsd_pd(DP12);                                 \
    v = _mm256_fmadd_pd(DP1, v_of_DP1, v);                                           \
    w_z = _mm_fmadd_pd(_mm256_castpd256_pd128(DP1), w_z_of_DP1, w_z);                \
    const double u_z = _mm_cvtsd_f64(_mm_unpackhi_pd(u, u));                         \
    if (fabs(u_z) >= 1e-16) {                                                        \
      const __m128d DP2 = _mm_unpackhi_pd(DP12, DP12);                               \
      w = _mm256_fmadd_pd(_mm256_set_m128d(DP2, DP2), w_of_DP2, w);                  \
      if (u_z < 0.0) {                                                               \
        const __m128d b = _mm256_extractf128_pd(db, 1);                              \
        const __m128d rb = rlength(b);                                               \
        if (!may_not_slip || _mm_cvtsd_f64(rb) < INFINITY) {                         \
          const __m128d DP_j = _mm_mul_pd(_mm_mul_pd(_mm_mul_pd(mu_j, rb), b), DP2); \
          const __m256d cloth = _mm256_set_m128d(DP_j, _mm_setzero_pd());            \
          v = _mm256_fmadd_pd(cloth, v_of_cloth, v);                                 \
          w = _mm256_fmadd_pd(_mm256_permute_pd(cloth, 0x5), w_of_cloth, w);         \
        }                                                                            \
      } else {                                                                       \
        const __m128d d = _mm256_castpd256_pd128(db);                                \
        const __m128d rd = rlength(d);                                               \
        if (!may_not_slip || _mm_cvtsd_f64(rd) < INFINITY) {                         \
          const __m128d DP_i = _mm_mul_pd(_mm_mul_pd(_mm_mul_pd(mu_i, rd), d), DP2); \
          const __m256d cloth = _mm256_set_m128d(_mm_setzero_pd(), DP_i);            \
          v = _mm256_fmadd_pd(cloth, v_of_cloth, v);                                 \
          w = _mm256_fmadd_pd(_mm256_permute_pd(cloth, 0x5), w_of_cloth, w);         \
        }                                                                            \
      }                                                                              \
    }                                                                                \
    u = slip_of_balls(v, w, w_z, R);                                                 \
    ru = rlength(u);                                                                 \
  }                                                                                  \
  v = _mm256_add_pd(v, v_of_DP);                                                     \
  db = slip_on_cloth(v, w, sR)

CAROM_TARGET_AVX2 void carom_rung_double_vec1(carom_local *state, int N) {
#include "double_vec_body.h"
}
