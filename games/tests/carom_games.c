/* Three-cushion and straight rail: plans, and equal innings. situations.txt and matches.txt have
 * their rulings. */
#include "carom_match.h"
#include "plan_support.h"

/* Plans a stroke of straight rail with all balls near each other, by a player whose errors are so
 * many times as large; equal innings are those of the rules. */
static carom_plan_stroke plan_straight_rail(double errors, int innings) {
  static const double places[][2] = {{0.5, 0.8}, {0.7, 1.2}, {0.8, 1.25}};
  carom_plan_stroke best;
  lay_out_game(CAROM_RULES_STRAIGHTRAIL, 1);
  for (int k = 0; k < 3; k++)
    memcpy(balls[k].state.r, places[k], sizeof places[k]);
  player = carom_player_of(errors);
  options = (carom_plan_options){.shots = 1000};
  if (innings >= 0)
    rules.state.score[0] = rules.state.target - 1;
  rules.state.innings = innings > 0 ? innings : 0;
  plan(false, &best, 1);
  return best;
}

/* A plan finds a point of straight rail that three-cushion would not count. */
TEST(a_point_is_planned) {
  const carom_plan_stroke best = plan_straight_rail(0.5, -1);
  ck_assert_msg(best.keep > 0.9, "keeps %g", best.keep);
}

/* Other games have no equal innings, and some no target. */
TEST(games_without_equal_innings) {
  static carom_match match;
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    carom_table_make((carom_table_kind)carom_rules_about_of((carom_rules_kind)kind)->table, &table);
    carom_match_setup setup = {
        .rules = (carom_rules_kind)kind, .table = &table, .seed = 1, .equal_innings = 1};
    const carom_status status = carom_match_begin_with(&match, &setup);
    if (kind == CAROM_RULES_THREECUSHION || kind == CAROM_RULES_STRAIGHTRAIL) {
      expect_ok(status);
      continue;
    }
    ck_assert_int_eq(status, CAROM_ERROR_ACT);
    ck_assert_str_eq(match.fault, "begin: innings must be 0, as the game has none");
  }
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_match_setup setup = {
      .rules = CAROM_RULES_EIGHTBALL, .table = &table, .seed = 1, .target = 5};
  ck_assert_int_eq(carom_match_begin_with(&match, &setup), CAROM_ERROR_ACT);
  ck_assert_str_eq(match.fault, "begin: target must be 0, as the game has none");
}

/* Plans know the last points: the one of who began, who then plays no more, and those of the
 * equalizing inning, whose misses lose the game. */
TEST(plans_of_equal_innings) {
  const carom_plan_stroke first = plan_straight_rail(4.0, 0);
  ck_assert_msg(first.keep > 0.3 && first.keep < 1.0, "keeps %g", first.keep);
  for (int innings = 0; innings <= 3; innings++) {
    const carom_plan_stroke best = plan_straight_rail(4.0, innings);
    ck_assert_msg(best.ball >= 0 && best.kind != CAROM_PLAN_SAFETY, "innings %d", innings);
    ck_assert(best.value == first.value && best.keep == first.keep);
  }
}
