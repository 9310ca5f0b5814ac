/* A measured CSV, whole in memory. */
#include "sheet.h"

#include "message.h"
#include "records.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *checked(void *block) {
  if (block == NULL) {
    complain("out of memory");
    exit(2);
  }
  return block;
}

/* One more place in an array of pointers. */
static void make_room(void *array, size_t count, size_t *space) {
  void **block;
  memcpy(&block, array, sizeof block);
  if (count < *space)
    return;
  *space = 2 * *space + 16;
  block = checked(realloc(block, *space * sizeof *block));
  memcpy(array, &block, sizeof block);
}

static size_t count_fields(const char *line) {
  size_t count = 1;
  for (; *line != '\0'; line++)
    count += *line == ',';
  return count;
}

/* Fields of a copy of the line; field[0] owns the copy. */
static char **split(const char *line, size_t columns) {
  char **field = checked(calloc(columns, sizeof *field));
  char *at = checked(strdup(line));
  for (size_t k = 0; k < columns; k++) {
    field[k] = at;
    char *comma = strchr(at, ',');
    if (comma == NULL)
      break;
    *comma = '\0';
    at = comma + 1;
  }
  return field;
}

static bool take_line(sheet *s, const char *path, long long number, const char *line) {
  if (line[0] == '#') {
    make_room(&s->note, s->notes, &s->notes_space);
    s->note[s->notes++] = checked(strdup(line + 1 + strspn(line + 1, " ")));
    return true;
  }
  if (line[0] == '\0')
    return true;
  const size_t fields = count_fields(line);
  if (s->header == NULL) {
    s->columns = fields;
    s->header = split(line, fields);
    return true;
  }
  if (fields != s->columns) {
    complain("%s:%lld: %zu fields, but the header has %zu", path, number, fields, s->columns);
    return false;
  }
  make_room(&s->row, s->rows, &s->row_space);
  s->row[s->rows++] = split(line, fields);
  return true;
}

bool sheet_read(const char *path, sheet *out) {
  *out = (sheet){0};
  FILE *in = fopen(path, "r");
  if (in == NULL) {
    complain("cannot read %s: %s", path, strerror(errno));
    return false;
  }
  char *line = NULL;
  size_t space = 0;
  bool good = true;
  for (long long number = 1; good && getline(&line, &space, in) >= 0; number++) {
    line[strcspn(line, "\r\n")] = '\0';
    good = take_line(out, path, number, line);
  }
  if (good && out->header == NULL) {
    complain("%s: no header", path);
    good = false;
  }
  free(line);
  fclose(in);
  if (!good)
    sheet_free(out);
  return good;
}

static void free_fields(char **field) {
  if (field != NULL)
    free(field[0]);
  free(field);
}

void sheet_free(sheet *s) {
  for (size_t k = 0; k < s->rows; k++)
    free_fields(s->row[k]);
  for (size_t k = 0; k < s->notes; k++)
    free(s->note[k]);
  free_fields(s->header);
  free(s->row);
  free(s->note);
  *s = (sheet){0};
}

size_t sheet_column(const sheet *s, const char *name) {
  for (size_t k = 0; k < s->columns; k++)
    if (strcmp(s->header[k], name) == 0)
      return k;
  return SIZE_MAX;
}

const char *sheet_text(const sheet *s, size_t row, const char *column) {
  const size_t k = sheet_column(s, column);
  return k == SIZE_MAX || row >= s->rows ? "" : s->row[row][k];
}

double sheet_number(const sheet *s, size_t row, const char *column) {
  double number;
  return parse_number(sheet_text(s, row, column), &number) ? number : NAN;
}

size_t sheet_find(const sheet *s, size_t from, const char *column, const char *text) {
  while (from < s->rows && strcmp(sheet_text(s, from, column), text) != 0)
    from++;
  return from;
}

const char *sheet_note(const sheet *s, const char *what) {
  const size_t size = strlen(what);
  for (size_t k = 0; k < s->notes; k++)
    if (strncmp(s->note[k], what, size) == 0 && strncmp(s->note[k] + size, ": ", 2) == 0)
      return s->note[k] + size + 2;
  return NULL;
}
