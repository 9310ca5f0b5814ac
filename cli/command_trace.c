/* `carom trace`: one collision against normal impulse, as a CSV file and as a picture. */
#include "command.h"
#include "message.h"
#include "option.h"
#include "output.h"
#include "pick.h"
#include "picture.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: carom trace --id X [OPTIONS] [FILE]\n\n"
    "Follows one collision from contact to parting, in equal steps of normal impulse. FILE is a CSV file with the columns "
    "that\n"
    "`carom resolve --help` lists, - for standard input; default: the 204 reference collisions.\n\n"
    "options:\n"
    "  --id X                  which collision: its column id, or the number of its row if there is no such column\n"
    "  --kernel LIST           exact (default), euler, or exact,euler\n"
    "  --slip paper|pooltool   sign of the spin in the slip over the cloth: the 2014 paper's (default), or pooltool's\n"
    "  --steps N               steps of Euler's method, 1 or more (default 1000)\n"
    "  --points N              points of each kernel, 2 or more (default 201)\n"
    "  --friction LAW          friction between the balls by their slip speed instead of the column u_b: alciatore, or\n"
    "                          alciatore=a,b,c (mu = a + b exp(-c |u|))\n"
    "  --plot OUT              draw it with gnuplot: OUT.svg or OUT.png\n"
    "  --data DIR              folder of the reference collisions (default: $CAROM_DATA, else the one that came with carom)\n"
    "  -o, --output OUT        CSV file to write, - for standard output (default, but none with --plot)\n"
    "  -h, --help              this text\n\n"
    "columns written:\n"
    "  kernel\n"
    "  impulse_N_s             normal impulse so far\n"
    "  work_J                  work of the normal force so far, the sum of |v_n| dP\n"
    "  phase                   compression while the balls approach each other, then restitution\n"
    "  sticks                  1 from where they no longer slip on each other, else 0; always 0 by Euler's method\n"
    "  v_n_m_s                 speed at which they part along the line of centres; negative while they approach\n"
    "  u_x_m_s u_z_m_s         slip of ball 1 on ball 2; y is the line of centres from 1 to 2, z points up, x = y x z\n"
    "  d_x_m_s d_y_m_s         slip of ball 1 over the cloth, and b_x_m_s b_y_m_s of ball 2, in the same axes\n"
    "  v1_x_m_s v1_y_m_s       velocity of ball 1, and v2_x_m_s v2_y_m_s of ball 2, in the same axes\n"
    "  v1x ... w2z             the state as `carom resolve` writes it, m/s and rad/s, along the axes of the table\n\n"
    "exit code: 0; 1 if the picture could not be drawn; 2 for bad usage, unreadable input or a collision in error\n";

typedef struct trace {
  pick asked;
  carom_options options;
  carom_impact impact;
  carom_solver solver[CAROM_SOLVER_COUNT];
  int solvers;
  int points;
  carom_trace_point *point; /* of the first solver, then of the next */
  bool separating;
} trace;

static void print_vector(FILE *out, const double x[3]) {
  fprintf(out, ",%.12g,%.12g,%.12g", x[0], x[1], x[2]);
}

/* Velocities in the collision frame. */
static void print_in_frame(FILE *out, const carom_impact *in, const double v[3]) {
  const double x = in->b.r[0] - in->a.r[0], y = in->b.r[1] - in->a.r[1], distance = hypot(x, y);
  fprintf(out, ",%.12g,%.12g", (v[0] * y - v[1] * x) / distance, (v[0] * x + v[1] * y) / distance);
}

static void print_point(FILE *out, const trace *t, carom_solver solver, const carom_trace_point *p) {
  fprintf(out, "%s,%.12g,%.12g,%s,%d", carom_solver_name(solver), p->normal, p->work,
          p->phase == CAROM_PHASE_COMPRESSION ? "compression" : "restitution", p->sticks);
  fprintf(out, ",%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g", p->v_n, p->u_x, p->u_z, p->d_x, p->d_y, p->b_x, p->b_y);
  print_in_frame(out, &t->impact, p->state.v_a);
  print_in_frame(out, &t->impact, p->state.v_b);
  print_vector(out, p->state.v_a);
  print_vector(out, p->state.w_a);
  print_vector(out, p->state.v_b);
  print_vector(out, p->state.w_b);
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
  carom_options options = t->options;
  carom_result unused;
  carom_detail detail;
  options.solver = CAROM_SOLVER_EXACT; /* Euler's method does not see it */
  carom_collide_detail(&t->impact, &options, &unused, &detail);
  pick_describe(out, &t->asked, &t->impact, &t->options);
  fprintf(out, "# compression ends: %.6g\n# the balls stick: %.6g\n", end_of_compression(t), detail.stick_normal);
  fputs("kernel,impulse_N_s,work_J,phase,sticks,v_n_m_s,u_x_m_s,u_z_m_s,d_x_m_s,d_y_m_s,b_x_m_s,b_y_m_s,v1_x_m_s,v1_y_m_s,"
        "v2_x_m_s,v2_y_m_s,v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z\n",
        out);
  for (int s = 0; s < t->solvers; s++)
    for (int k = 0; k < t->points; k++)
      print_point(out, t, t->solver[s], &t->point[s * t->points + k]);
}

