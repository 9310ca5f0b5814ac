/* double_newton: double with one Newton step after the instruction.
 *
 * The step squares the error of the estimate, so 12 correct bits become 23. It adds three or four
 * dependent operations to the chain, as the compiler groups the product.
 *
 * Paper: not in it. It is the fastest scalar kernel of another study of the same algorithm
 * (docs/study/paper.md, related work).
 */
#include "rung.h"

#include <math.h>
#include <xmmintrin.h>

/* About 1/sqrt(x), wrong by 2e-7 at the most. Not a number for 0, and minus infinity where x is
 * too small for single precision, so the comparisons below differ from those of double. */
static inline double rsqrt(double x) {
  const double y = _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set1_ps((float)x)));
  return y * (1.5 - 0.5 * x * (y * y));
}

void carom_rung_double_newton(carom_local *state, int N) {
  carom_local c = *state;
  const double M = c.M_i, R = c.R, sR = c.s * c.R;
  const double recM = 1.0 / M;
  const double C = 5.0 / (2.0 * M * R);

  double u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
  double u_z = R * (c.w_ix + c.w_jx);
  double d_x = c.v_ix + sR * c.w_iy, d_y = c.v_iy - sR * c.w_ix;
  double b_x = c.v_jx + sR * c.w_jy, b_y = c.v_jy - sR * c.w_jx;
  double ru = rsqrt(u_x * u_x + u_z * u_z);
  double v_n = c.v_jy - c.v_iy;

  const double DP = 0.5 * (1.0 + c.e) * M * fabs(v_n) / N;
  double W = 0.0;

  while (v_n <= 0.0) {
    if (fabs(ru) <= 1e16) {
      const double t = -c.mu_b * DP * ru;
      const double DP1 = t * u_x;
      const double Dw_z = C * -DP1;
      c.v_ix += DP1 * recM;
      c.v_jx -= DP1 * recM;
      c.w_iz += Dw_z;
      c.w_jz += Dw_z;
      if (fabs(u_z) >= 1e-16) {
        const double DP2 = t * u_z;
        c.w_ix += C * DP2;
        c.w_jx += C * DP2;
        if (u_z < 0.0) {
          const double rb = rsqrt(b_x * b_x + b_y * b_y);
          if (rb > 0.0) {
            const double t_j = -c.mu_j * rb;
            const double DP_jx = t_j * b_x * DP2;
            const double DP_jy = t_j * b_y * DP2;
            c.v_jx += DP_jx * recM;
            c.v_jy += DP_jy * recM;
            c.w_jx += C * DP_jy;
            c.w_jy -= C * DP_jx;
          }
        } else {
          const double rd = rsqrt(d_x * d_x + d_y * d_y);
          if (rd > 0.0) {
            const double t_i = c.mu_i * rd;
            const double DP_ix = t_i * d_x * DP2;
            const double DP_iy = t_i * d_y * DP2;
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

    const double v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W -= v_n_old + v_n;
  }

  const double W_f = (1.0 + c.e * c.e) * W;
  while (W < W_f) {
    if (fabs(ru) <= 1e16) {
      const double t = -c.mu_b * DP * ru;
      const double DP1 = t * u_x;
      const double Dw_z = C * -DP1;
      c.v_ix += DP1 * recM;
      c.v_jx -= DP1 * recM;
      c.w_iz += Dw_z;
      c.w_jz += Dw_z;
      if (fabs(u_z) >= 1e-16) {
        const double DP2 = t * u_z;
        c.w_ix += C * DP2;
        c.w_jx += C * DP2;
        if (u_z < 0.0) {
          const double rb = rsqrt(b_x * b_x + b_y * b_y);
          const double t_j = -c.mu_j * rb;
          const double DP_jx = t_j * b_x * DP2;
          const double DP_jy = t_j * b_y * DP2;
          c.v_jx += DP_jx * recM;
          c.v_jy += DP_jy * recM;
          c.w_jx += C * DP_jy;
          c.w_jy -= C * DP_jx;
        } else {
          const double rd = rsqrt(d_x * d_x + d_y * d_y);
          const double t_i = c.mu_i * rd;
          const double DP_ix = t_i * d_x * DP2;
          const double DP_iy = t_i * d_y * DP2;
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

    const double v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W += v_n_old + v_n;
  }
  *state = c;
}
