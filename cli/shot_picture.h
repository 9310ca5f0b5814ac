/* A shot as a picture: the table, each ball's path, where the balls began and ended. */
#ifndef CAROM_CLI_SHOT_PICTURE_H
#define CAROM_CLI_SHOT_PICTURE_H

#include "options.h"
#include "shot_file.h"

/* Whether the shot has this id; any has NULL. */
bool shot_has_id(const shot_line *line, const char *id);

/* Draws it as SVG, up to shot->time, when the balls are as in shot->final. */
void shot_draw(FILE *out, const shot_line *line, const carom_shot *shot);

#endif
