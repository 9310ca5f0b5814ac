/* Straight pool, snooker and one-pocket: every branch of their rules beside rulings written down,
 * places of balls that come back, free balls, and whole games that no machine changes. */
#include "carom_plan.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  KEEP = CAROM_TURN_KEEP,
  PASS = CAROM_TURN_PASS,
  WIN = CAROM_TURN_WIN,
  LOSE = CAROM_TURN_LOSE
};
enum { AFTER = CAROM_LEAVE_AFTER, KITCHEN = CAROM_LEAVE_KITCHEN, D = CAROM_LEAVE_D };
enum {
  LEGAL = CAROM_FOUL_NONE,
  CUE_BALL = CAROM_FOUL_CUE_BALL,
  NO_BALL = CAROM_FOUL_NO_BALL,
  FIRST = CAROM_FOUL_FIRST,
  OFF = CAROM_FOUL_OFF,
  CUSHION = CAROM_FOUL_CUSHION,
  BREAK = CAROM_FOUL_BREAK,
  POT = CAROM_FOUL_POT,
  DOUBLE_HIT = CAROM_FOUL_DOUBLE_HIT
};
enum { BALLS_MOST = 22, NO_CALL = -1 };

/* A shot whose cue ball met `first`; all that fell is in pocket 2. */
static carom_facts facts_of(int first, int cushions, uint32_t down, uint32_t off) {
  carom_facts f = {.first = {first, -1}, .cushions_after = cushions, .down = down, .off = off};
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    f.pocket[k] = down >> k & 1 ? 2 : -1;
  return f;
}

/* ---- Straight pool */

typedef struct straight_case {
  const char *what;
  uint32_t in_play;
  int first, cushions;
  uint32_t down, off;
  int call, pocket;
  /* before: points of pots, points lost, fouls in a row */
  int pots, lost, fouls;
  /* after, of the one who played */
  int is, leave, foul;
  uint32_t spot;
  int pots_after, lost_after, fouls_after;
} straight_case;

static const straight_case straight[] = {
    {"a called ball", 0xffff, 3, 0, 0x0008, 0, 3, 2, 4, 1, 2, KEEP, AFTER, 0, 0, 5, 1, 0},
    {"with two others", 0xffff, 3, 0, 0x0308, 0, 3, 2, 4, 0, 0, KEEP, AFTER, 0, 0, 7, 0, 0},
    {"by another ball first", 0xffff, 9, 0, 0x0008, 0, 3, 2, 0, 0, 0, KEEP, AFTER, 0, 0, 1, 0, 0},
    {"in another pocket", 0xffff, 3, 0, 0x0008, 0, 3, 1, 4, 0, 1, PASS, AFTER, 0, 8, 4, 0, 0},
    {"another ball than called", 0xffff, 3, 0, 0x0010, 0, 3, 2, 4, 0, 0, PASS, AFTER, 0, 0x10, 4, 0,
     0},
    {"a safety that pots", 0xffff, 3, 0, 0x0010, 0, NO_CALL, -1, 4, 0, 0, PASS, AFTER, 0, 0x10, 4,
     0, 0},
    {"a safety to a cushion", 0xffff, 3, 1, 0, 0, NO_CALL, -1, 4, 0, 2, PASS, AFTER, 0, 0, 4, 0, 0},
    {"no cushion", 0xffff, 3, 0, 0, 0, 3, 2, 4, 0, 0, PASS, AFTER, CUSHION, 0, 4, 1, 1},
    {"no ball met", 0xffff, -1, 0, 0, 0, 3, 2, 4, 3, 1, PASS, AFTER, NO_BALL, 0, 4, 4, 2},
    {"the cue ball falls", 0xffff, 3, 0, 0x0001, 0, 3, 2, 4, 0, 0, PASS, KITCHEN, CUE_BALL, 0, 4, 1,
     1},
    {"with the called ball", 0xffff, 3, 0, 0x0009, 0, 3, 2, 4, 0, 0, PASS, KITCHEN, CUE_BALL, 8, 4,
     1, 1},
    {"the cue ball leaves the table", 0xffff, 3, 1, 0, 0x0001, 3, 2, 4, 0, 0, PASS, KITCHEN,
     CUE_BALL, 0, 4, 1, 1},
    {"a ball leaves the table", 0xffff, 3, 1, 0, 0x0010, 3, 2, 4, 0, 0, PASS, AFTER, OFF, 0x10, 4,
     1, 1},
    {"while the called one falls", 0xffff, 3, 1, 0x0008, 0x0010, 3, 2, 4, 0, 0, PASS, AFTER, OFF,
     0x18, 4, 1, 1},
    {"a third foul", 0xffff, -1, 0, 0, 0, 3, 2, 4, 2, 2, KEEP, KITCHEN, NO_BALL, 0xfffe, 4, 18, 0},
    {"the fourteenth ball", 0x0007, 1, 0, 0x0002, 0, 1, 2, 40, 0, 0, KEEP, AFTER, 0, 0xfffa, 41, 0,
     0},
    {"the last two at once", 0x0007, 1, 0, 0x0006, 0, 1, 2, 40, 0, 0, KEEP, AFTER, 0, 0xfffe, 42, 0,
     0},
    {"one of two, not called", 0x0007, 1, 0, 0x0002, 0, 2, 2, 40, 0, 0, PASS, AFTER, 0, 2, 40, 0,
     0},
    {"one of three", 0x000f, 1, 0, 0x0002, 0, 1, 2, 40, 0, 0, KEEP, AFTER, 0, 0, 41, 0, 0},
    {"the last point", 0xffff, 3, 0, 0x0008, 0, 3, 2, 99, 0, 0, WIN, AFTER, 0, 0, 100, 0, 0},
    {"points lost do not count", 0xffff, 3, 0, 0x0008, 0, 3, 2, 99, 1, 0, KEEP, AFTER, 0, 0, 100, 1,
     0},
    {"more than enough", 0xffff, 3, 0, 0x0038, 0, 3, 2, 99, 1, 0, WIN, AFTER, 0, 0, 102, 1, 0},
};

TEST(straight_rulings) {
  for (size_t k = 0; k < sizeof straight / sizeof straight[0]; k++) {
    const straight_case *c = &straight[k];
    const carom_facts facts = facts_of(c->first, c->cushions, c->down, c->off);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
    ck_assert_uint_eq(of.user[0], 100);
    /* those of the other are told apart */
    of.user[2] = (uint64_t)c->pots;
    of.user[3] = 51;
    of.user[5] = (uint64_t)c->lost;
    of.user[6] = 7;
    of.user[7] = (uint64_t)c->fouls + 4 * 1;
    const carom_turn turn =
        of.judge(of.user, c->in_play, 0, &facts, (carom_call){c->call, c->pocket});
    const bool gives = c->is == PASS;
    ck_assert_msg((int)turn.is == c->is && (int)turn.leave == c->leave && turn.foul == c->foul &&
                      turn.spot == c->spot,
                  "%s: turn %d, leave %d, foul %d, spot %x", c->what, (int)turn.is, (int)turn.leave,
                  turn.foul, turn.spot);
    ck_assert_msg(
        of.user[gives ? 3 : 2] == (uint64_t)c->pots_after && of.user[gives ? 2 : 3] == 51 &&
            of.user[gives ? 6 : 5] == (uint64_t)c->lost_after && of.user[gives ? 5 : 6] == 7,
        "%s: points", c->what);
    const uint64_t fouls = (uint64_t)c->fouls_after;
    ck_assert_msg(of.user[7] == (gives ? 1 + 4 * fouls : fouls + 4), "%s: fouls", c->what);
    ck_assert_msg(turn.points == (double)(c->pots_after - c->pots), "%s: points", c->what);
    ck_assert_uint_eq(of.user[1], c->fouls == 2 && c->lost_after == c->lost + 16);
  }
}

