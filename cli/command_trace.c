/* `carom trace`: one collision against normal impulse, as a CSV file and as a picture. */
#include "command.h"
#include "cushion_rows.h"
#include "memory.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "pick.h"
#include "picture.h"
#include "sink.h"
#include "subcommands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct trace {
  shared_options asked;
  carom_impact impact;
  int points;
  const char *picture;
  carom_trace_point *point; /* of the first solver, then of the next */
  bool separating;
} trace;

/* Velocities in the collision frame. */
static void print_in_frame(FILE *out, const carom_impact *in, const double v[3]) {
  const double x = in->b.r[0] - in->a.r[0], y = in->b.r[1] - in->a.r[1], distance = hypot(x, y);
  write_numbers(out, (const double[]){(v[0] * y - v[1] * x) / distance, (v[0] * x + v[1] * y) / distance}, 2);
}

static void print_point(FILE *out, const trace *t, carom_solver solver, const carom_trace_point *p) {
  fputs(carom_solver_name(solver), out);
  write_numbers(out, (const double[]){p->normal, p->work}, 2);
  fprintf(out, ",%s,%d", p->phase == CAROM_PHASE_COMPRESSION ? "compression" : "restitution", p->sticks);
  write_numbers(out, (const double[]){p->v_n, p->u_x, p->u_z, p->d_x, p->d_y, p->b_x, p->b_y}, 7);
  print_in_frame(out, &t->impact, p->state.a.v);
  print_in_frame(out, &t->impact, p->state.b.v);
  write_numbers(out, (const double *)&p->state, sizeof p->state / sizeof(double));
  fputc('\n', out);
}

/* Where compression ends: v_n is all but linear between two points. NAN for balls that do not collide. */
static double end_of_compression(const trace *t) {
  for (int k = 1; k < t->points; k++) {
    const carom_trace_point *a = &t->point[k - 1], *b = &t->point[k];
    if (a->phase == CAROM_PHASE_COMPRESSION && b->phase == CAROM_PHASE_RESTITUTION)
      return fmin(a->normal - a->v_n * (b->normal - a->normal) / (b->v_n - a->v_n), b->normal);
  }
  return NAN;
}

static void print_trace(FILE *out, const void *data) {
  const trace *t = data;
  carom_options options = t->asked.options;
  carom_result unused;
  carom_detail detail;
  options.solver = CAROM_SOLVER_EXACT; /* Euler's method does not see it */
  carom_collide_detail(&t->impact, &options, &unused, &detail);
  pick_describe(out, &t->asked, &t->impact);
  fprintf(out, "# compression ends: %.6g\n# the balls stick: %.6g\n", end_of_compression(t), detail.stick_normal);
  fputs("solver,impulse_N_s,work_J,phase,sticks,v_n_m_s,u_x_m_s,u_z_m_s,d_x_m_s,d_y_m_s,b_x_m_s,b_y_m_s,v1_x_m_s,v1_y_m_s,"
        "v2_x_m_s,v2_y_m_s," RESULT_COLUMNS "\n",
        out);
  for (int s = 0; s < t->asked.solvers.count; s++)
    for (int k = 0; k < t->points; k++)
      print_point(out, t, t->asked.solvers.solver[s], &t->point[s * t->points + k]);
}

/* False after a complaint. */
static bool compute(trace *t) {
  t->point = allocate((size_t)t->points * (size_t)t->asked.solvers.count, sizeof *t->point);
  for (int s = 0; s < t->asked.solvers.count; s++) {
    carom_options options = t->asked.options;
    options.solver = t->asked.solvers.solver[s];
    const carom_status status = carom_trace(&t->impact, &options, (size_t)t->points, &t->point[s * t->points]);
    if (status < 0) {
      complain("id '%s', %s: %s (%s)", t->asked.id, carom_solver_name(options.solver), carom_status_string(status),
               carom_status_name(status));
      return false;
    }
    t->separating |= status == CAROM_SEPARATING;
  }
  if (t->separating)
    complain("id '%s': %s", t->asked.id, carom_status_string(CAROM_SEPARATING));
  return true;
}

