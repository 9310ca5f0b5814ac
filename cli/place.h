/* Where files lie that came with carom: in the source tree beside a build, else in the install the command belongs to. */
#ifndef CAROM_CLI_PLACE_H
#define CAROM_CLI_PLACE_H

#include <limits.h>

/* Writes the folder: `source` if it is there, else `installed`, which is relative to the prefix. Returns `path`. */
const char *place_find(const char *source, const char *installed, char path[PATH_MAX]);

#endif