/* The opening break: which are legal, what others cost, and that they may be asked for again. */
TEST(straight_breaks) {
  static const struct {
    const char *what;
    int cue_cushions, cue_before, driven;
    uint32_t down;
    int call, is, leave, foul, lost;
    uint32_t spot;
    bool again;
  } given[] = {
      {"two balls and the cue ball", 1, 0, 2, 0, NO_CALL, PASS, AFTER, 0, 0, 0, false},
      {"one ball and the cue ball", 1, 0, 1, 0, NO_CALL, PASS, AFTER, BREAK, 2, 0, true},
      {"without the cue ball", 0, 0, 5, 0, NO_CALL, PASS, AFTER, BREAK, 2, 0, true},
      {"the cue ball before the rack only", 1, 1, 5, 0, NO_CALL, PASS, AFTER, BREAK, 2, 0, true},
      {"a called ball", 0, 0, 0, 0x8, 3, KEEP, AFTER, 0, 0, 0, false},
      {"a ball that was not called", 0, 0, 1, 0x8, 4, PASS, AFTER, BREAK, 2, 0x8, true},
      {"the same, of a legal break", 1, 0, 3, 0x8, 4, PASS, AFTER, 0, 0, 0x8, false},
      {"the cue ball falls, legal else", 1, 0, 3, 0x1, NO_CALL, PASS, KITCHEN, CUE_BALL, 1, 0,
       false},
      {"the cue ball falls, bad too", 0, 0, 1, 0x1, NO_CALL, PASS, KITCHEN, CUE_BALL, 2, 0, true},
  };
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_facts facts = facts_of(1, 4, given[k].down, 0);
    facts.cushions[0] = given[k].cue_cushions;
    facts.cushions_before[0] = given[k].cue_before;
    for (int i = 1; i <= given[k].driven; i++)
      facts.cushions[i] = 1;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
    of.user[1] = 1;
    const carom_turn turn = of.judge(of.user, 0xffff, 0, &facts, (carom_call){given[k].call, 2});
    ck_assert_msg((int)turn.is == given[k].is && (int)turn.leave == given[k].leave &&
                      turn.foul == given[k].foul && turn.spot == given[k].spot,
                  "%s: turn %d, leave %d, foul %d, spot %x", given[k].what, (int)turn.is,
                  (int)turn.leave, turn.foul, turn.spot);
    ck_assert_msg(of.user[6] == (uint64_t)given[k].lost && of.user[1] == 0, "%s", given[k].what);
    ck_assert_uint_eq(of.may(of.user), given[k].again ? CAROM_MAY_PASS : 0);
    /* a bad break is no foul in a row */
    ck_assert_uint_eq(of.user[7], given[k].lost == 1 ? 4 : 0);
    if (!given[k].again)
      continue;

    /* the other has it played again: he who broke breaks once more */
    const carom_facts none = {.first = {-1, -1}};
    carom_plan_rules after = of;
    const carom_turn asked =
        after.judge(after.user, 0xffff, 0, &none, (carom_call){CAROM_CALL_PASS, -1});
    ck_assert(asked.is == CAROM_TURN_PASS && asked.foul == 0 && asked.leave == CAROM_LEAVE_KITCHEN);
    ck_assert(asked.spot == 0xfffe && after.user[1] == 1 && after.user[5] == 2);
    ck_assert_uint_eq(after.may(after.user), 0);
  }
}

static carom_table table;
static carom_shot_ball balls[CAROM_BALLS_MOST];

/* All balls of a rack, of which those that are not in play are down. */
static int lay_out(carom_rack_kind kind, carom_table_kind of, uint32_t in_play) {
  const int count = carom_rack_size(kind);
  carom_table_make(of, &table);
  ck_assert_int_eq(carom_rack(kind, &table, 1e-4, 1, balls, CAROM_BALLS_MOST), CAROM_OK);
  for (int k = 0; k < count; k++)
    if (!(in_play >> k & 1))
      balls[k].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
  return count;
}
static void put(int ball, double x, double y) {
  balls[ball].state =
      (carom_ball_state){.r = {x, y, balls[ball].kind.radius}, .label = CAROM_BALL_STATIONARY};
}
static bool is_at(int ball, double x, double y) {
  return balls[ball].state.label == CAROM_BALL_STATIONARY &&
         hypot(balls[ball].state.r[0] - x, balls[ball].state.r[1] - y) < 1e-9;
}

/* New racks, by where the cue ball and the fifteenth lie: those stay, or go to the head spot, to
 * the centre, into hand. */
TEST(straight_racks) {
  enum { STAYS, HEAD, CENTRE, HAND, RACKED };
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  const double w = table.width, l = table.length, x = 0.5 * w;
  const double rack_y = 0.75 * l + 0.08, head_y = 0.25 * l;
  const struct {
    const char *what;
    double last[2], cue[2];
    int last_goes, cue_goes;
  } given[] = {
      {"none in the rack", {0.2, 1.5}, {0.3, 1.0}, STAYS, STAYS},
      {"the fifteenth in it", {x, rack_y}, {0.3, 1.0}, HEAD, STAYS},
      {"the fifteenth in it, the cue ball on the head spot",
       {x, rack_y},
       {x + 0.01, head_y},
       CENTRE,
       STAYS},
      {"both in it", {x - 0.06, rack_y + 0.06}, {x, rack_y}, RACKED, HAND},
      {"the cue ball in it", {0.2, 1.5}, {x, rack_y}, STAYS, HAND},
      {"the cue ball in it, the fifteenth behind the head string",
       {0.2, 0.3},
       {x, rack_y},
       STAYS,
       HEAD},
      {"the cue ball in it, the fifteenth on the head spot",
       {x, head_y + 0.01},
       {x, rack_y},
       STAYS,
       CENTRE},
      {"the cue ball on the front place", {0.2, 1.5}, {x, 0.75 * l}, STAYS, HAND},
  };
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const int last = 9, count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 1 | 1u << 9);
    put(0, given[k].cue[0], given[k].cue[1]);
    put(last, given[k].last[0], given[k].last[1]);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
    carom_turn turn = {.is = CAROM_TURN_KEEP, .spot = 0xfffe & ~(1u << last)};
    ck_assert_int_eq(carom_turn_settle(&of, of.user, &table, balls, count, &turn), CAROM_OK);
    const double *at[2] = {given[k].cue, given[k].last};
    const int goes[2] = {given[k].cue_goes, given[k].last_goes}, who[2] = {0, last};
    for (int n = 0; n < 2; n++)
      ck_assert_msg(goes[n] == STAYS    ? is_at(who[n], at[n][0], at[n][1])
                    : goes[n] == HEAD   ? is_at(who[n], x, head_y)
                    : goes[n] == CENTRE ? is_at(who[n], x, 0.5 * l)
                    : goes[n] == HAND   ? balls[0].state.label == CAROM_BALL_POCKETED
                                        : turn.spot == 0xfffe,
                    "%s: ball %d", given[k].what, who[n]);
    ck_assert_msg((turn.leave == CAROM_LEAVE_KITCHEN) == (goes[0] == HAND), "%s", given[k].what);

    /* all lie, close together, and the front place is taken by the fifteenth alone */
    int front = 0, racked = 0;
    for (int i = 1; i < 16; i++) {
      const double *r = balls[i].state.r;
      ck_assert(balls[i].state.label == CAROM_BALL_STATIONARY);
      front += fabs(r[1] - 0.75 * l) < 1e-9;
      racked += r[1] > 0.75 * l - 1e-9 && r[1] < 0.75 * l + 0.22 && fabs(r[0] - x) < 0.13;
    }
    ck_assert_int_eq(front, goes[1] == RACKED);
    ck_assert_int_eq(racked, goes[1] == RACKED ? 15 : 14);
    if (goes[0] != HAND)
      ck_assert_int_eq(carom_shot_check(&table, balls, count, NULL, NULL, NULL), CAROM_OK);
  }

  /* the last two at once: all 15, the cue ball where it is */
  const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 1);
  put(0, 0.3, 1.0);
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
  carom_turn turn = {.is = CAROM_TURN_KEEP, .spot = 0xfffe};
  ck_assert_int_eq(carom_turn_settle(&of, of.user, &table, balls, count, &turn), CAROM_OK);
  ck_assert(is_at(0, 0.3, 1.0) && turn.leave == CAROM_LEAVE_AFTER && is_at(1, x, 0.75 * l));
  /* a ball that comes back alone goes to the foot spot */
  lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 3);
  put(1, 0.2, 0.3);
  turn = (carom_turn){.is = CAROM_TURN_PASS, .spot = 0x20};
  ck_assert_int_eq(carom_turn_settle(&of, of.user, &table, balls, count, &turn), CAROM_OK);
  ck_assert(is_at(5, x, 0.75 * l));
}

