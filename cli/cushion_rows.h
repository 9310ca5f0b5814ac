/* Impacts of a ball on a cushion from the columns of a CSV file: for the subcommands with --cushion.
 *
 * Columns are found by name, in any order; unknown ones are ignored. Needed: vx vy vz wx wy wz R M h mu_s mu_w e. Optional: id
 * (else the number of the row), nx ny (else 0 and 1: the cushion's normal is y) and rho (else 0: a straight rail). */
#ifndef CAROM_CLI_CUSHION_ROWS_H
#define CAROM_CLI_CUSHION_ROWS_H

#include "carom_shot.h"
#include "options.h"
#include "records.h"

enum { CUSHION_FIELDS = 15 };

/* What --cushion adds to the options of every job. */
typedef struct cushion_options {
  int model, convention, law; /* the enumerations of carom_shot.h */
  double least_step;
} cushion_options;

/* A job of any of the subcommands begins with it. */
typedef struct cushion_job {
  shared_options shared;
  cushion_options cushion;
} cushion_job;

extern const option_row option_model, option_convention, option_law, option_least_step;

/* For the help of what goes without it. */
extern const option_row option_cushion;

/* The help of columns and models. */
#define CUSHION_COLUMNS_HELP                                                                          \
  "columns of the CSV file, by name in any order (others are ignored), SI units:\n"                   \
  "  id                      optional; the number of the row if absent\n"                             \
  "  vx vy vz wx wy wz       velocity, m/s (vz must be 0), and angular velocity, rad/s\n"             \
  "  nx ny                   horizontal direction into the cushion, of any length; default: 0 1\n"    \
  "  R M h                   radius, m, mass, kg, and height of the nose above the cloth, m\n"        \
  "  mu_s mu_w e             friction with the cloth and with the cushion, and restitution, 0 to 1\n" \
  "  rho                     radius of a jaw, m; default: 0, a straight rail\n\n"

/* The library's options of a job. */
carom_cushion_options cushion_options_of(const cushion_job *job);

/* Whether the arguments of a subcommand ask for cushions: "--cushion" is among them, and is taken out. */
bool cushion_asked(int *argc, char **argv);

typedef struct cushion_reader cushion_reader;

typedef struct cushion_row {
  char *id; /* kept with its room from row to row; whoever has the row frees it */
  size_t id_room;
  long long line;
  const char *error; /* NULL, or the name of what kept the row from being read, */
  char message[160]; /* and a sentence about it */
  carom_cushion_impact impact;
} cushion_row;

/* Which number of a carom_cushion_impact the column of that name fills, or -1. */
int cushion_field(const char *column);

/* The column that fills a number. */
const char *cushion_column(int field);

/* Opens `path`, "-" for stdin. Complains and returns NULL if it or a column is missing. */
cushion_reader *cushion_open(const char *path);

/* The next row, or READ_END; READ_FAILED after a complaint. */
read_result cushion_next(cushion_reader *reader, cushion_row *row);

/* Complains about a row: what, where and what would be right. */
void cushion_report(const cushion_reader *reader, const cushion_row *row, const carom_cushion_options *options,
                    carom_status status);

void cushion_close(cushion_reader *reader);

/* Finds the impact `id` in a file; complains and returns false if it is not there or in error. */
bool cushion_pick(const char *path, const char *id, const carom_cushion_options *options, carom_cushion_impact *impact);

#endif
