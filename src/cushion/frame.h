/* From the table to the frame of contact.h, and back. */
#ifndef CAROM_SRC_CUSHION_FRAME_H
#define CAROM_SRC_CUSHION_FRAME_H

#include "cushion/contact.h"

/* y, of length 1, along the axes of the table; x is (y_y, -y_x). */
typedef struct carom_cushion_frame {
  double y_x, y_y;
} carom_cushion_frame;

/* Of an impact that has been checked. */
static inline carom_cushion_frame carom_cushion_frame_of(const carom_cushion_impact *in) {
  /* over the larger of the two first, so that no square leaves the range */
  const double most = fmax(fabs(in->normal[0]), fabs(in->normal[1])), x = in->normal[0] / most, y = in->normal[1] / most;
  const double length = sqrt(x * x + y * y);
  return (carom_cushion_frame){x / length, y / length};
}

static inline carom_contact carom_to_cushion(const carom_cushion_frame *frame, const carom_cushion_impact *in,
                                             const carom_cushion_options *opt) {
  const double X = frame->y_y, Y = frame->y_x, R = in->radius;
  carom_contact c = {.v_x = in->v[0] * X - in->v[1] * Y,
                     .v_y = in->v[0] * Y + in->v[1] * X,
                     .W_x = R * (in->w[0] * X - in->w[1] * Y),
                     .W_y = R * (in->w[0] * Y + in->w[1] * X),
                     .W_z = R * in->w[2],
                     .sine = (in->height - R) / R,
                     .mu_s = in->mu_cloth,
                     .mu_w = in->mu_cushion,
                     .e = in->restitution};
  c.cosine = sqrt((1 - c.sine) * (1 + c.sine));
  if (opt->model == CAROM_CUSHION_STRONGE && opt->convention == CAROM_CONVENTION_POOLTOOL) {
    const double up = in->height - R, out = R + in->jaw_radius + 1e-6, length = sqrt(up * up + out * out);
    c.sine = up / length;
    c.cosine = out / length;
  }
  return c;
}

static inline void carom_from_cushion(const carom_cushion_frame *frame, const carom_contact *c, double R, carom_motion *out) {
  const double X = frame->y_y, Y = frame->y_x, w_x = c->W_x / R, w_y = c->W_y / R;
  *out = (carom_motion){.v = {c->v_x * X + c->v_y * Y, c->v_y * X - c->v_x * Y, 0},
                        .w = {w_x * X + w_y * Y, w_y * X - w_x * Y, c->W_z / R}};
}

#endif
