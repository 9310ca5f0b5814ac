/* Doubles as text that reads back to the same double. */
#ifndef CAROM_CLI_NUMBER_H
#define CAROM_CLI_NUMBER_H

#include <stdbool.h>
#include <stdio.h>

/* Room for any number and its NUL. */
enum { NUMBER_TEXT = 32 };

/* Writes x by printf's %g with the fewest of 15, 16 and 17 significant digits that strtod()
 * reads as the same double: "0.1", "-29.073183936672191", "1e+22", "-0", "nan", "inf". Returns
 * `text`. */
const char *number_text(double x, char text[NUMBER_TEXT]);

/* The same for some numbers, each behind a comma, on a stream. */
void write_numbers(FILE *out, const double *x, size_t count);

/* Reads a whole field as a number: decimal or hexadecimal, nan, inf or infinity in any case,
 * blanks around it allowed. False if it is anything else. */
bool parse_number(const char *text, double *number);

/* What a message adds about a text that is no number: where it has a comma, that decimals have a
 * point. */
const char *comma_hint(const char *text);

#endif
