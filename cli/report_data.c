/* The report's data: every row of lab/figures/data.def becomes a CSV in its folder. */
#include "cases.h"
#include "command.h"
#include "kernel.h"
#include "message.h"
#include "output.h"
#include "place.h"
#include "report.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct data_row {
  const char *name;
  int share;                               /* of the budget, in per cent */
  const char *command;                     /* measured */
  const char *source, *installed, *stored; /* stored: folders and the file's name */
  bool (*derive)(const report *r, FILE *out);
} data_row;

static const data_row rows[DATA_COUNT] = {
#define MEASURED(name, share, command) {#name, share, command, NULL, NULL, NULL, NULL},
#define STORED(name, folder, file) \
  {#name, 0, NULL, CAROM_SOURCE_LAB "/" folder "/results", CAROM_INSTALLED_SHARE "/" folder, file, NULL},
#define DERIVED(name, function) {#name, 0, NULL, NULL, NULL, NULL, function},
#include "data.def"
#undef MEASURED
#undef STORED
#undef DERIVED
};

const char *report_data_name(int k) {
  return rows[k].name;
}

const char *report_data_command(int k) {
  return rows[k].command;
}

bool report_path(char path[PATH_MAX], const char *folder, const char *name, const char *extension) {
  if (snprintf(path, PATH_MAX, "%s/%s%s", folder, name, extension) < PATH_MAX)
    return true;
  complain("%s: the name is too long", folder);
  return false;
}

static bool copy_file(const char *from, const char *to) {
  char one[PATH_MAX], other[PATH_MAX];
  if (realpath(from, one) != NULL && realpath(to, other) != NULL && strcmp(one, other) == 0)
    return true;
  FILE *in = fopen(from, "rb");
  if (in == NULL) {
    complain("cannot read %s: %s", from, strerror(errno));
    return false;
  }
  FILE *out = output_open(to);
  char block[65536];
  for (size_t size; out != NULL && (size = fread(block, 1, sizeof block, in)) > 0;)
    fwrite(block, 1, size, out);
  const bool good = !ferror(in);
  fclose(in);
  if (out == NULL)
    return false;
  if (good)
    return output_commit();
  complain("cannot read %s", from);
  output_abandon();
  return false;
}

/* ---- Measuring: a command of carom, in this process */

enum { MOST_WORDS = 32, WORD_SIZE = PATH_MAX };

typedef struct command_line {
  int count;
  char word[MOST_WORDS][WORD_SIZE];
} command_line;

static void add_word(command_line *line, const char *text) {
  if (line->count < MOST_WORDS - 1)
    snprintf(line->word[line->count++], WORD_SIZE, "%s", text);
}

static void add_words(command_line *line, const char *option, const char *value) {
  add_word(line, option);
  add_word(line, value);
}

/* The library's kernels, "euler,exact". */
static void list_solvers(char text[WORD_SIZE]) {
  const kernel *one;
  text[0] = '\0';
  for (size_t k = 0; (one = kernel_at(k)) != NULL; k++)
    if (!one->is_rung && strlen(text) + strlen(one->name) + 2 < WORD_SIZE)
      strcat(strcat(text, text[0] != '\0' ? "," : ""), one->name);
}

static void add_command(command_line *line, const char *command) {
  static const char solvers[] = "{solvers}";
  char copy[WORD_SIZE], list[WORD_SIZE], *rest;
  snprintf(copy, sizeof copy, "%s", command);
  list_solvers(list);
  for (char *word = strtok_r(copy, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest))
    if (strncmp(word, solvers, sizeof solvers - 1) == 0) {
      add_word(line, list);
      strncat(line->word[line->count - 1], word + sizeof solvers - 1, WORD_SIZE - strlen(list) - 1);
    } else
      add_word(line, word);
}

static int run_command(command_line *line) {
  char *argv[MOST_WORDS + 1] = {NULL};
  for (int k = 0; k < line->count; k++)
    argv[k] = line->word[k];
  optind = 0; /* begins getopt anew */
#define COMMAND_RUN(name, text)    \
  if (strcmp(argv[0], #name) == 0) \
    return command_##name(line->count, argv);
  COMMAND_LIST(COMMAND_RUN)
#undef COMMAND_RUN
  complain("no command '%s'", argv[0]);
  return EXIT_USAGE;
}

static bool measure(const report *r, const data_row *row, const char *path) {
  command_line line = {0};
  add_command(&line, row->command);
  if (row->share > 0) {
    char seconds[32];
    snprintf(seconds, sizeof seconds, "%.4g", r->budget * row->share / 100.0);
    add_words(&line, "--budget", seconds);
  }
  printf("%s.csv: carom", row->name);
  for (int k = 0; k < line.count; k++)
    printf(" %s", line.word[k]);
  printf("\n");
  fflush(stdout);
  if (r->references != NULL)
    add_words(&line, "--data", r->references);
  add_words(&line, "--output", path);
  return run_command(&line) != EXIT_USAGE;
}

/* ---- All rows */

static bool derive(const report *r, const data_row *row, const char *path) {
  char *text = NULL;
  size_t size;
  FILE *memory = open_memstream(&text, &size);
  bool good = memory != NULL && row->derive(r, memory);
  if (memory != NULL)
    fclose(memory);
  FILE *out = good ? output_open(path) : NULL;
  if (out != NULL)
    fwrite(text, 1, size, out);
  free(text);
  return out != NULL && output_commit();
}

static bool obtain(const report *r, const data_row *row, const char *path) {
  char from[PATH_MAX], folder[PATH_MAX];
  if (row->derive != NULL)
    return derive(r, row, path);
  if (r->from != NULL)
    return report_path(from, r->from, row->name, ".csv") && copy_file(from, path);
  if (row->command != NULL)
    return measure(r, row, path);
  return report_path(from, place_find(row->source, row->installed, folder), row->stored, "") && copy_file(from, path);
}

void report_collect(report *r) {
  for (int k = 0; k < DATA_COUNT; k++) {
    char path[PATH_MAX];
    if (report_path(path, r->folder, rows[k].name, ".csv") && obtain(r, &rows[k], path))
      sheet_read(path, &r->data[k]);
    else if (rows[k].derive == NULL)
      complain("the report goes on without %s.csv", rows[k].name);
  }
}
