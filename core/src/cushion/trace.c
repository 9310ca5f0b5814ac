/* carom_cushion_trace(): an impact on its way, sampled at equal steps of normal impulse. The
 * precise solver follows the exact limit from sample to sample; Euler's method is stopped on its
 * way, once for each sample. */
#include "cushion/models.h"

#include <stdbool.h>

static const double TOLERANCE = 1e-3; /* see contact_law/impact.h */

/* The impact that is followed. */
typedef struct followed {
  const carom_cushion_impact *in;
  carom_cushion_frame frame;
  carom_contact start;
} followed;

static void put_point(const followed *subject, const carom_contact *contact, double P, double work,
                      bool parting, carom_cushion_point *point) {
  *point =
      (carom_cushion_point){.normal = P * subject->in->mass,
                            .work = work * subject->in->mass,
                            .phase = parting ? CAROM_PHASE_RESTITUTION : CAROM_PHASE_COMPRESSION,
                            .v_n = contact->v_y * contact->cosine,
                            .s_x = carom_slip_x(contact),
                            .s_t = carom_slip_t(contact),
                            .c_x = carom_cloth_x(contact),
                            .c_y = carom_cloth_y(contact)};
  carom_from_cushion(&subject->frame, contact, subject->in->radius, &point->state);
}

static carom_status trace_exact(const followed *subject, int plain, size_t count,
                                carom_cushion_point *points) {
  /* first to the end, for the impulse of the complete impact; then to each sample */
  carom_trajectory path;
  carom_mathavan_begin(&subject->start, TOLERANCE, plain, &path);
  carom_status status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
  const double whole = path.point.p,
               energy = subject->start.v_y * subject->start.v_y * subject->start.cosine;
  carom_mathavan_begin(&subject->start, TOLERANCE, plain, &path);
  for (size_t sample = 0; sample < count && status == CAROM_OK; sample++) {
    double end = INFINITY; /* the last point is the end */
    if (sample + 1 < count)
      end = whole * ((double)sample / (double)(count - 1));
    status = carom_impact_advance(&path, end, path.iterations + CAROM_IMPACT_ITERATIONS);
    carom_contact contact = subject->start;
    const carom_impulse so_far = carom_mathavan_impulse(&subject->start, &path);
    carom_push(&contact, &so_far);
    put_point(subject, &contact, so_far.P, energy * carom_impact_work(&path), path.restitution,
              &points[sample]);
    points[sample].nose_sticks = path.regime.held;
    points[sample].cloth_sticks = path.regime.cloth_held;
    if (path.regime.held)
      points[sample].s_x = points[sample].s_t = 0;
    if (path.regime.cloth_held)
      points[sample].c_x = points[sample].c_y = 0;
  }
  return status;
}

static carom_status trace_euler(const followed *subject, const carom_cushion_options *opt,
                                size_t count, carom_cushion_point *points) {
  int64_t total = INT64_MAX;
  /* first to the end, to count the steps; then to each point */
  for (size_t sample = count; sample-- > 0;) {
    carom_contact contact = subject->start;
    carom_cushion_run run;
    int64_t most = INT64_MAX;
    if (sample + 1 < count)
      most = (int64_t)round((double)sample * ((double)total / (double)(count - 1)));
    const carom_status status =
        carom_cushion_euler(&contact, carom_cushion_steps(opt), opt->least_step / subject->in->mass,
                            opt->convention == CAROM_CONVENTION_POOLTOOL, most, &run);
    if (status != CAROM_OK)
      return status;
    if (sample + 1 == count)
      total = run.steps;
    put_point(subject, &contact, run.impulse, run.work, !isnan(run.work_compression),
              &points[sample]);
  }
  return CAROM_OK;
}

static void fill_nan(size_t count, carom_cushion_point *points) {
  for (size_t sample = 0; sample < count; sample++)
    points[sample] = (carom_cushion_point){.normal = NAN,
                                           .work = NAN,
                                           .phase = CAROM_PHASE_RESTITUTION,
                                           .v_n = NAN,
                                           .s_x = NAN,
                                           .s_t = NAN,
                                           .c_x = NAN,
                                           .c_y = NAN,
                                           .state = {{NAN, NAN, NAN}, {NAN, NAN, NAN}}};
}

carom_status carom_cushion_trace(const carom_cushion_impact *in, const carom_cushion_options *opt,
                                 size_t count, carom_cushion_point *points) {
  static const carom_cushion_options defaults = {0};
  if (in == NULL || points == NULL)
    return CAROM_ERROR_NULL;
  if (count < 2)
    return CAROM_ERROR_POINTS;
  if (opt == NULL)
    opt = &defaults;
  carom_motion end;
  carom_status status = carom_cushion(in, opt, &end);
  if (status >= 0) {
    followed subject = {.in = in, .frame = carom_cushion_frame_of(in)};
    subject.start = carom_to_cushion(&subject.frame, in, opt);
    carom_apply_law(&subject.start, opt);
    if (status == CAROM_SEPARATING)
      for (size_t sample = 0; sample < count; sample++) {
        put_point(&subject, &subject.start, 0, 0, true, &points[sample]);
        points[sample].state = end;
      }
    else if (opt->model == CAROM_CUSHION_MATHAVAN)
      status = trace_exact(&subject, opt->plain, count, points);
    else if (opt->model == CAROM_CUSHION_EULER)
      status = trace_euler(&subject, opt, count, points);
    else
      status = CAROM_ERROR_CUSHION_MODEL;
    /* the roll is lost behind the last point of the impact itself */
    if (status == CAROM_OK)
      carom_lose_roll(opt, in->radius, &subject.frame, subject.start.log_v, in->v,
                      points[count - 1].state.w);
  }
  if (status < 0)
    fill_nan(count, points);
  return status;
}
