/* The monotonic clock, for all that takes time. */
#ifndef CAROM_CLI_MONOTONIC_H
#define CAROM_CLI_MONOTONIC_H

#include <time.h>

/* Nanoseconds on it. */
static inline double clock_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

#endif
