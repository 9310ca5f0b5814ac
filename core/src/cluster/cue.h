/* The directions of a cue, and where its tip is that continues after its push. */
#ifndef CAROM_SRC_CLUSTER_CUE_H
#define CAROM_SRC_CLUSTER_CUE_H

#include "carom_shot.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "platform/vectors.h"

#include <math.h>

/* Along the axis of a cue, and to its left and above it, across the axis; its angles are in
 * degrees. */
static inline void carom_cue_axes(double phi, double theta, double axis[3], double left[3],
                                  double above[3]) {
  double sin_phi, cos_phi, sin_theta, cos_theta;
  carom_sincos_degrees(phi, &sin_phi, &cos_phi);
  carom_sincos_degrees(carom_above(theta, CAROM_LEAST_ELEVATION), &sin_theta, &cos_theta);
  axis[0] = cos_theta * cos_phi;
  axis[1] = cos_theta * sin_phi;
  axis[2] = -sin_theta;
  left[0] = -sin_phi;
  left[1] = cos_phi;
  left[2] = 0.0;
  above[0] = sin_theta * cos_phi;
  above[1] = sin_theta * sin_phi;
  above[2] = cos_theta;
}

/* The speed of the arm, whose cue moves at V: a tenth of its first speed at least, which is a
 * convention. */
#define CAROM_SLOWEST_ARM 0.1
static inline double carom_arm_speed(const carom_cue *cue, double V) {
  return carom_greater(V, CAROM_SLOWEST_ARM * cue->speed);
}

/* The way from the centre of a ball to the tip, which has gone so far `along` its axis since it
 * touched that ball at `origin`. axes become the directions of the cue. */
static inline void carom_tip_from(const carom_cue *cue, double radius, const double origin[3],
                                  double along, const double centre[3], double axes[3][3],
                                  double tip_place[3]) {
  const double a = cue->a, b = cue->b, ahead = along - radius * sqrt(1.0 - a * a - b * b);
  carom_cue_axes(cue->phi, cue->theta, axes[0], axes[1], axes[2]);
  for (int axis = 0; axis < 3; axis++)
    tip_place[axis] = origin[axis] + radius * (a * axes[1][axis] + b * axes[2][axis]) +
                      ahead * axes[0][axis] - centre[axis];
}

/* The direction of that way along these axes, of which the last two are the (a, b) of a touch.
 * Returns the square of the distance. */
static inline double carom_tip_on(double axes[3][3], const double tip_place[3], double offset[3]) {
  const double square = carom_space_dot(tip_place, tip_place), over = 1.0 / sqrt(square);
  for (int axis = 0; axis < 3; axis++)
    offset[axis] = over * carom_space_dot(tip_place, axes[axis]);
  return square;
}

#endif
