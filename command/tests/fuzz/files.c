/* Gives the command `carom` files made of the bytes of a fuzzer: CSV, .npy and JSON Lines, of
 * collisions, impacts on cushions and shots. The first byte chooses the command. Aborts if an
 * exit code is none of the command's, if the output depends on the number of threads, or if a
 * file is refused and yet something is written. Crashes, hangs and undefined behaviour are for
 * the fuzzer and the sanitizers to see. */
#include "program/command.h"
#include "program/message.h"
#include "subcommands.h"

#include <getopt.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST_ARGUMENTS = 12 };

static const struct {
  int (*run)(int argc, char **argv);
  const char *suffix, *arguments[MOST_ARGUMENTS - 4];
} commands[] = {
    {command_resolve, "csv", {"resolve"}},
    {command_resolve, "csv", {"resolve", "--derived", "--friction", "alciatore", "--strict"}},
    {command_resolve, "csv", {"resolve", "--cushion", "--derived", "--model", "han"}},
    {command_resolve, "npy", {"resolve"}},
    {command_resolve, "npy", {"resolve", "--cushion", "--precision", "single"}},
    {command_shoot, "jsonl", {"shoot", "--events-most", "60", "--cushion", "han"}},
    {command_shoot,
     "jsonl",
     {"shoot", "--events-most", "20", "--world", "pooltool", "--events", "brief"}},
};

static char folder[20];                  /* in the working folder */
static char path[3][sizeof folder + 16]; /* by suffix */

static void remove_files(void) {
  for (int k = 0; k < 3; k++)
    unlink(path[k]);
  rmdir(folder);
}

static void fail(const char *what) {
  fprintf(stdout, "files: %s\n", what); /* stderr is off */
  fflush(stdout);
  abort();
}

/* What the command writes to standard output, as a new text, and its exit code. */
static char *output_of(size_t k, const char *file, const char *threads, int *code) {
  static int memory = -1;
  /* argv may be written to and is put into another order */
  const char *const last[] = {"--threads", threads, file};
  static char text_of[MOST_ARGUMENTS][64];
  char *argument[MOST_ARGUMENTS + 1] = {0};
  int count = 0, own = 0;
  while (commands[k].arguments[own] != NULL)
    own++;
  for (; count < own + 3; count++) {
    argument[count] = text_of[count];
    snprintf(argument[count], sizeof *text_of, "%s",
             count < own ? commands[k].arguments[count] : last[count - own]);
  }
  if (memory < 0)
    memory = memfd_create("output", 0);
  const int kept = dup(STDOUT_FILENO);
  if (memory < 0 || kept < 0 || ftruncate(memory, 0) != 0 || lseek(memory, 0, SEEK_SET) != 0 ||
      dup2(memory, STDOUT_FILENO) < 0)
    abort();
  optind = 0;
  *code = commands[k].run(count, argument);
  fflush(stdout);
  dup2(kept, STDOUT_FILENO);
  close(kept);
  const off_t size = lseek(memory, 0, SEEK_END);
  char *text = calloc((size_t)size + 1, 1);
  if (text == NULL || pread(memory, text, (size_t)size, 0) != size)
    abort();
  return text;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const suffixes[] = {"csv", "npy", "jsonl"};
  if (path[0][0] == '\0') {
    stderr = fopen("/dev/null", "w");
    snprintf(folder, sizeof folder, "carom-fuzz-%s", random_name);
    if (stderr == NULL || mkdtemp(folder) == NULL)
      abort();
    for (int k = 0; k < 3; k++)
      snprintf(path[k], sizeof path[k], "%s/in.%s", folder, suffixes[k]);
    atexit(remove_files);
  }
  if (size == 0)
    return 0;
  const size_t k = data[0] % (sizeof commands / sizeof commands[0]);
  const char *name = NULL;
  for (int n = 0; n < 3; n++)
    if (strcmp(commands[k].suffix, suffixes[n]) == 0)
      name = path[n];
  FILE *file = fopen(name, "w");
  if (file == NULL || fwrite(data + 1, 1, size - 1, file) != size - 1 || fclose(file) != 0)
    abort();

  int code, other;
  char *const text = output_of(k, name, "1", &code), *const again = output_of(k, name, "2", &other);
  if (code != EXIT_GOOD && code != EXIT_SOME && code != EXIT_USAGE)
    fail("an exit code that the command does not have");
  if (code != other || strcmp(text, again) != 0)
    fail("the output depends on the number of threads");
  free(text);
  free(again);
  return 0;
}
