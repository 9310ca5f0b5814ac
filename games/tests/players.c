/* Players: errors by ratings and in strokes. */
#include "plan_support.h"

/* A player plays as well with any tip: his strokes give the ball the same speeds, and a plan finds
 * the same choices, by cues that are faster by 2/(1 + e). */
TEST(players_of_any_tip) {
  static const double gain = 2.0 / (1.0 + CAROM_TIP_LEATHER);
  carom_plan_stroke choices[2][3];
  int found[2];
  for (int tip = 0; tip < 2; tip++) {
    make_layout(18, 3);
    cue.tip_restitution = tip == 0 ? 1.0 : CAROM_TIP_LEATHER;
    found[tip] = plan(false, choices[tip], 3);
  }
  ck_assert_int_eq(found[0], found[1]);
  const carom_plan_stroke *a = &choices[0][0], *b = &choices[1][0];
  ck_assert_double_eq_tol(b->cue.speed, gain * a->cue.speed, 1e-12);
  /* This stroke is raised by 0.9 degrees: the slate acts while the tip does, and tips of other
   * restitution share the time otherwise. */
  ck_assert_double_eq_tol(b->cue.phi, a->cue.phi, 1e-3);
  ck_assert_double_eq_tol(b->value, a->value, 0.01);

  /* strokes; at the default bounds too */
  for (uint64_t n = 0; n < 200; n++) {
    const carom_player errs = carom_player_of(n < 100 ? 1.0 : 40.0);
    double speed[2];
    for (int tip = 0; tip < 2; tip++) {
      cue = carom_cue_of(CAROM_GAME_POOL);
      cue.tip_restitution = tip == 0 ? 0.0 : CAROM_TIP_LEATHER;
      cue.speed = 3.0 * (tip == 0 ? 1.0 : gain);
      carom_player_strike(&errs, 7, n, &cue);
      speed[tip] = cue.speed;
    }
    ck_assert_double_eq_tol(speed[1], gain * speed[0], 1e-14);
  }
}

/* Errors fall with the rating, shots and sense rise, and all stay beyond the ends. An error of aim
 * of 0.25 degrees at 2 m/s is a 500. */
TEST(ratings) {
  carom_player last = {.phi = INFINITY, .only_pots = 1.0};
  for (int rating = 200; rating <= 850; rating += 5) {
    const carom_player p = carom_player_fargo(rating);
    ck_assert(p.phi < last.phi && p.phi > 0.0 && p.a == p.b);
    ck_assert(p.shots >= last.shots && p.only_pots <= last.only_pots && p.only_pots >= 0.0);
    last = p;
  }
  const carom_player ends[2] = {carom_player_fargo(200.0), carom_player_fargo(850.0)};
  const carom_player beyond[3] = {carom_player_fargo(100.0), carom_player_fargo(900.0),
                                  carom_player_fargo(NAN)};
  ck_assert(memcmp(&ends, &beyond, sizeof ends) == 0);
  ck_assert(beyond[2].phi == ends[0].phi);
  const carom_player league = carom_player_fargo(500.0);
  ck_assert_double_eq_tol(league.phi * sqrt(1.25), 0.25, 1e-12);
  ck_assert_double_eq_tol(league.speed_share, 0.035 * pow(2.5, 0.7), 1e-12);
  ck_assert_double_eq_tol(carom_player_fargo(450.0).phi / league.phi, sqrt(0.394 / 0.25), 1e-12);

  /* in each game a 500 is the same, between the least and the best; what is none is eight-ball */
  for (int k = -1; carom_rules_about_of((carom_rules_kind)(k + 1)) != NULL; k++) {
    const carom_player same = carom_player_rated(500.0, (carom_rules_kind)k);
    const carom_player best = carom_player_rated(850.0, (carom_rules_kind)k);
    const carom_player least = carom_player_rated(200.0, (carom_rules_kind)k);
    ck_assert(memcmp(&same, &league, sizeof same) == 0 && best.phi < league.phi);
    ck_assert(least.phi > league.phi && least.shots >= 100.0 && least.only_pots <= 1.0);
  }
}

