/* The floor under a batch: its bytes moved and nothing computed.
 *
 * As the solvers do, it goes through the input in blocks that stay in the first cache: a block is read whole, and as many bytes
 * as its results take are written. Threads divide the arrays as those of a batch do.
 */
#include "caches.h"
#include "message.h"
#include "workload.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
  BLOCK = 64,
  MOST_THREADS = 256,
  LEAST_PART = 4096, /* fewer pairs are not worth a thread: the solvers start none either */
};

typedef struct part {
  const char *in;
  char *out;
  size_t in_size, out_size, pairs;
} part;

static void *copy_part(void *argument) {
  const part *p = argument;
  char block[BLOCK * sizeof(carom_impact)];
  for (size_t k = 0; k < p->pairs; k += BLOCK) {
    const size_t n = p->pairs - k < BLOCK ? p->pairs - k : BLOCK;
    memcpy(block, p->in + k * p->in_size, n * p->in_size);
    BENCH_CONSUME(block);
    memcpy(p->out + k * p->out_size, block, n * p->out_size);
  }
  return NULL;
}

static size_t threads_used(const workload *w) {
  const size_t most = w->batch.size / LEAST_PART, wanted = (size_t)w->options.threads;
  const size_t used = wanted < most ? wanted : most;
  return used == 0 ? 1 : used < MOST_THREADS ? used : MOST_THREADS;
}

static void copy_all(void *context) {
  const workload *w = context;
  const bool single = w->batch.single;
  part parts[MOST_THREADS];
  pthread_t id[MOST_THREADS];
  bool started[MOST_THREADS] = {false};
  const size_t threads = threads_used(w), n = w->batch.size;
  for (size_t t = 0; t < threads; t++) {
    const size_t from = n * t / threads, end = n * (t + 1) / threads;
    part *p = &parts[t];
    *p = (part){.in_size = single ? sizeof(carom_impact_f32) : sizeof(carom_impact),
                .out_size = single ? sizeof(carom_result_f32) : sizeof(carom_result),
                .pairs = end - from};
    p->in = (single ? (const char *)w->batch.tiles->in_f32 : (const char *)w->in) + from * p->in_size;
    p->out = (single ? (char *)w->batch.result32 : (char *)w->result) + from * p->out_size;
    started[t] = t > 0 && pthread_create(&id[t], NULL, copy_part, p) == 0;
  }
  for (size_t t = 0; t < threads; t++)
    if (!started[t])
      copy_part(&parts[t]);
  for (size_t t = 0; t < threads; t++)
    if (started[t])
      pthread_join(id[t], NULL);
}

bool workload_of_copy(workload *w, bool single, int threads, size_t size, const case_set *cases, const case_tiles *tiles) {
  *w = (workload){.isa = "memcpy",
                  .options = carom_default_options(),
                  .cases = cases,
                  .in = tiles->in,
                  .rows = size,
                  .pairs = size,
                  .batch = {.size = size, .calls = 1, .single = single, .tiles = tiles},
                  .resolve = copy_all};
  w->options.threads = threads;
  if (single)
    w->batch.result32 = calloc(size, sizeof *w->batch.result32);
  else
    w->result = calloc(size, sizeof *w->result);
  if (w->batch.result32 != NULL || w->result != NULL)
    return true;
  complain("out of memory");
  return false;
}

/* A block's results are its first bytes. */
bool workload_is_copy(const workload *w) {
  const bool single = w->batch.single;
  const size_t in_size = single ? sizeof(carom_impact_f32) : sizeof(carom_impact),
               out_size = single ? sizeof(carom_result_f32) : sizeof(carom_result), threads = threads_used(w);
  const char *in = single ? (const char *)w->batch.tiles->in_f32 : (const char *)w->in;
  const char *out = single ? (const char *)w->batch.result32 : (const char *)w->result;
  for (size_t t = 0; t < threads; t++)
    for (size_t k = w->rows * t / threads, end = w->rows * (t + 1) / threads; k < end; k += BLOCK) {
      const size_t n = end - k < BLOCK ? end - k : BLOCK;
      if (memcmp(in + k * in_size, out + k * out_size, n * out_size) != 0)
        return false;
    }
  return true;
}

size_t workload_bytes(bool single) {
  return single ? sizeof(carom_impact_f32) + sizeof(carom_result_f32) : sizeof(carom_impact) + sizeof(carom_result);
}
