/* What a run of `carom bench` times: kernels x configurations x steps, and what they are compared with. */
#include "bench_job.h"
#include "message.h"

#include <stdlib.h>
#include <string.h>

/* ---- What to time */

static bool names_kernel(const bench_job *job, const kernel *one) {
  bool named = false;
  for (size_t k = 0; k < job->kernels.count; k++)
    named |= strcmp(job->kernels.name[k], one->name) == 0;
  return named;
}

static bool add(bench_job *job, const kernel *one, const ladder_module *module, int steps) {
  for (size_t k = 0; k < job->work_count; k++) {
    const workload *w = &job->work[k];
    if (w->kernel == one && w->module == module && w->options.steps == steps)
      return true;
  }
  if (job->work_count == job->work_space) {
    const size_t space = 2 * job->work_space + 16;
    workload *larger = realloc(job->work, space * sizeof *larger);
    if (larger == NULL) {
      complain("out of memory");
      return false;
    }
    job->work = larger;
    job->work_space = space;
  }
  if (!workload_of_calls(&job->work[job->work_count], one, module, steps, &job->cases))
    return false;
  job->work_count++;
  return true;
}

static bool add_steps(bench_job *job, const kernel *one, const ladder_module *module) {
  for (size_t k = 0; k < job->steps_count; k++)
    if (!add(job, one, module, job->steps[k]))
      return false;
  return true;
}

static bool add_config(bench_job *job, const kernel *one, const char *config) {
  const ladder_module *module;
  return kernel_module(one, config, &module) && add_steps(job, one, module);
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
static bool add_all(bench_job *job) {
  const kernel *one;
  for (size_t k = 0; (one = kernel_at(k)) != NULL; k++) {
    const bool named = names_kernel(job, one);
    if (job->kernels.count > 0 && !named)
      continue;
    if (!named && one->is_rung && (ladder_module_name(0) == NULL || !ladder_rung_runs(ladder_rung_find(one->name))))
      continue;
    if (!named && !one->is_rung && job->configs.count > 0)
      continue;
    if (!(one->is_rung ? add_rung(job, one) : add_steps(job, one, NULL)))
      return false;
  }
  return true;
}

/* Speedup is relative to the ladder's first rung in the default configuration; without a ladder, to the library's first solver
 * with steps. */
static bool add_yardsticks(bench_job *job) {
  const bool ladder = ladder_module_name(0) != NULL;
  const kernel *one = kernel_find(ladder ? ladder_rung_at(0)->name : carom_solver_name(CAROM_SOLVER_EULER));
  return ladder ? add_config(job, one, NULL) : add_steps(job, one, NULL);
}

bool bench_choose(bench_job *job) {
  return add_yardsticks(job) && add_all(job);
}

size_t bench_yardstick(const bench_job *job, int steps) {
  const workload *yardstick = &job->work[0];
  for (size_t k = 0; k < job->subject_count; k++) {
    const workload *w = job->subject[k].context;
    if (w->kernel == yardstick->kernel && w->module == yardstick->module && w->options.steps == steps)
      return k;
  }
  return SIZE_MAX;
}
