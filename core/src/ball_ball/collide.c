/* The public entry points of one collision: collocation, and for other inputs: check, transform to
 * the collision frame, solve, transform back, return the status. */
#include "carom.h"
#include "platform/arithmetic.h"

#include "ball_ball/arguments.h"
#include "ball_ball/euler.h"
#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "ball_ball/reduced.h"
#include "friction/laws.h"

#include <math.h>
#include <stdbool.h>

/* ---- carom_detail ---------------------------------------- */

/* The impulses over a complete collision follow from the changes. With Δ the change, C = 5/(2 M
 * R) of each ball, P the normal impulse, P1 and P2 those of friction along x and z on ball i,
 * and those of the cloth on i and on j:
 *
 *     P1 = -Δw_iz/C_i                                  P_ix = -Δw_iy/C_i
 *     P_jx = -Δw_jy/C_j
 *     P_iy - P_jy = Δw_ix/C_i - Δw_jx/C_j              P_iy + P_jy = M_i Δv_iy + M_j Δv_jy
 *     P = M_j Δv_jy - P_jy                             P2 = Δw_ix/C_i - P_iy
 */
static void along(const carom_frame *frame, double x, double y, double z, double vector[3]) {
  for (int axis = 0; axis < 3; axis++)
    vector[axis] = frame->x[axis] * x + frame->y[axis] * y + frame->z[axis] * z;
}

static carom_detail empty_report(void) {
  return (carom_detail){.stick = CAROM_STICK_NEVER, .stick_normal = NAN};
}

/* From the integrals of reduced.h. `compression`: int v_n dp up to v_n = 0; p_stick is NaN for
 * balls that do not stick. */
static carom_detail report_of_integrals(const carom_frame *frame, const carom_reduced *reduced,
                                        const carom_local *approach,
                                        const carom_integrals *integrals, double compression,
                                        double p_stick, bool in_compression) {
  const double mass = reduced->j_pressed ? approach->M_j : approach->M_i,
               sign = reduced->j_pressed ? -1 : 1;
  carom_detail detail = {.normal = mass * integrals->p,
                         .work_compression = -mass * compression,
                         .work = -mass * (1 + reduced->e * reduced->e) * compression,
                         .stick = CAROM_STICK_NEVER,
                         .stick_normal = mass * p_stick};
  if (!isnan(p_stick))
    detail.stick = in_compression ? CAROM_STICK_IN_COMPRESSION : CAROM_STICK_IN_RESTITUTION;
  along(frame, -mass * integrals->Q_1, 0.0, -sign * mass * integrals->Q_2, detail.friction);
  along(frame, sign * mass * integrals->F_x, sign * mass * integrals->F_y, 0.0,
        reduced->j_pressed ? detail.cloth_b : detail.cloth_a);
  return detail;
}

static carom_detail report_of_solution(const carom_frame *frame, const carom_local *approach,
                                       const double solution[OUT_COLUMNS], int evaluations) {
  carom_reduced reduced = carom_reduce(approach);
  const double unit = -reduced.v_n / reduced.kappa,
               slip = sqrt(reduced.u_x * reduced.u_x + reduced.u_z * reduced.u_z);
  /* as in rows.h */
  reduced.mu = reduced.u_z <= LEAST_PRESS * unit ? 0 : reduced.mu;
  reduced.mu_b = fmax(reduced.mu_b, LEAST_MU_B);
  const double mu_mu_b = reduced.mu * reduced.mu_b * unit;
  const bool stick = solution[OUT_STICK] >= 0;
  carom_integrals integrals = {.p = unit * (1 + reduced.e + solution[OUT_OVERSHOOT]),
                               .F_x = -mu_mu_b * solution[OUT_I_X],
                               .F_y = -mu_mu_b * solution[OUT_I_Y]};
  if (stick) {
    integrals.Q_1 = (reduced.u_x + integrals.F_x) / (3.5 * reduced.kappa);
    integrals.Q_2 = (reduced.u_z + 2.5 * integrals.F_y) / (2.5 * reduced.kappa);
  } else if (slip > 0) {
    integrals.Q_1 = reduced.mu_b * (reduced.u_x / slip * integrals.p + unit * solution[OUT_J_C]);
    integrals.Q_2 = reduced.mu_b * (reduced.u_z / slip * integrals.p + unit * solution[OUT_J_Z]);
  }
  /* v = v_n / kappa in units of `unit`, with the slope 1 - f: see problem.h */
  const double compression = reduced.kappa * unit * unit * (solution[OUT_K_C] - 0.5),
               p_stick = unit * solution[OUT_STICK];
  carom_detail detail =
      report_of_integrals(frame, &reduced, approach, &integrals, compression, stick ? p_stick : NAN,
                          reduced.v_n + reduced.kappa * p_stick - integrals.F_y < 0);
  detail.evaluations = evaluations;
  return detail;
}

