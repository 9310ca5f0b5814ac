/* carom_cushion_trace(): an impact on its way, sampled at equal steps of normal impulse. The
 * precise solver follows the exact limit from sample to sample; Euler's method is stopped on its
 * way, once for each sample. */
#include "cushion/models.h"

#include <stdbool.h>

static const double TOLERANCE = 1e-3; /* see contact_law/impact.h */

/* The impact that is followed. */
typedef struct subject {
  const carom_cushion_impact *in;
  carom_cushion_frame frame;
  carom_contact start;
} subject;

static void put_point(const subject *s, const carom_contact *c, double P, double work, bool parting,
                      carom_cushion_point *point) {
  *point =
      (carom_cushion_point){.normal = P * s->in->mass,
                            .work = work * s->in->mass,
                            .phase = parting ? CAROM_PHASE_RESTITUTION : CAROM_PHASE_COMPRESSION,
                            .v_n = c->v_y * c->cosine,
                            .s_x = carom_slip_x(c),
                            .s_t = carom_slip_t(c),
                            .c_x = carom_cloth_x(c),
                            .c_y = carom_cloth_y(c)};
  carom_from_cushion(&s->frame, c, s->in->radius, &point->state);
}

static carom_status trace_exact(const subject *s, int plain, size_t n,
                                carom_cushion_point *points) {
  /* first to the end, for the impulse of the whole impact; then to each sample */
  carom_trajectory path;
  carom_mathavan_begin(&s->start, TOLERANCE, plain, &path);
  carom_status status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
  const double p = path.point.p, energy = s->start.v_y * s->start.v_y * s->start.cosine;
  carom_mathavan_begin(&s->start, TOLERANCE, plain, &path);
  for (size_t k = 0; k < n && status == CAROM_OK; k++) {
    double end = INFINITY; /* the last point is the end */
    if (k + 1 < n)
      end = p * ((double)k / (double)(n - 1));
    status = carom_impact_advance(&path, end, path.iterations + CAROM_IMPACT_ITERATIONS);
    carom_contact c = s->start;
    const carom_impulse so_far = carom_mathavan_impulse(&s->start, &path);
    carom_push(&c, &so_far);
    put_point(s, &c, so_far.P, energy * carom_impact_work(&path), path.restitution, &points[k]);
    points[k].nose_sticks = path.regime.held;
    points[k].cloth_sticks = path.regime.cloth_held;
    if (path.regime.held)
      points[k].s_x = points[k].s_t = 0;
    if (path.regime.cloth_held)
      points[k].c_x = points[k].c_y = 0;
  }
  return status;
}

static carom_status trace_euler(const subject *s, const carom_cushion_options *opt, size_t n,
                                carom_cushion_point *points) {
  int64_t total = INT64_MAX;
  /* first to the end, to count the steps; then to each point */
  for (size_t k = n; k-- > 0;) {
    carom_contact c = s->start;
    carom_cushion_run run;
    int64_t most = INT64_MAX;
    if (k + 1 < n)
      most = (int64_t)round((double)k * ((double)total / (double)(n - 1)));
    const carom_status status =
        carom_cushion_euler(&c, carom_cushion_steps(opt), opt->least_step / s->in->mass,
                            opt->convention == CAROM_CONVENTION_POOLTOOL, most, &run);
    if (status != CAROM_OK)
      return status;
    if (k + 1 == n)
      total = run.steps;
    put_point(s, &c, run.impulse, run.work, !isnan(run.work_compression), &points[k]);
  }
  return CAROM_OK;
}

static void fill_nan(size_t n, carom_cushion_point *points) {
  for (size_t k = 0; k < n; k++)
    points[k] = (carom_cushion_point){.normal = NAN,
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
                                 size_t n, carom_cushion_point *points) {
  static const carom_cushion_options defaults = {0};
  if (in == NULL || points == NULL)
    return CAROM_ERROR_NULL;
  if (n < 2)
    return CAROM_ERROR_POINTS;
  if (opt == NULL)
    opt = &defaults;
  carom_motion end;
  carom_status status = carom_cushion(in, opt, &end);
  if (status >= 0) {
    subject s = {.in = in, .frame = carom_cushion_frame_of(in)};
    s.start = carom_to_cushion(&s.frame, in, opt);
    carom_apply_law(&s.start, opt);
    if (status == CAROM_SEPARATING)
      for (size_t k = 0; k < n; k++) {
        put_point(&s, &s.start, 0, 0, true, &points[k]);
        points[k].state = end;
      }
    else if (opt->model == CAROM_CUSHION_MATHAVAN)
      status = trace_exact(&s, opt->plain, n, points);
    else if (opt->model == CAROM_CUSHION_EULER)
      status = trace_euler(&s, opt, n, points);
    else
      status = CAROM_ERROR_CUSHION_MODEL;
    /* the roll is lost behind the last point of the impact itself */
    if (status == CAROM_OK)
      carom_lose_roll(opt, in->radius, &s.frame, s.start.log_v, in->v, points[n - 1].state.w);
  }
  if (status < 0)
    fill_nan(n, points);
  return status;
}