static int write_trace(const trace *t) {
  const char *path = t->asked.output == NULL && t->picture == NULL ? "-" : t->asked.output;
  if (path != NULL) {
    FILE *out = output_open(path);
    if (out == NULL)
      return EXIT_USAGE;
    print_trace(out, t);
    if (!output_commit())
      return EXIT_USAGE;
  }
  if (t->picture == NULL)
    return EXIT_GOOD;
  char title[256];
  snprintf(title, sizeof title, "Collision %.200s", t->asked.id);
  if (t->separating) {
    complain("cannot draw %s: there is no collision to draw", t->picture);
    return EXIT_SOME;
  }
  return picture_draw(t->picture, "trace", title, print_trace, t) ? EXIT_GOOD : EXIT_SOME;
}

OPTION(trace, option_points, "points", points, 0, "N", set_count, 2, "points of each solver, 2 or more (default 201)");
OPTION(trace, option_plot, "plot", picture, 0, "OUT", set_picture, 0,
       "draw it with gnuplot: OUT.svg or OUT.png; the CSV is then written only with -o");

static const char about[] =
    "Follows one collision from contact to parting, in equal steps of normal impulse. FILE is a CSV file with the columns\n"
    "that `carom resolve --help` lists, - for standard input; default: the 204 reference collisions.\n";

static const char details[] =
    "columns written:\n"
    "  solver, impulse_N_s     which one; normal impulse so far\n"
    "  work_J                  work of the normal force so far, the sum of |v_n| dP\n"
    "  phase                   compression while the balls approach each other, then restitution\n"
    "  sticks                  1 from where they no longer slip on each other, else 0; always 0 by Euler's method\n"
    "  v_n_m_s                 speed at which they part along the line of centres; negative while they approach\n"
    "  u_x_m_s u_z_m_s         slip of ball 1 on ball 2; y is the line of centres from 1 to 2, z points up, x = y x z\n"
    "  d_x_m_s d_y_m_s         slip of ball 1 over the cloth, and b_x_m_s b_y_m_s of ball 2, in the same axes\n"
    "  v1_x_m_s v1_y_m_s       velocity of ball 1, and v2_x_m_s v2_y_m_s of ball 2, in the same axes\n"
    "  v1x ... w2z             the state as `carom resolve` writes it, m/s and rad/s, along the axes of the table\n\n"
    "exit code: 0; 1 if the picture could not be drawn; 2 for bad usage, unreadable input or a collision in error\n";

static const command_form form = {
    .name = "trace",
    .usage = "--id X [OPTIONS] [FILE]",
    .about = about,
    .options =
        (const option_row *const[]){&option_id, &option_solvers, &option_slip, &option_steps, &option_points, &option_friction,
                                    &option_plot, &option_data, &option_cushion, &option_strict, &option_output, NULL},
    .details = details,
    .example = "carom trace --id pooltool-135 --solver exact,euler --plot trace.svg",
    .files = FILE_OR_NONE,
};

int command_trace(int argc, char **argv) {
  if (cushion_asked(&argc, argv))
    return cushion_trace(argc, argv);
  trace t = {.asked = {.options = COMMAND_OPTIONS, .solvers = {{CAROM_SOLVER_EXACT}, 1}}, .points = 201};
  const char *file;
  int code = parse_arguments(&form, argc, argv, &t, &file);
  if (code >= 0)
    return code;
  if (t.asked.id == NULL) {
    complain("trace needs --id: which collision to follow");
    return usage_hint(&form);
  }
  code = pick_impact(&t.asked, file, &t.impact) && compute(&t) ? write_trace(&t) : EXIT_USAGE;
  free(t.point);
  return code;
}
