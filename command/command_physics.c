/* `carom physics`: the options that describe the physics of shots, which other commands share. */
#include "program/program.h"
#include "shots/shoot_flags.h"
#include "subcommands.h"

static const command_form form = {
    .name = "physics",
    .usage = "",
    .about = "Describes the options of physics that `carom shoot`, `plan`, `ways`, `break` and "
             "`record` share. Their defaults are for play; these options are for comparisons with "
             "other models and simulators. Only `carom shoot` has --time-most, --events-most, "
             "--tip-time and --tip-restitution; it, `plan` and `ways` have --cue-ball.\n",
    .options = (const option_row *const[]){&options_of_shots, &option_tip_time,
                                           &option_tip_restitution, &option_cue_ball, NULL},
    .details = "`carom models` lists the models, and the parameters of --with.\n"
               "\n"
               "exit code: 0; 2 for bad usage\n",
    .example = "carom shoot --cue 0.6,0.8 --aim 35 --cushion han",
    .files = NO_FILES,
    .is_physics = true,
};

int command_physics(int argc, char **argv) {
  static shoot_flags flags;
  const int code = parse_arguments(&form, argc, argv, &flags, NULL);
  if (code >= 0)
    return code;
  print_help_of(&form);
  return EXIT_GOOD;
}
