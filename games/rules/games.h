/* The games, a row each, and what games by them taught. Names, checks and tables of the command and
 * of other languages are made of these rows.
 *
 * GAME(NAME, rules, word, text, BALLS, TABLE, RACK, last, OPENING, ANYWHERE, calls, members, may):
 * `rules` is the object that its file defines by CAROM_RULES_OBJECT, `members` are those of its
 * state, by the names of CAROM_ALL_MEMBERS of state_members.h, and carom_rules_about has the
 * rest. */
#ifndef CAROM_PLAN_GAMES_H
#define CAROM_PLAN_GAMES_H

#include "state_members.h"
#include "view.h"

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

/* Begins the definition of the rules of a game. An object that no row names does not compile. */
#define CAROM_GAME_ROW(NAME, rules, ...) CAROM_ROW_OF_##rules = CAROM_RULES_##NAME,
enum { CAROM_GAMES(CAROM_GAME_ROW) };
#define CAROM_RULES_OBJECT(rules)                                               \
  _Static_assert((int)CAROM_ROW_OF_##rules >= 0, "rules have a row of a game"); \
  const carom_plan_rules rules

typedef struct learned {
  double next[NEXT_NUMBERS], later[LATER_NUMBERS], first[FIRST_NUMBERS];
  double mean;    /* of x[2] */
  double width;   /* of the table of these racks, m */
  double stretch; /* of the log-odds of a value: carom-lab plan --games tells it. It is about the */
  double edge;    /* difference of the players, of which this share counts: --against shows it */
} learned;

/* Of the games that were played for it; the others have those of one with the same race. */
static const learned learned_of[] = {
    [CAROM_RULES_EIGHTBALL] =
        {/* of 23001 strokes: carom-lab learn --rules eightball --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.2723; of one number for all, -0.4124 */
         .next = {-0.351, -0.922, 1.072, 2.570, 0.239, 0.008, 0.371},
         /* log-likelihood of a stroke -0.2919; of one number for all, -0.3579 */
         .later = {1.838, -1.253, -0.193, 0.792},
         /* log-likelihood of a stroke -0.5535; of one number for all, -0.6161 */
         .first = {2.520, -1.370, -1.846},
         .mean = 0.624,
         .width = 0.9906,
         .stretch = 0.9,
         .edge = 0.85},
    [CAROM_RULES_NINEBALL] =
        {/* of 19183 strokes: carom-lab learn --rules nineball --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.2877; of one number for all, -0.4606 */
         .next = {-0.023, -1.126, 1.574, 1.574, 0.000, -0.023, 0.000},
         /* log-likelihood of a stroke -0.2096; of one number for all, -0.2677 */
         .later = {1.769, -1.507, 1.047, 0.210},
         /* log-likelihood of a stroke -0.5699; of one number for all, -0.6717 */
         .first = {1.141, -1.421, 2.196},
         .mean = 0.738,
         .width = 0.9906,
         .stretch = 1.5,
         .edge = 0.8},
    [CAROM_RULES_ONEPOCKET] =
        {/* of 17534 strokes: carom-lab learn --rules onepocket --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3248; of one number for all, -0.5642 */
         .next = {-0.883, -0.723, 0.965, 4.184, -0.345, -0.805, -2.275},
         /* log-likelihood of a stroke -0.3481; of one number for all, -0.4123 */
         .later = {1.709, -1.237, -0.877, 0.757},
         /* log-likelihood of a stroke -0.6616; of one number for all, -0.6888 */
         .first = {0.211, -0.555, -0.329},
         .mean = 0.155,
         .width = 1.27,
         .stretch = 1.6,
         .edge = 1.0},
    [CAROM_RULES_STRAIGHT] =
        {/* of 19836 strokes: carom-lab learn --rules straight --racks 2048 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.1891; of one number for all, -0.2654 */
         .next = {0.077, -1.013, 0.616, 1.777, 1.510, 0.000, -0.604},
         /* log-likelihood of a stroke -0.1639; of one number for all, -0.1947 */
         .later = {2.676, -1.522, 0.657, -0.455},
         /* log-likelihood of a stroke -0.4254; of one number for all, -0.4976 */
         .first = {3.305, -1.726, -2.164},
         .mean = 0.455,
         .width = 1.27,
         .stretch = 1.0,
         .edge = 1.0},
    [CAROM_RULES_SNOOKER] =
        {/* of 5484 strokes: carom-lab learn --rules snooker --racks 1792 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3135; of one number for all, -0.6076 */
         .next = {-1.520, -1.009, 1.989, 4.098, -0.347, -0.115, 0.000},
         /* log-likelihood of a stroke -0.3062; of one number for all, -0.3269 */
         .later = {0.766, -1.312, -0.134, 0.389},
         /* log-likelihood of a stroke -0.4624; of one number for all, -0.6190 */
         .first = {-0.530, -1.434, -0.500},
         .mean = 0.260,
         .width = 1.778,
         .stretch = 1.0,
         .edge = 1.0},
    [CAROM_RULES_BANK] =
        {/* of 16870 strokes: carom-lab learn --rules bank --racks 12288 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.5355; of one number for all, -0.6068 */
         .next = {-2.034, -0.732, 0.211, 0.999, -0.070, -0.137, 0.889},
         /* log-likelihood of a stroke -0.6286; of one number for all, -0.6621 */
         .later = {-1.047, -0.721, 0.019, 0.005},
         /* log-likelihood of a stroke -0.4736; of one number for all, -0.5398 */
         .first = {-1.255, -0.903, 0.168},
         .mean = 0.433,
         .width = 1.27,
         .stretch = 1.0,
         .edge = 1.0},
    [CAROM_RULES_PYRAMID] =
        {/* of 10849 strokes: carom-lab learn --rules pyramid --racks 256 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3373; of one number for all, -0.5443 */
         .next = {-1.878, -0.772, -0.196, 4.276, 1.462, 0.000, -1.878},
         /* log-likelihood of a stroke -0.5426; of one number for all, -0.6871 */
         .later = {0.256, -0.880, -4.707, 3.030},
         /* log-likelihood of a stroke -0.3801; of one number for all, -0.4423 */
         .first = {-0.098, -1.478, -1.065},
         .mean = 0.177,
         .width = 1.775,
         .stretch = 1.0,
         .edge = 1.0},
};

/* By how many points of carom_player_fargo() players differ who differ by 100 points in a game:
 * below a rating of 500, and above it. With these, 100 points are odds of 2 to 1 in the unit of
 * the comment, as `carom-lab plan --rules GAME --players A,B` shows; with twice as many points
 * they would be odds of about 4 to 1. Games without a row have those of eight-ball. */
static const double rating_steps[][2] = {
    [CAROM_RULES_EIGHTBALL] = {70.0, 95.0},    /* a rack */
    [CAROM_RULES_NINEBALL] = {118.0, 110.0},   /* a rack */
    [CAROM_RULES_TENBALL] = {108.0, 88.0},     /* a rack */
    [CAROM_RULES_ROTATION] = {68.0, 78.0},     /* a rack */
    [CAROM_RULES_ONEPOCKET] = {60.0, 53.0},    /* a rack */
    [CAROM_RULES_BANK] = {48.0, 34.0},         /* a rack */
    [CAROM_RULES_STRAIGHT] = {52.0, 52.0},     /* 15 points, about a rack */
    [CAROM_RULES_SNOOKER] = {47.0, 47.0},      /* a frame */
    [CAROM_RULES_THREECUSHION] = {36.0, 36.0}, /* 15 points */
};

#endif
