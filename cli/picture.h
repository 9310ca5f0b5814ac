/* Pictures that gnuplot draws from a CSV by a script of lab/figures, for subcommands other than report. */
#ifndef CAROM_CLI_PICTURE_H
#define CAROM_CLI_PICTURE_H

#include <stdbool.h>
#include <stdio.h>

/* Whether the name ends as a picture must, .svg or .png; complains if not. */
bool picture_name_fits(const char *path);

/* Draws `path` by NAME.gp from what `write` puts into a CSV. The picture appears whole or not at all. Complains and returns
 * false if it cannot be drawn. */
bool picture_draw(const char *path, const char *name, const char *title, void (*write)(FILE *out, const void *data),
                  const void *data);

#endif
