/* The time, for what a caller bounds by seconds. */
#ifndef CAROM_SRC_PLATFORM_CLOCK_H
#define CAROM_SRC_PLATFORM_CLOCK_H

/* Seconds since some moment, by a clock that nobody sets back. */
double carom_seconds(void);

#endif
