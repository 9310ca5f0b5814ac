/* Subcommands that are programs in Python, run by the shell. */
#include "python.h"
#include "program/program.h"

#include <stdlib.h>
#include <sys/wait.h>

/* Adds a word in single quotes, within which only the quote itself is special to the shell. */
static void add_quoted(FILE *line, const char *word) {
  fputs(" '", line);
  for (const char *c = word; *c != '\0'; c++)
    if (*c == '\'')
      fputs("'\\''", line);
    else
      fputc(*c, line);
  fputc('\'', line);
}

/* The exit code of the program, or -1 if it could not be run or did not exit. */
static int run(const char *needs, const char *module, const char *const words[], FILE *out) {
  char *text = NULL;
  size_t length = 0;
  FILE *line = open_memstream(&text, &length);
  if (line == NULL)
    return -1;
  fprintf(line, "CAROM_PYTHON_MODULES='%s'", needs);
  add_quoted(line, STUDY_SOURCE "/tools/python");
  fprintf(line, " -m %s", module);
  for (size_t k = 0; words[k] != NULL; k++)
    add_quoted(line, words[k]);
  fclose(line);
  FILE *output = popen(text, "r");
  free(text);
  if (output == NULL)
    return -1;
  for (int c; (c = fgetc(output)) != EOF;)
    fputc(c, out);
  const int status = pclose(output);
  if (!WIFEXITED(status))
    return -1;
  return WEXITSTATUS(status);
}

int python_command(const char *needs, const char *module, const char *const words[],
                   const char *output) {
  FILE *out = output_open(output);
  if (out == NULL)
    return EXIT_USAGE;
  const int code = run(needs, module, words, out);
  if (code < 0 || code > EXIT_SOME) {
    output_abandon();
    return EXIT_USAGE;
  }
  return output_commit() ? code : EXIT_USAGE;
}

void python_option(const char *words[], const char *option, const char *value) {
  if (value == NULL)
    return;
  while (*words != NULL)
    words++;
  words[0] = option;
  words[1] = value;
}
