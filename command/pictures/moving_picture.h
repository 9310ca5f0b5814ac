/* A shot that plays in a picture. */
#ifndef CAROM_CLI_MOVING_PICTURE_H
#define CAROM_CLI_MOVING_PICTURE_H

#include "pictures/shot_picture.h"

/* Writes a shot as an SVG whose balls move, over and over. */
void shot_move(FILE *out, const played *p);

#endif
