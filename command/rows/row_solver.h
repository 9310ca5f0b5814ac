/* Rows from a file, resolved, to a file: what the subcommands `resolve` share, whoever solves. */
#ifndef CAROM_CLI_ROW_SOLVER_H
#define CAROM_CLI_ROW_SOLVER_H

#include "program/options.h"

#include <stdint.h>

/* Resolves n collisions as carom_collide_batch() does, with `options` and what else stands in
 * `context`; where `single` is set the rows are in float. */
typedef void row_solver(const void *context, const carom_options *options, bool single,
                        const void *in, size_t n, void *out, int8_t *status);

typedef struct row_job {
  shared_options shared; /* the precision is that of the source where it is not given */
  row_solver *solve;     /* NULL for that of the library */
  const void *context;
  const char *solver; /* its name, for the summary; not needed for the library's */
} row_job;

/* Reads `file`, resolves and writes; returns an exit code. */
int resolve_file(const row_job *job, const char *file);

#endif
