/* One collision out of a file, for the subcommands that look at it closely. */
#ifndef CAROM_CLI_PICK_H
#define CAROM_CLI_PICK_H

#include "carom.h"

#include <stdbool.h>
#include <stdio.h>

/* What was asked for. */
typedef struct pick {
  const char *id;
  const char *file;   /* a CSV file, "-" for stdin; NULL: the reference cases */
  const char *folder; /* of the reference cases; NULL: the usual one */
  bool by_law;        /* friction between the balls follows the law, not the file */
  carom_speed_law law;
} pick;

/* Finds the collision and checks it. Complains and returns false if it is not there, naming what is, or if it is in error. */
bool pick_impact(const pick *asked, carom_impact *impact);

/* --kernel: names of the library's solvers with commas between. Complains and returns false where one is none. */
bool pick_solvers(const char *text, carom_solver solvers[CAROM_SOLVER_COUNT], int *count);

/* Writes what the collision is as lines "# what: text", for those who read the CSV or draw it. */
void pick_describe(FILE *out, const pick *asked, const carom_impact *impact, const carom_options *options);

#endif
