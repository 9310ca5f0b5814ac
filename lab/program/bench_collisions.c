/* Collisions for `carom-lab bench`, by the paths that a user has:
 *
 *     calls   the cases, one call each                               any kernel       isa "scalar"
 *     batch   the cases over and over, many in a call                solvers only
 *     isa "avx512", ...
 *
 * Calls go through a pointer, as those of a program that chooses its kernel at run time would;
 * the empty kernel is called through it too. Small batches move on: call j begins at case j *
 * size, modulo the number of cases, until every case has been in as many batches as any other,
 * so that what is timed does not depend on which cases a batch happens to hold. */
#include "accuracy.h"
#include "bench_job.h"
#include "command.h"
#include "kernel.h"
#include "machine.h"
#include "memory.h"
#include "message.h"
#include "precision.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
  LARGE = 4096, /* so many pairs hold all cases about equally often: one call is enough; fewer
                   are not worth a thread */
  DEFAULT_SIZE = 65536
};

typedef struct workload workload;
typedef carom_status call(const workload *w, size_t first);

struct workload {
  const kernel *kernel;
  const ladder_module *module; /* of a rung; NULL for a solver of the library */
  const ladder_rung *rung;     /* likewise */
  const case_set *cases;
  carom_options options;
  carom_isa isa;
  bool single;          /* precision */
  size_t size;          /* pairs in a call of a batch; 0: single calls */
  size_t calls, stride; /* calls in a pass, each so many rows after the one before */
  call *one;
  const carom_impact *in; /* the rows; row k is case k modulo the number of cases, or case_of[k] */
  const carom_impact_f32 *in_f32;
  carom_impact *kept;
  size_t *case_of;
  size_t rows, pairs; /* of `in` and the results; collisions in a pass */
  carom_result *result;
  carom_result_f32 *result_f32;
  accuracy_summary own; /* against the kernel's own reference */
};

/* The table's own part of a job. */
struct collisions {
  case_set cases;
  carom_impact *tiled; /* the cases over and over */
  carom_impact_f32 *tiled_f32;
  const kernel *reference; /* what speedup is relative to */
  const ladder_module *reference_module;
  workload *work; /* the reference, then all that is asked for */
  size_t count, room;
};

/* ---- What is called */

static carom_status by_nothing(const workload *w, size_t first) {
  (void)w;
  (void)first;
  return CAROM_OK;
}

static carom_status by_library(const workload *w, size_t first) {
  return carom_collide(&w->in[first], &w->options, &w->result[first]);
}

static carom_status by_ladder(const workload *w, size_t first) {
  return ladder_resolve(w->module, w->rung, &w->in[first], &w->options, &w->result[first]);
}

static carom_status by_batch(const workload *w, size_t first) {
  return w->single
             ? carom_collide_batch_f32(&w->in_f32[first], w->size, &w->options,
                                       &w->result_f32[first], NULL)
             : carom_collide_batch(&w->in[first], w->size, &w->options, &w->result[first], NULL);
}

static void call_all(const workload *w, call *one) {
  __asm__ volatile("" : "+r"(one)); /* hidden from the compiler, or it would look into by_nothing */
  carom_isa_limit(w->isa);
  for (size_t k = 0, first = 0; k < w->calls; k++) {
    one(w, first);
    BENCH_CONSUME(w->result);
    first += w->stride;
    first -= first >= w->cases->count ? w->cases->count : 0;
  }
}

static void resolve(void *context) {
  const workload *w = context;
  call_all(w, w->one);
}

static void resolve_nothing(void *context) {
  call_all(context, by_nothing);
}

static uint64_t fingerprint(const void *context) {
  const workload *w = context;
  return w->single ? bench_fingerprint(w->result_f32, w->rows * sizeof *w->result_f32)
                   : bench_fingerprint(w->result, w->rows * sizeof *w->result);
}

/* ---- Labels */

static bool takes_steps(const kernel *one) {
  return one->is_rung || one->solver == CAROM_SOLVER_EULER;
}

static int steps_of(const workload *w) {
  return takes_steps(w->kernel) ? w->options.steps : 0;
}

static const char *config_of(const workload *w) {
  return w->module != NULL ? w->module->name : "library";
}

static const char *precision_of(const workload *w) {
  return w->size == 0 ? w->kernel->precision : w->single ? "single" : "double";
}

static const char *isa_of(const workload *w) {
  return w->size == 0 ? "scalar" : carom_isa_name(w->isa);
}

/* ---- Verification */

static carom_result result_of(const workload *w, size_t row) {
  if (!w->single)
    return w->result[row];
  carom_result wide;
  to_double(&w->result_f32[row], &wide, sizeof wide / sizeof(double));
  return wide;
}

