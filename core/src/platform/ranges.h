/* Comparisons of numbers without a call, and the ranges of the numbers of a struct. */
#ifndef CAROM_SRC_PLATFORM_RANGES_H
#define CAROM_SRC_PLATFORM_RANGES_H

#include "carom.h"
#include "platform/dependence.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* fmin() and fmax() without their care for NaN, which costs a call. */
static inline double carom_lesser(double a, double b) {
  return a < b ? a : b;
}
static inline double carom_greater(double a, double b) {
  return a > b ? a : b;
}

/* A number of the caller's, or the usual one that 0 represents. It has the derivatives of the
 * number in both cases. */
static inline double carom_or_usual(double value, double usual) {
  return value > 0.0 ? value : usual + value;
}

/* x - x is 0 unless x is infinite or no number. C++ has isfinite() only in std. */
static inline bool carom_is_finite(const double x[3]) {
  return (x[0] - x[0]) + (x[1] - x[1]) + (x[2] - x[2]) == 0.0;
}
/* CAROM_OK, or an error where something is not good. */
static inline carom_status carom_ok_if(bool good, carom_status error) {
  return good ? CAROM_OK : error;
}
static inline bool carom_is_positive(double x) {
  return x > 0.0 && x < INFINITY;
}
static inline bool carom_in_unit_interval(double x) {
  return x >= 0.0 && x <= 1.0;
}
static inline bool carom_is_not_negative(double x) {
  return x >= 0.0 && x < INFINITY;
}

/* Whether the reserved fields of a struct of the caller's are zero. */
#define CAROM_RESERVED_IS_ZERO(s) \
  carom_is_zero((s)->reserved, sizeof((s)->reserved) / sizeof((s)->reserved[0]))
static inline bool carom_is_zero(const uint64_t *field, size_t n) {
  uint64_t any = 0;
  for (size_t k = 0; k < n; k++)
    any |= field[k];
  return any == 0;
}

/* The range of a number, both ends of which belong to it, and the error of a number outside. */
typedef struct carom_range {
  double low, high;
  carom_status error;
} carom_range;
#define CAROM_FINITE -DBL_MAX, DBL_MAX
#define CAROM_POSITIVE DBL_TRUE_MIN, DBL_MAX
#define CAROM_NOT_NEGATIVE 0.0, DBL_MAX
#define CAROM_UNIT_INTERVAL 0.0, 1.0

/* The first of n numbers that is outside its range, or n. Ranges repeat with a period. */
static inline int carom_first_outside(const double *x, int n, const carom_range *row, int period) {
  int k = 0;
  while (k < n && x[k] >= row[k % period].low && x[k] <= row[k % period].high)
    k++;
  return k;
}

#endif
