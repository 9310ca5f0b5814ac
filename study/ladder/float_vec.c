/* float_vec: the whole loop body in 128-bit vectors, without branches.
 *
 * Laid out as double_vec, with four floats in a register: (x, y) of ball i and of ball j. One
 * estimate serves all three magnitudes.
 *
 * Paper: slower than float. A third of the instructions move numbers between lanes.
 */
#include "rung.h"

#include <immintrin.h>
#include <math.h>

/* About 1/|(a_0, a_1)|, 1/|(a_2, a_3)|, 1/|(b_0, b_1)|, 1/|(b_2, b_3)|, to 12 bits. The least is
 * added so that what does not slip gets a finite number: times the slip, that is no friction. */
CAROM_TARGET_AVX2 static inline __m128 rlengths(__m128 a, __m128 b) {
  const __m128 least = _mm_set1_ps(1e-32f);
  return _mm_rsqrt_ps(_mm_hadd_ps(_mm_fmadd_ps(a, a, least), _mm_fmadd_ps(b, b, least)));
}

/* (u_x, u_z, u_x, u_z) at contact A; v_ij = v_i - v_j, the rest sums over both balls. */
CAROM_TARGET_AVX2 static inline __m128 slip_of_balls(__m128 v_ij, __m128 w, __m128 w_z, __m128 R) {
  const __m128 w_ij = _mm_add_ps(w, _mm_movehl_ps(w, w)),
               w_zij = _mm_add_ps(w_z, _mm_movehl_ps(w_z, w_z));
  const __m128 u = _mm_addsub_ps(_mm_unpacklo_ps(v_ij, _mm_setzero_ps()),
                                 _mm_mul_ps(R, _mm_unpacklo_ps(w_zij, w_ij)));
  return _mm_movelh_ps(u, u);
}

/* (d_x, d_y, b_x, b_y) at contacts D and B. */
CAROM_TARGET_AVX2 static inline __m128 slip_on_cloth(__m128 v, __m128 w, __m128 sR) {
  return _mm_fmadd_ps(sR, _mm_permute_ps(w, 0xb1), v);
}

