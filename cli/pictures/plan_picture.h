/* The best shot of a plan as a picture. */
#ifndef CAROM_CLI_PLAN_PICTURE_H
#define CAROM_CLI_PLAN_PICTURE_H

#include "shots/shot_file.h"

#include "carom_plan.h"

/* What a plan was made for, and its best. */
typedef struct planned {
  carom_player player;
  carom_plan_rules rules;
  carom_plan_stroke best;
} planned;

/* Draws it, with `what` it is; its stroke becomes the line's. False after a complaint. */
bool plan_draw(const char *path, shot_line *line, const planned *p, uint64_t seed,
               const char *what);

#endif
