/* Values of options that several subcommands take. */
#include "option.h"

#include "message.h"

#include <errno.h>
#include <stdlib.h>

bool option_steps(const char *text, int *steps) {
  char *end;
  errno = 0;
  const long value = strtol(text, &end, 10);
  if (end == text || *end != '\0' || errno != 0 || value < 1 || value > 2147483647) {
    complain("--steps is a whole number from 1 to 2147483647, not '%s'", text);
    return false;
  }
  *steps = (int)value;
  return true;
}
