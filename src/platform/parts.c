/* Rows shared out over threads: equal parts, one for each.
 *
 * Threads are started for the call and joined before it returns; the calling thread does the first part itself, and what no
 * thread could be started for. */
#include "platform/parts.h"

#include <pthread.h>
#include <stdbool.h>
#include <unistd.h>

enum { MOST_THREADS = 256 };

typedef struct work {
  carom_part *part;
  const void *context;
  size_t first, end, first_bad;
} work;

static void *run(void *argument) {
  work *w = argument;
  w->first_bad = w->part(w->context, w->first, w->end);
  return NULL;
}

static size_t processors(void) {
  const long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count > 0 ? (size_t)count : 1;
}

size_t carom_in_parts(size_t n, size_t least, int threads, carom_part *part, const void *context) {
  size_t count = threads < 0 ? processors() : (size_t)threads;
  if (count > n / least)
    count = n / least;
  if (count > MOST_THREADS)
    count = MOST_THREADS;
  if (count <= 1)
    return part(context, 0, n);
  work works[MOST_THREADS];
  pthread_t id[MOST_THREADS];
  bool started[MOST_THREADS] = {false};
  for (size_t t = 0; t < count; t++) {
    const size_t first = n / count * t + (n % count < t ? n % count : t), rows = n / count + (t < n % count);
    works[t] = (work){part, context, first, first + rows, first + rows};
    started[t] = t > 0 && pthread_create(&id[t], NULL, run, &works[t]) == 0;
  }
  for (size_t t = 0; t < count; t++)
    if (!started[t])
      run(&works[t]);
  size_t first_bad = n;
  for (size_t t = 0; t < count; t++) {
    if (started[t])
      pthread_join(id[t], NULL);
    if (first_bad == n && works[t].first_bad < works[t].end)
      first_bad = works[t].first_bad;
  }
  return first_bad;
}
