/* `carom-lab resolve`: collisions from a file, by any kernel: a solver of the library, or a rung
 * of the ladder in any build. */
#include "kernel.h"
#include "program/program.h"
#include "rows/help.h"
#include "rows/row_solver.h"
#include "subcommands.h"

typedef struct resolve_job {
  row_job rows; /* begins with the shared options */
  const kernel *kernel;
  const char *config;
  const ladder_module *module;
} resolve_job;

static void by_kernel(const void *context, const carom_options *options, bool single,
                      const void *in, size_t n, void *out, int8_t *status) {
  const resolve_job *job = context;
  if (single)
    kernel_resolve_f32(job->kernel, in, n, options, out, status);
  else
    kernel_resolve(job->kernel, job->module, in, n, options, out, status);
}

OPTION(resolve_job, option_kernel, "kernel", kernel, "NAME", set_kernel, 0,
       "how to compute (see `carom-lab kernels`)");
OPTION(resolve_job, option_config, "config", config, "NAME", set_text, 0,
       "which build of a ladder kernel (see `carom-lab kernels`; default: default)");

static const command_form form = {
    .name = "resolve",
    .usage = "[OPTIONS] IN",
    .about = RESOLVE_ABOUT,
    .options = (const option_row *const[]){&option_kernel, &option_config, &option_slip,
                                           &option_steps, &option_friction, &option_precision,
                                           &option_threads, &option_output, &option_summary, NULL},
    .details = COLLISION_COLUMNS_HELP "\n" RESULTS_HELP "\n" RESOLVE_EXIT_HELP,
    .example =
        "carom-lab resolve --kernel base --config o3 --slip pooltool -o after.csv before.csv",
    .files = ONE_FILE,
};

int command_resolve(int argc, char **argv) {
  resolve_job job = {.rows = {.shared = {.options = COMMAND_OPTIONS, .precision = ANY_PRECISION},
                              .solve = by_kernel},
                     .kernel = kernel_at(0)};
  const char *file;
  const int code = parse_arguments(&form, argc, argv, &job, &file);
  if (code >= 0)
    return code;
  if (!kernel_module(job.kernel, job.config, &job.module))
    return EXIT_USAGE;
  if (job.kernel->is_rung && job.rows.shared.precision == SINGLE_PRECISION) {
    complain("each kernel of the ladder has its own precision; --precision is for the solvers of "
             "the library");
    return EXIT_USAGE;
  }
  if (job.kernel->is_rung)
    job.rows.shared.precision = DOUBLE_PRECISION;
  job.rows.context = &job;
  job.rows.solver = job.kernel->name;
  return resolve_file(&job.rows, file);
}
