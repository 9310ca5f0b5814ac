/* `carom-lab bench`: collisions by the paths that a user has, timed once they are verified:
 *
 *     calls   the cases, one call each                               any kernel       isa "scalar"
 *     batch   the cases over and over, many in a call                solvers, and rungs across
 *                                                                    collisions: isa "avx512", ...
 *
 * Calls use a pointer, as in a program that chooses its kernel at run time. Small batches move on:
 * call j begins at case j * size, modulo the number of cases, until every case has been in as many
 * batches as any other, so that what is timed does not depend on which cases a batch happens to
 * hold. */
#include "accuracy.h"
#include "bench_job.h"
#include "cases.h"
#include "kernel.h"
#include "machine.h"
#include "pinning.h"
#include "program/program.h"
#include "rows/precision.h"
#include "sheet.h"
#include "subcommands.h"

#include <unistd.h>

enum {
  LARGE = 4096, /* so many pairs hold all cases about equally often: one call is enough; fewer
                   are not worth a thread */
  DEFAULT_SIZE = 65536 /* of solvers; rungs across collisions, with their steps, take LARGE */
};

typedef struct workload workload;
typedef carom_status call(const workload *w, size_t first);

struct workload {
  const kernel *kernel;
  const kernel_claim *claim;   /* one of the kernel's: the slip, and what must be reached with it */
  const ladder_module *module; /* of a rung; NULL for a solver of the library */
  const case_set *cases;
  carom_options options;
  carom_isa isa;
  bool single;          /* precision */
  size_t size;          /* pairs in a call of a batch; 0: single calls */
  size_t calls, stride; /* calls in a pass, each so many rows after the one before */
  call *single_call;
  const void *in;  /* the rows, of doubles or floats */
  size_t *case_of; /* their cases; NULL: row k is case k modulo their number */
  size_t rows;
  size_t period;   /* rows after which the cases repeat */
  size_t left_out; /* cases that the kernel's precision does not resolve in so many steps */
  void *result;
  accuracy_summary claimed, exact; /* against the kernel's own reference, and the exact limit */
};

static struct {
  case_set cases;
  const kernel *reference; /* what speedup is relative to */
  const ladder_module *reference_module;
  workload *work;
  size_t count, room;
  carom_impact *tiled; /* the cases over and over */
  carom_impact_f32 *tiled_f32;
} timing;

/* ---- What is called */

static carom_status by_library(const workload *w, size_t first) {
  return carom_collide((const carom_impact *)w->in + first, &w->options,
                       (carom_result *)w->result + first);
}

static carom_status by_ladder(const workload *w, size_t first) {
  return ladder_resolve(w->module, ladder_rung_find(w->kernel->name),
                        (const carom_impact *)w->in + first, &w->options,
                        (carom_result *)w->result + first);
}

static carom_status by_lanes_of_ladder(const workload *w, size_t first) {
  return ladder_resolve_batch(w->module, ladder_rung_find(w->kernel->name),
                              (const carom_impact *)w->in + first, w->size, &w->options,
                              (carom_result *)w->result + first, NULL);
}

static carom_status by_batch(const workload *w, size_t first) {
  if (w->single)
    return carom_collide_batch_f32((const carom_impact_f32 *)w->in + first, w->size, &w->options,
                                   (carom_result_f32 *)w->result + first, NULL);
  return carom_collide_batch((const carom_impact *)w->in + first, w->size, &w->options,
                             (carom_result *)w->result + first, NULL);
}

/* Asking the processor what it can takes a virtual machine some 20 us, as long as 200 calls. */
static void choose_isa(void *context) {
  carom_isa_limit(((const workload *)context)->isa);
}

static void resolve(void *context) {
  const workload *w = context;
  for (size_t k = 0, first = 0; k < w->calls; k++) {
    w->single_call(w, first);
    BENCH_CONSUME(w->result);
    first += w->stride;
    if (first >= w->period)
      first -= w->period;
  }
}

static size_t result_size(bool single) {
  return single ? sizeof(carom_result_f32) : sizeof(carom_result);
}

static uint64_t fingerprint(const void *context) {
  const workload *w = context;
  return bench_fingerprint(w->result, w->rows * result_size(w->single));
}

static bool is_rung_of_lanes(const kernel *candidate) {
  return candidate->is_rung && ladder_rung_find(candidate->name)->width > 1;
}

static const char *isa_of(const workload *w) {
  if (w->size == 0)
    return "scalar";
  if (w->kernel->is_rung)
    return ladder_isa_name(ladder_rung_find(w->kernel->name)->isa);
  return carom_word(CAROM_WORDS_ISA, (int)w->isa);
}

static const char *precision_of(const workload *w) {
  if (w->size == 0 || w->kernel->is_rung)
    return w->kernel->precision;
  return precision_name(w->single);
}

/* ---- Verification */

static size_t case_of(const workload *w, size_t row) {
  if (w->case_of != NULL)
    return w->case_of[row];
  return row % w->cases->count;
}

