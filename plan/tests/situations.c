/* Situations of the rules, a row each with its section: the World Standardized Rules of the WPA
 * (2016; 1 general, 2 nine-ball, 3 eight-ball, 4 straight pool, 6 fouls), the rules of the WPBSA
 * (section 3, by the titles of its rules), the BCA's one-pocket and bank pool, and the UMB's world
 * rules of carom billiard (articles). A row has what a shot did and what the ruling must be. */
#include "game_support.h"

enum { E = CAROM_RULES_EIGHTBALL, N = CAROM_RULES_NINEBALL, ST = CAROM_RULES_STRAIGHT };
enum { SN = CAROM_RULES_SNOOKER, ONE = CAROM_RULES_ONEPOCKET, BANK = CAROM_RULES_BANK };
enum { THREE = CAROM_RULES_THREECUSHION, RAIL = CAROM_RULES_STRAIGHTRAIL };
enum { BB = CAROM_RULES_BLACKBALL, HEY = CAROM_RULES_HEYBALL, ROT = CAROM_RULES_ROTATION };
enum { PYR = CAROM_RULES_PYRAMID, FOUR = CAROM_RULES_FOURBALL, COW = CAROM_RULES_COWBOY };
enum { TEN = CAROM_RULES_TENBALL, BAULK = CAROM_LEAVE_BAULK, OTHER_RULE = CAROM_FOUL_OTHER };
enum { HAND_ANY = CAROM_LEAVE_HAND };
enum { RACK = CAROM_MAY_RACK, OTHER = CAROM_MAY_OTHER_RACK, STAY = CAROM_MAY_STAY };
enum { PUSH = CAROM_MAY_PUSH, SPOT = CAROM_MAY_SPOT };

#define B(k) (UINT32_C(1) << (k))
static const uint32_t frame = 0x3fffff;

typedef struct situation {
  const char *section;
  int game;
  carom_rules_state state;
  uint32_t in_play; /* 0: all balls of the game */
  int first;        /* met; 0: none */
  uint32_t with;    /* balls met at the same instant */
  int after;        /* cushions after the first contact */
  uint32_t down, off, pushed, frozen, barred, jumped;
  int driven, pocket;    /* balls 1 to driven met a cushion; the pocket of all that fell */
  int touches, cushions; /* of the tip; of the cue ball before the second ball */
  int second;            /* the second ball that was met; 0: none */
  carom_call call;
  int outcome, leave, foul;
  uint32_t spot;
  int may, points; /* points: of who plays next in snooker and pyramid, else of the player */
  uint32_t met, past, head; /* all balls met; balls past the middle, and at the head string */
  int free;                 /* the next stroke is free */
} situation;

