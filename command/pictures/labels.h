/* Labels of a picture that cover neither each other nor what is kept free of them. */
#ifndef CAROM_CLI_LABELS_H
#define CAROM_CLI_LABELS_H

#include <stdio.h>

enum { MOST_BOXES = 4096 };

typedef struct labels {
  FILE *out;
  double width, height; /* where labels may stand, from 0, pixels */
  double size;          /* of the letters */
  int boxes;
  double box[MOST_BOXES][4]; /* left, top, right and bottom of what is taken */
} labels;

/* Keeps a box free of labels. */
void keep_free(labels *l, double left, double top, double right, double bottom);

/* The same for a line, whose ends are those. */
void keep_line(labels *l, double x0, double y0, double x1, double y1);

/* Writes a label as near to a place as it finds room; none where there is no room. */
void put_label(labels *l, double x, double y, const char *text);

#endif