/* `reference` has one result for each case. */
static accuracy_summary compare(const workload *w, const carom_result *reference) {
  pair_accuracy *each = allocate(w->rows + 1, sizeof *each);
  for (size_t k = 0; k < w->rows; k++) {
    const carom_result result = result_of(w, k);
    const size_t which = w->case_of != NULL ? w->case_of[k] : k % w->cases->count;
    each[k] = accuracy_of(&result, &reference[which], w->in[k].a.radius);
  }
  const accuracy_summary s =
      w->rows > 0 ? accuracy_summarise(each, w->rows) : (accuracy_summary){.max = INFINITY};
  free(each);
  return s;
}

/* What a kernel must reach on the cases at its claim's steps: for batches that of their
 * precision; 0 asks for the same bits. */
static double bound_of(const workload *w) {
  static const double of_batches[][2] = {
      [CAROM_SOLVER_EXACT] = {1e-6, 2e-5}, [CAROM_SOLVER_EULER] = {0.0, 1e-2}};
  return w->size > 0 ? of_batches[w->kernel->solver][w->single] : w->kernel->claims[0].bound;
}

static bool within(const workload *w, double allowed, int steps) {
  char with[64] = "", lanes[64] = "";
  if (takes_steps(w->kernel))
    snprintf(with, sizeof with, " with %d steps", steps);
  if (w->size > 0)
    snprintf(lanes, sizeof lanes, ", %s, %s", isa_of(w), precision_of(w));
  if (!(w->own.max <= allowed))
    complain("%s (%s%s)%s is %.2g off its reference, and %.2g is allowed: it is not timed",
             w->kernel->name, config_of(w), lanes, with, w->own.max, allowed);
  return w->own.max <= allowed;
}

/* Single calls only: drops the rows that the kernel's precision does not resolve in so many
 * steps. */
static void leave_out_too_slow(workload *w) {
  carom_result result;
  w->kept = allocate(w->rows, sizeof *w->kept);
  w->case_of = allocate(w->rows, sizeof *w->case_of);
  size_t kept = 0;
  for (size_t k = 0; k < w->rows; k++)
    if (!isnan(w->result[k].a.v[0]) ||
        kernel_resolve(w->kernel, w->module, &w->in[k], 1, &w->options, &result, NULL) !=
            CAROM_ERROR_TOO_SLOW) {
      w->kept[kept] = w->in[k];
      w->case_of[kept++] = k;
    }
  w->in = w->kept;
  w->rows = w->pairs = w->calls = kept;
  resolve(w);
}

/* At other steps than the claim's there is no file: the reference is the library's Euler with as
 * many steps, which has pooltool's bits. A rung that rounds differently may end one step sooner
 * or later. A step changes a velocity by
 * (1 + e)|v_n|/(2N), at most 2/N of the pair's scale, so allowed is 2/N + bound * max(1, N /
 * claim's N); but a bound of 0 stays 0. */
static bool verify_other_steps(workload *w) {
  const double steps = w->options.steps, bound = bound_of(w);
  resolve(w);
  if (w->size == 0)
    leave_out_too_slow(w);
  carom_result *reference = allocate(w->cases->count, sizeof *reference);
  carom_options euler = w->options;
  euler.solver = CAROM_SOLVER_EULER;
  for (size_t k = 0; k < w->cases->count; k++)
    carom_collide(&w->cases->impact[k], &euler, &reference[k]);
  w->own = compare(w, reference);
  free(reference);
  return within(
      w, bound > 0.0 ? 2.0 / steps + bound * fmax(1.0, steps / w->kernel->claims[0].steps) : 0.0,
      w->options.steps);
}

/* Resolves the cases and compares. *good: may it be timed? False if data could not be read. */
static bool verify(workload *w, const char *folder, bool *good) {
  const kernel_claim *claim = &w->kernel->claims[0];
  const int steps = w->options.steps;
  reference_set reference;
  const bool loaded = reference_load(folder, claim->reference, w->cases, &reference);
  if (loaded) {
    w->options.steps = claim->steps;
    resolve(w);
    w->options.steps = steps;
    w->own = compare(w, reference.result);
    *good = within(w, bound_of(w), claim->steps);
    if (*good && takes_steps(w->kernel) && steps != claim->steps)
      *good = verify_other_steps(w);
  }
  reference_free(&reference);
  return loaded;
}

