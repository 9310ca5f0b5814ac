/* Elementary functions whose bits do not depend on the system's mathematical library. Argument
 * reduction is exact or nearly so, then Taylor's polynomial on a range where its remainder is
 * below rounding:
 *
 *     exp(x) = 2^k exp(r)                       k the whole number nearest to x / log 2, |r| <=
 *                                               log(2)/2
 *     ln(2^k m) = k ln 2 + ln(c) + 2 atanh(t)
 *     c a number of sixteenths near m: t = (m - c) / (m + c), |t| < 0.023
 *     x^y = 2^(k/16) exp(r)                     k the whole number nearest to 16 y ln(x) / ln 2,
 *                                               |r| <= ln(2)/32
 *     sin and cos of n pi/2 + r                 n whole, |r| <= pi/4
 *     atan(x) = atan(k/8) + atan(t)
 *     for 0 <= x <= 1: t = (x - k/8) / (1 + x k/8), |t| <= 1/16
 *             = pi/2 - atan(1/x)                for x > 1
 *     acos(x) = 2 atan(sqrt((1 - x) / (1 + x)))
 *
 * tests/unit/elementary.c compares them with the functions of the C library in long double. */
#include "platform/elementary.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { HIGHEST = 20 };
/* 1/n! */
static const double inverse_factorial[HIGHEST] = {1.0,
                                                  1.0,
                                                  1.0 / 2.0,
                                                  1.0 / 6.0,
                                                  1.0 / 24.0,
                                                  1.0 / 120.0,
                                                  1.0 / 720.0,
                                                  1.0 / 5040.0,
                                                  1.0 / 40320.0,
                                                  1.0 / 362880.0,
                                                  1.0 / 3628800.0,
                                                  1.0 / 39916800.0,
                                                  1.0 / 479001600.0,
                                                  1.0 / 6227020800.0,
                                                  1.0 / 87178291200.0,
                                                  1.0 / 1307674368000.0,
                                                  1.0 / 20922789888000.0,
                                                  1.0 / 355687428096000.0,
                                                  1.0 / 6402373705728000.0,
                                                  1.0 / 121645100408832000.0};

/* 2^k, for a normal result. */
static double power_of_two(double k) {
  const int64_t exponent = (int64_t)(k + 1023.0) << 52;
  double x = 0.0;
  memcpy(&x, &exponent, sizeof exponent);
  return x;
}

double carom_exp(double x) {
  if (!(x > -708.0))
    return isnan(x) ? x : 0.0;
  if (x > 710.0)
    return (double)INFINITY;
  /* x = k log 2 + r, |r| <= log(2)/2; log 2 in two parts, of which k times the first is exact */
  const double k = floor(x * 0x1.71547652b82fep+0 + 0.5);
  const double r = (x - k * 0x1.62e42feep-1) - k * 0x1.a39ef35793c76p-33;
  double sum = inverse_factorial[13]; /* r^14/14! < 5e-18 */
  for (int n = 12; n >= 0; n--)
    sum = inverse_factorial[n] + sum * r;
  const double half = floor(0.5 * k); /* 2^1024 is beyond all numbers, the result may not be */
  return sum * power_of_two(half) * power_of_two(k - half);
}

double carom_log(double x) {
  /* ln(c) of 11 to 22 sixteenths */
  static const double of_sixteenths[12] = {
      -0x1.7fafa3bd8151cp-2, -0x1.269621134db92p-2, -0x1.a93ed3c8ad9e3p-3,
      -0x1.1178e8227e47cp-3, -0x1.08598b59e3a07p-4, 0x0.0p+0,
      0x1.f0a30c01162a6p-5,  0x1.e27076e2af2e6p-4,  0x1.5ff3070a793d4p-3,
      0x1.c8ff7c79a9a22p-3,  0x1.1675cababa60ep-2,  0x1.4618bc21c5ec2p-2};
  if (!(x > 0.0 && x < (double)INFINITY))
    return x == 0.0 ? -(double)INFINITY : x > 0.0 ? x : (double)NAN;
  /* x = 2^power m, 22.5/32 <= m < 22.5/16; without a branch, as nothing predicts it */
  const bool tiny = x < 0x1p-1000;
  const double scaled = tiny ? x * 0x1p100 : x;
  int64_t bits = 0;
  memcpy(&bits, &scaled, sizeof bits);
  const int64_t exponent = (bits - 0x3fe6800000000000) >> 52;
  bits -= exponent * (INT64_C(1) << 52);
  double m = 0.0;
  memcpy(&m, &bits, sizeof m);
  const double power = (double)(exponent - (tiny ? 100 : 0));
  /* the rest by the series of 2 atanh; its remainder is below 3e-18 of it */
  const int sixteenths = (int)(16.0 * m + 0.5);
  const double c = sixteenths / 16.0, t = (m - c) / (m + c), t2 = t * t;
  const double series =
      (1.0 + t2 * (1.0 / 3.0)) + t2 * t2 * ((1.0 / 5.0 + t2 * (1.0 / 7.0)) + t2 * t2 * (1.0 / 9.0));
  return power * 0x1.62e42feep-1 +
         (of_sixteenths[sixteenths - 11] + (2.0 * t * series + power * 0x1.a39ef35793c76p-33));
}