/* ---- Snooker */

enum { R1 = 1 << 1, R2 = 1 << 2, Y = 1 << 16, G = 1 << 17, BR = 1 << 18, BL = 1 << 19 };
enum { PI = 1 << 20, BK = 1 << 21, COLOURS = Y | G | BR | BL | PI | BK, ALL = 0x3fffff };
enum { YELLOW = 16, GREEN, BROWN, BLUE, PINK, BLACK };
enum { MAY_PASS = 1, FREE = 2, HAND = 4 };

typedef struct snooker_case {
  const char *what;
  uint32_t in_play;
  int colour, after_foul, first;
  uint32_t down, off;
  int call;
  int is, leave, foul, own, other; /* points made, by each */
  uint32_t spot;
  int colour_next, after_foul_next;
} snooker_case;

static const snooker_case snooker[] = {
    {"a red", ALL, 0, 0, 1, R1, 0, 1, KEEP, AFTER, 0, 1, 0, 0, 1, 0},
    {"two reds", ALL, 0, 0, 3, R1 | R2, 0, NO_CALL, KEEP, AFTER, 0, 2, 0, 0, 1, 0},
    {"a miss at the reds", ALL, 0, 0, 1, 0, 0, 1, PASS, AFTER, 0, 0, 0, 0, 0, 0},
    {"a red without a cushion is none", ALL, 0, 0, 2, 0, 0, NO_CALL, PASS, AFTER, 0, 0, 0, 0, 0, 0},
    {"no ball, on reds", ALL, 0, 0, -1, 0, 0, NO_CALL, PASS, AFTER, NO_BALL, 0, 4, 0, 0, MAY_PASS},
    {"the yellow first, on reds", ALL, 0, 0, YELLOW, 0, 0, 1, PASS, AFTER, FIRST, 0, 4, 0, 0,
     MAY_PASS},
    {"the black first, on reds", ALL, 0, 0, BLACK, 0, 0, 1, PASS, AFTER, FIRST, 0, 7, 0, 0,
     MAY_PASS},
    {"the black falls, on reds", ALL, 0, 0, 1, BK, 0, 1, PASS, AFTER, POT, 0, 7, BK, 0, MAY_PASS},
    {"a red and the blue", ALL, 0, 0, 1, R1 | BL, 0, 1, PASS, AFTER, POT, 0, 5, BL, 0, MAY_PASS},
    {"a red and the cue ball", ALL, 0, 0, 1, R1 | 1, 0, 1, PASS, D, CUE_BALL, 0, 4, 0, 0,
     MAY_PASS | HAND},
    {"the cue ball leaves the table", ALL, 0, 0, 1, 0, 1, 1, PASS, D, CUE_BALL, 0, 4, 0, 0,
     MAY_PASS | HAND},
    {"a red leaves the table", ALL, 0, 0, 1, 0, R2, 1, PASS, AFTER, OFF, 0, 4, 0, 0, MAY_PASS},
    {"the pink leaves the table", ALL, 0, 0, 1, 0, PI, 1, PASS, AFTER, OFF, 0, 6, PI, 0, MAY_PASS},

    {"the black after a red", ALL & ~R1, 1, 0, BLACK, BK, 0, BLACK, KEEP, AFTER, 0, 7, 0, BK, 0, 0},
    {"a colour without a call", ALL & ~R1, 1, 0, BLUE, BL, 0, NO_CALL, KEEP, AFTER, 0, 5, 0, BL, 0,
     0},
    {"another colour than named", ALL & ~R1, 1, 0, BLUE, BL, 0, BLACK, PASS, AFTER, FIRST, 0, 7, BL,
     0, MAY_PASS},
    {"the black first, the yellow named", ALL & ~R1, 1, 0, BLACK, 0, 0, YELLOW, PASS, AFTER, FIRST,
     0, 7, 0, 0, MAY_PASS},
    {"a red first, the yellow named", ALL & ~R1, 1, 0, 2, 0, 0, YELLOW, PASS, AFTER, FIRST, 0, 4, 0,
     0, MAY_PASS},
    {"two colours", ALL & ~R1, 1, 0, GREEN, G | PI, 0, GREEN, PASS, AFTER, POT, 0, 6, G | PI, 0,
     MAY_PASS},
    {"a red with the colour", ALL & ~R1, 1, 0, GREEN, G | R2, 0, GREEN, PASS, AFTER, POT, 0, 4, G,
     0, MAY_PASS},
    {"the cue ball with the black", ALL & ~R1, 1, 0, BLACK, BK | 1, 0, BLACK, PASS, D, CUE_BALL, 0,
     7, BK, 0, MAY_PASS | HAND},
    {"a miss at the colour", ALL & ~R1, 1, 0, PINK, 0, 0, PINK, PASS, AFTER, 0, 0, 0, 0, 0, 0},
    {"no ball, the brown named", ALL & ~R1, 1, 0, -1, 0, 0, BROWN, PASS, AFTER, NO_BALL, 0, 4, 0, 0,
     MAY_PASS},
    {"no ball, none named", ALL & ~R1, 1, 0, -1, 0, 0, NO_CALL, PASS, AFTER, NO_BALL, 0, 7, 0, 0,
     MAY_PASS},
    {"a colour after the last red", COLOURS | 1, 1, 0, YELLOW, Y, 0, YELLOW, KEEP, AFTER, 0, 2, 0,
     Y, 0, 0},

    {"the yellow in order", COLOURS | 1, 0, 0, YELLOW, Y, 0, YELLOW, KEEP, AFTER, 0, 2, 0, 0, 0, 0},
    {"the green too early", COLOURS | 1, 0, 0, GREEN, G, 0, GREEN, PASS, AFTER, FIRST, 0, 4, G, 0,
     MAY_PASS},
    {"the green in order", (COLOURS & ~Y) | 1, 0, 0, GREEN, G, 0, NO_CALL, KEEP, AFTER, 0, 3, 0, 0,
     0, 0},
    {"the brown with the green", (COLOURS & ~Y) | 1, 0, 0, GREEN, G | BR, 0, GREEN, PASS, AFTER,
     POT, 0, 4, G | BR, 0, MAY_PASS},
    {"no ball, the pink on", PI | BK | 1, 0, 0, -1, 0, 0, NO_CALL, PASS, AFTER, NO_BALL, 0, 6, 0, 0,
     MAY_PASS},

    {"a free ball, potted", ALL, 0, MAY_PASS | FREE, BROWN, BR, 0, BROWN, KEEP, AFTER, 0, 1, 0, BR,
     1, 0},
    {"a free ball and a red", ALL, 0, FREE, BROWN, BR | R1, 0, BROWN, KEEP, AFTER, 0, 2, 0, BR, 1,
     0},
    {"a red by a free ball", ALL, 0, FREE, BROWN, R1, 0, BROWN, KEEP, AFTER, 0, 1, 0, 0, 1, 0},
    {"the red, with a free ball", ALL, 0, FREE, 1, R1, 0, 1, KEEP, AFTER, 0, 1, 0, 0, 1, 0},
    {"a red first, the brown named", ALL, 0, FREE, 1, R1, 0, BROWN, PASS, AFTER, FIRST, 0, 4, 0, 0,
     MAY_PASS},
    {"the black as a free ball, missed", ALL, 0, FREE, -1, 0, 0, BLACK, PASS, AFTER, NO_BALL, 0, 4,
     0, 0, MAY_PASS},
    {"another colour with the free ball", ALL, 0, FREE, BROWN, BR | PI, 0, BROWN, PASS, AFTER, POT,
     0, 6, BR | PI, 0, MAY_PASS},
    {"a free ball for the yellow", COLOURS | 1, 0, FREE, BLACK, BK, 0, BLACK, KEEP, AFTER, 0, 2, 0,
     BK, 0, 0},
    {"both, of colours", COLOURS | 1, 0, FREE, BLACK, BK | Y, 0, BLACK, KEEP, AFTER, 0, 2, 0, BK, 0,
     0},
    {"the yellow by a free ball", COLOURS | 1, 0, FREE, BLACK, Y, 0, BLACK, KEEP, AFTER, 0, 2, 0, 0,
     0, 0},
    {"a free ball without a call", ALL, 0, FREE, BLUE, BL, 0, NO_CALL, KEEP, AFTER, 0, 1, 0, BL, 1,
     0},
};

