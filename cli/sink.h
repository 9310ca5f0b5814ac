/* Where results go: CSV, or a .npy array of shape (n, 12); whole or not at all (see output.h). */
#ifndef CAROM_CLI_SINK_H
#define CAROM_CLI_SINK_H

#include "carom.h"

#include <stdbool.h>

typedef struct result_sink result_sink;

/* Opens the output by its name: .npy, or CSV, or "-" for CSV on stdout. `single` says that results are carom_result_f32, and
 * that a .npy file is to hold float32. Complains and returns NULL if that fails. */
result_sink *sink_open(const char *path, bool single);

/* Writes a row. `id` may be NULL: the number of the row, from 1, is written. `error` is NULL, or the name of an error that is
 * not the library's; `result` is a carom_result or a carom_result_f32. */
void sink_write(result_sink *sink, const char *id, const void *result, carom_status status, const char *error);

/* Puts the file in its place, or drops it. The sink is gone after either. */
bool sink_commit(result_sink *sink);
void sink_abandon(result_sink *sink);

#endif
