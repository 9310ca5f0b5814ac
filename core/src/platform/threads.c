/* Threads: rows cut into equal parts, several for each thread, which takes the next one when it
 * is done with one. Rows that cost more than others, and a core that other programs use as well,
 * keep no thread waiting for long.
 *
 * Which thread works on a row makes no difference to it, so results are the same for any number of
 * threads. The threads of a crew are started for a call of the library and joined before it
 * returns; between two jobs they wait without sleep for some ms, since to wake one takes as long as
 * ten shots. The calling thread works, too, and does everything if no other can be started, as on
 * systems without threads. They block every signal, so that no handler of the process runs on them.
 * A job too small to be worth a thread is not cut. With CAROM_WITHOUT_THREADS nothing is cut, and
 * no library of threads is needed. */
#if !defined(_WIN32) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200809L /* pthread_sigmask */
#endif
#include "platform/threads.h"

#ifdef CAROM_WITHOUT_THREADS

void carom_with_crew(carom_crew_caller *call, void *context, int threads, size_t parts) {
  (void)threads, (void)parts;
  call(context, NULL);
}

size_t carom_crew_work(carom_crew *crew, carom_part_worker *worker, const void *job, size_t n,
                       size_t least) {
  (void)crew, (void)least;
  return worker(job, 0, n);
}

#else

#include "carom.h"
#include "platform/processors.h"
#include "platform/promise.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#ifdef _WIN32
#include "platform/win32.h"
#define yield SwitchToThread
#define doze() Sleep(1)
typedef void *thread_handle;
#else
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <time.h>
#define yield sched_yield
#define doze() nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL)
typedef pthread_t thread_handle;
#endif

enum {
  MOST_THREADS = 256,
  PARTS_EACH = 32, /* for a thread, where there are rows enough */
  UNIT = 64,       /* parts are multiples of this, so that only the last has lanes to spare; or of
                     the least worth a thread */
};

struct carom_crew {
  size_t threads;               /* next to the calling one */
  atomic_size_t begun, working; /* jobs so far; threads that are not done with the last one */
  atomic_bool over;             /* there are no more */
  /* the last one */
  carom_part_worker *worker;
  const void *job;
  size_t n, count, unit;     /* rows; parts; rows of which a part is a multiple */
  atomic_size_t next;        /* the first part that nobody took */
  atomic_size_t first_error; /* the first row in error so far, or n */
};

/* Where a part begins; beyond the last part, n. */
static size_t start_of(const carom_crew *crew, size_t number) {
  const size_t units = (crew->n + crew->unit - 1) / crew->unit,
               start = units * number / crew->count * crew->unit;
  CAROM_PROMISE(crew->count > 0 && crew->unit > 0 && (number < crew->count || start >= crew->n));
  if (start > crew->n)
    return crew->n;
  return start;
}

/* Takes parts until none is left. */
static void work(carom_crew *crew) {
  size_t number;
  while ((number = atomic_fetch_add(&crew->next, 1)) < crew->count) {
    const size_t end = start_of(crew, number + 1),
                 first = crew->worker(crew->job, start_of(crew, number), end);
    CAROM_PROMISE(first <= end);
    size_t least = atomic_load(&crew->first_error);
    while (first < end && first < least &&
           !atomic_compare_exchange_weak(&crew->first_error, &least, first))
      continue;
  }
}

/* One more look at what another thread is to change: at first at once, then after others had the
 * processor, and in the end a thousand times a second, so that long waits cost little. */
static void wait_a_little(int *looks) {
  enum { AT_ONCE = 2000, BY_TURNS = 20000 };
  if (*looks >= BY_TURNS)
    doze();
  else if (++*looks > AT_ONCE)
    yield();
}

/* A thread of the crew: job after job. */
static void serve(carom_crew *crew) {
  for (size_t seen = 0;; seen++) {
    for (int looks = 0; atomic_load(&crew->begun) == seen; wait_a_little(&looks))
      if (atomic_load(&crew->over))
        return;
    work(crew);
    atomic_fetch_sub(&crew->working, 1);
  }
}

