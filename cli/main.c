/* The command `carom`: finds the subcommand and hands over. The locale is never set, so numbers are read and written with a
 * point whatever the environment says. */
#include "carom.h"
#include "command.h"
#include "message.h"

#include <stdio.h>
#include <string.h>

static void print_help(FILE *to) {
  fputs("usage: carom COMMAND [ARGUMENTS]\n\n"
        "Collisions of two billiard balls: friction between the balls and with the cloth.\n\n"
        "commands:\n",
        to);
#define LINE(name, text) fprintf(to, "  %-12s%s\n", #name, text);
  COMMAND_LIST(LINE)
#undef LINE
  fputs("\n`carom COMMAND --help` tells the arguments of each; `carom --version` the version.\n", to);
}

/* What could not be written was not said, so the run was not good. */
static int finish(int code) {
  if (code == EXIT_USAGE || (fflush(stdout) == 0 && !ferror(stdout)))
    return code;
  complain("cannot write standard output");
  return EXIT_USAGE;
}

int main(int argc, char **argv) {
  if (argc < 2) {
    print_help(stderr);
    return EXIT_USAGE;
  }
  const char *name = argv[1];
  if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
    print_help(stdout);
    return finish(EXIT_GOOD);
  }
  if (strcmp(name, "--version") == 0) {
    printf("carom %s\n", carom_version());
    return finish(EXIT_GOOD);
  }
/* getopt's own complaints begin with the first argument. */
#define RUN(command, text)                                \
  if (strcmp(name, #command) == 0) {                      \
    static char program[] = "carom: " #command;           \
    argv[1] = program;                                    \
    return finish(command_##command(argc - 1, argv + 1)); \
  }
  COMMAND_LIST(RUN)
#undef RUN
  complain("no command '%s'; `carom --help` lists them", name);
  return EXIT_USAGE;
}
