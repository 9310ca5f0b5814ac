/* The public entry points: check, go to the frame of the cushion, solve, return. */
#include "cushion/models.h"
#include "platform/ranges.h"
#include "platform/threads.h"
#include "platform/vectors.h"

#include <stdbool.h>
#include <string.h>

static const carom_cushion_options defaults = {.steps = 0};

/* By the row of list.h. */
static carom_status by_model(carom_contact *c, const carom_cushion_options *opt, double mass) {
  switch (opt->model) {
#define CASE(NAME, name, impact, flight, rows, ...) \
  case CAROM_CUSHION_##NAME:                        \
    return impact;
    CAROM_CUSHION_MODELS(CASE)
#undef CASE
  }
  return CAROM_ERROR_CUSHION_MODEL;
}

void carom_apply_law(carom_contact *contact, const carom_cushion_options *opt) {
  if (!carom_absent(opt->restitution_log) || !carom_absent(opt->restitution_log2) ||
      !carom_absent(opt->mu_log) || !carom_absent(opt->roll_loss_log) ||
      opt->model == CAROM_CUSHION_SMOOTH)
    contact->log_v = carom_log_of_speed(contact->v_y);
  if (opt->law == CAROM_CUSHION_LAW_HAN)
    carom_apply_han(contact);
  else
    carom_apply_speed(contact, opt);
}

void carom_lose_roll(const carom_cushion_options *opt, double radius,
                     const carom_cushion_frame *frame, double log_v, const double v[3],
                     double w[3]) {
  if (carom_absent(opt->roll_loss) && carom_absent(opt->roll_loss_log))
    return;
  const double normal[2] = {frame->y_x, frame->y_y};
  const double v_t = v[0] * normal[1] - v[1] * normal[0],
               roll = radius * carom_plane_dot(w, normal);
  const double share = carom_absent(opt->roll_loss_log)
                           ? opt->roll_loss
                           : opt->roll_loss + opt->roll_loss_log * log_v;
  /* a fraction of 0 has derivatives by the numbers that make it */
  const double pull = carom_limited(opt->roll_loss, share) * v_t;
  const double loss = share == 0.0 && v_t * roll > 0.0 ? pull : carom_minmod(pull, roll);
  for (int axis = 0; axis < 2; axis++)
    w[axis] -= loss / radius * normal[axis] + 0.0; /* without a loss w keeps its bits */
}

carom_status carom_cushion_solve(const carom_cushion_impact *in, const carom_cushion_options *opt,
                                 carom_motion *out) {
  int field;
  carom_status status = carom_cushion_check_impact(in, &field);
  if (status == CAROM_OK) {
    const carom_cushion_frame frame = carom_cushion_frame_of(in);
    carom_contact contact = carom_to_cushion(&frame, in, opt);
    if (contact.v_y <= 0) {
      memcpy(out->v, in->v, sizeof out->v);
      memcpy(out->w, in->w, sizeof out->w);
      return CAROM_SEPARATING;
    }
    carom_apply_law(&contact, opt);
    status = by_model(&contact, opt, in->mass);
    if (status == CAROM_OK) {
      carom_from_cushion(&frame, &contact, in->radius, out);
      carom_lose_roll(opt, in->radius, &frame, contact.log_v, in->v, out->w);
      status = carom_is_finite(out->v) && carom_is_finite(out->w) ? CAROM_OK : CAROM_ERROR_OVERFLOW;
    }
  }
  if (status != CAROM_OK)
    *out = (carom_motion){{NAN, NAN, NAN}, {NAN, NAN, NAN}};
  return status;
}

carom_status carom_cushion(const carom_cushion_impact *in, const carom_cushion_options *opt,
                           carom_motion *out) {
  if (in == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  if (opt == NULL)
    opt = &defaults;
  const carom_status status = carom_cushion_check_options(opt);
  if (status == CAROM_OK)
    return carom_cushion_solve(in, opt, out);
  *out = (carom_motion){{NAN, NAN, NAN}, {NAN, NAN, NAN}};
  return status;
}

typedef struct batch {
  const carom_cushion_impact *in;
  const carom_cushion_options *opt;
  carom_motion *out;
  int8_t *status;
} batch;

/* Rows from `first` on; returns the first in error, or `end`. */
static size_t solve_rows(const void *context, size_t first, size_t end) {
  const batch *work = (const batch *)context;
  size_t first_bad = end;
  for (size_t row = first; row < end; row++) {
    const carom_status status = carom_cushion_solve(&work->in[row], work->opt, &work->out[row]);
    if (work->status != NULL)
      work->status[row] = (int8_t)status;
    if (status < 0 && first_bad == end)
      first_bad = row;
  }
  return first_bad;
}

/* Fewer rows than this are not worth a thread. */
static size_t least_part(const carom_cushion_options *opt) {
  switch (opt->model) {
#define CASE(NAME, name, impact, flight, rows, ...) \
  case CAROM_CUSHION_##NAME:                        \
    return (size_t)(rows);
    CAROM_CUSHION_MODELS(CASE)
#undef CASE
  }
  return 1;
}

carom_status carom_cushion_batch(const carom_cushion_impact *in, size_t n,
                                 const carom_cushion_options *opt, carom_motion *out,
                                 int8_t *status) {
  if (opt == NULL)
    opt = &defaults;
  const carom_status error = carom_cushion_check_options(opt);
  if (error != CAROM_OK || n == 0)
    return error;
  if (in == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  const batch work = {in, opt, out, status};
  const size_t first_bad = carom_in_threads(solve_rows, &work, n, opt->threads, least_part(opt));
  if (first_bad == n)
    return CAROM_OK;
  /* The threads only returned its index; resolving the row again returns its status. */
  carom_motion unused;
  return carom_cushion_solve(&in[first_bad], opt, &unused);
}
