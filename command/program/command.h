/* A program of subcommands, and the exit codes they share. */
#ifndef CAROM_CLI_COMMAND_H
#define CAROM_CLI_COMMAND_H

#include <stdbool.h>
#include <stddef.h>

enum {
  EXIT_GOOD = 0,  /* all went well */
  EXIT_SOME = 1,  /* some rows in error, or a claim not met; the rest was done */
  EXIT_USAGE = 2, /* bad usage or unreadable input; nothing was written */
};

/* The exit code of what was done: all of it went well, or some is in error. */
static inline int exit_of(bool good) {
  return good ? EXIT_GOOD : EXIT_SOME;
}

typedef struct command {
  const char *group, *name, *text;   /* of the help: a heading, and one line */
  int (*run)(int argc, char **argv); /* gets its own arguments, argv[0] being its name; returns
                                        an exit code */
} command;

/* The rows of commands.def, COMMAND(group, name, text), as declarations and as rows of a table. */
#define COMMAND_DECLARED(group, name, text) int command_##name(int argc, char **argv);
#define COMMAND_ROW(group, name, text) {group, #name, text, command_##name},

typedef struct program {
  const char *name, *about, *example;
  const char *cites; /* the command that --cite is an option of, or NULL */
  const command *commands;
  size_t count;
} program;

/* Finds the subcommand and hands over: the program's main(). The locale is never set, so numbers
 * are read and written with a point whatever the environment says. */
int program_run(const program *p, int argc, char **argv);

#endif
