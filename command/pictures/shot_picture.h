/* Shots as a picture: the table, each ball's path, where the balls began and ended. */
#ifndef CAROM_CLI_SHOT_PICTURE_H
#define CAROM_CLI_SHOT_PICTURE_H

#include "pictures/table_picture.h"
#include "program/options.h"
#include "shots/shot_file.h"
#include "shots/spread.h"

/* A shot and its result. */
typedef struct played {
  const shot_line *line;
  const carom_shot *shot;
  const spread *spread;     /* a player's, with bands; or NULL */
  const carom_shot *others; /* what else may come of it, with all their events, as thin paths; */
  int others_count;         /* as many; or 0 */
  const double (*zone)[2];  /* where the cue ball may end: corners, m, */
  int zone_corners;         /* as many; or 0 */
} played;

/* Whether the shot has this id; any has NULL. */
bool shot_has_id(const shot_line *line, const char *id);

/* Draws a ball at a place of the picture, pixels, with its name where that is a number. Its rim
 * has this colour; NULL: that of its path. */
void draw_disc(const view *v, const shot_line *line, int ball, double x, double y, const char *name,
               const char *rim);

/* The size of letters on a picture of a table, pixels. */
double picture_letters(const view *v);

/* Draws shots of one table and layout over each other as SVG, each up to shot->time, when the
 * balls are as in shot->final. `footer` has lines to stand below. Each ball at its end is a
 * group of class "ball"; those that do not move are drawn once. */
void shots_draw(FILE *out, const played *shots, int count, const char *footer);

#endif
