/* Doubles as text, by printf and strtod alone. */
#include "number.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *number_text(double x, char text[NUMBER_TEXT]) {
  int digits = DBL_DIG - 1;
  if (isnan(x))
    return strcpy(text, "nan"); /* without a sign */
  /* DBL_DIG digits keep what was a decimal of so many, and two more keep any double. */
  do
    snprintf(text, NUMBER_TEXT, "%.*g", ++digits, x);
  while (digits < DBL_DIG + 2 && strtod(text, NULL) != x);
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
