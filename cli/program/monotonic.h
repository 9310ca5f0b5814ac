/* Clocks: the monotonic one, for all that takes time, and the processor's. */
#ifndef CAROM_CLI_MONOTONIC_H
#define CAROM_CLI_MONOTONIC_H

#include <time.h>

/* Nanoseconds. */
static inline double ns_of(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}
static inline double clock_ns(void) {
  return ns_of(CLOCK_MONOTONIC);
}
static inline double processor_ns(void) {
  return ns_of(CLOCK_PROCESS_CPUTIME_ID);
}

#endif
