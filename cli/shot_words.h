/* What came of a shot, in words. */
#ifndef CAROM_CLI_SHOT_WORDS_H
#define CAROM_CLI_SHOT_WORDS_H

#include "spread.h"

/* Whether a rail is no cut of a pocket: those are short. */
bool is_cushion(const carom_table *t, int rail);

/* Whether event k is a contact of the ball with a cushion that a player would count: no jaw, no
 * cut of a pocket, and no further hop at the same cushion. */
bool counts_as_rail(const shot_line *line, const carom_shot *shot, int64_t k, int ball);

/* Whether the ball is in any event: the others lie where they lay. */
bool ball_moved(const carom_shot *shot, int ball);

/* Tells it, a line for each ball that moved; with the spread of a player where `s` is not NULL. */
void shot_tell(FILE *out, const shot_line *line, const carom_shot *shot, const spread *s);

#endif
