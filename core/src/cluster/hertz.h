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
static inline double carom_hertz_force(double K, double e, double d, double *d_max) {
  CAROM_PROMISE(!(d <= 0.0 || *d_max < 0.0) && e > 0.0 && e <= 1.0);
  if (d >= *d_max) {
    *d_max = d;
    return K * d * sqrt(d);
  }
  const double y = d - (1.0 - e * e) * *d_max;
  return y > 0.0 ? K / (e * e * e) * y * sqrt(y) : 0.0;
}

/* k over the mass of a contact with linear branches that lasts so long alone, against that mass. */
static inline double carom_linear_stiffness(double time, double e) {
  const double rate = 1.57079632679489662 * (1.0 + e) / time;
  return rate * rate;
}

/* The centroid in time of the impulse of a contact with linear branches that lasts so long alone.
 */
static inline double carom_linear_lag(double time, double e) {
  return time / (1.0 + e) * (0.63661977236758134 * (1.0 - e) + e);
}

/* Hertz's force with linear branches. */
static inline double carom_linear_force(double k, double e, double d, double *d_max) {
  CAROM_PROMISE(!(d <= 0.0 || *d_max < 0.0) && e > 0.0 && e <= 1.0);
  if (d >= *d_max) {
    *d_max = d;
    return k * d;
  }
  const double y = d - (1.0 - e * e) * *d_max;
  return y > 0.0 ? k / (e * e) * y : 0.0;
}

/* d_max of a contact whose force has reached 0: its set recovers as d falls, so that it loads again
 * along the line of unloading. It is open where d is 0. */
static inline double carom_set_left(double e, double d, double d_max) {
  const double lost = 1.0 - e * e;
  if (d > lost * d_max)
    return d_max;
  return d > 0.0 && lost > 0.0 ? d / lost : 0.0;
}

/* d_max after a step of h, in the middle of which the overlap was d, and which took the closing
 * speed from v0 to v1: where that changes its sign, the vertex of a parabola. */
static inline double carom_hertz_vertex(double d, double d_max, double h, double v0, double v1) {
  if (!(v0 > 0.0 && v1 <= 0.0 && d >= d_max))
    return d_max;
  const double vertex = d - 0.5 * h * v0 + 0.5 * h * v0 * v0 / (v0 - v1);
  return d > vertex ? d : vertex;
}

#endif
