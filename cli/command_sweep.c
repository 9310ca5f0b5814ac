/* `carom sweep`: one collision over and over, one of its inputs varied in fine steps. */
#include "command.h"
#include "cushion_rows.h"
#include "impacts.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "pick.h"
#include "picture.h"
#include "sink.h"
#include "subcommands.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { RESULTS = sizeof(carom_result) / sizeof(double), MOST_IDS = 16, PLOTTED = 361 };
static const double degree = 3.14159265358979323846 / 180.0;

/* What can be varied: columns of a collision, u_s for u_s1 and u_s2, and two that change more than their numbers. */
static const char inputs[] = "cut speed v1x v1y w1x w1y w1z v2x v2y w2x w2y w2z R M M1 M2 u_s u_s1 u_s2 u_b e_b";

typedef struct sweep {
  shared_options asked;
  char *ids; /* as they were given, then each with its NUL */
  const char *id[MOST_IDS];
  carom_impact impacts[MOST_IDS];
  int id_count;
  carom_impact impact; /* the one that is swept now */
  const char *over;
  double from, to;
  int points;
  bool brief;
  const char *picture;
} sweep;

typedef struct outcome {
  carom_result result;
  carom_status status;
  double value, mu_ball, throw_deg, stick_share, scale;
  double speed[RESULTS]; /* the results, spins times radius */
} outcome;

static void turn_line_of_centres(carom_impact *in, double degrees) {
  const double angle = degrees * degree;
  const double x = in->b.r[0] - in->a.r[0], y = in->b.r[1] - in->a.r[1];
  in->b.r[0] = in->a.r[0] + x * cos(angle) - y * sin(angle);
  in->b.r[1] = in->a.r[1] + x * sin(angle) + y * cos(angle);
}

static carom_impact vary(const sweep *s, double value) {
  carom_impact in = s->impact;
  double *number = (double *)&in;
  const bool both_cloths = strcmp(s->over, "u_s") == 0;
  const unsigned fields = both_cloths ? impact_fields("u_s1") | impact_fields("u_s2") : impact_fields(s->over);
  for (int k = 0; k < IMPACT_FIELDS; k++)
    if ((fields >> k & 1u) != 0)
      number[k] = value;
  if (strcmp(s->over, "cut") == 0)
    turn_line_of_centres(&in, value);
  for (int k = 0; k < 3 && strcmp(s->over, "speed") == 0; k++) {
    in.a.v[k] *= value;
    in.a.w[k] *= value;
    in.b.v[k] *= value;
    in.b.w[k] *= value;
  }
  if (s->asked.friction.given) /* it depends on the slip, and so on what is varied */
    in.mu_ball = carom_mu_ball(&in, s->asked.friction.law);
  return in;
}

static outcome resolve(const sweep *s, carom_solver solver, int k) {
  outcome o = {.value = s->from + (s->to - s->from) * ((double)k / (s->points - 1))};
  const carom_impact in = vary(s, o.value);
  carom_options options = s->asked.options;
  carom_detail detail;
  options.solver = solver;
  o.status = carom_collide_detail(&in, &options, &o.result, &detail);
  o.mu_ball = in.mu_ball;
  o.stick_share = detail.stick_normal / detail.normal;
  const double along[2] = {in.b.r[0] - in.a.r[0], in.b.r[1] - in.a.r[1]};
  const double change[2] = {o.result.b.v[0] - in.b.v[0], o.result.b.v[1] - in.b.v[1]};
  o.throw_deg = atan2(along[0] * change[1] - along[1] * change[0], along[0] * change[0] + along[1] * change[1]) / degree;
  for (int c = 0; c < RESULTS; c++) {
    o.speed[c] = ((const double *)&o.result)[c] * (c / 3 % 2 == 1 ? in.a.radius : 1.0);
    o.scale = fmax(o.scale, fabs(o.speed[c]));
  }
  return o;
}

