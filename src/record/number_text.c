/* A number is a decimal one, or in quotes a hexadecimal one as C has it: 0.25,
 * "0x1.999999999999ap-4".
 *
 * A decimal number m 10^e is read exactly where m <= 2^53 and |e| <= 22: then m and 10^|e| are
 * doubles, and one product or quotient rounds once (W. D. Clinger, "How to read floating point
 * numbers accurately", PLDI 1990). Others are refused, and written in hexadecimal. */
#include "record/number_text.h"

#include "platform/arithmetic.h"

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
    int at = 0;
    for (int k = 0; k < n - places || k == 0; k++)
      text[at++] = n > places ? whole[k] : '0';
    text[at++] = '.';
    for (int k = n - places; k < n; k++)
      text[at++] = k < 0 ? '0' : whole[k];
    return at;
  }
  return 0;
}

static int write_hexadecimal(uint64_t bits, char *text) {
  const int biased = (int)(bits >> MANTISSA & 0x7ff), e = biased == 0 ? 1 - BIAS : biased - BIAS;
  uint64_t fraction = bits & ((UINT64_C(1) << MANTISSA) - 1);
  int at = 0;
  text[at++] = '"';
  if (bits >> 63 != 0)
    text[at++] = '-';
  text[at++] = '0';
  text[at++] = 'x';
  text[at++] = biased == 0 ? '0' : '1';
  /* the digits of the fraction without the zeros behind them */
  if (fraction != 0)
    text[at++] = '.';
  for (; fraction != 0; fraction = fraction << 4 & ((UINT64_C(1) << MANTISSA) - 1))
    text[at++] = digits[fraction >> (MANTISSA - 4)];
  text[at++] = 'p';
  text[at++] = e < 0 ? '-' : '+';
  at += write_whole((uint64_t)(e < 0 ? -e : e), text + at);
  text[at++] = '"';
  return at;
}

int carom_number_write(double x, char *text) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  const int sign = (int)(bits >> 63);
  if (sign != 0)
    text[0] = '-';
  const int size = write_decimal(sign != 0 ? -x : x, text + sign);
  return size > 0 ? sign + size : write_hexadecimal(bits, text);
}

/* ---- Reading */

/* A whole number of up to 4 digits with a sign that may be missing; NULL where there is none. */
static const char *read_exponent(const char *at, const char *end, int *e) {
  bool negative = false;
  int n = 0;
  if (at < end && (*at == '-' || *at == '+'))
    negative = *at++ == '-';
  *e = 0;
  for (; at < end && *at >= '0' && *at <= '9' && n < 5; at++, n++)
    *e = 10 * *e + (*at - '0');
  if (negative)
    *e = -*e;
  return n == 0 || n == 5 ? NULL : at;
}

static const char *read_hexadecimal(const char *at, const char *end, double *x) {
  const bool negative = at < end && *at == '-';
  at += negative;
  if (end - at < 3 || at[0] != '0' || at[1] != 'x' || (at[2] != '0' && at[2] != '1'))
    return NULL;
  const bool normal = at[2] == '1';
  at += 3;
  uint64_t fraction = 0;
  if (at < end && *at == '.') {
    const char *digit;
    int n = 0;
    for (at++; at < end && *at != '\0' && (digit = strchr(digits, *at)) != NULL; at++, n++) {
      if (n == MANTISSA / 4)
        return NULL;
      fraction |= (uint64_t)(digit - digits) << (MANTISSA - 4 - 4 * n);
    }
    if (n == 0)
      return NULL;
  }
  int e;
  if (at == end || *at++ != 'p' || (at = read_exponent(at, end, &e)) == NULL)
    return NULL;
  /* only the form that is written: 1.5 of a normal number, 0.5 of one below these */
  if (normal ? e < 1 - BIAS || e > BIAS : e != 1 - BIAS || fraction == 0)
    return NULL;
  const uint64_t bits =
      (uint64_t)negative << 63 | (uint64_t)(normal ? e + BIAS : 0) << MANTISSA | fraction;
  memcpy(x, &bits, sizeof *x);
  return at < end && *at == '"' ? at + 1 : NULL;
}

const char *carom_number_read(const char *at, const char *end, double *x, const char **why) {
  if (at < end && *at == '"') {
    *why = "is no hexadecimal number such as \"0x1.8p+1\"";
    return read_hexadecimal(at + 1, end, x);
  }
  *why = "must be a number";

  /* a sign, and a digit that no other follows a zero */
  const bool negative = at < end && *at == '-';
  at += negative;
  if (at == end || *at < '0' || *at > '9' ||
      (end - at > 1 && *at == '0' && at[1] >= '0' && at[1] <= '9'))
    return NULL;

  /* m of all digits, e of those behind the point */
  const uint64_t most = UINT64_C(1) << (MANTISSA + 1);
  uint64_t m = 0;
  int e = 0, tens = 0;
  bool behind = false, exact = true;
  for (; at < end; at++) {
    if (*at == '.' && !behind && end - at > 1 && at[1] >= '0' && at[1] <= '9') {
      behind = true;
      continue;
    }
    if (*at < '0' || *at > '9')
      break;
    exact = exact && m <= most / 10 - 1;
    m = exact ? 10 * m + (uint64_t)(*at - '0') : m;
    e -= behind;
  }

  /* the power of ten; both parts exact, so that one division or product rounds once */
  if (at < end && (*at == 'e' || *at == 'E') && (at = read_exponent(at + 1, end, &tens)) == NULL)
    return NULL;
  e += tens;
  if (m == 0)
    e = 0;
  if (!exact || e <= -TENS || e >= TENS) {
    *why = "has more digits than can be read exactly: 15, and 22 places; write it as \"0x1.8p+1\"";
    return NULL;
  }

  const double size = e < 0 ? (double)m / ten[-e] : (double)m * ten[e];
  *x = negative ? -size : size;
  return at;
}
