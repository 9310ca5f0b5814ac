/* `carom-lab bench --cushion`: the models of the cushion timed on impacts of play, Euler's 1000 steps being the yardstick. */
#include "command.h"
#include "cushion_lab.h"
#include "draws.h"
#include "machine.h"
#include "memory.h"
#include "message.h"
#include "options.h"
#include "output.h"
#include "pinning.h"
#include "reference.h"
#include "rounds.h"

#include "carom_shot.h"

#include <math.h>
#include <stdlib.h>

enum { IMPACTS = 512, SEED = 1, SUBJECTS = 5 };
/* Euler's method first: it is what the others are compared with. */
static const carom_cushion_model models[SUBJECTS] = {CAROM_CUSHION_EULER, CAROM_CUSHION_MATHAVAN, CAROM_CUSHION_STRONGE,
                                                     CAROM_CUSHION_HAN, CAROM_CUSHION_MIRROR};
static const double euler_bound = 0.05; /* of the verified error; the exact limit's is that of `verify` */

typedef struct work {
  carom_cushion_options options;
  carom_cushion_impact in[IMPACTS];
  carom_motion out[IMPACTS];
  int8_t status[IMPACTS];
} work;

static void resolve(void *context) {
  work *w = context;
  for (size_t k = 0; k < IMPACTS; k++)
    w->status[k] = (int8_t)carom_cushion(&w->in[k], &w->options, &w->out[k]);
  BENCH_CONSUME(w->out);
}

static uint64_t fingerprint(const void *context) {
  const work *w = context;
  return bench_fingerprint(w->out, sizeof w->out);
}

/* The largest error against the judge; NAN for models of other physics. Infinity if an impact is not resolved. */
static double verify(const work *w) {
  double worst = 0;
  for (size_t k = 0; k < IMPACTS; k++) {
    carom_motion exact;
    if (w->status[k] != CAROM_OK)
      return INFINITY;
    if ((w->options.model == CAROM_CUSHION_MATHAVAN || w->options.model == CAROM_CUSHION_EULER) && k % 8 == 0 &&
        reference_cushion(&w->in[k], &exact, NULL) == REFERENCE_OK)
      worst = fmax(worst, cushion_distance(&w->in[k], &w->out[k], &exact));
  }
  const bool compared = w->options.model == CAROM_CUSHION_MATHAVAN || w->options.model == CAROM_CUSHION_EULER;
  return compared ? worst : (double)NAN;
}

typedef struct bench_cushions {
  shared_options shared;
  double budget;
  bool csv;
} bench_cushions;

static void print(FILE *out, bool csv, const bench_subject *s, const bench_figure *f) {
  if (csv)
    fputs("kernel,config,isa,precision,threads,steps,ns_median,ns_min,ns_max,speedup,pair_error_max\n", out);
  else
    fprintf(out, "\n%-9s %6s %12s %12s %12s %9s %9s\n", "cushion", "steps", "ns median", "least", "most", "speedup", "error");
  for (int k = 0; k < SUBJECTS; k++) {
    if (!f[k].unchanged)
      continue;
    char error[32] = "NA";
    if (!isnan(s[k].pair_error_max))
      snprintf(error, sizeof error, "%.2g", s[k].pair_error_max);
    if (csv)
      fprintf(out, "cushion-%s,library,scalar,double,1,%d,%.6g,%.6g,%.6g,%.5g,%s\n", s[k].kernel, s[k].steps, f[k].ns.median,
              f[k].ns.min, f[k].ns.max, f[k].speedup.median, error);
    else
      fprintf(out, "%-9s %6d %12.1f %12.1f %12.1f %9.4g %9s\n", s[k].kernel, s[k].steps, f[k].ns.median, f[k].ns.min,
              f[k].ns.max, f[k].speedup.median, error);
  }
}

OPTION(bench_cushions, option_budget, "budget", budget, 0, "SECONDS", set_number, 0, "how long to measure (default 5)");
OPTION(bench_cushions, option_csv, "csv", csv, 0, NULL, set_flag, 0, "as CSV, with lines about the machine that begin with #");

static const command_form form = {
    .name = "bench --cushion",
    .usage = "[OPTIONS]",
    .about = "Times the models of the cushion on 512 random impacts of play, each one call, in turns. What is timed has been "
             "verified\n"
             "just before: all impacts resolved, the exact limit and Euler's steps within bounds of the judge.\n",
    .options = (const option_row *const[]){&option_budget, &option_csv, &option_output, NULL},
    .details = "Figures are nanoseconds per impact; speedup is that over Euler's 1000 steps.\n\n"
               "exit code: 0 if all was timed, 1 if a model was refused, 2 for bad usage\n",
    .example = "carom-lab bench --cushion --budget 10",
};

int cushion_bench_command(int argc, char **argv) {
  bench_cushions job = {.shared = {.output = "-"}, .budget = 5};
  int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  work *works = allocate(SUBJECTS, sizeof *works);
  bench_subject subject[SUBJECTS];
  bench_figure figure[SUBJECTS];
  code = EXIT_GOOD;
  for (int m = 0; m < SUBJECTS && code == EXIT_GOOD; m++) {
    work *w = &works[m];
    w->options = (carom_cushion_options){.model = models[m]};
    for (size_t k = 0; k < IMPACTS; k++)
      w->in[k] = draw_cushion(CUSHION_PLAY, SEED, k);
    resolve(w);
    subject[m] = (bench_subject){.kernel = carom_cushion_model_name(models[m]),
                                 .config = "library",
                                 .isa = "scalar",
                                 .precision = "double",
                                 .threads = 1,
                                 .steps = models[m] == CAROM_CUSHION_EULER ? CAROM_DEFAULT_STEPS : 0,
                                 .pairs = IMPACTS,
                                 .resolve = resolve,
                                 .fingerprint = fingerprint,
                                 .context = w,
                                 .verified = fingerprint(w),
                                 .pair_error_max = verify(w)};
    if (subject[m].pair_error_max > (models[m] == CAROM_CUSHION_EULER ? euler_bound : 1e-8)) {
      complain("%s is off by %.2g and is not timed", subject[m].kernel, subject[m].pair_error_max);
      code = EXIT_SOME;
    }
  }
  FILE *out = code == EXIT_GOOD ? output_open(job.shared.output) : NULL;
  if (out != NULL) {
    const char *pinning = pinning_begin();
    machine_describe(out);
    machine_note(out, "pinning", "%s", pinning);
    const bench_settings settings = {.budget = job.budget};
    const bool good = bench_rounds(subject, SUBJECTS, &settings, figure);
    pinning_end();
    if (good)
      print(out, job.csv, subject, figure);
    else
      complain("out of memory");
    code = output_commit() && good ? EXIT_GOOD : EXIT_USAGE;
  } else if (code == EXIT_GOOD)
    code = EXIT_USAGE;
  free(works);
  return code;
}