/* `reference` has one result for each case. */
static accuracy_summary compare(const workload *w, const carom_result *reference) {
  pair_accuracy *each = allocate(w->rows + 1, sizeof *each);
  accuracy_summary s = {.max = INFINITY};
  for (size_t k = 0; k < w->rows; k++) {
    carom_result result;
    if (w->single)
      to_double((carom_result_f32 *)w->result + k, &result, sizeof result / sizeof(double));
    else
      result = ((carom_result *)w->result)[k];
    const size_t index = case_of(w, k);
    each[k] = accuracy_of(&result, &reference[index], w->cases->impact[index].a.radius);
  }
  if (w->rows > 0)
    s = accuracy_summarise(each, w->rows);
  free(each);
  return s;
}

static bool compare_file(const workload *w, const char *folder, const char *name,
                         accuracy_summary *summary) {
  reference_set reference;
  const bool loaded = reference_load(folder, name, w->cases, &reference);
  if (loaded)
    *summary = compare(w, reference.result);
  reference_free(&reference);
  return loaded;
}

/* What a kernel must reach on the cases at its claim's steps: for batches the bound of their
 * precision, if it is wider; 0 requires the same bits. */
static double bound_of(const workload *w) {
  static const double of_batches[][2] = {[CAROM_SOLVER_EXACT] = {1e-6, 2e-5},
                                         [CAROM_SOLVER_EULER] = {0.0, 1e-2},
                                         [CAROM_SOLVER_FAST] = {1e-6, 2e-5}};
  if (w->size == 0 || w->kernel->is_rung)
    return w->claim->bound;
  return fmax(w->claim->bound, of_batches[w->kernel->solver][w->single]);
}

static bool within(const workload *w, double allowed, int steps) {
  if (w->claimed.max <= allowed)
    return true;
  char with[64] = "", lanes[64] = "";
  if (kernel_takes_steps(w->kernel))
    snprintf(with, sizeof with, " with %d steps", steps);
  if (w->size > 0)
    snprintf(lanes, sizeof lanes, ", %s, %s", isa_of(w), precision_of(w));
  complain("%s (%s%s)%s is %.2g off its reference, and %.2g is allowed: it is not timed",
           w->kernel->name, config_name(w->module), lanes, with, w->claimed.max, allowed);
  return false;
}

/* Single calls only: drops the rows that the kernel's precision does not resolve in so many
 * steps. */
static void leave_out_too_slow(workload *w) {
  carom_impact *impacts = allocate(w->rows, sizeof *impacts);
  w->case_of = allocate(w->rows, sizeof *w->case_of);
  size_t count = 0;
  for (size_t k = 0; k < w->rows; k++)
    if (w->single_call(w, k) != CAROM_ERROR_TOO_SLOW) {
      impacts[count] = w->cases->impact[k];
      w->case_of[count++] = k;
    }
  w->in = impacts;
  w->left_out = w->rows - count;
  w->rows = w->calls = count;
  resolve(w);
}

/* At other steps than the claim's there is no file: the reference is the library's Euler with as
 * many steps, which has pooltool's bits. */
static bool verify_other_steps(workload *w) {
  resolve(w);
  if (w->size == 0)
    leave_out_too_slow(w);
  carom_result *reference = allocate(w->cases->count, sizeof *reference);
  carom_options euler = w->options;
  euler.solver = CAROM_SOLVER_EULER;
  for (size_t k = 0; k < w->cases->count; k++)
    carom_collide(&w->cases->impact[k], &euler, &reference[k]);
  w->claimed = compare(w, reference);
  free(reference);
  const int steps = w->options.steps;
  return within(w, kernel_bound(bound_of(w), w->claim, steps), steps);
}

/* Resolves the cases and compares. *good: may it be timed? False if data could not be read. */
static bool verify(workload *w, const char *folder, bool *good) {
  const kernel_claim *claim = w->claim;
  const int steps = w->options.steps;
  w->options.steps = claim->steps;
  choose_isa(w);
  resolve(w);
  w->options.steps = steps;
  if (!compare_file(w, folder, claim->reference, &w->claimed))
    return false;
  *good = within(w, bound_of(w), claim->steps);
  if (*good && kernel_takes_steps(w->kernel) && steps != claim->steps)
    *good = verify_other_steps(w);
  char name[64];
  snprintf(name, sizeof name, "reference-exact-%s.csv",
           carom_word(CAROM_WORDS_SLIP, (int)w->options.slip));
  return compare_file(w, folder, name, &w->exact);
}

/* ---- What is requested */

static bool names(const name_list *list, const char *name) {
  bool named = false;
  for (size_t k = 0; k < list->count; k++)
    named |= same_text(list->name[k], name);
  return named;
}

static void add_name(name_list *list, const char *name) {
  list->name = grow(list->name, &list->room, list->count + 1, sizeof *list->name);
  list->name[list->count++] = name;
}

static void add_count(name_list *list, int count) {
  char text[16];
  snprintf(text, sizeof text, "%d", count);
  add_name(list, copy_text(text));
}

static bool wants_precision(const bench_job *job, bool single) {
  return job->shared.precision == ANY_PRECISION ||
         (job->shared.precision == SINGLE_PRECISION) == single;
}

