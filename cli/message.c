/* What the user sees on stderr. */
#include "message.h"

#include "monotonic.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <unistd.h>

const char random_name[7] = {'X', 'X', 'X', 'X', 'X', 'X', '\0'};

const char *program_name = "carom";
static double started, drawn; /* ns */
static bool standing;

void complain(const char *format, ...) {
  flockfile(stderr); /* the reading thread complains too */
  progress_clear();
  va_list arguments;
  va_start(arguments, format);
  fprintf(stderr, "%s: ", program_name);
  vfprintf(stderr, format, arguments);
  fputc('\n', stderr);
  va_end(arguments);
  funlockfile(stderr);
}

void progress_show(const char *unit, double done, double total) {
  const double now = clock_ns();
  started = started == 0.0 ? now : started;
  if (now - started < 1e9 || now - drawn < 1e8 || !isatty(STDERR_FILENO))
    return;
  flockfile(stderr);
  drawn = now;
  standing = true;
  fprintf(stderr, "\r\033[K%.0f %s", done, unit);
  if (total > 0.0)
    fprintf(stderr, ", %.0f %%", 100.0 * done / total);
  fflush(stderr);
  funlockfile(stderr);
}

void progress_clear(void) {
  flockfile(stderr);
  if (standing)
    fputs("\r\033[K", stderr);
  standing = false;
  funlockfile(stderr);
}
