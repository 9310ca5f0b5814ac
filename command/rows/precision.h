/* Rows of doubles as rows of floats, and back. */
#ifndef CAROM_CLI_PRECISION_H
#define CAROM_CLI_PRECISION_H

#include <stddef.h>

/* `source` is an array of structs that hold nothing but doubles, and `target` has the same structs
 * in float; `numbers` counts the numbers of all of them. */
static inline void to_single(const void *source, void *target, size_t numbers) {
  for (size_t k = 0; k < numbers; k++)
    ((float *)target)[k] = (float)((const double *)source)[k];
}

static inline void to_double(const void *source, void *target, size_t numbers) {
  for (size_t k = 0; k < numbers; k++)
    ((double *)target)[k] = ((const float *)source)[k];
}

#endif