static workload *add(const kernel *candidate, const kernel_claim *claim, int steps) {
  timing.work = grow(timing.work, &timing.room, timing.count + 1, sizeof *timing.work);
  workload *w = &timing.work[timing.count++];
  *w = (workload){
      .kernel = candidate, .claim = claim, .cases = &timing.cases, .isa = carom_isa_in_force()};
  w->options = (carom_options){
      .slip = claim->slip, .steps = CAROM_DEFAULT_STEPS, .solver = CAROM_SOLVER_EXACT};
  if (kernel_takes_steps(candidate))
    w->options.steps = steps;
  if (!candidate->is_rung)
    w->options.solver = candidate->solver;
  return w;
}

/* The cases, one call each, unless they are there already. Where a kernel takes no steps, they
 * are not read. */
static void add_calls(const kernel *candidate, const kernel_claim *claim,
                      const ladder_module *module, int steps) {
  for (const workload *w = timing.work; w < timing.work + timing.count; w++)
    if (w->size == 0 && w->kernel == candidate && w->claim == claim && w->module == module &&
        (w->options.steps == steps || !kernel_takes_steps(candidate)))
      return;
  workload *w = add(candidate, claim, steps);
  w->module = module;
  w->single_call = by_library;
  if (candidate->is_rung)
    w->single_call = by_ladder;
  w->in = timing.cases.impact;
  w->stride = 1;
  w->period = w->rows = w->calls = timing.cases.count;
  w->result = allocate(w->rows, sizeof(carom_result));
}

static size_t common_divisor(size_t a, size_t b) {
  if (b == 0)
    return a;
  return common_divisor(b, a % b);
}

/* The number of calls of `size` pairs after which every case was used equally often; the cases
 * repeat after `period` rows. */
static void lay_out_calls(workload *w, size_t size, size_t period) {
  const size_t shared = common_divisor(size, period);
  w->size = size;
  w->period = period;
  w->stride = size % period;
  w->calls = 1;
  w->rows = size;
  if (size < LARGE) {
    w->calls = period / shared;
    w->rows = size + period - shared;
  }
}

static size_t whole_turns(size_t size, size_t period) {
  return (size + period - 1) / period * period;
}

/* A rung across collisions, on batches of the cases that its precision resolves in so many
 * steps. */
static void add_lanes(const kernel *candidate, const kernel_claim *claim,
                      const ladder_module *module, int steps, size_t size) {
  workload *w = add(candidate, claim, steps);
  const size_t n = timing.cases.count;
  int8_t *status = allocate(n, sizeof *status);
  carom_result *unused = allocate(n, sizeof *unused);
  size_t *rows = allocate(n, sizeof *rows), count = 0;
  kernel_resolve(candidate, module, timing.cases.impact, n, &w->options, unused, status);
  for (size_t k = 0; k < n; k++)
    if (status[k] != CAROM_ERROR_TOO_SLOW)
      rows[count++] = k;
  w->module = module;
  w->single_call = by_lanes_of_ladder;
  w->left_out = n - count;
  w->options.threads = 1;
  if (count > 0) {
    if (size == 0)
      size = whole_turns(LARGE, count);
    lay_out_calls(w, size, count);
  }

  carom_impact *in = allocate(w->rows + 1, sizeof *in);
  w->case_of = allocate(w->rows + 1, sizeof *w->case_of);
  for (size_t k = 0; k < w->rows; k++) {
    w->case_of[k] = rows[k % count];
    in[k] = timing.cases.impact[w->case_of[k]];
  }
  w->in = in;
  w->result = allocate(w->rows + 1, sizeof(carom_result));
  free(status);
  free(unused);
  free(rows);
}

/* By the sizes of batches that are requested, or the rung's own. */
static void add_all_lanes(const bench_job *job, const kernel *candidate, const kernel_claim *claim,
                          const ladder_module *module, int steps) {
  const bool has_sizes = job->pairs.room > 0;
  for (size_t k = 0; has_sizes && k < job->pairs.count; k++)
    add_lanes(candidate, claim, module, steps, (size_t)atoi(job->pairs.name[k]));
  if (!has_sizes)
    add_lanes(candidate, claim, module, steps, 0);
}

/* Is it the kernel's first claim with its slip, and is the slip requested? Without --slip, a kernel
 * is timed with the slip of its first claim. */
static bool wants_claim(const bench_job *job, const kernel *candidate, const kernel_claim *claim) {
  for (const kernel_claim *earlier = candidate->claims; earlier < claim; earlier++)
    if (earlier->slip == claim->slip)
      return false;
  if (job->slips.count == 0)
    return claim == candidate->claims;
  return names(&job->slips, carom_word(CAROM_WORDS_SLIP, (int)claim->slip));
}

static bool add_config(const bench_job *job, const kernel *candidate, const char *config) {
  const ladder_module *module;
  if (!kernel_module(candidate, config, &module))
    return false;
  for (const kernel_claim *claim = candidate->claims; claim->reference != NULL; claim++)
    for (size_t k = 0; k < job->steps.count && wants_claim(job, candidate, claim); k++)
      if (is_rung_of_lanes(candidate))
        add_all_lanes(job, candidate, claim, module, atoi(job->steps.name[k]));
      else
        add_calls(candidate, claim, module, atoi(job->steps.name[k]));
  return true;
}

