/* Two clocks. The time stamp counter is used where the processor says that it is invariant; 64-bit ARM has a counter that
 * always is, though a slow one. */
#include "clock.h"

#include <math.h>

#if defined(__x86_64__)
#include <cpuid.h>
#include <x86intrin.h>
#endif

#if defined(__x86_64__)

bool clock_has_ticks(void) {
  unsigned a, b, c, d;
  return __get_cpuid(0x80000007u, &a, &b, &c, &d) != 0 && (d & 1u << 8) != 0;
}

uint64_t clock_ticks(void) {
  _mm_lfence();
  const uint64_t ticks = __rdtsc();
  _mm_lfence();
  return ticks;
}

const char *clock_ticks_text(void) {
  return clock_has_ticks() ? "time stamp counter, fenced" : "NA (the time stamp counter of this processor is not invariant)";
}

#elif defined(__aarch64__)

bool clock_has_ticks(void) {
  return true;
}

uint64_t clock_ticks(void) {
  uint64_t ticks;
  __asm__ volatile("isb\n\tmrs %0, cntvct_el0\n\tisb" : "=r"(ticks)::"memory");
  return ticks;
}

const char *clock_ticks_text(void) {
  return "generic timer (cntvct_el0), fenced";
}

#else

bool clock_has_ticks(void) {
  return false;
}

uint64_t clock_ticks(void) {
  return 0;
}

const char *clock_ticks_text(void) {
  return "NA (no time stamp counter is known for this processor)";
}

#endif

double clock_ticks_per_ns(void) {
  static double rate;
  if (!clock_has_ticks())
    return NAN;
  if (rate == 0.0) {
    const double start = clock_ns();
    const uint64_t ticks = clock_ticks();
    double now = start;
    while (now - start < 50e6)
      now = clock_ns();
    rate = (double)(clock_ticks() - ticks) / (now - start);
  }
  return rate;
}
