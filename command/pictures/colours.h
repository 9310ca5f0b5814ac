/* The colours of pictures: those of balls by their names, and those of tables, from palette.h. */
#ifndef CAROM_CLI_COLOURS_H
#define CAROM_CLI_COLOURS_H

#include "carom_shot.h"

#include <stdbool.h>

/* A ball has the colour that players know it by. Its path and its outline have another, which is
 * bright enough on every cloth and is told from those of the others without colour vision too. */
typedef struct ball_look {
  const char *colour, *path, *ink; /* of the disc, of the path, and of the number on the disc */
} ball_look;

/* That of ball `index` of this name and radius, m: large balls are those of pyramid, white ones and
 * a yellow cue ball. */
ball_look look_of(const char *name, int index, double radius);

/* The colour of shot k of several that are drawn over each other, and of ball k of one impact. */
const char *line_colour(int k);

/* Whether the name of a ball is a colour, so that its disc says it. */
bool is_colour(const char *name);

/* Whether it is one of the striped balls of pool. */
bool is_striped(const char *name, double radius);

/* The colours of a table, by what is played on it. */
typedef struct table_colours {
  const char *cloth, *cushion, *wood;
} table_colours;

extern const table_colours pool_colours, snooker_colours, carom_colours;
table_colours colours_of(const carom_table *t);

#endif
