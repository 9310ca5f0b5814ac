/* What the rules of games need to know about a shot (carom_facts), noted event by event. */
#include "shot/facts.h"
#include "table/marks.h"

#include <math.h>
#include <string.h>

void carom_facts_begin(carom_facts *facts) {
  memset(facts, 0, sizeof *facts);
  facts->second_time = INFINITY;
  for (int axis = 0; axis < 2; axis++) {
    facts->first[axis] = -1;
    facts->first_time[axis] = INFINITY;
  }
  for (int ball = 0; ball < CAROM_BALLS_MOST; ball++) {
    facts->pocket[ball] = -1;
    facts->pocket_time[ball] = INFINITY;
    facts->order[ball] = -1;
  }
}

static uint32_t set_of(int ball) {
  return UINT32_C(1) << ball;
}

/* Where a ball is now. */
static carom_ball_state state_now(const carom_sim *sim, int ball) {
  carom_ball_state current;
  carom_path_at(&sim->path[ball], &sim->rates[ball], sim->time, &current);
  return current;
}

/* Widens the range of positions of the cue ball before it met a ball. `begins`: this is the first
 * position. */
static void widen_range(carom_facts *facts, const carom_sim *sim, bool begins) {
  const carom_ball_state current = state_now(sim, sim->struck);
  for (int axis = 0; axis < 2; axis++) {
    const double coordinate = current.r[axis];
    if (begins)
      facts->first_low[axis] = facts->first_high[axis] = coordinate;
    facts->first_low[axis] = fmin(facts->first_low[axis], coordinate);
    facts->first_high[axis] = fmax(facts->first_high[axis], coordinate);
  }
}

/* The cue ball has an event before it has met a ball. Notes the balls, all at rest, that it has
 * flown over since its last event, along a straight line. */
static void fly_over(carom_facts *facts, const carom_sim *sim) {
  const carom_ball_state *start = &sim->path[sim->struck].from,
                         current = state_now(sim, sim->struck);
  if (start->label != CAROM_BALL_AIRBORNE)
    return;
  const double x = current.r[0] - start->r[0], y = current.r[1] - start->r[1],
               square = x * x + y * y;
  for (int index = 0; index < sim->count; index++) {
    const carom_ball_state *over = &sim->path[index].from;
    if (index == sim->struck || carom_is_out(over->label))
      continue;
    const double to_x = over->r[0] - start->r[0], to_y = over->r[1] - start->r[1];
    const double along = x * to_x + y * to_y, across = x * to_y - y * to_x;
    const double reach = sim->rates[index].radius + sim->rates[sim->struck].radius;
    if (along > 0.0 && along < square && across * across < reach * reach * square)
      facts->jumped |= set_of(index);
  }
}

/* How the cue ball reaches its first ball. */
static int32_t approach_of(const carom_sim *sim, int ball) {
  const uint32_t rails = sim->shot->facts->rails[sim->struck];
  if (rails == 0)
    return CAROM_APPROACH_DIRECT;
  int rail = 0;
  while ((rails >> rail & 1) == 0)
    rail++;
  const double *line = sim->features->line[rail], *centre = sim->path[ball].from.r;
  const double gap = line[0] * centre[0] + line[1] * centre[1] + line[2] - sim->rates[ball].radius;
  if (rails == UINT32_C(1) << rail && gap < 2.0 * sim->rates[sim->struck].radius)
    return CAROM_APPROACH_RAIL_FIRST;
  return CAROM_APPROACH_KICK;
}

/* The cue ball meets a ball. Only the first meeting with each ball counts. */
static void meet(carom_facts *facts, const carom_sim *sim, int ball) {
  int count = 0;
  while (count < CAROM_BALLS_MOST && facts->order[count] >= 0) {
    if (facts->order[count] == ball)
      return;
    count++;
  }
  if (count == CAROM_BALLS_MOST)
    return;
  facts->order[count] = ball;

  /* the first ball, and the balls of the same instant */
  if (count == 0) {
    const carom_ball_state current = state_now(sim, sim->struck);
    memcpy(facts->first_place, current.r, sizeof facts->first_place);
    facts->approach = (int32_t)approach_of(sim, ball);
  }
  if (count == 0 || sim->time - facts->first_time[0] <= CAROM_RULES_INSTANT)
    facts->first_set |= set_of(ball);

  /* the first two */
  if (count < 2) {
    facts->first[count] = ball;
    facts->first_time[count] = sim->time;
    facts->cushions_before[count] = facts->cushions[sim->struck];
  }
}

/* Whether a ball that meets a cushion is frozen to it: the ball is where it lay at first. */
static bool is_frozen(const carom_sim *sim, int ball) {
  const double *first = sim->layout->state[ball]->r;
  const carom_ball_state current = state_now(sim, ball);
  return fabs(current.r[0] - first[0]) + fabs(current.r[1] - first[1]) < CAROM_RULES_TOUCH;
}

/* A ball meets a rail or a jaw. */
static void meet_cushion(carom_facts *facts, const carom_sim *sim, const carom_due *pending_event) {
  const int ball = pending_event->a, part = pending_event->b;
  facts->cushions[ball]++;
  if (is_frozen(sim, ball))
    return;
  if (facts->first[0] >= 0)
    facts->cushions_after++;
  if (pending_event->type == CAROM_EVENT_RAIL && !carom_is_cut(sim->table, part))
    facts->rails[ball] |= set_of(part);
}

