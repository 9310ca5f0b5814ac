/* `carom trace --cushion`: one impact on a cushion against normal impulse. */
#include "command.h"
#include "cushion_rows.h"
#include "memory.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "subcommands.h"

#include <stdlib.h>

typedef struct trace_job {
  shared_options shared; /* these two as in cushion_job */
  cushion_options cushion;
  int points;
} trace_job;

static void print_point(FILE *out, const char *model, const carom_cushion_point *p) {
  fputs(model, out);
  write_numbers(out, (const double[]){p->normal, p->work}, 2);
  fprintf(out, ",%s,%d,%d", p->phase == CAROM_PHASE_COMPRESSION ? "compression" : "restitution", p->nose_sticks,
          p->cloth_sticks);
  write_numbers(out, (const double[]){p->v_n, p->s_x, p->s_t, p->c_x, p->c_y}, 5);
  write_numbers(out, (const double *)&p->state, sizeof p->state / sizeof(double));
  fputc('\n', out);
}

OPTION(trace_job, option_points, "points", points, 0, "N", set_count, 2, "points, 2 or more (default 201)");

static const command_form form = {
    .name = "trace --cushion",
    .usage = "--id X [OPTIONS] FILE",
    .about =
        "Follows one impact of a ball on a cushion from contact to parting, in equal steps of normal impulse, by the model\n"
        "mathavan or euler. FILE is a CSV file, - for standard input.\n",
    .options = (const option_row *const[]){&option_id, &option_model, &option_convention, &option_law, &option_steps,
                                           &option_least_step, &option_points, &option_output, NULL},
    .details = CUSHION_COLUMNS_HELP
    "columns written:\n"
    "  model, impulse_N_s      which one; normal impulse so far\n"
    "  work_J                  work of the normal force so far, the sum of |v_n| dP\n"
    "  phase                   compression while the ball moves into the cushion, then restitution\n"
    "  nose_sticks cloth_sticks  1 where the ball does not slip there, else 0; always 0 by Euler's method\n"
    "  v_n_m_s                 speed into the nose, along its normal; negative while they part\n"
    "  s_x_m_s s_t_m_s         slip on the nose, along the cushion and upwards across it\n"
    "  c_x_m_s c_y_m_s         slip on the cloth; y points into the cushion, x along it, z up\n"
    "  vx ... wz               the motion, m/s and rad/s, along the axes of the table\n\n"
    "exit code: 0; 2 for bad usage, unreadable input or an impact in error\n",
    .example = "carom trace --cushion --id 1 -o trace.csv before.csv",
    .files = ONE_FILE,
};

int cushion_trace(int argc, char **argv) {
  trace_job job = {.shared = {.output = "-"}, .points = 201};
  const char *file;
  int code = parse_arguments(&form, argc, argv, &job, &file);
  if (code >= 0)
    return code;
  if (job.shared.id == NULL) {
    complain("trace needs --id: which impact to follow");
    return usage_hint(&form);
  }
  const carom_cushion_options options = cushion_options_of((const cushion_job *)&job);
  const char *model = carom_cushion_model_name(options.model);
  carom_cushion_impact impact;
  if (!cushion_pick(file, job.shared.id, &options, &impact))
    return EXIT_USAGE;
  carom_cushion_point *point = allocate((size_t)job.points, sizeof *point);
  const carom_status status = carom_cushion_trace(&impact, &options, (size_t)job.points, point);
  code = EXIT_USAGE;
  if (status == CAROM_ERROR_CUSHION_MODEL)
    complain("%s is a closed form and has no course; --model mathavan and euler have", model);
  else if (status < 0)
    complain("id '%s': %s (%s)", job.shared.id, carom_status_string(status), carom_status_name(status));
  if (status == CAROM_SEPARATING)
    complain("id '%s': %s", job.shared.id, carom_status_string(status));
  FILE *out = status >= 0 ? output_open(job.shared.output) : NULL;
  if (out != NULL) {
    fputs("model,impulse_N_s,work_J,phase,nose_sticks,cloth_sticks,v_n_m_s,s_x_m_s,s_t_m_s,c_x_m_s,c_y_m_s,vx,vy,vz,wx,wy,wz\n",
          out);
    for (int k = 0; k < job.points; k++)
      print_point(out, model, &point[k]);
    if (output_commit())
      code = EXIT_GOOD;
  }
  free(point);
  return code;
}
