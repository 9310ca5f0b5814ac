/* Messages to the user on stderr. */
#include "message.h"

#include "command.h"
#include "progress.h"

#include <stdarg.h>
#include <stdio.h>

void complain(const char *format, ...) {
  flockfile(stderr); /* the reading thread complains too */
  progress_clear();
  va_list arguments;
  va_start(arguments, format);
  fputs("carom: ", stderr);
  vfprintf(stderr, format, arguments);
  fputc('\n', stderr);
  va_end(arguments);
  funlockfile(stderr);
}

int usage_hint(const char *command) {
  fprintf(stderr, "`carom %s --help` tells the arguments\n", command);
  return EXIT_USAGE;
}
