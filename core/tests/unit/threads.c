/* Threads of the library: each row is worked on once, the first error is found wherever it is,
 * and no signal handler of the process runs on a thread that the process has not made. */
#define _GNU_SOURCE
#include "platform/threads.h"
#include "support.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Rows of a made-up job: how often each was worked on, and which are in error. */
typedef struct counting {
  unsigned char *times;
  const bool *bad;
} counting;

static size_t count_rows(const void *job, size_t from, size_t end) {
  const counting *c = job;
  size_t first_bad = end;
  for (size_t k = from; k < end; k++) {
    c->times[k]++;
    if (c->bad[k] && first_bad == end)
      first_bad = k;
  }
  return first_bad;
}

TEST(each_row_once) {
  enum { MOST = 3000 };
  random_source source = {test_seed()};
  for (int trial = 0; trial < 300; trial++) {
    const size_t n = (size_t)random_between(&source, 0.0, MOST);
    const size_t least = (size_t)random_between(&source, 1.0, 200.0);
    const int threads = (int)random_between(&source, -1.0, 12.0);
    const size_t bad_rows = (size_t)random_between(&source, 0.0, 4.0);
    unsigned char *times = calloc(n + 1, 1);
    bool *bad = calloc(n + 1, sizeof *bad);
    size_t first = n;
    for (size_t k = 0; k < bad_rows && n > 0; k++) {
      const size_t row = (size_t)random_between(&source, 0.0, (double)n);
      bad[row] = true;
      first = row < first ? row : first;
    }
    const counting job = {times, bad};
    ck_assert_uint_eq(carom_in_threads(count_rows, &job, n, threads, least), first);
    for (size_t k = 0; k < n; k++)
      ck_assert_uint_eq(times[k], 1);
    free(times);
    free(bad);
  }
}

#if !SANITIZED
static void *idle(void *argument) {
  return argument;
}
#endif

/* Where the system starts no thread, the calling one works on all rows. In a child without room
 * for another stack. */
TEST(threads_that_cannot_be_started) {
#if !SANITIZED
  enum { FEW = 400 };
  static unsigned char times[FEW];
  static bool bad[FEW] = {[FEW - 1] = true};
  const counting job = {times, bad};
  const pid_t child = fork();
  if (child == 0) {
    setrlimit(RLIMIT_AS, &(struct rlimit){0, 0});
    pthread_t unused;
    const bool none = pthread_create(&unused, NULL, idle, NULL) != 0;
    bool good = none && carom_in_threads(count_rows, &job, FEW, 4, 1) == FEW - 1;
    for (int k = 0; k < FEW; k++)
      good &= times[k] == 1;
    _exit(good ? 0 : 1);
  }
  int status;
  ck_assert_int_eq(waitpid(child, &status, 0), child);
  ck_assert(WIFEXITED(status) && WEXITSTATUS(status) == 0);
#endif
}

/* The most rows of a part so far. */
static size_t note_size(const void *job, size_t from, size_t end) {
  atomic_size_t *most = *(atomic_size_t *const *)job;
  size_t before = atomic_load(most);
  while (end - from > before && !atomic_compare_exchange_weak(most, &before, end - from))
    continue;
  return end;
}

/* A few dozen rows that are worth a thread, such as shots, are shared too. */
TEST(few_rows_are_shared) {
  atomic_size_t most, *const job = &most;
  for (size_t n = 8; n <= 64; n++)
    for (int threads = 2; threads <= 4; threads++) {
      atomic_store(&most, 0);
      ck_assert_uint_eq(carom_in_threads(note_size, &job, n, threads, 4), n);
      const size_t parts = n / 4 < (size_t)threads ? n / 4 : (size_t)threads;
      ck_assert_msg(atomic_load(&most) <= n / parts + 4, "%zu of %zu rows on one of %zu threads",
                    atomic_load(&most), n, parts);
    }
}

static pthread_t caller;
static atomic_int handled, elsewhere;
static atomic_bool done;

static void handler(int signal_number) {
  (void)signal_number;
  atomic_fetch_add(&handled, 1);
  if (!pthread_equal(pthread_self(), caller))
    atomic_fetch_add(&elsewhere, 1);
}

static void *call_batches(void *argument) {
  enum { ROWS = 20000 };
  random_source source = {test_seed()};
  carom_impact *in = malloc(ROWS * sizeof *in);
  carom_result *out = malloc(ROWS * sizeof *out);
  const carom_options options = {.solver = CAROM_SOLVER_EULER, .steps = 200, .threads = 4};
  sigset_t own;
  (void)argument;
  for (int k = 0; k < ROWS; k++)
    in[k] = random_impact(&source);
  sigemptyset(&own);
  sigaddset(&own, SIGUSR1);
  pthread_sigmask(SIG_UNBLOCK, &own, NULL);
  for (int k = 0; k < FEWER(8); k++)
    carom_collide_batch(in, ROWS, &options, out, NULL);
  /* The mask of the calling thread is as it was. */
  sigset_t now;
  pthread_sigmask(SIG_SETMASK, NULL, &now);
  ck_assert_int_eq(sigismember(&now, SIGUSR1), 0);
  pthread_sigmask(SIG_BLOCK, &own, NULL);
  atomic_store(&done, true);
  free(in);
  free(out);
  return NULL;
}

/* The signals go to the process; the only thread of ours that takes them is the one that calls
 * the library. */
TEST(signals_stay_with_the_caller) {
  const struct sigaction action = {.sa_handler = handler, .sa_flags = SA_RESTART};
  sigset_t own;
  sigaction(SIGUSR1, &action, NULL);
  sigemptyset(&own);
  sigaddset(&own, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &own, NULL);
  ck_assert_int_eq(pthread_create(&caller, NULL, call_batches, NULL), 0);
  while (!atomic_load(&done)) {
    kill(getpid(), SIGUSR1);
    usleep(200);
  }
  pthread_join(caller, NULL);
  ck_assert_int_gt(atomic_load(&handled), 10);
  ck_assert_int_eq(atomic_load(&elsewhere), 0);
}