static bool compare_exact(const workload *w, const char *folder, bench_subject *s) {
  char name[64];
  reference_set reference;
  s->slip = carom_slip_name(w->options.slip);
  s->error_exact_median = s->error_exact_max = NAN;
  snprintf(name, sizeof name, "reference-exact-%s.csv", s->slip);
  const bool loaded = reference_load(folder, name, w->cases, &reference);
  if (loaded) {
    const accuracy_summary exact = compare(w, reference.result);
    s->error_exact_median = exact.median;
    s->error_exact_max = exact.max;
  }
  reference_free(&reference);
  return loaded;
}

/* ---- What is asked for */

static bool names(const name_list *list, const char *name) {
  bool named = false;
  for (size_t k = 0; k < list->count; k++)
    named |= strcmp(list->name[k], name) == 0;
  return named;
}

static bool wants_precision(const bench_job *job, bool single) {
  return job->shared.precision == ANY_PRECISION ||
         (job->shared.precision == SINGLE_PRECISION) == single;
}

static workload *add(struct collisions *c, const kernel *one) {
  c->work = grow(c->work, &c->room, c->count + 1, sizeof *c->work);
  workload *w = &c->work[c->count++];
  *w = (workload){
      .kernel = one, .cases = &c->cases, .in = c->cases.impact, .isa = carom_isa_in_force()};
  w->options.steps = CAROM_DEFAULT_STEPS;
  if (!one->is_rung)
    w->options.solver = one->solver;
  w->options.slip = one->claims[0].slip;
  return w;
}

/* The cases, one call each, unless they are there already. Where a kernel takes no steps, they
 * are not read. */
static void add_calls(struct collisions *c, const kernel *one, const ladder_module *module,
                      int steps) {
  steps = takes_steps(one) ? steps : CAROM_DEFAULT_STEPS;
  for (size_t k = 0; k < c->count; k++)
    if (c->work[k].size == 0 && c->work[k].kernel == one && c->work[k].module == module &&
        c->work[k].options.steps == steps)
      return;
  workload *w = add(c, one);
  w->module = module;
  w->rung = one->is_rung ? ladder_rung_find(one->name) : NULL;
  w->options.steps = steps;
  w->one = one->is_rung ? by_ladder : by_library;
  w->stride = 1;
  w->rows = w->pairs = w->calls = c->cases.count;
  w->result = allocate(w->rows, sizeof *w->result);
}

static bool add_config(bench_job *job, const kernel *one, const char *config) {
  const ladder_module *module;
  if (!kernel_module(one, config, &module))
    return false;
  for (size_t k = 0; k < job->steps.count; k++)
    add_calls(job->collisions, one, module, job->steps.value[k]);
  return true;
}

static bool add_configs(bench_job *job, const kernel *one) {
  const char *name;
  for (size_t k = 0; k < job->configs.count; k++) {
    const bool all = strcmp(job->configs.name[k], "all") == 0;
    for (size_t m = 0; (name = all      ? ladder_module_name(m)
                               : m == 0 ? job->configs.name[k]
                                        : NULL) != NULL;
         m++)
      if (!add_config(job, one, name))
        return false;
  }
  return job->configs.count > 0 || add_config(job, one, NULL);
}

/* Where nothing is named, what cannot run here is left out; where it is named, it is an error. */
static bool add_all_calls(bench_job *job) {
  const kernel *one;
  const ladder_module *unused;
  if (job->configs.count > 0 && ladder_module_name(0) == NULL)
    return kernel_module(kernel_find(ladder_rung_at(0)->name), NULL, &unused);
  for (size_t k = 0; (one = kernel_at(k)) != NULL; k++) {
    const bool named = names(&job->kernels, one->name), listed = named || job->kernels.count == 0;
    const bool runs = one->is_rung ? ladder_module_name(0) != NULL &&
                                         ladder_rung_runs(ladder_rung_find(one->name))
                                   : job->configs.count == 0;
    if (!listed || !(named || runs) || !wants_precision(job, strcmp(one->precision, "single") == 0))
      continue;
    if (one->is_rung ? !add_configs(job, one) : !add_config(job, one, NULL))
      return false;
  }
  return true;
}

static size_t common_divisor(size_t a, size_t b) {
  return b == 0 ? a : common_divisor(b, a % b);
}

