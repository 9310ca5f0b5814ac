/* Elementary functions whose bits do not depend on the system's mathematical library. Argument
 * reduction is exact or nearly so, then Taylor's polynomial on a range where its remainder is
 * below rounding:
 *
 *     exp(x) = 2^k exp(r)                       k the integer nearest to x / log 2, |r| <=
 *                                               log(2)/2
 *     log2(2^k m) = k + log2(c) + log2(1 + r)
 *     c the middle of the 64th part of 1 to 2 that has m: r = (m - c)/c, |r| <= 1/129
 *     2^x = 2^(k/16) 2^r                        k the integer nearest to 16 x, |r| <= 1/32
 *     sin and cos of n pi/2 + r                 n whole, |r| <= pi/4
 *     atan(x) = atan(k/8) + atan(t)
 *     for 0 <= x <= 1: t = (x - k/8) / (1 + x k/8), |t| <= 1/16
 *             = pi/2 - atan(1/x)                for x > 1
 *     acos(x) = 2 atan(sqrt((1 - x) / (1 + x)))
 *
 * core/tests/unit/elementary.c compares them with the functions of the C library in long double. */
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

/* 1/c and log2(c) of the middles c of the 64th parts of 1 to 2. */
static const struct {
  double inverse, log2;
} of_parts[64] = {
    {0x1.fc07f01fc07f0p-1, 0x1.6fe50b6ef0851p-7}, {0x1.f44659e4a4271p-1, 0x1.11cd1d5133413p-5},
    {0x1.ecc07b301ecc0p-1, 0x1.c4dfab90aab5fp-5}, {0x1.e573ac901e574p-1, 0x1.3aa2fdd27f1c3p-4},
    {0x1.de5d6e3f8868ap-1, 0x1.918a16e46335bp-4}, {0x1.d77b654b82c34p-1, 0x1.e72ec117fa5b2p-4},
    {0x1.d0cb58f6ec074p-1, 0x1.1dcd197552b7bp-3}, {0x1.ca4b3055ee191p-1, 0x1.476a9f983f74dp-3},
    {0x1.c3f8f01c3f8f0p-1, 0x1.70742d4ef027fp-3}, {0x1.bdd2b899406f7p-1, 0x1.98edd077e70dfp-3},
    {0x1.b7d6c3dda338bp-1, 0x1.c0db6cdd94deep-3}, {0x1.b2036406c80d9p-1, 0x1.e840be74e6a4dp-3},
    {0x1.ac5701ac5701bp-1, 0x1.0790adbb03009p-2}, {0x1.a6d01a6d01a6dp-1, 0x1.1ac05b291f070p-2},
    {0x1.a16d3f97a4b02p-1, 0x1.2db10fc4d9aafp-2}, {0x1.9c2d14ee4a102p-1, 0x1.406463b1b0449p-2},
    {0x1.970e4f80cb872p-1, 0x1.52dbdfc4c96b3p-2}, {0x1.920fb49d0e229p-1, 0x1.6518fe4677ba7p-2},
    {0x1.8d3018d3018d3p-1, 0x1.771d2ba7efb3cp-2}, {0x1.886e5f0abb04ap-1, 0x1.88e9c72e0b226p-2},
    {0x1.83c977ab2beddp-1, 0x1.9a802391e232fp-2}, {0x1.7f405fd017f40p-1, 0x1.abe18797f1f49p-2},
    {0x1.7ad2208e0ecc3p-1, 0x1.bd0f2e9e79031p-2}, {0x1.767dce434a9b1p-1, 0x1.ce0a4923a587dp-2},
    {0x1.724287f46debcp-1, 0x1.ded3fd442364cp-2}, {0x1.6e1f76b4337c7p-1, 0x1.ef6d67328e220p-2},
    {0x1.6a13cd1537290p-1, 0x1.ffd799a83ff9bp-2}, {0x1.661ec6a5122f9p-1, 0x1.0809cf27f703dp-1},
    {0x1.623fa77016240p-1, 0x1.10113b153c8eap-1}, {0x1.5e75bb8d015e7p-1, 0x1.18028cf72976ap-1},
    {0x1.5ac056b015ac0p-1, 0x1.1fde3d30e8126p-1}, {0x1.571ed3c506b3ap-1, 0x1.27a4c0585cbf8p-1},
    {0x1.5390948f40febp-1, 0x1.2f56875eb3f26p-1}, {0x1.5015015015015p-1, 0x1.36f3ffb6d9162p-1},
    {0x1.4cab88725af6ep-1, 0x1.3e7d9379f7016p-1}, {0x1.49539e3b2d067p-1, 0x1.45f3a98a20739p-1},
    {0x1.460cbc7f5cf9ap-1, 0x1.4d56a5b33cec4p-1}, {0x1.42d6625d51f87p-1, 0x1.54a6e8ca5438ep-1},
    {0x1.3fb013fb013fbp-1, 0x1.5be4d0cb51435p-1}, {0x1.3c995a47babe7p-1, 0x1.6310b8f553048p-1},
    {0x1.3991c2c187f63p-1, 0x1.6a2af9e5a0f0ap-1}, {0x1.3698df3de0748p-1, 0x1.7133e9b156c7cp-1},
    {0x1.33ae45b57bcb2p-1, 0x1.782bdbfdda657p-1}, {0x1.30d190130d190p-1, 0x1.7f1322182cf16p-1},
    {0x1.2e025c04b8097p-1, 0x1.85ea0b0b27b26p-1}, {0x1.2b404ad012b40p-1, 0x1.8cb0e3b4b3bbep-1},
    {0x1.288b01288b013p-1, 0x1.9367f6da0ab2fp-1}, {0x1.25e22708092f1p-1, 0x1.9a0f8d3b0e050p-1},
    {0x1.23456789abcdfp-1, 0x1.a0a7eda4c112dp-1}, {0x1.20b470c67c0d9p-1, 0x1.a7315d02f20c8p-1},
    {0x1.1e2ef3b3fb874p-1, 0x1.adac1e711c833p-1}, {0x1.1bb4a4046ed29p-1, 0x1.b418734a9008cp-1},
    {0x1.19453808ca29cp-1, 0x1.ba769b39e4964p-1}, {0x1.16e0689427379p-1, 0x1.c0c6d447c5dd3p-1},
    {0x1.1485f0e0acd3bp-1, 0x1.c7095ae91e1c7p-1}, {0x1.12358e75d3033p-1, 0x1.cd3e6a0ca8907p-1},
    {0x1.0fef010fef011p-1, 0x1.d3663b27f31d5p-1}, {0x1.0db20a88f4696p-1, 0x1.d9810643d6615p-1},
    {0x1.0b7e6ec259dc8p-1, 0x1.df8f02086af2cp-1}, {0x1.0953f39010954p-1, 0x1.e59063c8822cep-1},
    {0x1.073260a47f7c6p-1, 0x1.eb855f8ca88fbp-1}, {0x1.05197f7d73404p-1, 0x1.f16e281db7630p-1},
    {0x1.03091b51f5e1ap-1, 0x1.f74aef0efafaep-1}, {0x1.0101010101010p-1, 0x1.fd1be4c7f2af9p-1}};