static bool add_configs(const bench_job *job, const kernel *candidate) {
  const name_list *configs = &job->configs;
  bool good = true;
  for (size_t k = 0; k < configs->count && candidate->is_rung; k++)
    if (!same_text(configs->name[k], "all"))
      good = good && add_config(job, candidate, configs->name[k]);
    else
      for (size_t m = 0; ladder_module_name(m) != NULL; m++)
        good = good && add_config(job, candidate, ladder_module_name(m));
  return good && ((configs->count > 0 && candidate->is_rung) || add_config(job, candidate, NULL));
}

/* Where nothing is named, what cannot run here is left out; where it is named, it is an error. */
static bool is_wanted(const bench_job *job, const kernel *candidate) {
  if (job->kernels.count > 0)
    return names(&job->kernels, candidate->name);
  if (candidate->is_rung)
    return ladder_module_name(0) != NULL && ladder_rung_runs(ladder_rung_find(candidate->name));
  return job->configs.count == 0;
}

/* Single calls, or the lanes of a rung's own instruction set. */
static bool wants_form(const bench_job *job, const kernel *candidate) {
  if (!is_rung_of_lanes(candidate))
    return !job->batch && (job->isas.count == 0 || names(&job->isas, "scalar"));
  const char *isa = ladder_isa_name(ladder_rung_find(candidate->name)->isa);
  const char *best = carom_word(CAROM_WORDS_ISA, (int)carom_isa_in_force());
  return job->isas.count == 0 || names(&job->isas, isa) ||
         (names(&job->isas, "best") && same_text(best, isa));
}

/* Everything except batches of the library. */
static bool add_all_calls(const bench_job *job) {
  const kernel *candidate;
  const ladder_module *unused;
  if (job->configs.count > 0 && ladder_module_name(0) == NULL)
    return kernel_module(kernel_find(ladder_rung_at(0)->name), NULL, &unused);
  for (size_t k = 0; (candidate = kernel_at(k)) != NULL; k++) {
    if (is_wanted(job, candidate) && wants_form(job, candidate) &&
        wants_precision(job, same_text(candidate->precision, "single")) &&
        !add_configs(job, candidate))
      return false;
  }
  return true;
}

/* Batches of `size` pairs by a solver in lanes of `isa`, from the cases over and over. */
static void add_batch(const kernel *candidate, const kernel_claim *claim, carom_isa isa,
                      bool single, int threads, int steps, size_t size) {
  workload *w = add(candidate, claim, steps);
  w->in = timing.tiled;
  if (single)
    w->in = timing.tiled_f32;
  w->isa = isa;
  w->single = single;
  w->single_call = by_batch;
  lay_out_calls(w, size, timing.cases.count);
  w->options.threads = threads;
  w->result = allocate(w->rows, result_size(single));
}

/* Does this processor have it, and is it not above what CAROM_ISA allows? */
static bool isa_is_here(carom_isa isa) {
  return carom_isa_available(isa) && isa <= carom_isa_in_force();
}

static bool wants_isa(const bench_job *job, carom_isa isa) {
  return isa_is_here(isa) &&
         (job->isas.count == 0 || names(&job->isas, carom_word(CAROM_WORDS_ISA, (int)isa)) ||
          (isa == carom_isa_in_force() && names(&job->isas, "best")));
}

/* Solvers with steps cost a batch as much as thousands of the others, so they must be requested. */
static bool wants_batches(const bench_job *job, const kernel *candidate) {
  return !candidate->is_rung &&
         (job->kernels.count == 0 || names(&job->kernels, candidate->name)) &&
         (job->batch || (job->configs.count == 0 && !kernel_takes_steps(candidate)));
}

/* Every size, precision, number of threads and, where a kernel takes any, of steps that is
 * wanted. */
static void add_batches(const bench_job *job, const kernel *candidate, const kernel_claim *claim,
                        carom_isa isa) {
  size_t steps = 1;
  if (kernel_takes_steps(candidate))
    steps = job->steps.count;
  for (size_t size = 0; size < job->pairs.count; size++)
    for (int single = 0; single < 2; single++)
      for (size_t t = 0; t < job->threads.count && wants_precision(job, single != 0); t++)
        for (size_t k = 0; k < steps; k++)
          add_batch(candidate, claim, isa, single != 0, atoi(job->threads.name[t]),
                    atoi(job->steps.name[k]), (size_t)atoi(job->pairs.name[size]));
}

static void add_all_batches(bench_job *job) {
  const size_t n = timing.cases.count;
  const name_list *pairs = &job->pairs;
  if (job->threads.count == 0) {
    add_count(&job->threads, 1);
    if (sysconf(_SC_NPROCESSORS_ONLN) > 1)
      add_count(&job->threads, 2);
  }
  size_t rows = n;
  for (size_t k = 0; k < pairs->count; k++) {
    const size_t needed = n + (size_t)atoi(pairs->name[k]);
    if (needed > rows)
      rows = needed;
  }
  timing.tiled = allocate(rows, sizeof *timing.tiled);
  timing.tiled_f32 = allocate(rows, sizeof *timing.tiled_f32);
  for (size_t k = 0; k < rows; k++)
    timing.tiled[k] = timing.cases.impact[k % n];
  to_single(timing.tiled, timing.tiled_f32, rows * sizeof *timing.tiled / sizeof(double));
  const kernel *candidate;
  for (size_t k = 0; (candidate = kernel_at(k)) != NULL; k++)
    for (int isa = 0; carom_word(CAROM_WORDS_ISA, isa) != NULL && wants_batches(job, candidate);
         isa++)
      for (const kernel_claim *claim = candidate->claims;
           claim->reference != NULL && wants_isa(job, (carom_isa)isa); claim++)
        if (wants_claim(job, candidate, claim))
          add_batches(job, candidate, claim, (carom_isa)isa);
}

