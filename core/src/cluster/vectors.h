/* Vectors of three, of which a contact on the cloth uses two numbers. `flat` is a constant where
 * these are inlined. */
#ifndef CAROM_SRC_CLUSTER_VECTORS_H
#define CAROM_SRC_CLUSTER_VECTORS_H

#include "platform/vectors.h"

#include <math.h>
#include <stdbool.h>

static inline double cluster_dot(bool flat, const double a[3], const double b[3]) {
  return flat ? carom_plane_dot(a, b) : carom_space_dot(a, b);
}

/* out = a - b */
static inline void cluster_minus(bool flat, const double a[3], const double b[3], double out[3]) {
  out[0] = a[0] - b[0];
  out[1] = a[1] - b[1];
  out[2] = flat ? 0.0 : a[2] - b[2];
}

/* a += x b */
static inline void cluster_add(bool flat, double a[3], double x, const double b[3]) {
  a[0] += x * b[0];
  a[1] += x * b[1];
  if (!flat)
    a[2] += x * b[2];
}

/* Two unit vectors across n and each other: t, horizontal, or along n x e_x where n is nearly
 * upright, and t x n, which is up on the cloth. */
static inline void cluster_across(bool flat, const double n[3], double t[3], double third[3]) {
  const double level = flat ? 1.0 : carom_plane_size(n);
  if (level >= 0.1) {
    const double size = flat ? 1.0 : 1.0 / level;
    t[0] = flat ? n[1] : n[1] * size;
    t[1] = flat ? -n[0] : -n[0] * size;
    t[2] = 0.0;
  } else {
    const double size = 1.0 / sqrt(n[1] * n[1] + n[2] * n[2]);
    t[0] = 0.0;
    t[1] = n[2] * size;
    t[2] = -n[1] * size;
  }
  third[0] = flat ? 0.0 : t[1] * n[2] - t[2] * n[1];
  third[1] = flat ? 0.0 : t[2] * n[0] - t[0] * n[2];
  third[2] = flat ? 1.0 : t[0] * n[1] - t[1] * n[0];
}

#endif
