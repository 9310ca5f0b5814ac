/* Eight-ball, nine-ball and the drill: rulings beside rulings written down, and balls that are put
 * back. */
#include "game_support.h"

enum { SOLIDS = 1, STRIPES = 2, IN_HAND = CAROM_LEAVE_HAND };

typedef struct ruling {
  const char *what;
  int kind;
  uint32_t in_play, down;
  int group, first, cushions_after, call, outcome, foul, leave, group_after;
} ruling;

/* All that falls goes into pocket 2, which is called. */
TEST(rulings) {
  enum { E = CAROM_RULES_EIGHTBALL, N = CAROM_RULES_NINEBALL, P = CAROM_RULES_POTTING };
  static const ruling given[] = {
      {"a solid on an open table", E, 0xffff, 0x0008, 0, 3, 0, 3, KEEP, 0, AFTER, SOLIDS},
      {"a stripe on an open table", E, 0xffff, 0x0400, 0, 10, 2, 10, KEEP, 0, AFTER, STRIPES},
      {"the eight met first on an open table", E, 0xffff, 0, 0, 8, 1, -1, PASS, FIRST, IN_HAND, 0},
      {"an own ball", E, 0xffff, 0x0400, 2, 9, 0, 10, KEEP, 0, AFTER, STRIPES},
      {"an own ball that was not called", E, 0xffff, 0x0400, 2, 9, 0, 11, PASS, 0, AFTER, SOLIDS},
      {"a ball of the other", E, 0xffff, 0x0008, 2, 9, 0, 3, PASS, 0, AFTER, SOLIDS},
      {"the wrong ball first", E, 0xffff, 0x0400, 2, 3, 1, 10, PASS, FIRST, IN_HAND, SOLIDS},
      {"no ball met", E, 0xffff, 0, 1, -1, 0, -1, PASS, NO_BALL, IN_HAND, STRIPES},
      {"no cushion after the contact", E, 0xffff, 0, 1, 3, 0, -1, PASS, CUSHION, IN_HAND, STRIPES},
      {"a safety", E, 0xffff, 0, 1, 3, 1, -1, PASS, 0, AFTER, STRIPES},
      {"the cue ball down too", E, 0xffff, 0x0009, 1, 3, 1, 3, PASS, CUE_BALL, IN_HAND, STRIPES},
      {"the eight too early", E, 0xffff, 0x0100, 1, 3, 1, 8, LOSE, 0, AFTER, SOLIDS},
      {"the eight at last", E, 0xff01, 0x0100, 1, 8, 0, 8, WIN, 0, AFTER, SOLIDS},
      {"the eight at last, not called", E, 0xff01, 0x0100, 1, 8, 0, -1, LOSE, 0, AFTER, SOLIDS},
      {"the eight with the cue ball", E, 0xff01, 0x0101, 1, 8, 0, 8, LOSE, CUE_BALL, AFTER, SOLIDS},
      {"the lowest ball", N, 0x03f9, 0x0008, 0, 3, 0, -1, KEEP, 0, AFTER, 0},
      {"another ball by the lowest", N, 0x03f9, 0x0080, 0, 3, 0, -1, KEEP, 0, AFTER, 0},
      {"not the lowest first", N, 0x03f9, 0x0080, 0, 4, 0, -1, PASS, FIRST, IN_HAND, 0},
      {"the nine by the lowest", N, 0x03f9, 0x0200, 0, 3, 0, -1, WIN, 0, AFTER, 0},
      {"the nine by a foul", N, 0x03f9, 0x0200, 0, 4, 0, -1, PASS, FIRST, IN_HAND, 0},
      {"the eight, where the nine is down", N, 0x01f9, 0x0100, 0, 3, 0, -1, WIN, 0, AFTER, 0},
      {"a pot of the drill", P, 0x000f, 0x0004, 0, 1, 0, -1, KEEP, 0, AFTER, 0},
      {"the last ball of the drill", P, 0x0005, 0x0004, 0, 2, 0, -1, WIN, 0, AFTER, 0},
      {"a miss of the drill", P, 0x000f, 0, 0, 1, 3, -1, PASS, 0, AFTER, 0},
  };
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const ruling *g = &given[k];
    const carom_facts facts = facts_of(g->first, g->cushions_after, g->down, 0);
    carom_plan_rules of = carom_plan_rules_of((carom_rules_kind)g->kind);
    of.state.group = g->group;
    const carom_turn turn =
        of.judge(&of.state, g->in_play, 0, &facts, (carom_call){g->call, g->call < 0 ? -1 : 2});
    /* a nine that does not win comes back */
    const uint32_t spot = g->kind == N && g->outcome == PASS ? g->down & 0x200 : 0;
    ruled(g->what, &turn, g->outcome, g->leave, g->foul, spot);
    ck_assert_msg(of.state.group == g->group_after, "%s: group", g->what);
  }
  ck_assert_str_eq(carom_rules_about_of(CAROM_RULES_NINEBALL)->name, "nineball");
  ck_assert_ptr_null(carom_rules_about_of((carom_rules_kind)99));
}

