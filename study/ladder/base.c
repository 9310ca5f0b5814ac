/* base: Mathavan's algorithm written down as pooltool has it.
 *
 * Every impulse is set to zero and then, branch by branch, to its value; all velocities are
 * updated from all impulses; all slip velocities and their magnitudes are computed anew at the
 * end of a step. The arithmetic is that of core/src/ball_ball/euler.c, operation by operation, so
 * where the compiler may not rearrange it (o3, novec) the result is pooltool's to the last bit.
 *
 * Paper: 1.00, 85.3 cycles a step on Zen 2. A square root and a division stand in the chain that
 * leads from one step to the next.
 */
#include "rung.h"

#include <math.h>
#include <stdbool.h>

void carom_rung_base(carom_local *state, int N) {
  carom_local c = *state;
  const double M = c.M_i, R = c.R, sR = c.s * c.R;
  const double C = 5.0 / (2.0 * M * R);

  double u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
  double u_z = R * (c.w_ix + c.w_jx);
  double d_x = c.v_ix + sR * c.w_iy, d_y = c.v_iy - sR * c.w_ix;
  double b_x = c.v_jx + sR * c.w_jy, b_y = c.v_jy - sR * c.w_jx;
  double u = sqrt(u_x * u_x + u_z * u_z);
  double d = sqrt(d_x * d_x + d_y * d_y);
  double b = sqrt(b_x * b_x + b_y * b_y);
  double v_n = c.v_jy - c.v_iy;

  const double DP = 0.5 * (1.0 + c.e) * M * fabs(v_n) / N;
  double W = 0.0, W_f = INFINITY;
  bool compressing = true;

  while (v_n < 0.0 || W < W_f) {
    double DP1 = 0.0, DP2 = 0.0, DP_ix = 0.0, DP_iy = 0.0, DP_jx = 0.0, DP_jy = 0.0;
    if (u >= 1e-16) {
      DP1 = -c.mu_b * DP * u_x / u;
      if (fabs(u_z) >= 1e-16) {
        DP2 = -c.mu_b * DP * u_z / u;
        if (DP2 > 0.0) {
          if (b > 0.0) {
            DP_jx = -c.mu_j * (b_x / b) * DP2;
            DP_jy = -c.mu_j * (b_y / b) * DP2;
          }
        } else {
          if (d > 0.0) {
            DP_ix = c.mu_i * (d_x / d) * DP2;
            DP_iy = c.mu_i * (d_y / d) * DP2;
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
    u = sqrt(u_x * u_x + u_z * u_z);
    d = sqrt(d_x * d_x + d_y * d_y);
    b = sqrt(b_x * b_x + b_y * b_y);

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