/* Batches of `size` pairs by a solver in lanes of `isa`. */
static void add_batch(struct collisions *c, const kernel *one, carom_isa isa, bool single,
                      int threads, int steps, size_t size) {
  const size_t shared = common_divisor(size, c->cases.count);
  workload *w = add(c, one);
  w->in = c->tiled;
  w->in_f32 = c->tiled_f32;
  w->isa = isa;
  w->single = single;
  w->size = size;
  w->calls = size < LARGE ? c->cases.count / shared : 1;
  w->stride = size % c->cases.count;
  w->one = by_batch;
  w->rows = w->calls > 1 ? size + c->cases.count - shared : size;
  w->pairs = w->calls * size;
  w->options.threads = threads;
  if (takes_steps(one))
    w->options.steps = steps;
  if (single)
    w->result_f32 = allocate(w->rows, sizeof *w->result_f32);
  else
    w->result = allocate(w->rows, sizeof *w->result);
}

/* Every size, precision, number of threads and, where a kernel takes any, of steps that is
 * wanted. */
static void add_batches(bench_job *job, const kernel *one, carom_isa isa) {
  const size_t counts = takes_steps(one) ? job->steps.count : 1;
  for (size_t size = 0; size < job->pairs.count; size++)
    for (int single = 0; single < 2; single++)
      for (size_t t = 0; t < job->threads.count && wants_precision(job, single != 0); t++)
        for (size_t k = 0; k < counts; k++)
          add_batch(job->collisions, one, isa, single != 0, job->threads.value[t],
                    job->steps.value[k], (size_t)job->pairs.value[size]);
}

bool bench_isa_here(carom_isa isa) {
  return carom_isa_available(isa) && isa <= carom_isa_in_force();
}

static bool wants_isa(const bench_job *job, carom_isa isa) {
  return bench_isa_here(isa) && (job->isas.count == 0 || names(&job->isas, carom_isa_name(isa)) ||
                                 (isa == carom_isa_in_force() && names(&job->isas, "best")));
}

/* Solvers with steps cost a batch as much as thousands of the others, so they have to be asked
 * for. */
static bool wants_batches(const bench_job *job, const kernel *one) {
  if (one->is_rung || (job->kernels.count > 0 && !names(&job->kernels, one->name)))
    return false;
  return job->batch || (job->configs.count == 0 && !takes_steps(one));
}

static void add_all_batches(bench_job *job) {
  struct collisions *c = job->collisions;
  const size_t n = c->cases.count;
  if (job->pairs.count == 0) /* whole turns of the cases */
    add_count(&job->pairs, (int)((DEFAULT_SIZE + n - 1) / n * n));
  const bool both = job->threads.count == 0 && sysconf(_SC_NPROCESSORS_ONLN) > 1;
  if (job->threads.count == 0)
    add_count(&job->threads, 1);
  if (both)
    add_count(&job->threads, 2);
  size_t rows = n;
  for (size_t k = 0; k < job->pairs.count; k++)
    rows = (size_t)job->pairs.value[k] + n > rows ? (size_t)job->pairs.value[k] + n : rows;
  c->tiled = allocate(rows, sizeof *c->tiled);
  c->tiled_f32 = allocate(rows, sizeof *c->tiled_f32);
  for (size_t k = 0; k < rows; k++)
    c->tiled[k] = c->cases.impact[k % n];
  to_single(c->tiled, c->tiled_f32, rows * sizeof *c->tiled / sizeof(double));
  const kernel *one;
  for (size_t k = 0; (one = kernel_at(k)) != NULL; k++)
    for (int isa = 0; carom_isa_name((carom_isa)isa) != NULL && wants_batches(job, one); isa++)
      if (wants_isa(job, (carom_isa)isa))
        add_batches(job, one, (carom_isa)isa);
}

/* ---- The reference of speedup: the ladder's first rung in the default configuration; without a
 * ladder, the library's Euler */

/* With as many steps as the workload, or the default where it takes none. */
static int reference_steps(const workload *w) {
  return steps_of(w) > 0 ? steps_of(w) : CAROM_DEFAULT_STEPS;
}

static bool is_reference(const struct collisions *c, const workload *w) {
  return w->size == 0 && w->kernel == c->reference && w->module == c->reference_module;
}

/* They come first, with as many steps as the others have, then with the default for those
 * without. */
static bool add_references(struct collisions *c) {
  c->reference = kernel_find(ladder_module_name(0) != NULL ? ladder_rung_at(0)->name
                                                           : carom_solver_name(CAROM_SOLVER_EULER));
  if (c->reference->is_rung && !kernel_module(c->reference, NULL, &c->reference_module))
    return false;
  const size_t chosen = c->count;
  for (int without = 0; without < 2; without++)
    for (size_t k = 0; k < chosen; k++)
      if ((steps_of(&c->work[k]) == 0) == (without == 1))
        add_calls(c, c->reference, c->reference_module, reference_steps(&c->work[k]));
  workload *sorted = allocate(c->count, sizeof *sorted);
  size_t count = 0;
  for (int others = 0; others < 2; others++)
    for (size_t k = 0; k < c->count; k++)
      if (is_reference(c, &c->work[k]) == (others == 0))
        sorted[count++] = c->work[k];
  free(c->work);
  c->work = sorted;
  c->room = c->count;
  return true;
}

