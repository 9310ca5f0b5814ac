/* A number with its derivatives in CAROM_DUAL_WIDTH directions, which the includer chooses: what
 * represents `double` in the copies of the sources of motion and contacts (text.h).
 *
 * x is the value and d has the derivatives, one for each direction. Arithmetic follows the rules
 * of differentiation:
 *
 *     d(a b) = x_a d_b + x_b d_a      d(a / b) = (d_a - (x_a / x_b) d_b) / x_b
 *     d sqrt(a) = d_a / (2 sqrt(x_a))
 *
 * Constants are of type `real` and cost no work on derivatives. The decision of a comparison,
 * rounding and conversion to other types have no derivative. Where a comparison is watched and
 * its sides agree to 1e-9, the derivative changes there: a kink. */
#ifndef CAROM_SRC_TANGENT_DUAL_H
#define CAROM_SRC_TANGENT_DUAL_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Macros where there is only the header of C. */
#undef isfinite
#undef isnan

/* The bits that the library promises hold in C, and likewise in C++. */
#define _Static_assert static_assert
extern "C" {
#include "platform/elementary.h"
#include "tangent/work.h"
}

namespace {

typedef double real;
enum { WIDTH = CAROM_DUAL_WIDTH, CLOCK = WIDTH - 1 }; /* the last direction is time */

/* Derivatives in all directions: a few vectors that fit registers, since compilers keep longer
 * ones in memory. */
typedef real lane __attribute__((vector_size(WIDTH > 1 ? 16 : 8)));
enum { LANE = sizeof(lane) / sizeof(real), LANES = WIDTH / LANE };
struct row {
  lane q[LANES];
  real operator[](int k) const {
    return q[k / LANE][k % LANE];
  }
  real &operator[](int k) {
    return reinterpret_cast<real *>(q)[k];
  }
};
/* Unrolled here, because core/src/CMakeLists.txt compiles below -O3, which would unroll it.
 * */
#define CAROM_LANES(expression)                                                 \
  row r;                                                                        \
  _Pragma("GCC unroll 16") for (int i = 0; i < LANES; i++) r.q[i] = expression; \
  return r
/* Rules are inlined; their callers are not, so that its numbers leave the stack with it. */
#define CAROM_RULE static inline __attribute__((always_inline))
#define CAROM_APART __attribute__((noinline))
CAROM_RULE row operator+(const row &a, const row &b) {
  CAROM_LANES(a.q[i] + b.q[i]);
}
CAROM_RULE row operator-(const row &a, const row &b) {
  CAROM_LANES(a.q[i] - b.q[i]);
}
CAROM_RULE row operator-(const row &a) {
  CAROM_LANES(-a.q[i]);
}
CAROM_RULE row operator*(const row &a, real b) {
  CAROM_LANES(a.q[i] * b);
}
CAROM_RULE row operator*(real a, const row &b) {
  CAROM_LANES(a * b.q[i]);
}
CAROM_RULE row operator/(const row &a, real b) {
  CAROM_LANES(a.q[i] / b);
}
CAROM_RULE row &operator+=(row &a, const row &b) {
  return a = a + b;
}
CAROM_RULE row &operator-=(row &a, const row &b) {
  return a = a - b;
}
/* x a + y b and (a - x b) y, without a row between. */
CAROM_RULE row sum(real x, const row &a, real y, const row &b) {
  CAROM_LANES(a.q[i] * x + b.q[i] * y);
}
CAROM_RULE row rest(const row &a, real x, const row &b, real y) {
  CAROM_LANES((a.q[i] - b.q[i] * x) * y);
}

/* The flags and errors of the contacts of this thread; begun anew for each. */
struct watch {
  bool on;
  carom_tangent_note note;
};
thread_local watch watched;

struct number {
  real x;
  row d;
  number() = default;
  constexpr number(real value) : x(value), d{} {
  }
  constexpr number(real value, row change) : x(value), d(change) {
  }
  explicit operator int() const {
    return (int)x;
  }
  explicit operator int64_t() const {
    return (int64_t)x;
  }
  explicit operator float() const {
    return (float)x;
  }
};

CAROM_RULE number operator+(const number &a, const number &b) {
  return {a.x + b.x, a.d + b.d};
}
CAROM_RULE number operator-(const number &a, const number &b) {
  return {a.x - b.x, a.d - b.d};
}
CAROM_RULE number operator*(const number &a, const number &b) {
  return {a.x * b.x, sum(b.x, a.d, a.x, b.d)};
}
CAROM_RULE number operator/(const number &a, const number &b) {
  const real quotient = a.x / b.x, per = 1 / b.x;
  return {quotient, rest(a.d, quotient, b.d, per)};
}
CAROM_RULE number operator-(const number &a) {
  return {-a.x, -a.d};
}
CAROM_RULE number operator+(const number &a, real b) {
  return {a.x + b, a.d};
}
CAROM_RULE number operator+(real a, const number &b) {
  return {a + b.x, b.d};
}
CAROM_RULE number operator-(const number &a, real b) {
  return {a.x - b, a.d};
}
CAROM_RULE number operator-(real a, const number &b) {
  return {a - b.x, -b.d};
}
CAROM_RULE number operator*(const number &a, real b) {
  return {a.x * b, a.d * b};
}
CAROM_RULE number operator*(real a, const number &b) {
  return {a * b.x, a * b.d};
}
CAROM_RULE number operator/(const number &a, real b) {
  return {a.x / b, a.d * (1 / b)};
}
CAROM_RULE number operator/(real a, const number &b) {
  const real quotient = a / b.x;
  return {quotient, b.d * (-quotient / b.x)};
}
template <class other> CAROM_RULE number &operator+=(number &a, const other &b) {
  return a = a + b;
}
template <class other> CAROM_RULE number &operator-=(number &a, const other &b) {
  return a = a - b;
}
template <class other> CAROM_RULE number &operator*=(number &a, const other &b) {
  return a = a * b;
}
template <class other> CAROM_RULE number &operator/=(number &a, const other &b) {
  return a = a / b;
}

/* ---- Comparisons ---- */

/* Whether a change brings a and b apart. */
static bool part(const row &a, const row &b) {
  bool any = false;
  for (int k = 0; k < CLOCK; k++)
    any |= a[k] != b[k];
  return any;
}
CAROM_RULE void look(const number &a, const number &b) {
  if (__builtin_expect(__builtin_fabs(a.x - b.x) < 1e-9 * __builtin_fabs(b.x), 0) && watched.on &&
      part(a.d, b.d))
    watched.note.flags |= CAROM_TANGENT_KINK;
}
#define CAROM_ORDER(op)                                           \
  CAROM_RULE bool operator op(const number &a, const number &b) { \
    look(a, b);                                                   \
    return a.x op b.x;                                            \
  }                                                               \
  CAROM_RULE bool operator op(const number &a, real b) {          \
    return a.x op b;                                              \
  }                                                               \
  CAROM_RULE bool operator op(real a, const number &b) {          \
    return a op b.x;                                              \
  }
CAROM_ORDER(<)
CAROM_ORDER(>)
CAROM_ORDER(<=)
CAROM_ORDER(>=)
CAROM_RULE bool operator==(const number &a, const number &b) {
  return a.x == b.x;
}
CAROM_RULE bool operator!=(const number &a, const number &b) {
  return a.x != b.x;
}

/* ---- Functions ---- */

/* A root has no derivative at 0, where it is a length that nothing divides by. */
CAROM_RULE number sqrt(const number &a) {
  const real root = __builtin_sqrt(a.x);
  return a.x == 0 ? number(root) : number(root, a.d * (0.5 / root));
}
CAROM_RULE number fabs(const number &a) {
  return __builtin_signbit(a.x) ? -a : a;
}
CAROM_RULE number fmin(const number &a, const number &b) {
  return a.x < b.x || __builtin_isnan(b.x) ? a : b;
}
CAROM_RULE number fmax(const number &a, const number &b) {
  return a.x > b.x || __builtin_isnan(b.x) ? a : b;
}
CAROM_RULE number copysign(const number &a, const number &b) {
  return __builtin_signbit(a.x) == __builtin_signbit(b.x) ? a : -a;
}
CAROM_RULE number ldexp(const number &a, int n) {
  return {__builtin_ldexp(a.x, n), a.d * __builtin_ldexp(1.0, n)};
}
/* See platform/dependence.h. */
CAROM_RULE bool carom_absent(const number &a) {
  bool none = a.x == 0;
  for (int k = 0; k < WIDTH; k++)
    none &= a.d[k] == 0;
  return none;
}
CAROM_RULE bool carom_varies(const number &a) {
  return !carom_absent({0, a.d});
}
CAROM_RULE number carom_above(const number &a, real least) {
  return a.x < least ? number(0, a.d) : a;
}
CAROM_RULE number carom_limited(const number &from, const number &sum) {
  if ((sum.x == 0 || sum.x == 1) && watched.on && part(from.d, sum.d))
    watched.note.flags |= CAROM_TANGENT_KINK;
  if (sum.x < 0)
    return number(0);
  return sum.x > 1 ? number(1) : sum;
}
CAROM_RULE bool isfinite(const number &a) {
  return __builtin_isfinite(a.x);
}
CAROM_RULE bool isnan(const number &a) {
  return __builtin_isnan(a.x);
}

} // namespace

#endif
