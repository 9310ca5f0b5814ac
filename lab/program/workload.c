/* What `carom-lab bench` times. Single calls go through a pointer, as those of a program that chooses its kernel at run time
 * would; the empty kernel is called through it too. */
#include "workload.h"

#include "accuracy.h"
#include "caches.h"
#include "memory.h"
#include "precision.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef carom_status call(const workload *w, const carom_impact *in, carom_result *out);

static carom_status by_library(const workload *w, const carom_impact *in, carom_result *out) {
  return carom_collide(in, &w->options, out);
}

static carom_status by_ladder(const workload *w, const carom_impact *in, carom_result *out) {
  return ladder_resolve(w->module, w->rung, in, &w->options, out);
}

static carom_status by_nothing(const workload *w, const carom_impact *in, carom_result *out) {
  (void)w;
  (void)in;
  (void)out;
  return CAROM_OK;
}

static void call_all(const workload *w, call *one) {
  __asm__ volatile("" : "+r"(one)); /* hidden from the compiler, or it would look into by_nothing */
  for (size_t k = 0; k < w->pairs; k++) {
    one(w, &w->in[k], &w->result[k]);
    BENCH_CONSUME(&w->result[k]);
  }
}

static void call_library(void *context) {
  call_all(context, by_library);
}

static void call_ladder(void *context) {
  call_all(context, by_ladder);
}

static void call_nothing(void *context) {
  call_all(context, by_nothing);
}

static uint64_t fingerprint(const void *context) {
  const workload *w = context;
  return w->batch.single ? bench_fingerprint(w->batch.result32, w->rows * sizeof *w->batch.result32)
                         : bench_fingerprint(w->result, w->rows * sizeof *w->result);
}

bool workload_takes_steps(const kernel *one) {
  return one->is_rung || one->solver == CAROM_SOLVER_EULER;
}

int workload_steps(const workload *w) {
  return w->kernel != NULL && workload_takes_steps(w->kernel) ? w->options.steps : 0;
}

void workload_of_calls(workload *w, const kernel *one, const ladder_module *module, int steps, const case_set *cases) {
  *w = (workload){.kernel = one, .module = module, .isa = "scalar", .options = {.steps = CAROM_DEFAULT_STEPS}, .cases = cases};
  w->options.slip = one->claims[0].slip;
  if (workload_takes_steps(one))
    w->options.steps = steps;
  if (one->is_rung)
    w->rung = ladder_rung_find(one->name);
  else
    w->options.solver = one->solver;
  w->resolve = one->is_rung ? call_ladder : call_library;
  w->empty = call_nothing;
  w->rows = w->pairs = cases->count;
  w->in = cases->impact;
  w->result = allocate(w->rows, sizeof *w->result);
}

void workload_free(workload *w) {
  if (w->left_out > 0)
    free((carom_impact *)w->in);
  free(w->case_of);
  free(w->result);
  free(w->batch.result32);
}

static size_t case_of(const workload *w, size_t row) {
  return w->case_of != NULL ? w->case_of[row] : row % w->cases->count;
}

static carom_result result_of(const workload *w, size_t row) {
  if (!w->batch.single)
    return w->result[row];
  carom_result wide;
  to_double(&w->batch.result32[row], &wide, sizeof wide / sizeof(double));
  return wide;
}

/* `reference` has one result for each case. */
static workload_error compare(const workload *w, const carom_result *reference) {
  if (w->rows == 0)
    return (workload_error){INFINITY, INFINITY};
  pair_accuracy *each = allocate(w->rows, sizeof *each);
  for (size_t k = 0; k < w->rows; k++) {
    const carom_result result = result_of(w, k);
    each[k] = accuracy_of(&result, &reference[case_of(w, k)], w->in[k].a.radius);
  }
  const accuracy_summary s = accuracy_summarise(each, w->rows);
  free(each);
  return (workload_error){.max = s.max, .median = s.median};
}

static void judge(const workload *w, double error, double bound, int steps, char message[WORKLOAD_MESSAGE]) {
  char with[64] = "", lanes[64] = "";
  if (workload_takes_steps(w->kernel))
    snprintf(with, sizeof with, " with %d steps", steps);
  if (w->batch.size > 0)
    snprintf(lanes, sizeof lanes, ", %s, %s", w->isa, workload_precision(w));
  message[0] = '\0';
  if (!(error <= bound))
    snprintf(message, WORKLOAD_MESSAGE, "%s (%s%s)%s is %.2g off its reference, and %.2g is allowed: it is not timed",
             workload_name(w), workload_config(w), lanes, with, error, bound);
}

static double bound_of(const workload *w) {
  return w->batch.size > 0 ? workload_batch_bound(w) : w->kernel->claims[0].bound;
}