/* A break of eight-ball: one is enough, the table is open whatever falls, and the eight comes
 * back. */
TEST(breaks_of_eightball) {
  static const struct {
    uint32_t down;
    int driven, outcome, leave, foul;
    uint32_t spot;
    int may;
  } given[] = {{0, 4, PASS, AFTER, 0, 0, 0},
               {0, 3, PASS, AFTER, BREAK, 0, CAROM_MAY_RACK | CAROM_MAY_OTHER_RACK},
               {0x0008, 0, KEEP, AFTER, 0, 0, 0},
               {0x0100, 0, KEEP, AFTER, 0, 0x0100, CAROM_MAY_RACK},
               {0x0101, 0, PASS, KITCHEN, CUE_BALL, 0x0100, CAROM_MAY_RACK},
               {0x0001, 4, PASS, KITCHEN, CUE_BALL, 0, 0}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_facts facts = facts_of(1, given[k].driven, given[k].down, 0);
    for (int i = 1; i <= given[k].driven; i++)
      facts.cushions[i] = 1;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
    of.state.opening = 1;
    const carom_turn turn = of.judge(&of.state, 0xffff, 0, &facts, (carom_call){-1, -1});
    ruled("break", &turn, given[k].outcome, given[k].leave, given[k].foul, given[k].spot);
    ck_assert(of.state.group == 0 && of.state.opening == 0 && of.state.may == given[k].may);
  }
}

/* A stroke of nine-ball that meets a ball and drives so many to cushions, after which ball `down`
 * is down, or none for -1. */
static carom_turn nine(carom_plan_rules *of, int first, int driven, int down, int call) {
  carom_facts facts = facts_of(first, driven, down >= 0 ? UINT32_C(1) << down : 0, 0);
  for (int k = 1; k <= driven; k++)
    facts.cushions[k] = 1;
  return of->judge(&of->state, 0x3ff, 0, &facts, (carom_call){call, -1});
}

/* The third foul of a player in a row loses; a legal stroke in between forgets them. */
TEST(three_fouls) {
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  for (int stroke = 0; stroke < 4; stroke++) { /* of each player two */
    ck_assert_int_eq(nine(&of, -1, 0, -1, -1).outcome, CAROM_TURN_PASS);
    ck_assert_int_eq(of.state.fouls[1], stroke / 2 + 1);
  }
  carom_plan_rules other = of;
  const carom_turn third = nine(&of, 2, 1, -1, -1);
  ck_assert(third.outcome == CAROM_TURN_LOSE && third.foul == CAROM_FOUL_FIRST);
  ck_assert(nine(&other, 1, 1, -1, -1).foul == CAROM_FOUL_NONE && other.state.fouls[1] == 0);
  ck_assert_int_eq(other.state.fouls[0], 2);
}

/* After a break without a foul one may push out, and the other may then pass. */
TEST(push_outs) {
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_NINEBALL), again;
  of.state.opening = 1;
  again = of;
  ck_assert(nine(&again, 1, 3, -1, -1).foul == CAROM_FOUL_BREAK && again.state.may == 0);
  ck_assert_int_eq(nine(&of, 1, 4, -1, -1).outcome, CAROM_TURN_PASS);
  ck_assert_int_eq(of.state.may, CAROM_MAY_PUSH);

  /* a push-out meets what it likes; what falls stays down, but for the nine */
  again = of;
  carom_turn turn = nine(&again, -1, 0, -1, CAROM_CALL_PUSH);
  ck_assert(turn.outcome == CAROM_TURN_PASS && turn.foul == 0 && turn.leave == CAROM_LEAVE_AFTER);
  ck_assert_int_eq(again.state.may, CAROM_MAY_PASS);
  again = of;
  turn = nine(&again, 5, 0, 9, CAROM_CALL_PUSH);
  ck_assert(turn.outcome == CAROM_TURN_PASS && turn.foul == 0 && turn.spot == 0x200);
  again = of;
  turn = nine(&again, 5, 0, 0, CAROM_CALL_PUSH);
  ck_assert(turn.foul == CAROM_FOUL_CUE_BALL && again.state.may == 0);

  /* the other passes, and neither may do so again; without the right, a push-out is a stroke */
  nine(&of, -1, 0, -1, CAROM_CALL_PUSH);
  turn = nine(&of, -1, 0, -1, CAROM_CALL_PASS);
  ck_assert(turn.outcome == CAROM_TURN_PASS && turn.foul == 0 && turn.leave == CAROM_LEAVE_AFTER);
  ck_assert_int_eq(of.state.may, 0);
  ck_assert_int_eq(nine(&of, -1, 0, -1, CAROM_CALL_PUSH).foul, CAROM_FOUL_NO_BALL);
}

