/* Doubles as text, by printf and strtod alone. */
#include "rows/number.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *number_text(double x, char text[NUMBER_TEXT]) {
  char shorter[NUMBER_TEXT];
  if (isnan(x))
    return strcpy(text, "nan"); /* without a sign */
  /* 16 digits are enough for half of all doubles, 17 for all. */
  int exponent;
  snprintf(text, NUMBER_TEXT, "%.*g", DBL_DIG + 1, x);
  const bool enough = strtod(text, NULL) == x;
  if (!enough)
    snprintf(text, NUMBER_TEXT, "%.*g", DBL_DIG + 2, x);
  /* 15 may be where %g left out no zero at the end of 16, as of 9.3, 9.300000000000001; or at a
   * power of two, whose neighbours are not at the same distance. */
  if ((enough && strlen(text) > DBL_DIG) || frexp(fabs(x), &exponent) == 0.5) {
    snprintf(shorter, sizeof shorter, "%.*g", DBL_DIG, x);
    if (strtod(shorter, NULL) == x)
      strcpy(text, shorter);
  }
  return text;
}

void write_numbers(FILE *out, const double *x, size_t count) {
  char text[NUMBER_TEXT + 1] = ",";
  for (size_t k = 0; k < count; k++) {
    number_text(x[k], text + 1);
    fputs(text, out);
  }
}

const char *comma_hint(const char *text) {
  return strchr(text, ',') != NULL ? "; decimals have a point, not a comma" : "";
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