/* ---- The reference of speedup: the ladder's first rung in the default configuration; without a
 * ladder, the library's Euler; with as many steps as the workload, or the default where it takes
 * none */

static bool is_reference(const workload *w) {
  return w->size == 0 && w->kernel == timing.reference && w->claim == timing.reference->claims &&
         w->module == timing.reference_module;
}

static bool add_references(void) {
  const char *name = carom_word(CAROM_WORDS_SOLVER, CAROM_SOLVER_EULER);
  if (ladder_module_name(0) != NULL)
    name = ladder_rung_at(0)->name;
  timing.reference = kernel_find(name);
  if (timing.reference->is_rung && !kernel_module(timing.reference, NULL, &timing.reference_module))
    return false;
  for (size_t k = 0, chosen = timing.count; k < chosen; k++)
    add_calls(timing.reference, timing.reference->claims, timing.reference_module,
              timing.work[k].options.steps);
  return true;
}

/* ---- The table of work */

static bool verify_all(bench_job *job, const char *folder) {
  size_t count = 0;
  for (size_t k = 0; k < timing.count; k++) {
    bool good;
    if (!verify(&timing.work[k], folder, &good))
      return false;
    progress_show("kernels verified", (double)(k + 1), (double)timing.count);
    const workload passed = timing.work[k];
    timing.work[k] = timing.work[count]; /* rejected ones move to the end */
    timing.work[count] = passed;
    count += good;
    if (!good)
      job->code = EXIT_SOME;
  }
  job->subject_count = count;
  job->subject = allocate(count + 1, sizeof *job->subject);
  for (size_t k = 0; k < count; k++) {
    workload *w = &timing.work[k];
    bench_subject *s = &job->subject[k];
    *s = (bench_subject){.name = w->kernel->name,
                         .context = w,
                         .prepare = choose_isa,
                         .resolve = resolve,
                         .fingerprint = fingerprint,
                         .pairs = w->calls,
                         .threads = 1,
                         .reference = SIZE_MAX};
    if (w->size > 0) {
      s->pairs = w->calls * w->size;
      s->threads = w->options.threads;
    }
    for (size_t j = 0; j < count; j++)
      if (is_reference(&timing.work[j]) && timing.work[j].options.steps == w->options.steps)
        s->reference = j;
  }
  return true;
}

static bool choose(bench_job *job) {
  const char *folder = data_folder(job->shared.folder);
  if (job->steps.count == 0)
    add_count(&job->steps, CAROM_DEFAULT_STEPS);
  if (job->budget == 0.0)
    job->budget = 20.0;
  if (!cases_load(folder, "collisions-204.csv", &timing.cases))
    return false;
  if (job->pairs.count == 0) { /* whole turns of the cases */
    add_count(&job->pairs, (int)whole_turns(DEFAULT_SIZE, timing.cases.count));
    job->pairs.room = 0; /* no column for them */
  }
  if (!add_all_calls(job))
    return false;
  add_all_batches(job);
  if (timing.count == 0) {
    complain("nothing to time: no kernel is all that is asked for (see `carom-lab kernels`; only "
             "the library's and those across collisions come in batches)");
    return false;
  }
  return add_references() && verify_all(job, folder);
}

/* ---- Printing */

static void note(const bench_job *job, FILE *out) {
  machine_note(out, "workload", "%zu reference cases, one call each, mean over the cases",
               timing.cases.count);
  const char *pairs = job->pairs.name[0];
  if (job->pairs.room > 0)
    pairs = "column";
  machine_note(out, "batches", "the cases over and over, %s pairs in a call", pairs);
  if (job->spread)
    machine_note(out, "core cycles",
                 "processor time of the thread over that of an addition in a "
                 "chain, timed before each sample");
  for (const workload *w = timing.work; w < timing.work + job->subject_count; w++)
    if (is_rung_of_lanes(w->kernel) && job->pairs.room == 0) {
      machine_note(out, "lanes of the ladder", "the cases over and over, %zu pairs in a call",
                   whole_turns(LARGE, timing.cases.count));
      break;
    }
  machine_note(out, "reference kernel", "%s, %s, with as many steps", timing.reference->name,
               config_name(timing.reference_module));
  const char *name;
  for (size_t k = 0; (name = ladder_module_name(k)) != NULL; k++)
    for (size_t w = 0; w < job->subject_count; w++)
      if (timing.work[w].module != NULL && timing.work[w].module->name == name) {
        const ladder_module *module = timing.work[w].module;
        machine_note(out, module->name, "%s, %s, %s", module->compiler, module->version,
                     module->flags);
        char what[64];
        snprintf(what, sizeof what, "module %s", module->name);
        machine_note(out, what, "%s", module->fingerprint);
        break;
      }
  for (const workload *w = timing.work; w < timing.work + job->subject_count; w++)
    if (w->left_out > 0)
      machine_note(out, "left out",
                   "%s, %s, %d steps: %zu of %zu cases, whose approach its precision does not "
                   "resolve in as many steps",
                   w->kernel->name, config_name(w->module), w->options.steps, w->left_out,
                   timing.cases.count);
}

