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

/* sum += factor term */
static inline void cluster_add(bool flat, double sum[3], double factor, const double term[3]) {
  sum[0] += factor * term[0];
  sum[1] += factor * term[1];
  if (!flat)
    sum[2] += factor * term[2];
}

/* Two unit vectors across the normal n and each other: the tangent t, horizontal, or along n x e_x
 * where n is nearly upright, and the third one, t x n, which is up on the cloth.
 *
 *      third ^   from above, t is to the right of n
 *            |
 *            o-----> n
 *           /
 *          t
 *
 * n is nearly upright where its horizontal part is below 0.1, as rounding would turn t there. */
#define CAROM_NEARLY_UPRIGHT 0.1
static inline void cluster_across(bool flat, const double normal[3], double tangent[3],
                                  double third[3]) {
  const double level = flat ? 1.0 : carom_plane_size(normal);
  if (level >= CAROM_NEARLY_UPRIGHT) {
    const double size = flat ? 1.0 : 1.0 / level;
    tangent[0] = flat ? normal[1] : normal[1] * size;
    tangent[1] = flat ? -normal[0] : -normal[0] * size;
    tangent[2] = 0.0;
  } else {
    const double size = 1.0 / sqrt(normal[1] * normal[1] + normal[2] * normal[2]);
    tangent[0] = 0.0;
    tangent[1] = normal[2] * size;
    tangent[2] = -normal[1] * size;
  }
  third[0] = flat ? 0.0 : tangent[1] * normal[2] - tangent[2] * normal[1];
  third[1] = flat ? 0.0 : tangent[2] * normal[0] - tangent[0] * normal[2];
  third[2] = flat ? 1.0 : tangent[0] * normal[1] - tangent[1] * normal[0];
}

#endif
