/* The games, a row each. Names, checks and tables of the command and of other languages are made of
 * these rows.
 *
 * GAME(NAME, rules, word, text, BALLS, TABLE, RACK, last, OPENING, ANYWHERE, calls, members, may):
 * `rules` is the object that its file defines by CAROM_RULES_OBJECT, `members` are the members of
 * its state, by the names of CAROM_ALL_MEMBERS of state_members.h, and carom_rules_about has the
 * rest. */
#ifndef CAROM_PLAN_GAMES_H
#define CAROM_PLAN_GAMES_H

#include "carom_plan.h"
#include "platform/arithmetic.h"
#include "state_members.h"

#include <stdbool.h>

#define CAROM_GAMES(GAME)                                                                          \
  GAME(EIGHTBALL, carom_eightball, "eightball", "eight-ball by the WPA", POOL, POOL_9FT,           \
       EIGHTBALL, 15, KITCHEN, ANYWHERE, 1, OPENING | GROUP | MAY,                                 \
       CAROM_CHOICE_RACK | CAROM_CHOICE_OTHER_RACK | CAROM_CHOICE_STAY | CAROM_CHOICE_SPOT)        \
  GAME(NINEBALL, carom_nineball, "nineball", "nine-ball by the WPA", POOL, POOL_9FT, NINEBALL, 9,  \
       KITCHEN, ANYWHERE, 0, OPENING | FOULS | LOST | MAY | TARGET,                                \
       CAROM_CHOICE_PASS | CAROM_CHOICE_PUSH)                                                      \
  GAME(POTTING, carom_potting, "potting", "a drill: all balls count", POOL, POOL_9FT, EIGHTBALL,   \
       0, ANYWHERE, ANYWHERE, 0, NO_MEMBER, 0)                                                     \
  GAME(THREECUSHION, carom_threecushion, "threecushion", "three-cushion", BILLIARD, THREECUSHION,  \
       THREECUSHION, 0, AFTER, AFTER, 0, OPENING | GROUP | SCORE | TARGET | MAY | INNINGS,         \
       CAROM_CHOICE_SPOT)                                                                          \
  GAME(STRAIGHT, carom_straight, "straight", "straight pool by the WPA", POOL, POOL_9FT,           \
       EIGHTBALL, 15, KITCHEN, KITCHEN, 1, OPENING | FOULS | SCORE | LOST | MAY | TARGET,          \
       CAROM_CHOICE_PASS | CAROM_CHOICE_SPOT)                                                      \
  GAME(SNOOKER, carom_snooker, "snooker", "snooker by the WPBSA", SNOOKER, SNOOKER, SNOOKER, 21,   \
       D, D, 1, SCORE | MAY | ON | FREE_BALL,                                                      \
       CAROM_CHOICE_PASS | CAROM_CHOICE_FREE_BALL | CAROM_CHOICE_PLACE)                            \
  GAME(ONEPOCKET, carom_onepocket, "onepocket", "one-pocket by the BCA", POOL, POOL_9FT,           \
       EIGHTBALL, 15, KITCHEN, KITCHEN, 0, FOULS | SCORE | LOST | POCKET | MAY, CAROM_CHOICE_SPOT) \
  GAME(BANK, carom_bank_pool, "bank", "bank pool by the BCA", POOL, POOL_9FT, EIGHTBALL, 15,       \
       KITCHEN, KITCHEN, 1, OPENING | FOULS | SCORE | LOST | MAY,                                  \
       CAROM_CHOICE_PASS | CAROM_CHOICE_SPOT)                                                      \
  GAME(TENBALL, carom_ten_ball, "tenball", "ten-ball by the WPA", POOL, POOL_9FT, TENBALL, 10,     \
       KITCHEN, ANYWHERE, 2, OPENING | FOULS | MAY | TARGET,                                       \
       CAROM_CHOICE_PASS | CAROM_CHOICE_PUSH)                                                      \
  GAME(STRAIGHTRAIL, carom_straight_rail, "straightrail", "straight rail by the UMB", BILLIARD,    \
       THREECUSHION, THREECUSHION, 0, AFTER, AFTER, 0,                                             \
       OPENING | GROUP | SCORE | TARGET | MAY | INNINGS, CAROM_CHOICE_SPOT)                        \
  GAME(BLACKBALL, carom_blackball, "blackball", "blackball by the WPA", BLACKBALL, BLACKBALL,      \
       BLACKBALL, 15, BAULK, BAULK, 0, OPENING | GROUP | MAY | ON | FREE_BALL,                     \
       CAROM_CHOICE_RACK | CAROM_CHOICE_STAY)                                                      \
  GAME(HEYBALL, carom_heyball, "heyball", "heyball, Chinese eight-ball", POOL, HEYBALL, EIGHTBALL, \
       15, KITCHEN, ANYWHERE, 0, OPENING | GROUP | FOULS | MAY,                                    \
       CAROM_CHOICE_RACK | CAROM_CHOICE_OTHER_RACK | CAROM_CHOICE_STAY | CAROM_CHOICE_SPOT)        \
  GAME(ROTATION, carom_rotation, "rotation", "rotation by the BCA", POOL, POOL_9FT, ROTATION, 15,  \
       KITCHEN, KITCHEN, 0, OPENING | FOULS | SCORE | MAY, CAROM_CHOICE_RACK | CAROM_CHOICE_SPOT)  \
  GAME(PYRAMID, carom_pyramid, "pyramid", "free pyramid, Russian billiards", PYRAMID, PYRAMID,     \
       PYRAMID, 15, KITCHEN, AFTER, 0, OPENING | SCORE | MAY, CAROM_CHOICE_RACK)                   \
  GAME(FOURBALL, carom_four_ball, "fourball", "four-ball, as in Korea", FOURBALL, FOURBALL,        \
       FOURBALL, 0, AFTER, AFTER, 0, OPENING | GROUP | SCORE | LOST | TARGET | MAY,                \
       CAROM_CHOICE_SPOT)                                                                          \
  GAME(COWBOY, carom_cowboy, "cowboy", "cowboy by the BCA", POOL, POOL_9FT, COWBOY, 0, KITCHEN,    \
       KITCHEN, 1, OPENING | SCORE | LOST | MAY,                                                   \
       CAROM_CHOICE_RACK | CAROM_CHOICE_OTHER_RACK | CAROM_CHOICE_SPOT)                            \
  GAME(KILLER, carom_killer, "killer", "killer, by clubs", POOL, POOL_9FT, EIGHTBALL, 15, KITCHEN, \
       ANYWHERE, 0, OPENING, 0)                                                                    \
  GAME(CUTTHROAT, carom_cut_throat, "cutthroat", "cut-throat by the BCA", POOL, POOL_9FT,          \
       EIGHTBALL, 15, KITCHEN, KITCHEN, 0, OPENING | MAY | TARGET,                                 \
       CAROM_CHOICE_RACK | CAROM_CHOICE_SPOT)                                                      \
  GAME(BILLIARDS, carom_billiards, "billiards", "English billiards", SNOOKER, SNOOKER, BILLIARDS,  \
       0, D, D, 0, GROUP | SCORE | TARGET | MAY | ON, CAROM_CHOICE_RACK)