#define NO_CALL .call = {-1, -1}
static const situation rows[] = {
    /* ---- WPA, fouls */
    {"WPA 6.1 scratch", N, .first = 1, .after = 1, .down = B(0), NO_CALL, PASS, HAND_ANY, CUE_BALL},
    {"WPA 6.1 off the table", N, .first = 1, .off = B(0), NO_CALL, PASS, HAND_ANY, CUE_BALL},
    {"WPA 6.2 wrong ball first", N, .first = 2, .after = 1, NO_CALL, PASS, HAND_ANY, FIRST},
    {"WPA 6.2 no ball", N, NO_CALL, PASS, HAND_ANY, NO_BALL},
    {"WPA 6.3 no rail", N, .first = 1, NO_CALL, PASS, HAND_ANY, CUSHION},
    {"WPA 6.3 a ball falls", N, .first = 1, .down = B(4), NO_CALL, KEEP},
    {"WPA 6.5 driven off", N, .first = 1, .after = 1, .off = B(4), NO_CALL, PASS, HAND_ANY, OFF},
    {"WPA 6.5 the nine is spotted", N, .first = 1, .after = 1, .off = B(9), NO_CALL, PASS, HAND_ANY,
     OFF, B(9)},
    {"WPA 6.7 double hit", N, .first = 1, .after = 1, .touches = 2, NO_CALL, PASS, HAND_ANY,
     DOUBLE_HIT},
    {"WPA 6.7 frozen ball", N, .first = 1, .after = 1, .pushed = B(1), .frozen = B(1), NO_CALL,
     PASS},
    {"WPA 6.8 push shot", N, .first = 1, .after = 1, .pushed = B(1), NO_CALL, PASS, HAND_ANY,
     DOUBLE_HIT},
    {"WPA 6.11 behind the head string",
     E,
     {.group = 1},
     .first = 2,
     .after = 1,
     .barred = B(2),
     NO_CALL,
     PASS,
     HAND_ANY,
     FIRST},
    {"WPA 6.11 after it was crossed", E, {.group = 1}, .first = 2, .after = 1, NO_CALL, PASS},
    {"WPA 6.14 third foul",
     N,
     {.fouls = {2, 0}},
     .first = 3,
     .after = 1,
     NO_CALL,
     LOSE,
     HAND_ANY,
     FIRST},
    {"WPA 6.14 second foul",
     N,
     {.fouls = {1, 0}},
     .first = 3,
     .after = 1,
     NO_CALL,
     PASS,
     HAND_ANY,
     FIRST},
    {"WPA regulations, split hits", N, .first = 3, .with = B(1), .after = 1, NO_CALL, PASS},
    {"WPA regulations, split hits",
     E,
     {.group = 2},
     .first = 1,
     .with = B(9),
     .after = 1,
     NO_CALL,
     PASS},

    /* ---- WPA, nine-ball */
    {"WPA 2.3 four to rails",
     N,
     {.opening = 1},
     .first = 1,
     .after = 4,
     .driven = 4,
     NO_CALL,
     PASS,
     .may = PUSH},
    {"WPA 2.3 three to rails",
     N,
     {.opening = 1},
     .first = 1,
     .after = 3,
     .driven = 3,
     NO_CALL,
     PASS,
     HAND_ANY,
     BREAK},
    {"WPA 2.3 the nine on the break", N, {.opening = 1}, .first = 1, .down = B(9), NO_CALL, WIN},
    {"WPA 2.4 push out",
     N,
     {.may = PUSH},
     .first = 0,
     .call = {CAROM_CALL_PUSH, -1},
     PASS,
     .may = MAY},
    {"WPA 2.4 push out, the nine",
     N,
     {.may = PUSH},
     .first = 9,
     .down = B(9),
     .call = {CAROM_CALL_PUSH, -1},
     PASS,
     AFTER,
     LEGAL,
     B(9),
     .may = MAY},
    {"WPA 2.4 push out, scratch",
     N,
     {.may = PUSH},
     .down = B(0),
     .call = {CAROM_CALL_PUSH, -1},
     PASS,
     HAND_ANY,
     CUE_BALL},
    {"WPA 2.4 passed back", N, {.may = MAY}, .call = {CAROM_CALL_PASS, -1}, PASS},
    {"WPA 2.5 the nine by a combination", N, .first = 1, .down = B(9), NO_CALL, WIN},
    {"WPA 2.6 the nine on a foul", N, .first = 2, .down = B(9), NO_CALL, PASS, HAND_ANY, FIRST,
     B(9)},

    /* ---- WPA, eight-ball */
    {"WPA 3.3(c) a ball falls", E, {.opening = 1}, .first = 1, .down = B(5), NO_CALL, KEEP},
    {"WPA 3.3(d) illegal break",
     E,
     {.opening = 1},
     .first = 1,
     .after = 3,
     .driven = 3,
     NO_CALL,
     PASS,
     AFTER,
     BREAK,
     .may = RACK | OTHER},
    {"WPA 3.3(d) he breaks again",
     E,
     {.may = RACK | OTHER},
     .call = {CAROM_CALL_RACK, -1},
     KEEP,
     KITCHEN,
     LEGAL,
     0xfffe},
    {"WPA 3.3(d) the other breaks again",
     E,
     {.may = RACK | OTHER},
     .call = {CAROM_CALL_OTHER_RACK, -1},
     PASS,
     KITCHEN,
     LEGAL,
     0xfffe},
    {"WPA 3.3(e) the eight falls",
     E,
     {.opening = 1},
     .first = 1,
     .down = B(8),
     NO_CALL,
     KEEP,
     AFTER,
     LEGAL,
     B(8),
     .may = RACK},
    {"WPA 3.3(f) the eight and the cue ball",
     E,
     {.opening = 1},
     .first = 1,
     .down = B(8) | B(0),
     NO_CALL,
     PASS,
     KITCHEN,
     CUE_BALL,
     B(8),
     .may = RACK},
    {"WPA 3.3(g) a ball off the table",
     E,
     {.opening = 1},
     .first = 1,
     .after = 4,
     .driven = 4,
     .off = B(3),
     NO_CALL,
     PASS,
     KITCHEN,
     OFF,
     .may = STAY},
    {"WPA 3.3(g) the table in position", E, {.may = STAY}, .call = {CAROM_CALL_STAY, -1}, KEEP},
    {"WPA 3.4 the group", E, .first = 3, .down = B(3), .pocket = 2, .call = {3, 2}, KEEP},
    {"WPA 3.5 another pocket",
     E,
     {.group = 1},
     .first = 3,
     .down = B(3),
     .pocket = 1,
     .call = {3, 2},
     PASS},
    {"WPA 3.6 a safety", E, {.group = 1}, .first = 3, .down = B(3), NO_CALL, PASS},
    {"WPA 3.8(a) the eight too early",
     E,
     {.group = 1},
     .first = 3,
     .down = B(8),
     .pocket = 2,
     .call = {8, 2},
     LOSE},
    {"WPA 3.8(b) the eight in another pocket",
     E,
     {.group = 1},
     .in_play = B(0) | B(8) | B(9),
     .first = 8,
     .down = B(8),
     .pocket = 1,
     .call = {8, 2},
     LOSE},
    {"WPA 3.8 the eight as the last",
     E,
     {.group = 1},
     .in_play = B(0) | B(8) | B(9),
     .first = 8,
     .down = B(8),
     .pocket = 2,
     .call = {8, 2},
     WIN},
    {"WPA 3.8 the eight on a foul",
     E,
     {.group = 1},
     .in_play = B(0) | B(8) | B(9),
     .first = 8,
     .down = B(8) | B(0),
     .pocket = 2,
     .call = {8, 2},
     LOSE,
     AFTER,
     CUE_BALL},
    {"WPA 3.9 the other group first",
     E,
     {.group = 1},
     .first = 9,
     .after = 1,
     NO_CALL,
     PASS,
     HAND_ANY,
     FIRST},
    {"WPA 3.9 the eight first",
     E,
     {.group = 1},
     .first = 8,
     .after = 1,
     NO_CALL,
     PASS,
     HAND_ANY,
     FIRST},

    /* ---- WPA, straight pool */
    {"WPA 4.3 breaking foul",
     ST,
     {.opening = 1, .target = 100},
     .first = 1,
     .after = 1,
     .driven = 1,
     NO_CALL,
     PASS,
     AFTER,
     BREAK,
     .may = MAY},
    {"WPA 4.3 he breaks again",
     ST,
     {.may = MAY, .target = 100},
     .call = {CAROM_CALL_PASS, -1},
     PASS,
     KITCHEN,
     LEGAL,
     0xfffe},
    {"WPA 4.4 a called ball",
     ST,
     {.target = 100},
     .first = 1,
     .down = B(1),
     .pocket = 2,
     .call = {1, 2},
     KEEP,
     .points = 1},
    {"WPA 4.4 the last point",
     ST,
     {.target = 100, .score = {99, 0}},
     .first = 1,
     .down = B(1),
     .pocket = 2,
     .call = {1, 2},
     WIN,
     .points = 100},
    {"WPA 4.6 not as called",
     ST,
     {.target = 100},
     .first = 1,
     .down = B(1),
     .pocket = 1,
     .call = {1, 2},
     PASS,
     AFTER,
     LEGAL,
     B(1)},
    {"WPA 4.9 scratch",
     ST,
     {.target = 100},
     .first = 1,
     .down = B(0),
     NO_CALL,
     PASS,
     KITCHEN,
     CUE_BALL},
    {"WPA 4.10 third foul",
     ST,
     {.target = 100, .fouls = {2, 0}},
     .first = 1,
     NO_CALL,
     KEEP,
     KITCHEN,
     CUSHION,
     0xfffe},

    /* ---- WPBSA */
    {"WPBSA mode of play: a red", SN, .first = 1, .down = B(1), NO_CALL, KEEP, .points = 1},
    {"WPBSA mode of play: two reds", SN, .first = 1, .down = B(1) | B(2), NO_CALL, KEEP,
     .points = 2},
    {"WPBSA mode of play: the colour named",
     SN,
     {.on = 1},
     .first = 21,
     .down = B(21),
     .call = {21, -1},
     KEEP,
     AFTER,
     LEGAL,
     B(21),
     .points = 7},
    {"WPBSA two balls at once: red and black", SN, .first = 1, .with = B(21), .after = 1, NO_CALL,
     PASS, AFTER, FIRST, .may = MAY, .points = 7},
    {"WPBSA two balls at once: two reds", SN, .first = 1, .with = B(2), .after = 1, NO_CALL, PASS},
    {"WPBSA two balls at once: free ball and red",
     SN,
     {.may = MAY | FREE},
     .first = 1,
     .with = B(17),
     .after = 1,
     .call = {17, -1},
     PASS},
    {"WPBSA two balls at once: blue named, pink too",
     SN,
     {.on = 1},
     .first = 19,
     .with = B(20),
     .call = {19, -1},
     PASS,
     AFTER,
     FIRST,
     .may = MAY,
     .points = 6},
    {"WPBSA touching ball: played away", SN, .frozen = B(1), NO_CALL, PASS},
    {"WPBSA touching ball: it moves", SN, .first = 1, .frozen = B(1), .pushed = B(1), NO_CALL, PASS,
     AFTER, DOUBLE_HIT, .may = MAY, .points = 4},
    {"WPBSA fouls: no ball", SN, NO_CALL, PASS, AFTER, NO_BALL, .may = MAY, .points = 4},
    {"WPBSA fouls: in off the black",
     SN,
     {.on = 1},
     .first = 21,
     .down = B(0),
     .call = {21, -1},
     PASS,
     D,
     CUE_BALL,
     .may = MAY | HAND,
     .points = 7},
    {"WPBSA fouls: a colour for a red", SN, .first = 1, .down = B(20), NO_CALL, PASS, AFTER, POT,
     B(20), .may = MAY, .points = 6},
    {"WPBSA play again", SN, {.may = MAY}, .call = {CAROM_CALL_PASS, -1}, PASS},
    {"WPBSA end: the black",
     SN,
     {.score = {60, 50}},
     .in_play = 1 | BK,
     .first = 21,
     .down = B(21),
     NO_CALL,
     WIN,
     .points = 67},
    {"WPBSA end: equal scores",
     SN,
     {.score = {50, 57}},
     .in_play = 1 | BK,
     .first = 21,
     .down = B(21),
     NO_CALL,
     PASS,
     D,
     LEGAL,
     B(21),
     .points = 57},

    /* ---- BCA */
    {"BCA one-pocket: his pocket",
     ONE,
     {.pocket = {MINE, HIS}},
     .first = 1,
     .down = B(1),
     .pocket = MINE,
     NO_CALL,
     KEEP,
     .points = 1},
    {"BCA one-pocket: another pocket",
     ONE,
     {.pocket = {MINE, HIS}},
     .first = 1,
     .down = B(1),
     .pocket = NEUTRAL,
     NO_CALL,
     PASS,
     AFTER,
     LEGAL,
     B(1)},
    {"BCA one-pocket: the eighth ball",
     ONE,
     {.pocket = {MINE, HIS}, .score = {7, 0}},
     .first = 1,
     .down = B(1),
     .pocket = MINE,
     NO_CALL,
     WIN,
     .points = 8},
    {"BCA bank pool: not banked", BANK, .first = 1, .down = B(1), .pocket = 2, .call = {1, 2}, PASS,
     AFTER, LEGAL, B(1)},

    /* ---- UMB */
    {"UMB 23 the red first",
     THREE,
     {.opening = 1, .target = 40},
     .first = 1,
     NO_CALL,
     PASS,
     AFTER,
     FIRST},
    {"UMB 83 three cushions",
     THREE,
     {.target = 40},
     .first = 1,
     .second = 2,
     .cushions = 3,
     NO_CALL,
     KEEP,
     .points = 1},
    {"UMB 83 two cushions",
     THREE,
     {.target = 40},
     .first = 1,
     .second = 2,
     .cushions = 2,
     NO_CALL,
     PASS},
    {"UMB 28 a ball leaves the table",
     THREE,
     {.target = 40},
     .first = 1,
     .second = 2,
     .cushions = 3,
     .off = B(2),
     NO_CALL,
     PASS,
     AFTER,
     OFF,
     B(2)},
    {"UMB 83 a drill without a target", THREE, .first = 1, .second = 2, .cushions = 3, NO_CALL,
     KEEP, .points = 1},
    {"UMB 29 the last point",
     THREE,
     {.target = 40, .score = {39, 20}},
     .first = 1,
     .second = 2,
     .cushions = 4,
     NO_CALL,
     WIN,
     .points = 40},
    {"UMB 23 straight rail: the red first",
     RAIL,
     {.opening = 1},
     .first = 1,
     .second = 2,
     NO_CALL,
     PASS,
     AFTER,
     FIRST},
    {"UMB 61 both balls", RAIL, .first = 1, .second = 2, NO_CALL, KEEP, .points = 1},
    {"UMB 61 one ball", RAIL, .first = 1, .cushions = 3, NO_CALL, PASS},
    {"UMB 61 none", RAIL, NO_CALL, PASS},
    {"UMB 28 straight rail: a ball leaves the table", RAIL, .first = 1, .second = 2, .off = B(2),
     NO_CALL, PASS, AFTER, OFF, B(2)},
    {"UMB 41 straight rail: a double hit", RAIL, .first = 1, .second = 2, .touches = 2, NO_CALL,
     PASS, AFTER, DOUBLE_HIT},
    {"UMB 29 straight rail: the last point",
     RAIL,
     {.target = 100, .score = {99, 3}},
     .first = 2,
     .second = 1,
     NO_CALL,
     WIN,
     .points = 100},
};