/* Balls on the foot spot, then behind it, then, where there is no room behind it, before it. */
TEST(spots) {
  enum { BALLS = 16 };
  lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 1);
  carom_place_ball(&table, balls, BALLS, 0, 0.2, 0.2, NULL);
  double least = INFINITY, most = 0.0;
  for (int k = 1; k < BALLS; k++) {
    ck_assert_int_eq(carom_spot_ball(&table, balls, BALLS, k), CAROM_OK);
    ck_assert(balls[k].state.r[0] == 0.5 * table.width);
    least = fmin(least, balls[k].state.r[1]);
    most = fmax(most, balls[k].state.r[1]);
  }
  ck_assert(balls[1].state.r[1] == 0.75 * table.length &&
            balls[2].state.r[1] > 0.75 * table.length);
  ck_assert(least < 0.75 * table.length - 0.1 && most < table.length - 0.028);

  /* on a long table the search has longer steps, a ten-thousandth of it */
  const carom_corner corner[] = {
      {0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 40.0, 0.0}, {0.0, 40.0, 0.0}};
  carom_table alley;
  ck_assert_int_eq(carom_table_polygon(corner, 4, 0.0365, 0.0, 0.028575, &alley, NULL), CAROM_OK);
  for (int k = 0; k < BALLS; k++)
    ck_assert_int_eq(carom_spot_ball(&alley, balls, BALLS, k), CAROM_OK);
  const double second = balls[1].state.r[1] - (30.0 + 2.0 * 0.028575);
  ck_assert(balls[0].state.r[1] == 30.0 && second > -1e-6 && second < 4e-3);
  /* what a turn brings back */
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  carom_turn turn = {.spot = 0x200};
  lay_out(CAROM_RACK_NINEBALL, CAROM_TABLE_POOL_9FT, 1);
  ck_assert_int_eq(carom_turn_settle(&of, &of.state, &table, balls, 10, &turn), CAROM_OK);
  ck_assert(is_at(9, 0.5 * table.width, 0.75 * table.length));
  ck_assert_int_eq(carom_spot_ball(NULL, balls, BALLS, 1), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_spot_ball(&table, balls, BALLS, BALLS), CAROM_ERROR_BALLS);
}

/* A ball that was frozen to a cushion, and is pressed into it, is not driven to it: a foul where no
 * other cushion is met. One that lay 1 mm off is driven. */
TEST(a_ball_frozen_to_a_cushion) {
  static const carom_rules_kind kinds[] = {CAROM_RULES_EIGHTBALL, CAROM_RULES_NINEBALL,
                                           CAROM_RULES_STRAIGHT,  CAROM_RULES_ONEPOCKET,
                                           CAROM_RULES_BANK,      CAROM_RULES_TENBALL};
  for (int k = 0; k < 24; k++) {
    carom_plan_rules of = carom_plan_rules_of(kinds[k / 4]);
    const bool off = k & 1, hard = k & 2;
    const int count = lay_out((carom_rack_kind)of.rack, CAROM_TABLE_POOL_9FT, 0xffff);
    const double R = balls[1].kind.radius, x[] = {0.3, off ? R + 1e-3 : R};
    for (int i = 0; i < 2; i++)
      ck_assert_int_eq(carom_place_ball(&table, balls, count, i, x[i], 0.8, NULL), CAROM_OK);
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.phi = 180.0;
    cue.speed = hard ? 3.0 : 0.5;
    carom_facts facts;
    carom_ball_state final[BALLS_MOST];
    static carom_ruling made;
    carom_shot shot = {.final = final, .facts = &facts};
    ck_assert_int_eq(carom_shoot(&table, balls, count, &cue, NULL, &shot), CAROM_OK);
    ck_assert_int_eq(
        carom_referee(&of, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &made), CAROM_OK);
    ck_assert_msg(made.turn.foul == (off || hard ? LEGAL : CUSHION) && facts.cushions[1] > 0,
                  "rules %d, off %d, hard %d: foul %d, cushions %d", kinds[k / 4], off, hard,
                  made.turn.foul, facts.cushions[1]);
  }
}
