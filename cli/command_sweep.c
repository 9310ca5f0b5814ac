/* `carom sweep`: some rows over and over, one of their inputs varied in fine steps. */
#include "command.h"
#include "derived.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "pick.h"
#include "picture.h"
#include "sink.h"
#include "subcommands.h"
#include "words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_IDS = 16, PLOTTED = 361, MOST_LEAD = 2 };

typedef struct sweep {
  shared_options asked;
  const row_kind *kind;
  char *ids; /* as they were given, then each with its NUL */
  const char *id[MOST_IDS];
  double rows[MOST_IDS][MOST_NUMBERS];
  int id_count;
  const char *over;
  double from, to;
  int points;
  bool brief, only_rows;
  const char *picture;
} sweep;

/* A curve: one row by one solver or model. */
typedef struct curve {
  const sweep *s;
  int row, variant;
} curve;

typedef struct outcome {
  double result[MOST_RESULTS], lead[MOST_LEAD], tail, value, scale;
  carom_status status;
  double speed[MOST_RESULTS]; /* the results, spins times radius */
} outcome;

/* Turns a point about the vertical through another. */
static void turn(double *r, const double *centre, double degrees) {
  const double angle = degrees * degree, x = r[0] - centre[0], y = r[1] - centre[1];
  r[0] = centre[0] + x * cos(angle) - y * sin(angle);
  r[1] = centre[1] + x * sin(angle) + y * cos(angle);
}

/* Puts the value into the row: into the number of that column, or into all that the word stands
 * for. */
static void vary(const sweep *s, double *row, double value) {
  const row_kind *kind = s->kind;
  for (int k = 0; k < kind->numbers; k++)
    if (kind_fills(kind, k, s->over))
      row[k] = value;
  if (strcmp(s->over, kind->turning) == 0)
    turn(row + kind->direction[1],
         kind->direction[0] >= 0 ? row + kind->direction[0] : (const double[2]){0.0}, value);
  /* All velocities, and the spins behind them, as those of the first ball. */
  const double *v = row + kind->motion[0], share = value / hypot(v[0], v[1]);
  for (int ball = 0; ball < 2 && strcmp(s->over, "speed") == 0 && kind->motion[ball] >= 0; ball++)
    for (int k = 0; k < 6; k++)
      row[kind->motion[ball] + k] *= share;
  if (kind->prepare != NULL)
    kind->prepare(&s->asked, row);
}

/* Makes the row of a point; returns the value that is varied. */
static double make_row(const curve *c, int point, double row[MOST_NUMBERS]) {
  const sweep *s = c->s;
  const double value = s->from + (s->to - s->from) * ((double)point / (s->points - 1));
  memcpy(row, s->rows[c->row], MOST_NUMBERS * sizeof *row);
  vary(s, row, value);
  return value;
}

static outcome resolve(const curve *c, int point) {
  const sweep *s = c->s;
  double row[MOST_NUMBERS];
  outcome o = {.value = make_row(c, point, row)};
  o.status = s->kind->look(&s->asked, c->variant, row, o.result, o.lead, &o.tail);
  for (int k = 0; k < s->kind->results; k++) {
    o.speed[k] = o.result[k] * (k / 3 % 2 == 1 ? row[s->kind->radius] : 1.0);
    o.scale = fmax(o.scale, fabs(o.speed[k]));
  }
  return o;
}

/* How far the step from at[1] to at[2] lies outside what the steps before and after it span. */
static double jump_of(const outcome at[4], int results) {
  double most = 0.0;
  for (int c = 0; c < results; c++) {
    double step[3];
    for (int k = 0; k < 3; k++)
      step[k] = at[k + 1].speed[c] - at[k].speed[c];
    most = fmax(most, fmax(step[1] - fmax(step[0], step[2]), fmin(step[0], step[2]) - step[1]));
  }
  return most / at[1].scale;
}