/* clang-format off */
static const situation games_of_2026[] = {
    /* ---- WPA, the three-point rule */
    {"WPA reg. 18 two points", N, {.opening = 1, .target = 3}, .first = 1, .after = 4,
     .driven = 4, .head = B(2) | B(5), NO_CALL, PASS, .may = MAY},
    {"WPA reg. 18 three points", N, {.opening = 1, .target = 3}, .first = 1, .down = B(7),
     .head = B(2) | B(5) | B(7), NO_CALL, KEEP, .may = PUSH},
    {"WPA reg. 18 a pot and one ball, ten-ball", TEN, {.opening = 1, .target = 3}, .first = 1,
     .down = B(7), .head = B(2) | B(7), NO_CALL, PASS, .may = MAY},
    {"WPA reg. 18 the nine with too few", N, {.opening = 1, .target = 3}, .first = 1,
     .down = B(9), NO_CALL, PASS, .spot = B(9), .may = MAY},

    /* ---- WPA, blackball */
    {"blackball 4b two past the middle", BB, {.opening = 1}, .first = 1, .after = 1,
     .past = B(3) | B(9), NO_CALL, PASS},
    {"blackball 4b one past the middle", BB, {.opening = 1}, .first = 1, .after = 4,
     .past = B(0) | B(3), .driven = 4, NO_CALL, PASS, BAULK, BREAK, .may = RACK | STAY, .free = 1},
    {"blackball 4b a ball is potted", BB, {.opening = 1}, .first = 1, .down = B(3), NO_CALL, KEEP},
    {"blackball 4d the black and the white", BB, {.opening = 1}, .first = 1, .down = B(8) | B(0),
     NO_CALL, KEEP, BAULK, LEGAL, 0xfffe},
    {"blackball 4b a new rack", BB, {.may = RACK | STAY, .free_ball = 1},
     .call = {CAROM_CALL_RACK, -1}, KEEP, BAULK, LEGAL, 0xfffe},
    {"blackball 4h played from where it lies", BB, {.may = STAY, .free_ball = 1},
     .call = {CAROM_CALL_STAY, -1}, KEEP, .free = 1},
    {"blackball 4e balls of both groups", BB, .first = 1, .down = B(1) | B(9), NO_CALL, KEEP},
    {"blackball 4f a miss in a free shot", BB, {.group = 1, .free_ball = 1}, .first = 9,
     .after = 1, NO_CALL, KEEP},
    {"blackball 4f the other group in a free shot", BB, {.group = 1, .free_ball = 1}, .first = 9,
     .down = B(9), NO_CALL, KEEP},
    {"blackball 5a in-off", BB, {.group = 1}, .first = 1, .down = B(0), NO_CALL, PASS, BAULK,
     CUE_BALL, .free = 1},
    {"blackball 5c the other's ball", BB, {.group = 1}, .first = 1, .down = B(9), NO_CALL, PASS,
     BAULK, POT, .may = STAY, .free = 1},
    {"blackball 5c with one's own", BB, {.group = 1}, .first = 1, .down = B(9) | B(1), NO_CALL,
     KEEP},
    {"blackball 5d no cushion", BB, {.group = 1}, .first = 1, NO_CALL, PASS, BAULK, CUSHION,
     .may = STAY, .free = 1},
    {"blackball 4k off the table", BB, {.group = 1}, .first = 1, .after = 1, .off = B(8), NO_CALL,
     PASS, BAULK, OFF, B(8), .may = STAY, .free = 1},
    {"blackball 8 towards a ball that touches", BB, {.group = 1}, .first = 2, .after = 1,
     .pushed = B(2), .frozen = B(2), NO_CALL, PASS, BAULK, DOUBLE_HIT, .may = STAY, .free = 1},
    {"blackball 8 away from a ball on that touches", BB, {.group = 1}, .first = 9, .after = 1,
     .frozen = B(2), NO_CALL, PASS},
    {"blackball 8 away from another ball that touches", BB, {.group = 1}, .first = 9, .after = 1,
     .frozen = B(10), NO_CALL, PASS, BAULK, FIRST, .may = STAY, .free = 1},
    {"blackball 8.13 a ball is jumped", BB, {.group = 1}, .first = 2, .after = 1, .jumped = B(9),
     NO_CALL, PASS, BAULK, JUMP, .may = STAY, .free = 1},
    {"blackball 6 the black too early", BB, {.group = 1}, .first = 1, .down = B(8), NO_CALL, LOSE},
    {"blackball 6 the black too early in a free shot", BB, {.group = 1, .free_ball = 1},
     .first = 8, .down = B(8), NO_CALL, LOSE},
    {"blackball 4s the black", BB, {.group = 1}, .in_play = B(0) | B(8) | B(9), .first = 8,
     .down = B(8), NO_CALL, WIN},
    {"blackball 4j the last ball and the black", BB, {.group = 1},
     .in_play = B(0) | B(1) | B(8) | B(9), .first = 1, .down = B(1) | B(8), NO_CALL, WIN},

    /* ---- Heyball */
    {"heyball 6 an illegal break", HEY, {.opening = 1}, .first = 1, .after = 3, .driven = 3,
     NO_CALL, PASS, AFTER, BREAK, .may = RACK | OTHER},
    {"heyball 6 the eight on the break", HEY, {.opening = 1}, .first = 1, .down = B(8), NO_CALL,
     KEEP, .spot = B(8), .may = RACK},
    {"heyball 8 a scratch on the break", HEY, {.opening = 1}, .first = 1, .down = B(0) | B(2),
     NO_CALL, PASS, KITCHEN, CUE_BALL},
    {"heyball 10 the group", HEY, .first = 3, .down = B(3), NO_CALL, KEEP},
    {"heyball 10 balls of both groups", HEY, .first = 3, .down = B(3) | B(12), NO_CALL, KEEP},
    {"heyball 11 nothing is called", HEY, {.group = 2}, .first = 9, .down = B(12), NO_CALL, KEEP},
    {"heyball 11 the other's ball", HEY, {.group = 2}, .first = 9, .down = B(2), NO_CALL, PASS},
    {"heyball 13 both at one instant", HEY, {.group = 2}, .first = 1, .with = B(9), .after = 1,
     NO_CALL, PASS},
    {"heyball 9 the wrong ball", HEY, {.group = 2}, .first = 1, .after = 1, NO_CALL, PASS,
     HAND_ANY, FIRST},
    {"heyball three fouls", HEY, {.group = 2, .fouls = {2, 0}}, .first = 1, .after = 1, NO_CALL,
     LOSE, HAND_ANY, FIRST},
    {"heyball the eight", HEY, {.group = 2}, .in_play = B(0) | B(8), .first = 8, .down = B(8),
     NO_CALL, WIN},
    {"heyball the last ball and the eight", HEY, {.group = 2}, .in_play = B(0) | B(8) | B(9),
     .first = 9, .down = B(8) | B(9), NO_CALL, LOSE},

    /* ---- BCA, rotation */
    {"BCA rotation: an open break", ROT, {.opening = 1}, .first = 1, .after = 4, .driven = 4,
     NO_CALL, PASS},
    {"BCA rotation: no open break", ROT, {.opening = 1}, .first = 1, .after = 3, .driven = 3,
     NO_CALL, PASS, KITCHEN, BREAK, .may = RACK},
    {"BCA rotation: a new rack", ROT, {.may = RACK}, .call = {CAROM_CALL_RACK, -1}, KEEP, KITCHEN,
     LEGAL, 0xfffe},
    {"BCA rotation: a ball counts its number", ROT, .first = 1, .down = B(15), NO_CALL, KEEP,
     .points = 15},
    {"BCA rotation: two balls", ROT, {.score = {10, 0}}, .first = 1, .down = B(1) | B(7), NO_CALL,
     KEEP, .points = 18},
    {"BCA rotation: not the lowest", ROT, .first = 2, .down = B(2), NO_CALL, PASS, AFTER, FIRST,
     B(2)},
    {"BCA rotation: scratch", ROT, .first = 1, .down = B(0) | B(5), NO_CALL, PASS, KITCHEN,
     CUE_BALL, B(5)},
    {"BCA rotation: off the table", ROT, .first = 1, .after = 1, .off = B(5), NO_CALL, PASS,
     AFTER, OFF, B(5)},
    {"BCA rotation: third foul", ROT, {.fouls = {2, 0}}, .first = 1, NO_CALL, LOSE, AFTER, CUSHION},
    {"BCA rotation: 61 points", ROT, {.score = {50, 30}}, .in_play = B(0) | B(11) | B(13),
     .first = 11, .down = B(11), NO_CALL, WIN, .points = 61},
    {"BCA rotation: 60 to 60, the last ball", ROT, {.score = {45, 60}}, .in_play = B(0) | B(15),
     .first = 15, .down = B(15), NO_CALL, WIN, .points = 60},

    /* ---- Free pyramid */
    {"pyramid 4 the opening: two to cushions", PYR, {.opening = 1}, .first = 1, .after = 2,
     .driven = 2, NO_CALL, PASS},
    {"pyramid 4 the opening: one", PYR, {.opening = 1}, .first = 1, .after = 1, .driven = 1,
     NO_CALL, PASS, AFTER, BREAK, .may = RACK, .points = 1},
    {"pyramid 4 a new rack", PYR, {.may = RACK, .score = {1, 0}}, .call = {CAROM_CALL_RACK, -1},
     KEEP, KITCHEN, LEGAL, 0xfffe, .points = 1},
    {"pyramid 5.2 a ball", PYR, .first = 4, .down = B(4), NO_CALL, KEEP, .points = 1},
    {"pyramid 5.3 none", PYR, .first = 4, .after = 1, NO_CALL, PASS},
    {"pyramid 5.4 the struck ball", PYR, .first = 4, .down = B(0), NO_CALL, KEEP, .points = 1},
    {"pyramid 5.5 another one too", PYR, .first = 4, .down = B(0) | B(7), NO_CALL, KEEP,
     .points = 2},
    {"pyramid 6 a foul: no ball", PYR, .down = B(0), NO_CALL, PASS, AFTER, NO_BALL, B(0),
     .points = 1},
    {"pyramid 6 a foul: off the table", PYR, .first = 4, .down = B(6), .off = B(4), NO_CALL, PASS,
     AFTER, OFF, B(4) | B(6), .points = 1},
    {"pyramid 5.6 no cushion", PYR, .first = 4, NO_CALL, PASS, AFTER, CUSHION, .points = 1},
    {"pyramid 1 eight points", PYR, {.score = {7, 7}}, .first = 4, .down = B(4), NO_CALL, WIN,
     .points = 8},
    {"pyramid 6 the last point by a foul", PYR, {.score = {5, 7}}, .first = 4, NO_CALL, LOSE,
     AFTER, CUSHION, .points = 8},

    /* ---- Four-ball */
    {"four-ball: both reds", FOUR, .met = B(2) | B(3), .first = 2, .second = 3, NO_CALL, KEEP,
     .points = 1},
    {"four-ball: one red", FOUR, .met = B(2), .first = 2, .after = 3, NO_CALL, PASS},
    {"four-ball: one red, no cushion", FOUR, .met = B(3), .first = 3, NO_CALL, PASS},
    {"four-ball: no red", FOUR, NO_CALL, PASS, AFTER, NO_BALL},
    {"four-ball: the other cue ball first", FOUR, .met = B(1) | B(2) | B(3), .first = 1,
     .second = 2, NO_CALL, PASS, AFTER, FIRST},
    {"four-ball: the other cue ball last", FOUR, .met = B(1) | B(2) | B(3), .first = 2,
     .second = 3, NO_CALL, PASS, AFTER, OTHER_RULE},
    {"four-ball: the opening meets the far red", FOUR, {.opening = 1}, .met = B(2) | B(3),
     .first = 3, .second = 2, NO_CALL, KEEP, .points = 1},
    {"four-ball: the opening meets the near red", FOUR, {.opening = 1}, .met = B(2) | B(3),
     .first = 2, .second = 3, NO_CALL, PASS, AFTER, FIRST},
    {"four-ball: off the table", FOUR, .met = B(2) | B(3), .first = 2, .second = 3, .off = B(3),
     NO_CALL, PASS, AFTER, OFF, B(3)},
    {"four-ball: a double hit", FOUR, .met = B(2) | B(3), .first = 2, .second = 3, .touches = 2,
     NO_CALL, PASS, AFTER, DOUBLE_HIT},
    {"four-ball: the last point", FOUR, {.target = 10, .score = {11, 3}, .lost = {2, 0}},
     .met = B(2) | B(3), .first = 2, .second = 3, NO_CALL, WIN, .points = 12},
    {"four-ball: a point less", FOUR, {.target = 10, .score = {11, 3}, .lost = {3, 0}},
     .met = B(2) | B(3), .first = 2, .second = 3, NO_CALL, KEEP, .points = 12},

    /* ---- BCA, cowboy */
    {"BCA cowboy: the opening meets the 3", COW, {.opening = 1}, .first = 2, .after = 1, NO_CALL,
     PASS},
    {"BCA cowboy: the opening meets another", COW, {.opening = 1}, .first = 3, .after = 1,
     NO_CALL, PASS, AFTER, FIRST, .may = RACK | OTHER},
    {"BCA cowboy: he has it repeated", COW, {.may = RACK | OTHER}, .call = {CAROM_CALL_OTHER_RACK,
     -1}, PASS, KITCHEN, LEGAL, 0xe},
    {"BCA cowboy: two balls", COW, .first = 2, .met = B(1) | B(2), NO_CALL, KEEP, .points = 1},
    {"BCA cowboy: three balls, and all potted", COW, .first = 2, .met = B(1) | B(2) | B(3),
     .down = 0xe, NO_CALL, KEEP, .spot = 0xe, .points = 11},
    {"BCA cowboy: one ball", COW, .first = 2, .met = B(2), .after = 1, NO_CALL, PASS},
    {"BCA cowboy: ninety exactly", COW, {.score = {87, 0}}, .first = 2, .met = B(2), .down = B(2),
     NO_CALL, KEEP, .spot = B(2), .points = 90},
    {"BCA cowboy: past ninety", COW, {.score = {88, 0}, .lost = {5, 0}}, .first = 2, .met = B(2),
     .down = B(2), NO_CALL, PASS, AFTER, OTHER_RULE, B(2), .points = 83},
    {"BCA cowboy: from ninety a ball counts nothing", COW, {.score = {90, 0}}, .first = 2,
     .met = B(2), .down = B(2), NO_CALL, PASS, .spot = B(2), .points = 90},
    {"BCA cowboy: a scratch costs the visit", COW, {.score = {40, 0}, .lost = {9, 0}}, .first = 2,
     .met = B(1) | B(2), .down = B(0), NO_CALL, PASS, KITCHEN, CUE_BALL, .points = 31},
    {"BCA cowboy: the last point", COW, {.score = {100, 0}}, .first = 1, .met = B(1),
     .down = B(0), .pocket = 4, .call = {1, 4}, WIN},
    {"BCA cowboy: the last point, not called", COW, {.score = {100, 0}}, .first = 1, .met = B(1),
     .down = B(0), .pocket = 4, .call = {1, 3}, PASS, KITCHEN, CUE_BALL, .points = 100},
    {"BCA cowboy: the last point, another ball", COW, {.score = {100, 0}}, .first = 1,
     .met = B(1) | B(2), .down = B(0), .pocket = 4, .call = {1, 4}, PASS, KITCHEN, CUE_BALL,
     .points = 100},
};
/* clang-format on */

