/* Situations of the rules, a row each with its section: the World Standardized Rules of the WPA
 * (2016; 1 general, 2 nine-ball, 3 eight-ball, 4 straight pool, 6 fouls), the rules of the WPBSA
 * (section 3, by the titles of its rules), the BCA's one-pocket and bank pool, and the UMB's world
 * rules of carom billiard (articles). A row has what a shot did and what the ruling must be. */
#include "game_support.h"

enum { E = CAROM_RULES_EIGHTBALL, N = CAROM_RULES_NINEBALL, ST = CAROM_RULES_STRAIGHT };
enum { SN = CAROM_RULES_SNOOKER, ONE = CAROM_RULES_ONEPOCKET, BANK = CAROM_RULES_BANK };
enum { THREE = CAROM_RULES_THREECUSHION, RAIL = CAROM_RULES_STRAIGHTRAIL };
enum { HAND_ANY = CAROM_LEAVE_HAND };
enum { RACK = CAROM_MAY_RACK, OTHER = CAROM_MAY_OTHER_RACK, STAY = CAROM_MAY_STAY };
enum { PUSH = CAROM_MAY_PUSH, SPOT = CAROM_MAY_SPOT };

#define B(k) (UINT32_C(1) << (k))
static const uint32_t all15 = 0xffff, nine9 = 0x3ff, frame = 0x3fffff;

typedef struct situation {
  const char *section;
  int game;
  carom_rules_state state;
  uint32_t in_play; /* 0: all balls of the game */
  int first;        /* met; 0: none */
  uint32_t with;    /* balls met at the same instant */
  int after;        /* cushions after the first contact */
  uint32_t down, off, pushed, frozen, barred;
  int driven, pocket;    /* balls 1 to driven met a cushion; the pocket of all that fell */
  int touches, cushions; /* of the tip; of the cue ball before the second ball */
  int second;            /* the second ball that was met; 0: none */
  carom_call call;
  int is, leave, foul;
  uint32_t spot;
  int may, points; /* points: of the other in snooker after a foul, else of the player */
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

static uint32_t balls_of(int game) {
  if (game == N)
    return nine9;
  if (game == SN)
    return frame;
  return game == THREE || game == RAIL ? 7 : all15;
}

static carom_facts facts_of_row(const situation *row) {
  carom_facts f = facts_of(row->first > 0 ? row->first : -1, row->after, row->down, row->off);
  f.first_set = row->first > 0 ? B(row->first) | row->with : 0;
  f.first[1] = row->second > 0 ? row->second : -1;
  f.cushions_before[1] = row->cushions;
  f.pushed = row->pushed;
  f.frozen = row->frozen;
  f.barred = row->barred;
  f.touches = row->touches;
  f.second_time = row->touches > 1 ? 0.01 : INFINITY;
  for (int k = 0; k < CAROM_BALLS_MOST; k++) {
    f.pocket[k] = row->down >> k & 1 ? row->pocket : -1;
    f.cushions[k] = k >= 1 && k <= row->driven;
  }
  return f;
}

TEST(situations) {
  const int count = sizeof rows / sizeof rows[0];
  ck_assert_int_ge(count, 60);
  for (int k = 0; k < count; k++) {
    const situation *row = &rows[k];
    carom_plan_rules of = carom_plan_rules_of((carom_rules_kind)row->game);
    of.state = row->state;
    const carom_facts facts = facts_of_row(row);
    const uint32_t in_play = row->in_play != 0 ? row->in_play : balls_of(row->game);
    const carom_turn turn = of.judge(&of.state, in_play, 0, &facts, row->call);
    ruled(row->section, &turn, row->is, row->leave, row->foul, row->spot);
    ck_assert_msg(of.state.may == row->may, "%s: may %d", row->section, of.state.may);
    const int passed = (int)turn.is == PASS;
    const int whose = row->game == SN ? 0 : passed;
    if (row->points > 0)
      ck_assert_msg(of.state.score[whose] == row->points, "%s: %d points", row->section,
                    of.state.score[whose]);
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
