/* The options of a subcommand: help and parsing from one table. What the fields are is known to fields.c. */
#include "options.h"

#include "command.h"
#include "message.h"
#include "suggest.h"

#include <getopt.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

enum { MOST_ROWS = 32, MANUAL_CODE = UCHAR_MAX + 1, FIRST_CODE };
enum { HELP_WIDTH = 80, OPTION_WIDTH = 23, TABLE_LEAST = 10, TABLE_MOST = 32 }; /* columns of the help */

static const option_row help_row = {.name = "help", .letter = 'h', .help = "this text"};
static const option_row manual_row = {.name = "man", .help = ""}; /* for the build, and not in the help */

/* ---- Help and manual */

/* The size of a paragraph: of a line and those that go on with it, far to the right or, as the line, without blanks before it.
 */
static size_t paragraph_size(const char *text) {
  const size_t own = strspn(text, " ");
  size_t size = strcspn(text, "\n");
  while (size > 0 && text[size] != '\0' && text[size + 1] != '\0' && text[size + 1] != '\n') {
    const size_t next = strspn(text + size + 1, " ");
    if (next < TABLE_LEAST && (next > 0 || own > 0))
      break;
    size += 1 + strcspn(text + size + 1, "\n");
  }
  return size;
}

/* Where the further lines of a paragraph begin: below the text behind its first word where blanks make a table of it. */
static int hanging_indent(const char *line, size_t size) {
  const int own = (int)strspn(line, " ");
  int indent = own;
  for (int k = own; k < TABLE_MOST && (size_t)k + 2 < size && own > 0 && line[k] != '\n'; k++)
    if (line[k] == ' ' && line[k + 1] == ' ')
      indent = k + 2;
  return indent;
}

/* Prints paragraphs, each broken between words where it is longer than a terminal is wide. */
static void print_wrapped(FILE *out, const char *text) {
  while (*text != '\0') {
    const size_t size = paragraph_size(text);
    const int indent = hanging_indent(text, size);
    int column = 0;
    for (size_t k = 0; k < size;) {
      /* A word with the blanks before it; the end of a line is one blank. */
      const size_t blanks = strspn(text + k, " \n"), word = strcspn(text + k + blanks, " \n");
      const bool joins = memchr(text + k, '\n', blanks) != NULL;
      const int before = joins ? 1 : (int)blanks;
      const bool breaks = column > indent && column + before + (int)word > HELP_WIDTH;
      fprintf(out, "%s%*s%.*s", breaks ? "\n" : "", breaks ? indent : before, "", (int)word, text + k + blanks);
      column = (breaks ? indent : column + before) + (int)word;
      k += blanks + word;
    }
    putc('\n', out);
    text += size + (text[size] == '\n');
  }
}

/* "  -o, --output OUT" */
static int write_head(const option_row *row, char text[80]) {
  const char letter[] = {'-', row->letter, ',', ' ', '\0'};
  return snprintf(text, 80, "  %s--%s%s%s", row->letter != 0 ? letter : "", row->name, row->argument != NULL ? " " : "",
                  row->argument != NULL ? row->argument : "");
}

/* The help beside the head, or below it where that is long. */
static void print_row(FILE *out, const option_row *row) {
  char head[80], text[1024];
  const int width = write_head(row, head);
  if (width + 2 > OPTION_WIDTH)
    fprintf(out, "%s\n", head);
  snprintf(text, sizeof text, "%-*s%s", OPTION_WIDTH, width + 2 > OPTION_WIDTH ? " " : head, row->help);
  for (char *end = text; (end = strchr(end, '\n')) != NULL;)
    *end = ' ';
  print_wrapped(out, text);
}

/* Prints the options that are for one kind of rows, or all. */
enum { EVERY_ROW = -1 };
static void print_options(FILE *out, const command_form *form, int only) {
  for (size_t k = 0; form->options[k] != NULL; k++)
    if (only == EVERY_ROW || form->options[k]->only == only)
      print_row(out, form->options[k]);
}

/* Whether the subcommand works on both kinds of rows. */
static bool has_kinds(const command_form *form) {
  size_t k = 0;
  while (form->options[k] != NULL && form->options[k]->only != CUSHION_ONLY)
    k++;
  return form->options[k] != NULL;
}

static void print_help(FILE *out, const void *of) {
  const command_form *form = of;
  fprintf(out, "usage: %s %s%s%s\n\n", program_name, form->name, form->usage[0] != '\0' ? " " : "", form->usage);
  print_wrapped(out, form->about);
  fputs("\noptions:\n", out);
  print_options(out, form, has_kinds(form) ? ANY_KIND : EVERY_ROW);
  print_row(out, &help_row);
  if (has_kinds(form)) {
    fputs("\noptions for collisions of two balls:\n", out);
    print_options(out, form, BALLS_ONLY);
    fputs("\noptions for impacts on a cushion, with --cushion:\n", out);
    print_options(out, form, CUSHION_ONLY);
  }
  putc('\n', out);
  print_wrapped(out, form->details);
  fprintf(out, "\nexample:\n  %s\n", form->example);
}

