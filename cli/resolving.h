/* Collisions from a file, resolved, to a file: what the subcommands `resolve` share, whoever solves. */
#ifndef CAROM_CLI_RESOLVING_H
#define CAROM_CLI_RESOLVING_H

#include "options.h"

/* Resolves n rows as carom_collide_batch() does, with `options` and what else stands in `context`; where `single` is set the
 * rows are in float. */
typedef void row_solver(const void *context, const carom_options *options, bool single, const void *in, size_t n, void *out,
                        int8_t *status);

typedef struct resolving {
  shared_options shared; /* the precision is that of the source where it is not given */
  row_solver *solve;
  const void *context;
  const char *solver; /* its name, for the summary */
} resolving;

/* Reads `file`, resolves and writes; returns an exit code. */
int resolve_file(const resolving *job, const char *file);

/* Parts of the help of both. */
extern const char resolve_about[], resolve_details[];

#endif
