/* Text files of rows, which tests read and check. A row is a line and the indented lines behind it.
 * A # at the beginning of a line or behind a space begins a comment; lines without anything else
 * count for nothing. */
#ifndef CAROM_TESTS_ROW_FILE_H
#define CAROM_TESTS_ROW_FILE_H

#include "support.h"

#include <ctype.h>

enum { ROW_LINE = 1000 };

/* The file that is read. */
static struct {
  FILE *file;
  const char *path;
  int line_number;
  int rows_begun;
  char line[ROW_LINE];
} row_file;

/* What is read next, within the line. */
static const char *cursor = "";

static inline _Noreturn void reject(const char *reason) {
  ck_abort_msg("%s:%d: %s, before \"%s\": %s", row_file.path, row_file.line_number, row_file.line,
               cursor, reason);
}

/* Opens a file; false where it cannot be read. */
static inline bool find_rows(const char *path) {
  row_file.path = path;
  row_file.line_number = 0;
  row_file.rows_begun = 0;
  row_file.file = fopen(path, "r");
  return row_file.file != NULL;
}

/* The same in a test, which must be able to read it. */
static inline void open_rows(const char *path) {
  if (!find_rows(path))
    ck_abort_msg("cannot read %s", path);
}

/* Whether the line begins a row. */
static inline bool begins_row(void) {
  return row_file.line[0] != ' ';
}

/* Reads the next line that has anything, without comment; false at the end of the file, which is
 * then closed. */
static inline bool next_line(void) {
  while (fgets(row_file.line, ROW_LINE, row_file.file) != NULL) {
    char *const line = row_file.line;
    size_t length = strcspn(line, "\n");
    for (size_t k = 0; k < length; k++)
      if (line[k] == '#' && (k == 0 || line[k - 1] == ' '))
        length = k;
    while (length > 0 && line[length - 1] == ' ')
      length--;
    line[length] = '\0';
    row_file.line_number++;
    if (length == 0)
      continue;
    row_file.rows_begun += begins_row();
    cursor = line;
    return true;
  }
  fclose(row_file.file);
  return false;
}

static inline bool is_word_part(char letter) {
  return isalnum((unsigned char)letter) || letter == '_';
}

static inline void skip_spaces(void) {
  cursor += strspn(cursor, " ");
}

/* Whether the line continues with a word or a sign, which is then skipped. */
static inline bool skip(const char *expected) {
  const size_t length = strlen(expected);
  skip_spaces();
  if (strncmp(cursor, expected, length) != 0)
    return false;
  if (is_word_part(expected[length - 1]) && is_word_part(cursor[length]))
    return false;
  cursor += length;
  return true;
}

#endif
