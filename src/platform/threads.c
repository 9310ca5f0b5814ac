/* Threads: a batch cut into equal parts, one for each.
 *
 * Each pair's result depends on nothing but the pair once the solver is chosen for the whole batch, so it is the same for any
 * number of threads. Threads are started for the call and joined before it returns; the calling thread does the first part
 * itself, and all of it if no thread can be started. A batch too small to be worth a thread is not cut: starting one costs
 * about as much as some hundred exact collisions.
 */
#include "ball_ball/arguments.h"
#include "ball_ball/batch.h"

#include <pthread.h>
#include <stdbool.h>
#include <unistd.h>

enum {
  MOST_THREADS = 256,
  UNIT = 64, /* parts are multiples of this, so that only the last has lanes to spare */
};

/* Fewer pairs than this are not worth a thread: about 50 us of work. */
static size_t least_part(const carom_options *opt) {
  if (opt->solver == CAROM_SOLVER_EULER) {
    const size_t part = 20000 / (size_t)carom_steps(opt);
    return part > UNIT ? part : UNIT;
  }
  return 4096;
}

typedef struct part {
  carom_batch_solver *solver;
  const char *in;
  size_t n;
  const carom_options *opt;
  char *out;
  int8_t *status;
  size_t first_bad;
} part;

static void *run_part(void *argument) {
  part *p = argument;
  p->first_bad = p->solver(p->in, p->n, p->opt, p->out, p->status);
  return NULL;
}

static size_t processors(void) {
  const long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count > 0 ? (size_t)count : 1;
}

size_t carom_batch_in_threads(carom_batch_solver *solver, carom_precision precision, const void *in, size_t n,
                              const carom_options *opt, void *out, int8_t *status) {
  size_t threads = opt->threads == CAROM_ALL_THREADS ? processors() : (size_t)opt->threads;
  const size_t useful = n / least_part(opt);
  if (threads > useful)
    threads = useful;
  if (threads > MOST_THREADS)
    threads = MOST_THREADS;
  if (threads <= 1)
    return solver(in, n, opt, out, status);

  const size_t in_size = precision == CAROM_DOUBLE ? sizeof(carom_impact) : sizeof(carom_impact_f32);
  const size_t out_size = precision == CAROM_DOUBLE ? sizeof(carom_result) : sizeof(carom_result_f32);
  part parts[MOST_THREADS];
  pthread_t id[MOST_THREADS];
  bool started[MOST_THREADS] = {false};
  const size_t units = (n + UNIT - 1) / UNIT;
  for (size_t t = 0; t < threads; t++) {
    const size_t from = units * t / threads * UNIT, end = units * (t + 1) / threads * UNIT;
    parts[t] = (part){.solver = solver,
                      .in = (const char *)in + from * in_size,
                      .n = (end < n ? end : n) - from,
                      .opt = opt,
                      .out = (char *)out + from * out_size,
                      .status = status != NULL ? status + from : NULL};
    started[t] = t > 0 && pthread_create(&id[t], NULL, run_part, &parts[t]) == 0;
  }
  for (size_t t = 0; t < threads; t++)
    if (!started[t])
      run_part(&parts[t]);
  size_t first_bad = n, before = 0;
  for (size_t t = 0; t < threads; t++) {
    if (started[t])
      pthread_join(id[t], NULL);
    if (first_bad == n && parts[t].first_bad < parts[t].n)
      first_bad = before + parts[t].first_bad;
    before += parts[t].n;
  }
  return first_bad;
}
