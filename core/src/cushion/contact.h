/* A ball at a cushion in the frame of the impact, for every model of core/src/cushion.
 *
 *      z
 *      |           ___       ______
 *      |         /     \   /           from the side: x points to the reader. The height of I above
 *      |        |       | I  cushion   C is that of the nose, and sin theta = height / R - 1
 *      |        |   o   |  \______
 *      |         \     /
 *      +--- y  ____\_C_/____________ cloth
 *
 * x along the cushion, y horizontally into it, z up, right-handed. The nose touches the ball at I,
 * in the direction n = (0, cos theta, sin theta) from its centre; t = (0, -sin theta, cos theta)
 * points up along the nose. C is the contact with the cloth. Spins are taken times the radius, so
 * all six numbers are speeds, m/s:
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

/* R times the change of w by an impulse along the surface, over the change of v: m R^2 / I for a
 * solid ball. A macro, since the copy with derivatives would differentiate a variable. */
#define CAROM_SPIN_PER_IMPULSE 2.5
/* m: the distance that pooltool leaves between a ball and a nose that touch. */
#define CAROM_POOLTOOL_GAP 1e-6

/* Changes the motion by an impulse, by the equations of the head. */
static inline void carom_push(carom_contact *contact, const carom_impulse *impulse) {
  contact->v_x += impulse->f_x + impulse->F_x;
  contact->v_y += impulse->F_y - impulse->P * contact->cosine - impulse->f_t * contact->sine;
  contact->W_x += CAROM_SPIN_PER_IMPULSE * (impulse->f_t + impulse->F_y);
  contact->W_y += CAROM_SPIN_PER_IMPULSE * (impulse->f_x * contact->sine - impulse->F_x);
  contact->W_z -= CAROM_SPIN_PER_IMPULSE * (impulse->f_x * contact->cosine);
}

static inline double carom_slip_x(const carom_contact *contact) {
  return contact->v_x + (contact->W_y * contact->sine - contact->W_z * contact->cosine);
}

static inline double carom_slip_t(const carom_contact *contact) {
  return contact->W_x - contact->v_y * contact->sine;
}

static inline double carom_cloth_x(const carom_contact *contact) {
  return contact->v_x - contact->W_y;
}

static inline double carom_cloth_y(const carom_contact *contact) {
  return contact->v_y + contact->W_x;
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
  const double y_y = frame->y_y, y_x = frame->y_x, radius = in->radius;
  carom_contact contact = {.v_x = in->v[0] * y_y - in->v[1] * y_x,
                           .v_y = in->v[0] * y_x + in->v[1] * y_y,
                           .W_x = radius * (in->w[0] * y_y - in->w[1] * y_x),
                           .W_y = radius * (in->w[0] * y_x + in->w[1] * y_y),
                           .W_z = radius * in->w[2],
                           .sine = (in->height - radius) / radius,
                           .mu_s = in->mu_slide,
                           .mu_w = in->mu_cushion,
                           .e = in->restitution};
  contact.cosine = sqrt((1 - contact.sine) * (1 + contact.sine));
  if (opt->model == CAROM_CUSHION_STRONGE && opt->convention == CAROM_CONVENTION_POOLTOOL) {
    const double up = in->height - radius, out = radius + in->jaw_radius + CAROM_POOLTOOL_GAP,
                 length = sqrt(up * up + out * out);
    contact.sine = up / length;
    contact.cosine = out / length;
  }
  return contact;
}

static inline void carom_from_cushion(const carom_cushion_frame *frame,
                                      const carom_contact *contact, double radius,
                                      carom_motion *out) {
  const double y_y = frame->y_y, y_x = frame->y_x;
  const double w_x = contact->W_x / radius, w_y = contact->W_y / radius;
  *out = (carom_motion){
      .v = {contact->v_x * y_y + contact->v_y * y_x, contact->v_y * y_y - contact->v_x * y_x, 0},
      .w = {w_x * y_y + w_y * y_x, w_y * y_y - w_x * y_x, contact->W_z / radius}};
}

#endif
