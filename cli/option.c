/* Values of options that several subcommands take. */
#include "option.h"

#include "message.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>

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
