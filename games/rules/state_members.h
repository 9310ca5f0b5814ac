/* The members of the state of a game, a row each. */
#ifndef CAROM_PLAN_STATE_MEMBERS_H
#define CAROM_PLAN_STATE_MEMBERS_H

/* MEMBER(NAME, member, low, high, range), of carom_rules_state, in its order. */
#define CAROM_STATE_MEMBERS(MEMBER)                      \
  MEMBER(OPENING, opening, 0, 1, "0 or 1")               \
  MEMBER(GROUP, group, 0, 2, "0, 1 or 2")                \
  MEMBER(FOULS, fouls, 0, 2, "0, 1 or 2")                \
  MEMBER(SCORE, score, 0, 1000000, "0 to 1000000")       \
  MEMBER(LOST, lost, 0, 1000000, "0 to 1000000")         \
  MEMBER(POCKET, pocket, 0, 7, "0 to 7")                 \
  MEMBER(MAY, may, 0, 255, "a sum that the game allows") \
  MEMBER(ON, on, 0, 1, "0 or 1")                         \
  MEMBER(FREE_BALL, free_ball, 0, 21, "0 to 21")         \
  MEMBER(TARGET, target, 1, 1000000, "1 to 1000000")

/* Members that were added later. Their keys are behind the others of a line, so that the hashes of
 * older recordings stay. */
#define CAROM_LATER_MEMBERS(MEMBER)        \
  MEMBER(INNINGS, innings, 0, 3, "0 to 3") \
  MEMBER(SEAT, seat, 0, 7, "0 to 7")
#define CAROM_ALL_MEMBERS(MEMBER) CAROM_STATE_MEMBERS(MEMBER) CAROM_LATER_MEMBERS(MEMBER)

#endif
