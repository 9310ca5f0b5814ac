/* Two clocks: the monotonic one in nanoseconds, which counts, and the core's own, whose cycle is measured. */
#ifndef CAROM_BENCH_CLOCK_H
#define CAROM_BENCH_CLOCK_H

#include "monotonic.h" /* clock_ns(), the first of them */

/* The length of a core cycle just now, in ns: that of an addition in a chain of them, which advances by one cycle each on every
 * processor of interest, whatever its clock. Measured in some 10 ms. NAN where no chain is written for the processor. */
double clock_core_cycle(void);

#endif