static void print_outcome(FILE *out, const curve *c, const outcome *o, double jump) {
  const sweep *s = c->s;
  fputs(s->kind->name(&s->asked, c->variant), out);
  write_numbers(out, &o->value, 1);
  write_numbers(out, o->lead, (size_t)s->kind->lead);
  write_numbers(out, &jump, 1);
  write_numbers(out, o->result, s->brief ? 0 : (size_t)s->kind->results);
  fprintf(out, ",%s", carom_status_name(o->status));
  write_numbers(out, &o->tail, 1);
  fputc(',', out);
  write_id(out, s->id[c->row]);
  fputc('\n', out);
}

/* Returns how many values made an error. */
static int print_curve(FILE *out, const curve *c, double done, double total) {
  const sweep *s = c->s;
  int errors = 0;
  outcome first = {0}, at[4] = {0}; /* k - 1 to k + 2, where they exist: a jump needs both
                                       neighbours */
  for (int k = -2; k < s->points; k++) {
    memmove(at, at + 1, 3 * sizeof at[0]);
    if (k + 2 < s->points)
      at[3] = resolve(c, k + 2);
    if (k < 0)
      continue;
    progress_show("values", done + k, total);
    print_outcome(out, c, &at[1],
                  k == 0 || k + 2 >= s->points ? (double)NAN : jump_of(at, s->kind->results));
    if (at[1].status < 0 && errors++ == 0)
      first = at[1];
  }
  progress_clear();
  if (errors > 0)
    complain("%d of the values make an error, first %s = %.6g: %s (%s)", errors, s->over,
             first.value, carom_status_string(first.status), carom_status_name(first.status));
  return errors;
}

/* The rows themselves, as `carom resolve` reads them; the id of each with the value. */
static void print_rows(FILE *out, const sweep *s) {
  write_row_header(out, s->kind);
  for (int k = 0; k < s->id_count * s->points; k++) {
    double row[MOST_NUMBERS];
    char id[256], number[NUMBER_TEXT];
    const double value = make_row(&(curve){s, k / s->points, 0}, k % s->points, row);
    snprintf(id, sizeof id, "%.200s:%s", s->id[k / s->points], number_text(value, number));
    write_row(out, s->kind, id, row);
  }
}

/* What is swept, on an axis. */
static const char *axis_of(const sweep *s) {
  static const char *const axes[][2] = {{"cut", "line of centres turned by (degrees)"},
                                        {"angle", "cushion turned by (degrees)"},
                                        {"speed", "speed (m/s)"},
                                        {"w1z", "side spin of ball 1 (rad/s)"}};
  for (size_t k = 0; k < sizeof axes / sizeof axes[0]; k++)
    if (strcmp(s->over, axes[k][0]) == 0)
      return axes[k][1];
  return s->over;
}

/* Returns how many values made an error. */
static int print_sweep(FILE *out, sweep *s) {
  const int variants = variants_of(&s->asked);
  const double total = (double)s->points * s->id_count * variants;
  int errors = 0;
  double done = 0.0;
  /* The notes are of the first row. */
  s->asked.id = s->id[0];
  if (!s->asked.bare) {
    s->kind->describe(out, &s->asked, s->rows[0]);
    fprintf(out, "# over: %s\n", s->over);
  }
  fprintf(out, "%s,value,%sjump,%s%sstatus,%s,id\n", s->kind->which, s->kind->lead_columns,
          s->brief ? "" : s->kind->result_columns, s->brief ? "" : ",", s->kind->tail_columns);
  for (int row = 0; row < s->id_count; row++)
    for (int variant = 0; variant < variants; variant++, done += s->points)
      errors += print_curve(out, &(curve){s, row, variant}, done, total);
  return errors;
}

