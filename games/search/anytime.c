/* A plan that may be stopped plays rounds: a whole plan of 100 shots, one of 200, of 400 and so on,
 * each with errors of its own. So whenever it is stopped it has the best stroke of a whole plan of
 * about half of its shots, which also joins the candidates of the next one. */
#include "anytime.h"

#include "platform/arithmetic.h"
#include "search.h"

typedef carom_candidate candidate;
typedef carom_search search;

bool carom_search_doubles(const search *plan) {
  return !plan->options.once && (plan->options.stop != NULL || plan->options.seconds > 0.0);
}

static void next_plan(search *plan) {
  const int64_t n = plan->first;
  int64_t shots = n;
  /* what does not suffice for the plan after this one belongs to it */
  if (!carom_search_doubles(plan) || plan->rest < 3 * n)
    shots = plan->rest;
  plan->rest -= shots;
  plan->first = 2 * n;
  carom_search_begin(plan, shots);
}

void carom_search_begin_doubling(search *plan, int64_t first, int64_t shots) {
  plan->first = first;
  plan->rest = shots;
  next_plan(plan);
}

bool carom_search_double(search *plan) {
  const candidate *c = &plan->found[0];
  const bool stopped = carom_is_stopped(plan);
  const bool better = !plan->joins || !stopped ||
                      (plan->count > 0 && c->round > 0 && c->round >= plan->best.round &&
                       c->chose.seen >= plan->best.chose.seen);
  if (better)
    plan->best = *c;

  /* the plan of the next round, whose errors are others, so that luck does not last */
  if (!stopped && plan->rest > 0) {
    plan->joins = true;
    plan->options.seed += UINT64_C(0x9e3779b97f4a7c15);
    plan->count = 0;
    next_plan(plan);
    return true;
  }

  /* one that was stopped tells the best so far */
  if (!better) {
    plan->found[0] = plan->best;
    plan->count = carom_max(plan->count, 1);
  }
  return false;
}