static uint32_t balls_of(int game) {
  if (game == SN)
    return frame;
  const int rack = carom_rules_about_of((carom_rules_kind)game)->rack;
  return (UINT32_C(1) << carom_rack_size((carom_rack_kind)rack)) - 1;
}

static carom_facts facts_of_row(const situation *row) {
  carom_facts f = facts_of(row->first > 0 ? row->first : -1, row->after, row->down, row->off);
  f.first_set = row->first > 0 ? B(row->first) | row->with : 0;
  f.first[1] = row->second > 0 ? row->second : -1;
  f.cushions_before[1] = row->cushions;
  f.pushed = row->pushed;
  f.frozen = row->frozen;
  f.barred = row->barred;
  f.jumped = row->jumped;
  f.touches = row->touches;
  f.second_time = row->touches > 1 ? 0.01 : INFINITY;
  f.past_middle = row->past;
  f.at_head = row->head;

  /* the balls that were met, the first two in their order */
  int n = 0;
  const uint32_t two = f.first[1] >= 0 ? B(row->first) | B(row->second) : f.first_set;
  for (int i = 0; i < 2; i++)
    if (f.first[i] >= 0)
      f.order[n++] = f.first[i];
  for (int k = 0; k < 4; k++)
    if ((row->met & ~two) >> k & 1)
      f.order[n++] = k;
  while (n < CAROM_BALLS_MOST)
    f.order[n++] = -1;
  for (int k = 0; k < CAROM_BALLS_MOST; k++) {
    f.pocket[k] = row->down >> k & 1 ? row->pocket : -1;
    f.cushions[k] = k >= 1 && k <= row->driven;
  }
  return f;
}

