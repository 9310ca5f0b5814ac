#include "stress_tally.h"

#include "message.h"

#include <math.h>
#include <pthread.h>
#include <unistd.h>

enum { THREADS_MOST = 64 };
static const double LEAST_ERROR = 1e-18, MOST_OF_PLAY = 1e-6, MOST = 1e-5;

void stress_count(stress_tally *t, double error, bool of_play, uint64_t k) {
  const double share = error / (of_play ? MOST_OF_PLAY : MOST);
  t->rows++;
  t->over_1e6 += error > 1e-6;
  t->over_1e5 += error > 1e-5;
  t->over_2e5 += error > 2e-5;
  t->largest = fmax(t->largest, error);
  if (of_play)
    t->largest_of_play = fmax(t->largest_of_play, error);
  if (share > t->worst_share) {
    t->worst_share = share;
    t->worst = k;
  }
  const double place = STRESS_PER_DECADE * log10(fmax(error, LEAST_ERROR) / LEAST_ERROR);
  const int last = STRESS_DECADES * STRESS_PER_DECADE - 1;
  t->histogram[place < last ? (int)place : last]++;
}

double stress_quantile(const stress_tally *t, double share) {
  long below = 0;
  for (int k = 0; k < STRESS_DECADES * STRESS_PER_DECADE; k++)
    if ((double)(below += t->histogram[k]) >= share * (double)t->rows)
      return fmin(LEAST_ERROR * pow(10, (k + 1.0) / STRESS_PER_DECADE), t->largest);
  return t->largest;
}

void stress_add(stress_tally *to, const stress_tally *from) {
  to->rows += from->rows;
  to->over_1e6 += from->over_1e6;
  to->over_1e5 += from->over_1e5;
  to->over_2e5 += from->over_2e5;
  to->unresolved += from->unresolved;
  to->refused += from->refused;
  to->unjudged += from->unjudged;
  to->by_fallback += from->by_fallback;
  to->largest = fmax(to->largest, from->largest);
  to->largest_of_play = fmax(to->largest_of_play, from->largest_of_play);
  if (from->worst_share > to->worst_share) {
    to->worst_share = from->worst_share;
    to->worst = from->worst;
  }
  for (int k = 0; k < STRESS_DECADES * STRESS_PER_DECADE; k++)
    to->histogram[k] += from->histogram[k];
}

void stress_print_head(FILE *out, const char *first, const char *second) {
  fprintf(out,
          "%-9s %-15s %9s   median      99 %%    99.9 %%   99.99 %%  largest  of play   > 1e-6   > 1e-5   > 2e-5  fallback  "
          "unresolved  refused  not judged\n",
          first, second, "rows");
}

void stress_print(FILE *out, const char *first, const char *second, const stress_tally *t) {
  fprintf(out, "%-9s %-15s %9ld  %7.1e   %7.1e   %7.1e   %7.1e  %7.1e  %7.1e  %7ld  %7ld  %7ld  %6.2f %%  %10ld  %7ld  %10ld\n",
          first, second, t->rows, stress_quantile(t, 0.5), stress_quantile(t, 0.99), stress_quantile(t, 0.999),
          stress_quantile(t, 0.9999), t->largest, t->largest_of_play, t->over_1e6, t->over_1e5, t->over_2e5,
          100.0 * (double)t->by_fallback / fmax(1, (double)(t->rows + t->unresolved + t->unjudged)), t->unresolved, t->refused,
          t->unjudged);
}

bool stress_holds(const stress_tally *t) {
  return t->largest_of_play <= MOST_OF_PLAY && t->largest <= MOST;
}

/* ---- Threads ---- */

typedef struct team {
  pthread_mutex_t lock;
  uint64_t next, blocks;
  stress_work *work;
  const char *what;
} team;

typedef struct member {
  team *team;
  void *shift;
} member;

static void *run(void *argument) {
  const member *m = argument;
  team *t = m->team;
  for (;;) {
    pthread_mutex_lock(&t->lock);
    const uint64_t block = t->next++;
    if (block < t->blocks)
      progress_show(t->what, (double)block, (double)t->blocks);
    pthread_mutex_unlock(&t->lock);
    if (block >= t->blocks)
      return NULL;
    t->work(m->shift, block);
  }
}

int stress_threads(int asked) {
  const long wanted = asked > 0 ? asked : sysconf(_SC_NPROCESSORS_ONLN);
  return wanted < 1 ? 1 : wanted < THREADS_MOST ? (int)wanted : THREADS_MOST;
}

void stress_in_threads(int threads, void *shifts, size_t size, uint64_t blocks, stress_work *work, const char *what) {
  team t = {.lock = PTHREAD_MUTEX_INITIALIZER, .blocks = blocks, .work = work, .what = what};
  member members[THREADS_MOST];
  pthread_t id[THREADS_MOST];
  int started = 1;
  for (int k = 0; k < threads; k++)
    members[k] = (member){&t, (char *)shifts + (size_t)k * size};
  while (started < threads && pthread_create(&id[started], NULL, run, &members[started]) == 0)
    started++;
  run(&members[0]);
  for (int k = 1; k < started; k++)
    pthread_join(id[k], NULL);
  progress_clear();
}
