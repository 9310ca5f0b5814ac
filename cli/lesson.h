/* A page to print for a lesson. */
#ifndef CAROM_CLI_LESSON_H
#define CAROM_CLI_LESSON_H

#include "shot_picture.h"

/* Draws A4, upright, as SVG: the picture of the shots, the stroke of the first one in words and its
 * tip on the ball, `footer`, and lines for notes. */
void lesson_draw(FILE *out, const played *shots, int count, const char *footer);

#endif