static void check_row(const situation *row) {
  carom_plan_rules of = carom_plan_rules_of((carom_rules_kind)row->game);
  of.state = row->state;
  const carom_facts facts = facts_of_row(row);
  const uint32_t in_play = row->in_play != 0 ? row->in_play : balls_of(row->game);
  const carom_turn turn = of.judge(&of.state, in_play, 0, &facts, row->call);
  ruled(row->section, &turn, row->outcome, row->leave, row->foul, row->spot);
  ck_assert_msg(of.state.may == row->may, "%s: may %d", row->section, of.state.may);
  ck_assert_msg(row->game == SN || of.state.free_ball == row->free, "%s: free %d", row->section,
                of.state.free_ball);
  const bool of_next = row->game == SN || row->game == PYR;
  const int whose = of_next ? 0 : (int)turn.outcome == PASS;
  if (row->points > 0)
    ck_assert_msg(of.state.score[whose] == row->points, "%s: %d points", row->section,
                  of.state.score[whose]);
}

TEST(situations) {
  const int count = sizeof rows / sizeof rows[0];
  ck_assert_int_ge(count, 60);
  for (int k = 0; k < count; k++)
    check_row(&rows[k]);
  for (size_t k = 0; k < sizeof games_of_2026 / sizeof games_of_2026[0]; k++)
    check_row(&games_of_2026[k]);
}

