/* The body of double, float and double_rsqrt14, from `c`, the state in numbers of the type `real`, to the end of the collision;
 * rsqrt(x) is about 1/sqrt(x), infinity for 0. The text is the same, so `diff double.c float.c` shows the idea of float. */
const real M = c.M_i, R = c.R, sR = c.s * c.R;
const real recM = 1 / M;
const real C = 5 / (2 * M * R);

real u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
real u_z = R * (c.w_ix + c.w_jx);
real d_x = c.v_ix + sR * c.w_iy, d_y = c.v_iy - sR * c.w_ix;
real b_x = c.v_jx + sR * c.w_jy, b_y = c.v_jy - sR * c.w_jx;
real ru = rsqrt(u_x * u_x + u_z * u_z);
real v_n = c.v_jy - c.v_iy;

const real DP = (real)0.5 * (1 + c.e) * M * fabs(v_n) / (real)N;
real W = 0;

while (v_n <= 0) {
#define MAY_NOT_SLIP 1
#include "scalar_step.h"
#undef MAY_NOT_SLIP
  const real v_n_old = v_n;
  v_n = c.v_jy - c.v_iy;
  W -= v_n_old + v_n;
}

const real W_f = (1 + c.e * c.e) * W;
while (W < W_f) {
#define MAY_NOT_SLIP 0
#include "scalar_step.h"
#undef MAY_NOT_SLIP
  const real v_n_old = v_n;
  v_n = c.v_jy - c.v_iy;
  W += v_n_old + v_n;
}
