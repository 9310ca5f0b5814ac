/* The options of a subcommand: help and parsing from one table. What the fields are is known to
 * fields.c. */
#include "program/options.h"

#include "program/command.h"
#include "program/manual.h"
#include "program/message.h"
#include "program/words.h"

#include <getopt.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROWS = 64, MOST_LONGS = MOST_ROWS + 24, FIRST_CODE = UCHAR_MAX + 1 };
enum { USUAL_TEXT = 80 };
enum { HELP_WIDTH = 80, OPTION_WIDTH = 23 }; /* columns of the help */

static const option_row help_row = {.name = "help", .letter = 'h', .help = "this text"};

/* Other names of options: each is taken where a subcommand has no option of that name, as the first
 * of these that it has. */
static const struct {
  const char *alias, *name;
} also[] = {{"english", "side"},         {"rack", "rules"},
            {"rack", "balls"},           {"game", "rules"},
            {"power", "speed"},          {"fargo", "player"},
            {"fargo", "players"},        {"player", "players"},
            {"rating", "player"},        {"rating", "players"},
            {"object-balls", "balls"},   {"cloth", "mu-slide"},
            {"cloth", "with"},           {"cushions", "with"},
            {"banks", "read"},           {"cloth-friction", "mu-slide"},
            {"models", "world"},         {"ball-ball", "ball-model"},
            {"solver", "ball-model"},    {"cushion-model", "model"},
            {"cushion-model", "cushion"}};

/* What players ask for by a name that no option has, and what says it. A subcommand without the
 * option says nothing. */
static const struct {
  const char *alias, *name, *advice;
} advices[] = {
    {"english", "tip", "try --tip 50%,0, half of the possible right english"},
    {"side", "tip", "try --tip 50%,0, half of the possible right english"},
    {"spin", "tip", "try --tip low, the most draw, or --tip 0,0.2 for some follow"},
    {"pivot", "tip", "try --tip 0.3,0: the report has the bridge for back-hand english"},
    {"pocket-size", "table", "try --table 9ft,corner=4.25in"},
    {"pockets", "table", "try --table 9ft,corner=4.25in"},
    {"with", "friction", "try --friction, --restitution, --mu-slide, --roll, --mass or --radius"},
    {"jump", "elevation", "try --elevation 40 --speed 4: the report has the height"},
    {"angle", "aim", "try --aim for the direction of the cue, --cut for the angle at the ball"},
    {"from", "cue", "try --cue, the position of the cue ball"}};

static bool has_option(const command_form *form, const char *name) {
  for (size_t k = 0; form->options[k] != NULL; k++)
    if (same_text(form->options[k]->name, name))
      return true;
  return false;
}

/* ---- Defaults */

/* The default and the help of a row in a form. One of a form without a default has that of the
 * row. */
static option_usual usual_of(const command_form *form, const option_row *row) {
  const option_usual of_row = {row->name, row->usual, row->else_usual, row->help};
  for (const option_usual *usual = form->usual; usual != NULL && usual->name != NULL; usual++) {
    if (!same_text(usual->name, row->name))
      continue;
    option_usual found = *usual;
    if (found.usual == NULL && found.else_usual == NULL) {
      found.usual = of_row.usual;
      found.else_usual = of_row.else_usual;
    }
    if (found.help == NULL)
      found.help = of_row.help;
    return found;
  }
  return of_row;
}

/* Reads the default of a row into its field, from a copy, which set() may change. */
static void set_usual(const command_form *form, const option_row *row, void *job) {
  static char kept[MOST_ROWS][USUAL_TEXT]; /* the field of an option without a list may keep it */
  static int used;
  char copy[USUAL_TEXT], *text = copy;
  const char *usual = usual_of(form, row).usual;
  if (usual == NULL)
    return;
  if (!row->is_list)
    text = kept[used++ % MOST_ROWS];
  snprintf(text, USUAL_TEXT, "%s", usual);
  if (!row->set(row, text, (char *)job + row->field))
    abort(); /* a default that its own option refuses */
}

void fill_usual(void *job, const option_row *row) {
  set_usual(((const shared_options *)job)->form, row, job);
}

/* ---- Complaints */

enum { HELP_TEXT = 1600 };
enum { QUOTED_MOST = 40 }; /* characters of a value that a complaint quotes */

