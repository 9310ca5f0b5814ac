/* `carom-lab experiments`: the 2014 paper's five shots, measured, as it predicted them, and as
 * the solvers compute them. */
#include "cases.h"
#include "kernel.h"
#include "program/program.h"
#include "rows/records.h"
#include "sheet.h"
#include "subcommands.h"

#include <limits.h>

static const double degree = 3.14159265358979323846 / 180.0;

/* What is compared, in the order of the columns: m/s and degrees. */
enum { V_CUE, V_OBJECT, ANGLE_CUE, ANGLE_OBJECT, OUTCOMES };

typedef struct shot {
  char id[32];
  double V0, omega_T, theta; /* m/s, rad/s, rad */
  double measured[OUTCOMES], predicted[OUTCOMES];
} shot;

enum { MOST_SHOTS = 32, SHOT_NUMBERS = 3 + 2 * OUTCOMES };
/* Of a row:
 * id,V0,omega_T,theta_deg,measured_v_cue,measured_v_object,predicted_v_cue,predicted_v_object,
 * measured_angle_cue_deg,measured_angle_object_deg,
 * predicted_angle_cue_deg,predicted_angle_object_deg */

static shot shot_of(const char *id, const double x[SHOT_NUMBERS]) {
  shot s = {.V0 = x[0],
            .omega_T = x[1],
            .theta = x[2] * degree,
            .measured = {x[3], x[4], x[7], x[8]},
            .predicted = {x[5], x[6], x[9], x[10]}};
  snprintf(s.id, sizeof s.id, "%s", id);
  return s;
}

static size_t read_shots(const char *folder, shot shots[MOST_SHOTS]) {
  char path[PATH_MAX];
  snprintf(path, sizeof path, "%s/experiments.csv", folder);
  record_reader *reader = record_open(path);
  if (reader == NULL)
    return 0;
  record row;
  size_t count = 0;
  bool good = record_next(reader, &row) == READ_ONE; /* the header */
  while (good && count < MOST_SHOTS && record_next(reader, &row) == READ_ONE) {
    double number[SHOT_NUMBERS];
    good = numbers_of(&row, SHOT_NUMBERS, number);
    if (good)
      shots[count++] = shot_of(row.field[0], number);
    else
      complain("%s:%lld: not an experiment", path, row.line);
  }
  record_close(reader);
  if (!good)
    return 0;
  return count;
}

/* The line of centres is y; the cue ball rolls at theta to it, towards +x. */
static carom_impact impact_of(const shot *s) {
  carom_impact in = {.a = {.v = {s->V0 * sin(s->theta), s->V0 * cos(s->theta), 0.0},
                           .w = {-s->omega_T * cos(s->theta), s->omega_T * sin(s->theta), 0.0},
                           .radius = 0.02625,
                           .mass = 0.1406,
                           .mu_slide = 0.21},
                     .mu_ball = 0.05,
                     .restitution = 0.89};
  in.b = (carom_ball){.r = {0.0, 2.0 * in.a.radius, 0.0},
                      .radius = in.a.radius,
                      .mass = in.a.mass,
                      .mu_slide = in.a.mu_slide};
  return in;
}

static bool outcome_of(const shot *s, const kernel *candidate, carom_slip slip,
                       double outcome[OUTCOMES]) {
  const carom_impact in = impact_of(s);
  carom_options options = {0};
  carom_result out;
  double cue[3], object[3];
  options.slip = slip;
  if (kernel_resolve(candidate, NULL, &in, 1, &options, &out, NULL) != CAROM_OK)
    return false;
  carom_rolling_velocity(out.a.v, out.a.w, in.a.radius, cue);
  carom_rolling_velocity(out.b.v, out.b.w, in.b.radius, object);
  outcome[V_CUE] = hypot(cue[0], cue[1]);
  outcome[V_OBJECT] = hypot(object[0], object[1]);
  outcome[ANGLE_CUE] = atan2(cue[0], cue[1]) / degree - s->theta / degree;
  outcome[ANGLE_OBJECT] = s->theta / degree - atan2(object[0], object[1]) / degree;
  return true;
}

/* One line: a shot according to a source. */
static void print_line(FILE *out, const char *id, const char *source, const char *format,
                       const double outcome[OUTCOMES]) {
  fprintf(out, "%s,%s", id, source);
  for (int k = 0; k < OUTCOMES; k++)
    fprintf(out, format, outcome[k]);
  fputc('\n', out);
}

static void print_all(FILE *out, bool csv, const shot *shots, size_t count, carom_slip slip) {
  sheet table;
  FILE *rows = sheet_begin(&table, out, csv);
  fputs("shot,source,v_cue,v_object,angle_cue_deg,angle_object_deg\n", rows);
  for (const shot *s = shots; s < shots + count; s++) {
    print_line(rows, s->id, "measured", ",%g", s->measured);
    print_line(rows, s->id, "predicted", ",%g", s->predicted);
    const kernel *candidate;
    double outcome[OUTCOMES];
    for (size_t index = 0; (candidate = kernel_at(index)) != NULL; index++)
      if (!candidate->is_rung && outcome_of(s, candidate, slip, outcome))
        print_line(rows, s->id, candidate->name, ",%.6f", outcome);
  }
  sheet_end(&table, rows);
}

typedef struct experiments_job {
  shared_options shared;
  bool csv;
} experiments_job;

FLAG(experiments_job, option_csv, "csv", csv,
     "as CSV: shot,source,v_cue,v_object,angle_cue_deg,angle_object_deg");

static const command_form form = {
    .name = "experiments",
    .usage = "[OPTIONS]",
    .about =
        "A rolling cue ball meets a resting object ball at a cut angle (Mathavan, Jackson, Parkin "
        "2014, tables 1 and 2). Speeds and angles are measured once both balls roll. Angles are "
        "relative to the path of the cue ball before the collision: the cue ball's to one side, "
        "and the object ball's to the other. Snooker balls: M = 0.1406 kg, R = 26.25 "
        "mm, friction 0.21 with the cloth and 0.05 with each other, restitution 0.89. The measured "
        "object angle equals the cut angle, so it is not an independent check.\n",
    .options =
        (const option_row *const[]){&option_slip, &option_data, &option_csv, &option_output, NULL},
    .details = "exit code: 0, or 2 for bad usage or unreadable data\n",
    .example = "carom-lab experiments --csv -o experiments.csv",
};

int command_experiments(int argc, char **argv) {
  experiments_job job = {.shared = {.options = COMMAND_OPTIONS}};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  shot shots[MOST_SHOTS];
  const size_t count = read_shots(data_folder(job.shared.folder), shots);
  if (count == 0)
    return EXIT_USAGE;
  FILE *out = output_open(job.shared.output);
  if (out == NULL)
    return EXIT_USAGE;
  print_all(out, job.csv, shots, count, job.shared.options.slip);
  if (!output_commit())
    return EXIT_USAGE;
  return EXIT_GOOD;
}
