/* One impact from above as a picture: the balls in contact, lines and angles, and their paths
 * until they roll. */
#ifndef CAROM_CLI_CONTACT_PICTURE_H
#define CAROM_CLI_CONTACT_PICTURE_H

#include "carom.h"

#include <stdbool.h>
#include <stdio.h>

enum { CONTACT_WIDTH = 900, MOST_LINES = 4, MOST_ARCS = 3 };

/* A dashed line with a label at its end, m. */
typedef struct contact_line {
  double start[2], end[2];
  const char *label;
} contact_line;

/* An angle about a place, between two directions in degrees from +x. */
typedef struct contact_arc {
  double centre[2], start, end;
  const char *label; /* "cut" */
} contact_arc;

typedef struct contact_picture {
  int balls;
  const carom_ball *ball[2]; /* as they were; the first one moved */
  const carom_motion *outgoing[2];
  bool rail;                    /* a cushion touches the first ball from +y */
  const char *name[2], *way[2]; /* of the balls, and what is said where a path ends: "33.5
                                   degrees to the right" */
  contact_line line[MOST_LINES];
  contact_arc arc[MOST_ARCS];
  int lines, arcs;
  const char *words; /* lines below, each with its end */
} contact_picture;

/* Draws it as a part of an SVG, from `top` down; returns its height, pixels. */
double contact_draw(FILE *out, double top, const contact_picture *p);

#endif
