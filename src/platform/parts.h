/* Rows shared out over threads. See parts.c. */
#ifndef CAROM_SRC_PLATFORM_PARTS_H
#define CAROM_SRC_PLATFORM_PARTS_H

#include <stddef.h>

/* Does the rows from `first` to before `end`; returns the first that is in error, or `end`. */
typedef size_t carom_part(const void *context, size_t first, size_t end);

/* Does n rows in up to `threads` threads (0 or 1: the calling one; negative: one for each processor), each with at least
 * `least` rows. Returns the first row in error, or n. */
size_t carom_in_parts(size_t n, size_t least, int threads, carom_part *part, const void *context);

#endif
