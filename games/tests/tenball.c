/* Ten-ball: a match, and a combination that is planned. situations.txt has its rulings. */
#include "carom_match.h"
#include "game_support.h"

/* A match begins with ten balls and the ten in the middle, and any ball may be called. */
TEST(a_match_of_tenball) {
  static carom_match match;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  expect_ok(carom_match_begin(&match, CAROM_RULES_TENBALL, &table, 1, 0));
  const carom_shot_ball *lies = match.record.balls;
  const double pitch = 2.0 * lies[1].kind.radius + 1e-4;
  ck_assert(match.record.count == 11 && match.on == 2 && match.rules.state.opening == 1);
  ck_assert(fabs(lies[1].state.r[1] - 0.75 * table.length) < 1e-4);
  ck_assert(fabs(lies[10].state.r[0] - 0.5 * table.width) < 1e-4 &&
            fabs(lies[10].state.r[1] - 0.75 * table.length - 2.0 * pitch * sqrt(0.75)) < 1e-4);
  expect_ok(carom_match_place(&match, 0, 0.6, 0.6));
  expect_ok(carom_match_call(&match, 0, (carom_call){7, 1}));
  ck_assert_int_eq(carom_match_call(&match, 0, (carom_call){0, 1}), CAROM_ERROR_ACT);
  ck_assert_int_eq(carom_match_call(&match, 0, (carom_call){11, 1}), CAROM_ERROR_ACT);
}

/* A plan calls the combination of a ball that hangs in a pocket, which is not on. */
TEST(a_combination_is_planned) {
  lay_out(CAROM_RACK_TENBALL, CAROM_TABLE_POOL_9FT, 0x423);
  put(0, 0.3, 0.9);
  put(1, 0.2, 0.35);
  put(5, 0.035, 0.04);
  put(10, 1.0, 2.2);
  carom_plan_stroke best[5];
  const int found = best_of(CAROM_RULES_TENBALL, 2000, best, 5);
  bool calls_five = false;
  for (int k = 0; k < found; k++)
    calls_five |= best[k].ball == 5 && best[k].pocket >= 0 && best[k].keep > 0.3;
  ck_assert_msg(calls_five, "the best calls %d, keeps %g", best[0].ball, best[0].keep);
}