/* Writes `NAME 'TEXT': `, with the beginning of a long text. */
static void quote_value(const option_row *row, const char *text, char quoted[120]) {
  const bool is_long = strlen(text) > QUOTED_MOST;
  snprintf(quoted, 120, "--%.30s '%.*s%s'", row->name, is_long ? QUOTED_MOST - 3 : QUOTED_MOST,
           text, text_if(is_long, "..."));
}

/* The command that describes an option. */
static const char *help_for(const option_row *row) {
  return row->is_physics ? "`carom help physics`" : "--help";
}

bool refuse_value(const option_row *row, const char *text, const char *format, ...) {
  char quoted[120], what[256];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(what, sizeof what, format, arguments);
  va_end(arguments);
  quote_value(row, text, quoted);
  complain("%s: %s (see %s)", quoted, what, help_for(row));
  return false;
}

bool refuse_word(const option_row *row, const char *text, const char *words) {
  char quoted[120], list[HINT_TEXT];
  quote_value(row, text, quoted);
  complain("%s: no such %s; try %s (%s lists them)", quoted, text_or(row->noun, "value"),
           words_to_try(text, words, list), help_for(row));
  return false;
}

/* ---- Help of rows */

/* Whether the words of an argument do not fit into a line, so that the text of the help has
 * them. */
static bool is_long_list(const char *argument) {
  return strlen(argument) > HELP_WIDTH - OPTION_WIDTH;
}

/* Whether a letter begins a kind of value, such as X,Y, instead of a word. */
static bool is_upper(char letter) {
  return letter >= 'A' && letter <= 'Z';
}

/* "NAME" for a long list, or "NAME|X,Y:..." where other values follow its words. */
static const char *short_list(const char *words) {
  static char text[40];
  const char *last = strrchr(words, '|');
  snprintf(text, sizeof text, "NAME%s", text_if(last != NULL && is_upper(last[1]), last));
  return text;
}

/* Adds the words of a long list behind a text: " NAME is 7ft, 8ft or 9ft." */
static void add_names(const option_row *row, char text[HELP_TEXT]) {
  const char *words = text_or(argument_of(row), "");
  if (!is_long_list(words))
    return;
  append(text, HELP_TEXT, ". ", "NAME is ");
  for (const char *separator = ""; *words != '\0' && !is_upper(*words); separator = ", ") {
    const size_t size = strcspn(words, "|");
    append(text, HELP_TEXT, separator, "%.*s", (int)size, words);
    words += size + (words[size] == '|');
  }
}

/* The help, the default and the names of a long list: "the table (default 9ft)". */
static const char *help_of(const command_form *form, const option_row *row, char text[HELP_TEXT]) {
  const option_usual usual = usual_of(form, row);
  const char *value = text_if(usual.usual != NULL, usual.usual),
             *more = text_if(usual.else_usual != NULL, usual.else_usual);
  if (usual.usual == NULL && usual.else_usual == NULL)
    snprintf(text, HELP_TEXT, "%s", usual.help);
  else
    snprintf(text, HELP_TEXT, "%s (default%s %s%s%s)", usual.help,
             text_if(usual.usual == NULL, ":"), value,
             text_if(usual.usual != NULL && usual.else_usual != NULL, "; "), more);
  add_names(row, text);
  return text;
}

/* ---- Help */

/* "  -o, --output OUT" */
static int write_head(const option_row *row, char text[80]) {
  const char letter[] = {'-', row->letter, ',', ' ', '\0'};
  const char *argument = text_or(argument_of(row), "");
  if (is_long_list(argument))
    argument = short_list(argument);
  return snprintf(text, 80, "  %s--%s%s%s", row->letter != 0 ? letter : "", row->name,
                  text_if(argument[0] != '\0', " "), argument);
}

/* The help beside the head, or below it where that is long. */
static void print_row(FILE *out, const command_form *form, const option_row *row) {
  char head[80], help[HELP_TEXT], text[HELP_TEXT + 80];
  const int width = write_head(row, head);
  if (width + 2 > OPTION_WIDTH)
    fprintf(out, "%s\n", head);
  snprintf(text, sizeof text, "%-*s%s", OPTION_WIDTH, width + 2 > OPTION_WIDTH ? " " : head,
           help_of(form, row, help));
  print_wrapped(out, text, HELP_WIDTH);
}

static void print_item(FILE *out, const command_form *form, const option_row *row) {
  char head[80], help[HELP_TEXT];
  const char *argument = argument_of(row);
  if (argument != NULL && is_long_list(argument))
    argument = short_list(argument);
  help_of(form, row, help);
  snprintf(head, sizeof head, "-%c, --%s", row->letter, row->name);
  manual_item(out, row->letter != 0 ? head : head + 4, argument, help);
}

