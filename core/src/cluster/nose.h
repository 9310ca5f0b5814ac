/* The nose of a cushion as a contact of a push: a ball that the cue pushes into it, or that returns
 * onto the tip from it, has both at once.
 *
 * Elsewhere a cushion takes no time. Here it lasts CAROM_NOSE_TIME for a ball alone. The model of
 * the cushion gives what such a ball would get: (v, W) becomes (v, W) + Delta, with W = R w. With
 * the product <x, y> = x_v . y_v + 2/5 x_W . y_W, in which m/2 <x, x> is the energy of a ball, and
 * D = Delta/|Delta|, the nose is a spring along D:
 *
 *     delta' = -<D, (v, W)>,  delta = 0 at the touch;  the ball gets F D per time and mass
 *     F = k delta                                  while delta > delta_max: loading
 *     F = k/e^2 (delta - (1 - e^2) delta_max), or 0   below it; the set recovers as in tip.h
 *     g = -<D, (v, W)> at the touch,  e = |Delta|/g - 1,  k = (pi/2 (1 + e)/CAROM_NOSE_TIME)^2
 *
 *               |  nose                delta' goes from g to -e g: a ball alone leaves with
 *        .---.  |                      (v, W) + Delta, whatever the model is
 *       '  v  ' |
 *       (  o-->)|  F D = (F D_v, F D_W): along the normal and against the slip, in the
 *       .     . |                      direction in which the model has friction in all
 *        '---'  |
 *
 * e <= 1 as no model raises the energy, and the spring returns e^2 of what it takes, however the
 * ball is pushed meanwhile. So the energy never rises. A spring of less than `least_nose` of e gets
 * that, and as the ball parts the `excess` that it gives a ball alone is taken off.
 *
 * The nose is above the centre of a ball on the cloth, and holds it down.
 *
 * A nose that the ball does not touch yet, or has left, is a plane at the gap + normal . s. Where
 * the ball reaches it the model is asked again, for the motion that the ball has then. */
#ifndef CAROM_SRC_CLUSTER_NOSE_H
#define CAROM_SRC_CLUSTER_NOSE_H

#include "carom_shot.h"
#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "platform/ranges.h"
#include "platform/sphere.h"

#include <math.h>
#include <string.h>

static const double least_nose = 0.05; /* e */
/* How much of its force a nose may have downwards on a ball that lies: the slope of the line from
 * its height, about 1.27 R, to the centre. */
static const double nose_slope = 0.3;

/* <D, (v, W)> */
static inline double nose_dot(const carom_cluster_nose *nose, const double v[3],
                              const double W[3]) {
  return carom_space_dot(nose->v, v) + 2.0 * CAROM_SPHERE_ENERGY * carom_space_dot(nose->W, W);
}

/* m: between ball and nose; and the speed at which they approach. */
static inline double nose_gap(const carom_cluster_nose *nose, const carom_cluster_ball *ball) {
  return nose->gap + carom_space_dot(nose->normal, ball->s);
}
static inline double nose_approach(const carom_cluster_nose *nose, const carom_cluster_ball *ball) {
  return -carom_space_dot(nose->normal, ball->v);
}

/* Gives the ball an impulse of the nose, over its mass. */
static inline void nose_push(const carom_cluster_nose *nose, double J, carom_cluster_ball *ball) {
  cluster_add(false, ball->v, J, nose->v);
  cluster_add(false, ball->W, J, nose->W);
}

/* D, e and k as the ball touches the nose, of which the model leaves it the motion v, W. Returns
 * whether that pushes. */
static inline bool nose_of(const carom_cluster_ball *ball, const double v[3], const double W[3],
                           carom_cluster_nose *nose) {
  cluster_minus(false, v, ball->v, nose->v);
  cluster_minus(false, W, ball->W, nose->W);
  const double size = sqrt(nose_dot(nose, nose->v, nose->W));
  if (!(size > 0.0))
    return false;
  for (int axis = 0; axis < 3; axis++) {
    nose->v[axis] /= size;
    nose->W[axis] /= size;
  }
  nose->closing = -nose_dot(nose, ball->v, ball->W); /* g */
  if (!(nose->closing > 0.0))
    return false;
  nose->restitution = carom_lesser(carom_greater(size / nose->closing - 1.0, least_nose), 1.0);
  nose->stiffness = carom_linear_stiffness(CAROM_NOSE_TIME, nose->restitution);
  nose->change = (1.0 + nose->restitution) * nose->closing;
  nose->excess = nose->change - size;
  return true;
}