static carom_detail report_of_trajectory(const carom_frame *frame, const carom_local *approach,
                                         const carom_trajectory *path) {
  const carom_reduced reduced = carom_reduce(approach);
  const carom_integrals integrals = carom_precise_integrals(&reduced, path);
  const double p_stick = -reduced.v_n * path->p_stick;
  carom_detail detail = report_of_integrals(
      frame, &reduced, approach, &integrals, -(reduced.v_n * reduced.v_n) * path->W_c, p_stick,
      reduced.v_n + reduced.kappa * p_stick - integrals.F_y < 0);
  detail.evaluations = 8 * path->iterations;
  return detail;
}

static carom_detail report_of_euler(const carom_frame *frame, const carom_local *approach,
                                    const carom_local *departure, const carom_euler_run *run) {
  const double C_i = 5.0 / (2.0 * approach->M_i * approach->R),
               C_j = 5.0 / (2.0 * approach->M_j * approach->R);
  const double turned_i = (departure->w_ix - approach->w_ix) / C_i,
               turned_j = (departure->w_jx - approach->w_jx) / C_j;
  const double pushed_j = approach->M_j * (departure->v_jy - approach->v_jy);
  const double both = approach->M_i * (departure->v_iy - approach->v_iy) + pushed_j;
  const double P_iy = 0.5 * (both + turned_i - turned_j), P_jy = 0.5 * (both - turned_i + turned_j);
  carom_detail detail = {.steps = run->steps,
                         .normal = pushed_j - P_jy,
                         .work_compression = run->work_compression,
                         .work = run->work,
                         .stick = CAROM_STICK_NEVER,
                         .stick_normal = NAN};
  along(frame, -(departure->w_iz - approach->w_iz) / C_i, 0.0, turned_i - P_iy, detail.friction);
  along(frame, -(departure->w_iy - approach->w_iy) / C_i, P_iy, 0.0, detail.cloth_a);
  along(frame, -(departure->w_jy - approach->w_jy) / C_j, P_jy, 0.0, detail.cloth_b);
  return detail;
}

/* ---- One collision ---- */

static bool solve_by_collocation(const carom_impact *in, const carom_options *opt,
                                 carom_result *out, carom_detail *detail) {
  double solution[OUT_COLUMNS];
  const int evaluations = carom_kernels_of_call(opt->plain)
                              ->call[carom_precision_of(opt)](in, carom_spin_sign(opt->slip), out,
                                                              detail == NULL ? NULL : solution);
  if (evaluations > 0 && detail != NULL) {
    const carom_frame frame = carom_frame_of(in);
    const carom_local approach = carom_to_frame(&frame, in, opt->slip);
    *detail = report_of_solution(&frame, &approach, solution, evaluations);
  }
  return evaluations > 0;
}

static carom_status solve_exact(const carom_frame *frame, carom_local *local, int plain,
                                carom_detail *detail) {
  const carom_reduced reduced = carom_reduce(local);
  carom_trajectory path;
  const carom_status status = carom_precise(&reduced, CAROM_PRECISE_TOLERANCE, plain, &path);
  const carom_integrals integrals = carom_precise_integrals(&reduced, &path);
  if (status == CAROM_OK && detail != NULL)
    *detail = report_of_trajectory(frame, local, &path);
  carom_restore(&reduced, &integrals, local);
  return status;
}

static carom_status solve_euler(const carom_frame *frame, carom_local *local, int steps,
                                carom_detail *detail) {
  const carom_local approach = *local;
  carom_euler_run run;
  const carom_status status = carom_euler(local, steps, INT64_MAX, &run);
  if (status == CAROM_OK && detail != NULL)
    *detail = report_of_euler(frame, &approach, local, &run);
  return status;
}

