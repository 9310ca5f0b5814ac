/* One collision from above as a picture: both balls in contact, the line of centres and the tangent line, and their paths. */
#ifndef CAROM_CLI_HIT_PICTURE_H
#define CAROM_CLI_HIT_PICTURE_H

#include "carom.h"

#include <stdbool.h>

/* Draws it as SVG, with the lines of the text below it. Complains and returns false if that fails. */
bool hit_draw(const char *path, const carom_impact *in, const carom_result *out, const char *text);

#endif
