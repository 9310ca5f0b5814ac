/* `carom-lab bench` of collisions: kernels x configurations x steps, one call each; solvers x instruction sets x
 * precisions x threads x sizes, in batches; the copies beside those; and what all are compared with. */
#include "bench_job.h"
#include "caches.h"
#include "command.h"
#include "machine.h"
#include "memory.h"
#include "message.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool names(const name_list *list, const char *name) {
  bool named = false;
  for (size_t k = 0; k < list->count; k++)
    named |= strcmp(list->name[k], name) == 0;
  return named;
}

static bool wants_precision(const bench_job *job, bool single) {
  return job->shared.precision == ANY_PRECISION || (job->shared.precision == SINGLE_PRECISION) == single;
}

/* One more workload. */
static workload *add_workload(bench_job *job) {
  job->work = grow(job->work, &job->work_space, job->work_count + 1, sizeof *job->work);
  return &job->work[job->work_count++];
}

/* ---- One call each */

static const workload *find_calls(const bench_job *job, const kernel *one, const ladder_module *module, int steps) {
  for (size_t k = 0; k < job->work_count; k++) {
    const workload *w = &job->work[k];
    if (w->batch.size == 0 && w->kernel == one && w->module == module && w->options.steps == steps)
      return w;
  }
  return NULL;
}

static void add_calls(bench_job *job, const kernel *one, const ladder_module *module, int steps) {
  if (find_calls(job, one, module, steps) == NULL)
    workload_of_calls(add_workload(job), one, module, steps, &job->cases);
}

static void add_steps(bench_job *job, const kernel *one, const ladder_module *module) {
  const size_t count = workload_takes_steps(one) ? job->steps.count : 1; /* where it takes none, they are not read */
  for (size_t k = 0; k < count; k++)
    add_calls(job, one, module, workload_takes_steps(one) ? job->steps.value[k] : CAROM_DEFAULT_STEPS);
}

static bool add_config(bench_job *job, const kernel *one, const char *config) {
  const ladder_module *module;
  const bool there = kernel_module(one, config, &module);
  if (there)
    add_steps(job, one, module);
  return there;
}

static bool add_rung(bench_job *job, const kernel *one) {
  for (size_t k = 0; k < job->configs.count; k++) {
    if (strcmp(job->configs.name[k], "all") != 0) {
      if (!add_config(job, one, job->configs.name[k]))
        return false;
      continue;
    }
    const char *name;
    for (size_t m = 0; (name = ladder_module_name(m)) != NULL; m++)
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
    const bool named = names(&job->kernels, one->name);
    if ((job->kernels.count > 0 && !named) || !wants_precision(job, strcmp(one->precision, "single") == 0))
      continue;
    if (!named && one->is_rung && (ladder_module_name(0) == NULL || !ladder_rung_runs(ladder_rung_find(one->name))))
      continue;
    if (!named && !one->is_rung && job->configs.count > 0)
      continue;
    if (!one->is_rung)
      add_steps(job, one, NULL);
    else if (!add_rung(job, one))
      return false;
  }
  return true;
}

/* ---- Batches */

bool bench_isa_here(carom_isa isa) {
  return carom_isa_available(isa) && isa <= carom_isa_in_force();
}

static bool wants_isa(const bench_job *job, carom_isa isa) {
  return bench_isa_here(isa) && (job->isas.count == 0 || names(&job->isas, carom_isa_name(isa)) ||
                                 (isa == carom_isa_in_force() && names(&job->isas, "best")));
}

/* Solvers with steps cost a batch as much as thousands of the others, so they have to be asked for. */
static bool wants_batches(const bench_job *job, const kernel *one) {
  if (one->is_rung || (job->kernels.count > 0 && !names(&job->kernels, one->name)))
    return false;
  return job->batch || (job->configs.count == 0 && !workload_takes_steps(one));
}

typedef struct shape {
  bool single;
  int threads;
  size_t size;
} shape;

/* Calls `add` with every size, precision and number of threads that is wanted. */
static void for_each_shape(bench_job *job, void (*add)(bench_job *job, const shape *s, const kernel *one, carom_isa isa),
                           const kernel *one, carom_isa isa) {
  for (size_t size = 0; size < job->pairs.count; size++)
    for (int single = 0; single < 2; single++)
      for (size_t threads = 0; threads < job->threads.count && wants_precision(job, single != 0); threads++) {
        const shape s = {single != 0, job->threads.value[threads], (size_t)job->pairs.value[size]};
        add(job, &s, one, isa);
      }
}

