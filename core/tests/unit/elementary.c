/* The elementary functions against those of the C library in long double. The bounds are those
 * that elementary.h states. */
#include "platform/elementary.h"
#include "support.h"

#include <float.h>

enum { DRAWN = 100000 };

/* The error in units in the last place of the exact result, or of 1. */
static double in_ulp(double x, long double exact) {
  const double size = fabs((double)exact);
  return (double)fabsl((long double)x - exact) / (nextafter(size, INFINITY) - size);
}

static double in_ulp_of_1(double x, long double exact) {
  return (double)fabsl((long double)x - exact) / DBL_EPSILON;
}

TEST(exponential) {
  random_source r = {test_seed()};
  for (int n = 0; n < DRAWN; n++) {
    const double size = pow(10.0, random_between(&r, -6.0, 2.85)), x = n % 2 == 0 ? -size : size;
    if (x > -708.0)
      ck_assert_msg(x > 709.7 || in_ulp(carom_exp(x), expl((long double)x)) <= 1.2, "exp(%.17g)",
                    x);
  }
  ck_assert_double_eq(carom_exp(0.0), 1.0);
  ck_assert_double_eq(carom_exp(-708.0), 0.0);
  ck_assert_double_eq(carom_exp(-INFINITY), 0.0);
  ck_assert_double_le(in_ulp(carom_exp(709.5), expl(709.5L)), 1.0); /* more than 2^1023 */
  ck_assert_double_infinite(carom_exp(709.79));
  ck_assert_double_infinite(carom_exp(INFINITY));
  ck_assert_double_nan(carom_exp(NAN));
}

/* The error of a logarithm in units in the last place of the larger of 1 and its size. */
static double of_log(double x) {
  const long double exact = logl((long double)x);
  return fabsl(exact) > 1.0L ? in_ulp(carom_log(x), exact) : in_ulp_of_1(carom_log(x), exact);
}

TEST(logarithm) {
  random_source r = {test_seed()};
  for (int n = 0; n < DRAWN; n++) {
    const double x =
        n % 2 == 0 ? random_between(&r, 0.5, 2.0) : pow(10.0, random_between(&r, -308.0, 308.0));
    ck_assert_msg(of_log(x) <= 3.0, "ln(%.17g)", x);
  }
  /* where the 64th parts meet, and the ends */
  for (int k = 64; k <= 128; k++)
    ck_assert(of_log(k / 64.0) <= 2.0 && of_log(nextafter(k / 64.0, 0.0)) <= 2.0);
  ck_assert_double_le(of_log(0x1p-1074), 2.0);
  ck_assert_double_eq(carom_log(0.0), -INFINITY);
  ck_assert_double_eq(carom_log(INFINITY), INFINITY);
  ck_assert_double_nan(carom_log(-1.0));
  ck_assert_double_nan(carom_log(NAN));
}

TEST(bend) {
  random_source r = {test_seed()};
  for (int n = 0; n < DRAWN; n++) {
    const double q = 0.5 * pow(10.0, random_between(&r, n % 2 == 0 ? -1.0 : -12.0, 0.0)),
                 x = n % 3 == 0 ? random_between(&r, 0.0, 1.0)
                                : pow(10.0, random_between(&r, -6.0 * q, 0.0));
    const long double z = powl((long double)x, 0.5L / (long double)q);
    ck_assert_msg(in_ulp(carom_bend(x, q), expl(-(long double)q * log1pl(z))) <= 2.0,
                  "bend(%.17g, %.17g)", x, q);
  }
  ck_assert_double_eq(carom_bend(0.0, 0.5), 1.0);
  ck_assert_double_eq(carom_bend(0.0, 1e-12), 1.0);
  ck_assert_double_eq_tol(carom_bend(1.0, 0.5), sqrt(0.5), 3e-16);
}

TEST(sine_and_cosine) {
  random_source r = {test_seed()};
  double s, c;
  for (int n = 0; n < DRAWN; n++) {
    const double degrees = random_between(&r, -1.0, 1.0) * pow(10.0, random_between(&r, 0.0, 5.0));
    const long double angle =
        fmodl((long double)degrees, 360.0L) * 3.14159265358979323846L / 180.0L;
    carom_sincos_degrees(degrees, &s, &c);
    ck_assert_msg(in_ulp_of_1(s, sinl(angle)) <= 1.0 && in_ulp_of_1(c, cosl(angle)) <= 1.0,
                  "%.17g degrees", degrees);
    const double x = random_between(&r, -1.0, 1.0) * pow(10.0, random_between(&r, 0.0, 6.0));
    carom_sincos(x, &s, &c);
    ck_assert_msg(in_ulp_of_1(s, sinl((long double)x)) <= 1.0 &&
                      in_ulp_of_1(c, cosl((long double)x)) <= 1.0,
                  "%.17g", x);
  }
  for (int quarter = -8; quarter <= 8; quarter++) {
    carom_sincos_degrees(90.0 * quarter, &s, &c);
    ck_assert(quarter % 2 != 0 ? c == 0.0 && fabs(s) == 1.0 : s == 0.0 && fabs(c) == 1.0);
    /* the double nearest to so many quarters misses them by something that the sine tells */
    const double x = 1.5707963267948966 * quarter;
    carom_sincos(x, &s, &c);
    ck_assert_double_le(
        fabs((quarter % 2 == 0 ? s : c) -
             (double)(quarter % 2 == 0 ? sinl((long double)x) : cosl((long double)x))),
        1e-30);
  }
}

TEST(inverse_tangent_and_cosine) {
  random_source r = {test_seed()};
  for (int n = 0; n < DRAWN; n++) {
    const double size = pow(10.0, random_between(&r, -8.0, 8.0)), x = n % 2 == 0 ? -size : size;
    ck_assert_msg(in_ulp(carom_atan(x), atanl((long double)x)) <= 2.5, "atan(%.17g)", x);
    const double near_0 = random_between(&r, -1.0, 1.0),
                 near_1 = 1.0 - pow(10.0, random_between(&r, -16.0, 0.0));
    const double places[3] = {near_0, near_1, -near_1}, y = places[n % 3];
    ck_assert_msg(in_ulp(carom_acos(y), acosl((long double)y)) <= 4.0, "acos(%.17g)", y);
  }
  /* where the eighths meet */
  for (int k = 0; k <= 16; k++) {
    const double x = k / 16.0;
    ck_assert_double_le(k == 0 ? fabs(carom_atan(x)) : in_ulp(carom_atan(x), atanl((long double)x)),
                        2.5);
    ck_assert_double_eq(carom_atan(-x), -carom_atan(x));
  }
  ck_assert_double_eq(carom_atan(INFINITY), 1.5707963267948966);
  ck_assert_double_eq(carom_atan(-INFINITY), -1.5707963267948966);
  ck_assert(signbit(carom_atan(-0.0)) && !signbit(carom_atan(0.0)));
  ck_assert_double_nan(carom_atan(NAN));
  ck_assert_double_eq(carom_acos(1.0), 0.0);
  ck_assert_double_eq(carom_acos(-1.0), 3.1415926535897931);
  ck_assert_double_nan(carom_acos(1.0000001));
  ck_assert_double_nan(carom_acos(NAN));
}

TEST(minmod) {
  ck_assert_double_eq(carom_minmod(2.0, 3.0), 2.0);
  ck_assert_double_eq(carom_minmod(-2.0, -1.0), -1.0);
  ck_assert_double_eq(carom_minmod(2.0, -1.0), 0.0);
  ck_assert_double_eq(carom_minmod(0.0, 1.0), 0.0);
}