/* The columns of hardware counters, or their heads for w = NULL. */
static void print_counts(const bench_job *job, FILE *out, const workload *w,
                         const bench_figure *f) {
  for (int column = 0; job->counters && column < COUNTER_COLUMNS; column++) {
    if (w == NULL)
      fprintf(out, ",%s", counter_column_name((counter_column)column));
    else if (isnan(f->counted[column]))
      fputs(",NA", out);
    else
      fprintf(out, ",%.6g", f->counted[column]);
  }
}

/* The head of the table for w = NULL. */
static void print_row(const bench_job *job, FILE *out, const workload *w, const bench_figure *f) {
  const workload none = {.kernel = timing.reference};
  const workload *listed = &none;
  if (w != NULL)
    listed = w;
  double threads = 1.0, pairs = (double)listed->rows, steps = 0.0;
  if (listed->size > 0) {
    threads = listed->options.threads;
    pairs = (double)listed->size;
  }
  if (kernel_takes_steps(listed->kernel))
    steps = listed->options.steps;
  const bool csv = job->csv, more = job->spread;
  const struct {
    bool shown;
    const char *name, *format;
    double x;
  } columns[] = {
      {true, "threads", "%.0f", threads},
      {true, "steps", "%.0f", steps},
      {true, "ns_median", "%.6g", f->ns.median},
      {csv, "ns_min", "%.6g", f->ns.min},
      {csv, "ns_max", "%.6g", f->ns.max},
      {!csv, "spread", "%.3g", f->ns.spread},
      {true, "speedup", "%.5g", f->speedup.median},
      {!csv, "spread", "%.3g", f->speedup.spread},
      {true, "pair_error_max", "%.3g", listed->claimed.max},
      {more, "ns_spread", "%.3g", f->ns.spread},
      {more, "speedup_min", "%.5g", f->speedup.min},
      {more, "speedup_max", "%.5g", f->speedup.max},
      {more, "speedup_spread", "%.3g", f->speedup.spread},
      {more, "core_cycles", "%.6g", f->core_cycles},
      {job->errors || job->slips.count > 0, "slip", NULL, 0.0},
      {job->errors, "error_exact_median", "%.3g", listed->exact.median},
      {job->errors || !csv, "error_exact_max", "%.3g", listed->exact.max},
      {job->pairs.room > 0, "pairs", "%.0f", pairs},
  };
  if (w == NULL)
    fputs("kernel,config,isa,precision", out);
  else
    fprintf(out, "%s,%s,%s,%s", w->kernel->name, config_name(w->module), isa_of(w),
            precision_of(w));
  for (size_t k = 0; k < COUNT_OF(columns); k++) {
    if (!columns[k].shown)
      continue;
    fputc(',', out);
    if (w == NULL)
      fputs(columns[k].name, out);
    else if (columns[k].format == NULL)
      fputs(carom_word(CAROM_WORDS_SLIP, (int)w->options.slip), out);
    else if (isnan(columns[k].x))
      fputs("NA", out);
    else
      fprintf(out, columns[k].format, columns[k].x);
  }
  print_counts(job, out, w, f);
  const char *paper = "-";
  if (w == NULL)
    paper = "paper";
  else if (w->module != NULL && w->module == timing.reference_module)
    paper = ladder_rung_find(w->kernel->name)->paper;
  if (!csv)
    fprintf(out, ",%s", paper);
  fputc('\n', out);
}

/* From what speedup is relative to, by the ladder and its rungs across collisions, to the
 * library's solvers, the exact one last. */
enum { PLACE_OF_REFERENCE, PLACE_OF_RUNGS, PLACE_OF_LANES, PLACE_OF_SOLVERS };

static size_t place_of(const workload *w) {
  if (is_reference(w))
    return PLACE_OF_REFERENCE;
  if (w->kernel->is_rung)
    return is_rung_of_lanes(w->kernel) ? PLACE_OF_LANES : PLACE_OF_RUNGS;
  /* The table of kernels has the exact solver first. */
  size_t behind = 0;
  for (const kernel *candidate = w->kernel + 1; candidate != kernel_find(ladder_rung_at(0)->name);
       candidate++)
    behind++;
  return PLACE_OF_SOLVERS + behind;
}

static void print(const bench_job *job, FILE *out) {
  sheet table;
  note(job, out);
  FILE *rows = sheet_begin(&table, out, job->csv);
  print_row(job, rows, NULL, &(bench_figure){.loops = 0});
  size_t last = 0;
  for (size_t k = 0; k < job->subject_count; k++)
    if (place_of(&timing.work[k]) > last)
      last = place_of(&timing.work[k]);
  for (size_t place = 0; place <= last; place++)
    for (size_t k = 0; k < job->subject_count; k++)
      if (place_of(&timing.work[k]) == place && job->figure[k].unchanged)
        print_row(job, rows, &timing.work[k], &job->figure[k]);
  sheet_end(&table, rows);
}

static const bench_table bench_of_collisions = {.choose = choose, .print = print};

/* ---- The run */

static void show_time(double done, double total) {
  progress_show("seconds measured", done, total);
}

