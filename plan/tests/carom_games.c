/* Three-cushion and straight rail: plans, and equal innings. situations.txt and matches.txt have their
 * rulings. */
#include "carom_match.h"
#include "game_support.h"

/* A plan finds a point of straight rail that three-cushion would not count. */
TEST(a_point_is_planned) {
  const int count = lay_out(CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION, 7);
  put(0, 0.5, 0.8);
  put(1, 0.7, 1.2);
  put(2, 0.8, 1.25);
  const carom_cue cue = carom_cue_of(CAROM_GAME_BILLIARD);
  const carom_player player = carom_player_of(0.5);
  const carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_STRAIGHTRAIL);
  const carom_plan_options options = {.shots = 1000};
  carom_plan_job job = job_of(count, &cue, &player, &game_rules, &options);
  carom_plan_stroke best;
  int found;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  ck_assert_msg(best.keep > 0.9, "keeps %g", best.keep);
  free(job.memory);
}

/* Other games have no equal innings, and some no target. */
TEST(games_without_equal_innings) {
  static carom_match match;
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    carom_table_make((carom_table_kind)carom_rules_about_of((carom_rules_kind)kind)->table, &table);
    const carom_status status =
        carom_match_begin_to(&match, (carom_rules_kind)kind, 0, 1, &table, 1, 0);
    if (kind == CAROM_RULES_THREECUSHION || kind == CAROM_RULES_STRAIGHTRAIL) {
      ck_assert_int_eq(status, CAROM_OK);
      continue;
    }
    ck_assert_int_eq(status, CAROM_ERROR_ACT);
    ck_assert_str_eq(match.fault, "begin: innings must be 0, as the game has none");
  }
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  ck_assert_int_eq(carom_match_begin_to(&match, CAROM_RULES_EIGHTBALL, 5, 0, &table, 1, 0),
                   CAROM_ERROR_ACT);
  ck_assert_str_eq(match.fault, "begin: target must be 0, as the game has none");
}

/* Plans know the last points: the one of who began, who then plays no more, and those of the
 * equalizing inning, whose misses lose the game. */
TEST(plans_of_equal_innings) {
  const carom_cue cue = carom_cue_of(CAROM_GAME_BILLIARD);
  const carom_player player = carom_player_of(4.0);
  const carom_plan_options options = {.shots = 1000};
  carom_plan_stroke best[4];
  for (int innings = 0; innings <= 3; innings++) {
    const int count = lay_out(CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION, 7);
    put(0, 0.5, 0.8);
    put(1, 0.7, 1.2);
    put(2, 0.8, 1.25);
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_STRAIGHTRAIL);
    game_rules.state.score[0] = game_rules.state.target - 1;
    game_rules.state.innings = innings;
    carom_plan_job job = job_of(count, &cue, &player, &game_rules, &options);
    int found;
    ck_assert_int_eq(carom_plan(&job, &best[innings], 1, &found), CAROM_OK);
    free(job.memory);
    const carom_plan_stroke *c = &best[innings];
    ck_assert_msg(c->ball >= 0 && c->kind != CAROM_PLAN_SAFETY, "innings %d", innings);
    ck_assert(c->value == best[0].value && c->keep == best[0].keep);
  }
  ck_assert_msg(best[0].keep > 0.3 && best[0].keep < 1.0, "keeps %g", best[0].keep);
}
