/* Some rows out of a file, for the subcommands that look at them closely. */
#ifndef CAROM_CLI_PICK_H
#define CAROM_CLI_PICK_H

#include "kind.h"

/* Finds the rows of these ids in `file`, "-" for stdin, NULL for the reference collisions in
 * asked->folder, in one pass, and checks them. Complains and returns false if one is not there,
 * naming what is, if it is in error, or if it is doubtful and asked->strict; of what is doubtful
 * (see doubts.h) it warns in any case. */
bool pick_rows(const shared_options *asked, const char *file, const char *const *id, size_t count,
               double (*row)[MOST_NUMBERS]);

#endif