TEST(snooker_rulings) {
  for (size_t k = 0; k < sizeof snooker / sizeof snooker[0]; k++) {
    const snooker_case *c = &snooker[k];
    const carom_facts facts = facts_of(c->first, 0, c->down, c->off);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[0] = (uint64_t)c->colour;
    of.user[2] = 20;
    of.user[3] = 30;
    of.user[4] = (uint64_t)c->after_foul;
    const carom_turn turn = of.judge(of.user, c->in_play, 0, &facts, (carom_call){c->call, -1});
    ck_assert_msg((int)turn.is == c->is && (int)turn.leave == c->leave && turn.foul == c->foul &&
                      turn.spot == c->spot,
                  "%s: turn %d, leave %d, foul %d, spot %x", c->what, (int)turn.is, (int)turn.leave,
                  turn.foul, turn.spot);
    const bool gives = c->is == PASS;
    ck_assert_msg(of.user[gives ? 3 : 2] == 20 + (uint64_t)c->own &&
                      of.user[gives ? 2 : 3] == 30 + (uint64_t)c->other,
                  "%s: scores %d, %d", c->what, (int)of.user[2], (int)of.user[3]);
    ck_assert_msg(of.user[0] == (uint64_t)c->colour_next &&
                      of.user[4] == (uint64_t)c->after_foul_next,
                  "%s: colour %d, after a foul %d", c->what, (int)of.user[0], (int)of.user[4]);
    ck_assert_msg(turn.points == (double)c->own, "%s", c->what);
  }
}

/* What is on. */
TEST(snooker_on) {
  static const struct {
    uint32_t in_play;
    int colour, after_foul;
    uint32_t on;
  } given[] = {
      {ALL, 0, 0, 0xfffe},          {ALL & ~R1, 1, 0, COLOURS},      {ALL, 0, FREE, ALL & ~1},
      {COLOURS | 1, 1, 0, COLOURS}, {COLOURS | 1, 0, 0, Y},          {PI | BK | 1, 0, MAY_PASS, PI},
      {BK | 1, 0, 0, BK},           {COLOURS | 1, 0, FREE, COLOURS}, {COLOURS | R2 | 1, 0, 0, R2}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[0] = (uint64_t)given[k].colour;
    of.user[4] = (uint64_t)given[k].after_foul;
    ck_assert_uint_eq(of.on(of.user, given[k].in_play), given[k].on);
  }
}

/* The last black, by the scores. */
TEST(snooker_ends) {
  static const struct {
    const char *what;
    int own, other, first;
    uint32_t down;
    int is, leave;
    uint32_t spot;
  } given[] = {{"wins", 50, 56, BLACK, BK, WIN, AFTER, 0},
               {"is not enough", 50, 58, BLACK, BK, LOSE, AFTER, 0},
               {"draws level", 50, 57, BLACK, BK, PASS, D, BK},
               {"a foul loses", 50, 50, -1, 0, LOSE, AFTER, 0},
               {"a foul in the lead", 60, 50, BLACK, 1, WIN, AFTER, 0},
               {"a foul draws level", 57, 50, -1, 0, PASS, D, BK},
               {"potted with the cue ball", 52, 50, BLACK, BK | 1, LOSE, AFTER, 0},
               {"a miss", 50, 50, BLACK, 0, PASS, AFTER, 0},
               {"a miss, seven behind", 50, 57, BLACK, 0, PASS, AFTER, 0},
               {"a miss, and the other claims", 50, 58, BLACK, 0, LOSE, AFTER, 0}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const carom_facts facts = facts_of(given[k].first, 0, given[k].down, 0);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[2] = (uint64_t)given[k].own;
    of.user[3] = (uint64_t)given[k].other;
    const carom_turn turn = of.judge(of.user, BK | 1, 0, &facts, (carom_call){BLACK, -1});
    ck_assert_msg((int)turn.is == given[k].is && (int)turn.leave == given[k].leave &&
                      turn.spot == given[k].spot,
                  "%s: turn %d, leave %d, spot %x", given[k].what, (int)turn.is, (int)turn.leave,
                  turn.spot);
    /* a black that comes back begins anew: nobody may pass */
    ck_assert_uint_eq(of.may(of.user), 0);
  }
}

/* The pink leaves the last black: with more than seven points ahead the frame is claimed. */
TEST(snooker_claim) {
  for (int other = 43; other < 52; other++) {
    const carom_facts facts = facts_of(PINK, 0, PI, 0);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[2] = 44;
    of.user[3] = (uint64_t)other;
    const carom_turn turn = of.judge(of.user, PI | BK | 1, 0, &facts, (carom_call){PINK, -1});
    ck_assert_int_eq((int)turn.is, 44 + 6 > other + 7 ? WIN : KEEP);
    ck_assert(turn.points == 6.0 && turn.foul == 0 && turn.spot == 0 && of.user[2] == 50);
  }
}

/* After a foul the other may let the offender play again, from hand if the cue ball was; and has no
 * free ball then. */
TEST(snooker_again) {
  for (int hand = 0; hand < 2; hand++) {
    const carom_facts none = {.first = {-1, -1}};
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[2] = 9;
    of.user[4] = (uint64_t)(MAY_PASS | FREE | (hand ? HAND : 0));
    ck_assert_uint_eq(of.may(of.user), CAROM_MAY_PASS);
    const carom_turn turn = of.judge(of.user, ALL, 0, &none, (carom_call){CAROM_CALL_PASS, -1});
    ck_assert(turn.is == CAROM_TURN_PASS && turn.foul == 0 && turn.spot == 0);
    ck_assert_int_eq(turn.leave, hand ? CAROM_LEAVE_D : CAROM_LEAVE_AFTER);
    ck_assert(of.user[3] == 9 && of.user[4] == 0 && of.on(of.user, ALL) == 0xfffe);
    /* without the right it is a stroke that meets nothing */
    ck_assert_int_eq(of.judge(of.user, ALL, 0, &none, (carom_call){CAROM_CALL_PASS, -1}).foul,
                     CAROM_FOUL_NO_BALL);
  }
}

/* A ball that is met while the tip is on the cue ball: `frozen` before the stroke, `pushed` in it.
 * In snooker reds are on. Before the same shot without a touch of a cushion, and after a loss. */
