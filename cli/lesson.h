/* A page to print for a lesson. */
#ifndef CAROM_CLI_LESSON_H
#define CAROM_CLI_LESSON_H

#include "shot_picture.h"

/* shots that have room on the page */
enum { LESSON_MOST = 4 };

/* Draws A4, upright, as SVG: the picture of the shots, their strokes in words and their tips on the
 * ball, `footer`, and lines for notes. */
void lesson_draw(FILE *out, const played *shots, int count, const char *footer);

#endif
