/* Where collisions come from: a CSV file, or a .npy array mapped into memory; given out in blocks. */
#ifndef CAROM_CLI_SOURCE_H
#define CAROM_CLI_SOURCE_H

#include "carom.h"
#include "impacts.h"

typedef struct row_source row_source;

/* The most rows of a block: small for CSV, whose rows are large in memory and slow to read anyway. */
enum { CSV_BLOCK = 1024, NPY_BLOCK = 65536 };

typedef struct source_block {
  size_t first, count;
  void *impact;    /* count of carom_impact, or of carom_impact_f32 where the source is single */
  impact_row *row; /* what else is known of each, or NULL: nothing, and the number of the row is the id */
} source_block;

/* Opens a file by its name: .npy, or CSV, or "-" for CSV on stdin; the column u_b may be missing if it is not `needed`.
 * Complains and returns NULL if that fails. */
row_source *source_open(const char *path, bool mu_ball_needed);

/* Whether the numbers are float. */
bool source_is_single(const row_source *source);

/* Fills a block, which begins as all zero and may be used again. READ_END: no more rows; READ_FAILED: after a complaint. */
read_result source_read(row_source *source, source_block *block);
void source_free_block(source_block *block);

/* Row k of a block in double precision; 0 throughout if it could not be read. */
carom_impact source_impact(const row_source *source, const source_block *block, size_t k);

/* Complains about row k of a block: what, where and what would be right. `status` is the library's, CAROM_OK where the row
 * could not be read; `doubt` is NULL, or what --strict refuses the row for. */
void source_report(const row_source *source, const source_block *block, size_t k, const carom_options *options,
                   carom_status status, const char *doubt);

/* The name of the input for messages. */
const char *source_name(const row_source *source);

/* The share of the input that has been read, 0 to 1, or -1 where it is not known; not while another thread reads. */
double source_share(const row_source *source);

void source_close(row_source *source);

#endif