/* The data of figures/curves.gp: of these points an SVG can show all. */
static void print_plotted(FILE *out, const void *data) {
  sweep s = *(const sweep *)data;
  const int variants = variants_of(&s.asked);
  s.points = s.points < PLOTTED ? s.points : PLOTTED;
  fprintf(out, "# x: %s\n# y: %s\n", axis_of(&s), s.kind->axis);
  for (int k = 0; k < s.id_count * variants; k++)
    fprintf(out, "# curve %d: %s%s%s\n", k + 1, s.id[k / variants], variants > 1 ? ", " : "",
            variants > 1 ? s.kind->name(&s.asked, k % variants) : "");
  fputs("curve,x,y\n", out);
  for (int k = 0; k < s.id_count * variants; k++)
    for (int point = 0; point < s.points; point++) {
      const outcome o = resolve(&(curve){&s, k / variants, k % variants}, point);
      fprintf(out, "%d,%.9g,%.9g\n", k + 1, o.value, s.kind->lead > 0 ? o.lead[0] : o.tail);
    }
}

/* Cuts the ids apart; false after a complaint. */
static bool split_ids(sweep *s) {
  char *rest;
  for (char *id = strtok_r(s->ids, ",", &rest); id != NULL; id = strtok_r(NULL, ",", &rest)) {
    if (s->id_count == MOST_IDS) {
      complain("--id takes up to %d rows", MOST_IDS);
      return false;
    }
    s->id[s->id_count++] = id;
  }
  return s->id_count > 0;
}

/* False after a complaint. */
static bool can_vary(const sweep *s) {
  char hint[HINT_TEXT];
  if (place_among(s->kind->inputs, s->over, strlen(s->over)) < 0) {
    complain("--over is one of %s, not '%s'%s", s->kind->inputs, s->over,
             did_you_mean(s->over, s->kind->inputs, hint));
    return false;
  }
  for (int k = 0; k < s->id_count; k++)
    if (strcmp(s->over, "speed") == 0 &&
        hypot(s->rows[k][s->kind->motion[0]], s->rows[k][s->kind->motion[0] + 1]) == 0.0) {
      complain("--over speed needs a ball that moves: in row '%s' the first one is at rest",
               s->id[k]);
      return false;
    }
  if (s->asked.friction.given && strcmp(s->over, "u_b") == 0) {
    complain("--over u_b has no effect with --friction, which says what u_b is");
    return false;
  }
  return true;
}

/* Friction that depends on the slip, which changes with what is varied, is a number here unless
 * a law is given. */
static void warn_of_constant(const sweep *s) {
  if (s->kind->prepare != NULL && !s->asked.friction.given &&
      place_among("cut speed v1x v1y w1x w1y w1z v2x v2y w2x w2y w2z", s->over, strlen(s->over)) >=
          0)
    complain("u_b stays constant; that of real balls depends on their slip: --friction alciatore "
             "applies such a law to every value");
}

OPTION(sweep, option_over, "over", over, 0, "cut|angle|speed|INPUT", set_text, 0,
       "what to vary: a column, such as w1z, u_b or e_b; cut: turns the line of centres by so many "
       "degrees; angle: turns the cushion; speed: that of the first ball, m/s, and all other "
       "velocities and spins in proportion");
OPTION(sweep, option_from, "from", from, 0, "A", set_number, 0, "first value of INPUT");
OPTION(sweep, option_to, "to", to, 0, "B", set_number, 0, "last value of INPUT");
OPTION(sweep, option_points, "points", points, 0, "N", set_count, 2,
       "number of values, 2 or more (default 10001)");
OPTION(sweep, option_ids, "id", ids, 0, "X", set_text, 0,
       "the row with this id; its number, from 1, if there is no column id. Several ids, separated "
       "by commas, are swept one after the other");
OPTION(sweep, option_plot, "plot", picture, 0, "OUT", set_picture, 0,
       "draw the throw, with --cushion the rebound angle, by gnuplot, a curve for each row and "
       "solver: OUT.svg, OUT.png or OUT.pdf. The CSV is then written only with -o");
