/* Snooker: what is on, double hits, spots and free balls. situations.txt has its rulings. */
#include "game_support.h"

/* What is on. */
TEST(snooker_on) {
  static const struct {
    uint32_t in_play;
    int colour, after_foul;
    uint32_t targets;
  } cases[] = {
      {ALL, 0, 0, 0xfffe},          {ALL & ~R1, 1, 0, COLOURS},      {ALL, 0, FREE, ALL & ~1},
      {COLOURS | 1, 1, 0, COLOURS}, {COLOURS | 1, 0, 0, Y},          {PI | BK | 1, 0, MAY, PI},
      {BK | 1, 0, 0, BK},           {COLOURS | 1, 0, FREE, COLOURS}, {COLOURS | R2 | 1, 0, 0, R2}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    game_rules.state.on = cases[k].colour;
    game_rules.state.may = cases[k].after_foul;
    ck_assert_uint_eq(game_rules.on(&game_rules.state, cases[k].in_play), cases[k].targets);
  }
}

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
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    carom_facts f = facts_of(1, 2, 0, 0), second = f;
    f.frozen = cases[k].frozen;
    f.pushed = cases[k].pushed;
    f.touches = cases[k].touches;
    ck_assert_msg((int)carom_foul_of(&f, R1, 0) == cases[k].pool, "%s", cases[k].what);
    for (int game = 0; carom_rules_about_of((carom_rules_kind)game) != NULL; game++) {
      if (game == CAROM_RULES_FOURBALL)
        continue; /* ball 1 may not be met */
      carom_plan_rules rules = carom_plan_rules_of((carom_rules_kind)game);
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
    nine.state.may = CAROM_MAY_PUSH;
    ck_assert_int_eq(nine.judge(&nine.state, 0x3ff, 0, &f, (carom_call){CAROM_CALL_PUSH, -1}).foul,
                     cases[k].pool);
  }
}

/* A cue ball that flies over a ball before it meets one is a foul in snooker (WPBSA, section 2,
 * rule 19), which costs what the ball that it flew over is worth. */
