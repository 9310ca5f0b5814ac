/* `carom`: the program for users. */
#include "program/command.h"
#include "subcommands.h"

int main(int argc, char **argv) {
  static const command commands[] = {
#define COMMAND COMMAND_ROW
#include "commands.def"
  };
  static const program carom = {
      .name = "carom",
      .about = "Computes billiards: collisions of balls, impacts on cushions, and complete shots.",
      .cites = "shoot",
      .example = "carom shoot --cue 0.6,0.8 --balls 0.8,1.9 --pocket 1:foot-right --plot shot.svg",
      .commands = commands,
      .count = sizeof commands / sizeof commands[0],
  };
  return program_run(&carom, argc, argv);
}
