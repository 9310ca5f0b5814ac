/* The options of a subcommand: one table, which prints the help and parses.
 *
 * A row reads its argument into a field of the subcommand's own struct, the job. Options that
 * several subcommands take are rows here, of fields of shared_options, with which every job
 * begins.
 */
#ifndef CAROM_CLI_OPTIONS_H
#define CAROM_CLI_OPTIONS_H

#include "carom_shot.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct option_row {
  const char *name;     /* without its dashes */
  char letter;          /* the short form, or 0 */
  const char *argument; /* what the help calls it; NULL for a flag, which has none */
  const char *help;     /* of any length: it is wrapped */
  /* Reads `text` into the field; complains and returns false where it is none of its values. May
   * change the text. */
  bool (*set)(const struct option_row *row, char *text, void *field);
  size_t field; /* offsetof(the job, field) */
  int least;    /* for set_count */
  int only;     /* ANY_KIND, or the kind of rows that the option is for */
} option_row;

/* Kinds of rows that an option is for: all, collisions of two balls, or impacts on a cushion,
 * which --cushion asks for. */
enum { ANY_KIND, BALLS_ONLY, CUSHION_ONLY };

/* The models of an impact on a cushion by their names, in the order of their values. */
#define CUSHION_WORDS "mathavan|stronge|han|mirror|euler|smooth"

enum { NO_FILES, FILE_OR_NONE, ONE_FILE };

typedef struct command_form {
  const char *name;                 /* "resolve" */
  const char *usage;                /* what stands behind it: "[OPTIONS] IN" */
  const char *about;                /* what it does, a paragraph a line */
  const option_row *const *options; /* ends with NULL */
  const char *details;              /* columns, exit codes: what stands behind the options */
  const char *example;              /* a line that begins with the program's name */
  int files;                        /* NO_FILES, ... */
} command_form;

/* Reads the arguments of a subcommand into its job, and the one file, if any, into `*file`.
 * Returns -1 where the subcommand should go on, else the exit code to end with: the help has
 * been printed, or a complaint. */
int parse_arguments(const command_form *form, int argc, char **argv, void *job, const char **file);

/* Says where help is; returns EXIT_USAGE. */
int usage_hint(const command_form *form);

#define OPTION_SET(function) bool function(const option_row *row, char *text, void *field)
OPTION_SET(set_flag);   /* bool */
OPTION_SET(set_text);   /* const char * */
OPTION_SET(set_count);  /* int: a whole number from row->least */
OPTION_SET(set_number); /* double, finite */
OPTION_SET(set_amount); /* double, finite, 0 or more */
OPTION_SET(set_choice); /* int, or an enumeration from 0: the place of the text in row->argument,
                           "this|that" */

OPTION_SET(set_ball_model);    /* int: carom_shot_options.ball_model */
OPTION_SET(set_cushion_model); /* int: carom_shot_options.cushion_model */

/* Friction between the balls by their slip speed, where it is `given`. */
typedef struct friction_law {
  bool given;
  carom_speed_law law;
} friction_law;

/* Solvers of the library, one or both; none stands for options.solver. */
typedef struct solver_list {
  carom_solver solver[2];
  int count;
} solver_list;

enum precision { ANY_PRECISION = -1, DOUBLE_PRECISION, SINGLE_PRECISION };

typedef struct shared_options {
  bool cushion;               /* --cushion: impacts of a ball on a cushion, instead of collisions
                                 of two balls */
  carom_cushion_options rail; /* --model, --convention, --law, --least-step */
  carom_options options;      /* --solver of one, --slip, --steps, --threads */
  solver_list solvers;        /* --solver of several */
  friction_law friction;
  int precision;                       /* enum precision */
  const char *id, *folder, *output;    /* --id, --data, --output */
  bool summary, strict, derived, bare; /* bare: --no-comments */
} shared_options;

/* What the options are where none is given: as the library's, but on all processors, and with
 * the steps to be shown. */
#define COMMAND_OPTIONS \
  { .steps = CAROM_DEFAULT_STEPS, .threads = CAROM_ALL_THREADS }

extern const option_row option_solver, option_solvers, option_slip, option_steps, option_threads,
    option_friction, option_precision, option_id, option_data, option_output, option_summary,
    option_bare, option_strict, option_derived, option_cushion, option_model, option_convention,
    option_law, option_least_step;

/* A row of one table alone: OPTION(job, option_NAME, name, field, letter, argument, set, least,
 * help). */
#define OPTION(job, row, name, member, letter, argument, set, least, help) \
  OPTION_FOR(ANY_KIND, job, row, name, member, letter, argument, set, least, help)
#define OPTION_FOR(only, job, row, name, member, letter, argument, set, least, help)        \
  static const option_row row = {name,  letter, argument, help, set, offsetof(job, member), \
                                 least, only}

#endif