/* Errors of aim and of the tip grow with the speed, that of aim with the elevation too; but not
 * those of a player without growth. */
TEST(errors_grow) {
  static const double speed[2] = {1.0, 4.0}, theta[2] = {0.0, 60.0};
  for (int grows = 0; grows < 2; grows++) {
    const carom_player errs = {.phi = 0.1, .a = 0.001, .growth = grows ? 0.25 : 0.0};
    double off[4], side[4];
    for (int k = 0; k < 4; k++) {
      carom_cue stroke = {.speed = speed[k % 2], .theta = theta[k / 2], .tip_restitution = 1.0};
      carom_player_strike(&errs, 3, 8, &stroke);
      off[k] = stroke.phi;
      side[k] = stroke.a;
    }
    const double more = grows ? sqrt((1.0 + 1.0) / (1.0 + 0.0625)) : 1.0;
    ck_assert_double_eq_tol(off[1] / off[0], more, 1e-12);
    ck_assert_double_eq_tol(side[1] / side[0], more, 1e-12);
    ck_assert_double_eq_tol(off[2] / off[0], grows ? 2.0 : 1.0, 1e-12);
    ck_assert(side[2] == side[0]);
  }
}

/* A player who thinks of nothing but potting plans as one whose opponent makes every ball; a share
 * of strokes is drawn by the seeds of one layout, and by the layouts of one seed; the player's
 * shots count where the options have none, and a player whose errors grow never smashes. */
TEST(players_choose) {
  enum { PLANS = 8 };
  carom_plan_stroke choice[2];
  int differ[2] = {0, 0};
  for (uint64_t n = 0; n < 2 * PLANS; n++) {
    const bool of_layouts = n >= PLANS;
    make_layout(of_layouts ? n : 18, 3);
    options = (carom_plan_options){.seed = of_layouts ? 0 : n};
    player = carom_player_fargo(400.0);
    player.only_pots = 0.5;
    player.shots = 300.0;
    plan(false, &choice[0], 1);
    ck_assert(choice[0].cue.speed <= 4.0 * 2.0 / (1.0 + CAROM_TIP_LEATHER) + 1e-12);

    /* the same by the options of a caller: of a stroke that only pots, or of any other */
    int same = 0;
    for (int pots = 0; pots < 2; pots++) {
      options.shots = 300;
      options.chance_me = pots ? 0.9 : 0.0;
      options.chance_opponent = pots ? 1.0 : 0.0;
      player.only_pots = player.shots = 0.0;
      plan(false, &choice[1], 1);
      if (memcmp(&choice[0], &choice[1], sizeof choice[0]) == 0) {
        same++;
        differ[of_layouts] += pots;
      }
    }
    ck_assert_int_eq(same, 1);
  }
  for (int k = 0; k < 2; k++)
    ck_assert(differ[k] > 0 && differ[k] < PLANS);
}

/* In straight pool, whose points one visit never makes, a player who only pots takes the ball in
 * the jaws: values that were the chance of all points were 0, and safeties were as good. */
TEST(who_only_pots_takes_the_sure_ball) {
  enum { SEEDS = 8 };
  int sure = 0;
  for (uint64_t seed = 0; seed < SEEDS; seed++) {
    lay_out_game(CAROM_RULES_STRAIGHT, 1);
    balls[0].state.r[1] = 0.3;
    balls[1].state.r[0] = balls[1].state.r[1] = 0.06;
    player = carom_player_fargo(600.0);
    player.only_pots = 1.0;
    options = (carom_plan_options){.shots = 500, .seed = seed};
    carom_plan_stroke choice;
    plan(false, &choice, 1);
    ck_assert_int_ne(choice.kind, CAROM_PLAN_SAFETY);
    sure += choice.ball == 1 && choice.keep > 0.9;
  }
  ck_assert_int_gt(sure, SEEDS / 4);
}

