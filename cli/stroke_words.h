/* A stroke in the words of a coach. */
#ifndef CAROM_CLI_STROKE_WORDS_H
#define CAROM_CLI_STROKE_WORDS_H

#include "shot_file.h"

/* The cushions before the first ball, the cut and how much of the ball is hit; false where nothing
 * is met, and nothing is told. */
bool tell_aim(FILE *out, const shot_line *line, const carom_cue *cue, const carom_shot *shot);

/* "at 6 o'clock, 30 % of the way to the edge" */
void tell_tip(FILE *out, const carom_cue *cue);

/* "medium, the ball at 1.4 m/s" */
void tell_speed(FILE *out, const carom_cue *cue, const carom_ball_kind *ball);

#endif
