/* One collision out of a file, for the subcommands that look at it closely. */
#ifndef CAROM_CLI_PICK_H
#define CAROM_CLI_PICK_H

#include "options.h"

#include <stdio.h>

/* Finds the collision asked->id in `file`, "-" for stdin, NULL for the reference collisions in asked->folder, and checks it.
 * Complains and returns false if it is not there, naming what is, if it is in error, or if it is doubtful and asked->strict; of
 * what is doubtful (see doubts.h) it warns in any case. */
bool pick_impact(const shared_options *asked, const char *file, carom_impact *impact);

/* The same for several, in one pass through the file. */
bool pick_impacts(const shared_options *asked, const char *file, const char *const *id, size_t count, carom_impact *impact);

/* Writes what the collision is as lines "# what: text", for those who read the CSV or draw it. */
void pick_describe(FILE *out, const shared_options *asked, const carom_impact *impact);

#endif
