/* carom_trace(): a collision on its way, sampled at equal steps of normal impulse. The precise
 * solver follows the exact limit from sample to sample; Euler's method is stopped on its way,
 * once for each sample. */
#include "ball_ball/arguments.h"
#include "ball_ball/euler.h"
#include "ball_ball/frame.h"
#include "ball_ball/reduced.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* Contact A is ball on ball, D and B are the first and the second ball on the cloth; see
 * carom_trace_point. */
static void put_point(const carom_frame *frame, const carom_local *c, double P, double work,
                      carom_phase phase, bool stuck, carom_trace_point *point) {
  const double sR = c->s * c->R;
  *point = (carom_trace_point){.normal = P,
                               .work = work,
                               .phase = phase,
                               .sticks = stuck,
                               .v_n = c->v_jy - c->v_iy,
                               .u_x = stuck ? 0.0 : c->v_ix - c->v_jx - c->R * (c->w_iz + c->w_jz),
                               .u_z = stuck ? 0.0 : c->R * (c->w_ix + c->w_jx),
                               .d_x = c->v_ix + sR * c->w_iy,
                               .d_y = c->v_iy - sR * c->w_ix,
                               .b_x = c->v_jx + sR * c->w_jy,
                               .b_y = c->v_jy - sR * c->w_jx};
  carom_from_frame(frame, c, &point->state);
}

/* P: normal impulse at the end. */
static carom_status trace_exact(const carom_frame *frame, const carom_local *start, double P,
                                int plain, size_t n, carom_trace_point *points) {
  const carom_reduced c = carom_reduce(start);
  double M = start->M_i;
  if (c.j_pressed)
    M = start->M_j;
  carom_trajectory path;
  carom_precise_begin(&c, CAROM_PRECISE_TOLERANCE, plain, &path);
  for (size_t k = 0; k < n; k++) {
    double p = INFINITY; /* the last point is the end */
    if (k + 1 < n)
      p = P / (M * -c.v_n) * ((double)k / (double)(n - 1));
    const carom_status status =
        carom_impact_advance(&path, p, path.iterations + CAROM_IMPACT_ITERATIONS);
    if (status != CAROM_OK)
      return status;
    const carom_integrals so_far = carom_precise_integrals(&c, &path);
    carom_local local = *start;
    carom_restore(&c, &so_far, &local);
    carom_phase phase = CAROM_PHASE_COMPRESSION;
    if (path.restitution || k + 1 == n)
      phase = CAROM_PHASE_RESTITUTION;
    put_point(frame, &local, M * so_far.p, M * (c.v_n * c.v_n) * carom_impact_work(&path), phase,
              !isnan(path.p_stick), &points[k]);
  }
  return CAROM_OK;
}

/* `total` is the number of steps that the whole collision takes. */
static carom_status trace_euler(const carom_frame *frame, const carom_local *start, int N,
                                int64_t total, size_t n, carom_trace_point *points) {
  for (size_t k = 0; k < n; k++) {
    carom_local c = *start;
    carom_euler_run run;
    int64_t most = INT64_MAX;
    if (k + 1 < n)
      most = (int64_t)round((double)k * ((double)total / (double)(n - 1)));
    const carom_status status = carom_euler(&c, N, most, &run);
    if (status != CAROM_OK)
      return status;
    carom_phase phase = CAROM_PHASE_RESTITUTION;
    if (isnan(run.work_compression))
      phase = CAROM_PHASE_COMPRESSION;
    put_point(frame, &c, (double)run.steps * run.step, run.work, phase, false, &points[k]);
  }
  return CAROM_OK;
}

/* Balls that do not collide stay as they are. */
static void trace_nothing(const carom_impact *in, const carom_frame *frame,
                          const carom_local *start, size_t n, carom_trace_point *points) {
  for (size_t k = 0; k < n; k++) {
    put_point(frame, start, 0.0, 0.0, CAROM_PHASE_RESTITUTION, false, &points[k]);
    carom_copy_state(in, &points[k].state);
  }
}

static void fill_nan(size_t n, carom_trace_point *points) {
  for (size_t k = 0; k < n; k++) {
    points[k] = (carom_trace_point){.normal = NAN,
                                    .work = NAN,
                                    .phase = CAROM_PHASE_RESTITUTION,
                                    .v_n = NAN,
                                    .u_x = NAN,
                                    .u_z = NAN,
                                    .d_x = NAN,
                                    .d_y = NAN,
                                    .b_x = NAN,
                                    .b_y = NAN};
    carom_fill_nan(&points[k].state);
  }
}

carom_status carom_trace(const carom_impact *in, const carom_options *opt, size_t n,
                         carom_trace_point *points) {
  if (in == NULL || points == NULL)
    return CAROM_ERROR_NULL;
  if (n < 2)
    return CAROM_ERROR_POINTS;
  const carom_options defaults = {0};
  if (opt == NULL)
    opt = &defaults;
  carom_result end;
  carom_detail detail;
  carom_status status = carom_collide_detail(in, opt, &end, &detail);
  if (status >= 0) {
    const carom_frame frame = carom_frame_of(in);
    const carom_local start = carom_to_frame(&frame, in, opt->slip);
    if (status == CAROM_SEPARATING)
      trace_nothing(in, &frame, &start, n, points);
    else if (opt->solver == CAROM_SOLVER_EULER)
      status = trace_euler(&frame, &start, carom_steps(opt), detail.steps, n, points);
    else
      status = trace_exact(&frame, &start, detail.normal, opt->plain, n, points);
  }
  if (status < 0)
    fill_nan(n, points);
  return status;
}