/* BCA, cowboy: a ball whose spot is taken stays off until it is free; and all balls come back where
 * that is the 1 and the player needs the last point. */
TEST(spots_of_cowboy) {
  enum { ACE = 1, TREY = 2 };
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_ruling ruling;
  double foot[2], head[2];
  const int count = lay_out(CAROM_RACK_COWBOY, CAROM_TABLE_POOL_9FT, 0xf);
  carom_spot_of(CAROM_RACK_COWBOY, &table, TREY, foot);
  carom_spot_of(CAROM_RACK_COWBOY, &table, ACE, head);
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_COWBOY);

  /* the cue ball comes to lie on the foot spot */
  carom_facts facts = facts_of(TREY, 1, B(TREY), 0);
  const carom_shot shot = {.facts = &facts, .final = final};
  put(0, foot[0] + 0.01, foot[1]);
  for (int k = 0; k < count; k++)
    final[k] = balls[k].state;
  final[TREY].label = CAROM_BALL_POCKETED;
  carom_referee(&of, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling);
  ck_assert_int_eq(ruling.balls[TREY].state.label, CAROM_BALL_POCKETED);

  /* and leaves it */
  memcpy(balls, ruling.balls, sizeof balls);
  put(0, foot[0] + 0.3, foot[1]);
  for (int k = 0; k < count; k++)
    final[k] = balls[k].state;
  facts = facts_of(ACE, 1, 0, 0);
  carom_referee(&of, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling);
  ck_assert(ruling.balls[TREY].state.label == CAROM_BALL_STATIONARY &&
            fabs(ruling.balls[TREY].state.r[1] - foot[1]) < 1e-9);

  /* the spot of the 1 is taken, and the other has 100 points */
  of.state.score[1] = 100;
  lay_out(CAROM_RACK_COWBOY, CAROM_TABLE_POOL_9FT, 0xf);
  put(0, head[0] + 0.01, head[1]);
  put(TREY, 0.3, 0.3);
  for (int k = 0; k < count; k++)
    final[k] = balls[k].state;
  final[ACE].label = CAROM_BALL_POCKETED;
  facts = facts_of(TREY, 1, 0, B(ACE));
  carom_referee(&of, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling);
  ck_assert(ruling.turn.leave == CAROM_LEAVE_KITCHEN && ruling.on == B(ACE));
  ck_assert(fabs(ruling.balls[TREY].state.r[1] - foot[1]) < 1e-9);
}

