/* The colours of balls in pictures, by their names. */
#ifndef CAROM_CLI_BALL_COLOURS_H
#define CAROM_CLI_BALL_COLOURS_H

#include <stdbool.h>

/* Those of pool by number, as bright as a path on green has to be; the first is for the cue ball
 * and others. */
extern const char *const ball_colours[16];

/* The colour that the name of a ball says, or NULL; and that of ball `index` of that name and
 * radius, m: large balls are those of pyramid, white ones and a yellow cue ball. */
const char *named_colour(const char *name);
const char *colour_of(const char *name, int index, double radius);

/* Whether it is one of the striped balls of pool. */
bool is_striped(const char *name, double radius);

#endif
