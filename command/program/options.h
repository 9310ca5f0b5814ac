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
  const char *name;     /* without its dashes; NULL: it stands for several, see rows_of() */
  char letter;          /* the short form, or 0 */
  const char *argument; /* what the help calls it; NULL for a flag, which has none */
  const char *help;     /* of any length: it is wrapped */
  /* Reads `text` into the field; complains and returns false where it is none of its values. May
   * change the text. */
  bool (*set)(const struct option_row *row, char *text, void *field);
  size_t field; /* offsetof(the job, field) */
  int least;    /* for set_count; of set_named the carom_words */
  int only;     /* ANY_KIND, or the kind of rows that the option is for */
  int part;     /* of set_option: whose rows they are, a carom_part_kind; 0: CAROM_PART_OPTIONS */
  int words;    /* a carom_words whose words it takes besides `argument`; 0: none */
  /* The default: what set() reads where the option is not given, and what else the help says of
   * it ("that of the game"). NULL: none. A list is filled by fill_usual(), so that a command sees
   * whether it was given. */
  const char *usual, *else_usual;
  bool is_list;
  bool is_physics;     /* described by `carom help physics` instead of the subcommand's help */
  const char *noun;    /* what a value is, for complaints: "table"; NULL: "value" */
  const char *example; /* a value for complaints to suggest; NULL: the default, or a word */
} option_row;

/* The default and the help of an option in one subcommand, instead of those of its row. */
typedef struct option_usual {
  const char *name, *usual, *else_usual;
  const char *help; /* NULL: that of the row */
} option_usual;

/* Kinds of rows that an option is for: all, collisions of two balls, or impacts on a cushion,
 * which --cushion asks for. */
enum { ANY_KIND, BALLS_ONLY, CUSHION_ONLY };

enum { NO_FILES, FILE_OR_NONE, ONE_FILE };

typedef struct command_form {
  const char *name;                 /* "resolve" */
  const char *usage;                /* what stands behind it: "[OPTIONS] IN" */
  const char *about;                /* what it does, a paragraph a line */
  const option_row *const *options; /* ends with NULL */
  const option_usual *usual;        /* ends with a name NULL; or NULL */
  const char *details;              /* columns, exit codes: what stands behind the options */
  const char *example;              /* lines that begin with the program's name */
  int files;                        /* NO_FILES, ... */
  bool is_physics;                  /* describes the options with is_physics */
} command_form;

/* Reads the arguments of a subcommand into its job, and the one file, if any, into `*file`.
 * Returns -1 where the subcommand should go on, else the exit code to end with: the help has
 * been printed, or a complaint. */
int parse_arguments(const command_form *form, int argc, char **argv, void *job, const char **file);

/* Fills a list that was not given with the option's default in this subcommand, or with that of its
 * row where the subcommand has no such option; the job is one that parse_arguments() has read. */
void fill_usual(void *job, const option_row *row);

/* Says where help is; returns EXIT_USAGE. */
int usage_hint(const command_form *form);

/* Prints the help of a subcommand. */
void print_help_of(const command_form *form);

/* Complains of the value of an option, and returns false. The format says what is wrong and what
 * would be right: "--errors '-1': below 0; try 1 (see --help)". */
__attribute__((format(printf, 3, 4))) bool refuse_value(const option_row *row, const char *text,
                                                        const char *format, ...);

/* Complains of a text that is none of the words, and returns false: "--table 'attic': no such
 * table; try 7ft or 8ft (--help lists them)". */
bool refuse_word(const option_row *row, const char *text, const char *words);

/* Whether `next`, the argument after the value `text`, seems to belong to it: a unit, or the second
 * number of a pair. Writes the value as it should be, "5m/s", into `whole`. */
enum { WHOLE_TEXT = 80 };
bool is_torn(const option_row *row, const char *text, const char *next, char whole[WHOLE_TEXT]);

#define OPTION_SET(function) bool function(const option_row *row, char *text, void *field)
OPTION_SET(set_flag);   /* bool */
OPTION_SET(set_text);   /* const char * */
OPTION_SET(set_count);  /* int: a whole number from row->least */
OPTION_SET(set_number); /* double, finite */
OPTION_SET(set_amount); /* double, finite, 0 or more */
OPTION_SET(set_choice); /* int, or an enumeration from 0: the place of the text in row->argument,
                           "this|that" */

OPTION_SET(
    set_named); /* an enumeration by the words of the library; its default has none in help */

OPTION_SET(set_option); /* an option of the library, by its row */

/* Writes the rows of the library's options for which a row without a name stands, at most
 * MOST_OF_LIBRARY; returns how many. Of shots: options_of_motion, or with those of when to stop
 * options_of_shots. */
enum { MOST_OF_LIBRARY = 24 };
int rows_of(const option_row *for_all, option_row rows[MOST_OF_LIBRARY]);

/* The words of an enumeration of the library with bars between them, with or without "default". */
enum { MOST_WORDS = 400 };
const char *words_of(int list, bool with_default, char text[MOST_WORDS]);

/* Sets the place of the text among words with bars between them; complains and returns false where
 * it is none of them. */
bool set_place(const option_row *row, const char *text, const char *words, int *place);

/* What the help calls the argument of an option, "this|that"; NULL for a flag. */
const char *argument_of(const option_row *row);

