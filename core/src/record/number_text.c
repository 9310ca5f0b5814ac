/* A number is a decimal one, or in quotes a hexadecimal one as C has it: 0.25,
 * "0x1.999999999999ap-4".
 *
 * A decimal number m 10^e is read exactly where m <= 2^53 and |e| <= 22: then m and 10^|e| are
 * doubles, and one product or quotient rounds once (W. D. Clinger, "How to read floating point
 * numbers accurately", PLDI 1990). Others are rejected, and written in hexadecimal. */
#include "record/number_text.h"

#include "platform/arithmetic.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { TENS = 23, MANTISSA = 52, BIAS = 1023 };

static const double ten[TENS] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
static const char digits[] = "0123456789abcdef";

/* ---- Writing */

static int write_whole(uint64_t m, char *text) {
  char backwards[CAROM_NUMBER_TEXT];
  int n = 0;
  do
    backwards[n++] = digits[m % 10];
  while ((m /= 10) != 0);
  for (int k = 0; k < n; k++)
    text[k] = backwards[n - 1 - k];
  return n;
}

/* As m / 10^places with at most 15 digits, or returns 0. */
static int write_decimal(double x, char *text) {
  for (int places = 0; places < TENS; places++) {
    const double scaled = x * ten[places];
    if (!(scaled < 1e15))
      return 0;
    const uint64_t m = (uint64_t)(scaled + 0.5);
    if ((double)m / ten[places] != x)
      continue;
    /* "0." and zeros before the digits of m, or the point among them */
    char whole[CAROM_NUMBER_TEXT];
    const int n = write_whole(m, whole);
    if (places == 0) {
      memcpy(text, whole, (size_t)n);
      return n;
    }
    int length = 0;
    if (n <= places)
      text[length++] = '0';
    for (int k = 0; k < n - places; k++)
      text[length++] = whole[k];
    text[length++] = '.';
    for (int k = n - places; k < 0; k++)
      text[length++] = '0';
    for (int k = n - places; k < n; k++)
      if (k >= 0)
        text[length++] = whole[k];
    return length;
  }
  return 0;
}

static int write_hexadecimal(uint64_t bits, char *text) {
  const int biased = (int)(bits >> MANTISSA & 0x7ff), normal = biased != 0;
  int e = biased - BIAS + !normal;
  uint64_t fraction = bits & ((UINT64_C(1) << MANTISSA) - 1);
  int length = 0;
  text[length++] = '"';
  if (bits >> 63 != 0)
    text[length++] = '-';
  text[length++] = '0';
  text[length++] = 'x';
  text[length++] = (char)('0' + normal);
  /* the digits of the fraction without the zeros behind them */
  if (fraction != 0)
    text[length++] = '.';
  for (; fraction != 0; fraction = fraction << 4 & ((UINT64_C(1) << MANTISSA) - 1))
    text[length++] = digits[fraction >> (MANTISSA - 4)];
  text[length++] = 'p';
  text[length] = '+';
  if (e < 0) {
    text[length] = '-';
    e = -e;
  }
  length++;
  length += write_whole((uint64_t)e, text + length);
  text[length++] = '"';
  return length;
}

int carom_number_write(double x, char *text) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  const int sign = (int)(bits >> 63);
  if (sign != 0)
    text[0] = '-';
  const int size = write_decimal(fabs(x), text + sign);
  if (size == 0)
    return write_hexadecimal(bits, text);
  return sign + size;
}

/* ---- Reading */

/* An integer of up to 4 digits with a sign that may be missing; NULL where there is none. */
static const char *read_exponent(const char *text, const char *end, int *e) {
  bool negative = false;
  int n = 0;
  if (text < end && (*text == '-' || *text == '+'))
    negative = *text++ == '-';
  *e = 0;
  for (; text < end && *text >= '0' && *text <= '9' && n < 5; text++, n++)
    *e = 10 * *e + (*text - '0');
  if (negative)
    *e = -*e;
  if (n == 0 || n == 5)
    return NULL;
  return text;
}

static bool is_digit_at(const char *text, const char *end) {
  return text < end && *text >= '0' && *text <= '9';
}

/* The digits behind the point, at most as many as the fraction of a double has; NULL where there is
 * no digit, or one too many. */
