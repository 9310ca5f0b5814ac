/* The options of a subcommand: help and parsing from one table. What the fields are is known to
 * fields.c. */
#include "program/options.h"

#include "program/command.h"
#include "program/manual.h"
#include "program/message.h"
#include "program/words.h"

#include <getopt.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROWS = 64, MOST_LONGS = MOST_ROWS + 24, FIRST_CODE = UCHAR_MAX + 1 };
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
    {"english", "tip", "--tip has it: --tip 50%,0 is half of the possible right english"},
    {"side", "tip", "--tip has it: --tip 50%,0 is half of the possible right english"},
    {"spin", "tip", "--tip has it: --tip low is the most draw, --tip 0,0.2 some follow"},
    {"pivot", "tip",
     "`carom shoot` reports the bridge for back-hand english of each --tip with "
     "side: --tip 0.3,0 --with end_mass=7g"},
    {"pocket-size", "table", "a measure of --table has it: --table 9ft,corner=4.25in"},
    {"pockets", "table", "a measure of --table has it: --table 9ft,corner=4.25in"},
    {"with", "friction",
     "--friction, --restitution, --mu-slide, --roll, --mass and --radius say it"},
    {"jump", "elevation", "--elevation 40 --speed 4 jumps; the report says how high and far"},
    {"angle", "aim", "--aim is the direction of the cue, --cut the angle at the ball"},
    {"from", "cue", "--cue is where the cue ball lies"}};

static bool has_option(const command_form *form, const char *name) {
  for (size_t k = 0; form->options[k] != NULL; k++)
    if (same_text(form->options[k]->name, name))
      return true;
  return false;
}

/* ---- Defaults */

/* The default of a row in a form. */
static option_usual usual_of(const command_form *form, const option_row *row) {
  for (const option_usual *usual = form->usual; usual != NULL && usual->name != NULL; usual++)
    if (same_text(usual->name, row->name))
      return *usual;
  return (option_usual){row->name, row->usual, row->else_usual};
}

/* Reads the default of a row into its field. */
static void set_usual(const command_form *form, const option_row *row, void *job) {
  static char texts[MOST_ROWS][80]; /* which fields may keep */
  static int used;
  const char *usual = usual_of(form, row).usual;
  if (usual == NULL)
    return;
  char *text = texts[used++ % MOST_ROWS];
  snprintf(text, sizeof texts[0], "%s", usual);
  if (!row->set(row, text, (char *)job + row->field))
    abort(); /* a default that its own option refuses */
}

void fill_usual(void *job, const option_row *row) {
  set_usual(((const shared_options *)job)->form, row, job);
}

/* The help with the default behind it: "the table (default 9ft)". */
static const char *help_of(const command_form *form, const option_row *row, char text[1024]) {
  const option_usual usual = usual_of(form, row);
  const char *value = text_if(usual.usual != NULL, usual.usual),
             *more = text_if(usual.else_usual != NULL, usual.else_usual);
  if (usual.usual == NULL && usual.else_usual == NULL)
    return row->help;
  snprintf(text, 1024, "%s (default%s %s%s%s)", row->help, text_if(usual.usual == NULL, ":"), value,
           text_if(usual.usual != NULL && usual.else_usual != NULL, "; "), more);
  return text;
}

/* ---- Help */

/* "  -o, --output OUT"; choices that do not fit into a line are listed in the details. */
static int write_head(const option_row *row, char text[80]) {
  const char letter[] = {'-', row->letter, ',', ' ', '\0'};
  const char *argument = argument_of(row) != NULL ? argument_of(row) : "";
  if (strlen(argument) > HELP_WIDTH - OPTION_WIDTH)
    argument = "NAME";
  return snprintf(text, 80, "  %s--%s%s%s", row->letter != 0 ? letter : "", row->name,
                  text_if(argument[0] != '\0', " "), argument);
}

/* The help beside the head, or below it where that is long. */
static void print_row(FILE *out, const command_form *form, const option_row *row) {
  char head[80], help[1024], text[1200];
  const int width = write_head(row, head);
  if (width + 2 > OPTION_WIDTH)
    fprintf(out, "%s\n", head);
  snprintf(text, sizeof text, "%-*s%s", OPTION_WIDTH, width + 2 > OPTION_WIDTH ? " " : head,
           help_of(form, row, help));
  print_wrapped(out, text, HELP_WIDTH);
}

