/* Rows from a file, resolved, to a file: what the subcommands `resolve` share, whoever solves. */
#ifndef CAROM_CLI_RESOLVING_H
#define CAROM_CLI_RESOLVING_H

#include "options.h"

#include <stdint.h>

/* Resolves n collisions as carom_collide_batch() does, with `options` and what else stands in
 * `context`; where `single` is set the rows are in float. */
typedef void row_solver(const void *context, const carom_options *options, bool single,
                        const void *in, size_t n, void *out, int8_t *status);

typedef struct resolving {
  shared_options shared; /* the precision is that of the source where it is not given */
  row_solver *solve;     /* NULL for that of the library */
  const void *context;
  const char *solver; /* its name, for the summary; not needed for the library's */
} resolving;

/* Reads `file`, resolves and writes; returns an exit code. */
int resolve_file(const resolving *job, const char *file);

#endif