/* log2(x) of a normal number above 0. Neither a branch nor a division. */
static inline double binary_log(double x) {
  static const double
      L[7] = {0x1.71547652b82fep+0,  -0x1.71547652b82fep-1, 0x1.ec709dc3a03fdp-2,
              -0x1.71547652b82fep-2, 0x1.2776c50ef9bfep-2,  -0x1.ec709dc3a03fdp-3,
              0x1.a61762a7aded9p-3}; /* (-1)^(n+1)/(n ln 2); the remainder is below 3e-18 */
  int64_t bits = 0;
  memcpy(&bits, &x, sizeof bits);
  const int64_t part = bits >> 46 & 63, exponent_of_one = INT64_C(1023) << 52;
  /* x = 2^power m, 1 <= m < 2 */
  const int64_t of_m = (bits & ((INT64_C(1) << 52) - 1)) | exponent_of_one,
                of_c = exponent_of_one | part << 46 | INT64_C(1) << 45;
  double m = 0.0, c = 0.0;
  memcpy(&m, &of_m, sizeof m);
  memcpy(&c, &of_c, sizeof c);
  const double power = (double)((bits >> 52) - 1023);
  const double r = (m - c) * of_parts[part].inverse, r2 = r * r;
  const double series =
      (L[0] + r * L[1]) + r2 * ((L[2] + r * L[3]) + r2 * ((L[4] + r * L[5]) + r2 * L[6]));
  return (power + of_parts[part].log2) + r * series;
}

