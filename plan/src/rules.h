/* What the games share: turns and sets of balls. A shot is judged by its facts alone; what depends
 * on places comes after, by settle(). */
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

/* Whether a break reaches cushions with four balls, or pots. */
bool carom_is_break(const carom_facts *facts, int cue_ball);

/* Games in which eight balls win: a ball that counts, or is no more owed; one that a foul costs, or
 * is owed; what each player needs; and the balls that come back after a stroke. */
enum { CAROM_BALLS_THAT_WIN = 8 };
void carom_count_ball(carom_rules_state *game, int who);
void carom_pay_ball(carom_rules_state *game);
carom_rules_left carom_left_of_eight;
uint32_t carom_back_of(const carom_rules_state *game, uint32_t down, uint32_t first);
carom_rules_settle carom_settle_pool;

/* Puts balls on the foot spot, or behind it, in the order of their numbers. */
void carom_put_back(const carom_table *table, carom_shot_ball *balls, int count, uint32_t set);

#endif
