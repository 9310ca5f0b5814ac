/* The sources of whole shots as C++ in which `double` is a dual number, x + d eps with eps^2 = 0: with one direction in the d
 * of its input, a shot has the derivatives of all that it computes, by the rules of differentiation alone. The compiler
 * includes this file before each source (CMakeLists.txt of this folder). The values are those of the C library to the last bit,
 * since the operations on x are the same.
 *
 * What a comparison decides, rounding and conversion to other types have no derivative. */
#ifndef CAROM_TESTS_DUAL_NUMBER_H
#define CAROM_TESTS_DUAL_NUMBER_H

/* Every header of the system that the sources include, before double is another type. */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* `sizeof 0.1` and how much a caller keeps of a shot are not those of C. */
#define _Static_assert(...) static_assert(true, "")
/* The program has the library too. Without this macro carom's headers declare functions of C++, which have other names for the
 * linker; a variable has not. */
#undef __cplusplus
#define carom_table_pooltool carom_table_pooltool_of_dual_numbers

/* Whatever holds for the rounding of the sources holds for the operations here. */
#include "platform/arithmetic.h"

typedef double real;

struct dual {
  real x, d;
  dual() = default;
  constexpr dual(real value) : x(value), d(0) {
  }
  constexpr dual(real value, real change) : x(value), d(change) {
  }
  explicit operator float() const {
    return (float)x;
  }
  explicit operator int() const {
    return (int)x;
  }
  explicit operator int64_t() const {
    return (int64_t)x;
  }
};

static inline dual operator+(dual a, dual b) {
  return {a.x + b.x, a.d + b.d};
}
static inline dual operator-(dual a, dual b) {
  return {a.x - b.x, a.d - b.d};
}
static inline dual operator*(dual a, dual b) {
  return {a.x * b.x, a.d * b.x + a.x * b.d};
}
static inline dual operator/(dual a, dual b) {
  const real quotient = a.x / b.x;
  return {quotient, (a.d - quotient * b.d) / b.x};
}
static inline dual operator-(dual a) {
  return {-a.x, -a.d};
}
static inline dual &operator+=(dual &a, dual b) {
  return a = a + b;
}
static inline dual &operator-=(dual &a, dual b) {
  return a = a - b;
}
static inline dual &operator*=(dual &a, dual b) {
  return a = a * b;
}
static inline dual &operator/=(dual &a, dual b) {
  return a = a / b;
}
static inline bool operator<(dual a, dual b) {
  return a.x < b.x;
}
static inline bool operator>(dual a, dual b) {
  return a.x > b.x;
}
static inline bool operator<=(dual a, dual b) {
  return a.x <= b.x;
}
static inline bool operator>=(dual a, dual b) {
  return a.x >= b.x;
}
static inline bool operator==(dual a, dual b) {
  return a.x == b.x;
}
static inline bool operator!=(dual a, dual b) {
  return a.x != b.x;
}

/* The functions of the C library that the sources call. The root has no derivative at 0, where it is of a length that nothing
 * divides by. */
static inline dual sqrt(dual a) {
  const real root = sqrt(a.x);
  return {root, a.x == 0 ? 0 : a.d / (2 * root)};
}
static inline dual fabs(dual a) {
  return signbit(a.x) ? -a : a;
}
static inline dual fmin(dual a, dual b) {
  return a.x < b.x || isnan(b.x) ? a : b;
}
static inline dual fmax(dual a, dual b) {
  return a.x > b.x || isnan(b.x) ? a : b;
}
static inline dual copysign(dual a, dual b) {
  return signbit(a.x) == signbit(b.x) ? a : -a;
}
static inline dual ldexp(dual a, int n) {
  return {ldexp(a.x, n), ldexp(a.d, n)};
}
static inline dual floor(dual a) {
  return floor(a.x);
}
static inline dual ceil(dual a) {
  return ceil(a.x);
}
static inline bool isfinite(dual a) {
  return isfinite(a.x);
}
static inline bool isnan(dual a) {
  return isnan(a.x);
}

#define double dual

#endif