/* The hardware counters, if they are requested, and a note on what they count. */
static counter_set *open_counters(const bench_job *job, FILE *out) {
  if (!job->counters)
    return NULL;
  counter_set *counters = counters_open_here();
  size_t size;
  char *text;
  FILE *note = open_text(&text, &size);
  counters_describe(counters, note);
  close_text(note, &text);
  machine_note(out, "counters", "%s", text);
  free(text);
  return counters;
}

static bool bench_all(bench_job *job) {
  const carom_isa isa = carom_isa_in_force();
  if (!job->table->choose(job))
    return false;
  if (job->subject_count == 0)
    return true;
  /* the output is opened before the long part, so that a bad name costs nothing */
  FILE *out = output_open(job->shared.output);
  if (out == NULL)
    return false;
  job->figure = allocate(job->subject_count, sizeof *job->figure);
  machine_describe(out);
  job->pinning = pinning_begin();
  counter_set *counters = open_counters(job, out);
  const bench_settings settings = {
      .budget = job->budget,
      .clock = job->clock,
      .cycle = clock_core_cycle,
      .progress = show_time,
      .counters = counters,
  };
  bench_rounds(job->subject, job->subject_count, &settings, job->figure);
  counters_close(counters);
  pinning_end();
  progress_clear();
  carom_isa_limit(isa);
  for (size_t k = 0; k < job->subject_count; k++)
    if (!job->figure[k].unchanged) {
      complain("%s did not repeat its verified results while it was timed: its figures are dropped",
               job->subject[k].name);
      job->code = EXIT_SOME;
    }
  machine_note(out, "pinning", "%s", job->pinning);
  machine_note(out, "rounds", "%zu", job->figure[0].ns.count);
  job->table->print(job, out);
  return output_commit();
}

/* ---- Arguments */

/* Adds to a list what is between commas, each good. */
static bool add_each(const option_row *row, char *text, name_list *list,
                     bool good(const option_row *row, char *word)) {
  char *rest, *word = strtok_r(text, ",", &rest);
  if (word == NULL)
    return good(row, text + strlen(text));
  for (; word != NULL && good(row, word); word = strtok_r(NULL, ",", &rest))
    add_name(list, word);
  return word == NULL;
}

static bool is_name(const option_row *row, char *word) {
  if (word[0] == '\0')
    complain("--%s needs a name", row->name);
  return word[0] != '\0';
}

static bool is_count(const option_row *row, char *word) {
  int unused;
  return set_count(row, word, &unused);
}

static bool is_kernel(const option_row *row, char *word) {
  const kernel *unused;
  return is_name(row, word) && set_kernel(row, word, &unused);
}

static bool is_isa(const option_row *row, char *word) {
  char known[128] = "scalar, best";
  bool good = same_text(word, "scalar") || same_text(word, "best");
  for (int isa = 0; carom_word(CAROM_WORDS_ISA, isa) != NULL; isa++)
    if (isa_is_here((carom_isa)isa)) {
      good |= same_text(word, carom_word(CAROM_WORDS_ISA, isa));
      strcat(strcat(known, ", "), carom_word(CAROM_WORDS_ISA, isa));
    }
  if (!is_name(row, word) || good)
    return good;
  complain("no instruction set '%s' here; there are %s", word, known);
  return false;
}

static OPTION_SET(set_names) {
  return add_each(row, text, field, is_name);
}
static OPTION_SET(set_kernels) {
  return add_each(row, text, field, is_kernel);
}
static OPTION_SET(set_isas) {
  return add_each(row, text, field, is_isa);
}
static bool is_slip(const option_row *row, char *word) {
  char known[64] = "";
  for (int slip = 0; carom_word(CAROM_WORDS_SLIP, slip) != NULL; slip++) {
    if (same_text(word, carom_word(CAROM_WORDS_SLIP, slip)))
      return true;
    strcat(strcat(known, slip > 0 ? ", " : ""), carom_word(CAROM_WORDS_SLIP, slip));
  }
  if (is_name(row, word))
    complain("no slip '%s'; there are %s", word, known);
  return false;
}

static OPTION_SET(set_slips) {
  return add_each(row, text, field, is_slip);
}
static OPTION_SET(set_counts) {
  return add_each(row, text, field, is_count);
}

static OPTION_SET(set_threads) {
  if (!same_text(text, "all"))
    return set_counts(row, text, field);
  const int cores = (int)sysconf(_SC_NPROCESSORS_ONLN);
  for (int count = 1; count < cores; count *= 2)
    add_count(field, count);
  add_count(field, cores);
  return true;
}

static OPTION_SET(set_budget) {
  double *seconds = field;
  char *end;
  *seconds = strtod(text, &end);
  const bool good = end != text && *end == '\0' && *seconds > 0.0 && *seconds <= 86400.0;
  if (!good)
    complain("--%s is a number of seconds above 0, up to 86400, not '%s'", row->name, text);
  return good;
}

OPTION(bench_job, option_kernel, "kernel", kernels, "NAME,...", set_kernels, 0,
       "only these kernels (see `carom-lab kernels`); may be repeated");
OPTION(bench_job, option_config, "config", configs, "NAME,...", set_names, 0,
       "these builds of the ladder's kernels, or all (default: default); without --kernel, only "
       "kernels of the ladder");
