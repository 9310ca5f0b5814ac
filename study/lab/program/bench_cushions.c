/* `carom-lab bench --cushions`: single impacts on a cushion by each model, compared with Han's.
 *
 * All models meet the same 512 random impacts of play. One is timed if it resolves all of them and
 * none gains energy. The ratio to Han is taken within the same round, so what disturbs the machine
 * for longer than a round meets both; its spread is over the rounds. The clock is the
 * processor's. */
#include "bench_job.h"
#include "machine.h"
#include "program/program.h"
#include "random_impacts.h"
#include "sheet.h"

enum { IMPACTS = 512, HAN = 0 };

static const struct {
  const char *name;
  carom_cushion_options options;
} models[] = {
    [HAN] = {"han", {.model = CAROM_CUSHION_HAN}},
    {"mirror", {.model = CAROM_CUSHION_MIRROR}},
    {"smooth; first law",
     {.model = CAROM_CUSHION_SMOOTH,
      .smooth_q = 0.35,
      .smooth_x = 1.3,
      .smooth_t = 1.2,
      .smooth_a = 0.13,
      .smooth_k = 0.047}},
    {"smooth", {.model = CAROM_CUSHION_SMOOTH}},
    {"smooth; mu_log", {.model = CAROM_CUSHION_SMOOTH, .mu_log = -0.01}},
    {"stronge", {.model = CAROM_CUSHION_STRONGE}},
    {"mathavan", {.model = CAROM_CUSHION_MATHAVAN}},
    {"euler; 1000 steps", {.model = CAROM_CUSHION_EULER, .steps = 1000}},
};

enum { MODELS = COUNT_OF(models) };

static carom_cushion_impact impacts[IMPACTS];

typedef struct timed_cushion {
  const carom_cushion_options *options;
  carom_motion out[IMPACTS];
} timed_cushion;

static timed_cushion timed[MODELS];

static void resolve(void *context) {
  timed_cushion *t = context;
  for (int k = 0; k < IMPACTS; k++)
    carom_cushion(&impacts[k], t->options, &t->out[k]);
  BENCH_CONSUME(t->out);
}

static uint64_t fingerprint(const void *context) {
  const timed_cushion *t = context;
  return bench_fingerprint(t->out, sizeof t->out);
}

/* Twice the kinetic energy over the mass of a ball. */
static double energy(const double *v, const double *w, double radius) {
  double sum = 0.0;
  for (int k = 0; k < 3; k++)
    sum += v[k] * v[k] + 0.4 * radius * radius * w[k] * w[k];
  return sum;
}

/* Are all impacts resolved, and none with more energy than before, but for rounding? */
static bool verified(timed_cushion *t, const char *name) {
  for (int k = 0; k < IMPACTS; k++) {
    const carom_cushion_impact *in = &impacts[k];
    const carom_status status = carom_cushion(in, t->options, &t->out[k]);
    if (status != CAROM_OK) {
      complain("%s: impact %d: %s: it is not timed", name, k, carom_status_string(status));
      return false;
    }
    const double energy_in = energy(in->v, in->w, in->radius),
                 energy_out = energy(t->out[k].v, t->out[k].w, in->radius);
    if (!(energy_out <= energy_in * (1.0 + 1e-9))) {
      complain("%s: impact %d gains energy, %.3g of it: it is not timed", name, k,
               energy_out / energy_in - 1.0);
      return false;
    }
  }
  return true;
}

static bool choose(bench_job *job) {
  for (uint64_t k = 0; k < IMPACTS; k++)
    impacts[k] = draw_cushion(CUSHION_PLAY, 1, k);
  job->subject = allocate(MODELS, sizeof *job->subject);
  job->subject_count = 0;
  for (int k = 0; k < MODELS; k++) {
    timed[k].options = &models[k].options;
    if (verified(&timed[k], models[k].name))
      job->subject[job->subject_count++] = (bench_subject){.name = models[k].name,
                                                           .context = &timed[k],
                                                           .resolve = resolve,
                                                           .fingerprint = fingerprint,
                                                           .pairs = IMPACTS,
                                                           .threads = 1,
                                                           .reference = HAN};
    else if (k == HAN)
      return false;
    else
      job->code = EXIT_SOME;
  }
  job->clock = processor_ns;
  if (job->budget == 0.0)
    job->budget = 20.0;
  return true;
}

/* The engine's speedup is Han's time over this one's. */
static void print(const bench_job *job, FILE *out) {
  sheet table;
  machine_note(out, "impacts", "%d of play, one call each", IMPACTS);
  FILE *rows = sheet_begin(&table, out, job->csv);
  fputs("cushion,ns_median,ns_spread,times_han,times_han_spread\n", rows);
  for (size_t k = 0; k < job->subject_count; k++) {
    const sample_summary *ns = &job->figure[k].ns, *speedup = &job->figure[k].speedup;
    const double ratio = 1.0 / speedup->median;
    fprintf(rows, "%s,%.1f,%.1f,%.3f,%.3f\n", job->subject[k].name, ns->median, ns->spread, ratio,
            ratio * speedup->spread / speedup->median);
  }
  sheet_end(&table, rows);
}

const bench_table bench_of_cushions = {.choose = choose, .print = print};
