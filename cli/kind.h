/* The kinds of rows that `resolve`, `trace` and `sweep` work on: collisions of two balls, and
 * impacts of a ball on a cushion.
 *
 * All that those subcommands know of a kind stands in its row of this table, so each of them is
 * written once. A row of input is the doubles of the library's own struct in their order, and so
 * are its results.
 */
#ifndef CAROM_CLI_KIND_H
#define CAROM_CLI_KIND_H

#include "options.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { MOST_NUMBERS = 26, MOST_RESULTS = 12, MOST_DERIVED = 9, MOST_POINT = 23, NO_NUMBER = -1 };

/* The numbers of a carom_result by the names of their columns. */
#define RESULT_COLUMNS "v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z"

/* The columns of CSV that fill one number. */
typedef struct column {
  const char *name, *both; /* its own; one that fills the numbers of both balls, or NULL */
  int partner;             /* the other number that `both` fills, or without which this one is
                              missing; or NO_NUMBER */
  bool optional;           /* may be missing: the number is then the kind's default */
} column;

/* One point of a trace, as it is printed. */
typedef struct trace_point {
  double impulse, work; /* N s, J */
  bool restitution, sticks[2];
  double number[MOST_POINT]; /* the columns behind those; the first is the normal velocity */
} trace_point;

typedef struct row_kind {
  const char *noun;              /* what a row is called: "collision" */
  const char *which;             /* the column that says how it was resolved: "solver" */
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

  /* How it is resolved: for the column `which`, where `variant` counts those asked for. */
  const char *(*name)(const shared_options *asked, int variant);
  /* Checks a row as carom_check() does. */
  carom_status (*check)(const void *in, const shared_options *asked, int *field);
  /* Sets the numbers that options say instead of columns; may be NULL. */
  void (*prepare)(const shared_options *asked, void *in);
  /* Resolves n rows, of floats where `single` is set, as it is only with `has_single`. */
  void (*solve)(const shared_options *asked, bool single, const void *in, size_t n, void *out,
                int8_t *status);

  /* --derived: names, how many, and the numbers. */
  const char *derived_columns;
  int derived;
  void (*derive)(const void *in, const void *out, double *numbers);

  /* Says what the row is as lines "# what: text". */
  void (*describe)(FILE *out, const shared_options *asked, const void *in);

  /* trace: the columns from "sticks" on and how many numbers there are behind them; the notes on
   * where each contact sticks; n points of equal steps; the impulses from which on the contacts
   * stick, or NaN. */
  const char *trace_columns, *contacts[2];
  int trace_numbers;
  carom_status (*trace)(const shared_options *asked, int variant, const void *in, int n,
                        trace_point *points);
  void (*stuck)(const shared_options *asked, const void *in, int n, const trace_point *points,
                double at[2]);

  /* sweep: words that --over takes; the one that turns the contact, and the places of the
   * direction that it turns, from the first, unless that is NO_NUMBER, to the second; columns
   * before "jump" and behind "status"; a row resolved, with those. */
  const char *inputs, *turning, *lead_columns, *tail_columns, *title, *axis;
  int direction[2], lead;
  carom_status (*look)(const shared_options *asked, int variant, const void *in, void *out,
                       double lead[2], double *tail);
} row_kind;

extern const row_kind ball_kind, cushion_kind;

/* The kind that the options ask for. */
static inline const row_kind *kind_of(const shared_options *asked) {
  return asked->cushion ? &cushion_kind : &ball_kind;
}

/* How many ways of resolving a row are asked for. */
static inline int variants_of(const shared_options *asked) {
  return asked->solvers.count > 0 ? asked->solvers.count : 1;
}

/* Whether a column of that name, its own or one for both balls, fills the number. */
static inline bool kind_fills(const row_kind *k, int number, const char *name) {
  const column *c = &k->columns[number];
  return strcmp(c->name, name) == 0 || (c->both != NULL && strcmp(c->both, name) == 0);
}

#endif
