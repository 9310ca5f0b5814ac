/* `carom-lab bounds`: study/bounds, which counts the operations of the kernels in the module that
 * is timed, and bounds their cycles. */
#include "program/program.h"
#include "python.h"
#include "subcommands.h"

typedef struct bounds_job {
  shared_options shared;
  const char *kernels, *config;
  int steps;
} bounds_job;

OPTION(bounds_job, bounds_kernels, "kernel", kernels, "NAME,...", set_text, 0,
       "these kernels of the ladder, or all (default base,double,float,double_vec,float_vec)");
OPTION(bounds_job, bounds_config, "config", config, "NAME", set_text, 0,
       "the build that is counted (default clang-zen2, or gcc-zen2 without clang); valgrind, which "
       "counts, does not support AVX-512");
OPTION(bounds_job, bounds_steps, "steps", steps, "N", set_count, 10,
       "steps of a collision (default 1000)");

static const command_form form = {
    .name = "bounds",
    .usage = "[OPTIONS]",
    .about = "Counts what the kernels of the ladder execute on the reference collisions, under "
             "valgrind: floating-point operations, instructions, loads and stores. Bounds the "
             "cycles by the longest chain of dependent operations, with the latencies of Zen 2 and "
             "of this processor, and by llvm-mca if it is installed. The notes have a fingerprint "
             "of the module, which `carom-lab bench` also writes.\n",
    .options = (const option_row *const[]){&bounds_kernels, &bounds_config, &bounds_steps,
                                           &option_output, NULL},
    .details = "Columns: flops_* by kind, flops_total, flops_amd (a fused multiply-add counts "
               "twice), loads_per_step, stores_per_step, chain_cycles_* and mca_cycles_* of a "
               "collision.\n"
               "\n"
               "exit code: 0; 1 if some kernels could not be counted; 2 for bad usage, or without "
               "valgrind, objdump or the module\n",
    .example = "carom-lab bounds --kernel base,double",
};

int command_bounds(int argc, char **argv) {
  bounds_job job = {.shared = {.options = COMMAND_OPTIONS}, .steps = 1000};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  char steps[16];
  snprintf(steps, sizeof steps, "%d", job.steps);
  const char *words[10] = {"--build", STUDY_BUILD, "--steps", steps};
  python_option(words, "--kernel", job.kernels);
  python_option(words, "--config", job.config);
  return python_command("jinja2", "study.bounds", words, job.shared.output);
}
