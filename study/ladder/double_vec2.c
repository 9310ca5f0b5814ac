/* double_vec2: the second stage: compares and masks in place of the branches.
 *
 * The impulses of both cloth contacts are computed in every step, and the mask lets one of them
 * pass.
 *
 * Paper: slower than double. The branches are nearly always predicted and cost nothing, the masks
 * are instructions.
 */
#include "rung.h"

#include <immintrin.h>
#include <math.h>

/* About 1/sqrt of the sum of both lanes, to 12 bits, in both lanes; infinity for 0. */
CAROM_TARGET_AVX2 static inline __m128d rsqrt_sum(__m128d x) {
  const __m128d sum = _mm_hadd_pd(x, x);
  return _mm_cvtps_pd(_mm_rsqrt_ps(_mm_cvtpd_ps(sum)));
}

/* The same for the lower and the upper pair of lanes. */
CAROM_TARGET_AVX2 static inline __m256d rsqrt_sums(__m256d x) {
  const __m256d sums = _mm256_hadd_pd(x, x);
  return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(sums)));
}

/* (u_x, u_z) at contact A. */
CAROM_TARGET_AVX2 static inline __m128d slip_of_balls(__m256d v, __m256d w, __m128d w_z,
                                                      __m128d R) {
  const __m128d v_ij = _mm_sub_pd(_mm256_castpd256_pd128(v), _mm256_extractf128_pd(v, 1));
  const __m128d w_ij = _mm_add_pd(_mm256_castpd256_pd128(w), _mm256_extractf128_pd(w, 1));
  const __m128d w_zij = _mm_hadd_pd(w_z, w_z);
  return _mm_addsub_pd(_mm_unpacklo_pd(v_ij, _mm_setzero_pd()),
                       _mm_mul_pd(R, _mm_unpacklo_pd(w_zij, w_ij)));
}

/* (d_x, d_y, b_x, b_y) at contacts D and B. */
CAROM_TARGET_AVX2 static inline __m256d slip_on_cloth(__m256d v, __m256d w, __m256d sR) {
  return _mm256_fmadd_pd(sR, _mm256_permute_pd(w, 0x5), v);
}

