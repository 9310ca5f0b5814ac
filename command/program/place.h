/* Where files lie that came with carom: found from where the program itself lies, never where it
 * was built. */
#ifndef CAROM_CLI_PLACE_H
#define CAROM_CLI_PLACE_H

#include <limits.h>

/* Writes the path of a folder that came with carom, "data" or "figures": in share/carom of the
 * installation that the program belongs to, or beside the program in a build. Returns `path`. */
const char *place_find(const char *name, char path[PATH_MAX]);

/* The folder of the reference collisions: `chosen_folder` if it is not NULL, else
 * $CAROM_DATA, else the one that came with carom. */
const char *data_folder(const char *chosen_folder);

#endif
