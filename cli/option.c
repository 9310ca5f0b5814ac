/* Values of options that several subcommands take. */
#include "option.h"

#include "message.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool option_count(const char *option, const char *text, int least, int *count) {
  char *end;
  errno = 0;
  const long value = strtol(text, &end, 10);
  if (end == text || *end != '\0' || errno != 0 || value < least || value > INT_MAX) {
    complain("%s is a whole number from %d to %d, not '%s'", option, least, INT_MAX, text);
    return false;
  }
  *count = (int)value;
  return true;
}

bool option_steps(const char *text, int *steps) {
  return option_count("--steps", text, 1, steps);
}

bool option_slip(const char *text, carom_slip *slip) {
  for (int k = 0; k < CAROM_SLIP_COUNT; k++)
    if (strcmp(text, carom_slip_name((carom_slip)k)) == 0) {
      *slip = (carom_slip)k;
      return true;
    }
  complain("--slip is paper or pooltool, not '%s'", text);
  return false;
}

bool option_kernel(const char *text, const kernel **one) {
  *one = kernel_find(text);
  if (*one == NULL)
    complain("no kernel '%s'; `carom kernels` lists them", text);
  return *one != NULL;
}

bool option_budget(const char *text, double *seconds) {
  char *end;
  *seconds = strtod(text, &end);
  const bool good = end != text && *end == '\0' && *seconds > 0.0 && *seconds <= 86400.0;
  if (!good)
    complain("--budget is a number of seconds above 0, up to 86400, not '%s'", text);
  return good;
}

bool option_precision(const char *text, bool *single) {
  *single = strcmp(text, "single") == 0;
  if (*single || strcmp(text, "double") == 0)
    return true;
  complain("--precision is double or single, not '%s'", text);
  return false;
}

bool option_law(const char *text, carom_speed_law *law) {
  static const char name[] = "alciatore";
  const size_t size = sizeof name - 1;
  *law = carom_alciatore();
  if (strncmp(text, name, size) == 0) {
    char rest;
    if (text[size] == '\0' ||
        (text[size] == '=' && sscanf(text + size + 1, "%lf,%lf,%lf%c", &law->a, &law->b, &law->c, &rest) == 3))
      return true;
  }
  complain("--friction is alciatore or alciatore=a,b,c (mu = a + b exp(-c |u|)), not '%s'", text);
  return false;
}
