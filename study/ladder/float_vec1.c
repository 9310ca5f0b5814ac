/* float_vec1: vector helpers, the loop around them scalar.
 *
 * The slip velocities are v + w × r with a vector product, their magnitudes a dot product, of
 * 128-bit vectors that are packed from scalars and taken apart again. (In the paper the helpers
 * served the change of frame as well; here that is outside the rungs.)
 *
 * Paper: slower than float. The general vector product also multiplies by the zeros in r, and
 * packing is in the chain.
 */
#include "rung.h"

#include <immintrin.h>
#include <math.h>

/* The velocity v + w × r of the point at r from the centre. */
CAROM_TARGET_AVX2 static inline __m128 slip(__m128 v, __m128 w, __m128 r) {
  const __m128 w_yzx = _mm_permute_ps(w, 0xc9), r_yzx = _mm_permute_ps(r, 0xc9);
  const __m128 zxy = _mm_fmsub_ps(w, r_yzx, _mm_mul_ps(w_yzx, r));
  return _mm_add_ps(v, _mm_permute_ps(zxy, 0xc9));
}

/* About 1/|a|, to 12 bits; infinity for 0. */
CAROM_TARGET_AVX2 static inline float rlength(__m128 a) {
  return _mm_cvtss_f32(_mm_rsqrt_ss(_mm_dp_ps(a, a, 0x71)));
}

CAROM_TARGET_AVX2 static inline float x_of(__m128 a) {
  return _mm_cvtss_f32(a);
}
CAROM_TARGET_AVX2 static inline float y_of(__m128 a) {
  return _mm_cvtss_f32(_mm_movehdup_ps(a));
}
CAROM_TARGET_AVX2 static inline float z_of(__m128 a) {
  return _mm_cvtss_f32(_mm_movehl_ps(a, a));
}

