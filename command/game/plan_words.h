/* What a stroke of a plan does, and how it is played, in words. */
#ifndef CAROM_CLI_PLAN_WORDS_H
#define CAROM_CLI_PLAN_WORDS_H

#include "shots/shot_file.h"

#include "carom_plan.h"

enum { PLAN_TEXT = 200 };

/* What a choice does, by the names of the file. */
void plan_describe(const shot_line *line, const carom_plan_stroke *c, char text[PLAN_TEXT]);

/* Its stroke, behind the place of a cue ball in hand. */
void plan_tell_stroke(FILE *out, const carom_plan_stroke *c, bool hand);

#endif