OPTION(bench_job, option_counts, "steps", steps, "N,...", set_counts, 1,
       "steps of Euler's method (default 1000); several make a sweep");
FLAG(bench_job, option_batch, "batch", batch,
     "only batches: every solver of the library (with euler about a minute), and the ladder across "
     "collisions");
OPTION(
    bench_job, option_isa, "isa", isas, "NAME,...", set_isas, 0,
    "only these instruction sets: scalar (single calls), plain, sse2, avx2, avx512, neon, or best");
OPTION(bench_job, option_slips, "slip", slips, "NAME,...", set_slips, 0,
       "sign of the spin in the slip over the cloth: paper, pooltool (default: the slip of each "
       "kernel's reference: pooltool for the ladder, paper for exact and fast); adds the column "
       "slip");
OPTION(bench_job, option_one_precision, "precision", shared.precision, "double|single", set_choice,
       0, "only this precision (default: both)");
OPTION(bench_job, option_thread_counts, "threads", threads, "N,...", set_threads, 1,
       "threads of a batch, or all: 1, 2, 4, ... up to the processor's (default 1,2; 1 on a single "
       "core)");
OPTION(bench_job, option_pairs, "pairs", pairs, "N,...", set_counts, 1,
       "pairs in a batch (default 65536, rounded up to whole turns of the cases); adds the column "
       "pairs");
OPTION(bench_job, option_budget, "budget", budget, "SECONDS", set_budget, 0,
       "how long to measure (default 20; shots 0.06 each)");
FLAG(bench_job, option_csv, "csv", csv, "as CSV, with lines about the machine that begin with #");
FLAG(bench_job, option_spread, "spread", spread,
     "more columns in the CSV: spread of the time; least, greatest and spread of the speedup; core "
     "cycles of a collision, its processor time over that of an addition");
FLAG(bench_job, option_errors, "errors", errors,
     "more columns in the CSV: slip, and the pair error against the exact reference, median and "
     "largest");
FLAG(bench_job, option_counters, "counters", counters,
     "more columns: what the processor counts for each collision, such as cycles and operations; "
     "NA where the kernel or the processor does not count it");
OPTION(bench_job, option_shots, "shots", shots, "IN.jsonl", set_text, 0,
       "instead: time the shots of this file, next to pooltool's recorded times");
FLAG(bench_job, option_cushions, "cushions", cushions,
     "instead: time impacts on a cushion with each model, relative to Han's");
static const char about[] =
    "Times kernels on the 204 reference collisions, one call each, interleaved: A B C A B C ... "
    "Each kernel is verified first; a kernel whose error is above its bound is not timed. Times "
    "are "
    "nanoseconds per collision, the mean over the collisions; median and spread are over the "
    "rounds. The speedup of a round is relative to the ladder's first kernel in the default "
    "configuration with the same number of steps (1000 for kernels without steps). The exact "
    "solver is also timed in batches, with every instruction set.\n";

static const char details[] =
    "Spread is the median absolute deviation: half of the rounds are within it. "
    "docs/study/measuring.md explains how to read the figures.\n"
    "\n"
    "exit code: 0 if all kernels were timed; 1 if some were rejected (the others are timed); 2 for "
    "bad usage or unreadable data\n";

static const command_form form = {
    .name = "bench",
    .usage = "[OPTIONS]",
    .about = about,
    .options =
        (const option_row *const[]){
            &option_kernel,     &option_config,   &option_counts,        &option_slips,
            &option_batch,      &option_isa,      &option_one_precision, &option_thread_counts,
            &option_pairs,      &option_budget,   &option_csv,           &option_spread,
            &option_errors,     &option_counters, &option_shots,         &option_cushions,
            &options_of_motion, &option_data,     &option_output,        NULL},
    .details = details,
    .example = "carom-lab bench --kernel base,double,float,exact --budget 5",
};

/* Options that choose collisions mean nothing for shots and cushions. */
static bool is_plain(const bench_job *job) {
  return job->kernels.count + job->configs.count + job->isas.count + job->steps.count +
                 job->slips.count + job->pairs.count ==
             0 &&
         !job->batch && !job->errors && !job->counters && job->shared.precision == ANY_PRECISION;
}

static int bench(bench_job *job) {
  if ((job->spread || job->errors) && !job->csv)
    complain("--spread and --errors add columns to the CSV: give --csv too");
  else if (job->shots != NULL && job->cushions)
    complain("--shots and --cushions: one of them can be timed");
  else if (job->cushions && job->threads.count > 0)
    complain("--threads is for batches and shots, not for --cushions, which are single calls");
  else if ((job->shots != NULL || job->cushions) && !is_plain(job))
    complain("--kernel, --config, --steps, --slip, --batch, --isa, --precision, --pairs, --errors "
             "and --counters are for collisions of two balls");
  else {
    job->table = &bench_of_collisions;
    if (job->shots != NULL)
      job->table = &bench_of_shots;
    else if (job->cushions)
      job->table = &bench_of_cushions;
    if (!bench_all(job))
      return EXIT_USAGE;
    return job->code;
  }
  return usage_hint(&form);
}

int command_bench(int argc, char **argv) {
  static bench_job job = {.shared = {.precision = ANY_PRECISION}};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  return bench(&job);
}
