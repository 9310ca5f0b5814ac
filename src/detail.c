/* carom_detail from what the solvers know.
 *
 * The impulses over a whole collision follow from what it changed. With Δ the change, C = 5/(2 M R) of each ball, P the normal
 * impulse, P1 and P2 those of friction along x and z on ball i, and those of the cloth on i and on j:
 *
 *     P1 = -Δw_iz/C_i                                  P_ix = -Δw_iy/C_i             P_jx = -Δw_jy/C_j
 *     P_iy - P_jy = Δw_ix/C_i - Δw_jx/C_j              P_iy + P_jy = M_i Δv_iy + M_j Δv_jy
 *     P = M_j Δv_jy - P_jy                             P2 = Δw_ix/C_i - P_iy
 */
#include "detail.h"

#include <math.h>

static void along(const carom_frame *frame, double x, double y, double z, double vector[3]) {
  for (int k = 0; k < 3; k++)
    vector[k] = frame->x[k] * x + frame->y[k] * y + frame->z[k] * z;
}

carom_detail carom_detail_of_nothing(void) {
  return (carom_detail){.stick = CAROM_STICK_NEVER, .stick_normal = NAN};
}

carom_detail carom_detail_of_exact(const carom_frame *frame, const carom_exact_report *report) {
  carom_detail d = {.evaluations = report->evaluations,
                    .normal = report->P,
                    .work_compression = report->work_compression,
                    .work = report->work_total,
                    .stick = (carom_stick)report->stuck,
                    .stick_normal = report->stuck != 0 ? report->P_stick : NAN};
  along(frame, report->P_ax, 0.0, report->P_az, d.friction);
  if (report->pressed != 0)
    along(frame, report->P_cx, report->P_cy, 0.0, report->pressed > 0 ? d.cloth_a : d.cloth_b);
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
