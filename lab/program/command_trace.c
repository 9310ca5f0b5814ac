/* `carom trace`: one row against normal impulse, as a CSV file and as a picture. */
#include "command.h"
#include "memory.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "pick.h"
#include "picture.h"
#include "subcommands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct trace {
  shared_options asked;
  const row_kind *kind;
  double row[MOST_NUMBERS];
  int points;
  const char *picture;
  trace_point *point; /* of the first variant, then of the next */
  bool separating;
} trace;

static void print_point(FILE *out, const trace *t, int variant, const trace_point *p) {
  fputs(t->kind->name(&t->asked, variant), out);
  write_numbers(out, (const double[]){p->impulse, p->work}, 2);
  fprintf(out, ",%s", p->restitution ? "restitution" : "compression");
  for (int k = 0; k < 2 && t->kind->contacts[k] != NULL; k++)
    fprintf(out, ",%d", p->sticks[k]);
  write_numbers(out, p->number, (size_t)t->kind->trace_numbers);
  fputc('\n', out);
}

/* Where compression ends: the normal velocity is all but linear between two points. NAN where
 * nothing meets. */
static double end_of_compression(const trace *t) {
  for (int k = 1; k < t->points; k++) {
    const trace_point *a = &t->point[k - 1], *b = &t->point[k];
    const double v = a->number[0], change = b->number[0] - v;
    if (!a->restitution && b->restitution)
      return fmin(a->impulse - v * (b->impulse - a->impulse) / change, b->impulse);
  }
  return (double)NAN;
}

/* What it is, as notes before the header. */
static void print_notes(FILE *out, const trace *t) {
  double stuck[2];
  t->kind->describe(out, &t->asked, t->row);
  t->kind->stuck(&t->asked, t->row, t->points, t->point, stuck);
  fprintf(out, "# compression ends: %.6g\n", end_of_compression(t));
  for (int k = 0; k < 2 && t->kind->contacts[k] != NULL; k++)
    fprintf(out, "# %s: %.6g\n", t->kind->contacts[k], stuck[k]);
}

static void print_trace(FILE *out, const void *data) {
  const trace *t = data;
  if (!t->asked.bare)
    print_notes(out, t);
  /* The points of each variant. */
  fprintf(out, "%s,impulse_N_s,work_J,phase,%s,%s\n", t->kind->which, t->kind->trace_columns,
          t->kind->result_columns);
  for (int variant = 0; variant < variants_of(&t->asked); variant++)
    for (int k = 0; k < t->points; k++)
      print_point(out, t, variant, &t->point[variant * t->points + k]);
}

/* False after a complaint. */
static bool compute(trace *t) {
  const int variants = variants_of(&t->asked);
  t->point = allocate((size_t)t->points * (size_t)variants, sizeof *t->point);
  for (int variant = 0; variant < variants; variant++) {
    const carom_status status =
        t->kind->trace(&t->asked, variant, t->row, t->points, &t->point[variant * t->points]);
    const char *name = t->kind->name(&t->asked, variant);
    if (status == CAROM_ERROR_CUSHION_MODEL)
      complain("%s is a closed form and has no course; --model mathavan and euler have", name);
    else if (status < 0)
      complain("id '%s', %s: %s (%s)", t->asked.id, name, carom_status_string(status),
               carom_status_name(status));
    if (status < 0)
      return false;
    t->separating |= status == CAROM_SEPARATING;
  }
  if (t->separating)
    complain("id '%s': %s", t->asked.id, carom_status_string(CAROM_SEPARATING));
  return true;
}

/* Returns an exit code. */
static int write_trace(const trace *t) {
  const char *path = t->asked.output == NULL && t->picture == NULL ? "-" : t->asked.output;
  if (path != NULL && !file_draw(path, print_trace, t))
    return EXIT_USAGE;
  if (t->picture == NULL)
    return EXIT_GOOD;
  if (t->separating) {
    complain("cannot draw %s: there is no %s to draw", t->picture, t->kind->noun);
    return EXIT_SOME;
  }
  trace noted = *t;
  noted.asked.bare = false; /* the picture is drawn by them */
  char title[256];
  snprintf(title, sizeof title, "%s %.200s", t->asked.cushion ? "Impact" : "Collision",
           t->asked.id);
  return picture_draw(t->picture, "trace", title, print_trace, &noted) ? EXIT_GOOD : EXIT_SOME;
}

OPTION(trace, option_points, "points", points, 0, "N", set_count, 2,
       "points, 2 or more (default 201)");
OPTION(trace, option_plot, "plot", picture, 0, "OUT", set_picture, 0,
       "draw the quantities, by gnuplot: OUT.svg, OUT.png or OUT.pdf. The CSV is then written only "
       "with -o");

static const command_form form = {
    .name = "trace",
    .usage = "--id X [OPTIONS] [FILE]",
    .about = "Writes the state during one collision, from contact to separation, in equal steps of "
             "normal impulse; with --cushion that during one impact on a cushion, by the model "
             "mathavan or euler. FILE has the format that `carom resolve` reads; - is CSV on "
             "standard input; without FILE, the 204 reference collisions.\n",
    .options =
        (const option_row *const[]){&option_id, &option_cushion, &option_points, &option_steps,
                                    &option_plot, &option_bare, &option_strict, &option_output,
                                    &option_solvers, &option_slip, &option_friction, &option_data,
                                    &option_model, &option_with, &option_convention, &option_law,
                                    &option_least_step, NULL},
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
        "  v1x ... w2z          the state as `carom resolve` writes it, m/s and rad/s, along the "
        "axes of the table\n"
        "\n"
        "columns written with --cushion:\n"
        "  model, impulse_N_s   the model; the normal impulse so far\n"
        "  work_J, phase        as above; compression while the ball moves into the cushion\n"
        "  nose_sticks          1 while the ball does not slip on the nose, else 0, and "
        "cloth_sticks on the cloth; always 0 with Euler's method\n"
        "  v_n_m_s              speed into the nose, along its normal; negative while ball and "
        "cushion separate\n"
        "  s_x_m_s s_t_m_s      slip on the nose, along the cushion and upwards across it\n"
        "  c_x_m_s c_y_m_s      slip on the cloth; y points into the cushion, x along it, z up\n"
        "  v_x_m_s v_y_m_s      velocity in the same axes\n"
        "  vx ... wz            the motion, m/s and rad/s, along the axes of the table\n"
        "\n"
        "exit code: 0; 1 if the picture could not be drawn; 2 for bad usage, unreadable input or a "
        "row with an error\n",
    .example = "carom trace --id pooltool-135 --solver exact,euler --plot trace.svg",
    .files = FILE_OR_NONE,
};

int command_trace(int argc, char **argv) {
  trace t = {.asked = {.options = COMMAND_OPTIONS}, .points = 201};
  const char *file;
  int code = parse_arguments(&form, argc, argv, &t, &file);
  if (code >= 0)
    return code;
  if (t.asked.id == NULL) {
    complain("trace needs --id: which row to follow");
    return usage_hint(&form);
  }
  t.kind = kind_of(&t.asked);
  code =
      output_possible(t.picture) && pick_rows(&t.asked, file, &t.asked.id, 1, &t.row) && compute(&t)
          ? write_trace(&t)
          : EXIT_USAGE;
  free(t.point);
  return code;
}
