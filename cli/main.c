/* `carom`: the program for users. */
#include "program/command.h"
#include "subcommands.h"

int main(int argc, char **argv) {
  static const command commands[] = {
      {"resolve", "resolve the collisions of a CSV file", command_resolve},
      {"hit", "one collision from speed, cut and spin: words, picture, curves", command_hit},
      {"rail", "one impact on a cushion, in the same ways", command_rail},
      {"shoot", "play whole shots, from the cue to rest", command_shoot},
      {"plan", "the shots that win most often from a layout", command_plan},
      {"ways", "the ways to pot a ball, or to score in three-cushion", command_ways},
      {"break", "what comes of many breaks of a rack", command_break},
      {"calibrate", "the cushion of your table, by three banks", command_calibrate},
      {"models", "models, their words and their numbers", command_models},
      {"record", "play shots and record them, with a hash of their bits", command_record},
      {"replay", "play a recording again", command_replay},
      {"verify", "compare every bit of a recording", command_verify},
      {"match", "play, go on with and tell matches of two rated players", command_match},
  };
  static const program carom = {
      .name = "carom",
      .about = "Computes billiards: collisions of balls, impacts on cushions, and whole shots.",
      .cites = "shoot",
      .example = "carom resolve -o after.csv before.csv",
      .commands = commands,
      .count = sizeof commands / sizeof commands[0],
  };
  return program_run(&carom, argc, argv);
}
