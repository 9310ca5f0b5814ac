/* carom_detail from what the solvers know.
 *
 * The impulses over a whole collision follow from what it changed. With Δ the change, C = 5/(2 M R) of each ball, P the normal
 * impulse, P1 and P2 those of friction along x and z on ball i, and those of the cloth on i and on j:
 *
 *     P1 = -Δw_iz/C_i                                  P_ix = -Δw_iy/C_i             P_jx = -Δw_jy/C_j
 *     P_iy - P_jy = Δw_ix/C_i - Δw_jx/C_j              P_iy + P_jy = M_i Δv_iy + M_j Δv_jy
 *     P = M_j Δv_jy - P_jy                             P2 = Δw_ix/C_i - P_iy
 */
#include "ball_ball/detail.h"

#include <math.h>

static void along(const carom_frame *frame, double x, double y, double z, double vector[3]) {
  for (int k = 0; k < 3; k++)
    vector[k] = frame->x[k] * x + frame->y[k] * y + frame->z[k] * z;
}

carom_detail carom_detail_of_nothing(void) {
  return (carom_detail){.stick = CAROM_STICK_NEVER, .stick_normal = NAN};
}

/* From the integrals of reduced.h. `compression`: int v_n dp up to v_n = 0; p_stick is NaN for balls that do not stick. */
static carom_detail of_integrals(const carom_frame *frame, const carom_reduced *c, const carom_local *before,
                                 const carom_integrals *g, double compression, double p_stick, bool in_compression) {
  const double M = c->j_pressed ? before->M_j : before->M_i, sign = c->j_pressed ? -1 : 1;
  carom_detail d = {.normal = M * g->p,
                    .work_compression = -M * compression,
                    .work = -M * (1 + c->e * c->e) * compression,
                    .stick = isnan(p_stick)   ? CAROM_STICK_NEVER
                             : in_compression ? CAROM_STICK_IN_COMPRESSION
                                              : CAROM_STICK_IN_RESTITUTION,
                    .stick_normal = M * p_stick};
  along(frame, -M * g->Q_1, 0.0, -sign * M * g->Q_2, d.friction);
  along(frame, sign * M * g->F_x, sign * M * g->F_y, 0.0, c->j_pressed ? d.cloth_b : d.cloth_a);
  return d;
}

carom_detail carom_detail_of_solution(const carom_frame *frame, const carom_local *before, const float solution[OUT_COLUMNS],
                                      int evaluations) {
  carom_reduced c = carom_reduce(before);
  const double unit = -c.v_n / c.kappa, u = sqrt(c.u_x * c.u_x + c.u_z * c.u_z);
  /* as in rows.h */
  c.mu = c.u_z <= LEAST_PRESS * unit ? 0 : c.mu;
  c.mu_b = fmax(c.mu_b, LEAST_MU_B);
  const double mu_mu_b = c.mu * c.mu_b * unit;
  const bool stick = solution[OUT_STICK] >= 0;
  carom_integrals g = {.p = unit * (1 + c.e + (double)solution[OUT_OVERSHOOT]),
                       .F_x = -mu_mu_b * (double)solution[OUT_I_X],
                       .F_y = -mu_mu_b * (double)solution[OUT_I_Y]};
  if (stick) {
    g.Q_1 = (c.u_x + g.F_x) / (3.5 * c.kappa);
    g.Q_2 = (c.u_z + 2.5 * g.F_y) / (2.5 * c.kappa);
  } else if (u > 0) {
    g.Q_1 = c.mu_b * (c.u_x / u * g.p + unit * (double)solution[OUT_J_C]);
    g.Q_2 = c.mu_b * (c.u_z / u * g.p + unit * (double)solution[OUT_J_Z]);
  }
  /* v = v_n / kappa in units of `unit`, with the slope 1 - f: see problem.h */
  const double compression = c.kappa * unit * unit * ((double)solution[OUT_K_C] - 0.5),
               p_stick = unit * (double)solution[OUT_STICK];
  carom_detail d =
      of_integrals(frame, &c, before, &g, compression, stick ? p_stick : NAN, c.v_n + c.kappa * p_stick - g.F_y < 0);
  d.evaluations = evaluations;
  return d;
}

carom_detail carom_detail_of_path(const carom_frame *frame, const carom_local *before, const carom_trajectory *path) {
  const carom_reduced c = carom_reduce(before);
  const carom_integrals all = carom_precise_integrals(&c, path);
  const double p_stick = -c.v_n * path->p_stick;
  carom_detail d =
      of_integrals(frame, &c, before, &all, -(c.v_n * c.v_n) * path->W_c, p_stick, c.v_n + c.kappa * p_stick - all.F_y < 0);
  d.evaluations = 8 * path->iterations;
  return d;
}

carom_detail carom_detail_of_euler(const carom_frame *frame, const carom_local *before, const carom_local *after,
                                   const carom_euler_run *run) {
  const double C_i = 5.0 / (2.0 * before->M_i * before->R), C_j = 5.0 / (2.0 * before->M_j * before->R);
  const double turned_i = (after->w_ix - before->w_ix) / C_i, turned_j = (after->w_jx - before->w_jx) / C_j;
  const double pushed_j = before->M_j * (after->v_jy - before->v_jy);
  const double both = before->M_i * (after->v_iy - before->v_iy) + pushed_j;
  const double P_iy = 0.5 * (both + turned_i - turned_j), P_jy = 0.5 * (both - turned_i + turned_j);
  carom_detail d = {.steps = run->steps,
                    .normal = pushed_j - P_jy,
                    .work_compression = run->work_compression,
                    .work = run->work,
                    .stick = CAROM_STICK_NEVER,
                    .stick_normal = NAN};
  along(frame, -(after->w_iz - before->w_iz) / C_i, 0.0, turned_i - P_iy, d.friction);
  along(frame, -(after->w_iy - before->w_iy) / C_i, P_iy, 0.0, d.cloth_a);
  along(frame, -(after->w_jy - before->w_jy) / C_j, P_jy, 0.0, d.cloth_b);
  return d;
}
