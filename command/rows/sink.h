/* Where results go: CSV, or a .npy array of a row of results each; whole or not at all (see
 * output.h). */
#ifndef CAROM_CLI_SINK_H
#define CAROM_CLI_SINK_H

#include "rows/kind.h"

#include <stdbool.h>
#include <stdio.h>

/* Writes rows as source.h reads them: a header, and an id with the numbers of a row. */
void write_row_header(FILE *out, const row_kind *kind);
void write_row(FILE *out, const row_kind *kind, const char *id, const double *row);

typedef struct result_sink result_sink;

/* Opens the output that the options name: .npy, or CSV, or "-" for CSV on stdout. `single` says
 * that a
 * .npy file is to hold float32. Complains and returns NULL if that fails. */
result_sink *sink_open(const shared_options *shared, bool single);

/* Writes a row. `id` may be NULL: the number of the row, from 1, is written. `in` is the row
 * resolved, `result` what came of it, NaN throughout where there is an error. `error` is NULL,
 * or the name of an error that is not the library's. */
void sink_write(result_sink *sink, const char *id, const double *in, const double *result,
                carom_status status, const char *error);

/* Puts the file in its place, or drops it if the results are not `good`; whether it stands
 * there. The sink is gone. */
bool sink_close(result_sink *sink, bool good);

#endif
