/* The games, a row each, and what games by them taught. Names, checks and tables of the command and
 * of other languages are made of these rows.
 *
 * GAME(NAME, rules, word, text, BALLS, RACK, last, OPENING, HAND, calls, members, may): `rules` is
 * the object that its file defines, `members` are those of its state, by the names of
 * CAROM_STATE_MEMBERS of about/numbers.h, and carom_rules_about has the rest. */
#ifndef CAROM_PLAN_GAMES_H
#define CAROM_PLAN_GAMES_H

#include "about/numbers.h"
#include "view.h"

#define CAROM_GAMES(GAME)                                                                         \
  GAME(EIGHTBALL, carom_eightball, "eightball", "eight-ball by the WPA", POOL, EIGHTBALL, 15,     \
       KITCHEN, HAND, 1, OPENING | GROUP, 0)                                                      \
  GAME(NINEBALL, carom_nineball, "nineball", "nine-ball by the WPA", POOL, NINEBALL, 9, KITCHEN,  \
       HAND, 0, OPENING | FOULS | MAY, CAROM_MAY_PASS | CAROM_MAY_PUSH)                           \
  GAME(POTTING, carom_potting, "potting", "a drill: all balls count", POOL, EIGHTBALL, 0, HAND,   \
       HAND, 0, NO_MEMBER, 0)                                                                     \
  GAME(THREECUSHION, carom_threecushion, "threecushion", "three-cushion", BILLIARD, THREECUSHION, \
       0, AFTER, AFTER, 0, NO_MEMBER, 0)                                                          \
  GAME(STRAIGHT, carom_straight, "straight", "straight pool by the WPA", POOL, EIGHTBALL, 15,     \
       KITCHEN, KITCHEN, 1, OPENING | FOULS | SCORE | LOST | MAY | TARGET, CAROM_MAY_PASS)        \
  GAME(SNOOKER, carom_snooker, "snooker", "snooker by the WPBSA", SNOOKER, SNOOKER, 21, D, D, 1,  \
       SCORE | MAY | ON | FREE_BALL, CAROM_MAY_PASS | CAROM_MAY_FREE_BALL | CAROM_MAY_PLACE)      \
  GAME(ONEPOCKET, carom_onepocket, "onepocket", "one-pocket by the BCA", POOL, EIGHTBALL, 15,     \
       KITCHEN, KITCHEN, 0, FOULS | SCORE | LOST | POCKET, 0)                                     \
  GAME(BANK, carom_bank_pool, "bank", "bank pool by the BCA", POOL, EIGHTBALL, 15, KITCHEN,       \
       KITCHEN, 1, OPENING | FOULS | SCORE | LOST | MAY, CAROM_MAY_PASS)

#define CAROM_GAME_RULES(NAME, rules, ...) extern const carom_plan_rules rules;
CAROM_GAMES(CAROM_GAME_RULES)
#define CAROM_GAME_WORD(NAME, rules, word, text, ...) \
  {CAROM_WORDS_RULES, CAROM_RULES_##NAME, word, text},

typedef struct learned {
  double next[NEXT_NUMBERS], later[LATER_NUMBERS], first[FIRST_NUMBERS];
  double mean;    /* of x[2] */
  double stretch; /* of the log-odds of a value: carom-lab plan --games tells it */
} learned;

/* Of the games that were played for it; the others have those of one with the same race. */
static const learned learned_of[] = {
    [CAROM_RULES_EIGHTBALL] =
        {/* of 23101 strokes: carom-lab learn --rules eightball --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.2798; of one number for all, -0.4112 */
         .next = {-0.209, -0.768, 1.958, 1.979, -0.019, -0.171, 0.381},
         /* log-likelihood of a stroke -0.3184; of one number for all, -0.3778 */
         .later = {1.904, -1.117, -0.509, 0.815},
         /* log-likelihood of a stroke -0.5209; of one number for all, -0.5689 */
         .first = {2.661, -1.130, -2.505},
         .mean = 0.612,
         .stretch = 0.85},
    [CAROM_RULES_NINEBALL] =
        {/* of 18459 strokes: carom-lab learn --rules nineball --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3021; of one number for all, -0.4525 */
         .next = {0.156, -1.092, 1.374, 1.374, 0.000, 0.156, -0.076},
         /* log-likelihood of a stroke -0.2170; of one number for all, -0.2813 */
         .later = {1.788, -1.548, 0.951, 0.353},
         /* log-likelihood of a stroke -0.5945; of one number for all, -0.6557 */
         .first = {1.032, -1.034, 1.755},
         .mean = 0.728,
         .stretch = 1.4},
    [CAROM_RULES_ONEPOCKET] =
        {/* of 18373 strokes: carom-lab learn --rules onepocket --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3250; of one number for all, -0.5352 */
         .next = {-0.589, -0.696, 0.919, 3.921, -0.347, -0.588, -2.201},
         /* log-likelihood of a stroke -0.3340; of one number for all, -0.3914 */
         .later = {1.738, -1.182, -0.472, 0.742},
         /* log-likelihood of a stroke -0.6681; of one number for all, -0.6927 */
         .first = {0.455, -0.510, -0.767},
         .mean = 0.165,
         .stretch = 1.6},
    [CAROM_RULES_STRAIGHT] =
        {/* of 4558 strokes: carom-lab learn --rules straight --racks 512 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.2221; of one number for all, -0.3014 */
         .next = {0.141, -0.902, 0.969, 0.991, 1.607, 0.000, 6.455},
         /* log-likelihood of a stroke -0.2187; of one number for all, -0.2435 */
         .later = {2.118, -1.208, 1.049, -0.284},
         /* log-likelihood of a stroke -0.4772; of one number for all, -0.5368 */
         .first = {2.131, -1.152, -0.526},
         .mean = 0.515,
         .stretch = 1.0},
    [CAROM_RULES_SNOOKER] =
        {/* of 5484 strokes: carom-lab learn --rules snooker --racks 1792 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3135; of one number for all, -0.6076 */
         .next = {-1.520, -1.009, 1.989, 4.098, -0.347, -0.115, 0.000},
         /* log-likelihood of a stroke -0.3062; of one number for all, -0.3269 */
         .later = {0.766, -1.312, -0.134, 0.389},
         /* log-likelihood of a stroke -0.4624; of one number for all, -0.6190 */
         .first = {-0.530, -1.434, -0.500},
         .mean = 0.260,
         .stretch = 1.0},
};

#endif
