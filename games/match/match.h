/* What match.c and match_read.c share. */
#ifndef CAROM_PLAN_MATCH_H
#define CAROM_PLAN_MATCH_H

#include "carom_match.h"

/* Rejects an act: fault[] becomes its name and what would be right. */
carom_status carom_match_refuse(carom_match *match, carom_refusal why, const char *act,
                                const char *right);

/* The ball that the player at the table strikes: in three-cushion each has his own. */
int carom_match_cue_ball(const carom_match *match);

/* opponent.c: weighs a judged stroke, before the ruling is adopted: what it shows about the errors
 * of its seat. */
void carom_match_weigh(carom_match *match);

/* Reads from the record and the state what follows: the cue ball, the balls on, the phase. */
void carom_match_look(carom_match *match);

#endif
