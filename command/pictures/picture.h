/* Pictures: those that gnuplot draws from a CSV by a script of command/figures, and those that
 * carom draws itself as SVG. Either is written as SVG, PNG or PDF by its name, whole or not at all.
 * */
#ifndef CAROM_CLI_PICTURE_H
#define CAROM_CLI_PICTURE_H

#include "program/options.h"

#include <stdio.h>

/* For a `const char *`: a name that ends as a picture's must, in .svg, .png or .pdf. */
OPTION_SET(set_picture);

/* Draws `path` by NAME.gp from what `write` puts into a CSV. Complains and returns false if it
 * cannot be drawn. */
bool picture_draw(const char *path, const char *name, const char *title,
                  void (*write)(FILE *out, const void *data), const void *data);

/* Whether svg_draw() would find what it needs to draw `path`, which may be NULL; complains where
 * it would not. */
bool svg_possible(const char *path);

/* Draws `path` from what `write` writes as SVG; rsvg-convert makes PNG and PDF of it. */
bool svg_draw(const char *path, void (*write)(FILE *out, const void *data), const void *data);

/* Writes `path` as `write` does. */
bool file_draw(const char *path, void (*write)(FILE *out, const void *data), const void *data);

/* The head of an SVG, and what is behind all, as attributes: "fill=\"#fff\"". */
void svg_begin(FILE *out, double width, double height, const char *background);

/* The size of letters of a picture of that width: 9 pixels or more where it is shown 500 pixels
 * wide. */
double svg_letters(double width);

/* Writes lines below each other, the first at `y`, letters `size` high; those of more than
 * `columns` are broken. Returns where the next would be. Without `out` it only tells that. */
double svg_lines(FILE *out, double x, double y, double size, int columns, const char *style,
                 const char *text);

/* A text at a place, of `most` characters at most, with what XML would take for its own put
 * right; and a circle. The attributes are as printf() writes them. */
__attribute__((format(printf, 6, 7))) void svg_text(FILE *out, double x, double y, const char *text,
                                                    int most, const char *attributes, ...);
__attribute__((format(printf, 5, 6))) void svg_circle(FILE *out, double x, double y, double r,
                                                      const char *attributes, ...);

#endif