static void add_batch(bench_job *job, const shape *s, const kernel *one, carom_isa isa) {
  const size_t counts = workload_takes_steps(one) ? job->steps.count : 1;
  for (size_t k = 0; k < counts; k++)
    workload_of_batch(add_workload(job), one, isa, s->single, s->threads, job->steps.value[k], s->size, &job->cases,
                      &job->tiles);
}

static void add_copy(bench_job *job, const shape *s, const kernel *one, carom_isa isa) {
  (void)one;
  (void)isa;
  workload_of_copy(add_workload(job), s->single, s->threads, s->size, &job->cases, &job->tiles);
}

/* The batches, and behind them the copies of as many bytes. */
static void add_all_batches(bench_job *job) {
  const kernel *one;
  bool any = false;
  for (size_t k = 0; (one = kernel_at(k)) != NULL; k++)
    for (int isa = 0; carom_isa_name((carom_isa)isa) != NULL && wants_batches(job, one); isa++)
      if (wants_isa(job, (carom_isa)isa)) {
        any = true;
        for_each_shape(job, add_batch, one, (carom_isa)isa);
      }
  if (any)
    for_each_shape(job, add_copy, NULL, (carom_isa)0);
}

/* A copy in the second cache, half of which it takes, beside that of the batches. */
static void add_near_copies(bench_job *job) {
  const size_t turn = job->cases.count * workload_bytes(false), turns = cache_size(2) / 2 / turn;
  if (turns == 0 || job->work_count == 0 || job->work[job->work_count - 1].kernel != NULL)
    return;
  for (int single = 0; single < 2; single++) {
    const shape s = {single != 0, 1, turns * job->cases.count};
    if (s.size < (size_t)job->pairs.value[0] && wants_precision(job, single != 0))
      add_copy(job, &s, NULL, (carom_isa)0);
  }
}

static void choose_batches(bench_job *job) {
  const size_t default_size = 65536;
  const bool given = job->pairs.count > 0;
  if (!given) /* whole turns of the cases */
    add_count(&job->pairs, (int)((default_size + job->cases.count - 1) / job->cases.count * job->cases.count));
  if (job->threads.count == 0) {
    add_count(&job->threads, 1);
    if (sysconf(_SC_NPROCESSORS_ONLN) > 1)
      add_count(&job->threads, 2);
  }
  int largest = 0;
  for (size_t k = 0; k < job->pairs.count; k++)
    largest = job->pairs.value[k] > largest ? job->pairs.value[k] : largest;
  case_tiles_make(&job->tiles, &job->cases, (size_t)largest);
  add_all_batches(job);
  if (!given)
    add_near_copies(job);
}

/* ---- The yardstick */

static const kernel *yardstick_kernel(void) {
  return kernel_find(ladder_module_name(0) != NULL ? ladder_rung_at(0)->name : carom_solver_name(CAROM_SOLVER_EULER));
}

/* As many steps as the yardstick of this workload takes: its own, or the default where it takes none. */
static int yardstick_steps(const workload *w) {
  const int steps = workload_steps(w);
  return steps > 0 ? steps : CAROM_DEFAULT_STEPS;
}

static bool is_yardstick(const bench_job *job, const workload *w) {
  return w->batch.size == 0 && w->kernel == job->yardstick.kernel && w->module == job->yardstick.module;
}

/* Speedup is relative to the ladder's first rung in the default configuration; without a ladder, to the library's first solver
 * with steps. The yardsticks come first, with as many steps as the others have, then with the default for those without. */
static bool add_yardsticks(bench_job *job) {
  job->yardstick.kernel = yardstick_kernel();
  if (job->yardstick.kernel->is_rung && !kernel_module(job->yardstick.kernel, NULL, &job->yardstick.module))
    return false;
  const size_t chosen = job->work_count;
  for (int without = 0; without < 2; without++)
    for (size_t k = 0; k < chosen; k++)
      if ((workload_steps(&job->work[k]) == 0) == (without == 1))
        add_calls(job, job->yardstick.kernel, job->yardstick.module, yardstick_steps(&job->work[k]));
  workload *sorted = allocate(job->work_count, sizeof *sorted);
  size_t count = 0;
  for (int others = 0; others < 2; others++)
    for (size_t k = 0; k < job->work_count; k++)
      if (is_yardstick(job, &job->work[k]) == (others == 0))
        sorted[count++] = job->work[k];
  free(job->work);
  job->work = sorted;
  job->work_space = job->work_count;
  return true;
}

