/* What candidates are worth, and which is better. */
#include "ranking.h"

#include "goals.h"
#include "platform/promise.h"

typedef carom_candidate candidate;
typedef carom_outcome outcome;

/* for each m/s, so that among equally good strokes the softer one is chosen: of 120 layouts of
 * eight-ball and nine-ball, plans of 1,000 shots had 36 % of strokes above 3 m/s without it, 27 %
 * with 0.002, and were worth 0.755 and 0.757. On nine feet, values of nine-ball are so flat that
 * 0.002, and 0.03 for a foul, lost 319 of 600 games against the steeper values of before, where
 * 0.001 and 0.018 lost 281 */
static const double softer = 0.001;

/* With a goal: for a foul, and for coming near a position, where strokes reach the goal as
 * often. */
static const double legal = 0.01, nearer = 0.1;

static double merit_of(const carom_search *search, const candidate *c) {
  const double seen = (double)c->chose.seen;
  double mean = c->chose.sum / seen;
  if (carom_has_goal(&search->job))
    mean += (nearer * c->chose.near - legal * c->chose.foul) / seen;
  if (search->only_safeties) /* a pot that mostly misses is no safety */
    mean -= c->chose.keep / seen;
  if (c->kind == CAROM_PLAN_BREAK)
    return mean;
  return mean - softer * c->speed;
}

static bool is_better(const carom_search *search, const candidate *a, const candidate *b) {
  if (a->round != b->round)
    return a->round > b->round;
  const double of_a = merit_of(search, a), of_b = merit_of(search, b);
  return of_a > of_b || (of_a == of_b && a->order < b->order);
}

/* Puts candidate k first if it is better than the first. */
void carom_search_lead(carom_search *search, int64_t k) {
  if (is_better(search, &search->found[k], &search->found[0])) {
    const candidate first = search->found[0];
    search->found[0] = search->found[k];
    search->found[k] = first;
  }
}

static void name(candidate *c, const outcome *o) {
  c->ball = o->ball;
  c->pocket = o->pocket;
  c->cushions = o->cushions;
}

/* Where nothing is called, the named pot is the most frequent one, by the vote of R. S. Boyer and J
 * S. Moore: with more than half of the pots, it is sure to be named. */
static void vote(candidate *c, const outcome *o) {
  if (o->ball < 0)
    return;
  if (c->votes == 0)
    name(c, o);
  if (o->ball == c->ball && o->pocket == c->pocket)
    c->votes++;
  else
    c->votes--;
}

void carom_search_take(carom_search *search, int64_t k, const outcome *o) {
  CAROM_PROMISE(k >= 0 && k < search->count);
  candidate *c = &search->found[k];
  c->chose = (carom_tally){.sum = o->worth, .near = (double)o->near, .seen = 1, .foul = o->foul};
  name(c, o);
  c->votes = c->pots = o->ball >= 0;
  c->own_ball = c->ball;
  c->own_pocket = c->pocket;
  c->own_cushions = c->cushions;
  carom_search_lead(search, k);
}

/* The gap that follows a gap of Shell's method; the last one is 1. */
static int64_t next_gap(int64_t gap) {
  if (gap == 2)
    return 1;
  return gap * 5 / 11;
}

/* Sorts the first n candidates, by Shell's method, without memory. The order is total, so that it
 * does not matter how it is found. To sort half a million takes longer than a plan has to stop; a
 * sort that is stopped leaves the first in its position if that is the best. */
void carom_search_sort(const carom_search *search, int64_t n) {
  candidate *c = search->found;
  for (int64_t gap = n / 2; gap > 0; gap = next_gap(gap))
    for (int64_t k = gap; k < n && !carom_is_stopped(search); k++) {
      const candidate moved = c[k];
      int64_t index = k;
      for (; index >= gap && is_better(search, &moved, &c[index - gap]); index -= gap)
        c[index] = c[index - gap];
      c[index] = moved;
    }
}

static void add(carom_tally *t, const outcome *o) {
  t->sum += o->worth;
  t->near += (double)o->near;
  t->squares += o->worth * o->worth;
  t->keep += o->turn == CAROM_TURN_KEEP;
  t->lose += o->turn == CAROM_TURN_LOSE;
  t->foul += o->foul;
  t->seen++;
}

/* How many candidates of the stage have been played `each` times. */
static int64_t played(const carom_search *search, int64_t *each) {
  const carom_stage *s = &search->stage;
  const int64_t n = s->rows / s->each;
  *each = s->each;
  if (n == 1)
    *each = s->done;
  CAROM_PROMISE(n >= 1 && s->first + n <= search->count && *each >= 1 && s->rows <= search->room);
  return s->done / *each;
}

void carom_search_add_up(carom_search *search) {
  int64_t each;
  const int64_t n = search->stage.rows / search->stage.each, done = played(search, &each);
  for (int64_t k = 0; k < done; k++) {
    candidate *c = &search->found[k];
    if (c->round == 0) /* the shot without errors is forgotten */
      c->chose = (carom_tally){0};
    for (int64_t j = 0; j < each; j++) {
      const outcome *o = &search->outcome[k * each + j];
      if (!search->job.rules->calls && c->kind != CAROM_PLAN_PUSH)
        vote(c, o);
      add(&c->chose, o);
    }
    c->round++;
  }
  for (int64_t k = 1; k < n; k++)
    carom_search_lead(search, k);
}

void carom_search_replayed(carom_search *search) {
  int64_t each;
  const int64_t done = played(search, &each);
  for (int64_t k = 0; k < done; k++)
    for (int64_t j = 0; j < each; j++)
      add(&search->found[search->stage.first + k].fresh, &search->outcome[k * each + j]);
}