/* How long a ball alone touches the nose: with a force, and then until the set has recovered, at
 * the speed e g, but no longer than that again. */
static inline double nose_lasts(const carom_cluster_nose *nose) {
  const double e = nose->restitution;
  const double recovers = (1.0 - e * e) / (e * sqrt(nose->stiffness));
  return CAROM_NOSE_TIME + carom_lesser(recovers, CAROM_NOSE_TIME);
}

/* How far a ball alone of the velocity v moves in that time: the impulse counts from its centroid
 * on. */
static inline void nose_moves(const carom_cluster_nose *nose, const double v[3], double lasts,
                              double moved[3]) {
  const double rest = lasts - carom_linear_lag(CAROM_NOSE_TIME, nose->restitution);
  for (int axis = 0; axis < 3; axis++)
    moved[axis] = lasts * v[axis] + rest * nose->change * nose->v[axis];
}

/* The ball reaches the nose: asks the model. */
static inline void nose_begins(carom_cluster_nose *nose, const carom_cluster_ball *ball,
                               double tau) {
  const double deep = -nose_gap(nose, ball), approach = nose_approach(nose, ball);
  double v[3], W[3];
  if (!(deep >= 0.0 && approach > 0.0) || !nose->model(nose->context, ball, v, W) ||
      !nose_of(ball, v, W, nose))
    return;
  nose->touches = true;
  nose->overlap = deep * nose->closing / approach;
  nose->overlap_max = nose->rest = 0.0;
  nose->began = tau - deep / approach;
  for (int axis = 0; axis < 3; axis++)
    nose->place[axis] = ball->s[axis] - deep / approach * ball->v[axis];
}

/* The ball parts from it: off what a ball alone would get too much, and no more than this one
 * leaves with. */
static inline void nose_ends(carom_cluster_nose *nose, carom_cluster_ball *ball, double tau) {
  const double leaves = carom_greater(nose_dot(nose, ball->v, ball->W), 0.0);
  nose_push(nose, -carom_lesser(nose->excess, leaves), ball);
  nose->touches = false;
  nose->lasted += tau - nose->began;
  for (int axis = 0; axis < 3; axis++)
    nose->moved[axis] += ball->s[axis] - nose->place[axis];
  nose->gap = -carom_space_dot(nose->normal, ball->s);
}

/* Half a step of its compression, and its impulse per mass; whether it acts: with a force, or until
 * the ball has parted, or as long again as it lasts. A ball that the tip has `gone` from meets it
 * as another event. */
static inline bool nose_acts(carom_cluster_nose *nose, const carom_cluster_ball *ball, double step,
                             double tau, bool gone) {
  nose->J = 0.0;
  if (nose->touches)
    nose->overlap += 0.5 * step * (nose->closing = -nose_dot(nose, ball->v, ball->W));
  else if (!gone)
    nose_begins(nose, ball, tau);
  if (!nose->touches || !(nose->overlap > 0.0))
    return false;
  nose->J = step * carom_linear_force(nose->stiffness, nose->restitution, nose->overlap,
                                      &nose->overlap_max);
  nose->impulse += nose->J * carom_space_size(nose->v);
  nose->rest = nose->J > 0.0 ? 0.0 : nose->rest + step;
  return nose->closing > 0.0 || nose->rest < CAROM_NOSE_TIME;
}

/* The other half of the step. */
static inline void nose_parts(carom_cluster_nose *nose, carom_cluster_ball *ball, double step,
                              double tau) {
  if (!nose->touches)
    return;
  const double closing = -nose_dot(nose, ball->v, ball->W), middle = nose->overlap;
  nose->overlap += 0.5 * step * closing;
  nose->overlap_max = carom_hertz_vertex(middle, nose->overlap_max, step, nose->closing, closing);
  nose->overlap_max = carom_set_left(nose->restitution, nose->overlap, nose->overlap_max);
  if (!(nose->overlap > 0.0))
    nose_ends(nose, ball, tau);
}

#endif