/* Prints the options that are for one kind of rows, or all, by one of these. */
enum { EVERY_ROW = -1 };
typedef void print_option(FILE *out, const command_form *form, const option_row *row);
static void print_options(FILE *out, const command_form *form, int only, print_option *print) {
  for (size_t k = 0; form->options[k] != NULL; k++) {
    const option_row *row = form->options[k];
    if ((only == EVERY_ROW || row->only == only) && (form->is_physics || !row->is_physics))
      print(out, form, row);
  }
}

/* Whether the subcommand works on both kinds of rows. */
static bool has_kinds(const command_form *form) {
  size_t k = 0;
  while (form->options[k] != NULL && form->options[k] != &option_cushion)
    k++;
  return form->options[k] != NULL;
}

/* All options; `title` stands before those for a kind of rows. */
static void print_all_options(FILE *out, const command_form *form, const char *title,
                              print_option *print) {
  print_options(out, form, has_kinds(form) ? ANY_KIND : EVERY_ROW, print);
  print(out, form, &help_row);
  for (int kind = BALLS_ONLY; kind <= CUSHION_ONLY && has_kinds(form); kind++) {
    fprintf(out, title,
            kind == BALLS_ONLY ? "for collisions of two balls"
                               : "for impacts on a cushion, with --cushion");
    print_options(out, form, kind, print);
  }
}

static const command_form *with_all_rows(const command_form *form);

/* Names the options that only `carom help physics` describes. False where there are none. */
static bool list_physics(const command_form *form, char text[512]) {
  char names[400] = "";
  for (size_t k = 0; form->options[k] != NULL && !form->is_physics; k++)
    if (form->options[k]->is_physics)
      append(names, sizeof names, ", ", "--%s", form->options[k]->name);
  snprintf(text, 512, "`carom help physics` describes %s.\n", names);
  return names[0] != '\0';
}

static void print_help(FILE *out, const command_form *form) {
  char physics[512];
  fprintf(out, "usage: %s %s%s%s\n\nexample:\n  %s\n\n", program_name, form->name,
          text_if(form->usage[0] != '\0', " "), form->usage, form->example);
  print_wrapped(out, form->about, HELP_WIDTH);
  fputs("\noptions:\n", out);
  print_all_options(out, form, "\noptions %s:\n", print_row);
  putc('\n', out);
  if (list_physics(form, physics))
    print_wrapped(out, physics, HELP_WIDTH);
  print_wrapped(out, form->details, HELP_WIDTH);
}

void print_help_of(const command_form *form) {
  print_help(stdout, with_all_rows(form));
}

/* The same as a page of the manual. */
static void print_manual(FILE *out, const command_form *form) {
  static const char exits[] = "exit code: ";
  char text[4096], physics[512];
  const char *exit = strstr(form->details, exits);
  manual_begin(out, program_name, form->name, form->usage, form->about);
  snprintf(text, sizeof text, "%s\n%.*s", form->about, (int)(exit - form->details), form->details);
  manual_section(out, "DESCRIPTION", text);
  if (list_physics(form, physics))
    manual_section(out, "PHYSICS", physics);
  manual_section(out, "OPTIONS", "");
  print_all_options(out, form, ".SS Options %s\n", print_item);
  manual_end(out, exit + sizeof exits - 1, form->example);
}

int usage_hint(const command_form *form) {
  fprintf(stderr, "`%s %s --help` lists the arguments\n", program_name, form->name);
  return EXIT_USAGE;
}

/* The form with the rows of the library; its own stand for those of the same name. */
static const command_form *with_all_rows(const command_form *form) {
  static option_row
      of_library[2 * MOST_OF_LIBRARY]; /* of a form, at most two rows without a name */
  static const option_row *rows[MOST_ROWS];
  static command_form whole;
  int count = 0;
  option_row *next = of_library;
  for (int k = 0; form->options[k] != NULL; k++) {
    if (form->options[k]->name != NULL) {
      rows[count++] = form->options[k];
      continue;
    }
    const int more = rows_of(form->options[k], next);
    for (int j = 0; j < more; j++) {
      int match = 0;
      while (form->options[match] != NULL && (form->options[match]->name == NULL ||
                                              !same_text(form->options[match]->name, next[j].name)))
        match++;
      if (form->options[match] == NULL)
        rows[count++] = &next[j];
    }
    next += more;
  }
  if (count >= MOST_ROWS)
    abort(); /* a form with more options than the tables hold */
  whole = *form;
  whole.options = rows;
  return &whole;
}

