/* Threads: rows cut into equal parts, several for each thread, which takes the next one when it
 * is done with one. Rows that cost more than others, and a core that other programs use as well,
 * keep no thread waiting for long.
 *
 * Which thread works on a row makes no difference to it, so results are the same for any number
 * of threads. Threads are started for the call and joined before it returns; the calling thread
 * works, too, and does everything if none can be started, which is so where the system has none.
 * They block every signal, so that no handler of the process runs on them. A job too small to be
 * worth a thread is not cut. With CAROM_WITHOUT_THREADS nothing is cut, and no library of
 * threads is needed.
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

#include <stdatomic.h>
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
  PARTS_EACH = 8, /* for a thread, where there are rows enough */
  UNIT = 64,      /* parts are multiples of this, so that only the last has lanes to spare; or of
                     the least worth a thread */
};

typedef struct cut {
  carom_part_worker *worker;
  const void *job;
  size_t n, count, unit; /* rows; parts; rows of which a part is a multiple */
  atomic_size_t next;    /* the first part that nobody took */
  atomic_size_t bad;     /* the first row in error so far, or n */
} cut;

/* Where a part begins; that of one beyond the last is n. */
static size_t start_of(const cut *of, size_t number) {
  const size_t units = (of->n + of->unit - 1) / of->unit,
               start = units * number / of->count * of->unit;
  return start < of->n ? start : of->n;
}

/* Takes parts until none is left. */
static void work(cut *of) {
  size_t number;
  while ((number = atomic_fetch_add(&of->next, 1)) < of->count) {
    const size_t end = start_of(of, number + 1),
                 first = of->worker(of->job, start_of(of, number), end);
    size_t least = atomic_load(&of->bad);
    while (first < end && first < least && !atomic_compare_exchange_weak(&of->bad, &least, first))
      continue;
  }
}

#ifdef _WIN32

static unsigned __stdcall work_on_thread(void *argument) {
  work(argument);
  return 0;
}

/* Starts threads; returns how many there are. */
static size_t start_threads(cut *of, thread_handle *thread, size_t most) {
  size_t count = 0;
  while (count < most &&
         (thread[count] = (HANDLE)_beginthreadex(NULL, 0, work_on_thread, of, 0, NULL)) != NULL)
    count++;
  return count;
}

static void join(thread_handle thread) {
  WaitForSingleObject(thread, INFINITE);
  CloseHandle(thread);
}

#else

static void *work_on_thread(void *argument) {
  work(argument);
  return NULL;
}

/* Starts threads; returns how many there are. A thread inherits the signals that are blocked
 * where it is made. */
static size_t start_threads(cut *of, thread_handle *thread, size_t most) {
  sigset_t all, before;
  sigfillset(&all);
  const bool blocked = pthread_sigmask(SIG_SETMASK, &all, &before) == 0;
  size_t count = 0;
  while (count < most && pthread_create(&thread[count], NULL, work_on_thread, of) == 0)
    count++;
  if (blocked)
    pthread_sigmask(SIG_SETMASK, &before, NULL);
  return count;
}

static void join(thread_handle thread) {
  pthread_join(thread, NULL);
}

#endif

size_t carom_in_threads(carom_part_worker *worker, const void *job, size_t n, int threads,
                        size_t least) {
  /* How many are useful is asked first: counting the processors takes some system calls. */
  const size_t parts = n / least;
  if (parts > 1 && threads == CAROM_ALL_THREADS)
    threads = carom_processors();
  size_t most = threads < 1 ? 1 : threads < MOST_THREADS ? (size_t)threads : MOST_THREADS;
  most = most < parts ? most : parts;
  if (most <= 1)
    return worker(job, 0, n);

  cut of = {.worker = worker,
            .job = job,
            .n = n,
            .count = parts < PARTS_EACH * most ? parts : PARTS_EACH * most,
            .unit = least < UNIT ? least : UNIT};
  atomic_init(&of.next, 0);
  atomic_init(&of.bad, n);
  thread_handle thread[MOST_THREADS];
  const size_t started = start_threads(&of, thread, most - 1);
  work(&of);
  for (size_t t = 0; t < started; t++)
    join(thread[t]);
  return atomic_load(&of.bad);
}

#endif
