/* A plan that may be stopped plays rounds: a complete plan of 100 shots, one of 200, of 400 and so
 * on, each with its own errors. So whenever it is stopped it has the best stroke of a complete plan
 * of about half of its shots, which is also a candidate of the next one. */
#include "anytime.h"

#include "platform/arithmetic.h"
#include "search.h"

typedef carom_candidate candidate;

bool carom_search_doubles(const carom_search *search) {
  return !search->options.once && (search->options.stop != NULL || search->options.seconds > 0.0);
}

static void next_plan(carom_search *search) {
  const int64_t n = search->first;
  int64_t shots = n;
  /* what does not suffice for the plan after this one belongs to it */
  if (!carom_search_doubles(search) || search->rest < 3 * n)
    shots = search->rest;
  search->rest -= shots;
  search->first = 2 * n;
  carom_search_begin(search, shots);
}

void carom_search_begin_doubling(carom_search *search, int64_t first, int64_t shots) {
  search->first = first;
  search->rest = shots;
  next_plan(search);
}

bool carom_search_double(carom_search *search) {
  const candidate *c = &search->found[0];
  const bool stopped = carom_is_stopped(search);
  const bool better = !search->joins || !stopped ||
                      (search->count > 0 && c->round > 0 && c->round >= search->best.round &&
                       c->chose.seen >= search->best.chose.seen);
  if (better)
    search->best = *c;

  /* the plan of the next round, whose errors are others, so that luck does not last */
  if (!stopped && search->rest > 0) {
    search->joins = true;
    search->options.seed += UINT64_C(0x9e3779b97f4a7c15);
    search->count = 0;
    next_plan(search);
    return true;
  }

  /* a stopped plan reports the best so far */
  if (!better) {
    search->found[0] = search->best;
    search->count = carom_max(search->count, 1);
  }
  return false;
}
