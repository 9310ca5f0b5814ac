/* `carom-lab bench --cushion`: the models of the cushion on impacts of play, Euler's 1000 steps
 * being what the others are compared with. */
#include "bench_job.h"
#include "command.h"
#include "draws.h"
#include "machine.h"
#include "memory.h"
#include "message.h"
#include "reference.h"

#include "carom_shot.h"

#include <math.h>
#include <stdlib.h>

enum { IMPACTS = 512, SEED = 1, MODELS = 5 };
/* Euler's method first: speedup is that over it. */
static const carom_cushion_model models[MODELS] = {CAROM_CUSHION_EULER, CAROM_CUSHION_MATHAVAN,
                                                   CAROM_CUSHION_STRONGE, CAROM_CUSHION_HAN,
                                                   CAROM_CUSHION_MIRROR};
/* of the verified error; the second is that of `verify` */
static const double euler_bound = 0.05, exact_bound = 1e-8;

typedef struct cushion_work {
  char name[32];
  carom_cushion_options options;
  carom_cushion_impact in[IMPACTS];
  carom_motion out[IMPACTS];
  int8_t status[IMPACTS];
} cushion_work;

static void resolve(void *context) {
  cushion_work *w = context;
  for (size_t k = 0; k < IMPACTS; k++)
    w->status[k] = (int8_t)carom_cushion(&w->in[k], &w->options, &w->out[k]);
  BENCH_CONSUME(w->out);
}

static uint64_t fingerprint(const void *context) {
  const cushion_work *w = context;
  return bench_fingerprint(w->out, sizeof w->out);
}

/* The largest error against the reference; NAN for models of other physics. Infinity if an
 * impact is not resolved. */
static double verify(const cushion_work *w) {
  const bool compared =
      w->options.model == CAROM_CUSHION_MATHAVAN || w->options.model == CAROM_CUSHION_EULER;
  double worst = 0;
  for (size_t k = 0; k < IMPACTS; k++) {
    carom_motion exact;
    if (w->status[k] != CAROM_OK)
      return INFINITY;
    if (compared && k % 8 == 0 && reference_cushion(&w->in[k], &exact, NULL) == REFERENCE_OK)
      worst = fmax(worst, cushion_distance(&w->in[k], &w->out[k], &exact));
  }
  return compared ? worst : (double)NAN;
}

static bool choose(bench_job *job) {
  job->cushions = allocate(MODELS, sizeof *job->cushions);
  job->subject = allocate(MODELS, sizeof *job->subject);
  for (int m = 0; m < MODELS; m++) {
    cushion_work *w = &job->cushions[m];
    const bool euler = models[m] == CAROM_CUSHION_EULER;
    w->options = (carom_cushion_options){.model = models[m]};
    snprintf(w->name, sizeof w->name, "cushion-%s", carom_cushion_model_name(models[m]));
    for (size_t k = 0; k < IMPACTS; k++)
      w->in[k] = draw_cushion(CUSHION_PLAY, SEED, k);
    resolve(w);
    const double error = verify(w);
    if (error > (euler ? euler_bound : exact_bound)) {
      complain("%s is off by %.2g and is not timed", w->name, error);
      job->code = EXIT_SOME;
      continue;
    }
    job->subject[job->subject_count++] = (bench_subject){.kernel = w->name,
                                                         .config = "library",
                                                         .isa = "scalar",
                                                         .precision = "double",
                                                         .threads = 1,
                                                         .steps = euler ? CAROM_DEFAULT_STEPS : 0,
                                                         .pairs = IMPACTS,
                                                         .resolve = resolve,
                                                         .fingerprint = fingerprint,
                                                         .context = w,
                                                         .verified = fingerprint(w),
                                                         .pair_error_max = error};
  }
  for (size_t k = 0; k < job->subject_count; k++)
    job->subject[k].reference = job->subject[0].steps > 0 ? 0 : SIZE_MAX;
  if (job->budget == 0.0)
    job->budget = 5.0;
  return true;
}

static void note(const bench_job *job, FILE *out) {
  (void)job;
  machine_note(out, "workload", "%d random impacts of play on a cushion, one call each", IMPACTS);
}

static void release(bench_job *job) {
  free(job->cushions);
}

const bench_table bench_of_cushions = {
    .choose = choose, .note = note, .print = bench_print, .release = release};
