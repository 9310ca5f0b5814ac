/* Values of layouts, and pockets that count. */
#include "plan_support.h"

/* A game in which balls count in one pocket only. */
static uint32_t one_pocket(const carom_rules_state *state) {
  return UINT32_C(1) << state->user[7];
}

/* Values: the eight alone before a pocket, and with a ball in the way; in hand is no worse. */
TEST(values) {
  double easy, blocked, hand, corner;
  make_layout(1, 2);
  carom_place_ball(&table, balls, BALLS, 8, 0.12, 0.12, NULL);
  carom_place_ball(&table, balls, BALLS, 0, 0.5, 0.5, NULL);
  ck_assert_int_eq(carom_plan_value(&job, 0, &easy), CAROM_OK);
  carom_place_ball(&table, balls, BALLS, 9, 0.35, 0.35, NULL);
  ck_assert_int_eq(carom_plan_value(&job, 0, &blocked), CAROM_OK);
  ck_assert_int_eq(carom_plan_value(&job, 1, &hand), CAROM_OK);
  ck_assert(easy > 0.85 && easy <= 1.0 && blocked < easy - 0.1 && hand > blocked);

  /* a pocket that does not count is worth nothing */
  make_layout(1, 2);
  carom_place_ball(&table, balls, BALLS, 8, 0.12, 0.12, NULL);
  carom_place_ball(&table, balls, BALLS, 0, 0.5, 0.5, NULL);
  rules.pockets = one_pocket;
  for (uint64_t pocket = 0; pocket < 6; pocket++) {
    rules.state.user[7] = pocket;
    ck_assert_int_eq(carom_plan_value(&job, 0, &corner), CAROM_OK);
    const double *centre = table.pocket[pocket].centre;
    if (centre[0] < 0.5 && centre[1] < 0.5)
      ck_assert_double_gt(corner, 0.9);
    else
      ck_assert_double_lt(corner, 0.8);
  }

  /* players who pot next to nothing; to one who makes every ball a miss is worth nothing */
  options.chance_me = options.chance_opponent = 1e-17;
  ck_assert_int_eq(carom_plan_value(&job, 0, &blocked), CAROM_OK);
  options.chance_opponent = 1.0;
  ck_assert_int_eq(carom_plan_value(&job, 0, &hand), CAROM_OK);
  ck_assert(hand >= 0.0 && hand < blocked && blocked <= 1.0);
}
