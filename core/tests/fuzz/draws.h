/* Inputs of the targets of the library, drawn from the bytes of a fuzzer: ordinary numbers,
 * special ones (zeros, equal ones, infinities, NaN, the ends of the range) and arbitrary bits.
 * Bytes that are missing count as 0. */
#ifndef CAROM_FUZZ_DRAWS_H
#define CAROM_FUZZ_DRAWS_H

#include "carom_tangent.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const uint8_t *bytes;
static size_t left;
static double last; /* the number before */
static bool tame;   /* whether numbers stay within their bounds, and options are those that there
                       are */

static inline unsigned byte(void) {
  if (left == 0)
    return 0;
  left--;
  return *bytes++;
}

static inline int choice(int n) {
  return (int)(byte() % (unsigned)n);
}

static inline void arbitrary(void *to, size_t size) {
  for (size_t k = 0; k < size; k++)
    ((unsigned char *)to)[k] = (unsigned char)byte();
}

/* Mostly between low and high. */
static inline double number(double low, double high) {
  static const double special[] = {
      0,      -0.0,  1,       -1,       0.5,          0.2,       0.4,        1e-9,
      -1e-9,  1e-17, 1e-300,  DBL_MIN,  DBL_TRUE_MIN, 1e9,       -1e9,       1e100,
      -1e160, 1e300, DBL_MAX, -DBL_MAX, INFINITY,     -INFINITY, (double)NAN};
  double x;
  const unsigned how = byte();
  if (how < 4)
    arbitrary(&x, sizeof x);
  else if (how < 24)
    x = special[byte() % (sizeof special / sizeof special[0])];
  else if (how < 40)
    x = last;
  else if (how < 56)
    x = -last;
  else if (how < 96)
    x = how % 2 == 0 ? low : high;
  else if (how < 104)
    x = last * (1 + ldexp(1, -(int)(byte() % 60)));
  else
    x = low + (high - low) * ((256 * (how % 64) + byte()) / 16383.0);
  if (tame && !(x >= low && x <= high))
    x = 0.5 * (low + high);
  last = x;
  return x;
}

/* A number of directions of derivatives, up to `most`: rarely one that is rejected. */
static inline int64_t directions(int most) {
  static const int64_t refused[] = {0, -1, CAROM_DIRECTIONS_MOST + 1, INT64_MAX, INT64_MIN};
  return choice(32) == 31 ? refused[choice(5)] : 1 + choice(most);
}

/* The next draws are made of these bytes. */
static inline void begin(const uint8_t *data, size_t size) {
  bytes = data;
  left = size;
  last = 0;
  tame = false;
}

static inline void vector(double v[3], double most, double z) {
  v[0] = number(-most, most);
  v[1] = number(-most, most);
  v[2] = z;
}

/* One of `n` reserved fields of options, which must be 0. */
static inline void reserve(uint64_t *reserved, int n) {
  const int one = choice(n);
  if (choice(50) == 49 && !tame)
    reserved[one] = 1;
}
#define RESERVE(options) \
  reserve((options).reserved, (int)(sizeof(options).reserved / sizeof *(options).reserved))

static inline void fail(const char *what) {
  fprintf(stderr, "fuzz: %s\n", what);
  abort();
}

/* All finite if `should`, else all NaN. */
static inline void expect(const double *x, size_t n, bool should, const char *what) {
  for (size_t k = 0; k < n; k++)
    if (should ? !isfinite(x[k]) : !isnan(x[k]))
      fail(what);
}

/* Whether all are 0 or of a size between 1 / most and most. */
static inline bool within(const double *x, size_t n, double most) {
  for (size_t k = 0; k < n; k++)
    if (!(fabs(x[k]) < most) || (x[k] != 0 && fabs(x[k]) < 1 / most))
      return false;
  return true;
}

/* Whether energies, and what is on the way to a result, are within the range of double. Details
 * and traces are held to that only. */
static inline bool moderate(const double *x, size_t n) {
  return within(x, n, 1e100);
}

/* What results are surrounded with, and whether all of it is still there. */
enum { GUARD = 0x55 };
#define FILL(array) memset(array, GUARD, sizeof(array))
static inline void unwritten(const void *from, size_t size, const char *what) {
  for (size_t k = 0; k < size; k++)
    if (((const unsigned char *)from)[k] != GUARD)
      fail(what);
}

/* The same of the elements of an array behind those that are used. */
#define UNWRITTEN(array, used, what) \
  unwritten((array) + (used), sizeof(array) - (size_t)(used) * sizeof *(array), what)

#endif
