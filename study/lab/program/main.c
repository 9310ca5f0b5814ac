/* `carom-lab`: the program of the study. A new subcommand is a file command_NAME.c
 * and a row of commands.def. */
#include "program/command.h"
#include "subcommands.h"

int main(int argc, char **argv) {
  static const command commands[] = {
#define COMMAND COMMAND_ROW
#include "commands.def"
  };
  static const program lab = {
      .name = "carom-lab",
      .about = "The study: the seed paper's kernels and the library's, verified, timed, and "
               "compared with measured shots.",
      .example = "carom-lab bench --kernel base,double,float,exact --budget 5",
      .commands = commands,
      .count = sizeof commands / sizeof commands[0],
  };
  return program_run(&lab, argc, argv);
}
