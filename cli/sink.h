/* Where results go: CSV, or a .npy array of shape (n, 12); whole or not at all (see output.h). */
#ifndef CAROM_CLI_SINK_H
#define CAROM_CLI_SINK_H

#include "carom.h"

#include <stdbool.h>
#include <stdio.h>

/* The numbers of a carom_result by the names of their columns. */
#define RESULT_COLUMNS "v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z"

/* Writes an id as a field of CSV, in quotes where it needs them. */
void write_id(FILE *out, const char *id);

typedef struct result_sink result_sink;

/* Opens the output by its name: .npy, or CSV, or "-" for CSV on stdout. `single` says that results are carom_result_f32, and
 * that a .npy file is to hold float32. `more`: rows of CSV end with the numbers of derived.h. Complains and returns NULL if
 * that fails. */
result_sink *sink_open(const char *path, bool single, bool more);

/* Writes a row. `id` may be NULL: the number of the row, from 1, is written. `error` is NULL, or the name of an error that is
 * not the library's; `result` is a carom_result or a carom_result_f32, NaN throughout where there is an error. */
void sink_write(result_sink *sink, const char *id, const carom_impact *impact, const void *result, carom_status status,
                const char *error);

/* Puts the file in its place, or drops it if the results are not `good`; whether it stands there. The sink is gone. */
bool sink_close(result_sink *sink, bool good);

#endif