TEST(double_hits) {
  static const struct {
    const char *what;
    uint32_t frozen, pushed;
    int touches, pool, snooker, three;
  } given[] = {{"as usual", 0, 0, 1, LEGAL, LEGAL, LEGAL},
               {"through a frozen ball", R1, R1, 1, LEGAL, DOUBLE_HIT, DOUBLE_HIT},
               {"the same, touched twice", R1, R1, 2, LEGAL, DOUBLE_HIT, DOUBLE_HIT},
               {"away from it", R1, 0, 1, LEGAL, LEGAL, LEGAL},
               {"a near ball", 0, R1, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"a near ball, touched twice", 0, R1, 2, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"a near ball beside a frozen one", R2, R1, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"one of each", R2, R1 | R2, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"touched twice, with no ball", 0, 0, 2, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_facts f = facts_of(1, 1, 0, 0), other = f;
    f.frozen = given[k].frozen;
    f.pushed = given[k].pushed;
    f.touches = given[k].touches;
    ck_assert_msg((int)carom_foul_of(&f, R1, 0) == given[k].pool, "%s", given[k].what);
    for (int game = CAROM_RULES_EIGHTBALL; game <= CAROM_RULES_ONEPOCKET; game++) {
      carom_plan_rules of = carom_plan_rules_of((carom_rules_kind)game);
      const int foul = game == CAROM_RULES_SNOOKER        ? given[k].snooker
                       : game == CAROM_RULES_THREECUSHION ? given[k].three
                                                          : given[k].pool;
      const carom_turn turn = of.judge(of.user, 0xffff, 0, &f, (carom_call){NO_CALL, -1});
      ck_assert_msg((int)turn.foul == foul, "%s: %s", carom_rules_name(game), given[k].what);
    }

    /* before a cushion, after a ball that is not on, and in a push-out too */
    f.cushions_after = other.cushions_after = 0;
    ck_assert_int_eq(carom_foul_of(&f, R1, 0), given[k].pool == LEGAL ? CUSHION : DOUBLE_HIT);
    ck_assert_int_eq(carom_foul_of(&f, R2, 0), FIRST);
    carom_plan_rules nine = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    nine.user[4] = 1;
    ck_assert_int_eq(nine.judge(nine.user, 0x3ff, 0, &f, (carom_call){CAROM_CALL_PUSH, -1}).foul,
                     given[k].pool);
  }
}

/* A ball on that touches the cue ball has been met by who plays away from it, whatever comes then;
 * of colours only the one that is named. A push costs what the ball is worth. */
TEST(snooker_touching) {
  static const struct {
    const char *what;
    int colour, first, call;
    uint32_t frozen, pushed;
    int foul, other;
  } given[] = {{"no other", 0, -1, NO_CALL, R2, 0, LEGAL, 0},
               {"then a colour", 0, PINK, NO_CALL, R2, 0, LEGAL, 0},
               {"a colour that is not on", 0, -1, NO_CALL, PI, 0, NO_BALL, 4},
               {"the colour named", 1, -1, PINK, PI, 0, LEGAL, 0},
               {"the colour not named", 1, -1, BLUE, PI, 0, NO_BALL, 5},
               {"none named", 1, -1, NO_CALL, PI, 0, LEGAL, 0},
               {"the red pushed", 0, 2, NO_CALL, R2, R2, DOUBLE_HIT, 4},
               {"the pink pushed behind a red", 0, 1, NO_CALL, 0, R1 | PI, DOUBLE_HIT, 6}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_facts f = facts_of(given[k].first, 0, 0, 0);
    f.frozen = given[k].frozen;
    f.pushed = given[k].pushed;
    f.touches = 1;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[0] = (uint64_t)given[k].colour;
    const carom_turn turn = of.judge(of.user, ALL, 0, &f, (carom_call){given[k].call, -1});
    ck_assert_msg((int)turn.foul == given[k].foul, "%s", given[k].what);
    ck_assert_msg(of.user[2] == (uint64_t)given[k].other, "%s", given[k].what); /* his turn now */
  }
}

/* Colours go to their own spots; to the highest free one; and where none is free, towards the top
 * cushion, or away from it. */
TEST(snooker_spots) {
  const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1);
  const double l = table.length, R = balls[1].kind.radius;
  double spot[BALLS_MOST][2];
  for (int k = 0; k < BALLS_MOST; k++)
    ck_assert_int_eq(carom_spot_of(CAROM_RACK_SNOOKER, &table, k, spot[k]), CAROM_OK);
  ck_assert(spot[YELLOW][0] > spot[BROWN][0] && spot[GREEN][0] < spot[BROWN][0]);
  ck_assert(spot[BLUE][1] == 0.5 * l && spot[PINK][1] == 0.75 * l);
  ck_assert(fabs(l - spot[BLACK][1] - 0.324) < 1e-3);
  for (int k = YELLOW; k <= BLACK; k++) {
    ck_assert_int_eq(carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, k), CAROM_OK);
    ck_assert(is_at(k, spot[k][0], spot[k][1]));
  }

  /* the brown's is taken: the black's is free, and the highest */
  lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1);
  put(1, spot[BROWN][0] + R, spot[BROWN][1]);
  carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, BROWN);
  ck_assert(is_at(BROWN, spot[BLACK][0], spot[BLACK][1]));
  /* now the blue's is taken, too: the pink's is the highest free one */
  put(2, spot[BLUE][0], spot[BLUE][1] - R);
  carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, BLUE);
  ck_assert(is_at(BLUE, spot[PINK][0], spot[PINK][1]));

  /* none is free: by reds on all spots */
  lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | 0x7e);
  for (int k = YELLOW; k <= BLACK; k++)
    put(k - YELLOW + 1, spot[k][0], spot[k][1]);
  carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, PINK);
  const double *r = balls[PINK].state.r;
  ck_assert(r[0] == spot[PINK][0] && r[1] > spot[PINK][1] + 2.0 * R - 1e-9 &&
            r[1] < spot[PINK][1] + 2.0 * R + 2e-3);
  /* nor between the black's and the cushion */
  for (int k = 0; k < 5; k++)
    put(7 + k, spot[BLACK][0], spot[BLACK][1] + 2.0 * R * (k + 1) + 0.01);
  carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, BLACK);
  r = balls[BLACK].state.r;
  ck_assert(r[0] == spot[BLACK][0] && r[1] < spot[BLACK][1] - 2.0 * R + 1e-9);

  /* two colours at once: the higher one goes first, to its own spot that is free */
  lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1);
  put(1, spot[YELLOW][0], spot[YELLOW][1]);
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
  carom_turn turn = {.is = CAROM_TURN_PASS, .foul = CAROM_FOUL_POT, .spot = Y | BK};
  ck_assert_int_eq(carom_turn_settle(&of, of.user, &table, balls, count, &turn), CAROM_OK);
  ck_assert(is_at(BLACK, spot[BLACK][0], spot[BLACK][1]) &&
            is_at(YELLOW, spot[PINK][0], spot[PINK][1]));
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_SNOOKER, &table, 22, spot[0]), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_NINEBALL, &table, -1, spot[0]), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_NINEBALL, NULL, 1, spot[0]), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_turn_settle(&of, NULL, &table, balls, count, &turn), CAROM_ERROR_NULL);
  turn.spot = 1u << 22;
  ck_assert_int_eq(carom_turn_settle(&of, of.user, &table, balls, count, &turn), CAROM_ERROR_BALLS);
}

/* After a foul: whether the player is snookered, that is, whether no ball on can be hit at both of
 * its edges. */
TEST(free_balls) {
  enum { NOT = 0, IS = 1 };
  static const double R = 0.02625;
  const struct {
    const char *what;
    double red[2], blocker[2];
    bool hand, snookered;
  } given[] = {
      {"nothing in the way", {0.9, 2.0}, {0.2, 2.0}, false, false},
      {"full behind the black", {0.9, 2.0}, {0.9, 1.5}, false, true},
      {"one edge behind it", {0.9, 2.0}, {0.9 + 1.2 * R, 1.9}, false, true},
      {"beside the way", {0.9, 2.0}, {0.9 + 4.1 * R, 1.9}, false, false},
      {"behind the red", {0.9, 2.0}, {0.9, 2.2}, false, false},
      {"in hand, from elsewhere in the D", {0.9, 2.0}, {0.9, 1.5}, true, false},
  };
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1 | BK);
    put(0, 0.9, 1.0);
    put(1, given[k].red[0], given[k].red[1]);
    put(BLACK, given[k].blocker[0], given[k].blocker[1]);
    for (int foul = 0; foul < 2; foul++) {
      carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
      of.user[4] = foul ? MAY_PASS : 0;
      carom_turn turn = {.is = CAROM_TURN_PASS,
                         .leave = given[k].hand ? CAROM_LEAVE_D : CAROM_LEAVE_AFTER,
                         .foul = foul ? CAROM_FOUL_NO_BALL : 0};
      carom_turn_settle(&of, of.user, &table, balls, count, &turn);
      ck_assert_msg(((of.user[4] & FREE) != 0) == (foul && given[k].snookered), "%s, foul %d",
                    given[k].what, foul);
    }
  }

  /* in hand, with a wall of colours close to the D */
  int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, R1 | COLOURS);
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
  of.user[4] = MAY_PASS | HAND;
  carom_turn turn = {.is = CAROM_TURN_PASS, .leave = CAROM_LEAVE_D, .foul = CAROM_FOUL_CUE_BALL};
  put(1, 1.3, 3.4);
  carom_turn_settle(&of, of.user, &table, balls, count, &turn);
  ck_assert(!(of.user[4] & FREE));
  for (int k = YELLOW; k <= BLACK; k++)
    put(k, 1.3 + 2.0 * R * (k - 18.5), 3.2);
  of.user[4] = MAY_PASS | HAND;
  carom_turn_settle(&of, of.user, &table, balls, count, &turn);
  ck_assert(of.user[4] & FREE);

  /* a second red that is free ends it */
  balls[2] = balls[1];
  put(2, 0.2, 2.0);
  of.user[4] = MAY_PASS | HAND;
  carom_turn_settle(&of, of.user, &table, balls, count, &turn);
  ck_assert(!(of.user[4] & FREE));

  /* to leave the other behind the free ball is a foul; behind another it is not, nor with pink and
   * black alone */
  for (int k = 0; k < 4; k++) {
    const bool last = k >= 2;
    count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER,
                    last ? (k == 2 ? 1 | PI | BK : 1 | BL | PI | BK) : 1 | R1 | Y | BK);
    put(0, 0.9, 1.0);
    const int target = k == 2 ? PINK : k == 3 ? BLUE : 1, named = k == 1 ? YELLOW : BLACK;
    put(target, 0.9, 2.0);
    put(BLACK, 0.9, 1.5);
    if (k == 1)
      put(YELLOW, 0.2, 0.2);
    if (k == 3)
      put(PINK, 0.2, 0.2);
    of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[2] = 5;
    of.user[5] = (uint64_t)named + 1;
    turn = (carom_turn){.is = CAROM_TURN_PASS};
    carom_turn_settle(&of, of.user, &table, balls, count, &turn);
    const bool foul = k == 0 || k == 3;
    ck_assert_msg((turn.foul != 0) == foul, "%d: foul %d", k, turn.foul);
    ck_assert_uint_eq(of.user[2], k == 0 ? 9 : k == 3 ? 10 : 5);
    ck_assert_uint_eq(of.user[4], foul ? MAY_PASS | FREE : 0);
    ck_assert_uint_eq(of.user[5], 0);
  }
}

