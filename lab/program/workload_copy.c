/* The floor under a batch: its bytes moved and nothing computed.
 *
 * As the solvers do, it goes through the input in blocks that stay in the first cache: a block is read whole, and as many bytes
 * as its results take are written. Threads divide the arrays as those of a batch do, by the library's own function.
 */
#include "memory.h"
#include "platform/threads.h"
#include "workload.h"

#include <string.h>

enum {
  BLOCK = 64,
  LEAST_PART = 4096 /* fewer pairs are not worth a thread: the solvers start none either */
};

/* The arrays as bytes. */
typedef struct arrays {
  const char *in;
  char *out;
  size_t in_size, out_size;
} arrays;

static arrays arrays_of(const workload *w) {
  if (w->batch.single)
    return (arrays){(const char *)w->batch.tiles->in_f32, (char *)w->batch.result32, sizeof(carom_impact_f32),
                    sizeof(carom_result_f32)};
  return (arrays){(const char *)w->in, (char *)w->result, sizeof(carom_impact), sizeof(carom_result)};
}

/* A block's results are its first bytes. */
static size_t copy_rows(const void *job, size_t from, size_t end) {
  const arrays *a = job;
  char block[BLOCK * sizeof(carom_impact)];
  for (size_t k = from; k < end; k += BLOCK) {
    const size_t n = end - k < BLOCK ? end - k : BLOCK;
    memcpy(block, a->in + k * a->in_size, n * a->in_size);
    BENCH_CONSUME(block);
    memcpy(a->out + k * a->out_size, block, n * a->out_size);
  }
  return end;
}

static void copy_all(void *context) {
  const workload *w = context;
  const arrays a = arrays_of(w);
  carom_in_threads(copy_rows, &a, w->batch.size, w->options.threads, LEAST_PART);
}

bool workload_is_copy(const workload *w) {
  const arrays a = arrays_of(w);
  bool same = true;
  for (size_t k = 0; k < w->batch.size; k += BLOCK) {
    const size_t n = w->batch.size - k < BLOCK ? w->batch.size - k : BLOCK;
    same &= memcmp(a.in + k * a.in_size, a.out + k * a.out_size, n * a.out_size) == 0;
  }
  return same;
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

size_t workload_bytes(bool single) {
  return single ? sizeof(carom_impact_f32) + sizeof(carom_result_f32) : sizeof(carom_impact) + sizeof(carom_result);
}
