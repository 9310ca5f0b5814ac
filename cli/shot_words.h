/* What came of a shot, in words. */
#ifndef CAROM_CLI_SHOT_WORDS_H
#define CAROM_CLI_SHOT_WORDS_H

#include "spread.h"

/* Tells what each ball does that moved: its moments, or in a line where `shortly` is set; with the
 * spread of a player where `s` is not NULL. */
void shot_tell(FILE *out, const shot_line *line, const carom_shot *shot, const spread *s,
               bool shortly);

#endif
