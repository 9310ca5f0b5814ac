/* A table that is printed as CSV, or in columns for people. */
#ifndef CAROM_LAB_SHEET_H
#define CAROM_LAB_SHEET_H

#include <stdbool.h>
#include <stdio.h>

typedef struct sheet {
  FILE *out;
  bool csv;
  char *text;
} sheet;

/* Begins a table, whose rows, the head first, are written as CSV into the stream that it returns.
 * sheet_end() prints them. In columns, text is left-aligned, numbers are right-aligned, and a
 * fraction has four digits. */
FILE *sheet_begin(sheet *s, FILE *out, bool csv);
void sheet_end(sheet *s, FILE *rows);

#endif
