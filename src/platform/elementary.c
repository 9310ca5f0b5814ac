/* Elementary functions whose bits do not depend on the system's mathematical library. Argument reduction is exact or nearly so,
 * then Taylor's polynomial on a range where its remainder is below rounding. */
#include "platform/elementary.h"

#include <math.h>
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

double carom_exp_negative(double x) {
  if (!(x > -708.0))
    return 0.0;
  /* x = k log 2 + r, |r| <= log(2)/2; log 2 in two parts, of which k times the first is exact */
  const double k = floor(x * 0x1.71547652b82fep+0 + 0.5);
  const double r = (x - k * 0x1.62e42feep-1) - k * 0x1.a39ef35793c76p-33;
  double sum = inverse_factorial[13]; /* r^14/14! < 5e-18 */
  for (int n = 12; n >= 0; n--)
    sum = inverse_factorial[n] + sum * r;
  const int64_t exponent = (int64_t)(k + 1023.0) << 52;
  double scale;
  memcpy(&scale, &exponent, sizeof scale);
  return sum * scale;
}

void carom_sincos_degrees(double degrees, double *sine, double *cosine) {
  /* quarter turns, exact; the rest is within 45 degrees */
  const double turns = floor(degrees / 90.0 + 0.5);
  const double x = (degrees - 90.0 * turns) * 0x1.1df46a2529d39p-6, x2 = -x * x;
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
