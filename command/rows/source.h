/* Where rows come from: a CSV file, or a .npy array; given out in blocks.
 *
 * Columns of CSV are found by name, in any order; unknown ones are ignored. kind.h has those of
 * each kind. Optional for every kind is id; without it the number of the row is the id.
 */
#ifndef CAROM_CLI_SOURCE_H
#define CAROM_CLI_SOURCE_H

#include "rows/kind.h"
#include "rows/records.h"

typedef struct row_source row_source;

/* The most rows of a block: small for CSV, whose rows are large in memory and slow to read
 * anyway. */
enum { CSV_BLOCK = 1024, NPY_BLOCK = 65536 };

/* What is known of a row besides its numbers. */
typedef struct row_note {
  char *id; /* with room to be used again */
  size_t id_room;
  long long line;
  const char *error; /* NULL, or the name of what kept the row from being read, */
  char message[160]; /* and a sentence about it */
} row_note;

typedef struct source_block {
  size_t first, count;
  double *numbers; /* those of `count` rows; 0 where one is in error */
  row_note *note;  /* one for each, or NULL: then the number of the row is its id */
} source_block;

/* Opens a file of rows of the kind that is asked for by its name: .npy, or CSV, or "-" for CSV
 * on stdin. Complains and returns NULL if it or a column is missing. `shared` is read until the
 * source is closed. */
row_source *source_open(const char *path, const shared_options *shared);

/* Whether the numbers were float in the file. */
bool source_is_single(const row_source *source);

/* Fills a block, which begins as all zero and may be used again. READ_END: no more rows;
 * READ_FAILED: after a complaint. */
read_result source_read(row_source *source, source_block *block);
void source_free_block(source_block *block);

/* The numbers of row k of a block. */
double *source_row(const row_source *source, const source_block *block, size_t k);

/* Complains about row k of a block: what, where and what would be right. `status` is the
 * library's, CAROM_OK where the row could not be read; `doubt` is NULL, or what --strict refuses
 * the row for. */
void source_report(const row_source *source, const source_block *block, size_t k,
                   carom_status status, const char *doubt);

/* The name of the input for messages. */
const char *source_name(const row_source *source);

/* The share of the input that has been read, 0 to 1, or -1 where it is not known; not while
 * another thread reads. */
double source_share(const row_source *source);

void source_close(row_source *source);

/* The note of row k of a block; NULL where rows have none. */
static inline const row_note *row_note_of(const source_block *block, size_t k) {
  return block->note != NULL ? &block->note[k] : NULL;
}

#endif