/* 2^x for |x| <= 1000. */
static inline double binary_power(double x) {
  static const double E[7] = {0x1.62e42fefa39efp-1, 0x1.ebfbdff82c58fp-3,  0x1.c6b08d704a0c0p-5,
                              0x1.3b2ab6fba4e77p-7, 0x1.5d87fe78a6731p-10, 0x1.430912f86c787p-13,
                              0x1.ffcbfc588b0c7p-17}; /* ln(2)^n/n!; the remainder is below 2e-18 */
  /* 2^(k/16) */
  static const double roots[16] = {
      0x1.0000000000000p+0, 0x1.0b5586cf9890fp+0, 0x1.172b83c7d517bp+0, 0x1.2387a6e756238p+0,
      0x1.306fe0a31b715p+0, 0x1.3dea64c123422p+0, 0x1.4bfdad5362a27p+0, 0x1.5ab07dd485429p+0,
      0x1.6a09e667f3bcdp+0, 0x1.7a11473eb0187p+0, 0x1.8ace5422aa0dbp+0, 0x1.9c49182a3f090p+0,
      0x1.ae89f995ad3adp+0, 0x1.c199bdd85529cp+0, 0x1.d5818dcfba487p+0, 0x1.ea4afa2a490dap+0};
  /* x = k/16 + r; k is rounded by a number whose last place is 1/16 */
  const double shifted = x + 0x1.8p48, r = x - (shifted - 0x1.8p48), r2 = r * r;
  const double series =
      ((E[0] + r * E[1]) + r2 * (E[2] + r * E[3])) + r2 * r2 * ((E[4] + r * E[5]) + r2 * E[6]);
  uint64_t sixteenths = 0, bits = 0; /* the exponents add up modulo 2^12 */
  memcpy(&sixteenths, &shifted, sizeof sixteenths);
  memcpy(&bits, &roots[sixteenths & 15], sizeof bits);
  bits += sixteenths >> 4 << 52;
  double whole = 0.0;
  memcpy(&whole, &bits, sizeof whole);
  return whole + whole * r * series;
}

/* ln x of a number that is not normal and positive. */
static double log_at_ends(double x) {
  if (x == 0.0)
    return -(double)INFINITY;
  if (!(x > 0.0))
    return (double)NAN;
  return x < 1 ? carom_log(x * 0x1p100) - 100.0 * 0x1.62e42fefa39efp-1 : x;
}

double carom_log(double x) {
  if (!(x >= DBL_MIN && x < (double)INFINITY))
    return log_at_ends(x);
  return 0x1.62e42fefa39efp-1 * binary_log(x);
}

double carom_bend(double x, double q) {
  /* log2 of x^(1/(2 q)), which adds nothing to 1 below -1000 */
  const double power = binary_log(x > 0x1p-1000 ? x : 0x1p-1000) * (0.5 / q);
  return binary_power(-q * binary_log(1.0 + binary_power(power > -1000.0 ? power : -1000.0)));
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
  /* a half turn changes both signs, and a further quarter exchanges the two */
  const double sign = quarter >= 2.0 ? -1.0 : 1.0;
  const bool odd = quarter == 1.0 || quarter == 3.0;
  *sine = sign * (odd ? c : s);
  *cosine = sign * (odd ? -s : c);
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
