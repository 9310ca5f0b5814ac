/* One collision from above as a picture: both balls in contact, the line of centres and the tangent line, and their paths. */
#ifndef CAROM_CLI_HIT_PICTURE_H
#define CAROM_CLI_HIT_PICTURE_H

#include "carom.h"

#include <stdbool.h>

/* Draws it as SVG; the texts stand below each other in its corner. Complains and returns false if that fails. */
bool hit_draw(const char *path, const carom_impact *in, const carom_result *out, const char *const *text);

#endif
