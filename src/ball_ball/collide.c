/* The public entry points: collocation, and for what it does not take: check, go to the collision frame, solve, come back, say
 * how it went. */
#include "carom.h"
#include "platform/arithmetic.h"

#include "ball_ball/arguments.h"
#include "ball_ball/detail.h"
#include "ball_ball/euler.h"
#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "ball_ball/precise.h"
#include "ball_ball/result.h"
#include "platform/threads.h"

#include <math.h>
#include <stdbool.h>

static bool collocate(const carom_impact *in, const carom_options *opt, carom_result *out, carom_detail *detail) {
  float solution[OUT_COLUMNS];
  const int evaluations =
      carom_kernels_in_force()->call[CAROM_F64](in, carom_spin_sign(opt->slip), out, detail == NULL ? NULL : solution);
  if (evaluations > 0 && detail != NULL) {
    const carom_frame frame = carom_frame_of(in);
    const carom_local before = carom_to_frame(&frame, in, opt->slip);
    *detail = carom_detail_of_solution(&frame, &before, solution, evaluations);
  }
  return evaluations > 0;
}

static carom_status solve_exact(const carom_frame *frame, carom_local *local, carom_detail *detail) {
  const carom_reduced c = carom_reduce(local);
  carom_trajectory path;
  const carom_status status = carom_precise(&c, CAROM_PRECISE_TOLERANCE, &path);
  const carom_integrals all = carom_precise_integrals(&c, &path);
  if (status == CAROM_OK && detail != NULL)
    *detail = carom_detail_of_path(frame, local, &path);
  carom_restore(&c, &all, local);
  return status;
}

static carom_status solve_euler(const carom_frame *frame, carom_local *local, int steps, carom_detail *detail) {
  const carom_local before = *local;
  carom_euler_run run;
  const carom_status status = carom_euler(local, steps, INT64_MAX, &run);
  if (status == CAROM_OK && detail != NULL)
    *detail = carom_detail_of_euler(frame, &before, local, &run);
  return status;
}

static carom_status collide_one_pair(const carom_impact *in, const carom_options *opt, carom_result *out,
                                     carom_detail *detail) {
  if (opt->solver == CAROM_SOLVER_EXACT && collocate(in, opt, out, detail))
    return CAROM_OK;
  int field;
  const carom_status bad = carom_check_impact(in, &field);
  if (bad != CAROM_OK)
    return bad;
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
  const carom_status status = opt->solver == CAROM_SOLVER_EXACT ? solve_exact(&frame, &local, detail)
                                                                : solve_euler(&frame, &local, carom_steps(opt), detail);
  if (status != CAROM_OK)
    return status;
  carom_from_frame(&frame, &local, out);
  return carom_result_is_finite(out) ? CAROM_OK : CAROM_ERROR_OVERFLOW;
}

carom_status carom_collide_detail(const carom_impact *in, const carom_options *opt, carom_result *out, carom_detail *detail) {
  if (detail != NULL)
    *detail = carom_detail_of_nothing();
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
  const float *from = (const float *)in;
  double *to = (double *)out;
  for (size_t k = 0; k < sizeof *in / sizeof *from; k++)
    to[k] = from[k];
}

static carom_status to_single(carom_status status, const carom_result *in, carom_result_f32 *out) {
  const double *from = (const double *)in;
  float *to = (float *)out;
  bool fits = true;
  for (size_t k = 0; k < sizeof *out / sizeof *to; k++) {
    to[k] = (float)from[k];
    fits &= isfinite(to[k]) || !isfinite(from[k]);
  }
  if (fits)
    return status;
  for (size_t k = 0; k < sizeof *out / sizeof *to; k++)
    to[k] = NAN;
  return CAROM_ERROR_OVERFLOW;
}

carom_status carom_collide_f32(const carom_impact_f32 *in, const carom_options *opt, carom_result_f32 *out) {
  if (in == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  const carom_options defaults = {0};
  if (opt == NULL)
    opt = &defaults;
  if (opt->solver == CAROM_SOLVER_EXACT && carom_check_options(opt) == CAROM_OK &&
      carom_kernels_in_force()->call[CAROM_F32](in, carom_spin_sign(opt->slip), out, NULL) > 0)
    return CAROM_OK;
  carom_impact wide;
  carom_result result;
  to_double(in, &wide);
  return to_single(carom_collide(&wide, opt, &result), &result, out);
}

carom_status carom_collide_one(carom_precision precision, const void *in, const carom_options *opt, void *out) {
  return precision == CAROM_F64 ? carom_collide(in, opt, out) : carom_collide_f32(in, opt, out);
}

/* A batch as threads see it. */
typedef struct batch {
  carom_batch_solver *solver;
  const char *in;
  char *out;
  int8_t *status;
  size_t in_size, out_size;
  const carom_options *opt;
} batch;

static size_t solve_part(const void *job, size_t from, size_t end) {
  const batch *b = job;
  return from + b->solver(b->in + from * b->in_size, end - from, b->opt, b->out + from * b->out_size,
                          b->status != NULL ? b->status + from : NULL);
}

/* Fewer pairs than this are not worth a thread: about 50 us of work, some times what starting one costs. */
static size_t least_part(const carom_options *opt) {
  const size_t exact = 4096, least = 64, euler = 20000 / (size_t)carom_steps(opt);
  if (opt->solver != CAROM_SOLVER_EULER)
    return exact;
  return euler > least ? euler : least;
}

static carom_status collide_batch(carom_precision precision, const void *in, size_t n, const carom_options *opt, void *out,
                                  int8_t *status) {
  const carom_options defaults = {0};
  if (opt == NULL)
    opt = &defaults;
  carom_status bad = carom_check_options(opt);
  if (bad == CAROM_OK && n > 0 && (in == NULL || out == NULL))
    bad = CAROM_ERROR_NULL;
  if (bad != CAROM_OK || n == 0)
    return bad;
  carom_batch_solver *const exact = precision == CAROM_F64 ? carom_exact_batch_f64 : carom_exact_batch_f32;
  const batch job = {.solver = opt->solver == CAROM_SOLVER_EXACT ? exact : carom_kernels_in_force()->euler[precision],
                     .in = in,
                     .out = out,
                     .status = status,
                     .in_size = precision == CAROM_F64 ? sizeof(carom_impact) : sizeof(carom_impact_f32),
                     .out_size = precision == CAROM_F64 ? sizeof(carom_result) : sizeof(carom_result_f32),
                     .opt = opt};
  const size_t first_bad = carom_in_threads(solve_part, &job, n, opt->threads, least_part(opt));
  if (first_bad == n)
    return CAROM_OK;
  /* Only its index came back through the threads; doing the pair again tells its status. */
  carom_result unused;
  return carom_collide_one(precision, job.in + first_bad * job.in_size, opt, &unused);
}

carom_status carom_collide_batch(const carom_impact *in, size_t n, const carom_options *opt, carom_result *out,
                                 int8_t *status) {
  return collide_batch(CAROM_F64, in, n, opt, out, status);
}

carom_status carom_collide_batch_f32(const carom_impact_f32 *in, size_t n, const carom_options *opt, carom_result_f32 *out,
                                     int8_t *status) {
  return collide_batch(CAROM_F32, in, n, opt, out, status);
}
