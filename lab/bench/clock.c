#include "clock.h"

#include <math.h>

#if defined(__x86_64__)
#define CHAIN ".rept 100\n\tadd %0, %0\n\t.endr"
#elif defined(__aarch64__)
#define CHAIN ".rept 100\n\tadd %0, %0, %0\n\t.endr"
#endif

double clock_core_cycle(void) {
#ifdef CHAIN
  enum { TURNS = 1000, LINKS = 100, ROUNDS = 300 };
  double least = INFINITY;
  unsigned long long value = 1;
  for (int round = 0; round < ROUNDS; round++) {
    const double begin = clock_ns();
    for (int turn = 0; turn < TURNS; turn++)
      __asm__ volatile(CHAIN : "+r"(value));
    least = fmin(least, (clock_ns() - begin) / (TURNS * LINKS));
  }
  return least;
#else
  return NAN;
#endif
}