#define CAROM_GAME_RULES(NAME, rules, ...) extern const carom_plan_rules rules;
CAROM_GAMES(CAROM_GAME_RULES)

/* Sets what each of so many seats has as a match begins. Killer has 2 to 8 seats, cut-throat 3 or
 * 5, each other game 2; else CAROM_ERROR_OPTIONS. */
carom_status carom_begin_seats(carom_rules_kind kind, int seats, carom_rules_state *state);

/* Whether a game begins with a break. */
bool carom_has_opening(carom_rules_kind kind);
/* The largest handicap that a seat may have, and what the integer of a seat counts. */
int64_t carom_handicap_most(carom_rules_kind kind);
int carom_usual_seats(carom_rules_kind kind);
int64_t carom_seat_points(carom_rules_kind kind, uint64_t word);
/* Whether `lost` of a state counts what a player owes, which the points of a standing lack. */
bool carom_owes_points(carom_rules_kind kind);
/* The balls without which a game of this kind cannot be played, as a set. */
uint32_t carom_needed_balls(carom_rules_kind kind);

/* Begins the definition of the rules of a game. An object that no row names does not compile. */
#define CAROM_GAME_ROW(NAME, rules, ...) CAROM_ROW_OF_##rules = CAROM_RULES_##NAME,
enum { CAROM_GAMES(CAROM_GAME_ROW) };
#define CAROM_RULES_OBJECT(rules)                                               \
  _Static_assert((int)CAROM_ROW_OF_##rules >= 0, "rules have a row of a game"); \
  const carom_plan_rules rules

#endif
