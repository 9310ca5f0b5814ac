/* `carom sweep`: one collision over and over, one of its inputs varied in fine steps. */
#include "command.h"
#include "message.h"
#include "option.h"
#include "output.h"
#include "pick.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: carom sweep --id X --over INPUT --from A --to B [OPTIONS] [FILE]\n\n"
    "Resolves one collision many times, INPUT taking equally spaced values from A to B. FILE is a CSV file with the columns "
    "that\n"
    "`carom resolve --help` lists, - for standard input; default: the 204 reference collisions.\n\n"
    "options:\n"
    "  --id X                  which collision: its column id, or the number of its row if there is no such column\n"
    "  --over INPUT            what to vary: a column, such as w1z, u_b or e_b; cut, to turn the line of centres by so many\n"
    "                          degrees; or speed, to multiply all velocities and spins\n"
    "  --from A, --to B        its first and last value\n"
    "  --points N              how many, 2 or more (default 10001)\n"
    "  --kernel LIST           exact (default), euler, or exact,euler\n"
    "  --slip paper|pooltool   sign of the spin in the slip over the cloth: the 2014 paper's (default), or pooltool's\n"
    "  --steps N               steps of Euler's method, 1 or more (default 1000)\n"
    "  --friction LAW          friction between the balls by their slip speed, before the sweep: alciatore or alciatore=a,b,c\n"
    "  --brief                 without the columns v1x to w2z\n"
    "  --data DIR              folder of the reference collisions (default: $CAROM_DATA, else the one that came with carom)\n"
    "  -o, --output OUT        CSV file to write, - for standard output (default)\n"
    "  -h, --help              this text\n\n"
    "columns written:\n"
    "  kernel, value           of the input\n"
    "  throw_deg               angle of ball 2's change of velocity from the line of centres, to the left as seen from above\n"
    "  stick_share             share of the normal impulse after which the balls no longer slip on each other; nan if they do "
    "to\n"
    "                          the end, and by Euler's method\n"
    "  jump                    how far the twelve results (radius times spin), over the largest of them, leave a smooth curve\n"
    "                          between this value and the next: the distance of their step from both neighbouring steps and\n"
    "                          all between. A corner is no jump; nan at the ends\n"
    "  v1x ... w2z, status     as `carom resolve` writes them; v1x to w2z not with --brief\n\n"
    "exit code: 0; 1 if some values make an error; 2 for bad usage or unreadable input\n";

enum { RESULTS = sizeof(carom_result) / sizeof(double) };

/* Which numbers of a carom_impact an input sets; -1: none. */
typedef struct swept_input {
  const char *name;
  int field[2];
} swept_input;

static const swept_input inputs[] = {
    {"cut", {-1, -1}},  {"speed", {-1, -1}}, {"v1x", {3, -1}},  {"v1y", {4, -1}},  {"w1x", {6, -1}},  {"w1y", {7, -1}},
    {"w1z", {8, -1}},   {"v2x", {15, -1}},   {"v2y", {16, -1}}, {"w2x", {18, -1}}, {"w2y", {19, -1}}, {"w2z", {20, -1}},
    {"R", {9, 21}},     {"M", {10, 22}},     {"M1", {10, -1}},  {"M2", {22, -1}},  {"u_s", {11, 23}}, {"u_s1", {11, -1}},
    {"u_s2", {23, -1}}, {"u_b", {24, -1}},   {"e_b", {25, -1}},
};
enum { INPUTS = sizeof inputs / sizeof inputs[0] };

typedef struct sweep {
  pick asked;
  carom_options options;
  carom_impact impact;
  carom_solver solver[CAROM_SOLVER_COUNT];
  int solvers;
  const swept_input *over;
  double from, to;
  int points;
  bool brief;
} sweep;

typedef struct outcome {
  carom_result result;
  carom_status status;
  double value, throw_deg, stick_share, scale;
  double speed[RESULTS]; /* the results, spins times radius */
} outcome;

static void turn_line_of_centres(carom_impact *in, double degrees) {
  const double angle = degrees * (3.14159265358979323846 / 180.0);
  const double x = in->b.r[0] - in->a.r[0], y = in->b.r[1] - in->a.r[1];
  in->b.r[0] = in->a.r[0] + x * cos(angle) - y * sin(angle);
  in->b.r[1] = in->a.r[1] + x * sin(angle) + y * cos(angle);
}

static carom_impact vary(const sweep *s, double value) {
  carom_impact in = s->impact;
  double *number = (double *)&in;
  if (strcmp(s->over->name, "cut") == 0)
    turn_line_of_centres(&in, value);
  else if (strcmp(s->over->name, "speed") == 0)
    for (int k = 0; k < 3; k++) {
      in.a.v[k] *= value;
      in.a.w[k] *= value;
      in.b.v[k] *= value;
      in.b.w[k] *= value;
    }
  else
    for (int k = 0; k < 2; k++)
      if (s->over->field[k] >= 0)
        number[s->over->field[k]] = value;
  return in;
}

