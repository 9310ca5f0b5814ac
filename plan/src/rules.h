/* What the games share: turns, sets of balls, and the games that have files of their own. A shot is
 * judged by its facts alone; what depends on places comes after, by settle(). */
#ifndef CAROM_PLAN_RULES_H
#define CAROM_PLAN_RULES_H

#include "view.h"

static const carom_turn carom_keep = {CAROM_TURN_KEEP, CAROM_LEAVE_AFTER, 0, 0, 0.0};
static const carom_turn carom_pass = {CAROM_TURN_PASS, CAROM_LEAVE_AFTER, 0, 0, 0.0};

static inline int carom_count_of(uint32_t set) {
  int n = 0;
  for (; set != 0; set &= set - 1)
    n++;
  return n;
}
static inline bool carom_is_called(const carom_facts *facts, carom_call call) {
  return call.ball >= 0 && call.ball < CAROM_BALLS_MOST && facts->pocket[call.ball] == call.pocket;
}
/* The pairs of a state, for the other player. */
static inline void carom_swap(int32_t pair[2]) {
  const int32_t kept = pair[0];
  pair[0] = pair[1];
  pair[1] = kept;
}
/* Adds points, or fouls; none of a state that no game has. */
static inline void carom_add(int32_t *to, int more) {
  *to = *to > INT32_MAX - more ? INT32_MAX : *to + more;
}

/* A ball that was not frozen was met while the tip was on the cue ball, or the tip touched twice
 * without any that was: a frozen ball may be played through. */
bool carom_is_double_hit(const carom_facts *facts);

/* Puts balls on the foot spot, or behind it, in the order of their numbers. */
void carom_put_back(const carom_table *table, carom_shot_ball *balls, int count, uint32_t set);

extern const carom_plan_rules carom_straight, carom_snooker, carom_onepocket;

#endif
