/* The kinds of rows that `resolve`, `hit` and `rail` work on: collisions of two balls, and
 * impacts of a ball on a cushion.
 *
 * All that those subcommands know of a kind stands in its row of this table, so each of them is
 * written once. A row of input is the doubles of the library's own struct in their order, and so
 * are its results.
 */
#ifndef CAROM_CLI_KIND_H
#define CAROM_CLI_KIND_H

#include "program/options.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { MOST_NUMBERS = 26, MOST_RESULTS = 12, MOST_DERIVED = 9, NO_NUMBER = -1 };

/* The numbers of a carom_result by the names of their columns. */
#define RESULT_COLUMNS "v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z"

/* The columns of CSV that fill one number. */
typedef struct column {
  const char *name, *both; /* its own; one that fills the numbers of both balls, or NULL */
  int partner;             /* the other number that `both` fills, or without which this one is
                              missing; or NO_NUMBER */
  bool optional;           /* may be missing: the number is then the kind's default */
} column;

typedef struct row_kind {
  const char *noun;              /* what a row is called: "collision" */
  const char *clue, *meant;      /* a column that only the other kind has, and what is said where
                                    it is met */
  int numbers, results;          /* doubles of a row, and of its results: a velocity and a spin
                                    for each ball */
  const column *columns;         /* of the numbers */
  const double *defaults;        /* what optional numbers are where they are missing */
  int radius, height, motion[2]; /* places of R, of the nose or NO_NUMBER, and of each ball's
                                    velocity with its spin behind */
  const char *result_columns;    /* separated by commas */
  bool has_single;               /* it can be solved in single precision; else results are
                                    rounded */

  /* The name of the solver or model that is asked for. */
  const char *(*name)(const shared_options *shared);
  /* Checks a row as carom_check() does. */
  carom_status (*check)(const void *in, const shared_options *shared, int *field);
  /* Sets the numbers that options say instead of columns; may be NULL. */
  void (*prepare)(const shared_options *shared, void *in);
  /* Resolves n rows, of floats where `single` is set, as it is only with `has_single`. */
  void (*solve)(const shared_options *shared, bool single, const void *in, size_t n, void *out,
                int8_t *status);

  /* --derived: names, how many, and the numbers. */
  const char *derived_columns;
  int derived;
  void (*derive)(const void *in, const void *out, double *numbers);
} row_kind;

extern const row_kind ball_kind, cushion_kind;

/* The kind that the options ask for. */
static inline const row_kind *kind_of(const shared_options *shared) {
  return shared->cushion ? &cushion_kind : &ball_kind;
}

/* The options of impacts on a cushion, with the steps and threads that every kind has. */
static inline carom_cushion_options cushion_options_of(const shared_options *shared) {
  carom_cushion_options options = shared->rail;
  options.steps = shared->options.steps;
  options.threads = shared->options.threads;
  return options;
}

#endif
