/* Recordings of matches, one behind the other, as lines that are read and judged. */
#ifndef CAROM_CLI_MATCH_LINES_H
#define CAROM_CLI_MATCH_LINES_H

#include "carom_match.h"

#include <stdbool.h>

/* Reads a line, with which a match or the next one of a set may begin. Complains, with false, of
 * one that is not by the rules. */
bool match_line_read(carom_match *match, const char *path, const char *line, size_t size);

#endif
