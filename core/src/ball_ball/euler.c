/* Mathavan's method: Euler's rule in the normal impulse, as the simulator pooltool does it.
 *
 * Contact A is ball on ball, D is ball i on the cloth, B is ball j on the cloth. The slip
 * velocities are
 *
 *     at A:  u_x = v_ix - v_jx - R (w_iz + w_jz)      u_z = R (w_ix + w_jx)
 *     at D:  d_x = v_ix + s R w_iy                    d_y = v_iy - s R w_ix
 *     at B:  b_x = v_jx + s R w_jy                    b_y = v_jy - s R w_jx
 *     v_n = v_jy - v_iy
 *
 * A step gives the normal impulse ΔP and the friction that Coulomb's law derives from it:
 *
 *     ΔP1 = -μ_b ΔP u_x/|u|   along x on ball i
 *     ΔP2 = -μ_b ΔP u_z/|u|   along z on ball i
 *     ΔP2 > 0 presses ball j into the cloth:         (ΔP_jx, ΔP_jy) = -μ_j ΔP2 (b_x, b_y)/|b|
 *     ΔP2 < 0 presses ball i into the cloth:         (ΔP_ix, ΔP_iy) =  μ_i ΔP2 (d_x, d_y)/|d|
 *
 * Compression lasts until v_n > 0; the work done by then is W_c, and the collision ends when the
 * work reaches (1 + e²) W_c. ΔP = (1 + e) M |v_n| / 2N, so that about N steps are taken; M is
 * the harmonic mean of the masses. The error is of order 1/N.
 *
 * Parity. For equal masses every result is pooltool's to the last bit, so the order of the
 * operations below is fixed, and this file must be compiled without contraction of a*b + c and
 * without reassociation.
 *
 * Termination. pooltool's loop never ends when the steps are so small that rounding swallows
 * them. Here the number of steps is bounded. Per unit normal impulse v_n rises by 1/M_i + 1/M_j,
 * less at most k/M_p by the friction of the cloth, where p is the pressed ball and k = μ_p μ_b
 * <= 1. So v_n' lies between A = 1/M_i + 1/M_j - k/M_p > 0 and values above it, compression
 * takes at most |v_n|/A, restitution at most e |v_n|/A, and with ΔP as above the steps number at
 * most
 *
 *     (1 + e)|v_n| / (A ΔP) = 2 N / (2 - k M/M_p),
 *
 * plus one for each phase, which ends on a whole step. Where that is more than CAROM_EULER_MOST
 * N, as with strong friction and one ball far heavier than the other, nothing is begun: the
 * method is too slow, and says so. Rounding that doubles the number has swallowed the collision:
 * the method cannot resolve it, and says the same.
 *
 * Source: the 2014 paper named in carom.h, and pooltool's frictional_mathavan model for the
 * order of the operations.
 */
#include "ball_ball/euler.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* Twice the greatest number of steps that exact arithmetic can need; 0 if that is too many. See
 * Termination above. */
static int64_t step_bound(const carom_local *c, double M, int N) {
  const double loss_i = c->mu_i * c->mu_b * M / c->M_i;
  const double loss_j = c->mu_j * c->mu_b * M / c->M_j;
  const double per_N = 2.0 / (2.0 - fmax(loss_i, loss_j));
  return per_N <= (double)CAROM_EULER_MOST ? (int64_t)(2.0 * (per_N * N + 2.0)) : 0;
}

carom_status carom_euler(carom_local *state, int N, int64_t most, carom_euler_run *run) {
  carom_local c = *state;
  const double R = c.R, sR = c.s * c.R;
  /* The harmonic mean rounds, so equal masses, which parity is about, are taken as they are. */
  const double M = c.M_i == c.M_j ? c.M_i : 2.0 / (1.0 / c.M_i + 1.0 / c.M_j);
  const double C_i = 5.0 / (2.0 * c.M_i * R);
  const double C_j = 5.0 / (2.0 * c.M_j * R);

  /* slips of the balls on each other, and of each on the cloth */
  double u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
  double u_z = R * (c.w_ix + c.w_jx);
  double d_x = c.v_ix + sR * c.w_iy, d_y = c.v_iy - sR * c.w_ix;
  double b_x = c.v_jx + sR * c.w_jy, b_y = c.v_jy - sR * c.w_jx;
  double v_n = c.v_jy - c.v_iy;

  /* the impulse of a step, and how many steps there may be */
  const double DP = 0.5 * (1.0 + c.e) * M * fabs(v_n) / N;
  const int64_t bound = step_bound(&c, M, N);
  double W = 0.0, W_c = NAN, W_f = INFINITY;
  bool compressing = true;
  int64_t n = 0;

  while ((v_n < 0.0 || W < W_f) && n < most) {
    if (n >= bound)
      return CAROM_ERROR_TOO_SLOW;
    n++;
    /* friction between the balls; its vertical part presses one of them on the cloth */
    double DP1 = 0.0, DP2 = 0.0, DP_ix = 0.0, DP_iy = 0.0, DP_jx = 0.0, DP_jy = 0.0;
    const double u = sqrt(u_x * u_x + u_z * u_z);
    if (u >= 1e-16) {
      DP1 = -c.mu_b * DP * u_x / u;
      if (fabs(u_z) >= 1e-16) {
        DP2 = -c.mu_b * DP * u_z / u;
        /* the pressed ball, j or i, rubs on the cloth against its slip there */
        if (DP2 > 0.0) {
          const double b = sqrt(b_x * b_x + b_y * b_y);
          if (b != 0.0) {
            DP_jx = -c.mu_j * (b_x / b) * DP2;
            DP_jy = -c.mu_j * (b_y / b) * DP2;
          }
        } else {
          const double d = sqrt(d_x * d_x + d_y * d_y);
          if (d != 0.0) {
            DP_ix = c.mu_i * (d_x / d) * DP2;
            DP_iy = c.mu_i * (d_y / d) * DP2;
          }
        }
      }
    }

    /* velocities and spins, and the slips that they make */
    c.v_ix += (DP1 + DP_ix) / c.M_i;
    c.v_iy += (-DP + DP_iy) / c.M_i;
    c.v_jx += (-DP1 + DP_jx) / c.M_j;
    c.v_jy += (DP + DP_jy) / c.M_j;
    c.w_ix += C_i * (DP2 + DP_iy);
    c.w_iy += C_i * -DP_ix;
    c.w_iz += C_i * -DP1;
    c.w_jx += C_j * (DP2 + DP_jy);
    c.w_jy += C_j * -DP_jx;
    c.w_jz += C_j * -DP1;

    u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
    u_z = R * (c.w_ix + c.w_jx);
    d_x = c.v_ix + sR * c.w_iy;
    d_y = c.v_iy - sR * c.w_ix;
    b_x = c.v_jx + sR * c.w_jy;
    b_y = c.v_jy - sR * c.w_jx;

    /* the work of the step; at the end of compression it tells the work in all */
    const double v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W += 0.5 * DP * fabs(v_n_old + v_n);
    if (compressing && v_n > 0.0) {
      compressing = false;
      W_c = W;
      W_f = (1.0 + c.e * c.e) * W_c;
    }
  }
  *state = c;
  *run = (carom_euler_run){.steps = n, .step = DP, .work = W, .work_compression = W_c};
  return CAROM_OK;
}
