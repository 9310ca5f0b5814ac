/* What the games share: turns and sets of balls. A shot is judged only by its facts; what depends
 * on positions is done afterwards, by settle(). */
#ifndef CAROM_PLAN_RULES_H
#define CAROM_PLAN_RULES_H

#include "pot_kind.h"
#include "small_math.h"

static const carom_turn carom_keep = {CAROM_TURN_KEEP, CAROM_LEAVE_AFTER, 0, 0, 0.0};
static const carom_turn carom_pass = {CAROM_TURN_PASS, CAROM_LEAVE_AFTER, 0, 0, 0.0};

/* The values of carom_rules_state.innings but 0: who began, and the equalizing inning. */
enum { CAROM_BEGAN = 1, CAROM_FOLLOWS = 2, CAROM_LAST_INNING = 3 };

static inline int carom_count_of(uint32_t set) {
  int n = 0;
  for (; set != 0; set &= set - 1)
    n++;
  return n;
}
/* The set of one ball; of none where its number is below 0. */
static inline uint32_t carom_only(int ball) {
  if (ball < 0)
    return 0;
  return UINT32_C(1) << ball;
}
/* The lowest ball of a set and the highest one, as sets. */
static inline uint32_t carom_lowest_of(uint32_t set) {
  return set & (~set + 1);
}
static inline uint32_t carom_highest_of(uint32_t set) {
  uint32_t highest = 0;
  for (; set != 0; set &= set - 1)
    highest = carom_lowest_of(set);
  return highest;
}
/* The square of a distance. */
static inline double carom_square(const double a[2], const double b[2]) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}
static inline bool carom_is_called(const carom_facts *facts, carom_call call) {
  return call.ball >= 0 && call.ball < CAROM_BALLS_MOST && facts->pocket[call.ball] == call.pocket;
}
/* The balls that were met first, at one instant, as a set; 0: none. */
uint32_t carom_met_first(const carom_facts *facts);
/* The balls that are neither down nor off the table, as a set. */
uint32_t carom_on_table(const carom_shot_ball *balls, int count);
/* The ball that is met first by rules of touching balls: the lowest of `choice` that touches the
 * cue ball, where it is played away from, else the one that it meets; -1: none. */
int carom_first_of(const carom_facts *facts, uint32_t choice);
/* Balls behind the head string, which from there may not be met first before the cue ball has
 * crossed it (WPA 6.11), by the leave with which it was taken in hand; in English billiards balls
 * in baulk, from the D. As a set; 0 of a shot in which it has crossed the line. */
uint32_t carom_barred_from(const carom_plan_rules *rules, carom_leave leave,
                           const carom_facts *facts, const carom_table *table,
                           const carom_shot_ball *balls, int count);
/* Of the balls that are on, those nearest to the head string, where all of them lie behind it (WPA
 * 1.5); 0 where one does not. Balls whose distances differ by less than CAROM_RULES_TOUCH are
 * equally near. */
uint32_t carom_nearest_behind(const carom_table *table, const carom_shot_ball *balls, int count,
                              uint32_t targets);
/* The balls in play that touch a ball for the rules, as a set; 0 of one that is out of play. */
uint32_t carom_touching(const carom_shot_ball *balls, int count, int ball);
/* sight.c: whether others bar the way of the cue ball from c to an edge of ball k; and whether it
 * can hit any part of ball k in a straight line. */
bool carom_is_hidden(const carom_shot_ball *balls, uint32_t others, const double c[2], int k);
bool carom_is_seen(const carom_shot_ball *balls, uint32_t others, const double c[2], int k);
/* The turn goes to the other: the pairs of the state become his. Any of 15 balls may be met. */
carom_turn carom_give(carom_rules_state *game, carom_turn turn);
/* The same of a turn that passes; another one stays as it is. */
static inline carom_turn carom_end_turn(carom_rules_state *game, carom_turn turn) {
  if (turn.outcome == CAROM_TURN_PASS)
    carom_give(game, turn);
  return turn;
}
/* In games that each plays for itself: the seat at the table; the turn goes to the next seat that
 * has something left, or that seat has won if no other has; and the turn as its player sees it, who
 * has lost where another seat has won. */
static inline int carom_seat_of(const carom_rules_state *game) {
  return (int)((uint32_t)game->seat % CAROM_SEATS_MOST);
}
carom_turn carom_give_seat(carom_rules_state *game, carom_turn turn);
static inline carom_turn carom_turn_seen(const carom_plan_rules *rules,
                                         const carom_rules_state *after, carom_turn turn) {
  if (rules->race == CAROM_RACE_SEATS && turn.outcome == CAROM_TURN_WIN &&
      after->seat != rules->state.seat)
    turn.outcome = CAROM_TURN_LOSE;
  return turn;
}
/* A turn that passes with a foul, or none. After a scratch the cue ball is in hand behind the head
 * string, otherwise it is played from where it is. */
carom_turn carom_pass_by(int32_t foul);
/* The foul of a stroke is one more in a row; a stroke without one ends the row. Whether it is the
 * third, behind which a new row begins. */
bool carom_is_third_foul(carom_rules_state *game, bool foul);
carom_rules_on carom_on_any;
/* Whether a call is a choice after a break that the state allows: to have all balls of the set
 * racked and break from behind the head string, to have the other do so, or to leave the cue ball
 * where it is. *turn is then the result. */
bool carom_racks_again(carom_rules_state *game, int32_t call, uint32_t object_balls,
                       carom_turn *turn);

/* Adds points, or fouls; none of a state that no game has. */
static inline void carom_add(int32_t *sum, int more) {
  *sum = (int32_t)carom_min((int64_t)*sum + more, INT32_MAX);
}

/* Nine-ball and ten-ball: the foul of a break, of a push-out or of another stroke; and the turn
 * after a foul, with the cue ball in hand. The third foul in a row loses. */
int32_t carom_rotation_foul_of(const carom_facts *facts, uint32_t targets, int cue_ball,
                               bool opening, bool pushes);
carom_turn carom_give_hand(carom_rules_state *game, int32_t foul, uint32_t spot);
/* Whether a break pots or drives to the head string fewer balls than the state requires: by the
 * three-point rule (WPA, regulation 18) three. Then the other may hand the table back, without a
 * push-out; this is read from practice, as only paragraph 1 of the text was at hand. */
bool carom_is_below_target(const carom_rules_state *game, const carom_facts *facts, uint32_t balls);

/* Games in which eight balls win: a ball that counts, or is no more owed; one that a foul costs, or
 * is owed; what each player needs; and the balls that return after a stroke. */
enum { CAROM_BALLS_THAT_WIN = 8 };
void carom_count_ball(carom_rules_state *game, int seat);
void carom_pay_ball(carom_rules_state *game);
carom_rules_left carom_left_of_eight;
uint32_t carom_back_of(const carom_rules_state *game, uint32_t down, uint32_t first);

/* Spots balls, as a rack if there are enough for a break, or in straight pool. */
carom_rules_settle carom_settle_rack;

#endif
