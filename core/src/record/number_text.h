/* Doubles as text, exactly, by operations that have the same bits everywhere: no function of a C
 * library, whose point may be a comma. */
#ifndef CAROM_SRC_RECORD_NUMBER_TEXT_H
#define CAROM_SRC_RECORD_NUMBER_TEXT_H

#include <stdbool.h>

/* Room for any number. */
enum { CAROM_NUMBER_TEXT = 32 };

/* Writes a finite double without a closing 0; returns the length. */
int carom_number_write(double x, char *text);

/* Reads a number that begins at `position` and ends before `end`; returns where it stops, or NULL
 * if there is no number that can be read exactly, with the reason in *why. */
const char *carom_number_read(const char *position, const char *end, double *x, const char **why);

#endif
