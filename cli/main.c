/* `carom`: the program for users. */
#include "program/command.h"
#include "subcommands.h"

int main(int argc, char **argv) {
  static const command commands[] = {
      {"shots", "shoot", "play whole shots, from the cue to rest", command_shoot},
      {"shots", "ways", "the ways to pot a ball, or to score in three-cushion", command_ways},
      {"shots", "plan", "the shots that win most often from a layout", command_plan},
      {"shots", "break", "what comes of many breaks of a rack", command_break},
      {"shots", "match", "play, go on with and tell matches of two rated players", command_match},
      {"shots", "calibrate", "the cushion of your table, by three banks", command_calibrate},
      {"one impact", "hit", "one collision from speed, cut and spin: words, picture, curves",
       command_hit},
      {"one impact", "rail", "one impact on a cushion, in the same ways", command_rail},
      {"recordings", "record", "play shots and record them, with a hash of their bits",
       command_record},
      {"recordings", "replay", "play a recording again", command_replay},
      {"recordings", "verify", "compare every bit of a recording", command_verify},
      {"study", "resolve", "resolve the collisions of a CSV file", command_resolve},
      {"study", "models", "models, their words and their numbers", command_models},
  };
  static const program carom = {
      .name = "carom",
      .about = "Computes billiards: collisions of balls, impacts on cushions, and whole shots.",
      .cites = "shoot",
      .example = "carom shoot --cue 0.6,0.8 --balls 0.8,1.9 --pocket 1:foot-right --plot shot.svg",
      .commands = commands,
      .count = sizeof commands / sizeof commands[0],
  };
  return program_run(&carom, argc, argv);
}
