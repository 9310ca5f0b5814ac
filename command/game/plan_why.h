/* Why a shot of a plan, in words that a player can aim by. */
#ifndef CAROM_CLI_PLAN_WHY_H
#define CAROM_CLI_PLAN_WHY_H

#include "shots/shot_file.h"

#include "carom_plan.h"

/* Tells how to strike a choice, what it leaves, what a miss leaves, and what the errors of the
 * player cost. `job` is that of the plan, whose memory is used again. */
void plan_tell_why(FILE *out, const carom_plan_job *job, const shot_line *line,
                   const carom_plan_stroke *choice);

#endif
