/* The fingerprint of a module's file: what was timed is what was counted if both are the same. */
#ifndef CAROM_LADDER_FINGERPRINT_H
#define CAROM_LADDER_FINGERPRINT_H

#include <stdbool.h>

enum { FINGERPRINT_SIZE = 17 };

/* FNV-1a with 64 bits of all bytes of the file, as 16 hexadecimal digits; false if it cannot be
 * read. */
bool file_fingerprint(const char *path, char text[FINGERPRINT_SIZE]);

#endif