double carom_power(double x, double y) {
  /* 2^(k/16) */
  static const double roots[16] = {
      0x1.0000000000000p+0, 0x1.0b5586cf9890fp+0, 0x1.172b83c7d517bp+0, 0x1.2387a6e756238p+0,
      0x1.306fe0a31b715p+0, 0x1.3dea64c123422p+0, 0x1.4bfdad5362a27p+0, 0x1.5ab07dd485429p+0,
      0x1.6a09e667f3bcdp+0, 0x1.7a11473eb0187p+0, 0x1.8ace5422aa0dbp+0, 0x1.9c49182a3f090p+0,
      0x1.ae89f995ad3adp+0, 0x1.c199bdd85529cp+0, 0x1.d5818dcfba487p+0, 0x1.ea4afa2a490dap+0};
  const double e = y * carom_log(x);
  if (!(fabs(e) < 700.0))
    return isnan(e) ? e : e > 0.0 ? (double)INFINITY : 0.0;
  /* e = k log(2)/16 + r; k is rounded by a number whose last place is 1 */
  const double k = (e * 0x1.71547652b82fep+4 + 0x1.8p52) - 0x1.8p52;
  /* r^8/8! < 2e-18 */
  const double r = (e - k * 0x1.62e42feep-5) - k * 0x1.a39ef35793c76p-37, r2 = r * r;
  const double series =
      (1.0 + r) +
      r2 * ((1.0 / 2.0 + r * (1.0 / 6.0)) +
            r2 * ((1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * (1.0 / 720.0 + r * (1.0 / 5040.0))));
  const int64_t sixteenths = (int64_t)k, root = sixteenths & 15,
                bits = ((sixteenths - root) / 16 + 1023) * (INT64_C(1) << 52);
  double whole = 0.0;
  memcpy(&whole, &bits, sizeof whole);
  return whole * (roots[root] * series);
}

/* Sine and cosine of so many quarter turns and x, |x| <= pi/4. */
static void sincos_turned(double turns, double x, double *sine, double *cosine) {
  const double x2 = -x * x;
  double s = inverse_factorial[17], c = inverse_factorial[18]; /* (pi/4)^19/19! < 1e-19 */
  for (int n = 15; n > 0; n -= 2) {
    s = inverse_factorial[n] + s * x2;
    c = inverse_factorial[n + 1] + c * x2;
  }
  s *= x;
  c = 1.0 + c * x2;
  const double quarter = turns - 4.0 * floor(turns / 4.0);
  *sine = quarter == 0.0 ? s : quarter == 1.0 ? c : quarter == 2.0 ? -s : -c;
  *cosine = quarter == 0.0 ? c : quarter == 1.0 ? -s : quarter == 2.0 ? -c : s;
}

void carom_sincos_degrees(double degrees, double *sine, double *cosine) {
  /* quarter turns, exact; the rest is within 45 degrees */
  const double turns = floor(degrees / 90.0 + 0.5);
  sincos_turned(turns, (degrees - 90.0 * turns) * 0x1.1df46a2529d39p-6, sine, cosine);
}

void carom_sincos(double x, double *sine, double *cosine) {
  /* pi/2 in three parts; so many times the first and the second, of 33 digits each, is exact */
  const double turns = floor(x * 0x1.45f306dc9c883p-1 + 0.5);
  sincos_turned(turns,
                ((x - turns * 0x1.921fb544p+0) - turns * 0x1.0b4611a6p-34) -
                    turns * 0x1.3198a2e037073p-69,
                sine, cosine);
}

double carom_atan(double x) {
  /* atan(k/8) */
  static const double at_eighth[9] = {0.0,
                                      0x1.fd5ba9aac2f6ep-4,
                                      0x1.f5b75f92c80ddp-3,
                                      0x1.6f61941e4def1p-2,
                                      0x1.dac670561bb4fp-2,
                                      0x1.1e00babdefeb4p-1,
                                      0x1.4978fa3269ee1p-1,
                                      0x1.700a7c5784634p-1,
                                      0x1.921fb54442d18p-1};
  if (isnan(x))
    return x;
  /* |x| as z in 0 to 1, by eighths and a remainder */
  const double z = fabs(x) > 1.0 ? 1.0 / fabs(x) : fabs(x);
  const int k = (int)(8.0 * z + 0.5);
  const double eighths = 0.125 * k, t = (z - eighths) / (1.0 + z * eighths), t2 = t * t;
  double sum = 1.0 / 13.0; /* t^15/15 < 6e-20 */
  for (int n = 11; n > 0; n -= 2)
    sum = 1.0 / n - sum * t2;
  const double angle = at_eighth[k] + t * sum;
  return copysign(fabs(x) > 1.0 ? 0x1.921fb54442d18p+0 - angle : angle, x);
}

double carom_acos(double x) {
  return 2.0 * carom_atan(sqrt((1.0 - x) / (1.0 + x)));
}

double carom_minmod(double a, double b) {
  if (!(a * b > 0.0))
    return 0.0;
  return fabs(a) < fabs(b) ? a : b;
}