/* A player's strokes have his errors, and stay within his bounds. */
TEST(strokes_err) {
  enum { STROKES = 4000 };
  const carom_player wild = {.speed = 0.3, .speed_share = 0.2, .phi = 2.0, .b = 0.4};
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < STROKES; k++) {
    carom_cue first = {.speed = 2.0, .phi = 30.0, .theta = 5.0, .a = 0.1, .b = 0.2}, second = first;
    carom_player_strike(&wild, test_seed(), (uint64_t)k, &first);
    carom_player_strike(&wild, test_seed(), (uint64_t)k, &second);
    ck_assert(memcmp(&first, &second, sizeof first) == 0);
    ck_assert(first.speed >= 0.5 && first.speed <= 8.0 && fabs(first.b) <= 0.5);
    ck_assert(first.theta == 5.0 && first.a == 0.1);
    sum += first.phi - 30.0;
    squares += (first.speed - 2.0) * (first.speed - 2.0);
  }
  /* 0.3 and 0.2 of 2 m/s make 0.5; five standard errors */
  ck_assert(fabs(sum / STROKES) < 5.0 * 2.0 / sqrt(STROKES));
  ck_assert(fabs(sqrt(squares / STROKES) - 0.5) < 5.0 * 0.5 / sqrt(2.0 * STROKES));

  /* a bound that is beyond the other one's default */
  const carom_player slow = {.speed_most = 0.3}, fast = {.speed_least = 9.0};
  carom_cue first[2] = {{.speed = 0.1}, {.speed = 10.0}};
  carom_player_strike(&slow, 1, 1, &first[0]);
  carom_player_strike(&fast, 1, 1, &first[1]);
  ck_assert(first[0].speed == 0.3 && first[1].speed == 9.0);
}

/* Ratings by games, compared with sums over 2,000,001 ratings, by NumPy: none, few, half of the
 * games won or all or none, so many that the density is a needle; and what is rejected. */
TEST(rating_by_games) {
  static const struct {
    carom_score scores[2];
    double mean, low, high;
  } known[] = {{{{0, 0, 0}, {0, 0, 0}}, 426.37834, 219.09101, 696.51005},
               {{{500, 7, 3}, {600, 2, 4}}, 541.01983, 409.47716, 672.87243},
               {{{400, 200, 100}, {0, 0, 0}}, 498.97971, 464.89153, 533.72511},
               {{{800, 1000, 0}, {0, 0, 0}}, 849.65026, 848.71142, 849.99113},
               {{{300, 0, 1000}, {0, 0, 0}}, 200.43274, 200.01098, 201.59361},
               {{{500, 1e9, 1e9}, {0, 0, 0}}, 500.0, 499.98735, 500.01265},
               {{{0, 5, 3.5}, {1000, 1, 2}}, 298.20865, 204.24671, 470.35038}};
  carom_rating rating;
  for (size_t k = 0; k < COUNT_OF(known); k++) {
    expect_ok(carom_rating_of(known[k].scores, 2, &rating));
    ck_assert_double_eq_tol(rating.mean, known[k].mean, 2e-5);
    ck_assert_double_eq_tol(rating.low, known[k].low, 2e-5);
    ck_assert_double_eq_tol(rating.high, known[k].high, 2e-5);
    ck_assert_int_eq(rating.row, -1);
  }
  static const double wrong[] = {-1.0, NAN, -1.0, NAN, INFINITY, NAN};
  for (int k = 0; k < 6; k++) {
    carom_score scores[] = {{500, 1, 1}, {500, 1, 1}};
    (&scores[1].against)[k / 2] = wrong[k];
    ck_assert_int_eq(carom_rating_of(scores, 2, &rating), CAROM_ERROR_SCORE);
    ck_assert(rating.row == 1 && rating.mean != rating.mean);
  }
}
