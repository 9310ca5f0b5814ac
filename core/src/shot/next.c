/* The next event: the earliest of the times that detect.c keeps, by a plain scan. Of events that
 * the rules of the world count as simultaneous, those rules choose the one that goes first. */
#include "platform/promise.h"
#include "shot/rules.h"

#include <math.h>

enum { MOST_DUE = 128 };

static int type_of_end(const carom_sim *sim, int ball) {
  const carom_path *path = &sim->path[ball];
  if (path->goes_on)
    return CAROM_DUE_PIECE;
  if (path->from.label == CAROM_BALL_SLIDING)
    return CAROM_EVENT_SLIDING_ROLLING;
  if (path->from.label == CAROM_BALL_SPINNING)
    return CAROM_EVENT_SPINNING_STATIONARY;
  if (carom_flies(&path->from))
    return CAROM_EVENT_SLATE;
  carom_ball_state end;
  carom_path_end(path, &sim->rates[ball], &end);
  return end.label == CAROM_BALL_SPINNING ? CAROM_EVENT_ROLLING_SPINNING
                                          : CAROM_EVENT_ROLLING_STATIONARY;
}

static carom_due end_of(const carom_sim *sim, int ball) {
  return (carom_due){sim->path[ball].end, type_of_end(sim, ball), ball, -1};
}
static carom_due meeting_of(const carom_sim *sim, int ball) {
  return (carom_due){sim->meeting[ball].time, sim->meeting[ball].type, ball,
                     sim->meeting[ball].part};
}
static carom_due pair_of(const carom_sim *sim, int ball, int partner) {
  return (carom_due){sim->pair[ball][partner], CAROM_EVENT_BALL_BALL, ball, partner};
}

/* All that is due up to a time. */
static int list_due(const carom_sim *sim, double limit, carom_due pending_events[MOST_DUE]) {
  int count = 0;
  for (int ball = 0; ball < sim->count && count < MOST_DUE - CAROM_BALLS_MOST - 2; ball++) {
    /* neither the ball itself nor a pair with one behind it is due */
    if (sim->own_end[ball] > limit && sim->first[ball] > limit)
      continue;

    /* the end of its phase, its meeting with the table, its pairs with those behind it */
    if (sim->path[ball].end <= limit)
      pending_events[count++] = end_of(sim, ball);
    if (sim->meeting[ball].time <= limit)
      pending_events[count++] = meeting_of(sim, ball);
    for (int partner = ball + 1; sim->first[ball] <= limit && partner < sim->count; partner++)
      if (sim->pair[ball][partner] <= limit)
        pending_events[count++] = pair_of(sim, ball, partner);
  }
  CAROM_PROMISE(count >= 1 && count <= MOST_DUE);
  return count;
}

carom_due carom_next(const carom_sim *sim) {
  /* the earliest time that anything is due */
  double first = INFINITY;
  for (int ball = 0; ball < sim->count; ball++) {
    const double soonest = carom_lesser(sim->own_end[ball], sim->first[ball]);
    first = carom_lesser(soonest, first);
  }

  if (!(first < INFINITY))
    return (carom_due){INFINITY, CAROM_DUE_REST, -1, -1};

  /* all that the world takes for simultaneous with it; its rules choose */
  carom_due pending_events[MOST_DUE];
  const int count = list_due(sim, first + sim->rules->simultaneous, pending_events);
  if (count == 1)
    return pending_events[0];
  return sim->rules->choose(sim, pending_events, count);
}
