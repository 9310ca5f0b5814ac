/* The rows are gathered, so that each column can be as wide as its widest cell. */
#include "sheet.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMNS_MOST = 24, CELL_MOST = 160 };

FILE *sheet_begin(sheet *s, FILE *out, bool csv) {
  static size_t unused;
  *s = (sheet){.out = out, .csv = csv};
  return csv ? out : open_text(&s->text, &unused);
}

/* Puts the next cell of a row into `cell` as it is shown; returns what follows it, NULL at the end
 * of the row. *number: whether it is one. */
static const char *next_cell(const char *at, char cell[CELL_MOST], bool *number) {
  size_t size = 0;
  bool quoted = false;
  for (; *at != '\n' && (*at != ',' || quoted); at++)
    if (*at == '"')
      quoted = !quoted;
    else if (size + 1 < CELL_MOST)
      cell[size++] = *at;
  cell[size] = '\0';
  char *end;
  const double x = strtod(cell, &end);
  *number = (*end == '\0' && end > cell) || strcmp(cell, "NA") == 0;
  if (*number && strpbrk(cell, ".e") != NULL)
    snprintf(cell, CELL_MOST, x < 1000.0 ? "%.4g" : "%.0f", x);
  return *at == ',' ? at + 1 : NULL;
}

void sheet_end(sheet *s, FILE *rows) {
  if (s->csv)
    return;
  close_text(rows, &s->text);
  int width[COLUMNS_MOST] = {0};
  bool numbers[COLUMNS_MOST] = {false}, number;
  char cell[CELL_MOST];
  /* once to measure, once to print; a row with a number tells that its column has them */
  for (int print = 0; print < 2; print++)
    for (const char *row = s->text; *row != '\0'; row = strchr(row, '\n') + 1) {
      const char *at = row;
      for (int k = 0; at != NULL && k < COLUMNS_MOST; k++) {
        at = next_cell(at, cell, &number);
        numbers[k] |= number;
        if (print == 0)
          width[k] = (int)strlen(cell) > width[k] ? (int)strlen(cell) : width[k];
        else {
          const int left = at != NULL ? -width[k] : 0; /* nothing behind the last cell */
          fprintf(s->out, "%s%*s", k > 0 ? "  " : "", numbers[k] ? width[k] : left, cell);
        }
      }
      if (print == 1)
        fputc('\n', s->out);
    }
  free(s->text);
}
