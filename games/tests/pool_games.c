/* Balls that are put back, and a ball that is frozen to a cushion, in the games of pool. */
#include "game_support.h"

/* Balls on the foot spot, then behind it, then, where there is no room behind it, before it. */
TEST(spots) {
  enum { BALLS = 16 };
  lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 1);
  carom_place_ball(&table, balls, BALLS, 0, 0.2, 0.2, NULL);
  double least = INFINITY, most = 0.0;
  for (int k = 1; k < BALLS; k++) {
    expect_ok(carom_spot_ball(&table, balls, BALLS, k));
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
  expect_ok(carom_table_polygon(corner, 4, 0.0365, 0.0, 0.028575, &alley, NULL));
  for (int k = 0; k < BALLS; k++)
    expect_ok(carom_spot_ball(&alley, balls, BALLS, k));
  const double second = balls[1].state.r[1] - (30.0 + 2.0 * 0.028575);
  ck_assert(balls[0].state.r[1] == 30.0 && second > -1e-6 && second < 4e-3);
  /* what a turn brings back */
  carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  carom_turn turn = {.spot = 0x200};
  lay_out(CAROM_RACK_NINEBALL, CAROM_TABLE_POOL_9FT, 1);
  expect_ok(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, 10, &turn));
  ck_assert(is_at(9, 0.5 * table.width, 0.75 * table.length));
  ck_assert_int_eq(carom_spot_ball(NULL, balls, BALLS, 1), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_spot_ball(&table, balls, BALLS, BALLS), CAROM_ERROR_BALLS);
}

/* In pyramid the struck ball returns to the foot spot as others do, and touches none there. */
TEST(spots_of_pyramid) {
  const int count = lay_out(CAROM_RACK_PYRAMID, CAROM_TABLE_PYRAMID, 4);
  const double foot[2] = {0.5 * table.width, 0.75 * table.length}, R = balls[0].kind.radius;
  carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_PYRAMID);
  put(0, 0.4, 0.4);
  for (int k = 1; k <= 3; k++)
    put(k, 0.3 * k, 1.5);
  carom_turn turn = {.spot = 0x3};
  expect_ok(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn));
  ck_assert(is_at(0, foot[0], foot[1]) && balls[1].state.r[0] == foot[0]);
  const double gap = balls[1].state.r[1] - foot[1] - 2.0 * R;
  ck_assert_msg(gap > CAROM_RULES_TOUCH && gap < 3.0 * CAROM_RULES_TOUCH, "gap %g m", gap);
}

/* A ball that was frozen to a cushion, and is pressed into it, is not driven to it: a foul where no
 * other cushion is met. One that lay 1 mm off is driven. */
TEST(a_ball_frozen_to_a_cushion) {
  static const carom_rules_kind kinds[] = {CAROM_RULES_EIGHTBALL, CAROM_RULES_NINEBALL,
                                           CAROM_RULES_STRAIGHT,  CAROM_RULES_ONEPOCKET,
                                           CAROM_RULES_BANK,      CAROM_RULES_TENBALL};
  for (int k = 0; k < 24; k++) {
    carom_plan_rules game_rules = carom_plan_rules_of(kinds[k / 4]);
    const bool off = k & 1, hard = k & 2;
    const int count = lay_out((carom_rack_kind)game_rules.rack, CAROM_TABLE_POOL_9FT, 0xffff);
    const double R = balls[1].kind.radius, x[] = {0.3, off ? R + 1e-3 : R};
    for (int i = 0; i < 2; i++)
      expect_ok(carom_place_ball(&table, balls, count, i, x[i], 0.8, NULL));
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.phi = 180.0;
    cue.speed = hard ? 3.0 : 0.5;
    carom_facts facts;
    carom_ball_state final[BALLS_MOST];
    static carom_ruling ruling;
    carom_shot shot = {.final = final, .facts = &facts};
    expect_ok(carom_shoot(&table, balls, count, &cue, NULL, &shot));
    expect_ok(
        carom_referee(&game_rules, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling));
    ck_assert_msg(ruling.turn.foul == (off || hard ? LEGAL : CUSHION) && facts.cushions[1] > 0,
                  "rules %d, off %d, hard %d: foul %d, cushions %d", kinds[k / 4], off, hard,
                  ruling.turn.foul, facts.cushions[1]);
  }
}
