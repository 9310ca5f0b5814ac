/* The opponent of a match: as good as the player before the first stroke, by rating where there is
 * one, else by the strokes so far, whoever reads them. */
#include "match_support.h"

#include <stdlib.h>

static carom_plan_options options;
static carom_plan_job job;

/* A job of plans of 100 shots by this player. */
static void make_job(const carom_player *player) {
  options = (carom_plan_options){.shots = 100};
  job = (carom_plan_job){.options = &options, .player = player};
  job.memory_size = carom_plan_memory(&options);
  job.memory = malloc(job.memory_size);
}

/* How many strokes of each seat the match weighed, and the opponent's error of aim as a fraction of
 * that of a player whose errors are `scale`. */
static double share_of(const carom_match *of, double scale) {
  const carom_player asks = carom_player_of(scale);
  carom_player opponent;
  expect_ok(carom_match_opponent(of, &asks, &opponent));
  ck_assert_double_eq_tol(opponent.a / asks.a, opponent.phi / asks.phi, 1e-12);
  return opponent.phi / asks.phi;
}

/* Plays a set of eight-ball between players with these errors, to so many matches. */
static void play_set(const double errors[2], int race, uint64_t seed) {
  const carom_set set = {.race = race};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  expect_ok(carom_match_begin_with(
      &match, &(carom_match_setup){
                  .rules = CAROM_RULES_EIGHTBALL, .table = &table, .seed = seed, .set = &set}));
  carom_player player;
  make_job(&player);
  file_size = 0;
  keep();
  for (uint64_t stroke = 0;; stroke++) {
    if (match.phase == CAROM_MATCH_OVER) {
      if (carom_match_next(&match) != CAROM_OK)
        break;
      keep();
    }
    carom_plan_stroke best;
    int found;
    const int seat = match.seat;
    player = carom_player_of(errors[seat]);
    options.seed = seed + stroke;
    expect_ok(carom_match_plan(&match, &job, &best, 1, &found));
    expect_ok(carom_match_prepare(&match, seat, &best));
    keep();
    if (best.kind == CAROM_PLAN_PASS)
      continue;
    carom_player_strike(&player, seed, stroke, &best.cue);
    expect_ok(carom_match_stroke(&match, seat, &best.cue, NULL, NULL));
    keep();
  }
  free(job.memory);
}

/* A player who errs three times as much is seen to, and one who errs a third; both from the strokes
 * of a set, which whoever reads its lines knows too. */
TEST(strokes_tell_the_opponent) {
  static const double errors[2] = {1.0, 3.0};
  play_set(errors, 12, 5);
  ck_assert(match.weighed[0] > 40 && match.weighed[1] > 15);
  int seats[2] = {0, 1};
  for (int n = 0; n < 2; n++) {
    carom_match asked = match;
    asked.record.side = asked.seat = seats[n];
    const double asks = errors[seats[n]], true_share = errors[1 - seats[n]] / asks;
    const double share = share_of(&asked, asks);
    printf("seat %d: %.2f, in truth %.2f\n", seats[n], share, true_share);
    ck_assert(share > 0.5 * true_share && share < 2.0 * true_share);
    ck_assert((share > 1.5) == (true_share > 1.0) && (share < 0.7) == (true_share < 1.0));

    /* the prior is about the player who asks: a better one believes in a better opponent */
    ck_assert(share_of(&asked, 0.5 * asks) * 0.5 < share);
  }
  expect_ok(read_all(file, file_size));
  ck_assert(memcmp(match.weighed, reader.weighed, sizeof match.weighed) == 0);
  ck_assert(memcmp(match.log_likelihood, reader.log_likelihood, sizeof match.log_likelihood) == 0);
}

/* Before the first stroke, in three-cushion and in killer the opponent is as good; a rating and the
 * caller's own opponent count before strokes. */
TEST(other_opponents) {
  static const carom_rules_kind kinds[] = {CAROM_RULES_NINEBALL, CAROM_RULES_THREECUSHION,
                                           CAROM_RULES_KILLER};
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
    begin(kinds[k], 1, 0, 0);
    ck_assert(share_of(&match, 2.0) == 1.0);
    if (match.phase == CAROM_MATCH_PLACE)
      expect_ok(carom_match_place(&match, 0, 0.5, 0.3));
    for (int stroke = 0; k > 0 && stroke < 4; stroke++) {
      carom_cue cue = cue_of(kinds[k]);
      cue.phi = 80.0 + 7.0 * stroke;
      if (match.phase == CAROM_MATCH_STROKE)
        carom_match_stroke(&match, match.seat, &cue, NULL, NULL);
    }
    ck_assert(share_of(&match, 2.0) == 1.0);
  }

  begin(CAROM_RULES_NINEBALL, 1, 0, 0);
  const carom_player asks = carom_player_of(1.0);
  const carom_player rated = carom_player_rated(300.0, CAROM_RULES_NINEBALL);
  carom_player opponent;
  match.log_likelihood[1][16] = 50.0;
  match.weighed[1] = 50;
  ck_assert_double_gt(share_of(&match, 1.0), 10.0);
  match.seating.seat[1].rating = 300.0;
  expect_ok(carom_match_opponent(&match, &asks, &opponent));
  ck_assert(memcmp(&opponent, &rated, sizeof opponent) == 0);

  /* a plan takes it, unless the caller names one */
  make_job(&asks);
  carom_plan_stroke best;
  int found;
  expect_ok(carom_match_plan(&match, &job, &best, 1, &found));
  ck_assert(job.opponent == &match.opponent && match.opponent.phi == rated.phi);
  options.opponent = &asks;
  expect_ok(carom_match_plan(&match, &job, &best, 1, &found));
  ck_assert_ptr_null(job.opponent);
  free(job.memory);
  ck_assert_int_eq(carom_match_opponent(NULL, &asks, &opponent), CAROM_ERROR_NULL);
}