/* Blackball's groups: one that falls alone decides, of both none, and no free stroke does. */
TEST(groups_of_blackball) {
  static const struct {
    uint32_t down;
    int free, group;
  } given[] = {{B(3), 0, 1}, {B(9) | B(10), 0, 2}, {B(3) | B(9), 0, 0}, {B(3), 1, 0}};
  for (int k = 0; k < 4; k++) {
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_BLACKBALL);
    of.state = (carom_rules_state){.free_ball = given[k].free};
    const carom_facts facts = facts_of(3, 1, given[k].down, 0);
    of.judge(&of.state, 0xffff, 0, &facts, (carom_call){-1, -1});
    ck_assert_int_eq(of.state.group, given[k].group);
  }
}

/* WPA 1.4: a spotted ball is frozen to the one before it, not to the cue ball; in snooker it
 * touches none. */
TEST(spotted_balls_touch) {
  static const struct {
    carom_rack_kind rack;
    int ball, there;
    bool frozen;
  } given[] = {{CAROM_RACK_EIGHTBALL, 3, 5, true},
               {CAROM_RACK_EIGHTBALL, 3, 0, false},
               {CAROM_RACK_SNOOKER, 1, 5, false}};
  for (int k = 0; k < 3; k++)
    for (int n = -20; n <= 20; n++) {
      const bool snooker = given[k].rack == CAROM_RACK_SNOOKER;
      const int count =
          lay_out(given[k].rack, snooker ? CAROM_TABLE_SNOOKER : CAROM_TABLE_POOL_9FT, 0);
      double at[2];
      carom_spot_of(given[k].rack, &table, given[k].ball, at);
      put(given[k].there, at[0] + 0.001 * n, at[1] + 0.0004 * n);
      ck_assert_int_eq(carom_spot_ball_of(given[k].rack, &table, balls, count, given[k].ball),
                       CAROM_OK);
      const double *a = balls[given[k].ball].state.r, *b = balls[given[k].there].state.r;
      const double gap = hypot(a[0] - b[0], a[1] - b[1]) - balls[0].kind.radius * 2.0;
      ck_assert_msg(given[k].frozen ? gap >= 0.0 && gap < 1e-12
                                    : gap > CAROM_RULES_TOUCH && gap < 4.0 * CAROM_RULES_TOUCH,
                    "%d, %d: %g m", k, n, gap);
    }
}

