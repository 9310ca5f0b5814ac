/* `carom sweep --cushion`: one impact on a cushion over and over, one of its inputs varied in fine steps. */
#include "command.h"
#include "cushion_rows.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "subcommands.h"

#include <math.h>
#include <string.h>

enum { NUMBERS = sizeof(carom_motion) / sizeof(double) };

typedef struct sweep_job {
  shared_options shared; /* these two as in cushion_job */
  cushion_options cushion;
  const char *over;
  double from, to;
  int points;
} sweep_job;

typedef struct outcome {
  carom_motion motion;
  carom_status status;
  double value, scale, speed[NUMBERS]; /* the results, spins times radius */
} outcome;

static outcome resolve(const sweep_job *job, const carom_cushion_options *options, const carom_cushion_impact *impact, int k) {
  outcome o = {.value = job->from + (job->to - job->from) * ((double)k / (job->points - 1))};
  carom_cushion_impact in = *impact;
  ((double *)&in)[cushion_field(job->over)] = o.value;
  o.status = carom_cushion(&in, options, &o.motion);
  for (int c = 0; c < NUMBERS; c++) {
    o.speed[c] = ((const double *)&o.motion)[c] * (c < 3 ? 1 : in.radius);
    o.scale = fmax(o.scale, fabs(o.speed[c]));
  }
  return o;
}

/* How far the step from at[1] to at[2] lies outside what the steps before and after it span. */
static double jump_of(const outcome at[4]) {
  double most = 0;
  for (int c = 0; c < NUMBERS; c++) {
    double step[3];
    for (int k = 0; k < 3; k++)
      step[k] = at[k + 1].speed[c] - at[k].speed[c];
    most = fmax(most, fmax(step[1] - fmax(step[0], step[2]), fmin(step[0], step[2]) - step[1]));
  }
  return most / at[1].scale;
}

/* Returns how many values make an error. */
static int print_sweep(FILE *out, const sweep_job *job, const carom_cushion_impact *impact) {
  const carom_cushion_options options = cushion_options_of((const cushion_job *)job);
  int errors = 0;
  outcome at[4] = {0}; /* k - 1 to k + 2, where they exist */
  fputs("model,value,jump,vx,vy,vz,wx,wy,wz,status\n", out);
  for (int k = -2; k < job->points; k++) {
    memmove(at, at + 1, 3 * sizeof at[0]);
    if (k + 2 < job->points)
      at[3] = resolve(job, &options, impact, k + 2);
    if (k < 0)
      continue;
    progress_show("values", k, job->points);
    fputs(carom_cushion_model_name(options.model), out);
    write_numbers(out, (const double[]){at[1].value, k == 0 || k + 2 >= job->points ? (double)NAN : jump_of(at)}, 2);
    write_numbers(out, (const double *)&at[1].motion, NUMBERS);
    fprintf(out, ",%s\n", carom_status_name(at[1].status));
    if (at[1].status < 0 && errors++ == 0)
      complain("the first value in error is %s = %.6g: %s (%s)", job->over, at[1].value, carom_status_string(at[1].status),
               carom_status_name(at[1].status));
  }
  progress_clear();
  return errors;
}

static OPTION_SET(set_over) {
  *(const char **)field = text;
  if (cushion_field(text) >= 0)
    return true;
  complain("--%s is a column of numbers (vx vy wx wy wz nx ny R M h mu_s mu_w e rho), not '%s'", row->name, text);
  return false;
}

OPTION(sweep_job, option_over, "over", over, 0, "COLUMN", set_over, 0, "what to vary: a column, such as vx, wz or mu_w");
OPTION(sweep_job, option_from, "from", from, 0, "A", set_number, 0, "its first value");
OPTION(sweep_job, option_to, "to", to, 0, "B", set_number, 0, "its last value");
OPTION(sweep_job, option_points, "points", points, 0, "N", set_count, 2, "how many, 2 or more (default 10001)");

static const command_form form = {
    .name = "sweep --cushion",
    .usage = "--id X --over COLUMN --from A --to B [OPTIONS] FILE",
    .about = "Resolves one impact of a ball on a cushion many times, COLUMN taking equally spaced values from A to B. FILE is "
             "a CSV\n"
             "file, - for standard input.\n",
    .options =
        (const option_row *const[]){&option_id, &option_over, &option_from, &option_to, &option_points, &option_model,
                                    &option_convention, &option_law, &option_steps, &option_least_step, &option_output, NULL},
    .details = CUSHION_COLUMNS_HELP
    "columns written:\n"
    "  model, value            of the input\n"
    "  jump                    how far the results (radius times spin), over the largest of them, leave a smooth curve "
    "between\n"
    "                          this value and the next: the distance of their step from both neighbouring steps and all\n"
    "                          between. nan at the ends\n"
    "  vx ... wz, status       as `carom resolve --cushion` writes them\n\n"
    "exit code: 0; 1 if some values make an error; 2 for bad usage or unreadable input\n",
    .example = "carom sweep --cushion --id 1 --over wz --from -60 --to 60 -o sweep.csv before.csv",
    .files = ONE_FILE,
};

int cushion_sweep(int argc, char **argv) {
  sweep_job job = {.shared = {.output = "-"}, .points = 10001, .from = (double)NAN, .to = (double)NAN};
  const char *file;
  const int code = parse_arguments(&form, argc, argv, &job, &file);
  if (code >= 0)
    return code;
  if (job.shared.id == NULL || job.over == NULL || isnan(job.from) || isnan(job.to)) {
    complain("sweep needs --id, --over, --from and --to");
    return usage_hint(&form);
  }
  const carom_cushion_options options = cushion_options_of((const cushion_job *)&job);
  carom_cushion_impact impact;
  FILE *out = cushion_pick(file, job.shared.id, &options, &impact) ? output_open(job.shared.output) : NULL;
  if (out == NULL)
    return EXIT_USAGE;
  const int errors = print_sweep(out, &job, &impact);
  if (!output_commit())
    return EXIT_USAGE;
  return errors > 0 ? EXIT_SOME : EXIT_GOOD;
}
