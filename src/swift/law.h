/* What the arcs of the swift solver are given: the law of a collision, and a glance ahead from where an arc begins. */
#ifndef CAROM_SRC_SWIFT_LAW_H
#define CAROM_SRC_SWIFT_LAW_H

#include "quad.h"

/* What stays. In the frame of exact.c: ball i pressed, or the other case turned into it. */
typedef struct law {
  float kappa, per;     /* 1 + M_pressed / M_other; per = 1 / kappa */
  float mu, mu_b, spin; /* friction; spin = 5/2 s */
  float pull;           /* mu mu_b */
  float unit;           /* -v_n0 / kappa, the impulse that stops the approach without cloth */
} law;

/* What an arc starts from, and where things are going there. */
typedef struct glance {
  float u_x, u_z, d_x, d_y, v; /* slips, v_n */
  float i, c, z;               /* 1 / |u|, and the direction of u */
  float t_x, t_y;              /* direction of d half way to the expected end */
  float rate;                  /* the share of |u| lost per unit p; its inverse is about where the balls stick */
} glance;

static const float NOTHING = 1e-36f; /* keeps 0 / 0 away */

#endif