CAROM_TARGET_AVX2 void carom_rung_double_vec2(carom_local *state, int N) {
  const carom_local c = *state;
  const double M = c.M_i;
  const double recM = 1.0 / M;
  const double C = 5.0 / (2.0 * M * c.R);

  __m256d v = _mm256_setr_pd(c.v_ix, c.v_iy, c.v_jx, c.v_jy);
  __m256d w = _mm256_setr_pd(c.w_ix, c.w_iy, c.w_jx, c.w_jy);
  __m128d w_z = _mm_setr_pd(c.w_iz, c.w_jz);
  double v_n = c.v_jy - c.v_iy;

  const double DP = 0.5 * (1.0 + c.e) * M * fabs(v_n) / N;
  double W = 0.0;

  const __m128d R = _mm_set1_pd(c.R);
  const __m256d sR = _mm256_setr_pd(c.s * c.R, -c.s * c.R, c.s * c.R, -c.s * c.R);
  const __m128d mu_b_DP = _mm_set1_pd(-c.mu_b * DP);
  const __m256d mu_ij = _mm256_setr_pd(c.mu_i, c.mu_i, -c.mu_j, -c.mu_j);
  /* i is pressed where u_z > 0, j where u_z < 0 */
  const __m256d sign = _mm256_setr_pd(1.0, 1.0, -1.0, -1.0);
  const __m256d v_of_DP = _mm256_setr_pd(0.0, -DP * recM, 0.0, DP * recM);
  const __m256d v_of_DP1 = _mm256_setr_pd(recM, 0.0, -recM, 0.0);
  const __m128d w_z_of_DP1 = _mm_set1_pd(-C);
  const __m256d w_of_DP2 = _mm256_setr_pd(C, 0.0, C, 0.0);
  const __m256d v_of_cloth = _mm256_set1_pd(recM);
  const __m256d w_of_cloth = _mm256_setr_pd(C, -C, C, -C); /* of the impulse with x and y swapped */

  __m128d u = slip_of_balls(v, w, w_z, R);
  __m256d db = slip_on_cloth(v, w, sR);
  __m128d ru = rsqrt_sum(_mm_mul_pd(u, u));

  while (v_n <= 0.0) {
    const __m128d slips = _mm_cmp_pd(ru, _mm_set1_pd(1e16), _CMP_LE_OQ);
    const __m128d DP12 = _mm_and_pd(slips, _mm_mul_pd(_mm_mul_pd(mu_b_DP, ru), u));
    const __m256d DP1 = _mm256_broadcastsd_pd(DP12);
    v = _mm256_fmadd_pd(DP1, v_of_DP1, v);
    w_z = _mm_fmadd_pd(_mm256_castpd256_pd128(DP1), w_z_of_DP1, w_z);
    const __m256d u_z = _mm256_permute4x64_pd(_mm256_castpd128_pd256(u), 0x55);
    const __m256d turns = _mm256_cmp_pd(_mm256_andnot_pd(_mm256_set1_pd(-0.0), u_z),
                                        _mm256_set1_pd(1e-16), _CMP_GE_OQ);
    const __m256d DP2 =
        _mm256_and_pd(turns, _mm256_permute4x64_pd(_mm256_castpd128_pd256(DP12), 0x55));
    w = _mm256_fmadd_pd(DP2, w_of_DP2, w);
    const __m256d pressed =
        _mm256_cmp_pd(_mm256_mul_pd(u_z, sign), _mm256_setzero_pd(), _CMP_GT_OQ);
    const __m256d rdb = rsqrt_sums(_mm256_mul_pd(db, db));
    const __m256d finite = _mm256_cmp_pd(rdb, _mm256_set1_pd(INFINITY), _CMP_LT_OQ);
    const __m256d DP_db = _mm256_mul_pd(_mm256_mul_pd(_mm256_mul_pd(mu_ij, rdb), db), DP2);
    const __m256d cloth = _mm256_and_pd(_mm256_and_pd(pressed, finite), DP_db);
    v = _mm256_fmadd_pd(cloth, v_of_cloth, v);
    w = _mm256_fmadd_pd(_mm256_permute_pd(cloth, 0x5), w_of_cloth, w);
    u = slip_of_balls(v, w, w_z, R);
    ru = rsqrt_sum(_mm_mul_pd(u, u));
    v = _mm256_add_pd(v, v_of_DP);
    db = slip_on_cloth(v, w, sR);

    const double v_n_old = v_n;
    const __m128d v_ji = _mm_sub_pd(_mm256_extractf128_pd(v, 1), _mm256_castpd256_pd128(v));
    v_n = _mm_cvtsd_f64(_mm_unpackhi_pd(v_ji, v_ji));
    W -= v_n_old + v_n;
  }

  const double W_f = (1.0 + c.e * c.e) * W;
  while (W < W_f) {
    const __m128d slips = _mm_cmp_pd(ru, _mm_set1_pd(1e16), _CMP_LE_OQ);
    const __m128d DP12 = _mm_and_pd(slips, _mm_mul_pd(_mm_mul_pd(mu_b_DP, ru), u));
    const __m256d DP1 = _mm256_broadcastsd_pd(DP12);
    v = _mm256_fmadd_pd(DP1, v_of_DP1, v);
    w_z = _mm_fmadd_pd(_mm256_castpd256_pd128(DP1), w_z_of_DP1, w_z);
    const __m256d u_z = _mm256_permute4x64_pd(_mm256_castpd128_pd256(u), 0x55);
    const __m256d turns = _mm256_cmp_pd(_mm256_andnot_pd(_mm256_set1_pd(-0.0), u_z),
                                        _mm256_set1_pd(1e-16), _CMP_GE_OQ);
    const __m256d DP2 =
        _mm256_and_pd(turns, _mm256_permute4x64_pd(_mm256_castpd128_pd256(DP12), 0x55));
    w = _mm256_fmadd_pd(DP2, w_of_DP2, w);
    const __m256d pressed =
        _mm256_cmp_pd(_mm256_mul_pd(u_z, sign), _mm256_setzero_pd(), _CMP_GT_OQ);
    const __m256d rdb = rsqrt_sums(_mm256_mul_pd(db, db));
    const __m256d DP_db = _mm256_mul_pd(_mm256_mul_pd(_mm256_mul_pd(mu_ij, rdb), db), DP2);
    const __m256d cloth = _mm256_and_pd(pressed, DP_db);
    v = _mm256_fmadd_pd(cloth, v_of_cloth, v);
    w = _mm256_fmadd_pd(_mm256_permute_pd(cloth, 0x5), w_of_cloth, w);
    u = slip_of_balls(v, w, w_z, R);
    ru = rsqrt_sum(_mm_mul_pd(u, u));
    v = _mm256_add_pd(v, v_of_DP);
    db = slip_on_cloth(v, w, sR);

    const double v_n_old = v_n;
    const __m128d v_ji = _mm_sub_pd(_mm256_extractf128_pd(v, 1), _mm256_castpd256_pd128(v));
    v_n = _mm_cvtsd_f64(_mm_unpackhi_pd(v_ji, v_ji));
    W += v_n_old + v_n;
  }
  double v_of[4], w_of[4], w_z_of[2];
  _mm256_storeu_pd(v_of, v);
  _mm256_storeu_pd(w_of, w);
  _mm_storeu_pd(w_z_of, w_z);
  state->v_ix = v_of[0], state->v_iy = v_of[1], state->v_jx = v_of[2], state->v_jy = v_of[3];
  state->w_ix = w_of[0], state->w_iy = w_of[1], state->w_jx = w_of[2], state->w_jy = w_of[3];
  state->w_iz = w_z_of[0], state->w_jz = w_z_of[1];
}