/* ---- One-pocket */

/* The pockets of the player, of the other and of none. */
enum { MINE = 5, HIS = 2, NEUTRAL = 0 };

typedef struct onepocket_case {
  const char *what;
  uint32_t in_play; /* the others are down: those that do not count come back */
  int first, cushions;
  uint32_t mine, his, neutral, off; /* the cue ball is gone with bit 0 of neutral or off */
  int balls[2], owed[2], fouls;     /* before, of the one who plays and of the other; his fouls */
  int is, leave, foul;
  uint32_t spot;
  int balls_after[2], owed_after[2], fouls_after; /* of the same two */
} onepocket_case;

/* clang-format off */
static const onepocket_case onepocket[] = {
    {"a ball in his pocket", 0xffff, 3, 0, 8, 0, 0, 0, {0, 0}, {0, 0}, 2,
     KEEP, AFTER, 0, 0, {1, 0}, {0, 0}, 0},
    {"two of them, off another", 0xffff, 9, 0, 0x18, 0, 0, 0, {0, 0}, {0, 0}, 0,
     KEEP, AFTER, 0, 0, {2, 0}, {0, 0}, 0},
    {"one in the pocket of the other", 0xffff, 3, 0, 0, 8, 0, 0, {0, 0}, {0, 0}, 1,
     PASS, AFTER, 0, 0, {0, 1}, {0, 0}, 0},
    {"one in each", 0xffff, 3, 0, 8, 0x10, 0, 0, {0, 0}, {0, 0}, 0,
     KEEP, AFTER, 0, 0, {1, 1}, {0, 0}, 0},
    {"one in no one's", 0xfff9, 3, 0, 0, 0, 8, 0, {1, 1}, {0, 0}, 0,
     PASS, AFTER, 0, 8, {1, 1}, {0, 0}, 0},
    {"the same with one of his own", 0xffff, 3, 0, 0x10, 0, 8, 0, {0, 0}, {0, 0}, 0,
     KEEP, AFTER, 0, 0, {1, 0}, {0, 0}, 0},
    {"one of the two comes back after a miss", 0xffe7, 5, 1, 0, 0, 0, 0, {1, 0}, {0, 0}, 0,
     PASS, AFTER, 0, 8, {1, 0}, {0, 0}, 0},
    {"and with it one that falls then", 0xffe7, 5, 1, 0, 0, 0x20, 0, {1, 0}, {0, 0}, 0,
     PASS, AFTER, 0, 0x28, {1, 0}, {0, 0}, 0},
    {"a safety to a cushion", 0xffff, 3, 1, 0, 0, 0, 0, {0, 0}, {0, 0}, 2,
     PASS, AFTER, 0, 0, {0, 0}, {0, 0}, 0},
    {"no cushion, without a ball to pay", 0xfff1, 4, 0, 0, 0, 0, 0, {0, 3}, {0, 0}, 0,
     PASS, AFTER, CUSHION, 0, {0, 3}, {1, 0}, 1},
    {"no ball met, with three", 0xfff1, -1, 0, 0, 0, 0, 0, {3, 0}, {0, 0}, 1,
     PASS, AFTER, NO_BALL, 2, {2, 0}, {0, 0}, 2},
    {"the cue ball falls with one of his", 0xffff, 3, 0, 8, 0, 1, 0, {0, 0}, {0, 0}, 0,
     PASS, KITCHEN, CUE_BALL, 8, {0, 0}, {1, 0}, 1},
    {"and leaves the table with one of the other", 0xffff, 3, 0, 0, 8, 0, 1, {0, 0}, {0, 0}, 0,
     PASS, KITCHEN, CUE_BALL, 8, {0, 0}, {1, 0}, 1},
    {"a ball off the table, others fall", 0xffff, 3, 1, 8, 0x10, 0, 0x20, {0, 0}, {0, 0}, 0,
     PASS, AFTER, OFF, 0x28, {0, 1}, {1, 0}, 1},
    {"a foul in a visit: what fell before, too", 0xffe3, 5, 0, 0, 0, 0, 0, {1, 1}, {0, 0}, 0,
     PASS, AFTER, CUSHION, 0xc, {0, 1}, {0, 0}, 1},
    {"a ball that is owed", 0xffff, 3, 0, 8, 0, 0, 0, {0, 0}, {1, 0}, 0,
     KEEP, AFTER, 0, 0, {0, 0}, {0, 0}, 0},
    {"the next one counts", 0xfff7, 4, 0, 0x10, 0, 0, 0, {0, 0}, {0, 0}, 0,
     KEEP, AFTER, 0, 0, {1, 0}, {0, 0}, 0},
    {"one owed of three", 0xffff, 3, 0, 0x38, 0, 0, 0, {0, 0}, {1, 0}, 0,
     KEEP, AFTER, 0, 0, {2, 0}, {0, 0}, 0},
    {"the other owes one", 0xffff, 3, 0, 0, 0x18, 0, 0, {0, 0}, {0, 1}, 0,
     PASS, AFTER, 0, 8, {0, 1}, {0, 0}, 0},
    {"the eighth", 0xff01, 9, 0, 0x200, 0, 0, 0, {7, 0}, {0, 0}, 0,
     WIN, AFTER, 0, 0, {8, 0}, {0, 0}, 0},
    {"the eighth pays a debt", 0xff01, 9, 0, 0x200, 0, 0, 0, {7, 0}, {1, 0}, 0,
     KEEP, AFTER, 0, 0, {7, 0}, {0, 0}, 0},
    {"the eighth of both", 0xc001, 14, 0, 0x4000, 0x8000, 0, 0, {7, 7}, {0, 0}, 0,
     WIN, AFTER, 0, 0, {8, 8}, {0, 0}, 0},
    {"the eighth on a foul", 0xff01, 9, 0, 0x200, 0, 1, 0, {7, 0}, {0, 0}, 0,
     PASS, KITCHEN, CUE_BALL, 0x202, {6, 0}, {0, 0}, 1},
    {"the eighth of the other", 0xff01, 9, 0, 0, 0x200, 0, 0, {0, 7}, {0, 0}, 0,
     LOSE, AFTER, 0, 0, {0, 8}, {0, 0}, 0},
    {"the same, and one of his", 0xff01, 9, 0, 0x400, 0x200, 0, 0, {0, 7}, {0, 0}, 0,
     LOSE, AFTER, 0, 0, {1, 8}, {0, 0}, 0},
    {"the same, and the cue ball", 0xff01, 9, 0, 0, 0x200, 1, 0, {0, 7}, {0, 0}, 0,
     PASS, KITCHEN, CUE_BALL, 0x200, {0, 7}, {1, 0}, 1},
    {"the same, and a ball off the table", 0xff01, 9, 0, 0, 0x200, 0, 0x400, {0, 7}, {0, 0}, 0,
     LOSE, AFTER, OFF, 0, {0, 8}, {1, 0}, 1},
    {"a third foul", 0xfff1, -1, 0, 0, 0, 0, 0, {3, 0}, {0, 0}, 2,
     LOSE, AFTER, NO_BALL, 0, {2, 0}, {0, 0}, 3},
    {"the last ball: two that fell come back", 0x0009, 3, 0, 8, 0, 0, 0, {6, 6}, {0, 0}, 0,
     KEEP, AFTER, 0, 0x6, {7, 6}, {0, 0}, 0},
};
/* clang-format on */