/* Several values of one number, or several conditions, of which shots by options take each. */
enum { LIST_MOST = 32, LISTS_MOST = 6, NUMBER_NAME = 64 };
typedef struct number_list {
  int part;   /* CAROM_PART_BALL or CAROM_PART_CUE; CAROM_PART_NONE of conditions */
  int number; /* as carom_number_of() has it; of conditions the first that they give */
  int count;
  double value[LIST_MOST]; /* or carom_condition */
} number_list;

/* Numbers that --with gives: bit k of `of_balls` is carom_number_of(CAROM_PART_BALL, k), and of
 * `of_cue` that of CAROM_PART_CUE; `of_fit` are those of a fit, and `fitted`
 * is its cushion, or 0. */
typedef struct given_numbers {
  uint64_t of_balls, of_cue, of_fit;
  int bands; /* of the fit: from so many contacts on, m within which 68 and 95 % of places were */
  double band[8][3];
  double slope[2]; /* of the fit's table */
  carom_shot_cushion fitted;
  carom_ball_kind kind;
  carom_cue cue;
  int lists; /* numbers with several values, of which no bit is set */
  number_list list[LISTS_MOST];
  bool in_lines;         /* the lines of the shots have them already */
  const char *condition; /* the last condition of a pool table that is given, or NULL */
  unsigned conditions;   /* bit k: carom_condition k is given */
} given_numbers;

/* Whether a game is played on the tables that the conditions describe; else a complaint. */
bool condition_fits(const given_numbers *numbers, carom_game game);

/* Gives value `k` of a list. */
void give_of_list(const number_list *list, int k, given_numbers *numbers);

/* "mass 0.17 kg", or "fast_cloth". */
void name_of_list(const number_list *list, int k, char text[NUMBER_NAME]);

/* Puts the numbers that are given into those of a ball, or of a cue. */
void give_ball(const given_numbers *numbers, carom_ball_kind *kind);
void give_cue(const given_numbers *numbers, carom_cue *cue);

/* Says into text[160] what would read a number, such as "--friction constant". */
const char *reader_of(const carom_number *number, const char *of_cushion, char text[160]);

/* Friction between the balls by their slip speed, where it is `is_set`. */
typedef struct friction_law {
  bool is_set;
  carom_speed_law law;
} friction_law;

/* A player that --player or --errors gives; one of a film has a rating and errors. */
typedef struct given_player {
  bool rated, errs, filmed;
  double rating, scale;
  double speed_share, phi, theta, a, b, growth, eye; /* as of carom_player */
} given_player;

enum precision { ANY_PRECISION = -1, DOUBLE_PRECISION, SINGLE_PRECISION };

typedef struct shared_options {
  const command_form *form;   /* of the subcommand, with all rows */
  bool cushion;               /* --cushion: impacts of a ball on a cushion, instead of collisions
                                 of two balls */
  carom_cushion_options rail; /* --model, --convention, --law, --least-step */
  uint32_t models;            /* a bit for each of several models; 0: that of rail */
  carom_shot_options shot;    /* of whole shots: --world, --ball-model, ... */
  given_numbers with;         /* --with */
  bool of_game;               /* of impacts: --with changes the numbers of a game, not 0s */
  carom_options options;      /* --solver of one, --slip, --steps, --threads */
  friction_law friction;
  given_player player;
  int precision;               /* enum precision */
  const char *folder, *output; /* --data, --output */
  bool summary, strict, derived;
  int layout; /* --from: a layout_moment */
} shared_options;

/* Puts the numbers of --with into those of cushions, where the rows are impacts. Complains and
 * returns false where one is not read by the model. */
bool numbers_are_read(shared_options *shared);

/* What the options are where none is given: as the library's, but on all processors, and with
 * the steps to be shown. */
#define COMMAND_OPTIONS \
  { .steps = CAROM_DEFAULT_STEPS, .threads = CAROM_ALL_THREADS }

extern const option_row option_solver, option_slip, option_steps, option_threads, option_friction,
    option_precision, option_data, option_output, option_summary, option_strict, option_derived,
    option_cushion, option_model, option_convention, option_law, option_least_step, option_with,
    options_of_shots, options_of_motion, option_with_of_shots, option_player, option_player_errors,
    option_player_eye;

OPTION_SET(
    set_numbers); /* given_numbers: NAME=X,... of balls and cues, or the file of a fit; with a
                            part only those of it */
OPTION_SET(set_cue_number); /* given_numbers: values of the number of a cue that has the option's
                               name, with _ for - */

/* A row of a job: the kind of rows that it is for, its own name, and what stands in an option_row;
 * behind the help may stand .usual = "2" and the like. OPTION() is one of a single table, for every
 * kind, and FLAG() one without an argument. */
#define OPTION_ROW(job, only_for, row, option, member, value, setter, minimum, ...) \
  const option_row row = {.name = option,                                           \
                          .argument = value,                                        \
                          .set = setter,                                            \
                          .field = offsetof(job, member),                           \
                          .least = minimum,                                         \
                          .only = only_for,                                         \
                          .help = __VA_ARGS__}
#define OPTION(job, row, option, member, argument, set, least, ...) \
  static OPTION_ROW(job, ANY_KIND, row, option, member, argument, set, least, __VA_ARGS__)
#define FLAG(job, row, option, member, ...) \
  OPTION(job, row, option, member, NULL, set_flag, 0, __VA_ARGS__)

#endif
