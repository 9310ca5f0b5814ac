/* Batches: many collisions in a call of the library.
 *
 * Results may lie in any place, but what is timed should not depend on which cases a batch happens to hold. So small batches
 * move on: call j begins at case j * size, modulo the number of cases, until it would begin at the first again. Arrays are then
 * as small as a user's would be, a batch and a turn of the cases long.
 */
#include "memory.h"
#include "precision.h"
#include "workload.h"

#include <stdlib.h>

enum { LARGE = 4096 }; /* so many pairs hold all cases about equally often: one call is enough */

/* What a batch must reach on the cases at the claim's steps; 0 asks for the same bits. */
static const struct {
  double in_double, in_single;
} bounds[] = {
    [CAROM_SOLVER_EXACT] = {1e-6, 2e-5},
    [CAROM_SOLVER_EULER] = {0.0, 1e-2},
};

double workload_batch_bound(const workload *w) {
  return w->batch.single ? bounds[w->options.solver].in_single : bounds[w->options.solver].in_double;
}

static size_t common_divisor(size_t a, size_t b) {
  while (b > 0) {
    const size_t rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

void case_tiles_make(case_tiles *tiles, const case_set *cases, size_t size) {
  tiles->rows = size + cases->count;
  tiles->in = allocate(tiles->rows, sizeof *tiles->in);
  tiles->in_f32 = allocate(tiles->rows, sizeof *tiles->in_f32);
  for (size_t k = 0; k < tiles->rows; k++)
    tiles->in[k] = cases->impact[k % cases->count];
  to_single(tiles->in, tiles->in_f32, tiles->rows * sizeof *tiles->in / sizeof(double));
}

void case_tiles_free(case_tiles *tiles) {
  free(tiles->in);
  free(tiles->in_f32);
}

static carom_status by_library(const workload *w, size_t first) {
  const case_tiles *t = w->batch.tiles;
  return w->batch.single
             ? carom_collide_batch_f32(&t->in_f32[first], w->batch.size, &w->options, &w->batch.result32[first], NULL)
             : carom_collide_batch(&t->in[first], w->batch.size, &w->options, &w->result[first], NULL);
}

static carom_status by_nothing(const workload *w, size_t first) {
  (void)w;
  (void)first;
  return CAROM_OK;
}

static void call_all(const workload *w, carom_status (*one)(const workload *w, size_t first)) {
  __asm__ volatile("" : "+r"(one)); /* hidden from the compiler, or it would look into by_nothing */
  for (size_t k = 0, first = 0; k < w->batch.calls; k++, first = (first + w->batch.size) % w->cases->count)
    BENCH_CONSUME((void *)(intptr_t)one(w, first));
}

static void call_library(void *context) {
  const workload *w = context;
  carom_isa_limit(w->batch.isa);
  call_all(w, by_library);
}

static void call_nothing(void *context) {
  const workload *w = context;
  carom_isa_limit(w->batch.isa);
  call_all(w, by_nothing);
}

void workload_of_batch(workload *w, const kernel *one, carom_isa isa, bool single, int threads, int steps, size_t size,
                       const case_set *cases, const case_tiles *tiles) {
  const size_t shared = common_divisor(size, cases->count), calls = size < LARGE ? cases->count / shared : 1;
  *w = (workload){.kernel = one,
                  .isa = carom_isa_name(isa),
                  .options = {.steps = CAROM_DEFAULT_STEPS},
                  .cases = cases,
                  .in = tiles->in,
                  .rows = calls > 1 ? size + cases->count - shared : size,
                  .pairs = calls * size,
                  .batch = {.size = size, .calls = calls, .isa = isa, .single = single, .tiles = tiles},
                  .resolve = call_library,
                  .empty = call_nothing};
  w->options.solver = one->solver;
  w->options.slip = one->claims[0].slip;
  w->options.threads = threads;
  if (workload_takes_steps(one))
    w->options.steps = steps;
  if (single)
    w->batch.result32 = allocate(w->rows, sizeof *w->batch.result32);
  else
    w->result = allocate(w->rows, sizeof *w->result);
}
