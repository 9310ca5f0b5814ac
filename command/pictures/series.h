/* Impacts from words: a row for each combination of the values asked for, told in words, written
 * as rows or as a table, drawn as pictures or, over a range of one of the values, as curves.
 * What differs between a hit and a rail stands in a scene. */
#ifndef CAROM_CLI_SERIES_H
#define CAROM_CLI_SERIES_H

#include "rows/kind.h"
#include "rows/values.h"

/* the speed is the second input of a scene */
enum { SPEED_INPUT = 1, MOST_INPUTS = 12, MOST_CASES = 16 };

typedef struct series series;

/* One of the combinations: a value of each input, its row, how it is solved, and the result. */
typedef struct one_case {
  const value *inputs[MOST_INPUTS];
  shared_options shared;
  double row[MOST_NUMBERS], result[MOST_RESULTS];
  char id[MOST_INPUTS * VALUE_NAME];
} one_case;

typedef struct scene {
  const row_kind *kind;
  const char *const *inputs;   /* what each is, on an axis: "cut angle"; ends with NULL. An option
                                  without a default leaves NaN, for which the scene knows what
                                  stands. */
  int model;                   /* the input that is a cushion model, or -1 */
  const char *quantities;      /* words of --quantity, with bars between; the first is the usual
                                  one */
  const char *const *quantity; /* what each is, on an axis, with its unit */
  /* Makes the row of the values, and changes how it is solved; the id is made. */
  void (*make)(const series *s, one_case *c);
  /* Measures a quantity. */
  double (*measure)(const series *s, const one_case *c, int quantity);
  /* Tells in words what came of it. */
  void (*tell)(FILE *out, const one_case *c);
  /* Draws it as a part of a picture, with those words, from `top` down; returns its height,
   * pixels. */
  double (*draw)(FILE *out, double top, const one_case *c, const char *words);
  /* What holds for all curves and is no input, or "": the law of friction. */
  const char *(*law)(const series *s, char text[80]);
  /* Whether all can be made; else a complaint. NULL: it can. */
  bool (*check)(const series *s);
} scene;

struct series {
  shared_options shared;
  const scene *scene;
  values in[MOST_INPUTS];
  uint32_t asked_for; /* --quantity: a bit for each of the words; 0: none was given */
  int game;           /* of a rail, a carom_game */
  bool csv;
  const char *picture;
};

/* An option for the values of an input. */
#define INPUT(row, option, input, argument, measure, ...) \
  OPTION(series, row, option, in[input], argument, set_values, measure, __VA_ARGS__)

/* series.asked_for: words of row->argument, with commas. */
OPTION_SET(set_quantities);

/* A subcommand: reads the arguments and does what they ask for; an exit code. Input `angle` is
 * below 90 degrees, or that is what it complains of. */
int series_command(series *s, const command_form *form, int argc, char **argv, int angle,
                   const char *complaint);

/* "1.2 m/s, 30.00 degrees to the left"; angles are from +x. Below 1e-9 of `scale`, m/s, a ball
 * is at rest. */
const char *velocity_text(const double v[2], double scale, char text[64]);

/* "2.1 rad/s of right english", or "no english", of a spin about the vertical. */
const char *english_text(double w_z, char text[64]);

/* A line about a ball's spin after an impact, of a ball that moves along v. */
void tell_spin(FILE *out, const double v[2], const double w[3]);

#endif
