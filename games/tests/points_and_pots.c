/* Games that are planned: values of points, and strokes that are chosen. */
#include "game_support.h"

/* Chances: more points are better, and so are fewer that the other has; those of both players add
 * up to about one where nothing can be potted. */
TEST(values_of_points) {
  for (int game = 0; game < 2; game++) {
    const carom_rules_kind kind = game == 0 ? CAROM_RULES_STRAIGHT : CAROM_RULES_SNOOKER;
    carom_plan_rules game_rules = carom_plan_rules_of(kind);
    lay_out(game == 0 ? CAROM_RACK_EIGHTBALL : CAROM_RACK_SNOOKER,
            game == 0 ? CAROM_TABLE_POOL_9FT : CAROM_TABLE_SNOOKER, ALL);
    const carom_plan_job job = job_of(&game_rules, 1.0, 0);
    double last = -1.0, value;
    for (int score = 0; score <= 99; score += 9) {
      game_rules.state.score[0] = score;
      game_rules.state.score[1] = 40;
      expect_ok(carom_plan_value(&job, 0, &value));
      ck_assert_msg(value >= last && value >= 0.0 && value <= 1.0, "%d: %g after %g", score, value,
                    last);
      last = value;
    }
    last = 2.0;
    for (int opponent = 0; opponent <= 99; opponent += 9) {
      game_rules.state.score[0] = 40;
      game_rules.state.score[1] = opponent;
      expect_ok(carom_plan_value(&job, 0, &value));
      ck_assert(value <= last);
      last = value;
    }
    ck_assert(last < 0.25);
    game_rules.state.score[1] = 40;
    expect_ok(carom_plan_value(&job, 1, &value));
    ck_assert(value > 0.3 && value < 0.95);
  }
}

/* With the black alone a lead of eight points has won the frame, whoever is at the table; one of
 * seven has not. */
TEST(values_of_a_claim) {
  lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, BK | 1);
  for (int lead = -9; lead <= 9; lead++) {
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    game_rules.state.score[0] = 50 + lead;
    game_rules.state.score[1] = 50;
    const carom_plan_job job = job_of(&game_rules, 1.0, 0);
    double value;
    expect_ok(carom_plan_value(&job, 0, &value));
    if (lead > 7 || lead < -7)
      ck_assert_msg(value == (lead > 0 ? 1.0 : 0.0), "%d ahead: %g", lead, value);
    else
      ck_assert_msg(value > 0.0 && value < 1.0, "%d ahead: %g", lead, value);
  }
}

/* One-pocket: a ball before a pocket is worth much to its player only, who plays it there; fewer
 * balls that are needed, or owed, are better. */
TEST(pocket_of_ones_own) {
  lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0x7);
  put(0, 0.6, 1.6);
  put(1, table.width - 0.15, table.length - 0.15);
  put(2, 0.5 * table.width, 0.1);
  carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_ONEPOCKET);
  const carom_plan_job job = job_of(&game_rules, 1.0, 1000);
  const carom_rules_state states[] = {{.pocket = {MINE, HIS}, .score = {7, 6}},
                                      {.pocket = {MINE, HIS}, .score = {6, 6}},
                                      {.pocket = {MINE, HIS}, .score = {7, 7}},
                                      {.pocket = {MINE, HIS}, .score = {7, 6}, .lost = {1}},
                                      {.pocket = {HIS, MINE}, .score = {7, 6}}};
  double value[5];
  for (int k = 0; k < 5; k++) {
    const bool mine = states[k].pocket[0] == MINE;
    game_rules.state = states[k];
    carom_plan_stroke best;
    int found;
    expect_ok(carom_plan_value(&job, 0, &value[k]));
    expect_ok(carom_plan(&job, &best, 1, &found));
    ck_assert_msg(!mine || (best.ball == 1 && best.pocket == MINE), "%d: ball %d", k, best.ball);
  }
  ck_assert_msg(value[0] > value[4] + 0.2 && value[0] > value[1] + 0.01 && value[0] > value[2] &&
                    fabs(value[3] - value[1]) < 1e-9,
                "%g %g %g %g %g", value[0], value[1], value[2], value[3], value[4]);
}

/* Snooker: after a red a plan takes the black, where it is as easy as the yellow; and the yellow
 * where the black is out of reach. */
TEST(colours_by_value_and_position) {
  for (int k = 0; k < 2; k++) {
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    game_rules.state.on = 1;
    lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1 | Y | BK);
    const double w = table.width, l = table.length;
    put(0, 0.5 * w, 0.5 * l);
    put(1, 0.5 * w, 0.6 * l);
    /* both before a corner, or the black far along a rail */
    put(YELLOW, 0.15, 0.15);
    put(BLACK, w - 0.15, k == 0 ? 0.15 : l - 0.5);
    if (k == 1)
      put(BLACK, 0.027, 0.7 * l);
    const carom_plan_job job = job_of(&game_rules, 0.3, 2000);
    carom_plan_stroke best;
    int found;
    expect_ok(carom_plan(&job, &best, 1, &found));
    ck_assert_msg(best.ball == (k == 0 ? BLACK : YELLOW), "%d: ball %d", k, best.ball);
  }
}