/* Whether a ball that falls into a pocket has met a rail that does not end next to it. */
static bool is_banked(const carom_sim *sim, int ball, int pocket) {
  const uint32_t rails = sim->shot->facts->rails[ball];
  for (int rail = 0; rails >> rail != 0; rail++)
    if ((rails >> rail & 1) && !carom_is_beside(sim->table, rail, pocket))
      return true;
  return false;
}

/* A ball has an event: where it has been. Its last event was at the start of its path; where it
 * stops, it has no other one. */
static void been_at(carom_facts *facts, const carom_sim *sim, int ball, bool rests) {
  double y = sim->path[ball].from.r[1];
  if (rests)
    y = state_now(sim, ball).r[1];
  const double radius = sim->rates[ball].radius;
  const carom_marks marks = carom_marks_of(sim->table->width, sim->table->length);
  if (y + radius < marks.centre_spot[1])
    facts->past_middle |= set_of(ball);
  if (y - radius > marks.centre_spot[1])
    facts->beyond_middle |= set_of(ball);
  if (y - radius <= marks.head_spot[1])
    facts->at_head |= set_of(ball);
}

void carom_facts_event(const carom_sim *sim, const carom_due *pending_event) {
  carom_facts *facts = sim->shot->facts;
  const int a = pending_event->a, b = pending_event->b, cue = sim->struck;
  const bool balls = pending_event->type == CAROM_EVENT_BALL_BALL;
  const bool of_cue = a == cue || (balls && b == cue);
  been_at(facts, sim, a, pending_event->type == CAROM_EVENT_ROLLING_STATIONARY);
  if (balls)
    been_at(facts, sim, b, false);
  if (of_cue && facts->first[0] < 0) {
    widen_range(facts, sim, pending_event->type == CAROM_EVENT_STRIKE && facts->touches == 0);
    fly_over(facts, sim);
  }
  switch (pending_event->type) {
  case CAROM_EVENT_STRIKE:
    facts->moved |= set_of(a);
    facts->touches++;
    break;
  case CAROM_EVENT_BALL_BALL:
    facts->moved |= set_of(a) | set_of(b);
    if (of_cue)
      meet(facts, sim, a == cue ? b : a);
    break;
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
    meet_cushion(facts, sim, pending_event);
    break;
  case CAROM_EVENT_POCKET:
    facts->down |= set_of(a);
    facts->pocket[a] = b;
    facts->pocket_time[a] = sim->time;
    if (is_banked(sim, a, b))
      facts->banked |= set_of(a);
    break;
  case CAROM_EVENT_LEFT_TABLE:
    facts->off |= set_of(a);
    break;
  default:
    break;
  }
}

/* Whether two balls touch by the rules. */
static bool touch_by_rules(const carom_sim *sim, int ball, int partner) {
  const double *centre = sim->path[ball].from.r, *partner_centre = sim->path[partner].from.r;
  const double radius = sim->rates[ball].radius, partner_radius = sim->rates[partner].radius;
  const double reach = radius + partner_radius + CAROM_RULES_TOUCH;
  const double x = partner_centre[0] - centre[0], y = partner_centre[1] - centre[1],
               z = partner_radius - radius;
  return x * x + y * y + z * z < reach * reach;
}

void carom_facts_frozen(const carom_sim *sim) {
  carom_facts *facts = sim->shot->facts;
  if (facts == NULL)
    return;
  facts->frozen = 0;
  for (int index = 0; index < sim->count; index++) {
    const bool is_object_ball = index != sim->struck && !carom_is_out(sim->path[index].from.label);
    if (is_object_ball && touch_by_rules(sim, sim->struck, index))
      facts->frozen |= set_of(index);
  }
}

void carom_facts_touches(const carom_sim *sim, int touches, double first, double second) {
  carom_facts *facts = sim->shot->facts;
  if (facts == NULL)
    return;
  const int earlier = facts->touches - 1;
  facts->touches = earlier + touches;
  if (earlier < 2 && facts->touches >= 2) {
    facts->second_time = sim->time;
    facts->second_speed = second;
    if (earlier == 1)
      facts->second_speed = first;
    memcpy(facts->second_place, sim->path[sim->struck].from.r, sizeof facts->second_place);
  }
}

void carom_facts_push(const carom_sim *sim, const carom_cluster_state *cluster,
                      const uint8_t order[], int count) {
  carom_facts *facts = sim->shot->facts;
  if (facts == NULL)
    return;
  carom_facts_touches(sim, cluster->tip.touches, cluster->tip.touch_closing, cluster->tip.second);
  for (int index = 0; index < count; index++) {
    const carom_cluster_contact_state *contact = &cluster->contact[order[index]];
    const bool of_tip = contact->i == cluster->tip.ball || contact->j == cluster->tip.ball;
    const int ball = contact->i == cluster->tip.ball ? contact->j : contact->i;
    if (of_tip && contact->time <= cluster->tip.last)
      facts->pushed |= set_of(cluster->ball[ball].index);
  }
}
