/* Two clocks: the monotonic one in nanoseconds, which counts, and the processor's time stamp counter, which ticks at a fixed
 * rate whatever the core's frequency: its ticks are reference cycles, not core cycles. */
#ifndef CAROM_BENCH_CLOCK_H
#define CAROM_BENCH_CLOCK_H

#include "monotonic.h" /* clock_ns(), the first of them */

#include <stdbool.h>
#include <stdint.h>

/* Does this processor have a counter that ticks evenly? */
bool clock_has_ticks(void);

/* The counter, fenced: what stands before has ended, what stands behind has not begun. 0 where there is none. */
uint64_t clock_ticks(void);

/* Ticks per nanosecond, measured against the monotonic clock over about 50 ms at the first call; NAN where there is no counter.
 */
double clock_ticks_per_ns(void);

/* What the counter is, in a few words, or why there is none. */
const char *clock_ticks_text(void);

#endif