/* What a shot tells: the balls met in order, those of the first instant, where the cue ball was and
 * how far it came; and a ball that lies 0.05 mm from it touches it. */
TEST(facts_of_a_split_hit) {
  const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0);
  const double R = balls[0].kind.radius, x = 0.5 * table.width;
  put(0, x, 0.8);
  put(9, x - 1.2 * R, 1.2);
  put(1, x + 1.2 * R, 1.2);
  put(4, x, 0.8 - 2.0 * R - 0.5 * CAROM_RULES_TOUCH);
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.phi = 90.0;
  cue.speed = 2.0;
  carom_facts facts;
  carom_shot shot = {.facts = &facts};
  ck_assert_int_eq(carom_shoot(&table, balls, count, &cue, NULL, &shot), CAROM_OK);
  ck_assert_uint_eq(facts.first_set, B(1) | B(9));
  ck_assert_uint_eq(facts.frozen, B(4));
  ck_assert((facts.order[0] == 1 && facts.order[1] == 9) ||
            (facts.order[0] == 9 && facts.order[1] == 1));
  const double y = 1.2 - sqrt(4.0 * R * R - 1.44 * R * R);
  ck_assert_double_eq_tol(facts.first_place[1], y, 1e-6);
  ck_assert_double_eq_tol(facts.first_low[1], 0.8, 1e-9);
  ck_assert_double_eq_tol(facts.first_high[1], y, 1e-6);
}