int usage_hint(const command_form *form) {
  fprintf(stderr, "`%s %s --help` tells the arguments\n", program_name, form->name);
  return EXIT_USAGE;
}

static const option_row *row_of(const command_form *form, int code) {
  for (int k = 0; form->options[k] != NULL; k++)
    if (code == FIRST_CODE + k || (code != 0 && code == form->options[k]->letter))
      return form->options[k];
  return code == help_row.letter ? &help_row : code == MANUAL_CODE ? &manual_row : NULL;
}

/* What getopt wants to know of the table. */
static void list_options(const command_form *form, struct option longs[MOST_ROWS], char shorts[2 * MOST_ROWS]) {
  int k = 0;
  for (; form->options[k] != NULL && k < MOST_ROWS - 3; k++) {
    const option_row *row = form->options[k];
    longs[k] = (struct option){row->name, row->argument != NULL ? required_argument : no_argument, NULL, FIRST_CODE + k};
    if (row->letter != 0)
      strcat(strncat(shorts, &row->letter, 1), row->argument != NULL ? ":" : "");
  }
  longs[k] = (struct option){help_row.name, no_argument, NULL, help_row.letter};
  longs[k + 1] = (struct option){manual_row.name, no_argument, NULL, MANUAL_CODE};
}

/* Whether `text`, "--name" or "--name=argument", is the beginning of a name. */
static bool begins(const char *text, const char *name) {
  return strncmp(text + 2, name, strcspn(text + 2, "=")) == 0;
}

/* "--text" is none of the options, or the beginning of several: says which may be meant. */
static void complain_of_name(const command_form *form, const char *text, const struct option *longs) {
  char name[40] = "", which[200] = "";
  const char *meant = NULL;
  int beginnings = 0;
  snprintf(name, sizeof name, "%.*s", (int)strcspn(text + 2, "="), text + 2);
  for (const struct option *row = longs; row->name != NULL; row++) {
    if (row->val == MANUAL_CODE)
      continue;
    if (begins(text, row->name)) {
      const size_t used = strlen(which);
      snprintf(which + used, sizeof which - used, "%s--%s", beginnings++ > 0 ? ", " : "", row->name);
    }
    if (meant == NULL && resembles(name, row->name))
      meant = row->name;
  }
  if (beginnings > 1)
    complain("%s: option '%s' may be %s", form->name, text, which);
  else if (meant != NULL)
    complain("%s: unrecognized option '%s'; is '--%s' meant?", form->name, text, meant);
  else
    complain("%s: unrecognized option '%s'", form->name, text);
}

/* What getopt did not take. */
static int refuse(const command_form *form, char **argv, int found, const struct option *longs) {
  const option_row *row = row_of(form, optopt);
  if (found == ':')
    complain("%s: option '%s' needs an argument", form->name, argv[optind - 1]);
  else if (optopt == 0)
    complain_of_name(form, argv[optind - 1], longs);
  else if (row != NULL)
    complain("%s: option '--%s' takes no argument", form->name, row->name);
  else
    complain("%s: invalid option '-%c'", form->name, optopt);
  return usage_hint(form);
}

/* Whether the options that were given are for the kind of rows that is asked for; complains where one is not. */
static bool are_for_kind(const command_form *form, const bool given[MOST_ROWS], const void *job) {
  for (int k = 0; form->options[k] != NULL; k++) {
    const option_row *row = form->options[k];
    if (!given[k] || row->only == ANY_KIND || (row->only == CUSHION_ONLY) == ((const shared_options *)job)->cushion)
      continue;
    complain("%s: option '--%s' goes %s --cushion", form->name, row->name, row->only == CUSHION_ONLY ? "with" : "without");
    return false;
  }
  return true;
}

/* Sets the fields; -1, or an exit code. */
static int parse_options(const command_form *form, int argc, char **argv, void *job) {
  struct option longs[MOST_ROWS] = {0};
  char shorts[2 * MOST_ROWS] = ":h"; /* the colon: a missing argument is told apart */
  bool given[MOST_ROWS] = {false};
  int option;
  opterr = 0;
  list_options(form, longs, shorts);
  while ((option = getopt_long(argc, argv, shorts, longs, NULL)) != -1) {
    const option_row *row = row_of(form, option);
    if (row == NULL)
      return refuse(form, argv, option, longs);
    if (row == &help_row || row == &manual_row) {
      char name[64];
      snprintf(name, sizeof name, "%s-%s", program_name, form->name);
      if (row == &help_row)
        print_help(stdout, form);
      else
        print_manual(name, form->about, print_help, form);
      return EXIT_GOOD;
    }
    if (!row->set(row, optarg, (char *)job + row->field))
      return EXIT_USAGE;
    for (int k = 0; k < MOST_ROWS && form->options[k] != NULL; k++)
      given[k] |= form->options[k] == row;
  }
  return are_for_kind(form, given, job) ? -1 : usage_hint(form);
}

int parse_arguments(const command_form *form, int argc, char **argv, void *job, const char **file) {
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