CAROM_TARGET_AVX2 void carom_rung_float_vec(carom_local *state, int N) {
  const carom_local_f32 c = carom_to_single(state);
  const float M = c.M_i;
  const float recM = 1.0f / M;
  const float C = 5.0f / (2.0f * M * c.R);

  __m128 v = _mm_setr_ps(c.v_ix, c.v_iy, c.v_jx, c.v_jy);
  __m128 w = _mm_setr_ps(c.w_ix, c.w_iy, c.w_jx, c.w_jy);
  __m128 w_z = _mm_setr_ps(c.w_iz, 0.0f, c.w_jz, 0.0f);
  float v_n = c.v_jy - c.v_iy;

  const float DP = 0.5f * (1.0f + c.e) * M * fabsf(v_n) / (float)N;
  float W = 0.0f;

  const __m128 R = _mm_set1_ps(c.R);
  const __m128 sR = _mm_setr_ps(c.s * c.R, -c.s * c.R, c.s * c.R, -c.s * c.R);
  const __m128 mu_b_DP = _mm_set1_ps(-c.mu_b * DP);
  const __m128 mu_ij = _mm_setr_ps(c.mu_i, c.mu_i, -c.mu_j, -c.mu_j);
  /* i is pressed where u_z > 0, j where u_z < 0 */
  const __m128 sign = _mm_setr_ps(1.0f, 1.0f, -1.0f, -1.0f);
  const __m128 v_of_DP = _mm_setr_ps(0.0f, -DP * recM, 0.0f, DP * recM);
  const __m128 v_of_DP1 = _mm_setr_ps(recM, 0.0f, -recM, 0.0f);
  const __m128 w_z_of_DP1 = _mm_setr_ps(-C, 0.0f, -C, 0.0f);
  const __m128 w_of_DP2 = _mm_setr_ps(C, 0.0f, C, 0.0f);
  const __m128 v_of_cloth = _mm_set1_ps(recM);
  const __m128 w_of_cloth = _mm_setr_ps(C, -C, C, -C); /* of the impulse with x and y swapped */

  __m128 u = slip_of_balls(_mm_sub_ps(v, _mm_movehl_ps(v, v)), w, w_z, R);
  __m128 db = slip_on_cloth(v, w, sR);

  while (v_n <= 0.0f) {
    const __m128 pressed =
        _mm_cmpgt_ps(_mm_mul_ps(_mm_permute_ps(u, 0x55), sign), _mm_setzero_ps());
    const __m128 mu = _mm_and_ps(pressed, mu_ij);
    const __m128 r = rlengths(db, u); /* rd, rb, ru, ru */
    const __m128 DP12 = _mm_mul_ps(_mm_mul_ps(mu_b_DP, u), _mm_movehl_ps(r, r));
    const __m128 DP1 = _mm_permute_ps(DP12, 0x00), DP2 = _mm_permute_ps(DP12, 0x55);
    const __m128 cloth = _mm_mul_ps(_mm_mul_ps(_mm_mul_ps(mu, _mm_unpacklo_ps(r, r)), db), DP2);
    v = _mm_fmadd_ps(cloth, v_of_cloth, _mm_fmadd_ps(DP1, v_of_DP1, _mm_add_ps(v, v_of_DP)));
    w = _mm_fmadd_ps(_mm_permute_ps(cloth, 0xb1), w_of_cloth, _mm_fmadd_ps(DP2, w_of_DP2, w));
    w_z = _mm_fmadd_ps(DP1, w_z_of_DP1, w_z);
    const __m128 v_ij = _mm_sub_ps(v, _mm_movehl_ps(v, v));
    u = slip_of_balls(v_ij, w, w_z, R);
    db = slip_on_cloth(v, w, sR);

    const float v_n_old = v_n;
    v_n = -_mm_cvtss_f32(_mm_movehdup_ps(v_ij));
    W -= v_n_old + v_n;
  }

  const float W_f = (1.0f + c.e * c.e) * W;
  while (W < W_f) {
    const __m128 pressed =
        _mm_cmpgt_ps(_mm_mul_ps(_mm_permute_ps(u, 0x55), sign), _mm_setzero_ps());
    const __m128 mu = _mm_and_ps(pressed, mu_ij);
    const __m128 r = rlengths(db, u); /* rd, rb, ru, ru */
    const __m128 DP12 = _mm_mul_ps(_mm_mul_ps(mu_b_DP, u), _mm_movehl_ps(r, r));
    const __m128 DP1 = _mm_permute_ps(DP12, 0x00), DP2 = _mm_permute_ps(DP12, 0x55);
    const __m128 cloth = _mm_mul_ps(_mm_mul_ps(_mm_mul_ps(mu, _mm_unpacklo_ps(r, r)), db), DP2);
    v = _mm_fmadd_ps(cloth, v_of_cloth, _mm_fmadd_ps(DP1, v_of_DP1, _mm_add_ps(v, v_of_DP)));
    w = _mm_fmadd_ps(_mm_permute_ps(cloth, 0xb1), w_of_cloth, _mm_fmadd_ps(DP2, w_of_DP2, w));
    w_z = _mm_fmadd_ps(DP1, w_z_of_DP1, w_z);
    const __m128 v_ij = _mm_sub_ps(v, _mm_movehl_ps(v, v));
    u = slip_of_balls(v_ij, w, w_z, R);
    db = slip_on_cloth(v, w, sR);

    const float v_n_old = v_n;
    v_n = -_mm_cvtss_f32(_mm_movehdup_ps(v_ij));
    W += v_n_old + v_n;
  }
  float v_of[4], w_of[4], w_z_of[4];
  _mm_storeu_ps(v_of, v);
  _mm_storeu_ps(w_of, w);
  _mm_storeu_ps(w_z_of, w_z);
  state->v_ix = v_of[0], state->v_iy = v_of[1], state->v_jx = v_of[2], state->v_jy = v_of[3];
  state->w_ix = w_of[0], state->w_iy = w_of[1], state->w_jx = w_of[2], state->w_jy = w_of[3];
  state->w_iz = w_z_of[0], state->w_jz = w_z_of[2];
}
