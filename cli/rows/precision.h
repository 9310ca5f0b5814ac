/* Rows of doubles as rows of floats, and back. */
#ifndef CAROM_CLI_PRECISION_H
#define CAROM_CLI_PRECISION_H

#include <stddef.h>

/* `from` is an array of structs that hold nothing but doubles, `to` one of the same structs in
 * float; `numbers` counts those of all of them. */
static inline void to_single(const void *from, void *to, size_t numbers) {
  for (size_t k = 0; k < numbers; k++)
    ((float *)to)[k] = (float)((const double *)from)[k];
}

static inline void to_double(const void *from, void *to, size_t numbers) {
  for (size_t k = 0; k < numbers; k++)
    ((double *)to)[k] = ((const float *)from)[k];
}

#endif
