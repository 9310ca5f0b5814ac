/* Pictures that gnuplot draws from a CSV by a script of cli/figures. */
#ifndef CAROM_CLI_PICTURE_H
#define CAROM_CLI_PICTURE_H

#include "options.h"

#include <stdio.h>

/* For a `const char *`: a name that ends as a picture's must, in .svg or .png. */
OPTION_SET(set_picture);

/* Draws `path` by NAME.gp from what `write` puts into a CSV. The picture appears whole or not at all. Complains and returns
 * false if it cannot be drawn. */
bool picture_draw(const char *path, const char *name, const char *title, void (*write)(FILE *out, const void *data),
                  const void *data);

#endif
