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

static size_t steer_rows(const void *context, size_t first, size_t end) {
  const carom_search *search = context;
  for (size_t k = first; k < end; k++) {
    const int64_t row = search->stage.done + (int64_t)k;
    if (row > 0 && carom_is_stopped(search))
      return k;
    candidate *c = &search->found[search->stage.first + row];
    outcome *o = &search->outcome[row];
    *o = (outcome){.turn = 1};
    if (!c->turns)
      continue;
    c->turns = false;
    search->path[row].work = 0;
    o->turn = (int8_t)carom_search_turn(search, c, &search->path[row]);
    o->events = (uint16_t)carom_min(search->path[row].work, UINT16_MAX);
  }
  return end;
}

/* Adds the strokes of the scan that miss and whose slopes are the least. */
static void add_seeds(carom_search *search) {
  int64_t seed[PATH_ROWS + 1];
  int seeds = 0;
  for (int64_t k = 0; k < search->count; k++) {
    const carom_miss *m = &search->found[k].miss;
    const bool misses = carom_search_is_in_reach(m) && !carom_search_is_good(m);
    if (search->found[k].kind != CAROM_PLAN_SCAN || !misses)
      continue;
    int index = seeds;
    for (; index > 0 && fabsf(search->found[seed[index - 1]].miss.slope) > fabsf(m->slope); index--)
      seed[index] = seed[index - 1];
    seed[index] = k;
    seeds = (int)carom_min(seeds + 1, PATH_ROWS);
  }
  for (int n = 0; n < seeds; n++) {
    candidate c = search->found[seed[n]];
    c.turns = true;
    carom_search_add(search, c);
  }
}

void carom_search_steer_added(carom_search *search, int64_t first) {
  search->stage =
      (carom_stage){.work = steer_rows, .first = first, .each = 1, .rows = search->count - first};
}

bool carom_search_steer(carom_search *search) {
  if (!carom_search_is_steered(search) || search->steered == 2 || carom_is_stopped(search))
    return false;
  const int64_t first = search->count;
  if (search->steered == 0)
    add_seeds(search);
  else
    carom_search_mirrors(search, PATH_ROWS);
  search->steered++;
  carom_search_steer_added(search, first);
  return true;
}

void carom_search_steered(carom_search *search) {
  const int64_t first = search->stage.first;
  search->count = first;
  for (int64_t k = 0; k < search->stage.done; k++)
    if (search->outcome[k].turn)
      carom_search_add(search, search->found[first + k]);
  carom_search_stage(search, first, search->count - first, 1, 0);
}

void carom_search_take_steered(carom_search *search) {
  const int64_t first = search->stage.first;
  search->count = first;
  for (int64_t k = 0; k < search->stage.done; k++) {
    outcome o = search->outcome[k];
    candidate c = search->found[first + k];
    if (o.ball < 0 || o.foul)
      continue;
    o.worth = carom_search_worth(search, &c, o.worth);
    c.order = (int32_t)search->count;
    search->found[search->count++] = c;
    carom_search_take(search, search->count - 1, &o);
  }
}
