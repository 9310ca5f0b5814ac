/* A progress line on a terminal's stderr, for work of more than a second. */
#include "progress.h"

#include <stdbool.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static double started, drawn;
static bool standing;

double seconds_now(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_show(const char *unit, double done, double total) {
  const double now = seconds_now();
  if (started == 0.0)
    started = now;
  if (now - started < 1.0 || now - drawn < 0.1 || !isatty(STDERR_FILENO))
    return;
  flockfile(stderr);
  drawn = now;
  standing = true;
  if (total > 0.0)
    fprintf(stderr, "\r\033[K%.0f %s, %.0f %%", done, unit, 100.0 * done / total);
  else
    fprintf(stderr, "\r\033[K%.0f %s", done, unit);
  fflush(stderr);
  funlockfile(stderr);
}

void progress_clear(void) {
  flockfile(stderr);
  if (standing) {
    standing = false;
    fputs("\r\033[K", stderr);
    fflush(stderr);
  }
  funlockfile(stderr);
}