static const option_row *row_of(const command_form *form, int code) {
  for (int k = 0; form->options[k] != NULL; k++)
    if (code == FIRST_CODE + k || (code != 0 && code == form->options[k]->letter))
      return form->options[k];
  return code == help_row.letter ? &help_row : NULL;
}

/* What getopt wants to know of the table. */
static void list_options(const command_form *form, struct option longs[MOST_LONGS],
                         char shorts[2 * MOST_ROWS]) {
  int k = 0;
  for (; form->options[k] != NULL; k++) {
    const option_row *row = form->options[k];
    longs[k] =
        (struct option){row->name, argument_of(row) != NULL ? required_argument : no_argument, NULL,
                        FIRST_CODE + k};
    if (row->letter != 0)
      strcat(strncat(shorts, &row->letter, 1), argument_of(row) != NULL ? ":" : "");
  }
  if (form->options[k] != NULL) {
    complain("MOST_ROWS has no room for --%s", form->options[k]->name);
    abort();
  }
  longs[k] = (struct option){help_row.name, no_argument, NULL, help_row.letter};

  /* the other names, of the first option that the form has */
  const int options = k;
  int count = k + 1;
  const char *last = "";
  for (size_t n = 0; n < COUNT_OF(also); n++)
    for (k = 0; k < options; k++)
      if (same_text(longs[k].name, also[n].name) && !same_text(last, also[n].alias) &&
          !has_option(form, also[n].alias)) {
        longs[count] = longs[k];
        longs[count++].name = last = also[n].alias;
      }
}

/* Lists the options of a form that begin as a text does; returns how many. */
static int list_beginnings(const command_form *form, const char *text, char list[128]) {
  int count = 0;
  list[0] = '\0';
  for (int k = 0; form->options[k] != NULL; k++)
    if (strncmp(text + 2, form->options[k]->name, strlen(text + 2)) == 0) {
      append(list, 128, ", ", "--%s", form->options[k]->name);
      count++;
    }
  return count;
}

/* Complains of an option that the subcommand does not have; its value may follow at "=". */
static void complain_unknown(const command_form *form, char *text) {
  char words[32 * MOST_ROWS] = "--help", list[HINT_TEXT];
  text[strcspn(text, "=")] = '\0';
  for (size_t k = 0; k < COUNT_OF(advices); k++)
    if (same_text(text + 2, advices[k].alias) && has_option(form, advices[k].name)) {
      complain("%s: no such option of %s; %s", text, form->name, advices[k].advice);
      return;
    }
  for (int k = 0; form->options[k] != NULL; k++)
    append(words, sizeof words, "|", "--%s", form->options[k]->name);
  if (list_beginnings(form, text, list) > 1)
    complain("%s: several options of %s begin like this; try one of %s", text, form->name, list);
  else if (is_nearly(text, words))
    complain("%s: no such option of %s; try %s (`%s %s --help` lists them)", text, form->name,
             words_to_try(text, words, list), program_name, form->name);
  else
    complain("%s: no such option of %s; try `%s %s --help`, which lists them", text, form->name,
             program_name, form->name);
}

/* A value to suggest for an option: its example, its default, or one of its words. */
static const char *value_to_try(const command_form *form, const option_row *row,
                                char list[HINT_TEXT]) {
  const char *usual = usual_of(form, row).usual;
  if (row->example != NULL)
    return row->example;
  if (usual != NULL)
    return usual;
  return words_to_try("", argument_of(row), list);
}

/* Complains of what getopt_long() could not read: `option` is what it returned. */
static void complain_unread(const command_form *form, int option, char **argv) {
  const option_row *row = row_of(form, optopt);
  char *text = argv[optind - 1], list[HINT_TEXT];
  const char *equals = strchr(text, '=');
  if (option == ':' && row != NULL) /* a value is missing */
    complain("--%s: it needs a value; try --%s %s (see --help)", row->name, row->name,
             value_to_try(form, row, list));
  else if (row != NULL && equals != NULL)
    complain("--%s '%.40s': it takes no value; try --%s alone (see --help)", row->name, equals + 1,
             row->name);
  else if (optopt == 0 && strncmp(text, "--", 2) == 0)
    complain_unknown(form, text);
  else
    complain("-%c: no such option of %s; try `%s %s --help`, which lists them", optopt, form->name,
             program_name, form->name);
}

