/* Odds of matches, compared with all courses of a match, and ratings of players who are drawn. */
#include "carom_coach.h"
#include "carom_match.h"
#include "support.h"

static carom_series match;
static carom_odds odds;

/* The chance of side 0 in a game with this lead, as carom_coach.h defines it. */
static double chance(double lead) {
  return 1.0 / (1.0 + pow(2.0, -lead / 100.0));
}

/* Goes through all courses of one set from a score on, and adds their chances. */
static void play_on(int breaks, int won, int lost, double likely, carom_odds *sums) {
  const int side = won == match.games[0] ? 0 : 1;
  if (won == match.games[0] || lost == match.games[1]) {
    sums->score[side][side == 0 ? lost : won] += likely;
    sums->games += likely * (won + lost);
    sums->match += side == 0 ? likely : 0.0;
    return;
  }
  const double sign = breaks == 0 ? 1.0 : -1.0;
  const double p = chance(match.rating[0] - match.rating[1] + sign * match.break_points);
  const int next[3][2] = {{1 - breaks, 1 - breaks}, {0, 1}, {1, 0}};
  play_on(next[match.order][0], won + 1, lost, likely * p, sums);
  play_on(next[match.order][1], won, lost + 1, likely * (1.0 - p), sums);
}

TEST(odds_are_those_of_all_courses) {
  for (int n = 0; n < 36; n++) {
    match = (carom_series){.rating = {480.0 + 7.0 * n, 600.0},
                           .break_points = 15.0 * (n % 5 - 1),
                           .games = {1 + n % 6, 1 + n / 6},
                           .order = n % 3,
                           .side = n % 2};
    carom_odds sums = {0};
    play_on(match.side, 0, 0, 1.0, &sums);
    expect_ok(carom_odds_of(&match, &odds));
    NEAR_EACH(odds.score[0], sums.score[0], CAROM_SERIES_MOST, 1e-13);
    NEAR_EACH(odds.score[1], sums.score[1], CAROM_SERIES_MOST, 1e-13);
    ck_assert_double_eq_tol(odds.match, sums.match, 1e-13);
    ck_assert_double_eq_tol(odds.games, sums.games, 1e-12);
    ck_assert(odds.match == odds.set);
    ck_assert_double_eq_tol(odds.game, chance(match.rating[0] - match.rating[1]), 1e-14);
  }
}

/* Who breaks after a game changes the scores, and not who wins to the same number of games (C. L.
 * Anderson, "Note on the advantage of first serve", J. Combin. Theory A 23, 1977). */
TEST(the_order_of_breaks_decides_no_even_race) {
  match = (carom_series){.rating = {560.0, 530.0}, .break_points = 80.0, .games = {7, 7}};
  double by_order[3], score[3];
  for (match.order = 0; match.order < 3; match.order++) {
    expect_ok(carom_odds_of(&match, &odds));
    by_order[match.order] = odds.match;
    score[match.order] = odds.score[0][0];
  }
  ck_assert_double_eq_tol(by_order[1], by_order[0], 1e-13);
  ck_assert_double_eq_tol(by_order[2], by_order[0], 1e-13);
  ck_assert(fabs(score[1] - score[0]) > 0.01 && fabs(score[2] - score[0]) > 0.01);
}

/* Sets of one game whose first breaks alternate are games with alternate breaks; and by lot the
 * odds are the mean of both first breaks. */
TEST(sets_are_a_chain_of_sets) {
  const carom_series games = {
      .rating = {500.0, 540.0}, .break_points = 60.0, .games = {5, 3}, .side = 1};
  carom_odds of_games, of_other;
  expect_ok(carom_odds_of(&games, &of_games));
  match = games;
  match.games[0] = match.games[1] = 1;
  match.sets[0] = 5;
  match.sets[1] = 3;
  expect_ok(carom_odds_of(&match, &odds));
  NEAR_EACH(odds.score[0], of_games.score[0], CAROM_SERIES_MOST, 1e-15);
  ck_assert(odds.match == of_games.match && fabs(odds.games - of_games.games) < 1e-12);
  match = games;
  match.side = 0;
  expect_ok(carom_odds_of(&match, &of_other));
  match.side = -1;
  expect_ok(carom_odds_of(&match, &odds));
  ck_assert_double_eq_tol(odds.match, 0.5 * (of_games.match + of_other.match), 1e-15);
}

/* No other length of the weaker side's race comes nearer to even. */
TEST(handicaps_are_fair) {
  for (int lead = -300; lead <= 300; lead += 60) {
    match = (carom_series){.rating = {500.0 + lead, 500.0}, .games = {3, 11}, .side = -1};
    carom_series fair;
    expect_ok(carom_fair_series(&match, &fair));
    const int weaker = lead < 0 ? 0 : 1;
    ck_assert_int_eq(fair.games[1 - weaker], 11);
    expect_ok(carom_odds_of(&fair, &odds));
    const double off = fabs(odds.match - 0.5);
    for (int n = 1; n <= 11; n++) {
      fair.games[weaker] = n;
      expect_ok(carom_odds_of(&fair, &odds));
      ck_assert(fabs(odds.match - 0.5) >= off);
    }
    ck_assert(off < 0.16);
  }
}

TEST(numbers_out_of_range_are_refused) {
  static const carom_series wrong[] = {
      {.rating = {-1.0, 500.0}, .games = {9, 9}},
      {.rating = {500.0, NAN}, .games = {9, 9}},
      {.break_points = 1001.0, .games = {9, 9}},
      {.games = {0, 9}},
      {.games = {9, CAROM_SERIES_MOST + 1}},
      {.games = {9, 9}, .sets = {-1, 1}},
      {.games = {9, 9}, .order = 3},
      {.games = {9, 9}, .side = 2},
  };
  for (size_t n = 0; n < COUNT_OF(wrong); n++) {
    ck_assert_int_eq(carom_odds_of(&wrong[n], &odds), CAROM_ERROR_OPTIONS);
    ck_assert_int_eq(carom_fair_series(&wrong[n], &match), CAROM_ERROR_OPTIONS);
  }
}

/* Of players whose ratings are those before the first game, and who win and lose as the odds say,
 * 95 % have ratings within their intervals: a player with 0 to 80 games by as many opponents as
 * there are scores. */
TEST(intervals_of_ratings_hold_95_percent) {
  enum { PLAYERS = 1500, SCORES = 4 };
  random_source r = {test_seed()};
  int below = 0, above = 0;
  for (int n = 0; n < FEWER(PLAYERS); n++) {
    double rating;
    do {
      const double far = sqrt(-2.0 * log(random_between(&r, 1e-300, 1.0)));
      rating = 400.0 + 150.0 * far * cos(6.28318530717958648 * random_between(&r, 0.0, 1.0));
    } while (rating < 200.0 || rating > 850.0);
    carom_score scores[SCORES] = {{0}};
    for (int s = 0; s < SCORES; s++) {
      scores[s].against = random_between(&r, 200.0, 850.0);
      const int games = (int)random_between(&r, 0.0, 21.0);
      for (int g = 0; g < games; g++) {
        const bool won = random_between(&r, 0.0, 1.0) < chance(rating - scores[s].against);
        scores[s].won += won;
        scores[s].lost += !won;
      }
    }
    carom_rating told;
    expect_ok(carom_rating_of(scores, SCORES, &told));
    below += rating < told.low;
    above += rating > told.high;
  }
  /* five standard errors */
  const double due = 0.025 * FEWER(PLAYERS), spread = 5.0 * sqrt(due * 0.975);
  ck_assert(fabs(below - due) < spread && fabs(above - due) < spread);
}
