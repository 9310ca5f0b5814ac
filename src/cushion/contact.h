/* A ball at a cushion in the frame of the impact: what every model of src/cushion works on.
 *
 * x along the cushion, y horizontally into it, z up, right-handed. The nose touches the ball at I, in the direction
 * n = (0, cos theta, sin theta) from its centre; t = (0, -sin theta, cos theta) points up along the nose. C is the contact with
 * the cloth. Spins are taken times the radius, so all six numbers are speeds, m/s:
 *
 *     slip at I:   s_x = v_x + W_y sin theta - W_z cos theta        s_t = W_x - v_y sin theta
 *     slip at C:   c_x = v_x - W_y                                  c_y = v_y + W_x
 *
 * Impulses over the mass are speeds too: P into the cushion, f = (f_x, f_t) the friction at I and F = (F_x, F_y) that at C,
 * both on the ball, change the motion by
 *
 *     v_x: f_x + F_x       v_y: -P cos theta - f_t sin theta + F_y
 *     W_x: 5/2 (f_t + F_y)       W_y: 5/2 (f_x sin theta - F_x)       W_z: -5/2 f_x cos theta */
#ifndef CAROM_SRC_CUSHION_CONTACT_H
#define CAROM_SRC_CUSHION_CONTACT_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

#include <math.h>

typedef struct carom_contact {
  double v_x, v_y;      /* m/s */
  double W_x, W_y, W_z; /* R times the angular velocity, m/s */
  double sine, cosine;  /* of theta */
  double mu_s, mu_w, e; /* friction of the cloth and of the cushion, restitution */
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

#endif