static outcome resolve(const sweep *s, carom_solver solver, int k) {
  outcome o = {.value = s->from + (s->to - s->from) * ((double)k / (s->points - 1))};
  const carom_impact in = vary(s, o.value);
  carom_options options = s->options;
  carom_detail detail;
  options.solver = solver;
  o.status = carom_collide_detail(&in, &options, &o.result, &detail);
  o.stick_share = detail.stick_normal / detail.normal;
  const double along[2] = {in.b.r[0] - in.a.r[0], in.b.r[1] - in.a.r[1]};
  const double change[2] = {o.result.v_b[0] - in.b.v[0], o.result.v_b[1] - in.b.v[1]};
  o.throw_deg = atan2(along[0] * change[1] - along[1] * change[0], along[0] * change[0] + along[1] * change[1]) *
                (180.0 / 3.14159265358979323846);
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

static void print_outcome(FILE *out, const sweep *s, const outcome *o, carom_solver solver, double jump) {
  fprintf(out, "%s,%.12g,%.10g,%.6g,%.4g", carom_solver_name(solver), o->value, o->throw_deg, o->stick_share, jump);
  for (int c = 0; c < RESULTS && !s->brief; c++)
    fprintf(out, ",%.12g", ((const double *)&o->result)[c]);
  fprintf(out, ",%s\n", carom_status_name(o->status));
}

/* Returns how many values made an error. */
static int print_sweep(FILE *out, const sweep *s) {
  int errors = 0;
  carom_status first = CAROM_OK;
  double first_at = 0.0;
  pick_describe(out, &s->asked, &s->impact, &s->options);
  fprintf(out, "# over: %s\nkernel,value,throw_deg,stick_share,jump,%sstatus\n", s->over->name,
          s->brief ? "" : "v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z,");
  for (int which = 0; which < s->solvers; which++) {
    const carom_solver solver = s->solver[which];
    outcome at[4] = {0}; /* k - 1 to k + 2, where they exist */
    for (int k = -2; k < s->points; k++) {
      memmove(at, at + 1, 3 * sizeof at[0]);
      if (k + 2 < s->points)
        at[3] = resolve(s, solver, k + 2);
      if (k < 0)
        continue;
      print_outcome(out, s, &at[1], solver, k == 0 || k + 2 >= s->points ? NAN : jump_of(at));
      if (at[1].status < 0 && errors++ == 0) {
        first = at[1].status;
        first_at = at[1].value;
      }
    }
  }
  if (errors > 0)
    complain("%d of the values make an error, first %s = %.6g: %s (%s)", errors, s->over->name, first_at,
             carom_status_string(first), carom_status_name(first));
  return errors;
}

static bool option_number(const char *option, const char *text, double *number) {
  char *end;
  *number = strtod(text, &end);
  const bool good = end != text && *end == '\0' && isfinite(*number);
  if (!good)
    complain("%s is a number, not '%s'", option, text);
  return good;
}

static bool option_over(const char *text, const swept_input **over) {
  char names[256] = "";
  for (int k = 0; k < INPUTS; k++) {
    if (strcmp(text, inputs[k].name) == 0) {
      *over = &inputs[k];
      return true;
    }
    strcat(strcat(names, k > 0 ? " " : ""), inputs[k].name);
  }
  complain("--over is one of %s, not '%s'", names, text);
  return false;
}

int command_sweep(int argc, char **argv) {
  static const struct option options[] = {
      {"id", required_argument, NULL, 'i'},       {"over", required_argument, NULL, 'O'},
      {"from", required_argument, NULL, 'a'},     {"to", required_argument, NULL, 'b'},
      {"points", required_argument, NULL, 'p'},   {"kernel", required_argument, NULL, 'k'},
      {"slip", required_argument, NULL, 's'},     {"steps", required_argument, NULL, 'n'},
      {"friction", required_argument, NULL, 'f'}, {"data", required_argument, NULL, 'd'},
      {"output", required_argument, NULL, 'o'},   {"brief", no_argument, NULL, 'B'},
      {"help", no_argument, NULL, 'h'},           {0},
  };
  sweep s = {.options = carom_default_options(),
             .solver = {CAROM_SOLVER_EXACT},
             .solvers = 1,
             .points = 10001,
             .from = NAN,
             .to = NAN};
  const char *path = "-";
  bool good = true;
  int option;
  while (good && (option = getopt_long(argc, argv, "o:h", options, NULL)) != -1)
    switch (option) {
    case 'i':
      s.asked.id = optarg;
      break;
    case 'O':
      good = option_over(optarg, &s.over);
      break;
    case 'a':
      good = option_number("--from", optarg, &s.from);
      break;
    case 'b':
      good = option_number("--to", optarg, &s.to);
      break;
    case 'p':
      good = option_count("--points", optarg, 2, &s.points);
      break;
    case 'k':
      good = pick_solvers(optarg, s.solver, &s.solvers);
      break;
    case 's':
      good = option_slip(optarg, &s.options.slip);
      break;
    case 'n':
      good = option_steps(optarg, &s.options.steps);
      break;
    case 'f':
      good = option_law(optarg, &s.asked.law);
      s.asked.by_law = true;
      break;
    case 'B':
      s.brief = true;
      break;
    case 'd':
      s.asked.folder = optarg;
      break;
    case 'o':
      path = optarg;
      break;
    case 'h':
      fputs(help, stdout);
      return EXIT_GOOD;
    default:
      return usage_hint("sweep");
    }
  if (!good)
    return EXIT_USAGE;
  if (argc - optind > 1) {
    complain("sweep takes one file, but got %d", argc - optind);
    return usage_hint("sweep");
  }
  if (s.asked.id == NULL || s.over == NULL || isnan(s.from) || isnan(s.to)) {
    complain("sweep needs --id, --over, --from and --to");
    return usage_hint("sweep");
  }
  s.asked.file = argv[optind];
  FILE *out = pick_impact(&s.asked, &s.impact) ? output_open(path) : NULL;
  if (out == NULL)
    return EXIT_USAGE;
  const int errors = print_sweep(out, &s);
  if (!output_commit())
    return EXIT_USAGE;
  return errors > 0 ? EXIT_SOME : EXIT_GOOD;
}