/* How far the step from at[1] to at[2] lies outside what the steps before and after it span. */
static double jump_of(const outcome at[4]) {
  double most = 0.0;
  for (int c = 0; c < RESULTS; c++) {
    double step[3];
    for (int k = 0; k < 3; k++)
      step[k] = at[k + 1].speed[c] - at[k].speed[c];
    most = fmax(most, fmax(step[1] - fmax(step[0], step[2]), fmin(step[0], step[2]) - step[1]));
  }
  return most / at[1].scale;
}

static void print_outcome(FILE *out, const sweep *s, const char *id, const outcome *o, carom_solver solver, double jump) {
  fputs(carom_solver_name(solver), out);
  write_numbers(out, (const double[]){o->value, o->throw_deg, o->stick_share, jump}, 4);
  write_numbers(out, (const double *)&o->result, s->brief ? 0 : RESULTS);
  fprintf(out, ",%s", carom_status_name(o->status));
  write_numbers(out, &o->mu_ball, 1);
  fputc(',', out);
  write_id(out, id);
  fputc('\n', out);
}

/* One collision by one solver; returns how many values made an error. */
static int print_curve(FILE *out, const sweep *s, const char *id, carom_solver solver, double done, double total) {
  int errors = 0;
  outcome first = {0}, at[4] = {0}; /* k - 1 to k + 2, where they exist */
  for (int k = -2; k < s->points; k++) {
    memmove(at, at + 1, 3 * sizeof at[0]);
    if (k + 2 < s->points)
      at[3] = resolve(s, solver, k + 2);
    if (k < 0)
      continue;
    progress_show("values", done + k, total);
    print_outcome(out, s, id, &at[1], solver, k == 0 || k + 2 >= s->points ? NAN : jump_of(at));
    if (at[1].status < 0 && errors++ == 0)
      first = at[1];
  }
  progress_clear();
  if (errors > 0)
    complain("%d of the values make an error, first %s = %.6g: %s (%s)", errors, s->over, first.value,
             carom_status_string(first.status), carom_status_name(first.status));
  return errors;
}

/* Returns how many values made an error. */
static int print_sweep(FILE *out, sweep *s) {
  int errors = 0;
  double done = 0.0;
  const double total = (double)s->points * s->id_count * s->asked.solvers.count;
  s->asked.id = s->id[0];
  pick_describe(out, &s->asked, &s->impacts[0]);
  fprintf(out, "# over: %s\nsolver,value,throw_deg,stick_share,jump,%sstatus,mu_ball,id\n", s->over,
          s->brief ? "" : RESULT_COLUMNS ",");
  for (int which = 0; which < s->id_count; which++)
    for (int k = 0; k < s->asked.solvers.count; k++, done += s->points) {
      s->impact = s->impacts[which];
      errors += print_curve(out, s, s->id[which], s->asked.solvers.solver[k], done, total);
    }
  return errors;
}

/* For the picture: of these points an SVG can show all. */
static void print_plotted(FILE *out, const void *data) {
  sweep s = *(const sweep *)data;
  s.points = s.points < PLOTTED ? s.points : PLOTTED;
  s.brief = true;
  print_sweep(out, &s);
}

/* Cuts the ids apart; false after a complaint. */
static bool split_ids(sweep *s) {
  char *rest;
  for (char *id = strtok_r(s->ids, ",", &rest); id != NULL; id = strtok_r(NULL, ",", &rest)) {
    if (s->id_count == MOST_IDS) {
      complain("--id takes up to %d collisions", MOST_IDS);
      return false;
    }
    s->id[s->id_count++] = id;
  }
  return s->id_count > 0;
}

static OPTION_SET(set_over) {
  *(const char **)field = text;
  if (place_among(inputs, text, strlen(text)) >= 0)
    return true;
  complain("--%s is one of %s, not '%s'", row->name, inputs, text);
  return false;
}

OPTION(sweep, option_over, "over", over, 0, "INPUT", set_over, 0,
       "what to vary: a column, such as w1z, u_b or e_b; cut, to turn the line of centres by\n"
       "so many degrees; or speed, to multiply all velocities and spins");
