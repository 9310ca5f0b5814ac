/* Comparisons of numbers, without a call. */
#ifndef CAROM_SRC_PLATFORM_RANGES_H
#define CAROM_SRC_PLATFORM_RANGES_H

#include <math.h>
#include <stdbool.h>

/* fmin() and fmax() without their care for NaN, which costs a call. */
static inline double carom_lesser(double a, double b) {
  return a < b ? a : b;
}
static inline double carom_greater(double a, double b) {
  return a > b ? a : b;
}

static inline bool carom_is_positive(double x) {
  return x > 0.0 && x < INFINITY;
}
static inline bool carom_in_unit_interval(double x) {
  return x >= 0.0 && x <= 1.0;
}

#endif
