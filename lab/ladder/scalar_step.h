/* One step of sepwhile and of scalar.h, whose texts include it twice. Where MAY_NOT_SLIP is 1, the pressed ball is asked. */
if (ru <= (real)1e16) {
  const real t = -c.mu_b * DP * ru;
  const real DP1 = t * u_x;
  const real Dw_z = C * -DP1;
  c.v_ix += DP1 * recM;
  c.v_jx -= DP1 * recM;
  c.w_iz += Dw_z;
  c.w_jz += Dw_z;
  if (fabs(u_z) >= (real)1e-16) {
    const real DP2 = t * u_z;
    c.w_ix += C * DP2;
    c.w_jx += C * DP2;
    if (u_z < 0) {
      const real rb = rsqrt(b_x * b_x + b_y * b_y);
      if (!MAY_NOT_SLIP || rb < (real)INFINITY) {
        const real t_j = -c.mu_j * rb;
        const real DP_jx = t_j * b_x * DP2;
        const real DP_jy = t_j * b_y * DP2;
        c.v_jx += DP_jx * recM;
        c.v_jy += DP_jy * recM;
        c.w_jx += C * DP_jy;
        c.w_jy -= C * DP_jx;
      }
    } else {
      const real rd = rsqrt(d_x * d_x + d_y * d_y);
      if (!MAY_NOT_SLIP || rd < (real)INFINITY) {
        const real t_i = c.mu_i * rd;
        const real DP_ix = t_i * d_x * DP2;
        const real DP_iy = t_i * d_y * DP2;
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