/* False after a complaint. */
static bool compute(trace *t) {
  t->point = calloc((size_t)t->points * (size_t)t->solvers, sizeof *t->point);
  if (t->point == NULL) {
    complain("--points %d: out of memory", t->points);
    return false;
  }
  for (int s = 0; s < t->solvers; s++) {
    carom_options options = t->options;
    options.solver = t->solver[s];
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

static int write_trace(const trace *t, const char *path, const char *picture) {
  if (path != NULL) {
    FILE *out = output_open(path);
    if (out == NULL)
      return EXIT_USAGE;
    print_trace(out, t);
    if (!output_commit())
      return EXIT_USAGE;
  }
  if (picture == NULL)
    return EXIT_GOOD;
  char title[256];
  snprintf(title, sizeof title, "Collision %.200s", t->asked.id);
  if (t->separating) {
    complain("cannot draw %s: there is no collision to draw", picture);
    return EXIT_SOME;
  }
  return picture_draw(picture, "trace", title, print_trace, t) ? EXIT_GOOD : EXIT_SOME;
}

int command_trace(int argc, char **argv) {
  static const struct option options[] = {
      {"id", required_argument, NULL, 'i'},
      {"kernel", required_argument, NULL, 'k'},
      {"slip", required_argument, NULL, 's'},
      {"steps", required_argument, NULL, 'n'},
      {"points", required_argument, NULL, 'p'},
      {"friction", required_argument, NULL, 'f'},
      {"plot", required_argument, NULL, 'P'},
      {"data", required_argument, NULL, 'd'},
      {"output", required_argument, NULL, 'o'},
      {"help", no_argument, NULL, 'h'},
      {0},
  };
  trace t = {.options = carom_default_options(), .solver = {CAROM_SOLVER_EXACT}, .solvers = 1, .points = 201};
  const char *path = NULL, *picture = NULL;
  int option;
  while ((option = getopt_long(argc, argv, "o:h", options, NULL)) != -1)
    switch (option) {
    case 'i':
      t.asked.id = optarg;
      break;
    case 'k':
      if (!pick_solvers(optarg, t.solver, &t.solvers))
        return EXIT_USAGE;
      break;
    case 's':
      if (!option_slip(optarg, &t.options.slip))
        return EXIT_USAGE;
      break;
    case 'n':
      if (!option_steps(optarg, &t.options.steps))
        return EXIT_USAGE;
      break;
    case 'p':
      if (!option_count("--points", optarg, 2, &t.points))
        return EXIT_USAGE;
      break;
    case 'f':
      if (!option_law(optarg, &t.asked.law))
        return EXIT_USAGE;
      t.asked.by_law = true;
      break;
    case 'P':
      if (!picture_name_fits(optarg))
        return EXIT_USAGE;
      picture = optarg;
      break;
    case 'd':
      t.asked.folder = optarg;
      break;
    case 'o':
      path = optarg;
      break;
    case 'h':
      fputs(help, stdout);
      return EXIT_GOOD;
    default:
      return usage_hint("trace");
    }
  if (argc - optind > 1) {
    complain("trace takes one file, but got %d", argc - optind);
    return usage_hint("trace");
  }
  if (t.asked.id == NULL) {
    complain("trace needs --id: which collision to follow");
    return usage_hint("trace");
  }
  t.asked.file = argv[optind];
  if (path == NULL && picture == NULL)
    path = "-";
  const int code = pick_impact(&t.asked, &t.impact) && compute(&t) ? write_trace(&t, path, picture) : EXIT_USAGE;
  free(t.point);
  return code;
}
