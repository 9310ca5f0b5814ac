/* Strokes that are steered before they are played: the strokes of the scan that miss and whose
 * slopes are the least, and the ways of mirrors.c. */
#include "steer.h"

#include "candidates.h"
#include "mirrors.h"
#include "miss.h"
#include "ranking.h"
#include "rows.h"

#include <math.h>

typedef carom_candidate candidate;
typedef carom_outcome outcome;
typedef carom_search search;

static size_t steer_rows(const void *context, size_t first, size_t end) {
  const search *plan = context;
  for (size_t k = first; k < end; k++) {
    const int64_t row = plan->stage.done + (int64_t)k;
    if (row > 0 && carom_is_stopped(plan))
      return k;
    candidate *c = &plan->found[plan->stage.first + row];
    outcome *o = &plan->outcome[row];
    *o = (outcome){.turn = 1};
    if (!c->turns)
      continue;
    c->turns = false;
    plan->path[row].work = 0;
    o->turn = (int8_t)carom_search_turn(plan, c, &plan->path[row]);
    o->events = (uint16_t)carom_min(plan->path[row].work, UINT16_MAX);
  }
  return end;
}

/* Adds the strokes of the scan that miss and whose slopes are the least. */
static void add_seeds(search *plan) {
  int64_t seed[PATH_ROWS + 1];
  int seeds = 0;
  for (int64_t k = 0; k < plan->count; k++) {
    const carom_miss *m = &plan->found[k].miss;
    const bool misses = carom_search_is_in_reach(m) && !carom_search_is_good(m);
    if (plan->found[k].kind != CAROM_PLAN_SCAN || !misses)
      continue;
    int index = seeds;
    for (; index > 0 && fabsf(plan->found[seed[index - 1]].miss.slope) > fabsf(m->slope); index--)
      seed[index] = seed[index - 1];
    seed[index] = k;
    seeds = (int)carom_min(seeds + 1, PATH_ROWS);
  }
  for (int n = 0; n < seeds; n++) {
    candidate c = plan->found[seed[n]];
    c.turns = true;
    carom_search_add(plan, c);
  }
}

void carom_search_steer_added(search *plan, int64_t first) {
  plan->stage =
      (carom_stage){.work = steer_rows, .first = first, .each = 1, .rows = plan->count - first};
}

bool carom_search_steer(search *plan) {
  if (!carom_search_is_steered(plan) || plan->steered == 2 || carom_is_stopped(plan))
    return false;
  const int64_t first = plan->count;
  if (plan->steered == 0)
    add_seeds(plan);
  else
    carom_search_mirrors(plan, PATH_ROWS);
  plan->steered++;
  carom_search_steer_added(plan, first);
  return true;
}

void carom_search_steered(search *plan) {
  const int64_t first = plan->stage.first;
  plan->count = first;
  for (int64_t k = 0; k < plan->stage.done; k++)
    if (plan->outcome[k].turn)
      carom_search_add(plan, plan->found[first + k]);
  carom_search_stage(plan, first, plan->count - first, 1, 0);
}

void carom_search_take_steered(search *plan) {
  const int64_t first = plan->stage.first;
  plan->count = first;
  for (int64_t k = 0; k < plan->stage.done; k++) {
    outcome o = plan->outcome[k];
    candidate c = plan->found[first + k];
    if (o.ball < 0 || o.foul)
      continue;
    o.worth = carom_search_worth(plan, &c, o.worth);
    c.order = (int32_t)plan->count;
    plan->found[plan->count++] = c;
    carom_search_take(plan, plan->count - 1, &o);
  }
}
