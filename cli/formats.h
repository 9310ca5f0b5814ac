/* What files are that were given for something else. */
#ifndef CAROM_CLI_FORMATS_H
#define CAROM_CLI_FORMATS_H

#include <stddef.h>

/* The kind of a file whose beginning shows that it is no text to be read here, with what to do about it: an array of NumPy, an
 * archive, compressed, UTF-16. NULL if it may be. */
const char *other_kind(const char *beginning, size_t size);

#endif