TEST(onepocket_rulings) {
  for (size_t k = 0; k < sizeof onepocket / sizeof onepocket[0]; k++) {
    const onepocket_case *c = &onepocket[k];
    carom_facts facts = facts_of(c->first, c->cushions, c->mine | c->his | c->neutral, c->off);
    for (int ball = 0; ball < CAROM_BALLS_MOST; ball++)
      if (facts.down >> ball & 1)
        facts.pocket[ball] = c->mine >> ball & 1 ? MINE : c->his >> ball & 1 ? HIS : NEUTRAL;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_ONEPOCKET);
    ck_assert_uint_eq(of.user[0], MINE + 8 * HIS);
    ck_assert_uint_eq(of.pockets(of.user), 1U << MINE);
    for (int who = 0; who < 2; who++) {
      of.user[2 + who] = (uint64_t)c->balls[who];
      of.user[5 + who] = (uint64_t)c->owed[who];
    }
    of.user[7] = (uint64_t)c->fouls + 4 * 1;

    /* what each needs; then the ruling, and the state of whoever plays next */
    int32_t needs[2];
    of.left(of.user, c->in_play, needs);
    for (int who = 0; who < 2; who++)
      ck_assert_msg(needs[who] == 8 - c->balls[who] + c->owed[who], "%s: left", c->what);
    const carom_turn turn = of.judge(of.user, c->in_play, 0, &facts, (carom_call){NO_CALL, -1});
    const int other = c->is == PASS ? 1 : 0;
    ck_assert_msg((int)turn.is == c->is && (int)turn.leave == c->leave && turn.foul == c->foul &&
                      turn.spot == c->spot,
                  "%s: turn %d, leave %d, foul %d, spot %x", c->what, (int)turn.is, (int)turn.leave,
                  turn.foul, turn.spot);
    for (int who = 0; who < 2; who++)
      ck_assert_msg(of.user[2 + (other ^ who)] == (uint64_t)c->balls_after[who] &&
                        of.user[5 + (other ^ who)] == (uint64_t)c->owed_after[who],
                    "%s: balls %d, owed %d", c->what, (int)of.user[2 + (other ^ who)],
                    (int)of.user[5 + (other ^ who)]);
    const uint64_t fouls = (uint64_t)c->fouls_after;
    ck_assert_msg(of.user[7] == (other ? 1 + 4 * fouls : fouls + 4), "%s: fouls", c->what);
    ck_assert_uint_eq(of.pockets(of.user), 1U << (other ? HIS : MINE));
    ck_assert_uint_eq(of.on(of.user, c->in_play), c->in_play & 0xfffe);
  }
}

/* Chances: more points are better, and so are fewer that the other has; those of both players add
 * up to about one where nothing can be potted. */
TEST(values_of_points) {
  for (int game = 0; game < 2; game++) {
    const carom_rules_kind kind = game == 0 ? CAROM_RULES_STRAIGHT : CAROM_RULES_SNOOKER;
    carom_plan_rules of = carom_plan_rules_of(kind);
    const int count = lay_out(game == 0 ? CAROM_RACK_EIGHTBALL : CAROM_RACK_SNOOKER,
                              game == 0 ? CAROM_TABLE_POOL_9FT : CAROM_TABLE_SNOOKER, ALL);
    carom_cue cue = carom_cue_of(game == 0 ? CAROM_GAME_POOL : CAROM_GAME_SNOOKER);
    const carom_player player = carom_player_of(1.0);
    const carom_plan_job job = {.table = &table,
                                .balls = balls,
                                .count = count,
                                .cue = &cue,
                                .player = &player,
                                .rules = &of};
    double last = -1.0, value;
    for (int own = 0; own <= 99; own += 9) {
      of.user[2] = (uint64_t)own;
      of.user[3] = 40;
      ck_assert_int_eq(carom_plan_value(&job, 0, &value), CAROM_OK);
      ck_assert_msg(value >= last && value >= 0.0 && value <= 1.0, "%d: %g after %g", own, value,
                    last);
      last = value;
    }
    last = 2.0;
    for (int other = 0; other <= 99; other += 9) {
      of.user[2] = 40;
      of.user[3] = (uint64_t)other;
      ck_assert_int_eq(carom_plan_value(&job, 0, &value), CAROM_OK);
      ck_assert(value <= last);
      last = value;
    }
    ck_assert(last < 0.25);
    of.user[3] = 40;
    ck_assert_int_eq(carom_plan_value(&job, 1, &value), CAROM_OK);
    ck_assert(value > 0.3 && value < 0.95);
  }
}

/* With the black alone a lead of eight points has won the frame, whoever is at the table; one of
 * seven has not. */
TEST(values_of_a_claim) {
  const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, BK | 1);
  const carom_cue cue = carom_cue_of(CAROM_GAME_SNOOKER);
  const carom_player player = carom_player_of(1.0);
  for (int lead = -9; lead <= 9; lead++) {
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[2] = (uint64_t)(50 + lead);
    of.user[3] = 50;
    const carom_plan_job job = {.table = &table,
                                .balls = balls,
                                .count = count,
                                .cue = &cue,
                                .player = &player,
                                .rules = &of};
    double value;
    ck_assert_int_eq(carom_plan_value(&job, 0, &value), CAROM_OK);
    ck_assert_msg(lead > 7    ? value == 1.0
                  : lead < -7 ? value == 0.0
                              : value > 0.0 && value < 1.0,
                  "%d ahead: %g", lead, value);
  }
}

/* A plan for the balls that lie here, with memory of its own. */
static carom_plan_job job_of(int count, const carom_cue *cue, const carom_player *player,
                             const carom_plan_rules *of, const carom_plan_options *options) {
  const size_t size = carom_plan_memory(options);
  return (carom_plan_job){.table = &table,
                          .balls = balls,
                          .count = count,
                          .cue = cue,
                          .player = player,
                          .rules = of,
                          .options = options,
                          .memory = malloc(size),
                          .memory_size = size};
}

/* One-pocket: a ball before a pocket is worth much to its player only, who plays it there; fewer
 * balls that are needed, or owed, are better. */
TEST(pocket_of_ones_own) {
  const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0x7);
  put(0, 0.6, 1.6);
  put(1, table.width - 0.15, table.length - 0.15);
  put(2, 0.5 * table.width, 0.1);
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_player player = carom_player_of(1.0);
  const carom_plan_options options = {.shots = 1000};
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_ONEPOCKET);
  carom_plan_job job = job_of(count, &cue, &player, &of, &options);
  double value[5];
  for (int k = 0; k < 5; k++) {
    const bool mine = k < 4;
    of.user[0] = mine ? MINE + 8 * HIS : HIS + 8 * MINE;
    of.user[2] = k == 1 ? 6 : 7;
    of.user[3] = k == 2 ? 7 : 6;
    of.user[5] = k == 3;
    carom_choice best;
    int found;
    ck_assert_int_eq(carom_plan_value(&job, 0, &value[k]), CAROM_OK);
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    ck_assert_msg(!mine || (best.ball == 1 && best.pocket == MINE), "%d: ball %d", k, best.ball);
  }
  ck_assert_msg(value[0] > value[4] + 0.2 && value[0] > value[1] + 0.01 && value[0] > value[2] &&
                    fabs(value[3] - value[1]) < 1e-9,
                "%g %g %g %g %g", value[0], value[1], value[2], value[3], value[4]);
  free(job.memory);
}

