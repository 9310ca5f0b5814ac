/* The normal force of a contact that lasts, at an overlap d; d_max is its greatest since the
 * touch, and 0 while open. Hertz's law, with a restitution e:
 *
 *     F = K d^1.5                                     while d >= d_max: loading
 *     F = K/e^3 (d - (1 - e^2) d_max)^1.5, or 0       below it: unloading, loading again
 *
 * Unloading gives back e^2 of the work of compression, for any course of d. A contact that closes
 * at v, with B the inverse of the reduced mass, is pressed delta = (5 v^2 / (4 K B))^0.4 deep, and
 * lasts CAROM_HERTZ_DURATION delta / v.
 *
 * Tip and slate have linear branches instead, k d and k/e^2 (d - (1 - e^2) d_max), which give back
 * e^2 of the work too. */
#ifndef CAROM_SRC_CLUSTER_HERTZ_H
#define CAROM_SRC_CLUSTER_HERTZ_H

#include "platform/arithmetic.h"
#include "platform/promise.h"

#include <math.h>

#define CAROM_HERTZ_DURATION 2.9432

/* d_max grows with d. */
static inline double carom_hertz_force(double stiffness, double restitution, double overlap,
                                       double *overlap_max) {
  CAROM_PROMISE(!(overlap <= 0.0 || *overlap_max < 0.0) && restitution > 0.0 && restitution <= 1.0);
  if (overlap >= *overlap_max) {
    *overlap_max = overlap;
    return stiffness * overlap * sqrt(overlap);
  }
  const double elastic = overlap - (1.0 - restitution * restitution) * *overlap_max;
  return elastic > 0.0
             ? stiffness / (restitution * restitution * restitution) * elastic * sqrt(elastic)
             : 0.0;
}

/* k over the mass of a contact with linear branches that lasts so long alone, against that mass. */
static inline double carom_linear_stiffness(double time, double restitution) {
  const double rate = 1.57079632679489662 * (1.0 + restitution) / time;
  return rate * rate;
}

/* The centroid in time of the impulse of a contact with linear branches that lasts so long alone.
 */
static inline double carom_linear_lag(double time, double restitution) {
  return time / (1.0 + restitution) * (0.63661977236758134 * (1.0 - restitution) + restitution);
}

/* Hertz's force with linear branches. */
static inline double carom_linear_force(double stiffness, double restitution, double overlap,
                                        double *overlap_max) {
  CAROM_PROMISE(!(overlap <= 0.0 || *overlap_max < 0.0) && restitution > 0.0 && restitution <= 1.0);
  if (overlap >= *overlap_max) {
    *overlap_max = overlap;
    return stiffness * overlap;
  }
  const double elastic = overlap - (1.0 - restitution * restitution) * *overlap_max;
  return elastic > 0.0 ? stiffness / (restitution * restitution) * elastic : 0.0;
}

/* d_max of a contact whose force has reached 0: its set recovers as d falls, so that it loads again
 * along the line of unloading. It is open where d is 0. */
static inline double carom_set_left(double restitution, double overlap, double overlap_max) {
  const double lost = 1.0 - restitution * restitution;
  if (overlap > lost * overlap_max)
    return overlap_max;
  return overlap > 0.0 && lost > 0.0 ? overlap / lost : 0.0;
}

/* d_max after a step of h, in the middle of which the overlap was d, and which took the closing
 * speed from v0 to v1: where that changes its sign, the vertex of a parabola. */
static inline double carom_hertz_vertex(double overlap, double overlap_max, double step,
                                        double closing_before, double closing_after) {
  if (!(closing_before > 0.0 && closing_after <= 0.0 && overlap >= overlap_max))
    return overlap_max;
  const double vertex =
      overlap - 0.5 * step * closing_before +
      0.5 * step * closing_before * closing_before / (closing_before - closing_after);
  return overlap > vertex ? overlap : vertex;
}

#endif
