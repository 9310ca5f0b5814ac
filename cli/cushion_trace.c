/* `carom trace --cushion`: one impact on a cushion against normal impulse, as a CSV file and as a picture. */
#include "command.h"
#include "cushion_rows.h"
#include "memory.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "picture.h"
#include "subcommands.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct trace_job {
  shared_options shared; /* these two as in cushion_job */
  cushion_options cushion;
  int points;
  const char *picture;
  carom_cushion_impact impact;
  carom_cushion_point *point;
} trace_job;

static const char *model_of(const trace_job *job) {
  return carom_cushion_model_name((carom_cushion_model)job->cushion.model);
}

static void print_point(FILE *out, const trace_job *job, const carom_cushion_point *p) {
  const double *n = job->impact.normal, *v = p->state.v, size = hypot(n[0], n[1]);
  fputs(model_of(job), out);
  write_numbers(out, (const double[]){p->normal, p->work}, 2);
  fprintf(out, ",%s,%d,%d", p->phase == CAROM_PHASE_COMPRESSION ? "compression" : "restitution", p->nose_sticks,
          p->cloth_sticks);
  write_numbers(out, (const double[]){p->v_n, p->s_x, p->s_t, p->c_x, p->c_y}, 5);
  write_numbers(out, (const double[]){(v[0] * n[1] - v[1] * n[0]) / size, (v[0] * n[0] + v[1] * n[1]) / size}, 2);
  write_numbers(out, (const double *)&p->state, sizeof p->state / sizeof(double));
  fputc('\n', out);
}

/* Where compression ends: v_n is all but linear between two points. NAN for a ball that does not come in. */
static double end_of_compression(const trace_job *job) {
  for (int k = 1; k < job->points; k++) {
    const carom_cushion_point *a = &job->point[k - 1], *b = &job->point[k];
    if (a->phase == CAROM_PHASE_COMPRESSION && b->phase == CAROM_PHASE_RESTITUTION)
      return fmin(a->normal - a->v_n * (b->normal - a->normal) / (b->v_n - a->v_n), b->normal);
  }
  return (double)NAN;
}

static bool sticks_at(const trace_job *job, int k, bool nose) {
  return nose ? job->point[k].nose_sticks : job->point[k].cloth_sticks;
}

/* The first point from which the ball sticks to the end; NAN where it slips at the end. */
static double sticks_from(const trace_job *job, bool nose) {
  int k = job->points;
  while (k > 0 && sticks_at(job, k - 1, nose))
    k--;
  return k < job->points ? job->point[k].normal : (double)NAN;
}

static void print_trace(FILE *out, const void *data) {
  const trace_job *job = data;
  const carom_cushion_impact *in = &job->impact;
  fprintf(out, "# impact: %s\n# model: %s\n# steps: %d\n", job->shared.id, model_of(job), job->shared.options.steps);
  fprintf(out, "# friction of the cushion: %.3g\n# friction of the cloth: %.3g\n# restitution: %.3g\n", in->mu_cushion,
          in->mu_cloth, in->restitution);
  fprintf(out, "# compression ends: %.6g\n# the nose sticks: %.6g\n# the cloth sticks: %.6g\n", end_of_compression(job),
          sticks_from(job, true), sticks_from(job, false));
  fputs("model,impulse_N_s,work_J,phase,nose_sticks,cloth_sticks,v_n_m_s,s_x_m_s,s_t_m_s,c_x_m_s,c_y_m_s,v_x_m_s,v_y_m_s,"
        "vx,vy,vz,wx,wy,wz\n",
        out);
  for (int k = 0; k < job->points; k++)
    print_point(out, job, &job->point[k]);
}

/* Returns an exit code. */
static int write_trace(const trace_job *job, bool separating) {
  const char *path = job->shared.output == NULL && job->picture == NULL ? "-" : job->shared.output;
  if (path != NULL) {
    FILE *out = output_open(path);
    if (out == NULL)
      return EXIT_USAGE;
    print_trace(out, job);
    if (!output_commit())
      return EXIT_USAGE;
  }
  if (job->picture == NULL)
    return EXIT_GOOD;
  char title[256];
  snprintf(title, sizeof title, "Impact %.200s", job->shared.id);
  if (separating) {
    complain("cannot draw %s: there is no impact to draw", job->picture);
    return EXIT_SOME;
  }
  return picture_draw(job->picture, "cushion_trace", title, print_trace, job) ? EXIT_GOOD : EXIT_SOME;
}

OPTION(trace_job, option_points, "points", points, 0, "N", set_count, 2, "points, 2 or more (default 201)");
OPTION(trace_job, option_plot, "plot", picture, 0, "OUT", set_picture, 0,
       "draw it with gnuplot: OUT.svg or OUT.png; the CSV is then written only with -o");

static const command_form form = {
    .name = "trace --cushion",
    .usage = "--id X [OPTIONS] FILE",
    .about =
        "Follows one impact of a ball on a cushion from contact to parting, in equal steps of normal impulse, by the model\n"
        "mathavan or euler. FILE is a CSV file, - for standard input.\n",
    .options = (const option_row *const[]){&option_id, &option_model, &option_convention, &option_law, &option_steps,
                                           &option_least_step, &option_points, &option_plot, &option_output, NULL},
    .details = CUSHION_COLUMNS_HELP
    "columns written:\n"
    "  model, impulse_N_s      which one; normal impulse so far\n"
    "  work_J                  work of the normal force so far, the sum of |v_n| dP\n"
    "  phase                   compression while the ball moves into the cushion, then restitution\n"
    "  nose_sticks cloth_sticks  1 where the ball does not slip there, else 0; always 0 by Euler's method\n"
    "  v_n_m_s                 speed into the nose, along its normal; negative while they part\n"
    "  s_x_m_s s_t_m_s         slip on the nose, along the cushion and upwards across it\n"
    "  c_x_m_s c_y_m_s         slip on the cloth; y points into the cushion, x along it, z up\n"
    "  v_x_m_s v_y_m_s         velocity in the same axes\n"
    "  vx ... wz               the motion, m/s and rad/s, along the axes of the table\n\n"
    "exit code: 0; 1 if the picture could not be drawn; 2 for bad usage, unreadable input or an impact in error\n",
    .example = "carom trace --cushion --id 1 -o trace.csv before.csv",
    .files = ONE_FILE,
};

int cushion_trace(int argc, char **argv) {
  trace_job job = {.shared = {.options = {.steps = CAROM_DEFAULT_STEPS}}, .points = 201};
  const char *file;
  int code = parse_arguments(&form, argc, argv, &job, &file);
  if (code >= 0)
    return code;
  if (job.shared.id == NULL) {
    complain("trace needs --id: which impact to follow");
    return usage_hint(&form);
  }
  const carom_cushion_options options = cushion_options_of((const cushion_job *)&job);
  if (!cushion_pick(file, job.shared.id, &options, &job.impact))
    return EXIT_USAGE;
  job.point = allocate((size_t)job.points, sizeof *job.point);
  const carom_status status = carom_cushion_trace(&job.impact, &options, (size_t)job.points, job.point);
  if (status == CAROM_ERROR_CUSHION_MODEL)
    complain("%s is a closed form and has no course; --model mathavan and euler have", model_of(&job));
  else if (status != CAROM_OK)
    complain("id '%s': %s%s%s%s", job.shared.id, carom_status_string(status), status < 0 ? " (" : "",
             status < 0 ? carom_status_name(status) : "", status < 0 ? ")" : "");
  code = status >= 0 ? write_trace(&job, status == CAROM_SEPARATING) : EXIT_USAGE;
  free(job.point);
  return code;
}