static carom_status collide_one_pair(const carom_impact *in, const carom_options *opt,
                                     carom_result *out, carom_detail *detail) {
  if (opt->solver != CAROM_SOLVER_EULER && solve_by_collocation(in, opt, out, detail))
    return CAROM_OK;
  int field;
  const carom_status error = carom_check_impact(in, &field);
  if (error != CAROM_OK)
    return error;
  const carom_frame frame = carom_frame_of(in);
  if (frame.distance == 0.0) /* centres so near that the square of their distance underflows */
    return CAROM_ERROR_COINCIDENT;
  if (isinf(frame.distance))
    return CAROM_ERROR_OVERFLOW;
  carom_local local = carom_to_frame(&frame, in, opt->slip);
  if (local.v_jy - local.v_iy >= 0.0) {
    carom_copy_state(in, out);
    return CAROM_SEPARATING;
  }
  const int plain =
      opt->plain || opt->solver == CAROM_SOLVER_EXACT; /* with equal bits everywhere */
  const carom_status status = opt->solver != CAROM_SOLVER_EULER
                                  ? solve_exact(&frame, &local, plain, detail)
                                  : solve_euler(&frame, &local, carom_steps(opt), detail);
  if (status != CAROM_OK)
    return status;
  carom_from_frame(&frame, &local, out);
  return carom_result_is_finite(out) ? CAROM_OK : CAROM_ERROR_OVERFLOW;
}

carom_status carom_collide_detail(const carom_impact *in, const carom_options *opt,
                                  carom_result *out, carom_detail *detail) {
  if (detail != NULL)
    *detail = empty_report();
  if (in == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  const carom_options defaults = {0};
  if (opt == NULL)
    opt = &defaults;
  carom_status status = carom_check_options(opt);
  if (status == CAROM_OK)
    status = collide_one_pair(in, opt, out, detail);
  if (status < 0)
    carom_fill_nan(out);
  return status;
}

carom_status carom_collide(const carom_impact *in, const carom_options *opt, carom_result *out) {
  return carom_collide_detail(in, opt, out, NULL);
}

static void to_double(const carom_impact_f32 *in, carom_impact *out) {
  const float *single = (const float *)in;
  double *wide = (double *)out;
  for (size_t field = 0; field < sizeof *in / sizeof *single; field++)
    wide[field] = single[field];
}

static carom_status to_single(carom_status status, const carom_result *in, carom_result_f32 *out) {
  const double *wide = (const double *)in;
  float *single = (float *)out;
  bool fits = true;
  for (size_t field = 0; field < sizeof *out / sizeof *single; field++) {
    single[field] = (float)wide[field];
    fits &= isfinite(single[field]) || !isfinite(wide[field]);
  }
  if (fits)
    return status;
  for (size_t field = 0; field < sizeof *out / sizeof *single; field++)
    single[field] = NAN;
  return CAROM_ERROR_OVERFLOW;
}

static carom_status collide_single(const carom_impact_f32 *in, const carom_options *opt,
                                   carom_result_f32 *out) {
  if (opt->solver != CAROM_SOLVER_EULER &&
      carom_kernels_of_call(opt->plain)
              ->call[CAROM_F32](in, carom_spin_sign(opt->slip), out, NULL) > 0)
    return CAROM_OK;
  carom_impact wide;
  carom_result result;
  carom_options options = *opt;
  /* double precision inside would be meaningless for numbers that were rounded before */
  if (options.solver == CAROM_SOLVER_EXACT)
    options.solver = CAROM_SOLVER_FAST;
  to_double(in, &wide);
  return to_single(carom_collide(&wide, &options, &result), &result, out);
}

carom_status carom_collide_one(carom_precision precision, const void *in, const carom_options *opt,
                               void *out) {
  return precision == CAROM_F32 ? collide_single(in, opt, out) : carom_collide(in, opt, out);
}

/* ---- Friction around the collision: between the balls, by the speed of their slip; and the
 * cloth's friction on a ball later ---- */

carom_speed_law carom_alciatore(void) {
  return (carom_speed_law){.a = 0.009951, .b = 0.108, .c = 1.088};
}

double carom_mu_ball(const carom_impact *in, carom_speed_law law) {
  if (in == NULL)
    return NAN;
  const carom_frame frame = carom_frame_of(in);
  const carom_local local = carom_to_frame(&frame, in, CAROM_SLIP_PAPER);
  const double u_x = local.v_ix - local.v_jx - local.R * (local.w_iz + local.w_jz);
  const double u_z = local.R * (local.w_ix + local.w_jx);
  const double numbers[3] = {law.a, law.b, law.c};
  return carom_friction_at(CAROM_LAW_ALCIATORE, numbers, sqrt(u_x * u_x + u_z * u_z));
}

void carom_rolling_velocity(const double v[3], const double w[3], double radius,
                            double rolling[3]) {
  if (rolling == NULL)
    return;
  if (v == NULL || w == NULL) {
    rolling[0] = rolling[1] = rolling[2] = NAN;
    return;
  }
  /* first both: `rolling` may be v or w */
  const double x = (5.0 * v[0] + 2.0 * radius * w[1]) / 7.0;
  rolling[1] = (5.0 * v[1] - 2.0 * radius * w[0]) / 7.0;
  rolling[0] = x;
  rolling[2] = 0.0;
}
