/* A measured CSV, whole in memory, as the report reads it: notes (lines "# what: text"), a header, rows.
 *
 * These are carom's own files: no quotes, one record a line. A row with too few or too many fields is an error. */
#ifndef CAROM_CLI_SHEET_H
#define CAROM_CLI_SHEET_H

#include <stdbool.h>
#include <stddef.h>

typedef struct sheet {
  size_t columns, rows, notes;
  char **header;
  char ***row;
  char **note;                   /* "what: text" */
  size_t row_space, notes_space; /* of the arrays */
} sheet;

/* Reads a file. Complains and returns false if that fails; the sheet is then empty. */
bool sheet_read(const char *path, sheet *out);
void sheet_free(sheet *s);

/* The column of that name, or SIZE_MAX. */
size_t sheet_column(const sheet *s, const char *name);

/* A field as text ("" where there is no such column) or as a number (NAN where it is none). */
const char *sheet_text(const sheet *s, size_t row, const char *column);
double sheet_number(const sheet *s, size_t row, const char *column);

/* The first row in which `column` holds `text`, at or behind `from`; s->rows if there is none. */
size_t sheet_find(const sheet *s, size_t from, const char *column, const char *text);

/* What the note says, or NULL. */
const char *sheet_note(const sheet *s, const char *what);

#endif
