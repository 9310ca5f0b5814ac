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
 * <= 1. So v_n' is between A = 1/M_i + 1/M_j - k/M_p > 0 and values above it, compression
 * takes at most |v_n|/A, restitution at most e |v_n|/A, and with ΔP as above the steps number at
 * most
 *
 *     (1 + e)|v_n| / (A ΔP) = 2 N / (2 - k M/M_p),
 *
 * plus one for each phase, which ends on a whole step. Where that is more than CAROM_EULER_MOST N,
 * as with strong friction and one ball far heavier than the other, nothing is begun: the method
 * reports that it is too slow. Rounding that doubles the number has swallowed the collision: the
 * method cannot resolve it, and reports the same.
 *
 * Source: the 2014 paper named in carom.h, and pooltool's frictional_mathavan model for the
 * order of the operations.
 */
#include "ball_ball/euler.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* m/s: slips below this have no direction, as in pooltool. */
static const double NO_SLIP = 1e-16;

/* Twice the greatest number of steps that exact arithmetic can need; 0 if that is too many. See
 * Termination above. */
static int64_t step_bound(const carom_local *local, double M, int N) {
  const double loss_i = local->mu_i * local->mu_b * M / local->M_i;
  const double loss_j = local->mu_j * local->mu_b * M / local->M_j;
  const double per_N = 2.0 / (2.0 - fmax(loss_i, loss_j));
  return per_N <= (double)CAROM_EULER_MOST ? (int64_t)(2.0 * (per_N * N + 2.0)) : 0;
}

carom_status carom_euler(carom_local *state, int N, int64_t most, carom_euler_run *run) {
  carom_local local = *state;
  const double R = local.R, sR = local.s * local.R;
  /* The harmonic mean rounds, so equal masses, which parity is about, are taken as they are. */
  const double M = local.M_i == local.M_j ? local.M_i : 2.0 / (1.0 / local.M_i + 1.0 / local.M_j);
  const double C_i = 5.0 / (2.0 * local.M_i * R);
  const double C_j = 5.0 / (2.0 * local.M_j * R);

  /* slips of the balls on each other, and of each on the cloth */
  double u_x = local.v_ix - local.v_jx - R * (local.w_iz + local.w_jz);
  double u_z = R * (local.w_ix + local.w_jx);
  double d_x = local.v_ix + sR * local.w_iy, d_y = local.v_iy - sR * local.w_ix;
  double b_x = local.v_jx + sR * local.w_jy, b_y = local.v_jy - sR * local.w_jx;
  double v_n = local.v_jy - local.v_iy;

  /* the impulse of a step, and how many steps there may be */
  const double DP = 0.5 * (1.0 + local.e) * M * fabs(v_n) / N;
  const int64_t bound = step_bound(&local, M, N);
  double work = 0.0, work_compression = NAN, work_end = INFINITY;
  bool compressing = true;
  int64_t steps = 0;

  while ((v_n < 0.0 || work < work_end) && steps < most) {
    if (steps >= bound)
      return CAROM_ERROR_TOO_SLOW;
    steps++;
    /* friction between the balls; its vertical part presses one of them on the cloth */
    double DP1 = 0.0, DP2 = 0.0, DP_ix = 0.0, DP_iy = 0.0, DP_jx = 0.0, DP_jy = 0.0;
    const double slip = sqrt(u_x * u_x + u_z * u_z);
    if (slip >= NO_SLIP) {
      DP1 = -local.mu_b * DP * u_x / slip;
      if (fabs(u_z) >= NO_SLIP) {
        DP2 = -local.mu_b * DP * u_z / slip;
        /* the pressed ball, j or i, rubs on the cloth against its slip there */
        if (DP2 > 0.0) {
          const double b = sqrt(b_x * b_x + b_y * b_y);
          if (b != 0.0) {
            DP_jx = -local.mu_j * (b_x / b) * DP2;
            DP_jy = -local.mu_j * (b_y / b) * DP2;
          }
        } else {
          const double d = sqrt(d_x * d_x + d_y * d_y);
          if (d != 0.0) {
            DP_ix = local.mu_i * (d_x / d) * DP2;
            DP_iy = local.mu_i * (d_y / d) * DP2;
          }
        }
      }
    }

    /* velocities and spins, and the slips that they make */
    local.v_ix += (DP1 + DP_ix) / local.M_i;
    local.v_iy += (-DP + DP_iy) / local.M_i;
    local.v_jx += (-DP1 + DP_jx) / local.M_j;
    local.v_jy += (DP + DP_jy) / local.M_j;
    local.w_ix += C_i * (DP2 + DP_iy);
    local.w_iy += C_i * -DP_ix;
    local.w_iz += C_i * -DP1;
    local.w_jx += C_j * (DP2 + DP_jy);
    local.w_jy += C_j * -DP_jx;
    local.w_jz += C_j * -DP1;

    u_x = local.v_ix - local.v_jx - R * (local.w_iz + local.w_jz);
    u_z = R * (local.w_ix + local.w_jx);
    d_x = local.v_ix + sR * local.w_iy;
    d_y = local.v_iy - sR * local.w_ix;
    b_x = local.v_jx + sR * local.w_jy;
    b_y = local.v_jy - sR * local.w_jx;

    /* the work of the step; at the end of compression it determines the total work */
    const double v_n_old = v_n;
    v_n = local.v_jy - local.v_iy;
    work += 0.5 * DP * fabs(v_n_old + v_n);
    if (compressing && v_n > 0.0) {
      compressing = false;
      work_compression = work;
      work_end = (1.0 + local.e * local.e) * work_compression;
    }
  }
  *state = local;
  *run = (carom_euler_run){
      .steps = steps, .step = DP, .work = work, .work_compression = work_compression};
  return CAROM_OK;
}