OPTION(sweep, option_from, "from", from, 0, "A", set_number, 0, "its first value");
OPTION(sweep, option_to, "to", to, 0, "B", set_number, 0, "its last value");
OPTION(sweep, option_points, "points", points, 0, "N", set_count, 2, "how many, 2 or more (default 10001)");
OPTION(sweep, option_ids, "id", ids, 0, "X", set_text, 0,
       "which collision: its column id, or the number of its row if there is none; several with\n"
       "commas are swept one after the other");
OPTION(sweep, option_plot, "plot", picture, 0, "OUT", set_picture, 0,
       "draw the throw with gnuplot, a curve for each collision and solver: OUT.svg or OUT.png;\n"
       "the CSV is then written only with -o");
OPTION(sweep, option_brief, "brief", brief, 0, NULL, set_flag, 0, "without the columns v1x to w2z");

static const char about[] =
    "Resolves one collision many times, INPUT taking equally spaced values from A to B. FILE is a CSV file with the columns\n"
    "that `carom resolve --help` lists, - for standard input; default: the 204 reference collisions.\n";

static const char details[] =
    "columns written:\n"
    "  solver, value           of the input\n"
    "  throw_deg               angle of ball 2's change of velocity from the line of centres, to the left from above\n"
    "  stick_share             share of the normal impulse after which the balls no longer slip on each other; nan if they do\n"
    "                          to the end, and by Euler's method\n"
    "  jump                    how far the twelve results (radius times spin), over the largest of them, leave a smooth curve\n"
    "                          between this value and the next: the distance of their step from both neighbouring steps\n"
    "                          and all between. A corner is no jump; nan at the ends\n"
    "  v1x ... w2z, status     as `carom resolve` writes them; v1x to w2z not with --brief\n"
    "  mu_ball                 friction between the balls; with --friction that of the law at this value\n"
    "  id                      of the collision\n\n"
    "exit code: 0; 1 if some values make an error; 2 for bad usage or unreadable input\n";

static const command_form form = {
    .name = "sweep",
    .usage = "--id X --over INPUT --from A --to B [OPTIONS] [FILE]",
    .about = about,
    .options = (const option_row *const[]){&option_ids, &option_over, &option_from, &option_to, &option_points, &option_solvers,
                                           &option_slip, &option_steps, &option_friction, &option_brief, &option_plot,
                                           &option_data, &option_cushion, &option_strict, &option_output, NULL},
    .details = details,
    .example = "carom sweep --id pooltool-135 --over w1z --from -60 --to 60 --brief -o sweep.csv",
    .files = FILE_OR_NONE,
};

int command_sweep(int argc, char **argv) {
  if (cushion_asked(&argc, argv))
    return cushion_sweep(argc, argv);
  sweep s = {
      .asked = {.options = COMMAND_OPTIONS, .solvers = {{CAROM_SOLVER_EXACT}, 1}}, .points = 10001, .from = NAN, .to = NAN};
  const char *file;
  const int code = parse_arguments(&form, argc, argv, &s, &file);
  if (code >= 0)
    return code;
  if (s.ids == NULL || s.over == NULL || isnan(s.from) || isnan(s.to) || !split_ids(&s)) {
    complain("sweep needs --id, --over, --from and --to");
    return usage_hint(&form);
  }
  if (s.asked.friction.given && strcmp(s.over, "u_b") == 0) {
    complain("--over u_b has no effect with --friction, which says what u_b is");
    return EXIT_USAGE;
  }
  if (!pick_impacts(&s.asked, file, s.id, (size_t)s.id_count, s.impacts))
    return EXIT_USAGE;
  int errors = 0;
  if (s.picture == NULL || s.asked.output != NULL) {
    FILE *out = output_open(s.asked.output != NULL ? s.asked.output : "-");
    if (out == NULL)
      return EXIT_USAGE;
    errors = print_sweep(out, &s);
    if (!output_commit())
      return EXIT_USAGE;
  }
  const bool drawn = s.picture == NULL || picture_draw(s.picture, "sweep", "Throw of the object ball", print_plotted, &s);
  return errors > 0 || !drawn ? EXIT_SOME : EXIT_GOOD;
}
