/* Clocks: the monotonic one, for all that takes time, and the processor's, of all threads or of
 * the caller's. */
#ifndef CAROM_CLI_MONOTONIC_H
#define CAROM_CLI_MONOTONIC_H

#include <time.h>

/* Nanoseconds. */
static inline double ns_of(clockid_t clock) {
  struct timespec reading;
  clock_gettime(clock, &reading);
  return 1e9 * (double)reading.tv_sec + (double)reading.tv_nsec;
}
static inline double clock_ns(void) {
  return ns_of(CLOCK_MONOTONIC);
}
static inline double processor_ns(void) {
  return ns_of(CLOCK_PROCESS_CPUTIME_ID);
}
static inline double thread_ns(void) {
  return ns_of(CLOCK_THREAD_CPUTIME_ID);
}

#endif
