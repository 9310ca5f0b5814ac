/* `carom resolve`: rows from a file, by the library's solvers. */
#include "rows/help.h"
#include "rows/row_solver.h"
#include "subcommands.h"

static const command_form form = {
    .name = "resolve",
    .usage = "[OPTIONS] IN",
    .about = RESOLVE_ABOUT "With --cushion the rows are impacts of a ball on a cushion.\n",
    .options =
        (const option_row *const[]){&option_cushion, &option_precision, &option_threads,
                                    &option_steps, &option_derived, &option_strict, &option_summary,
                                    &option_output, &option_solver, &option_slip, &option_friction,
                                    &option_model, &option_with, &option_convention, &option_law,
                                    &option_least_step, NULL},
    .details = COLLISION_COLUMNS_HELP
    "\n" RESULTS_HELP "\n"
    "with --derived also, nan unless the status is ok:\n"
    "  throw_deg            angle of ball 2's change of velocity from the line of centres, "
    "degrees, to the left from above\n"
    "  deflection_deg       angle between the paths of ball 1 before and just after, and "
    "deflection_rolling_deg once it rolls\n"
    "  roll1x roll1y        velocity of ball 1 once it rolls, m/s, and roll2x roll2y of ball 2\n"
    "  spin_transfer        ball 2's change of w2z over ball 1's w1z before; nan where that is 0\n"
    "  energy_lost          fraction of the kinetic energy that is lost, including spins\n"
    "\n" IMPACT_COLUMNS_HELP "\n"
    "columns written with --cushion: id,vx,vy,vz,wx,wy,wz,status\n"
    "\n"
    "with --cushion --derived also:\n"
    "  angle_in_deg         angle of the velocity before from the normal, degrees, to the left "
    "from above\n"
    "  angle_out_deg        angle of the velocity after from the normal; a mirror without loss "
    "keeps it\n"
    "  angle_rolling_deg    the same once the ball rolls\n"
    "  rollx rolly          velocity once the ball rolls, m/s\n"
    "  energy_lost          fraction of the kinetic energy that is lost, including spin\n"
    "\n"
    "--strict refuses centres whose distance is not R1 + R2 to 1 %, more than 50 m/s or 2,000 "
    "rad/s, a radius above 0.5 m, a mass above 10 kg and a tip more than 0.5 R from the centre.\n"
    "\n" RESOLVE_EXIT_HELP,
    .example = "carom resolve --solver euler --slip pooltool -o after.csv before.csv",
    .files = ONE_FILE,
};

int command_resolve(int argc, char **argv) {
  row_job job = {.shared = {.options = COMMAND_OPTIONS, .precision = ANY_PRECISION}};
  const char *file;
  const int code = parse_arguments(&form, argc, argv, &job, &file);
  return code >= 0 ? code : resolve_file(&job, file);
}
