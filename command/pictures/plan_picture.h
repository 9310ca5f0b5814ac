/* The best shot of a plan, and a run-out, as a picture. */
#ifndef CAROM_CLI_PLAN_PICTURE_H
#define CAROM_CLI_PLAN_PICTURE_H

#include "shots/shot_file.h"

#include "carom_coach.h"

/* What a plan was made for, and its best. */
typedef struct planned {
  carom_player player;
  carom_plan_rules rules;
  carom_plan_stroke best;
} planned;

/* Draws it, with `what` it is; its stroke becomes the line's. False after a complaint. */
bool plan_draw(const char *path, shot_line *line, const planned *p, uint64_t seed,
               const char *what);

/* Draws the strokes of a run-out without errors over each other, each from its own layout, with
 * their landing zones. False after a complaint. */
bool sequence_draw(const char *path, shot_line *layouts, const carom_sequence_stroke *strokes,
                   int n);

#endif