/* At the claim's own steps, whatever those of the workload are. */
static bool verify_claim(workload *w, const char *folder, char message[WORKLOAD_MESSAGE]) {
  const kernel_claim *claim = &w->kernel->claims[0];
  const int steps = w->options.steps;
  reference_set reference;
  const bool loaded = reference_load(folder, claim->reference, w->cases, &reference);
  if (loaded) {
    w->options.steps = claim->steps;
    w->resolve(w);
    w->options.steps = steps;
    w->own = compare(w, reference.result);
    judge(w, w->own.max, bound_of(w), claim->steps, message);
  }
  reference_free(&reference);
  return loaded;
}

static bool too_slow(const workload *w, size_t row) {
  carom_result result;
  return isnan(w->result[row].a.v[0]) &&
         kernel_resolve(w->kernel, w->module, &w->in[row], 1, &w->options, &result, NULL) == CAROM_ERROR_TOO_SLOW;
}

/* Drops rows that have been refused as too slow, and resolves the others again where there are any. */
static void leave_out_too_slow(workload *w) {
  carom_impact *in = allocate(w->rows, sizeof *in);
  size_t *which = allocate(w->rows, sizeof *which), kept = 0;
  for (size_t k = 0; k < w->rows; k++)
    if (!too_slow(w, k)) {
      in[kept] = w->in[k];
      which[kept++] = k;
    }
  if (kept == w->rows) {
    free(in);
    free(which);
    return;
  }
  w->left_out = w->rows - kept;
  w->rows = w->pairs = kept;
  w->in = in;
  w->case_of = which;
  w->resolve(w);
}

static void verify_other_steps(workload *w, char message[WORKLOAD_MESSAGE]) {
  const kernel_claim *claim = &w->kernel->claims[0];
  const double steps = w->options.steps, bound = bound_of(w);
  w->resolve(w);
  if (w->batch.size == 0)
    leave_out_too_slow(w);
  carom_result *reference = allocate(w->cases->count, sizeof *reference);
  carom_options euler = w->options;
  euler.solver = CAROM_SOLVER_EULER;
  for (size_t k = 0; k < w->cases->count; k++)
    carom_collide(&w->cases->impact[k], &euler, &reference[k]);
  w->own = compare(w, reference);
  const double allowed = bound > 0.0 ? 2.0 / steps + bound * fmax(1.0, steps / claim->steps) : 0.0;
  judge(w, w->own.max, allowed, w->options.steps, message);
  free(reference);
}

bool workload_verify(workload *w, const char *folder, char message[WORKLOAD_MESSAGE]) {
  if (w->kernel == NULL) {
    w->resolve(w);
    w->own = w->exact = (workload_error){NAN, NAN};
    snprintf(message, WORKLOAD_MESSAGE, "%s",
             workload_is_copy(w) ? "" : "the copy differs from what was copied: it is not timed");
    return true;
  }
  if (!verify_claim(w, folder, message))
    return false;
  const bool at_claim = !workload_takes_steps(w->kernel) || w->options.steps == w->kernel->claims[0].steps;
  if (message[0] == '\0' && !at_claim)
    verify_other_steps(w, message);
  return true;
}

bool workload_compare_exact(workload *w, const char *folder) {
  if (w->kernel == NULL)
    return true;
  char name[64];
  snprintf(name, sizeof name, "reference-exact-%s.csv", carom_slip_name(w->options.slip));
  reference_set reference;
  const bool loaded = reference_load(folder, name, w->cases, &reference);
  if (loaded)
    w->exact = compare(w, reference.result);
  reference_free(&reference);
  return loaded;
}

bench_subject workload_subject(workload *w) {
  return (bench_subject){
      .kernel = workload_name(w),
      .config = workload_config(w),
      .isa = w->isa,
      .precision = workload_precision(w),
      .threads = w->batch.size > 0 ? w->options.threads : 1,
      .steps = workload_steps(w),
      .paper = w->rung != NULL ? w->rung->paper : NULL,
      .pairs = w->pairs,
      .in_a_call = w->batch.size,
      .resolve = w->resolve,
      .empty = w->empty,
      .fingerprint = fingerprint,
      .context = w,
      .verified = fingerprint(w),
      .pair_error_max = w->own.max,
  };
}

const char *workload_name(const workload *w) {
  return w->kernel != NULL ? w->kernel->name : "copy";
}

const char *workload_config(const workload *w) {
  if (w->kernel == NULL)
    return cache_holding(w->batch.size * workload_bytes(w->batch.single));
  return w->module != NULL ? w->module->name : "library";
}

const char *workload_precision(const workload *w) {
  return w->batch.size == 0 ? w->kernel->precision : w->batch.single ? "single" : "double";
}