/* Whether the options that were given are for the kind of rows that is asked for; complains
 * where one is not. */
static bool are_for_kind(const command_form *form, const bool is_set[MOST_ROWS], const void *job) {
  for (int k = 0; form->options[k] != NULL; k++) {
    const option_row *row = form->options[k];
    if (!is_set[k] || row->only == ANY_KIND ||
        (row->only == CUSHION_ONLY) == ((const shared_options *)job)->cushion)
      continue;
    complain("--%s: no option for these rows; give it %s --cushion", row->name,
             row->only == CUSHION_ONLY ? "with" : "without");
    return false;
  }
  return true;
}

/* Prints what may stand where `word` is being typed, a line each: values of the option before
 * it, or options. Upper-case words of an argument, such as OUT, are no values. */
static void complete(const command_form *form, const char *previous, const char *word) {
  for (int k = 0; form->options[k] != NULL; k++) {
    const char *value = argument_of(form->options[k]);
    if (value == NULL || strncmp(previous, "--", 2) != 0 ||
        !same_text(previous + 2, form->options[k]->name))
      continue;
    for (size_t size; *value != '\0'; value += size + (value[size] == '|')) {
      size = strcspn(value, "|");
      if (!is_upper(*value))
        printf("%.*s\n", (int)size, value);
    }
    return;
  }
  for (int k = 0; form->options[k] != NULL && (word[0] == '-' || form->files == NO_FILES); k++)
    printf("--%s\n", form->options[k]->name);
}

/* Sets the fields; -1, or an exit code. */
static int parse_options(const command_form *form, int argc, char **argv, void *job) {
  struct option longs[MOST_LONGS] = {0};
  char shorts[2 * MOST_ROWS] = ":h", whole[WHOLE_TEXT];
  bool is_set[MOST_ROWS] = {false};
  int option;
  if (argc == 4 && same_text(argv[1], "--complete")) {
    complete(form, argv[2], argv[3]);
    return EXIT_GOOD;
  }
  if (argc == 2 && same_text(argv[1], "--manual")) { /* for manual.cmake */
    print_manual(stdout, form);
    return EXIT_GOOD;
  }
  ((shared_options *)job)->form = form;
  for (int k = 0; form->options[k] != NULL; k++)
    if (!form->options[k]->is_list)
      set_usual(form, form->options[k], job);
  list_options(form, longs, shorts);
  opterr = 0; /* complain_unread() says what is wrong */
  while ((option = getopt_long(argc, argv, shorts, longs, NULL)) != -1) {
    const option_row *row = option == ':' ? NULL : row_of(form, option);
    if (row == NULL) {
      complain_unread(form, option, argv);
      return EXIT_USAGE;
    }
    if (row == &help_row) {
      print_help(stdout, form);
      return EXIT_GOOD;
    }
    if (optarg != NULL && optind < argc && is_torn(row, optarg, argv[optind], whole)) {
      complain("--%s '%.20s %.20s': a value has no blanks; try --%s %s (see --help)", row->name,
               optarg, argv[optind], row->name, whole);
      return EXIT_USAGE;
    }
    if (!row->set(row, optarg, (char *)job + row->field))
      return EXIT_USAGE;
    for (int k = 0; k < MOST_ROWS && form->options[k] != NULL; k++)
      is_set[k] |= form->options[k] == row;
  }
  return are_for_kind(form, is_set, job) && numbers_are_read(job) ? -1 : usage_hint(form);
}

int parse_arguments(const command_form *form, int argc, char **argv, void *job, const char **file) {
  form = with_all_rows(form);
  const int code = parse_options(form, argc, argv, job), files = argc - optind;
  if (code >= 0)
    return code;
  if (form->files == NO_FILES && files > 0)
    complain("'%.80s': %s takes no file; give its options only", argv[optind], form->name);
  else if (form->files == ONE_FILE && files == 0)
    complain("%s needs a file; give its name", form->name);
  else if (files > 1)
    complain("'%.80s': %s takes one file, and %d are given", argv[optind + 1], form->name, files);
  else if (files == 1 && argv[optind][0] == '\0')
    complain("'': no name of a file; give one to %s", form->name);
  else {
    if (file != NULL)
      *file = files == 1 ? argv[optind] : NULL;
    return -1;
  }
  return usage_hint(form);
}
