/* The collision frame: two balls from table axes to the line of centres and back.
 *
 *       ___       ___
 *     /     \   /     \        from above: z points up, to the reader
 *    |   i---|-|---j---|---> y
 *     \__|__/   \_____/
 *        v
 *        x
 *
 * With r the vector from centre i (first ball) to centre j (second), the frame is right-handed:
 *
 *     y = r/|r|  (line of centres)      z = (0, 0, 1)      x = y × z = (y_y, -y_x, 0)
 *
 * The order of the operations is part of the contract: it is pooltool's, so that results agree
 * to the last bit in IEEE double (sums from left to right, no fused multiply-add).
 */
#ifndef CAROM_SRC_BALL_BALL_FRAME_H
#define CAROM_SRC_BALL_BALL_FRAME_H

#include "carom.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

typedef struct carom_frame {
  double x[3], y[3], z[3];
  double distance; /* |r|, m; 0 for centres that coincide, and then x and y are NaN. */
} carom_frame;

/* All that a solver needs and changes, in frame axes. v_z and the work of the vertical forces
 * vanish: the balls stay down. */
typedef struct carom_local {
  double v_ix, v_iy, w_ix, w_iy, w_iz; /* first ball, m/s and rad/s */
  double v_jx, v_jy, w_jx, w_jy, w_jz; /* second ball */
  double M_i, M_j, R;                  /* kg, kg, m */
  double mu_i, mu_j, mu_b;             /* friction of i and j with the cloth, and of the balls
                                          with each other */
  double e;                            /* restitution */
  double s;                            /* sign of the spin in the cloth slip: -1 paper, +1
                                          pooltool */
  double rounding;                     /* of velocities along axes other than the table's, m/s;
                                          otherwise 0 */
} carom_local;

/* s in the slip over the cloth, v_x + s R w_y and v_y - s R w_x. */
static inline double carom_spin_sign(carom_slip slip) {
  return slip == CAROM_SLIP_POOLTOOL ? 1.0 : -1.0;
}

static inline double carom_dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline carom_frame carom_frame_of(const carom_impact *in) {
  carom_frame frame;
  const double r[3] = {in->b.r[0] - in->a.r[0], in->b.r[1] - in->a.r[1], in->b.r[2] - in->a.r[2]};
  frame.distance = sqrt(carom_dot(r, r));
  for (int axis = 0; axis < 3; axis++)
    frame.y[axis] = r[axis] / frame.distance;
  const double x[3] = {frame.y[1], -frame.y[0], 0.0}, z[3] = {0.0, 0.0, 1.0};
  for (int axis = 0; axis < 3; axis++) {
    frame.x[axis] = x[axis];
    frame.z[axis] = z[axis];
  }
  return frame;
}

/* A speed that bounds the speeds of the ball's surface. */
static inline double size_of_motion(const carom_ball *ball) {
  return fabs(ball->v[0]) + fabs(ball->v[1]) +
         ball->radius * (fabs(ball->w[0]) + fabs(ball->w[1]) + fabs(ball->w[2]));
}

static inline carom_local carom_to_frame(const carom_frame *frame, const carom_impact *in,
                                         carom_slip slip) {
  return (carom_local){
      .v_ix = carom_dot(in->a.v, frame->x),
      .v_iy = carom_dot(in->a.v, frame->y),
      .w_ix = carom_dot(in->a.w, frame->x),
      .w_iy = carom_dot(in->a.w, frame->y),
      .w_iz = carom_dot(in->a.w, frame->z),
      .v_jx = carom_dot(in->b.v, frame->x),
      .v_jy = carom_dot(in->b.v, frame->y),
      .w_jx = carom_dot(in->b.w, frame->x),
      .w_jy = carom_dot(in->b.w, frame->y),
      .w_jz = carom_dot(in->b.w, frame->z),
      .M_i = in->a.mass,
      .M_j = in->b.mass,
      .R = in->a.radius,
      .mu_i = in->a.mu_slide,
      .mu_j = in->b.mu_slide,
      .mu_b = in->mu_ball,
      .e = in->restitution,
      .s = carom_spin_sign(slip),
      .rounding = frame->x[0] == 0 || frame->x[1] == 0
                      ? 0
                      : 0x1p-52 * (size_of_motion(&in->a) + size_of_motion(&in->b)),
  };
}

static inline void carom_from_frame(const carom_frame *frame, const carom_local *local,
                                    carom_result *out) {
  for (int axis = 0; axis < 3; axis++) {
    out->a.v[axis] = frame->x[axis] * local->v_ix + frame->y[axis] * local->v_iy;
    out->b.v[axis] = frame->x[axis] * local->v_jx + frame->y[axis] * local->v_jy;
    out->a.w[axis] =
        frame->x[axis] * local->w_ix + frame->y[axis] * local->w_iy + frame->z[axis] * local->w_iz;
    out->b.w[axis] =
        frame->x[axis] * local->w_jx + frame->y[axis] * local->w_jy + frame->z[axis] * local->w_jz;
  }
}

/* ---- Results where nothing was solved, and whether they are finite ---- */

/* After an error. */
static inline void carom_fill_nan(carom_result *out) {
  for (int axis = 0; axis < 3; axis++)
    out->a.v[axis] = out->a.w[axis] = out->b.v[axis] = out->b.w[axis] = NAN;
}

/* For balls that do not collide. */
static inline void carom_copy_state(const carom_impact *in, carom_result *out) {
  memcpy(out->a.v, in->a.v, sizeof out->a.v);
  memcpy(out->a.w, in->a.w, sizeof out->a.w);
  memcpy(out->b.v, in->b.v, sizeof out->b.v);
  memcpy(out->b.w, in->b.w, sizeof out->b.w);
}

static inline bool carom_result_is_finite(const carom_result *out) {
  double sum = 0.0; /* stays 0 unless a term is infinite or NaN */
  for (int axis = 0; axis < 3; axis++)
    sum +=
        out->a.v[axis] * 0.0 + out->a.w[axis] * 0.0 + out->b.v[axis] * 0.0 + out->b.w[axis] * 0.0;
  return sum == 0.0;
}

#endif