#ifdef _WIN32

static unsigned __stdcall work_on_thread(void *argument) {
  serve(argument);
  return 0;
}

/* Starts threads; returns how many there are. */
static size_t start_threads(carom_crew *crew, thread_handle *thread, size_t most) {
  size_t count = 0;
  while (count < most &&
         (thread[count] = (void *)_beginthreadex(NULL, 0, work_on_thread, crew, 0, NULL)) != NULL)
    count++;
  return count;
}

static void join(thread_handle thread) {
  WaitForSingleObject(thread, 0xffffffff); /* however long it takes */
  CloseHandle(thread);
}

#else

static void *work_on_thread(void *argument) {
  serve(argument);
  return NULL;
}

/* Starts threads; returns how many there are. A thread inherits the signals that are blocked
 * where it is made. */
static size_t start_threads(carom_crew *crew, thread_handle *thread, size_t most) {
  sigset_t every_signal, previous_mask;
  sigfillset(&every_signal);
  const bool blocked = pthread_sigmask(SIG_SETMASK, &every_signal, &previous_mask) == 0;
  size_t count = 0;
  while (count < most && pthread_create(&thread[count], NULL, work_on_thread, crew) == 0)
    count++;
  if (blocked)
    pthread_sigmask(SIG_SETMASK, &previous_mask, NULL);
  return count;
}

static void join(thread_handle thread) {
  pthread_join(thread, NULL);
}

#endif

void carom_with_crew(carom_crew_caller *call, void *context, int threads, size_t parts) {
  /* The number of useful threads is computed first, because counting the processors takes some
   * system calls. */
  if (parts > 1 && threads == CAROM_ALL_THREADS)
    threads = carom_processors();
  size_t most = 1;
  if (threads > 1)
    most = (size_t)threads;
  if (most > MOST_THREADS)
    most = MOST_THREADS;
  if (most > parts)
    most = parts;
  carom_crew crew = {.threads = 0};
  atomic_init(&crew.begun, 0);
  atomic_init(&crew.over, false);
  thread_handle thread[MOST_THREADS];
  size_t started = 0;
  if (most > 1)
    started = start_threads(&crew, thread, most - 1);
  crew.threads = started;
  call(context, &crew);
  atomic_store(&crew.over, true);
  for (size_t t = 0; t < started; t++)
    join(thread[t]);
}

size_t carom_crew_work(carom_crew *crew, carom_part_worker *worker, const void *job, size_t n,
                       size_t least) {
  const size_t parts = n / least, most = PARTS_EACH * (crew->threads + 1);
  if (crew->threads == 0 || parts <= 1)
    return worker(job, 0, n);
  crew->worker = worker;
  crew->job = job;
  crew->n = n;
  crew->count = parts < most ? parts : most;
  crew->unit = least < UNIT ? least : UNIT;
  atomic_store(&crew->next, 0);
  atomic_store(&crew->first_error, n);
  atomic_store(&crew->working, crew->threads);
  atomic_fetch_add(&crew->begun, 1);
  work(crew);
  for (int looks = 0; atomic_load(&crew->working) > 0; wait_a_little(&looks))
    continue;
  return atomic_load(&crew->first_error);
}

#endif

/* A crew for one job. */
typedef struct only_job {
  carom_part_worker *worker;
  const void *job;
  size_t n, least, first_error;
} only_job;

static void do_only_job(void *context, carom_crew *crew) {
  only_job *only = context;
  only->first_error = carom_crew_work(crew, only->worker, only->job, only->n, only->least);
}

size_t carom_in_threads(carom_part_worker *worker, const void *job, size_t n, int threads,
                        size_t least) {
  only_job only = {worker, job, n, least, n};
  carom_with_crew(do_only_job, &only, threads, n / least);
  return only.first_error;
}
