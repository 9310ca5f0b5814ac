/* Snooker: double hits, jumps and spots. situations.txt has its rulings, what is on and free
 * balls. */
#include "game_support.h"

/* A ball that is met while the tip is on the cue ball: `frozen` before the stroke, `pushed` in it.
 * In snooker reds are on. Before the same shot without a touch of a cushion, and after a loss. */
TEST(double_hits) {
  static const struct {
    const char *what;
    uint32_t frozen, pushed;
    int touches, pool, snooker, three;
  } cases[] = {{"as usual", 0, 0, 1, LEGAL, LEGAL, LEGAL},
               {"through a frozen ball", R1, R1, 1, LEGAL, DOUBLE_HIT, DOUBLE_HIT},
               {"the same, touched twice", R1, R1, 2, LEGAL, DOUBLE_HIT, DOUBLE_HIT},
               {"away from it", R1, 0, 1, LEGAL, LEGAL, LEGAL},
               {"a near ball", 0, R1, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"a near ball, touched twice", 0, R1, 2, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"a near ball beside a frozen one", R2, R1, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"one of each", R2, R1 | R2, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"touched twice, with no ball", 0, 0, 2, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT}};
  for (size_t k = 0; k < COUNT_OF(cases); k++) {
    carom_facts f = facts_of(1, 2, 0, 0), second = f;
    f.frozen = cases[k].frozen;
    f.pushed = cases[k].pushed;
    f.touches = cases[k].touches;
    ck_assert_msg((int)carom_foul_of(&f, R1, 0) == cases[k].pool, "%s", cases[k].what);
    for (int game = 0; carom_rules_about_of((carom_rules_kind)game) != NULL; game++) {
      if (game == CAROM_RULES_FOURBALL)
        continue; /* ball 1 may not be met */
      carom_plan_rules rules = carom_plan_rules_of((carom_rules_kind)game);
      rules.state.seat = rules.race == CAROM_RACE_SEATS; /* ball 1 is that of seat 0 */
      int foul = cases[k].pool;
      if (game == CAROM_RULES_SNOOKER || game == CAROM_RULES_BLACKBALL)
        foul = cases[k].snooker;
      else if (game == CAROM_RULES_THREECUSHION || game == CAROM_RULES_STRAIGHTRAIL)
        foul = cases[k].three;
      const carom_turn turn = rules.judge(&rules.state, 0xffff, 0, &f, (carom_call){NONE, -1});
      ck_assert_msg((int)turn.foul == foul, "%s: %s", carom_word(CAROM_WORDS_RULES, game),
                    cases[k].what);
    }

    /* before a cushion, after a ball that is not on, and in a push-out too */
    f.cushions_after = second.cushions_after = 0;
    ck_assert_int_eq(carom_foul_of(&f, R1, 0), cases[k].pool == LEGAL ? CUSHION : DOUBLE_HIT);
    ck_assert_int_eq(carom_foul_of(&f, R2, 0), FIRST);
    carom_plan_rules nine = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    nine.state.may = CAROM_CHOICE_PUSH;
    ck_assert_int_eq(nine.judge(&nine.state, 0x3ff, 0, &f, (carom_call){CAROM_CALL_PUSH, -1}).foul,
                     cases[k].pool);
  }
}

/* A cue ball that flies over a ball before it meets one is a foul in snooker (WPBSA, section 2,
 * rule 19), which costs what the ball that it flew over is worth. */
TEST(snooker_jumps) {
  static const struct {
    const char *what;
    double theta, speed, x, place[2]; /* how far off the way the blue is; of the red and the blue */
    uint32_t jumped;
    int foul, second;
  } cases[] = {{"over the blue", 30.0, 4.0, 0.0, {1.0, 0.35}, UINT32_C(1) << BLUE, JUMP, 5},
               {"beside it", 30.0, 4.0, 0.06, {1.0, 0.35}, 0, LEGAL, 0},
               {"level, with the blue behind", 0.0, 4.0, 0.0, {0.3, 0.9}, 0, LEGAL, 0}};
  carom_table_make(CAROM_TABLE_SNOOKER, &table);
  for (size_t k = 0; k < COUNT_OF(cases); k++) {
    carom_rack(CAROM_RACK_SNOOKER, &table, 1e-4, 1, balls, 22);
    for (int ball = 2; ball < 22; ball++)
      balls[ball].state.label = CAROM_BALL_POCKETED;
    const double x = 0.5 * table.width;
    carom_place_ball(&table, balls, 22, 0, x, 1.0, NULL);
    carom_place_ball(&table, balls, 22, 1, x, 1.0 + cases[k].place[0], NULL);
    carom_place_ball(&table, balls, 22, BLUE, x + cases[k].x, 1.0 + cases[k].place[1], NULL);
    carom_cue cue = carom_cue_of(CAROM_GAME_SNOOKER);
    cue.speed = cases[k].speed;
    cue.theta = cases[k].theta;
    cue.a = cue.b = 0.0;
    carom_facts facts;
    carom_ball_state final[22];
    carom_shot shot = {.facts = &facts, .final = final};
    expect_ok(carom_shoot(&table, balls, 22, &cue, NULL, &shot));
    ck_assert_msg(facts.jumped == cases[k].jumped && facts.first[0] == 1, "%s: %x, %d",
                  cases[k].what, facts.jumped, (int)facts.first[0]);
    const carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    carom_ruling ruling;
    carom_referee(&rules, &table, balls, 22, 0, &shot, (carom_call){NONE, -1}, &ruling);
    ck_assert_msg(ruling.turn.foul == cases[k].foul, "%s: %d", cases[k].what,
                  (int)ruling.turn.foul);
    ck_assert_int_eq(ruling.state.score[0], cases[k].second);
  }
}

/* Colours go to their own spots. situations.txt has those whose spots are taken. */
TEST(snooker_spots) {
  const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1);
  const double l = table.length;
  double spot[BALLS_MOST][2];
  for (int k = 0; k < BALLS_MOST; k++)
    expect_ok(carom_spot_of(CAROM_RACK_SNOOKER, &table, k, spot[k]));
  ck_assert(spot[YELLOW][0] > spot[BROWN][0] && spot[GREEN][0] < spot[BROWN][0]);
  ck_assert(spot[BLUE][1] == 0.5 * l && spot[PINK][1] == 0.75 * l);
  ck_assert(fabs(l - spot[BLACK][1] - 0.324) < 1e-3);
  for (int k = YELLOW; k <= BLACK; k++) {
    expect_ok(carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, k));
    ck_assert(is_at(k, spot[k][0], spot[k][1]));
  }
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_SNOOKER, &table, 22, spot[0]), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_NINEBALL, &table, -1, spot[0]), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_NINEBALL, NULL, 1, spot[0]), CAROM_ERROR_NULL);
  carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
  carom_turn turn = {.outcome = CAROM_TURN_PASS, .spot = UINT32_C(1) << 22};
  ck_assert_int_eq(carom_turn_settle(&game_rules, NULL, &table, balls, count, &turn),
                   CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn),
                   CAROM_ERROR_BALLS);
}
