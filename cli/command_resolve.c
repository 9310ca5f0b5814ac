/* `carom resolve`: collisions from a file, by the library's solvers. */
#include "cushion_rows.h"
#include "resolving.h"
#include "subcommands.h"

static void by_library(const void *context, const carom_options *options, bool single, const void *in, size_t n, void *out,
                       int8_t *status) {
  (void)context;
  if (single)
    carom_collide_batch_f32(in, n, options, out, status);
  else
    carom_collide_batch(in, n, options, out, status);
}

static const command_form form = {
    .name = "resolve",
    .usage = "[OPTIONS] IN",
    .about = resolve_about,
    .options = (const option_row *const[]){&option_solver, &option_slip, &option_steps, &option_friction, &option_precision,
                                           &option_threads, &option_cushion, &option_derived, &option_strict, &option_output,
                                           &option_summary, NULL},
    .details = resolve_details,
    .example = "carom resolve --solver euler --slip pooltool -o after.csv before.csv",
    .files = ONE_FILE,
};

int command_resolve(int argc, char **argv) {
  if (cushion_asked(&argc, argv))
    return cushion_resolve(argc, argv);
  resolving job = {.shared = {.options = COMMAND_OPTIONS, .precision = ANY_PRECISION}, .solve = by_library};
  const char *file;
  const int code = parse_arguments(&form, argc, argv, &job, &file);
  if (code >= 0)
    return code;
  job.solver = carom_solver_name(job.shared.options.solver);
  return resolve_file(&job, file);
}
