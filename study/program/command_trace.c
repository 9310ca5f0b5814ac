/* `carom-lab trace`: a reference collision over normal impulse, by the exact solver and by Euler's
 * method, as the CSV file that study/lab/figures/trace.gp draws. */
#include "cases.h"
#include "program/program.h"
#include "rows/kind.h"
#include "rows/number.h"
#include "subcommands.h"

typedef struct trace_job {
  shared_options shared;
  const char *id;
  int points;
} trace_job;

/* The horizontal components of a velocity in the axes of the collision: y from ball 1 to ball 2. */
static void write_in_axes(FILE *out, const carom_impact *in, const double v[3]) {
  const double x = in->b.r[0] - in->a.r[0], y = in->b.r[1] - in->a.r[1], length = hypot(x, y);
  write_numbers(out, (double[]){(v[0] * y - v[1] * x) / length, (v[0] * x + v[1] * y) / length}, 2);
}

static void write_point(FILE *out, const carom_impact *in, const char *solver,
                        const carom_trace_point *p) {
  fputs(solver, out);
  write_numbers(out, (double[]){p->normal, p->work}, 2);
  const char *phase = "compression";
  if (p->phase == CAROM_PHASE_RESTITUTION)
    phase = "restitution";
  fprintf(out, ",%s,%d", phase, p->sticks != 0);
  write_numbers(out, (double[]){p->v_n, p->u_x, p->u_z, p->d_x, p->d_y, p->b_x, p->b_y}, 7);
  write_in_axes(out, in, p->state.a.v);
  write_in_axes(out, in, p->state.b.v);
  write_numbers(out, (const double *)(const void *)&p->state, sizeof p->state / sizeof(double));
  fputc('\n', out);
}

/* Where compression ends: the normal velocity is nearly linear between two points. */
static double end_of_compression(const carom_trace_point *point, int points) {
  for (int k = 1; k < points; k++) {
    const carom_trace_point *a = &point[k - 1], *b = &point[k];
    if (a->phase != b->phase)
      return fmin(a->normal - a->v_n * (b->normal - a->normal) / (b->v_n - a->v_n), b->normal);
  }
  return (double)NAN;
}

/* The notes that the figure is drawn by. */
static void write_notes(FILE *out, const trace_job *job, const carom_impact *in,
                        const carom_trace_point *exact) {
  carom_detail detail;
  carom_result unused;
  carom_collide_detail(in, &job->shared.options, &unused, &detail);
  fprintf(out,
          "# collision: %s\n# slip: %s\n# steps: %d\n# friction between the balls: %.3g\n"
          "# friction of the cloth: %.3g and %.3g\n# restitution: %.3g\n"
          "# compression ends: %.6g\n# the balls stick: %.6g\n",
          job->id, carom_word(CAROM_WORDS_SLIP, (int)job->shared.options.slip),
          job->shared.options.steps, in->mu_ball, in->a.mu_slide, in->b.mu_slide, in->restitution,
          end_of_compression(exact, job->points), detail.stick_normal);
}

/* Writes the traces; an exit code. */
static int write_traces(const trace_job *job, const carom_impact *in) {
  const size_t n = (size_t)job->points;
  carom_trace_point *point = allocate(2 * n, sizeof *point);
  carom_options options = job->shared.options;
  int code = EXIT_GOOD;
  static const carom_solver solvers[2] = {CAROM_SOLVER_EXACT, CAROM_SOLVER_EULER};
  for (int k = 0; k < 2 && code == EXIT_GOOD; k++) {
    options.solver = solvers[k];
    const carom_status status = carom_trace(in, &options, n, &point[(size_t)k * n]);
    if (status == CAROM_OK)
      continue;
    complain("id '%s', %s: %s (%s)", job->id, carom_word(CAROM_WORDS_SOLVER, (int)options.solver),
             carom_status_string(status), carom_status_name(status));
    code = EXIT_USAGE;
  }

  FILE *out = NULL;
  if (code == EXIT_GOOD)
    out = output_open(text_or(job->shared.output, "-"));
  if (out != NULL) {
    write_notes(out, job, in, point);
    fputs("solver,impulse_N_s,work_J,phase,sticks,v_n_m_s,u_x_m_s,u_z_m_s,d_x_m_s,d_y_m_s,b_x_m_s,"
          "b_y_m_s,v1_x_m_s,v1_y_m_s,v2_x_m_s,v2_y_m_s," RESULT_COLUMNS "\n",
          out);
    for (size_t k = 0; k < 2 * n; k++)
      write_point(out, in, carom_word(CAROM_WORDS_SOLVER, (int)solvers[k / n]), &point[k]);
  }
  free(point);
  if (out == NULL || !output_commit())
    return EXIT_USAGE;
  return EXIT_GOOD;
}

OPTION(trace_job, option_trace_id, "id", id, "X", set_text, 0,
       "the collision of data/collisions-204.csv with this id");
OPTION(trace_job, option_points, "points", points, "N", set_count, 2,
       "points, 2 or more (default 201)");

static const command_form form = {
    .name = "trace",
    .usage = "--id X [OPTIONS]",
    .about =
        "Writes the state during one of the 204 reference collisions, from contact to separation, "
        "in equal steps of normal impulse, with the exact solver and with Euler's method.\n",
    .options = (const option_row *const[]){&option_trace_id, &option_points, &option_steps,
                                           &option_slip, &option_data, &option_output, NULL},
    .details =
        "columns written:\n"
        "  solver, impulse_N_s  the solver; the normal impulse so far\n"
        "  work_J               work of the normal force so far, the sum of |v_n| dP\n"
        "  phase                compression while the balls approach each other, then restitution\n"
        "  sticks               1 as soon as the balls no longer slip on each other, else 0; "
        "always 0 with Euler's method\n"
        "  v_n_m_s              speed of separation along the line of centres; negative while the "
        "balls approach\n"
        "  u_x_m_s u_z_m_s      slip of ball 1 on ball 2; y is the line of centres from 1 to 2, z "
        "points up, x = y x z\n"
        "  d_x_m_s d_y_m_s      slip of ball 1 over the cloth, and b_x_m_s b_y_m_s of ball 2, in "
        "the same axes\n"
        "  v1_x_m_s v1_y_m_s    velocity of ball 1, and v2_x_m_s v2_y_m_s of ball 2, in the same "
        "axes\n"
        "  v1x ... w2z          the state, m/s and rad/s, along the axes of the table\n"
        "\n"
        "exit code: 0; 2 for bad usage, unreadable input or a collision that cannot be traced\n",
    .example = "carom-lab trace --id pooltool-135 -o trace.csv",
    .files = NO_FILES,
};

int command_trace(int argc, char **argv) {
  trace_job job = {.shared = {.options = COMMAND_OPTIONS}, .points = 201};
  int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  if (job.id == NULL) {
    complain("trace needs --id: which collision to follow");
    return usage_hint(&form);
  }

  case_set cases;
  if (!cases_load(data_folder(job.shared.folder), "collisions-204.csv", &cases))
    return EXIT_USAGE;
  size_t k = 0;
  while (k < cases.count && !same_text(cases.id[k], job.id))
    k++;
  code = EXIT_USAGE;
  if (k == cases.count)
    complain("the reference collisions have no id '%s'; they have %s to %s", job.id, cases.id[0],
             cases.id[cases.count - 1]);
  else
    code = write_traces(&job, &cases.impact[k]);
  cases_free(&cases);
  return code;
}