OPTION(sweep, option_brief, "brief", brief, 0, NULL, set_flag, 0,
       "leave out the columns v1x to w2z, or vx to wz");

OPTION(sweep, option_rows, "rows", only_rows, 0, NULL, set_flag, 0,
       "write the rows for `carom resolve`, instead of their results");

static const command_form form = {
    .name = "sweep",
    .usage = "--id X --over INPUT --from A --to B [OPTIONS] [FILE]",
    .about = "Resolves one collision, with --cushion one impact on a cushion, for equally spaced "
             "values of INPUT from A to B. FILE has the format that `carom resolve` reads; - is "
             "CSV on standard input; without FILE, the 204 reference collisions.\n",
    .options =
        (const option_row *const[]){
            &option_ids,     &option_over,       &option_from,  &option_to,
            &option_cushion, &option_points,     &option_steps, &option_brief,
            &option_rows,    &option_bare,       &option_plot,  &option_strict,
            &option_output,  &option_solvers,    &option_slip,  &option_friction,
            &option_data,    &option_model,      &option_with,  &option_convention,
            &option_law,     &option_least_step, NULL},
    .details =
        "columns written:\n"
        "  solver, value        the solver, with --cushion the model; the value of INPUT\n"
        "  throw_deg            angle of ball 2's change of velocity from the line of centres, to "
        "the left from above\n"
        "  stick_share          share of the normal impulse after which the balls no longer slip "
        "on each other; nan if they slip to the end, and with Euler's method\n"
        "  jump                 how far the results (radius times spin), over the largest of them, "
        "leave a smooth curve between this value and the next: the distance of their step from "
        "both neighbouring steps and all between. A corner is no jump; nan at the ends\n"
        "  v1x ... w2z, status  as `carom resolve` writes them; v1x to w2z not with --brief\n"
        "  mu_ball              friction between the balls; with --friction alciatore, that of the "
        "law at this value\n"
        "  id                   the id of the row\n"
        "With --cushion there is no throw_deg, stick_share or mu_ball, but rebound_deg: the angle "
        "of the velocity after from the normal, degrees; a mirror without loss keeps it.\n"
        "\n"
        "exit code: 0; 1 if some values give an error; 2 for bad usage or unreadable input\n",
    .example = "carom sweep --id pooltool-135 --over u_b --from 0 --to 0.2 -o sweep.csv",
    .files = FILE_OR_NONE,
};

int command_sweep(int argc, char **argv) {
  sweep s = {.asked = {.options = COMMAND_OPTIONS},
             .points = 10001,
             .from = (double)NAN,
             .to = (double)NAN};
  const char *file;
  const int code = parse_arguments(&form, argc, argv, &s, &file);
  if (code >= 0)
    return code;
  if (s.ids == NULL || s.over == NULL || isnan(s.from) || isnan(s.to) || !split_ids(&s)) {
    complain("sweep needs --id, --over, --from and --to");
    return usage_hint(&form);
  }
  s.kind = kind_of(&s.asked);
  if (!output_possible(s.picture) || !pick_rows(&s.asked, file, s.id, (size_t)s.id_count, s.rows) ||
      !can_vary(&s))
    return EXIT_USAGE;
  warn_of_constant(&s);
  /* The CSV, unless only the picture is asked for. */
  int errors = 0;
  if (s.picture == NULL || s.asked.output != NULL) {
    FILE *out = output_open(s.asked.output != NULL ? s.asked.output : "-");
    if (out == NULL)
      return EXIT_USAGE;
    if (s.only_rows)
      print_rows(out, &s);
    else
      errors = print_sweep(out, &s);
    if (!output_commit())
      return EXIT_USAGE;
  }
  const bool drawn =
      s.picture == NULL || picture_draw(s.picture, "curves", s.kind->title, print_plotted, &s);
  return errors > 0 || !drawn ? EXIT_SOME : EXIT_GOOD;
}
