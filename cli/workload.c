/* What `carom bench` times. Single calls go through a pointer, as those of a program that chooses its kernel at run time would;
 * the empty kernel is called through it too. */
#include "workload.h"

#include "accuracy.h"
#include "message.h"

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
  return bench_fingerprint(w->result, w->pairs * sizeof *w->result);
}

bool workload_of_calls(workload *w, const kernel *one, const ladder_module *module, int steps, const case_set *cases) {
  *w = (workload){.kernel = one, .module = module, .isa = "scalar", .options = carom_default_options(), .cases = cases};
  w->options.slip = one->claims[0].slip;
  w->options.steps = steps;
  if (one->is_rung)
    w->rung = ladder_rung_find(one->name);
  else
    w->options.solver = one->solver;
  w->resolve = one->is_rung ? call_ladder : call_library;
  w->empty = call_nothing;
  w->pairs = cases->count;
  w->in = calloc(w->pairs, sizeof *w->in);
  w->case_of = calloc(w->pairs, sizeof *w->case_of);
  w->result = calloc(w->pairs, sizeof *w->result);
  if (w->in == NULL || w->case_of == NULL || w->result == NULL) {
    complain("out of memory");
    workload_free(w);
    return false;
  }
  for (size_t k = 0; k < w->pairs; k++) {
    w->in[k] = cases->impact[k];
    w->case_of[k] = k;
  }
  return true;
}

void workload_free(workload *w) {
  free(w->in);
  free(w->case_of);
  free(w->result);
}

/* `reference` has one result for each case. */
static workload_error compare(const workload *w, const carom_result *reference) {
  pair_accuracy *each = calloc(w->pairs, sizeof *each);
  if (each == NULL || w->pairs == 0) {
    free(each);
    return (workload_error){INFINITY, INFINITY};
  }
  for (size_t k = 0; k < w->pairs; k++)
    each[k] = accuracy_of(&w->result[k], &reference[w->case_of[k]], w->in[k].a.radius);
  const accuracy_summary s = accuracy_summarise(each, w->pairs);
  free(each);
  return (workload_error){.max = s.max, .median = s.median};
}

static void judge(const workload *w, double error, double bound, int steps, char message[WORKLOAD_MESSAGE]) {
  message[0] = '\0';
  if (!(error <= bound))
    snprintf(message, WORKLOAD_MESSAGE, "%s (%s) with %d steps is %.2g off its reference, and %.2g is allowed: it is not timed",
             w->kernel->name, workload_config(w), steps, error, bound);
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
    judge(w, w->own.max, claim->bound, claim->steps, message);
  }
  reference_free(&reference);
  return loaded;
}

static void leave_out_too_slow(workload *w, uint8_t *status) {
  kernel_resolve(w->kernel, w->module, w->in, w->pairs, &w->options, w->result, status);
  size_t kept = 0;
  for (size_t k = 0; k < w->pairs; k++)
    if (carom_status_of_byte(status[k]) != CAROM_ERROR_TOO_SLOW) {
      w->in[kept] = w->in[k];
      w->case_of[kept++] = w->case_of[k];
    }
  w->left_out += w->pairs - kept;
  w->pairs = kept;
}

static bool verify_other_steps(workload *w, char message[WORKLOAD_MESSAGE]) {
  const kernel_claim *claim = &w->kernel->claims[0];
  const double steps = w->options.steps;
  carom_result *reference = calloc(w->cases->count, sizeof *reference);
  uint8_t *status = calloc(w->pairs, sizeof *status);
  if (reference == NULL || status == NULL) {
    free(reference);
    free(status);
    complain("out of memory");
    return false;
  }
  leave_out_too_slow(w, status);
  carom_options euler = w->options;
  euler.solver = CAROM_SOLVER_EULER;
  carom_collide_batch(w->cases->impact, w->cases->count, &euler, reference, NULL);
  w->resolve(w);
  w->own = compare(w, reference);
  const double allowed = claim->bound > 0.0 ? 2.0 / steps + claim->bound * fmax(1.0, steps / claim->steps) : 0.0;
  judge(w, w->own.max, allowed, w->options.steps, message);
  free(reference);
  free(status);
  return true;
}

bool workload_verify(workload *w, const char *folder, char message[WORKLOAD_MESSAGE]) {
  if (!verify_claim(w, folder, message))
    return false;
  return message[0] != '\0' || w->options.steps == w->kernel->claims[0].steps || verify_other_steps(w, message);
}

bool workload_compare_exact(workload *w, const char *folder) {
  char name[64];
  snprintf(name, sizeof name, "reference-exact-%s.csv", carom_slip_name(w->options.slip));
  reference_set reference;
  const bool loaded = reference_load(folder, name, w->cases, &reference);
  if (loaded) {
    w->resolve(w);
    w->exact = compare(w, reference.result);
  }
  reference_free(&reference);
  return loaded;
}

bench_subject workload_subject(workload *w) {
  return (bench_subject){
      .kernel = w->kernel->name,
      .config = workload_config(w),
      .isa = w->isa,
      .precision = w->kernel->precision,
      .threads = 1,
      .steps = w->options.steps,
      .pairs = w->pairs,
      .resolve = w->resolve,
      .empty = w->empty,
      .fingerprint = fingerprint,
      .context = w,
      .verified = fingerprint(w),
      .pair_error_max = w->own.max,
  };
}

const char *workload_config(const workload *w) {
  return w->module != NULL ? w->module->name : "library";
}

const char *workload_paper(const workload *w) {
  return w->rung != NULL ? w->rung->paper : "-";
}
