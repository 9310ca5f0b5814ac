/* The normal force of a contact that lasts, at an overlap d; d_max is its greatest since the
 * touch, and 0 while open. Hertz's law, with a restitution e:
 *
 *     F = K d^1.5                                     while d >= d_max: loading
 *     F = K/e^3 (d - (1 - e^2) d_max)^1.5, or 0       below it: unloading, loading again
 *
 *     F |                        .'
 *       |                      .'|
 *       |        loading    .-'  |
 *       |                .-'    /    unloading,
 *       |            .--'      /     and loading again
 *       |       .--'         .'
 *       +--.-'-------------.'----+------ d
 *       0    (1 - e^2) d_max     d_max
 *            the set that is left
 *
 * Unloading returns e^2 of the work of compression, for any course of d. A contact that closes
 * at v, with B the inverse of the reduced mass, is pressed delta = (5 v^2 / (4 K B))^0.4 deep, and
 * lasts CAROM_HERTZ_DURATION delta / v.
 *
 * Tip and slate have linear branches instead, k d and k/e^2 (d - (1 - e^2) d_max), which return
 * e^2 of the work too. */
#ifndef CAROM_SRC_CLUSTER_HERTZ_H
#define CAROM_SRC_CLUSTER_HERTZ_H

#include "platform/arithmetic.h"
#include "platform/promise.h"

#include <math.h>

/* twice the integral of 1/sqrt(1 - x^2.5) from 0 to 1: of a contact without losses */
#define CAROM_HERTZ_DURATION 2.9432
#define CAROM_QUARTER_TURN 1.57079632679489662     /* pi/2 */
#define CAROM_CENTROID_OF_SINE 0.63661977236758134 /* 2/pi */

/* F of Hertz's law at an overlap above 0, and the greatest one, which grows with it. */
static inline double carom_hertz_force(double stiffness, double restitution, double overlap,
                                       double *overlap_max) {
  CAROM_PROMISE(!(overlap <= 0.0 || *overlap_max < 0.0) && restitution > 0.0 && restitution <= 1.0);
  if (overlap >= *overlap_max) {
    *overlap_max = overlap;
    return stiffness * overlap * sqrt(overlap);
  }
  /* what has not been left as a set gives the force back */
  const double elastic = overlap - (1.0 - restitution * restitution) * *overlap_max;
  return elastic > 0.0
             ? stiffness / (restitution * restitution * restitution) * elastic * sqrt(elastic)
             : 0.0;
}

/* k/m of a contact with linear branches that by itself lasts that long, against the mass m, in
 * 1/s^2. Loading is a quarter of a swing at the rate sqrt(k/m), unloading e times as long. */
static inline double carom_linear_stiffness(double time, double restitution) {
  const double rate = CAROM_QUARTER_TURN * (1.0 + restitution) / time;
  return rate * rate;
}

/* The centroid in time of the impulse of a contact with linear branches that lasts so long alone.
 * The force is a quarter of a sine, whose centroid is 2/pi of it, and then e times as long as that
 * a quarter of a cosine, whose centroid is 1 - 2/pi of it. */
static inline double carom_linear_lag(double time, double restitution) {
  return time / (1.0 + restitution) * (CAROM_CENTROID_OF_SINE * (1.0 - restitution) + restitution);
}

/* F with linear branches, k for K. */
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

/* d_max of a contact whose force has reached 0: its set recovers as the overlap falls, so that it
 * loads again along the line of unloading. It is open where the overlap is 0. */
static inline double carom_set_left(double restitution, double overlap, double overlap_max) {
  const double lost = 1.0 - restitution * restitution;
  if (overlap > lost * overlap_max)
    return overlap_max;
  return overlap > 0.0 && lost > 0.0 ? overlap / lost : 0.0;
}

/* d_max after a step, in the middle of which the contact had that overlap. Where the closing speed
 * changed its sign within the step, d_max is the vertex of the parabola with these speeds at its
 * ends. */
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