TEST(snooker_jumps) {
  static const struct {
    const char *what;
    double theta, speed, x,
        place[2]; /* how far beside the way the blue is; of the red and the blue */
    uint32_t jumped;
    int foul, second;
  } cases[] = {{"over the blue", 30.0, 4.0, 0.0, {1.0, 0.35}, UINT32_C(1) << BLUE, JUMP, 5},
               {"beside it", 30.0, 4.0, 0.06, {1.0, 0.35}, 0, LEGAL, 0},
               {"level, with the blue behind", 0.0, 4.0, 0.0, {0.3, 0.9}, 0, LEGAL, 0}};
  carom_table_make(CAROM_TABLE_SNOOKER, &table);
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
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
    ck_assert_int_eq(carom_shoot(&table, balls, 22, &cue, NULL, &shot), CAROM_OK);
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
  carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
  carom_turn turn = {.outcome = CAROM_TURN_PASS, .foul = CAROM_FOUL_POT, .spot = Y | BK};
  ck_assert_int_eq(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn),
                   CAROM_OK);
  ck_assert(is_at(BLACK, spot[BLACK][0], spot[BLACK][1]) &&
            is_at(YELLOW, spot[PINK][0], spot[PINK][1]));

  /* one whose own spot is free keeps it from a higher one whose own is taken */
  lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1 | R2);
  put(1, spot[BLACK][0], spot[BLACK][1]);
  put(2, spot[PINK][0], spot[PINK][1]);
  turn.spot = BL | BK;
  ck_assert_int_eq(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn),
                   CAROM_OK);
  ck_assert(is_at(BLUE, spot[BLUE][0], spot[BLUE][1]) &&
            is_at(BLACK, spot[BROWN][0], spot[BROWN][1]));
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_SNOOKER, &table, 22, spot[0]), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_NINEBALL, &table, -1, spot[0]), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_NINEBALL, NULL, 1, spot[0]), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_turn_settle(&game_rules, NULL, &table, balls, count, &turn),
                   CAROM_ERROR_NULL);
  turn.spot = 1u << 22;
  ck_assert_int_eq(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn),
                   CAROM_ERROR_BALLS);
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
  } cases[] = {
      {"nothing in the way", {0.9, 2.0}, {0.2, 2.0}, false, false},
      {"full behind the black", {0.9, 2.0}, {0.9, 1.5}, false, true},
      {"one edge behind it", {0.9, 2.0}, {0.9 + 1.2 * R, 1.9}, false, true},
      {"beside the way", {0.9, 2.0}, {0.9 + 4.1 * R, 1.9}, false, false},
      {"behind the red", {0.9, 2.0}, {0.9, 2.2}, false, false},
      {"in hand, from elsewhere in the D", {0.9, 2.0}, {0.9, 1.5}, true, false},
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1 | BK);
    put(0, 0.9, 1.0);
    put(1, cases[k].red[0], cases[k].red[1]);
    put(BLACK, cases[k].blocker[0], cases[k].blocker[1]);
    for (int foul = 0; foul < 2; foul++) {
      carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
      game_rules.state.may = foul ? MAY : 0;
      carom_turn turn = {.outcome = CAROM_TURN_PASS,
                         .leave = cases[k].hand ? CAROM_LEAVE_D : CAROM_LEAVE_AFTER,
                         .foul = foul ? CAROM_FOUL_NO_BALL : 0};
      carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn);
      ck_assert_msg(((game_rules.state.may & FREE) != 0) == (foul && cases[k].snookered),
                    "%s, foul %d", cases[k].what, foul);
    }
  }

  /* in hand, with a wall of colours close to the D */
  int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, R1 | COLOURS);
  carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
  game_rules.state.may = MAY | HAND;
  carom_turn turn = {
      .outcome = CAROM_TURN_PASS, .leave = CAROM_LEAVE_D, .foul = CAROM_FOUL_CUE_BALL};
  put(1, 1.3, 3.4);
  carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn);
  ck_assert(!(game_rules.state.may & FREE));
  for (int k = YELLOW; k <= BLACK; k++)
    put(k, 1.3 + 2.0 * R * (k - 18.5), 3.2);
  game_rules.state.may = MAY | HAND;
  carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn);
  ck_assert(game_rules.state.may & FREE);

  /* a second red that is free ends it */
  balls[2] = balls[1];
  put(2, 0.2, 2.0);
  game_rules.state.may = MAY | HAND;
  carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn);
  ck_assert(!(game_rules.state.may & FREE));

  /* to leave the other behind the free ball is a foul; behind another it is not, nor with pink and
   * black alone; of two in one way the nearer one is it, of those before two reds none */
  static const struct {
    uint32_t lie;
    int target, named, points;
    double yellow[2];
  } behind[] = {
      {1 | R1 | Y | BK, 1, BLACK, 4, {0.2, 0.2}},  {1 | R1 | Y | BK, 1, YELLOW, 0, {0.2, 0.2}},
      {1 | PI | BK, PINK, BLACK, 0, {0.0, 0.0}},   {1 | BL | PI | BK, BLUE, BLACK, 5, {0.0, 0.0}},
      {1 | R1 | Y | BK, 1, YELLOW, 4, {0.9, 1.3}}, {1 | R1 | R2 | Y | BK, 1, BLACK, 0, {0.6, 1.3}}};
  for (int k = 0; k < 6; k++) {
    count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, behind[k].lie);
    put(0, 0.9, 1.0);
    put(behind[k].target, 0.9, 2.0);
    put(BLACK, 0.9, 1.5);
    if (behind[k].lie & Y)
      put(YELLOW, behind[k].yellow[0], behind[k].yellow[1]);
    if (behind[k].lie & R2)
      put(2, 0.3, 1.6);
    game_rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    game_rules.state.free_ball = behind[k].named;
    turn = (carom_turn){.outcome = CAROM_TURN_PASS};
    carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn);
    ck_assert_msg((turn.foul != 0) == (behind[k].points > 0) && game_rules.state.free_ball == 0 &&
                      game_rules.state.score[0] == behind[k].points &&
                      game_rules.state.may == (behind[k].points > 0 ? MAY | FREE : 0),
                  "%d: foul %d, %d points", k, turn.foul, game_rules.state.score[0]);
  }
}
