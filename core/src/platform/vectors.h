/* Products of vectors: in the plane of the cloth, of which two numbers count, and in space. Sums
 * begin with x, so each has the same bits in every context. */
#ifndef CAROM_SRC_PLATFORM_VECTORS_H
#define CAROM_SRC_PLATFORM_VECTORS_H

#include "platform/arithmetic.h"

#include <math.h>

static inline double carom_plane_dot(const double a[2], const double b[2]) {
  return a[0] * b[0] + a[1] * b[1];
}
static inline double carom_space_dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline double carom_plane_size(const double a[2]) {
  return sqrt(carom_plane_dot(a, a));
}
static inline double carom_space_size(const double a[3]) {
  return sqrt(carom_space_dot(a, a));
}

/* out = a x b, another position than both. */
static inline void carom_cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

#endif
