// `base` of the ladder (lab/ladder/base.c) in plain JavaScript: Mathavan's algorithm, operation by operation, in about N steps of normal
// impulse. Symbols and frame are those of src/ball_ball/euler.c. For equal masses it has the bits of carom's Euler steps.

/**
 * One collision: 26 numbers of `rows` from `at` on, as in carom_impact, to 12 numbers of `out` from `to` on. `s` is the sign of spin in the
 * slip on the cloth: -1 the 2014 paper's, +1 pooltool's.
 */
export function base(rows, at, N, s, out, to) {
  // the frame: y along the line of centres, z up, x = y cross z
  const r_x = rows[at + 12] - rows[at];
  const r_y = rows[at + 13] - rows[at + 1];
  const r_z = rows[at + 14] - rows[at + 2];
  const distance = Math.sqrt(r_x * r_x + r_y * r_y + r_z * r_z);
  const y_x = r_x / distance;
  const y_y = r_y / distance;
  const x_x = y_y;
  const x_y = -y_x;
  let v_ix = rows[at + 3] * x_x + rows[at + 4] * x_y;
  let v_iy = rows[at + 3] * y_x + rows[at + 4] * y_y;
  let w_ix = rows[at + 6] * x_x + rows[at + 7] * x_y;
  let w_iy = rows[at + 6] * y_x + rows[at + 7] * y_y;
  let w_iz = rows[at + 8];
  let v_jx = rows[at + 15] * x_x + rows[at + 16] * x_y;
  let v_jy = rows[at + 15] * y_x + rows[at + 16] * y_y;
  let w_jx = rows[at + 18] * x_x + rows[at + 19] * x_y;
  let w_jy = rows[at + 18] * y_x + rows[at + 19] * y_y;
  let w_jz = rows[at + 20];
  const R = rows[at + 9];
  const M = rows[at + 10];
  const mu_i = rows[at + 11];
  const mu_j = rows[at + 23];
  const mu_b = rows[at + 24];
  const e = rows[at + 25];
  const sR = s * R;
  const C = 5.0 / (2.0 * M * R);

  // slips at the contacts: ball on ball, ball i on the cloth, ball j on the cloth
  let u_x = v_ix - v_jx - R * (w_iz + w_jz);
  let u_z = R * (w_ix + w_jx);
  let d_x = v_ix + sR * w_iy;
  let d_y = v_iy - sR * w_ix;
  let b_x = v_jx + sR * w_jy;
  let b_y = v_jy - sR * w_jx;
  let u = Math.sqrt(u_x * u_x + u_z * u_z);
  let d = Math.sqrt(d_x * d_x + d_y * d_y);
  let b = Math.sqrt(b_x * b_x + b_y * b_y);
  let v_n = v_jy - v_iy;

  const DP = (0.5 * (1.0 + e) * M * Math.abs(v_n)) / N;
  let W = 0.0;
  let W_f = Infinity;
  let compressing = true;
  while (v_n < 0.0 || W < W_f) {
    // the impulses of a step
    let DP1 = 0.0;
    let DP2 = 0.0;
    let DP_ix = 0.0;
    let DP_iy = 0.0;
    let DP_jx = 0.0;
    let DP_jy = 0.0;
    if (u >= 1e-16) {
      DP1 = (-mu_b * DP * u_x) / u;
      if (Math.abs(u_z) >= 1e-16) {
        DP2 = (-mu_b * DP * u_z) / u;
        if (DP2 > 0.0) {
          if (b > 0.0) {
            DP_jx = -mu_j * (b_x / b) * DP2;
            DP_jy = -mu_j * (b_y / b) * DP2;
          }
        } else if (d > 0.0) {
          DP_ix = mu_i * (d_x / d) * DP2;
          DP_iy = mu_i * (d_y / d) * DP2;
        }
      }
    }

    // velocities and spins
    v_ix += (DP1 + DP_ix) / M;
    v_iy += (-DP + DP_iy) / M;
    v_jx += (-DP1 + DP_jx) / M;
    v_jy += (DP + DP_jy) / M;
    w_ix += C * (DP2 + DP_iy);
    w_iy += C * -DP_ix;
    w_iz += C * -DP1;
    w_jx += C * (DP2 + DP_jy);
    w_jy += C * -DP_jx;
    w_jz += C * -DP1;

    // slips again
    u_x = v_ix - v_jx - R * (w_iz + w_jz);
    u_z = R * (w_ix + w_jx);
    d_x = v_ix + sR * w_iy;
    d_y = v_iy - sR * w_ix;
    b_x = v_jx + sR * w_jy;
    b_y = v_jy - sR * w_jx;
    u = Math.sqrt(u_x * u_x + u_z * u_z);
    d = Math.sqrt(d_x * d_x + d_y * d_y);
    b = Math.sqrt(b_x * b_x + b_y * b_y);

    // work; compression ends where the balls no longer approach
    const v_n_old = v_n;
    v_n = v_jy - v_iy;
    W += 0.5 * DP * Math.abs(v_n_old + v_n);
    if (compressing && v_n > 0.0) {
      compressing = false;
      W_f = (1.0 + e * e) * W;
    }
  }
  out[to] = x_x * v_ix + y_x * v_iy;
  out[to + 1] = x_y * v_ix + y_y * v_iy;
  out[to + 2] = 0.0;
  out[to + 3] = x_x * w_ix + y_x * w_iy;
  out[to + 4] = x_y * w_ix + y_y * w_iy;
  out[to + 5] = w_iz;
  out[to + 6] = x_x * v_jx + y_x * v_jy;
  out[to + 7] = x_y * v_jx + y_y * v_jy;
  out[to + 8] = 0.0;
  out[to + 9] = x_x * w_jx + y_x * w_jy;
  out[to + 10] = x_y * w_jx + y_y * w_jy;
  out[to + 11] = w_jz;
}
