/* Doubles as text.
 *
 * 17 significant digits always read back; 15 do so for whatever was a decimal of up to 15 digits and is no subnormal number. Of
 * the decimals with n digits the one nearest to x reads back if any does, since it lies within half a unit in the last place of
 * x. Only at a power of two, where doubles below are twice as dense as above, may the nearest lie outside below while its
 * neighbour above lies inside.
 *
 * Printing and reading are slow, so most digits are found by arithmetic. With k such that x 10^k has n digits before its point,
 * let i be the nearest whole number; then n digits are enough if |i - x 10^k| < 1/2 ulp(x) 10^k. For 0 <= k <= 22 the power of
 * ten is a double and the product exact as the sum of two (fma). What then is left uncertain is the rounding of the comparison:
 * such cases, powers of two, and all other numbers are tried by printing and reading.
 */
#include "number.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double tens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* d.ddd 10^exponent */
typedef struct decimal {
  char digits[NUMBER_TEXT];
  int count, exponent;
} decimal;

static void set_digits(decimal *d, uint64_t whole, int count, int exponent) {
  d->count = count;
  d->exponent = exponent;
  for (int k = count - 1; k >= 0; k--, whole /= 10)
    d->digits[k] = (char)('0' + whole % 10);
}

/* The nearest decimal of `count` digits to x > 0, and whether it certainly reads back: 1 yes, 0 no, -1 unknown, and then there
 * is none. */
static int nearest(double x, int count, int exponent, decimal *d) {
  const int k = count - 1 - exponent;
  int binary;
  /* Only what the arithmetic is exact for. */
  if (k < 0 || k > 22 || frexp(x, &binary) == 0.5)
    return -1;
  /* x 10^k = high + low; half a unit in the last place of x, likewise times 10^k. */
  const double high = x * tens[k], low = fma(x, tens[k], -high), half = ldexp(tens[k], binary - DBL_MANT_DIG - 1);
  /* The nearest whole number, in two parts, since it may be above 2^53; a logarithm that was off by one shows in its size. */
  const double rounded = nearbyint(high), more = nearbyint(high - rounded + low);
  const double whole = rounded + more, distance = fabs(high - rounded + low - more);
  if (high < tens[count - 1] || whole >= tens[count])
    return -1;
  set_digits(d, (uint64_t)rounded + (uint64_t)(int64_t)more, count, exponent);
  return count == 17 || distance < half * (1.0 - 1e-9) ? 1 : distance > half * (1.0 + 1e-9) ? 0 : -1;
}

static bool by_arithmetic(double x, decimal *d) {
  const int exponent = (int)floor(log10(x));
  decimal fewer;
  int good = nearest(x, 16, exponent, d);
  if (good == 0)
    return nearest(x, 17, exponent, d) == 1;
  if (good == 1 && (good = nearest(x, 15, exponent, &fewer)) == 1)
    *d = fewer;
  return good >= 0;
}

static bool reads_back(const decimal *d, double x) {
  char text[2 * NUMBER_TEXT];
  snprintf(text, sizeof text, "%.*se%d", d->count, d->digits, d->exponent - d->count + 1);
  return strtod(text, NULL) == x;
}

static void by_trial(double x, decimal *d) {
  bool good = false;
  int binary;
  for (int count = x < DBL_MIN ? 1 : 15; !good; count++) {
    char text[NUMBER_TEXT];
    snprintf(text, sizeof text, "%.*e", count - 1, x);
    const uint64_t whole =
        strtoull(text, NULL, 10) * (uint64_t)tens[count - 1] + (count > 1 ? strtoull(text + 2, NULL, 10) : 0);
    const int exponent = atoi(strchr(text, 'e') + 1);
    set_digits(d, whole, count, exponent);
    good = count == 17 || reads_back(d, x);
    if (!good && count == 16 && frexp(x, &binary) == 0.5) {
      set_digits(d, whole + 1, count, exponent);
      good = reads_back(d, x);
    }
  }
}

/* In the notation of %g with 16 digits. */
static void lay_out(decimal *d, char *to) {
  while (d->count > 1 && d->digits[d->count - 1] == '0')
    d->count--;
  const int e = d->exponent, whole = e < -4 || e >= 16 ? 1 : e + 1; /* digits before the point */
  if (whole <= 0) {
    memcpy(to, "0.000", (size_t)(2 - whole));
    to += 2 - whole;
  }
  for (int k = 0; k < d->count || k < whole; k++) {
    if (k == whole && whole > 0)
      *to++ = '.';
    *to++ = k < d->count ? d->digits[k] : '0';
  }
  *to = '\0';
  if (e < -4 || e >= 16)
    snprintf(to, 8, "e%+03d", e);
}

const char *number_text(double x, char text[NUMBER_TEXT]) {
  decimal d;
  if (x == 0.0 || isnan(x) || isinf(x)) {
    snprintf(text, NUMBER_TEXT, "%g", isnan(x) ? (double)NAN : x);
    return text;
  }
  if (!by_arithmetic(fabs(x), &d))
    by_trial(fabs(x), &d);
  text[0] = '-';
  lay_out(&d, text + (x < 0.0));
  return text;
}

void write_numbers(FILE *out, const double *x, size_t count) {
  char text[NUMBER_TEXT + 1] = ",";
  for (size_t k = 0; k < count; k++) {
    number_text(x[k], text + 1);
    fputs(text, out);
  }
}

bool parse_number(const char *text, double *number) {
  char *end;
  *number = strtod(text, &end);
  if (end == text)
    return false;
  while (isspace((unsigned char)*end))
    end++;
  return *end == '\0';
}
