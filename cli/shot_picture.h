/* A shot as a picture: the table, each ball's path, where the balls began and ended. */
#ifndef CAROM_CLI_SHOT_PICTURE_H
#define CAROM_CLI_SHOT_PICTURE_H

#include "options.h"
#include "shot_file.h"

/* For a `const char *`: a name that ends in .svg. */
OPTION_SET(set_svg);

/* Whether the shot has this id; any has NULL. */
bool shot_has_id(const shot_line *line, const char *id);

/* A line to be marked, dashed, with a label at its end or NULL; a dot where it has no length. Places on the table, m. */
typedef struct shot_mark {
  double from[2], to[2];
  const char *label;
} shot_mark;

/* A part of the cloth to be drawn instead of the table, with marks, and lines of text below it, each with its end. */
typedef struct shot_extra {
  double low[2], high[2]; /* m */
  const shot_mark *mark;
  int marks;
  const char *text;
} shot_extra;

/* Draws it as SVG, up to shot->time, when the balls are as in shot->final. `extra` may be NULL. */
void shot_draw(FILE *out, const shot_line *line, const carom_shot *shot, const shot_extra *extra);

#endif
