/* Counters in a build without PAPI: there are none, and the reason says how to get them. */
#include "counters.h"

#include <math.h>

static const char reason[] = "NA: this build has no PAPI; install it (Debian: libpapi-dev) and configure again";

const char *counters_begin(void) {
  return reason;
}

const char *counter_reason(int k) {
  (void)k;
  return reason;
}

void counters_measure(void (*work)(void *), void *context, double value[COUNTER_COUNT]) {
  (void)work;
  (void)context;
  for (int k = 0; k < COUNTER_COUNT; k++)
    value[k] = NAN;
}

void counters_end(void) {
}