static void print_item(FILE *out, const command_form *form, const option_row *row) {
  char head[80], help[1024];
  snprintf(head, sizeof head, "-%c, --%s", row->letter, row->name);
  manual_item(out, row->letter != 0 ? head : head + 4, argument_of(row), help_of(form, row, help));
}

/* Prints the options that are for one kind of rows, or all, by one of these. */
enum { EVERY_ROW = -1 };
typedef void print_option(FILE *out, const command_form *form, const option_row *row);
static void print_options(FILE *out, const command_form *form, int only, print_option *print) {
  for (size_t k = 0; form->options[k] != NULL; k++)
    if (only == EVERY_ROW || form->options[k]->only == only)
      print(out, form, form->options[k]);
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

static void print_help(FILE *out, const command_form *form) {
  fprintf(out, "usage: %s %s%s%s\n\n", program_name, form->name,
          text_if(form->usage[0] != '\0', " "), form->usage);
  print_wrapped(out, form->about, HELP_WIDTH);
  fputs("\noptions:\n", out);
  print_all_options(out, form, "\noptions %s:\n", print_row);
  putc('\n', out);
  print_wrapped(out, form->details, HELP_WIDTH);
  fprintf(out, "\nexample:\n  %s\n", form->example);
}

/* The same as a page of the manual. */
static void print_manual(FILE *out, const command_form *form) {
  static const char exits[] = "exit code: ";
  char text[4096];
  const char *exit = strstr(form->details, exits);
  manual_begin(out, program_name, form->name, form->usage, form->about);
  snprintf(text, sizeof text, "%s\n%.*s", form->about, (int)(exit - form->details), form->details);
  manual_section(out, "DESCRIPTION", text);
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
  for (; form->options[k] != NULL && k < MOST_ROWS - 3; k++) {
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

/* What an option that there is not may have been; its value may stand behind it. Nothing of the
 * beginnings of several. */
static void hint_at_option(const command_form *form, char *text) {
  char words[32 * MOST_ROWS] = "--help", hint[HINT_TEXT];
  text[strcspn(text, "=")] = '\0';
  for (size_t k = 0; k < COUNT_OF(advices); k++)
    if (same_text(text + 2, advices[k].alias) && has_option(form, advices[k].name)) {
      fprintf(stderr, "%s %s: %s\n", program_name, form->name, advices[k].advice);
      return;
    }
  for (int k = 0; form->options[k] != NULL; k++) {
    append(words, sizeof words, "|", "--%s", form->options[k]->name);
    if (strncmp(text + 2, form->options[k]->name, strlen(text + 2)) == 0)
      return;
  }
  if (did_you_mean(text, words, hint)[0] != '\0')
    fprintf(stderr, "%s %s: %s\n", program_name, form->name, hint + 2);
}

/* Whether the options that were given are for the kind of rows that is asked for; complains
 * where one is not. */
static bool are_for_kind(const command_form *form, const bool is_set[MOST_ROWS], const void *job) {
  for (int k = 0; form->options[k] != NULL; k++) {
    const option_row *row = form->options[k];
    if (!is_set[k] || row->only == ANY_KIND ||
        (row->only == CUSHION_ONLY) == ((const shared_options *)job)->cushion)
      continue;
    complain("%s: option '--%s' goes %s --cushion", form->name, row->name,
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
      if (*value < 'A' || *value > 'Z')
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
  char shorts[2 * MOST_ROWS] = "h", name[80];
  bool is_set[MOST_ROWS] = {false};
  int option;
  /* getopt complains in the name of the subcommand. */
  snprintf(name, sizeof name, "%s %s", program_name, form->name);
  argv[0] = name;
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
  while ((option = getopt_long(argc, argv, shorts, longs, NULL)) != -1) {
    const option_row *row = row_of(form, option);
    if (row == NULL && optopt == 0 && optind > 1 && strncmp(argv[optind - 1], "--", 2) == 0)
      hint_at_option(form, argv[optind - 1]);
    if (row == NULL)
      return usage_hint(form);
    if (row == &help_row) {
      print_help(stdout, form);
      return EXIT_GOOD;
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
    complain("%s takes no files, but got '%s'", form->name, argv[optind]);
  else if (form->files == ONE_FILE && files == 0)
    complain("%s needs the name of a file", form->name);
  else if (files > 1)
    complain("%s takes one file, but got %d", form->name, files);
  else if (files == 1 && argv[optind][0] == '\0')
    complain("%s needs the name of a file, and got an empty one", form->name);
  else {
    if (file != NULL)
      *file = files == 1 ? argv[optind] : NULL;
    return -1;
  }
  return usage_hint(form);
}
