/* Questions about a number whose answers differ where it carries derivatives, as tangent/dual.h has
 * them. */
#ifndef CAROM_SRC_PLATFORM_DEPENDENCE_H
#define CAROM_SRC_PLATFORM_DEPENDENCE_H

#include <stdbool.h>

/* Whether a number is 0, so that what it changes may be left out. A number with derivatives is
 * absent only where nothing depends on it. */
static inline bool carom_absent(double x) {
  return x == 0;
}
/* Whether a number has derivatives, so that what it changes counts however small it is. */
static inline bool carom_varies(double x) {
  (void)x;
  return false;
}
/* A number that is 0 below some least value, where it keeps its derivatives. */
static inline double carom_above(double x, double least) {
  return x < least ? 0.0 : x;
}
/* A sum that begins with `from`, within 0 and 1. At either end it has the derivatives of the sum;
 * there it has a kink by all numbers but `from`, whose range ends there. */
static inline double carom_limited(double from, double sum) {
  (void)from;
  if (sum < 0)
    return 0;
  return sum > 1 ? (double)1 : sum;
}

#endif
