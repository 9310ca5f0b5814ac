/* float: double in single precision, without conversions.
 *
 * Paper: 1.87, and 1.93 with archnative, its best. The two conversions stood in the chain, with 3
 * cycles each. The price: rounding of 6e-8 a step, the larger a share of what a step adds the
 * more steps there are.
 */
#include "rung.h"

#include <math.h>
#include <xmmintrin.h>

/* About 1/sqrt(x), to 12 bits; infinity for 0. */
static inline float rsqrt(float x) {
  return _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set1_ps(x)));
}

void carom_rung_float(carom_local *state, int N) {
  carom_local_f32 c = carom_to_single(state);
  const float M = c.M_i, R = c.R, sR = c.s * c.R;
  const float recM = 1.0f / M;
  const float C = 5.0f / (2.0f * M * R);

  float u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
  float u_z = R * (c.w_ix + c.w_jx);
  float d_x = c.v_ix + sR * c.w_iy, d_y = c.v_iy - sR * c.w_ix;
  float b_x = c.v_jx + sR * c.w_jy, b_y = c.v_jy - sR * c.w_jx;
  float ru = rsqrt(u_x * u_x + u_z * u_z);
  float v_n = c.v_jy - c.v_iy;

  const float DP = 0.5f * (1.0f + c.e) * M * fabsf(v_n) / (float)N;
  float W = 0.0f;

  while (v_n <= 0.0f) {
    if (ru <= 1e16f) {
      const float t = -c.mu_b * DP * ru;
      const float DP1 = t * u_x;
      const float Dw_z = C * -DP1;
      c.v_ix += DP1 * recM;
      c.v_jx -= DP1 * recM;
      c.w_iz += Dw_z;
      c.w_jz += Dw_z;
      if (fabsf(u_z) >= 1e-16f) {
        const float DP2 = t * u_z;
        c.w_ix += C * DP2;
        c.w_jx += C * DP2;
        if (u_z < 0.0f) {
          const float rb = rsqrt(b_x * b_x + b_y * b_y);
          if (rb < INFINITY) {
            const float t_j = -c.mu_j * rb;
            const float DP_jx = t_j * b_x * DP2;
            const float DP_jy = t_j * b_y * DP2;
            c.v_jx += DP_jx * recM;
            c.v_jy += DP_jy * recM;
            c.w_jx += C * DP_jy;
            c.w_jy -= C * DP_jx;
          }
        } else {
          const float rd = rsqrt(d_x * d_x + d_y * d_y);
          if (rd < INFINITY) {
            const float t_i = c.mu_i * rd;
            const float DP_ix = t_i * d_x * DP2;
            const float DP_iy = t_i * d_y * DP2;
            c.v_ix += DP_ix * recM;
            c.v_iy += DP_iy * recM;
            c.w_ix += C * DP_iy;
            c.w_iy -= C * DP_ix;
          }
        }
      }
      u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
      u_z = R * (c.w_ix + c.w_jx);
      ru = rsqrt(u_x * u_x + u_z * u_z);
    }
    c.v_iy -= DP * recM;
    c.v_jy += DP * recM;

    d_x = c.v_ix + sR * c.w_iy;
    d_y = c.v_iy - sR * c.w_ix;
    b_x = c.v_jx + sR * c.w_jy;
    b_y = c.v_jy - sR * c.w_jx;

    const float v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W -= v_n_old + v_n;
  }

  const float W_f = (1.0f + c.e * c.e) * W;
  while (W < W_f) {
    if (ru <= 1e16f) {
      const float t = -c.mu_b * DP * ru;
      const float DP1 = t * u_x;
      const float Dw_z = C * -DP1;
      c.v_ix += DP1 * recM;
      c.v_jx -= DP1 * recM;
      c.w_iz += Dw_z;
      c.w_jz += Dw_z;
      if (fabsf(u_z) >= 1e-16f) {
        const float DP2 = t * u_z;
        c.w_ix += C * DP2;
        c.w_jx += C * DP2;
        if (u_z < 0.0f) {
          const float rb = rsqrt(b_x * b_x + b_y * b_y);
          const float t_j = -c.mu_j * rb;
          const float DP_jx = t_j * b_x * DP2;
          const float DP_jy = t_j * b_y * DP2;
          c.v_jx += DP_jx * recM;
          c.v_jy += DP_jy * recM;
          c.w_jx += C * DP_jy;
          c.w_jy -= C * DP_jx;
        } else {
          const float rd = rsqrt(d_x * d_x + d_y * d_y);
          const float t_i = c.mu_i * rd;
          const float DP_ix = t_i * d_x * DP2;
          const float DP_iy = t_i * d_y * DP2;
          c.v_ix += DP_ix * recM;
          c.v_iy += DP_iy * recM;
          c.w_ix += C * DP_iy;
          c.w_iy -= C * DP_ix;
        }
      }
      u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
      u_z = R * (c.w_ix + c.w_jx);
      ru = rsqrt(u_x * u_x + u_z * u_z);
    }
    c.v_iy -= DP * recM;
    c.v_jy += DP * recM;

    d_x = c.v_ix + sR * c.w_iy;
    d_y = c.v_iy - sR * c.w_ix;
    b_x = c.v_jx + sR * c.w_jy;
    b_y = c.v_jy - sR * c.w_jx;

    const float v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W += v_n_old + v_n;
  }
  carom_from_single(&c, state);
}
