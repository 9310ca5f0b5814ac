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

static const option_row help_row = {.name = "help", .letter = 'h', .help = "this text"};
static const option_row manual_row = {.name = "man", .help = ""}; /* for the build, and not in the help */

/* "  -o, --output OUT" */
static int write_head(const option_row *row, char text[80]) {
  const char letter[] = {'-', row->letter, ',', ' ', '\0'};
  return snprintf(text, 80, "  %s--%s%s%s", row->letter != 0 ? letter : "", row->name, row->argument != NULL ? " " : "",
                  row->argument != NULL ? row->argument : "");
}

/* The first line of the help beside the head, the others below it. */
static void print_row(const option_row *row, int width) {
  char head[80];
  printf("%*s", -width, (write_head(row, head), head));
  for (const char *at = row->help; *at != '\0'; at++)
    printf(*at == '\n' ? "\n%*s" : "%c", *at == '\n' ? width : *at, "");
  putchar('\n');
}

/* Text for roff: what its lines would take for requests and escapes is put right. */
static void print_roff(const char *text) {
  for (bool first = true; *text != '\0'; first = *text == '\n', text++) {
    if (first && (*text == '.' || *text == '\''))
      fputs("\\&", stdout);
    if (*text == '\\')
      fputs("\\e", stdout);
    else if (*text == '-')
      fputs("\\-", stdout);
    else
      putchar(*text);
  }
  putchar('\n');
}

/* The page carom-NAME(1) of the manual, from the same table. */
static void print_manual(const command_form *form) {
  char head[80];
  printf(".TH %s\\-%s 1 \"\" \"carom %s\"\n.SH NAME\n%s\\-%s \\- part of %s(1)\n.SH SYNOPSIS\n", program_name, form->name,
         carom_version(), program_name, form->name, program_name);
  printf(".B %s %s\n", program_name, form->name);
  print_roff(form->usage);
  puts(".SH DESCRIPTION");
  print_roff(form->about);
  puts(".SH OPTIONS");
  for (size_t k = 0; form->options[k] != NULL; k++) {
    write_head(form->options[k], head);
    puts(".TP");
    print_roff(head + 2);
    print_roff(form->options[k]->help);
  }
  puts(".SH DETAILS\n.nf");
  print_roff(form->details);
  puts(".fi\n.SH EXAMPLE\n.nf");
  print_roff(form->example);
  puts(".fi");
}

static void print_help(const command_form *form) {
  int width = 0;
  char head[80];
  for (size_t k = 0; form->options[k] != NULL; k++) {
    const int used = write_head(form->options[k], head) + 2;
    width = used > width ? used : width;
  }
  printf("usage: %s %s%s%s\n\n%s\noptions:\n", program_name, form->name, form->usage[0] != '\0' ? " " : "", form->usage,
         form->about);
  for (size_t k = 0; form->options[k] != NULL; k++)
    print_row(form->options[k], width);
  print_row(&help_row, width);
  printf("\n%s\nexample:\n  %s\n", form->details, form->example);
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

/* Sets the fields; -1, or an exit code. */
static int parse_options(const command_form *form, int argc, char **argv, void *job) {
  struct option longs[MOST_ROWS] = {0};
  char shorts[2 * MOST_ROWS] = ":h"; /* the colon: a missing argument is told apart */
  int option;
  opterr = 0;
  list_options(form, longs, shorts);
  while ((option = getopt_long(argc, argv, shorts, longs, NULL)) != -1) {
    const option_row *row = row_of(form, option);
    if (row == NULL)
      return refuse(form, argv, option, longs);
    if (row == &help_row || row == &manual_row) {
      (row == &help_row ? print_help : print_manual)(form);
      return EXIT_GOOD;
    }
    if (!row->set(row, optarg, (char *)job + row->field))
      return EXIT_USAGE;
  }
  return -1;
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