static bool choose_work(bench_job *job) {
  if (!job->batch && (job->isas.count == 0 || names(&job->isas, "scalar")) && !add_all_calls(job))
    return false;
  choose_batches(job);
  if (job->work_count == 0) {
    complain(
        "nothing to time: no kernel is all that is asked for (see `carom-lab kernels`; only the library's come in batches)");
    return false;
  }
  return add_yardsticks(job);
}

/* ---- The table of work */

static bool verify_all(bench_job *job) {
  job->subject = allocate(job->work_count, sizeof *job->subject);
  for (size_t k = 0; k < job->work_count; k++) {
    workload *w = &job->work[k];
    char message[WORKLOAD_MESSAGE];
    if (!workload_verify(w, job->folder, message) || (job->errors && !workload_compare_exact(w, job->folder)))
      return false;
    progress_show("kernels verified", (double)(k + 1), (double)job->work_count);
    if (message[0] != '\0') {
      complain("%s", message);
      job->code = EXIT_SOME;
      continue;
    }
    job->subject[job->subject_count++] = workload_subject(w);
  }
  return true;
}

/* The subject that `of` is compared with, or SIZE_MAX. */
static size_t yardstick_of(const bench_job *job, const workload *of) {
  for (size_t k = 0; k < job->subject_count; k++) {
    const workload *w = job->subject[k].context;
    if (is_yardstick(job, w) && w->options.steps == yardstick_steps(of))
      return k;
  }
  return SIZE_MAX;
}

static bool choose(bench_job *job) {
  job->show_pairs = job->pairs.count > 0;
  if (job->steps.count == 0)
    add_count(&job->steps, CAROM_DEFAULT_STEPS);
  if (job->budget == 0.0)
    job->budget = 20.0;
  if (!cases_load(job->folder, "collisions-204.csv", &job->cases) || !choose_work(job) || !verify_all(job))
    return false;
  for (size_t k = 0; k < job->subject_count; k++)
    job->subject[k].yardstick = yardstick_of(job, job->subject[k].context);
  return true;
}

static void release(bench_job *job) {
  for (size_t k = 0; k < job->work_count; k++)
    workload_free(&job->work[k]);
  free(job->work);
  cases_free(&job->cases);
  case_tiles_free(&job->tiles);
}

/* For batches: how large they are, and what the copy is. */
static void print_batch_notes(const bench_job *job, FILE *out) {
  bool any = false;
  for (size_t k = 0; k < job->work_count; k++)
    any |= job->work[k].batch.size > 0;
  if (!any)
    return;
  if (job->show_pairs)
    machine_note(out, "batches", "the cases over and over, so many pairs in a call as the column says");
  else
    machine_note(out, "batches", "the cases over and over, %d pairs in a call", job->pairs.value[0]);
  machine_note(out, "bytes", "a pair is %zu bytes in and %zu out in double precision, half of that in single",
               sizeof(carom_impact), sizeof(carom_result));
  machine_note(out, "copy", "reads and writes as many bytes and computes nothing; its config is the cache that holds them");
}

static void note(const bench_job *job, FILE *out) {
  machine_note(out, "workload", "%zu reference cases, one call each, mean over the cases", job->cases.count);
  print_batch_notes(job, out);
  const workload *yardstick = &job->work[0];
  machine_note(out, "yardstick", "%s, %s, with as many steps", workload_name(yardstick), workload_config(yardstick));
  const char *name;
  for (size_t k = 0; (name = ladder_module_name(k)) != NULL; k++)
    for (size_t w = 0; w < job->work_count; w++)
      if (job->work[w].module != NULL && job->work[w].module->name == name) {
        const ladder_module *module = job->work[w].module;
        machine_note(out, module->name, "%s, %s, %s", module->compiler, module->version, module->flags);
        break;
      }
  for (size_t w = 0; w < job->work_count; w++)
    if (job->work[w].left_out > 0)
      machine_note(out, "left out",
                   "%s, %s, %d steps: %zu of %zu cases, whose approach its precision does not resolve in as many steps",
                   job->work[w].kernel->name, workload_config(&job->work[w]), job->work[w].options.steps, job->work[w].left_out,
                   job->cases.count);
}

const bench_table bench_of_collisions = {.choose = choose, .note = note, .print = bench_print, .release = release};