CAROM_TARGET_AVX2 void carom_rung_float_vec1(carom_local *state, int N) {
  carom_local_f32 c = carom_to_single(state);
  const float M = c.M_i, R = c.R, sR = c.s * c.R;
  const float recM = 1.0f / M;
  const float C = 5.0f / (2.0f * M * R);

  const __m128 r_A = _mm_setr_ps(0.0f, R, 0.0f, 0.0f), r_DB = _mm_setr_ps(0.0f, 0.0f, sR, 0.0f);
  __m128 u = slip(_mm_setr_ps(c.v_ix - c.v_jx, 0.0f, 0.0f, 0.0f),
                  _mm_setr_ps(c.w_ix + c.w_jx, c.w_iy + c.w_jy, c.w_iz + c.w_jz, 0.0f), r_A);
  __m128 d = slip(_mm_setr_ps(c.v_ix, c.v_iy, 0.0f, 0.0f),
                  _mm_setr_ps(c.w_ix, c.w_iy, c.w_iz, 0.0f), r_DB);
  __m128 b = slip(_mm_setr_ps(c.v_jx, c.v_jy, 0.0f, 0.0f),
                  _mm_setr_ps(c.w_jx, c.w_jy, c.w_jz, 0.0f), r_DB);
  float ru = rlength(u);
  float v_n = c.v_jy - c.v_iy;

  const float DP = 0.5f * (1.0f + c.e) * M * fabsf(v_n) / (float)N;
  float W = 0.0f;

  while (v_n <= 0.0f) {
    if (ru <= 1e16f) {
      const float t = -c.mu_b * DP * ru;
      const float DP1 = t * x_of(u);
      const float Dw_z = C * -DP1;
      c.v_ix += DP1 * recM;
      c.v_jx -= DP1 * recM;
      c.w_iz += Dw_z;
      c.w_jz += Dw_z;
      if (fabsf(z_of(u)) >= 1e-16f) {
        const float DP2 = t * z_of(u);
        c.w_ix += C * DP2;
        c.w_jx += C * DP2;
        if (z_of(u) < 0.0f) {
          const float rb = rlength(b);
          if (rb < INFINITY) {
            const float t_j = -c.mu_j * rb;
            const float DP_jx = t_j * x_of(b) * DP2;
            const float DP_jy = t_j * y_of(b) * DP2;
            c.v_jx += DP_jx * recM;
            c.v_jy += DP_jy * recM;
            c.w_jx += C * DP_jy;
            c.w_jy -= C * DP_jx;
          }
        } else {
          const float rd = rlength(d);
          if (rd < INFINITY) {
            const float t_i = c.mu_i * rd;
            const float DP_ix = t_i * x_of(d) * DP2;
            const float DP_iy = t_i * y_of(d) * DP2;
            c.v_ix += DP_ix * recM;
            c.v_iy += DP_iy * recM;
            c.w_ix += C * DP_iy;
            c.w_iy -= C * DP_ix;
          }
        }
      }
      u = slip(_mm_setr_ps(c.v_ix - c.v_jx, 0.0f, 0.0f, 0.0f),
               _mm_setr_ps(c.w_ix + c.w_jx, c.w_iy + c.w_jy, c.w_iz + c.w_jz, 0.0f), r_A);
      ru = rlength(u);
    }
    c.v_iy -= DP * recM;
    c.v_jy += DP * recM;

    d = slip(_mm_setr_ps(c.v_ix, c.v_iy, 0.0f, 0.0f), _mm_setr_ps(c.w_ix, c.w_iy, c.w_iz, 0.0f),
             r_DB);
    b = slip(_mm_setr_ps(c.v_jx, c.v_jy, 0.0f, 0.0f), _mm_setr_ps(c.w_jx, c.w_jy, c.w_jz, 0.0f),
             r_DB);

    const float v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W -= v_n_old + v_n;
  }

  const float W_f = (1.0f + c.e * c.e) * W;
  while (W < W_f) {
    if (ru <= 1e16f) {
      const float t = -c.mu_b * DP * ru;
      const float DP1 = t * x_of(u);
      const float Dw_z = C * -DP1;
      c.v_ix += DP1 * recM;
      c.v_jx -= DP1 * recM;
      c.w_iz += Dw_z;
      c.w_jz += Dw_z;
      if (fabsf(z_of(u)) >= 1e-16f) {
        const float DP2 = t * z_of(u);
        c.w_ix += C * DP2;
        c.w_jx += C * DP2;
        if (z_of(u) < 0.0f) {
          const float rb = rlength(b);
          const float t_j = -c.mu_j * rb;
          const float DP_jx = t_j * x_of(b) * DP2;
          const float DP_jy = t_j * y_of(b) * DP2;
          c.v_jx += DP_jx * recM;
          c.v_jy += DP_jy * recM;
          c.w_jx += C * DP_jy;
          c.w_jy -= C * DP_jx;
        } else {
          const float rd = rlength(d);
          const float t_i = c.mu_i * rd;
          const float DP_ix = t_i * x_of(d) * DP2;
          const float DP_iy = t_i * y_of(d) * DP2;
          c.v_ix += DP_ix * recM;
          c.v_iy += DP_iy * recM;
          c.w_ix += C * DP_iy;
          c.w_iy -= C * DP_ix;
        }
      }
      u = slip(_mm_setr_ps(c.v_ix - c.v_jx, 0.0f, 0.0f, 0.0f),
               _mm_setr_ps(c.w_ix + c.w_jx, c.w_iy + c.w_jy, c.w_iz + c.w_jz, 0.0f), r_A);
      ru = rlength(u);
    }
    c.v_iy -= DP * recM;
    c.v_jy += DP * recM;

    d = slip(_mm_setr_ps(c.v_ix, c.v_iy, 0.0f, 0.0f), _mm_setr_ps(c.w_ix, c.w_iy, c.w_iz, 0.0f),
             r_DB);
    b = slip(_mm_setr_ps(c.v_jx, c.v_jy, 0.0f, 0.0f), _mm_setr_ps(c.w_jx, c.w_jy, c.w_jz, 0.0f),
             r_DB);

    const float v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W += v_n_old + v_n;
  }
  carom_from_single(&c, state);
}
