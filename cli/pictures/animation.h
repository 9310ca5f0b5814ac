/* Shots that play: one HTML file with the balls' poses, the player of player.js, and the
 * picture. */
#ifndef CAROM_CLI_ANIMATION_H
#define CAROM_CLI_ANIMATION_H

#include "pictures/shot_picture.h"

/* For a `const char *`: a name that ends in .html. */
OPTION_SET(set_animation);

/* Writes the page, which loads nothing. */
void shots_animate(FILE *out, const played *shots, int count, const char *footer);

#endif