/* Snooker: after a red a plan takes the black, where it is as easy as the yellow; and the yellow
 * where the black is out of reach. */
TEST(colours_by_value_and_position) {
  for (int k = 0; k < 2; k++) {
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.user[0] = 1;
    const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1 | Y | BK);
    const double w = table.width, l = table.length;
    put(0, 0.5 * w, 0.5 * l);
    put(1, 0.5 * w, 0.6 * l);
    /* both before a corner, or the black far along a rail */
    put(YELLOW, 0.15, 0.15);
    put(BLACK, w - 0.15, k == 0 ? 0.15 : l - 0.5);
    if (k == 1)
      put(BLACK, 0.027, 0.7 * l);
    carom_cue cue = carom_cue_of(CAROM_GAME_SNOOKER);
    const carom_player player = carom_player_of(0.3);
    const carom_plan_options options = {.shots = 2000};
    carom_plan_job job = job_of(count, &cue, &player, &of, &options);
    carom_choice best;
    int found;
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    ck_assert_msg(best.ball == (k == 0 ? BLACK : YELLOW), "%d: ball %d", k, best.ball);
    free(job.memory);
  }
}

/* ---- Golden games */

/* A whole game between two plans of few shots: the same strokes, scores and layouts on all
 * machines. Where a change of the method or of the physics is meant to change them, the new hash is
 * the one that this test prints. All layouts are such that a shot can be played from, and the
 * points add up. */
static uint64_t play(carom_rules_kind kind, int target, int *strokes, int64_t made[2]) {
  const bool in_d = kind == CAROM_RULES_SNOOKER;
  const int count = lay_out(in_d ? CAROM_RACK_SNOOKER : CAROM_RACK_EIGHTBALL,
                            in_d ? CAROM_TABLE_SNOOKER : CAROM_TABLE_POOL_9FT, ALL);
  carom_plan_rules of = carom_plan_rules_of(kind);
  if (kind == CAROM_RULES_STRAIGHT) {
    of.user[0] = (uint64_t)target;
    of.user[1] = 1;
  }
  const carom_cue cue = carom_cue_of(in_d ? CAROM_GAME_SNOOKER : CAROM_GAME_POOL);
  const carom_player player = carom_player_of(in_d ? 0.5 : 1.0);
  carom_plan_options options = {.shots = 100};
  carom_plan_job job = job_of(count, &cue, &player, &of, &options);
  uint64_t h = UINT64_C(0xcbf29ce484222325);
  carom_turn turn = {.is = CAROM_TURN_PASS, .leave = in_d ? CAROM_LEAVE_D : CAROM_LEAVE_KITCHEN};
  const double high[2] = {table.width, 0.25 * table.length};
  int who = 1;
  for (*strokes = 0; *strokes < 400 && turn.is != CAROM_TURN_WIN && turn.is != CAROM_TURN_LOSE;
       (*strokes)++) {
    carom_choice best;
    int found;
    who = turn.is == CAROM_TURN_PASS ? 1 - who : who;
    options.seed = (uint64_t)*strokes;
    const bool hand = turn.leave == CAROM_LEAVE_KITCHEN || turn.leave == CAROM_LEAVE_D;
    ck_assert_int_eq(hand ? carom_plan_hand(&job, NULL,
                                            turn.leave == CAROM_LEAVE_KITCHEN ? high : NULL, &best,
                                            1, &found)
                          : carom_plan(&job, &best, 1, &found),
                     CAROM_OK);
    if (hand)
      ck_assert_int_eq(
          carom_place_ball(&table, balls, count, 0, best.place[0], best.place[1], NULL), CAROM_OK);
    if (turn.leave == CAROM_LEAVE_D)
      ck_assert(hypot(best.place[0] - 0.5 * table.width, best.place[1] - 0.737) < 0.2921 &&
                best.place[1] < 0.7371);

    carom_cue stroke = best.cue;
    carom_player_strike(&player, 5, (uint64_t)*strokes, &stroke);
    carom_facts facts = {.first = {-1, -1}};
    carom_ball_state final[BALLS_MOST];
    carom_shot shot = {.final = final, .facts = &facts};
    uint32_t in_play = 0;
    for (int k = 0; k < count; k++) {
      final[k] = balls[k].state;
      in_play |=
          (uint32_t)(final[k].label != CAROM_BALL_POCKETED && final[k].label != CAROM_BALL_OFF)
          << k;
    }
    if (best.kind != CAROM_PLAN_PASS)
      ck_assert_int_eq(carom_shoot(&table, balls, count, &stroke, NULL, &shot), CAROM_OK);
    for (int k = 0; k < count; k++)
      balls[k].state = final[k];
    turn = of.judge(of.user, in_play, 0, &facts, (carom_call){best.ball, best.pocket});
    ck_assert_int_eq(carom_turn_settle(&of, of.user, &table, balls, count, &turn), CAROM_OK);
    made[who] += (int64_t)turn.points;
    if (turn.leave == CAROM_LEAVE_AFTER)
      ck_assert_int_eq(carom_shot_check(&table, balls, count, NULL, NULL, NULL), CAROM_OK);
    h = hash_of(h, &best, sizeof best);
    h = hash_of(h, of.user, sizeof of.user);
    for (int k = 0; k < count; k++)
      h = hash_of(h, balls[k].state.r, sizeof balls[k].state.r);
  }
  free(job.memory);
  ck_assert(turn.is == CAROM_TURN_WIN || turn.is == CAROM_TURN_LOSE);
  if (kind == CAROM_RULES_STRAIGHT)
    ck_assert(of.user[2] == (uint64_t)made[who] && of.user[3] == (uint64_t)made[1 - who]);
  else if (!in_d) /* fouls and debts take from them */
    ck_assert(of.user[turn.is == CAROM_TURN_WIN ? 2 : 3] >= 8 &&
              (int64_t)of.user[2] <= 15 - (int64_t)of.user[3]);
  else /* fouls come to the pots */
    ck_assert(of.user[2] >= (uint64_t)made[who] && of.user[3] >= (uint64_t)made[1 - who]);
  return h;
}

TEST(golden_straight) {
  int strokes;
  int64_t made[2] = {0};
  const uint64_t h = play(CAROM_RULES_STRAIGHT, 40, &strokes, made);
  printf("straight pool: 0x%016llx; %d strokes, %d and %d points\n", (unsigned long long)h, strokes,
         (int)made[0], (int)made[1]);
  ck_assert(made[0] >= 40 || made[1] >= 40);
  ck_assert_msg(h == UINT64_C(0xb597886f4616a679), "another game: 0x%016llx",
                (unsigned long long)h);
}

TEST(golden_snooker) {
  int strokes;
  int64_t made[2] = {0};
  const uint64_t h = play(CAROM_RULES_SNOOKER, 0, &strokes, made);
  printf("snooker: 0x%016llx; %d strokes, %d and %d points\n", (unsigned long long)h, strokes,
         (int)made[0], (int)made[1]);
  ck_assert(made[0] + made[1] >= 40);
  ck_assert_msg(h == UINT64_C(0x8cac88e7c8ff7c24), "another game: 0x%016llx",
                (unsigned long long)h);
}

TEST(golden_onepocket) {
  int strokes;
  int64_t made[2] = {0};
  const uint64_t h = play(CAROM_RULES_ONEPOCKET, 0, &strokes, made);
  printf("one-pocket: 0x%016llx; %d strokes, %d and %d balls\n", (unsigned long long)h, strokes,
         (int)made[0], (int)made[1]);
  ck_assert(strokes >= 8 && made[0] + made[1] >= 4);
  ck_assert_msg(h == UINT64_C(0xe74819c60dcaabd1), "another game: 0x%016llx",
                (unsigned long long)h);
}
