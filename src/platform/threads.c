/* Threads: rows cut into equal parts, one for each.
 *
 * Where the cuts are makes no difference to a row, so results are the same for any number of
 * threads. Threads are started for the call and joined before it returns; the calling thread
 * does the first part itself, and all of it if no thread can be started, which is so where the
 * system has none. They block every signal, so that no handler of the process runs on them. A
 * job too small to be worth a thread is not cut. With CAROM_WITHOUT_THREADS nothing is cut, and
 * no library of threads is needed.
 */
#if !defined(_WIN32) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200809L /* pthread_sigmask */
#endif
#include "platform/threads.h"

#ifdef CAROM_WITHOUT_THREADS

size_t carom_in_threads(carom_part_worker *worker, const void *job, size_t n, int threads,
                        size_t least) {
  (void)threads, (void)least;
  return worker(job, 0, n);
}

#else

#include "carom.h"
#include "platform/processors.h"

#include <stdbool.h>
#include <stddef.h>
#ifdef _WIN32
#include <process.h>
#include <windows.h>
typedef HANDLE thread_handle;
#else
#include <pthread.h>
#include <signal.h>
typedef pthread_t thread_handle;
#endif

enum {
  MOST_THREADS = 256,
  UNIT = 64, /* parts are multiples of this, so that only the last has lanes to spare; or of the
                least worth a thread */
};

typedef struct cut {
  carom_part_worker *worker;
  const void *job;
  size_t n, count, unit;
} cut;

/* Short, as all of them are on the stack of the caller. */
typedef struct part {
  size_t number; /* its index; becomes the first bad row of the part, or the row behind it */
  thread_handle thread;
} part;

typedef struct all_parts {
  cut of;
  part part[MOST_THREADS];
} all_parts;

/* Where a part begins; that of one beyond the last is n. */
static size_t start_of(const cut *of, size_t number) {
  const size_t units = (of->n + of->unit - 1) / of->unit,
               start = units * number / of->count * of->unit;
  return start < of->n ? start : of->n;
}

static void run_part(part *p) {
  const char *first = (const char *)(p - p->number);
  const cut *of = &((const all_parts *)(first - offsetof(all_parts, part)))->of;
  p->number = of->worker(of->job, start_of(of, p->number), start_of(of, p->number + 1));
}

#ifdef _WIN32

static unsigned __stdcall run_on_thread(void *argument) {
  run_part(argument);
  return 0;
}

/* Starts a thread for each part but the first. */
static void start_threads(part *parts, size_t count, bool *started) {
  for (size_t t = 1; t < count; t++) {
    parts[t].thread = (HANDLE)_beginthreadex(NULL, 0, run_on_thread, &parts[t], 0, NULL);
    started[t] = parts[t].thread != NULL;
  }
}

static void join(thread_handle thread) {
  WaitForSingleObject(thread, INFINITE);
  CloseHandle(thread);
}

#else

static void *run_on_thread(void *argument) {
  run_part(argument);
  return NULL;
}

/* Starts a thread for each part but the first. A thread inherits the signals that are blocked
 * where it is made. */
static void start_threads(part *parts, size_t count, bool *started) {
  sigset_t all, before;
  sigfillset(&all);
  const bool blocked = pthread_sigmask(SIG_SETMASK, &all, &before) == 0;
  for (size_t t = 1; t < count; t++)
    started[t] = pthread_create(&parts[t].thread, NULL, run_on_thread, &parts[t]) == 0;
  if (blocked)
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

static void join(thread_handle thread) {
  pthread_join(thread, NULL);
}

#endif

size_t carom_in_threads(carom_part_worker *worker, const void *job, size_t n, int threads,
                        size_t least) {
  /* How many are useful is asked first: counting the processors takes some system calls. */
  size_t count = n / least;
  if (count > 1 && threads == CAROM_ALL_THREADS)
    threads = carom_processors();
  const size_t most = threads < 1 ? 1 : threads < MOST_THREADS ? (size_t)threads : MOST_THREADS;
  if (count > most)
    count = most;
  if (count <= 1)
    return worker(job, 0, n);

  all_parts all = {.of = {worker, job, n, count, least < UNIT ? least : UNIT}};
  bool started[MOST_THREADS] = {false};
  for (size_t t = 0; t < count; t++)
    all.part[t].number = t;
  start_threads(all.part, count, started);
  for (size_t t = 0; t < count; t++)
    if (!started[t])
      run_part(&all.part[t]);
  size_t first_bad = n;
  for (size_t t = 0; t < count; t++) {
    if (started[t])
      join(all.part[t].thread);
    if (first_bad == n && all.part[t].number < start_of(&all.of, t + 1))
      first_bad = all.part[t].number;
  }
  return first_bad;
}

#endif
