/* A ball at a cushion in the frame of the impact, for every model of core/src/cushion.
 *
 * x along the cushion, y horizontally into it, z up, right-handed. The nose touches the ball at
 * I, in the direction
 * n = (0, cos theta, sin theta) from its centre; t = (0, -sin theta, cos theta) points up along
 * the nose. C is the contact with the cloth. Spins are taken times the radius, so all six
 * numbers are speeds, m/s:
 *
 *     slip at I:   s_x = v_x + W_y sin theta - W_z cos theta        s_t = W_x - v_y sin theta
 *     slip at C:   c_x = v_x - W_y                                  c_y = v_y + W_x
 *
 * Impulses over the mass are speeds too: P into the cushion, f = (f_x, f_t) the friction at I
 * and F = (F_x, F_y) that at C, both on the ball, change the motion by
 *
 *     v_x: f_x + F_x       v_y: -P cos theta - f_t sin theta + F_y
 *     W_x: 5/2 (f_t + F_y)       W_y: 5/2 (f_x sin theta - F_x)       W_z: -5/2 f_x cos theta */
#ifndef CAROM_SRC_CUSHION_CONTACT_H
#define CAROM_SRC_CUSHION_CONTACT_H

#include "carom_shot.h"
#include "platform/arithmetic.h"
#include "platform/ranges.h"

#include <math.h>

typedef struct carom_contact {
  double v_x, v_y;      /* m/s */
  double W_x, W_y, W_z; /* R times the angular velocity, m/s */
  double sine, cosine;  /* of theta */
  double mu_s, mu_w, e; /* friction of the cloth and of the cushion, restitution */
  double log_v;         /* ln v_y, where carom_apply_law() found a number that it changes */
} carom_contact;

typedef struct carom_impulse {
  double P, f_x, f_t, F_x, F_y; /* over the mass, m/s */
} carom_impulse;

static inline void carom_push(carom_contact *c, const carom_impulse *q) {
  c->v_x += q->f_x + q->F_x;
  c->v_y += q->F_y - q->P * c->cosine - q->f_t * c->sine;
  c->W_x += 2.5 * (q->f_t + q->F_y);
  c->W_y += 2.5 * (q->f_x * c->sine - q->F_x);
  c->W_z -= 2.5 * (q->f_x * c->cosine);
}

static inline double carom_slip_x(const carom_contact *c) {
  return c->v_x + (c->W_y * c->sine - c->W_z * c->cosine);
}

static inline double carom_slip_t(const carom_contact *c) {
  return c->W_x - c->v_y * c->sine;
}

static inline double carom_cloth_x(const carom_contact *c) {
  return c->v_x - c->W_y;
}

static inline double carom_cloth_y(const carom_contact *c) {
  return c->v_y + c->W_x;
}

/* Coulomb's friction on a ball whose surface slips, for a normal impulse P: it stops the slip, or
 * slips to the end. Impulses over the mass. */
static inline double carom_coulomb(double slip, double mu, double P) {
  const double slips = mu * P, stops = 2.0 / 7.0 * slip;
  return slips < stops ? slips : stops;
}

/* ---- From the table to this frame, and back ---- */

/* y, of length 1, along the axes of the table; x is (y_y, -y_x). */
typedef struct carom_cushion_frame {
  double y_x, y_y;
} carom_cushion_frame;

/* Of an impact that has been checked. */
static inline carom_cushion_frame carom_cushion_frame_of(const carom_cushion_impact *in) {
  /* over the larger of the two first, so that no square leaves the range */
  const double most = carom_greater(fabs(in->normal[0]), fabs(in->normal[1]));
  const double x = in->normal[0] / most, y = in->normal[1] / most;
  const double length = sqrt(x * x + y * y);
  return (carom_cushion_frame){x / length, y / length};
}

static inline carom_contact carom_to_cushion(const carom_cushion_frame *frame,
                                             const carom_cushion_impact *in,
                                             const carom_cushion_options *opt) {
  const double X = frame->y_y, Y = frame->y_x, R = in->radius;
  carom_contact c = {.v_x = in->v[0] * X - in->v[1] * Y,
                     .v_y = in->v[0] * Y + in->v[1] * X,
                     .W_x = R * (in->w[0] * X - in->w[1] * Y),
                     .W_y = R * (in->w[0] * Y + in->w[1] * X),
                     .W_z = R * in->w[2],
                     .sine = (in->height - R) / R,
                     .mu_s = in->mu_slide,
                     .mu_w = in->mu_cushion,
                     .e = in->restitution};
  c.cosine = sqrt((1 - c.sine) * (1 + c.sine));
  if (opt->model == CAROM_CUSHION_STRONGE && opt->convention == CAROM_CONVENTION_POOLTOOL) {
    const double up = in->height - R, out = R + in->jaw_radius + 1e-6,
                 length = sqrt(up * up + out * out);
    c.sine = up / length;
    c.cosine = out / length;
  }
  return c;
}

static inline void carom_from_cushion(const carom_cushion_frame *frame, const carom_contact *c,
                                      double R, carom_motion *out) {
  const double X = frame->y_y, Y = frame->y_x, w_x = c->W_x / R, w_y = c->W_y / R;
  *out = (carom_motion){.v = {c->v_x * X + c->v_y * Y, c->v_y * X - c->v_x * Y, 0},
                        .w = {w_x * X + w_y * Y, w_y * X - w_x * Y, c->W_z / R}};
}

#endif
