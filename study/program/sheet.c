/* The rows are gathered, so that each column can be as wide as its widest cell. */
#include "sheet.h"

#include "program/program.h"

enum { COLUMNS_MOST = 24, CELL_MOST = 160 };

FILE *sheet_begin(sheet *s, FILE *out, bool csv) {
  static size_t unused;
  *s = (sheet){.out = out, .csv = csv};
  if (csv)
    return out;
  return open_text(&s->text, &unused);
}

/* Puts the next cell of a row into `cell` as it is shown; returns what follows it, NULL at the end
 * of the row. *number: whether it is one. */
static const char *next_cell(const char *place, char cell[CELL_MOST], bool *number) {
  size_t size = 0;
  bool quoted = false;
  for (; *place != '\n' && (*place != ',' || quoted); place++)
    if (*place == '"')
      quoted = !quoted;
    else if (size + 1 < CELL_MOST)
      cell[size++] = *place;
  cell[size] = '\0';
  char *end;
  const double x = strtod(cell, &end);
  *number = (*end == '\0' && end > cell) || same_text(cell, "NA");
  const bool rounds = *number && strpbrk(cell, ".e") != NULL;
  if (rounds && x < 1000.0)
    snprintf(cell, CELL_MOST, "%.4g", x);
  else if (rounds)
    snprintf(cell, CELL_MOST, "%.0f", x);
  if (*place != ',')
    return NULL;
  return place + 1;
}

void sheet_end(sheet *s, FILE *rows) {
  if (s->csv)
    return;
  close_text(rows, &s->text);
  int width[COLUMNS_MOST] = {0};
  bool numbers[COLUMNS_MOST] = {false}, number;
  char cell[CELL_MOST];
  /* once to measure, once to print; a row with a number shows that its column is numeric */
  for (int print = 0; print < 2; print++)
    for (const char *row = s->text; *row != '\0'; row = strchr(row, '\n') + 1) {
      const char *place = row;
      for (int k = 0; place != NULL && k < COLUMNS_MOST; k++) {
        place = next_cell(place, cell, &number);
        numbers[k] |= number;
        if (print == 0 && (int)strlen(cell) > width[k])
          width[k] = (int)strlen(cell);
        int wide = width[k];
        if (!numbers[k]) /* to the left, with nothing behind the last cell */
          wide = -width[k] * (place != NULL);
        if (print == 1)
          fprintf(s->out, "%s%*s", text_if(k > 0, "  "), wide, cell);
      }
      if (print == 1)
        fputc('\n', s->out);
    }
  free(s->text);
}
