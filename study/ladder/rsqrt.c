/* rsqrt: the processor's estimate of 1/sqrt(x) in place of a square root and the divisions by
 * it.
 *
 * u, d, b become ru, rd, rb, the reciprocals of the magnitudes; "no slip" is now a reciprocal
 * that is too large or infinite. The estimate takes and gives single precision, 12 bits of it
 * good: two conversions, and friction wrong by 4e-4 at the most.
 *
 * Paper: 1.26. The estimate and its conversions are a shorter chain than a square root and a
 * division.
 */
#include "rung.h"

#include <math.h>
#include <stdbool.h>
#include <xmmintrin.h>

/* About 1/sqrt(x), to 12 bits; infinity for 0. */
static inline double rsqrt(double x) {
  return _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set1_ps((float)x)));
}

void carom_rung_rsqrt(carom_local *state, int N) {
  carom_local c = *state;
  const double M = c.M_i, R = c.R, sR = c.s * c.R;
  const double C = 5.0 / (2.0 * M * R);

  double u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
  double u_z = R * (c.w_ix + c.w_jx);
  double d_x = c.v_ix + sR * c.w_iy, d_y = c.v_iy - sR * c.w_ix;
  double b_x = c.v_jx + sR * c.w_jy, b_y = c.v_jy - sR * c.w_jx;
  double ru = rsqrt(u_x * u_x + u_z * u_z);
  double rd = rsqrt(d_x * d_x + d_y * d_y);
  double rb = rsqrt(b_x * b_x + b_y * b_y);
  double v_n = c.v_jy - c.v_iy;

  const double DP = 0.5 * (1.0 + c.e) * M * fabs(v_n) / N;
  double W = 0.0, W_f = INFINITY;
  bool compressing = true;

  while (v_n < 0.0 || W < W_f) {
    double DP1 = 0.0, DP2 = 0.0, DP_ix = 0.0, DP_iy = 0.0, DP_jx = 0.0, DP_jy = 0.0;
    if (ru <= 1e16) {
      DP1 = -c.mu_b * DP * u_x * ru;
      if (fabs(u_z) >= 1e-16) {
        DP2 = -c.mu_b * DP * u_z * ru;
        if (DP2 > 0.0) {
          if (rb < INFINITY) {
            DP_jx = -c.mu_j * (b_x * rb) * DP2;
            DP_jy = -c.mu_j * (b_y * rb) * DP2;
          }
        } else {
          if (rd < INFINITY) {
            DP_ix = c.mu_i * (d_x * rd) * DP2;
            DP_iy = c.mu_i * (d_y * rd) * DP2;
          }
        }
      }
    }

    c.v_ix += (DP1 + DP_ix) / M;
    c.v_iy += (-DP + DP_iy) / M;
    c.v_jx += (-DP1 + DP_jx) / M;
    c.v_jy += (DP + DP_jy) / M;
    c.w_ix += C * (DP2 + DP_iy);
    c.w_iy += C * -DP_ix;
    c.w_iz += C * -DP1;
    c.w_jx += C * (DP2 + DP_jy);
    c.w_jy += C * -DP_jx;
    c.w_jz += C * -DP1;

    u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
    u_z = R * (c.w_ix + c.w_jx);
    d_x = c.v_ix + sR * c.w_iy;
    d_y = c.v_iy - sR * c.w_ix;
    b_x = c.v_jx + sR * c.w_jy;
    b_y = c.v_jy - sR * c.w_jx;
    ru = rsqrt(u_x * u_x + u_z * u_z);
    rd = rsqrt(d_x * d_x + d_y * d_y);
    rb = rsqrt(b_x * b_x + b_y * b_y);

    const double v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W += 0.5 * DP * fabs(v_n_old + v_n);
    if (compressing && v_n > 0.0) {
      compressing = false;
      W_f = (1.0 + c.e * c.e) * W;
    }
  }
  *state = c;
}
