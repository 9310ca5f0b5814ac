/* The time, by the system's clock that nobody sets back. */
#if !defined(_WIN32) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200809L /* clock_gettime */
#endif
#include "platform/clock.h"

#include "platform/arithmetic.h"

#ifdef _WIN32
#include "platform/win32.h"

double carom_seconds(void) {
  int64_t current, each_second;
  QueryPerformanceCounter(&current);
  QueryPerformanceFrequency(&each_second);
  return (double)current / (double)each_second;
}

#else
#include <time.h>

double carom_seconds(void) {
  struct timespec current;
  clock_gettime(CLOCK_MONOTONIC, &current);
  return (double)current.tv_sec + 1e-9 * (double)current.tv_nsec;
}

#endif
