/* Shots that play: one HTML file with the balls' poses, the player of player.js, and the
 * picture. */
#ifndef CAROM_CLI_ANIMATION_H
#define CAROM_CLI_ANIMATION_H

#include "pictures/shot_picture.h"

/* For a `const char *`: a name that ends in .html, or in .svg for a picture that moves. */
OPTION_SET(set_animation);
bool is_moving_picture(const char *path);

/* Writes the page, which loads nothing. */
void shots_animate(FILE *out, const played *shots, int count, const char *footer);

#endif