/* ---- The table of work */

static bool verify_all(bench_job *job) {
  struct collisions *c = job->collisions;
  job->subject = allocate(c->count, sizeof *job->subject);
  for (size_t k = 0; k < c->count; k++) {
    workload *w = &c->work[k];
    bool good;
    bench_subject s = {.kernel = w->kernel->name,
                       .config = config_of(w),
                       .isa = isa_of(w),
                       .precision = precision_of(w),
                       .threads = w->size > 0 ? w->options.threads : 1,
                       .steps = steps_of(w),
                       .paper = w->rung != NULL ? w->rung->paper : NULL,
                       .in_a_call = w->size,
                       .resolve = resolve,
                       .empty = resolve_nothing,
                       .fingerprint = fingerprint,
                       .context = w,
                       .reference = SIZE_MAX};
    if (!verify(w, job->folder, &good) || (job->errors && !compare_exact(w, job->folder, &s)))
      return false;
    progress_show("kernels verified", (double)(k + 1), (double)c->count);
    if (!good) {
      job->code = EXIT_SOME;
      continue;
    }
    s.pairs = w->pairs;
    s.verified = fingerprint(w);
    s.pair_error_max = w->own.max;
    for (size_t before = 0; before <= job->subject_count; before++) {
      const bench_subject *of = before < job->subject_count ? &job->subject[before] : &s;
      if (is_reference(c, of->context) && of->steps == reference_steps(w))
        s.reference = before;
    }
    job->subject[job->subject_count++] = s;
  }
  return true;
}

static bool choose(bench_job *job) {
  struct collisions *c = job->collisions = allocate(1, sizeof *c);
  job->show_pairs = job->pairs.count > 0;
  if (job->steps.count == 0)
    add_count(&job->steps, CAROM_DEFAULT_STEPS);
  if (job->budget == 0.0)
    job->budget = 20.0;
  if (!cases_load(job->folder, "collisions-204.csv", &c->cases))
    return false;
  if (!job->batch && (job->isas.count == 0 || names(&job->isas, "scalar")) && !add_all_calls(job))
    return false;
  add_all_batches(job);
  if (c->count == 0) {
    complain("nothing to time: no kernel is all that is asked for (see `carom-lab kernels`; only "
             "the library's come in batches)");
    return false;
  }
  return add_references(c) && verify_all(job);
}

static void note(const bench_job *job, FILE *out) {
  const struct collisions *c = job->collisions;
  machine_note(out, "workload", "%zu reference cases, one call each, mean over the cases",
               c->cases.count);
  bool batches = false;
  for (size_t k = 0; k < c->count; k++)
    batches |= c->work[k].size > 0;
  if (batches && job->show_pairs)
    machine_note(out, "batches",
                 "the cases over and over, so many pairs in a call as the column says");
  else if (batches)
    machine_note(out, "batches", "the cases over and over, %d pairs in a call",
                 job->pairs.value[0]);
  machine_note(out, "reference kernel", "%s, %s, with as many steps", c->reference->name,
               config_of(&c->work[0]));
  const char *name;
  for (size_t k = 0; (name = ladder_module_name(k)) != NULL; k++)
    for (size_t w = 0; w < c->count; w++)
      if (c->work[w].module != NULL && c->work[w].module->name == name) {
        const ladder_module *module = c->work[w].module;
        machine_note(out, module->name, "%s, %s, %s", module->compiler, module->version,
                     module->flags);
        break;
      }
  for (const workload *w = c->work; w < c->work + c->count; w++)
    if (w->kept != NULL && w->rows < c->cases.count)
      machine_note(out, "left out",
                   "%s, %s, %d steps: %zu of %zu cases, whose approach its precision does not "
                   "resolve in as many steps",
                   w->kernel->name, config_of(w), w->options.steps, c->cases.count - w->rows,
                   c->cases.count);
}

static void release(bench_job *job) {
  struct collisions *c = job->collisions;
  for (size_t k = 0; k < c->count; k++) {
    free(c->work[k].kept);
    free(c->work[k].case_of);
    free(c->work[k].result);
    free(c->work[k].result_f32);
  }
  free(c->work);
  free(c->tiled);
  free(c->tiled_f32);
  cases_free(&c->cases);
  free(c);
}

const bench_table bench_of_collisions = {
    .choose = choose, .note = note, .print = bench_print, .release = release};
