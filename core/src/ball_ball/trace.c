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
static void put_point(const carom_frame *frame, const carom_local *local, double normal,
                      double work, carom_phase phase, bool stuck, carom_trace_point *point) {
  const double sR = local->s * local->R;
  *point = (carom_trace_point){
      .normal = normal,
      .work = work,
      .phase = phase,
      .sticks = stuck,
      .v_n = local->v_jy - local->v_iy,
      .u_x = stuck ? 0.0 : local->v_ix - local->v_jx - local->R * (local->w_iz + local->w_jz),
      .u_z = stuck ? 0.0 : local->R * (local->w_ix + local->w_jx),
      .d_x = local->v_ix + sR * local->w_iy,
      .d_y = local->v_iy - sR * local->w_ix,
      .b_x = local->v_jx + sR * local->w_jy,
      .b_y = local->v_jy - sR * local->w_jx};
  carom_from_frame(frame, local, &point->state);
}

/* normal: the impulse at the end. */
static carom_status trace_exact(const carom_frame *frame, const carom_local *start, double normal,
                                int plain, size_t count, carom_trace_point *points) {
  const carom_reduced reduced = carom_reduce(start);
  double mass = start->M_i;
  if (reduced.j_pressed)
    mass = start->M_j;
  carom_trajectory path;
  carom_precise_begin(&reduced, CAROM_PRECISE_TOLERANCE, plain, &path);
  for (size_t sample = 0; sample < count; sample++) {
    double impulse = INFINITY; /* the last point is the end */
    if (sample + 1 < count)
      impulse = normal / (mass * -reduced.v_n) * ((double)sample / (double)(count - 1));
    const carom_status status =
        carom_impact_advance(&path, impulse, path.iterations + CAROM_IMPACT_ITERATIONS);
    if (status != CAROM_OK)
      return status;
    const carom_integrals so_far = carom_precise_integrals(&reduced, &path);
    carom_local local = *start;
    carom_restore(&reduced, &so_far, &local);
    carom_phase phase = CAROM_PHASE_COMPRESSION;
    if (path.restitution || sample + 1 == count)
      phase = CAROM_PHASE_RESTITUTION;
    put_point(frame, &local, mass * so_far.p,
              mass * (reduced.v_n * reduced.v_n) * carom_impact_work(&path), phase,
              !isnan(path.p_stick), &points[sample]);
  }
  return CAROM_OK;
}

/* `total` is the number of steps that the complete collision takes. */
static carom_status trace_euler(const carom_frame *frame, const carom_local *start, int steps,
                                int64_t total, size_t count, carom_trace_point *points) {
  for (size_t sample = 0; sample < count; sample++) {
    carom_local local = *start;
    carom_euler_run run;
    int64_t most = INT64_MAX;
    if (sample + 1 < count)
      most = (int64_t)round((double)sample * ((double)total / (double)(count - 1)));
    const carom_status status = carom_euler(&local, steps, most, &run);
    if (status != CAROM_OK)
      return status;
    carom_phase phase = CAROM_PHASE_RESTITUTION;
    if (isnan(run.work_compression))
      phase = CAROM_PHASE_COMPRESSION;
    put_point(frame, &local, (double)run.steps * run.step, run.work, phase, false, &points[sample]);
  }
  return CAROM_OK;
}

/* Balls that do not collide stay as they are. */
static void trace_nothing(const carom_impact *in, const carom_frame *frame,
                          const carom_local *start, size_t count, carom_trace_point *points) {
  for (size_t sample = 0; sample < count; sample++) {
    put_point(frame, start, 0.0, 0.0, CAROM_PHASE_RESTITUTION, false, &points[sample]);
    carom_copy_state(in, &points[sample].state);
  }
}

static void fill_nan(size_t count, carom_trace_point *points) {
  for (size_t sample = 0; sample < count; sample++) {
    points[sample] = (carom_trace_point){.normal = NAN,
                                         .work = NAN,
                                         .phase = CAROM_PHASE_RESTITUTION,
                                         .v_n = NAN,
                                         .u_x = NAN,
                                         .u_z = NAN,
                                         .d_x = NAN,
                                         .d_y = NAN,
                                         .b_x = NAN,
                                         .b_y = NAN};
    carom_fill_nan(&points[sample].state);
  }
}

carom_status carom_trace(const carom_impact *in, const carom_options *opt, size_t count,
                         carom_trace_point *points) {
  if (in == NULL || points == NULL)
    return CAROM_ERROR_NULL;
  if (count < 2)
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
      trace_nothing(in, &frame, &start, count, points);
    else if (opt->solver == CAROM_SOLVER_EULER)
      status = trace_euler(&frame, &start, carom_steps(opt), detail.steps, count, points);
    else
      status = trace_exact(&frame, &start, detail.normal, opt->plain, count, points);
  }
  if (status < 0)
    fill_nan(count, points);
  return status;
}
