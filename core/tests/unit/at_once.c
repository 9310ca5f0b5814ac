/* Threads of the caller: every function may be called at once with all others, also in children
 * forked meanwhile. */
#define _GNU_SOURCE
#define OWN _Thread_local
#include "functions.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <sys/wait.h>
#include <unistd.h>

/* The sanitizer of threads lets none start in a child of a process with threads; that of
 * addresses may wait there for ever for a lock that another thread held at the fork. */
enum {
  CHILD_THREADS = SANITIZED ? 0 : 3,
  CALLERS = FEWER(16),
  FORKS = FEWER(12),
  INPUTS = SANITIZED ? 2 : 6
};
static uint64_t alone[INPUTS][COUNT];
static atomic_int others[COUNT], calling;
/* Held while children are forked, so that no thread ends meanwhile: the sanitizer of threads finds
 * in a child the threads that had ended and were not joined, and calls them leaks. */
static pthread_mutex_t forking = PTHREAD_MUTEX_INITIALIZER;

/* All that calls write, in which what was there before is cleared; or a hash of it. */
static uint64_t results_of(int64_t returned, bool clear) {
#define EACH(object) \
  { &(object), sizeof(object) }
  const struct {
    void *object;
    size_t size;
  } objects[] = {
      EACH(given),
      EACH(law),
      EACH(kind),
      EACH(bank),
      EACH(calibration),
      EACH(table),
      EACH(balls),
      EACH(cue),
      EACH(measures),
      EACH(marks),
      EACH(states),
      EACH(facts),
      EACH(shot.count),
      EACH(shot.time),
      EACH(second_shot.time),
      EACH(results),
      EACH(results_f32),
      EACH(motion),
      EACH(statuses),
      /* in two pieces: the padding between them may hold anything */
      {&detail, offsetof(carom_detail, stick) + sizeof detail.stick},
      {&detail.stick_normal, sizeof detail - offsetof(carom_detail, stick_normal)},
      EACH(points),
      EACH(cushion_points),
      EACH(contacts),
      EACH(numbers),
      EACH(turned),
      EACH(text),
      EACH(reach),
      EACH(heap->ends),
      EACH(part),
      EACH(table_fault),
      EACH(flags),
      EACH(found),
      EACH(where),
      EACH(record.hash),
      EACH(record.balls),
      EACH(record.table),
      EACH(record.played),
#ifndef CAROM_WITHOUT_PLAN
      EACH(aimed),
      EACH(pot),
      EACH(player),
      EACH(rules.state),
      EACH(rules_state),
      EACH(settled),
      EACH(bounds),
      EACH(rating),
      EACH(ruling.turn),
      EACH(ruling.state),
      EACH(choices),
      EACH(ways[0].chance),
      EACH(ways_result),
      EACH(break_counts),
      EACH(why.speed),
      EACH(why.misses),
      EACH(match.record.hash),
      EACH(match.fault),
      EACH(reader.record.hash),
#endif
  };
#undef EACH
  uint64_t h = hash_of(1, &returned, sizeof returned);
  for (size_t k = 0; k < COUNT_OF(objects); k++)
    if (clear)
      memset(objects[k].object, 0, objects[k].size);
    else
      h = hash_of(h, objects[k].object, objects[k].size);
  if (clear) {
    memset(&record, 0, sizeof record);
    memset(&frames, 0, sizeof frames);
#ifndef CAROM_WITHOUT_PLAN
    memset(&reader, 0, sizeof reader);
#endif
    return 0;
  }
  h = hash_of(h, own_events, (size_t)shot.count * sizeof *own_events);
  for (int k = 0; k < SHOTS && shots[k].brief != NULL; k++) {
    const int64_t events_count = shots[k].count < BRIEF ? shots[k].count : BRIEF;
    h = hash_of(h, heap->brief[k], (size_t)events_count * sizeof heap->brief[k][0]);
  }
  return h;
}

/* What a function gives and writes with some inputs. */
static uint64_t call(int function, int with, int threads_of_call) {
  threads = threads_of_call;
  variant = with + 1;
  results_of(0, true);
  set_up();
  return results_of(functions[function].call(), false);
}

static void *call_all(void *index) {
  const int own = *(const int *)index, with = own % INPUTS;
  random_source r = {test_seed() + (uint64_t)own};
  heap = calloc(1, sizeof *heap);
  own_events = calloc(ROOM, sizeof *own_events);
  own_final = calloc(CAROM_BALLS_MOST, sizeof *own_final);
  for (int n = 0; n < COUNT; n++) {
    const int k = (int)random_between(&r, 0.0, COUNT);
    if (call(k, with, 3) != alone[with][k])
      atomic_fetch_add(&others[k], 1);
  }
  free(own_final);
  free(own_events);
  free(heap);
  atomic_fetch_sub(&calling, 1);
  pthread_mutex_lock(&forking);
  pthread_mutex_unlock(&forking);
  return NULL;
}

/* How many functions have other results in a child that is made while the threads are at work. */
static int in_a_child(void) {
  const pid_t child = fork();
  ck_assert_int_ge(child, 0);
  if (child == 0) {
    int bad = 0;
    for (int k = 0; k < COUNT; k++)
      if (call(k, 0, CHILD_THREADS) != alone[0][k]) {
        bad++;
        fprintf(stderr, "%s has other results in a child\n", functions[k].name);
      }
    _exit(bad);
  }
  int status;
  ck_assert_int_eq(waitpid(child, &status, 0), child);
  ck_assert_msg(WIFEXITED(status), "the child ended by signal %d", WTERMSIG(status));
  return WEXITSTATUS(status);
}

/* Threads call all functions in random order, and get what each call gives alone; so do
 * children forked in between. */
TEST(every_function_at_once) {
  for (int with = 0; with < INPUTS; with++)
    for (int k = 0; k < COUNT; k++)
      alone[with][k] = call(k, with, 0);
  /* a sanitizer, which looks at what few threads share, has the same in every run */
  const int callers = SANITIZED ? CALLERS : draws_within(CALLERS / 2, CALLERS);
  const int forks = SANITIZED ? FORKS : draws_within(FORKS / 2, FORKS);
  pthread_t thread[CALLERS];
  int index[CALLERS];
  atomic_store(&calling, callers);
  pthread_mutex_lock(&forking);
  for (int k = 0; k < callers; k++) {
    index[k] = k;
    ck_assert_int_eq(pthread_create(&thread[k], NULL, call_all, &index[k]), 0);
  }
  int children = 0;
  for (; children < forks && atomic_load(&calling) > 0; children++)
    ck_assert_int_eq(in_a_child(), 0);
  pthread_mutex_unlock(&forking);
  for (int k = 0; k < callers; k++)
    pthread_join(thread[k], NULL);
  for (int k = 0; k < COUNT; k++)
    ck_assert_msg(atomic_load(&others[k]) == 0, "%s had other results %d times", functions[k].name,
                  atomic_load(&others[k]));
  ck_assert_int_gt(children, 0);
  printf("%d threads called %d functions; %d children between\n", callers, COUNT, children);
}
