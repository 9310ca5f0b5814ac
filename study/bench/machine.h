/* Where and with what a figure was measured: without that it means nothing. */
#ifndef CAROM_BENCH_MACHINE_H
#define CAROM_BENCH_MACHINE_H

#include <stdio.h>

/* Prints lines "# what: text" about the processor, the system, the build and the time. What a
 * machine does not report is "NA". */
void machine_describe(FILE *out);

/* Prints one such line; line breaks in the text become blanks. */
__attribute__((format(printf, 3, 4))) void machine_note(FILE *out, const char *what,
                                                        const char *format, ...);

/* The length of a core cycle just now, in ns: the time of an addition in a chain of them, which
 * advances by one cycle each on every processor of interest, whatever its clock. Measured in less
 * than a millisecond. NAN where no chain is written for the processor. */
double clock_core_cycle(void);

#endif
