/* Why a shot of a plan, in words that a player can aim by. */
#ifndef CAROM_CLI_PLAN_WHY_H
#define CAROM_CLI_PLAN_WHY_H

#include "shots/shot_file.h"

#include "carom_plan.h"

enum { WHY_STROKES = 300 }; /* that are played with errors for what is told of each shot */

static const double PLAN_LUCK = 0.1; /* a chance to play on below which balls fall by luck */

/* Whether a choice names a ball that more than luck makes fall. */
bool plan_names_ball(const carom_plan_stroke *choice);

/* Plays a choice so often with the errors of the player, and gives it these chances. Which ball
 * falls stays as the plan has it. */
void plan_play_again(const carom_plan_job *job, carom_plan_stroke *choice);

/* Tells how to strike a choice, what it leaves, what a miss leaves, and what the errors of the
 * player cost. `job` is that of the plan, of which balls, rules and player count. */
void plan_tell_why(FILE *out, const carom_plan_job *job, const shot_line *line,
                   const carom_plan_stroke *choice);

#endif
