/* The picture of a table from above, on which shots are drawn. */
#ifndef CAROM_CLI_TABLE_PICTURE_H
#define CAROM_CLI_TABLE_PICTURE_H

#include "carom_shot.h"
#include "pictures/labels.h"

#include <stdbool.h>
#include <stdio.h>

/* The table's axes on the picture. */
typedef struct view {
  FILE *out;
  double low[2], high[2], scale, margin; /* m, but for the scale */
  bool turned;
  labels *labels;
} view;

view view_of(FILE *out, const carom_table *t);

/* The pixels of a place. */
double across(const view *v, const double r[2]);
double down(const view *v, const double r[2]);

/* Draws the table, with `below` pixels free under it. Labels keep off rails and pockets. */
void draw_table(const view *v, const carom_table *t, double below);

#endif
