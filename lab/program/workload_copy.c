/* The floor under a batch: its bytes moved and nothing computed.
 *
 * As the solvers do, it goes through the input in blocks that stay in the first cache: a block is read whole, and as many bytes
 * as its results take are written. Threads divide the arrays as those of a batch do.
 */
#include "memory.h"
#include "workload.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
  BLOCK = 64,
  MOST_THREADS = 256,
  LEAST_PART = 4096 /* fewer pairs are not worth a thread: the solvers start none either */
};

/* The arrays as bytes, and the rows of one thread. */
typedef struct part {
  const char *in;
  char *out;
  size_t in_size, out_size, from, end;
  bool same; /* of comparing: whether the output is a copy */
} part;

static part arrays_of(const workload *w) {
  if (w->batch.single)
    return (part){(const char *)w->batch.tiles->in_f32,
                  (char *)w->batch.result32,
                  sizeof(carom_impact_f32),
                  sizeof(carom_result_f32),
                  0,
                  w->batch.size,
                  true};
  return (part){(const char *)w->in, (char *)w->result, sizeof(carom_impact), sizeof(carom_result), 0, w->batch.size, true};
}

/* A block's results are its first bytes. */
static void *copy_part(void *argument) {
  const part *p = argument;
  char block[BLOCK * sizeof(carom_impact)];
  for (size_t k = p->from; k < p->end; k += BLOCK) {
    const size_t n = p->end - k < BLOCK ? p->end - k : BLOCK;
    memcpy(block, p->in + k * p->in_size, n * p->in_size);
    BENCH_CONSUME(block);
    memcpy(p->out + k * p->out_size, block, n * p->out_size);
  }
  return NULL;
}

static void *compare_part(void *argument) {
  part *p = argument;
  for (size_t k = p->from; k < p->end; k += BLOCK) {
    const size_t n = p->end - k < BLOCK ? p->end - k : BLOCK;
    p->same &= memcmp(p->in + k * p->in_size, p->out + k * p->out_size, n * p->out_size) == 0;
  }
  return NULL;
}

/* Cuts the rows over threads, as the library cuts a batch, and works on each part in its own; the calling thread takes the
 * first, and those for which none can be started. Returns whether all of them are the same. */
static bool in_threads(const workload *w, void *(*work)(void *part)) {
  const size_t most = w->batch.size / LEAST_PART, wanted = (size_t)w->options.threads, n = w->batch.size;
  const size_t used = wanted < most ? wanted : most, threads = used == 0 ? 1 : used < MOST_THREADS ? used : MOST_THREADS;
  part parts[MOST_THREADS];
  pthread_t id[MOST_THREADS];
  bool started[MOST_THREADS] = {false}, same = true;
  for (size_t t = 0; t < threads; t++) {
    parts[t] = arrays_of(w);
    parts[t].from = n * t / threads;
    parts[t].end = n * (t + 1) / threads;
    started[t] = t > 0 && pthread_create(&id[t], NULL, work, &parts[t]) == 0;
  }
  for (size_t t = 0; t < threads; t++)
    if (!started[t])
      work(&parts[t]);
  for (size_t t = 0; t < threads; t++) {
    if (started[t])
      pthread_join(id[t], NULL);
    same &= parts[t].same;
  }
  return same;
}

static void copy_all(void *context) {
  in_threads(context, copy_part);
}

void workload_of_copy(workload *w, bool single, int threads, size_t size, const case_set *cases, const case_tiles *tiles) {
  *w = (workload){.isa = "memcpy",
                  .options = {.steps = CAROM_DEFAULT_STEPS},
                  .cases = cases,
                  .in = tiles->in,
                  .rows = size,
                  .pairs = size,
                  .batch = {.size = size, .calls = 1, .single = single, .tiles = tiles},
                  .resolve = copy_all};
  w->options.threads = threads;
  if (single)
    w->batch.result32 = allocate(size, sizeof *w->batch.result32);
  else
    w->result = allocate(size, sizeof *w->result);
}

bool workload_is_copy(const workload *w) {
  return in_threads(w, compare_part);
}

size_t workload_bytes(bool single) {
  return single ? sizeof(carom_impact_f32) + sizeof(carom_result_f32) : sizeof(carom_impact) + sizeof(carom_result);
}