static const char *read_fraction(const char *text, const char *end, uint64_t *fraction) {
  int count = 0;
  for (; text < end && *text != '\0'; text++) {
    const char *digit = strchr(digits, *text);
    if (digit == NULL)
      break;
    if (count == MANTISSA / 4)
      return NULL;
    *fraction |= (uint64_t)(digit - digits) << (MANTISSA - 4 - 4 * count);
    count++;
  }
  if (count == 0)
    return NULL;
  return text;
}

/* Whether 2^e (1 + fraction) with `normal`, else 2^e fraction, is in the one form that is written:
 * 1.5 of a normal number, 0.5 of one below these. */
static bool is_written_form(bool normal, int e, uint64_t fraction) {
  if (normal)
    return e >= 1 - BIAS && e <= BIAS;
  return e == 1 - BIAS && fraction != 0;
}

/* What is behind the first quote, to the second one. */
static const char *read_hexadecimal(const char *text, const char *end, double *x) {
  /* The sign, and 0x0 or 0x1. */
  const bool negative = text < end && *text == '-';
  text += negative;
  if (end - text < 3 || text[0] != '0' || text[1] != 'x')
    return NULL;
  if (text[2] != '0' && text[2] != '1')
    return NULL;
  const bool normal = text[2] == '1';
  text += 3;

  /* The fraction, which may be missing with its point. */
  uint64_t fraction = 0;
  if (text < end && *text == '.') {
    text = read_fraction(text + 1, end, &fraction);
    if (text == NULL)
      return NULL;
  }

  /* The exponent of two, which may not be missing. */
  int e;
  if (text == end || *text != 'p')
    return NULL;
  text = read_exponent(text + 1, end, &e);
  if (text == NULL || !is_written_form(normal, e, fraction))
    return NULL;

  /* A double is its sign, its exponent and its fraction, side by side. */
  uint64_t biased = 0;
  if (normal)
    biased = (uint64_t)(e + BIAS);
  const uint64_t bits = (uint64_t)negative << 63 | biased << MANTISSA | fraction;
  memcpy(x, &bits, sizeof *x);
  if (text == end || *text != '"')
    return NULL;
  return text + 1;
}

/* A decimal number without its sign: m 10^e, or not exact where m has too many digits. */
typedef struct decimal {
  uint64_t m;
  int e;
  bool exact;
} decimal;

/* The digits, of which at least one is before the point, and at least one behind it. */
static const char *read_digits(const char *text, const char *end, decimal *d) {
  const uint64_t most = UINT64_C(1) << (MANTISSA + 1);
  bool behind_point = false;
  *d = (decimal){.exact = true};
  for (; text < end; text++) {
    if (*text == '.' && !behind_point && is_digit_at(text + 1, end)) {
      behind_point = true;
      continue;
    }
    if (!is_digit_at(text, end))
      break;

    /* m keeps the digits for as long as it is exact; e counts those behind the point. */
    d->exact = d->exact && d->m <= most / 10 - 1;
    if (d->exact)
      d->m = 10 * d->m + (uint64_t)(*text - '0');
    if (behind_point)
      d->e--;
  }
  return text;
}

static const char *read_decimal(const char *text, const char *end, decimal *d) {
  /* A zero is the only digit before the point. */
  if (!is_digit_at(text, end))
    return NULL;
  if (*text == '0' && is_digit_at(text + 1, end))
    return NULL;
  text = read_digits(text, end, d);

  if (text < end && (*text == 'e' || *text == 'E')) {
    int tens;
    text = read_exponent(text + 1, end, &tens);
    d->e += tens;
  }
  if (d->m == 0)
    d->e = 0;
  return text;
}

const char *carom_number_read(const char *position, const char *end, double *x, const char **why) {
  if (position < end && *position == '"') {
    *why = "is not a hexadecimal number such as \"0x1.8p+1\"";
    return read_hexadecimal(position + 1, end, x);
  }

  *why = "must be a number";
  const bool negative = position < end && *position == '-';
  decimal d;
  position = read_decimal(position + negative, end, &d);
  if (position == NULL)
    return NULL;
  if (!d.exact || d.e <= -TENS || d.e >= TENS) {
    *why = "has more digits than can be read exactly: 15, and 22 places; write it as \"0x1.8p+1\"";
    return NULL;
  }

  /* Both m and the power of ten are exact, so that one division or product rounds once. */
  if (d.e < 0)
    *x = (double)d.m / ten[-d.e];
  else
    *x = (double)d.m * ten[d.e];
  if (negative)
    *x = -*x;
  return position;
}
