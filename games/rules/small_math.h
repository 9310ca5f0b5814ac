/* Numbers, angles and ways: the small functions that all parts of the games share. */
#ifndef CAROM_PLAN_SMALL_MATH_H
#define CAROM_PLAN_SMALL_MATH_H

#include "platform/arithmetic.h"

#include <stdbool.h>
#include <stdint.h>

static const double pi = 3.14159265358979323846, degree = 3.14159265358979323846 / 180.0;

static inline double carom_within(double x, double least, double most) {
  if (x < least)
    return least;
  if (x > most)
    return most;
  return x;
}

/* An angle of less than three half turns, as one of at most half a turn. */
static inline double carom_wrapped(double angle) {
  if (angle > pi)
    return angle - 2.0 * pi;
  if (angle < -pi)
    return angle + 2.0 * pi;
  return angle;
}

/* A direction, degrees, of -360 to below 720 as one of 0 to below 360. */
static inline double carom_turned(double phi) {
  if (phi < 0.0)
    return phi + 360.0;
  if (phi >= 360.0)
    return phi - 360.0;
  return phi;
}

static inline int64_t carom_min(int64_t a, int64_t b) {
  if (a < b)
    return a;
  return b;
}
static inline int64_t carom_max(int64_t a, int64_t b) {
  if (a > b)
    return a;
  return b;
}

/* Whether a point, `offset` from where a way begins, is nearer than `least` to the way: so long, in
 * the direction u. */
static inline bool carom_is_near_way(const double offset[2], const double u[2], double length,
                                     double least) {
  const double along = carom_within(offset[0] * u[0] + offset[1] * u[1], 0.0, length);
  const double off[2] = {offset[0] - along * u[0], offset[1] - along * u[1]};
  return off[0] * off[0] + off[1] * off[1] < least * least;
}

#endif
