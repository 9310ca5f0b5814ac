/* `carom-lab`: the program of the study. A new subcommand is a file command_NAME.c, a line in
 * subcommands.h and a row here. */
#include "program/command.h"
#include "subcommands.h"

int main(int argc, char **argv) {
  static const command commands[] = {
      {"commands", "paper", "judge every claim of the seed paper by a run", command_paper},
      {"commands", "kernels", "list the kernels: the library's solvers and the seed paper's ladder",
       command_kernels},
      {"commands", "resolve", "resolve the collisions of a CSV file by any kernel",
       command_resolve},
      {"commands", "verify", "compare every kernel with the references", command_verify},
      {"commands", "bench", "time every kernel, once it is verified", command_bench},
      {"commands", "bounds", "count the kernels' operations and bound their cycles",
       command_bounds},
      {"commands", "stress", "test the exact solver on random collisions", command_stress},
      {"commands", "parity", "compare whole shots with those that pooltool recorded",
       command_parity},
      {"commands", "plan", "play racks of eight-ball by plans", command_plan},
      {"commands", "learn", "fit the planner's values of layouts to racks that are played",
       command_learn},
      {"commands", "trace", "follow one reference collision over normal impulse", command_trace},
      {"commands", "experiments", "compare with the 2014 paper's measured shots",
       command_experiments},
      {"commands", "published", "compare with values that others published", command_published},
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
