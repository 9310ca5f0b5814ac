/* Reviews of strokes and drills of them: of a player with the errors of the job the costs have the
 * mean 0, and one who aims off it pays for misses. */
#include "carom_coach.h"
#include "plan_support.h"

enum { STROKES = 40 };

/* Sums of the reviews of strokes at the 8, which are played `beside` degrees to the left. */
typedef struct review_sums {
  double told, kept, miss, place, squares, off;
} review_sums;

static carom_cue aim_at_eight(void) {
  carom_pot pot = {.ball = 8, .pocket = 2};
  carom_cue aim = cue;
  aim.speed = 2.0;
  expect_ok(carom_aim(&table, balls, BALLS, NULL, &pot, &aim));
  ck_assert_int_eq(pot.outcome, CAROM_POT_FALLS);
  return aim;
}

static void lay_out_pot(void) {
  make_layout(5, 4);
  expect_ok(place_ball(0, 0.5, 1.2));
  expect_ok(place_ball(8, 0.35, 1.9));
  rules = carom_plan_rules_of(CAROM_RULES_NINEBALL); /* the 2 is not on; ball 8 is the lowest */
  balls[2].state.label = balls[3].state.label = CAROM_BALL_POCKETED;
  expect_ok(place_ball(9, 0.9, 1.3));
  player = carom_player_of(3.0);
}

static review_sums review_strokes(double beside, carom_review *last) {
  review_sums sums = {0};
  const carom_cue aim = aim_at_eight();
  for (int n = 0; n < STROKES; n++) {
    carom_cue played = aim;
    carom_player_strike(&player, 9000, (uint64_t)n, &played);
    played.phi += beside;
    expect_ok(carom_review_of(&job, &played, (carom_call){-1, -1}, last));
    ck_assert(last->ball == 8 && last->pocket == 2);
    ck_assert_double_eq_tol(last->miss_cost + last->place_cost, last->value - last->came, 1e-12);
    const double cost = last->value - last->came;
    sums.told += last->told;
    sums.kept += last->kept;
    sums.miss += last->miss_cost;
    sums.place += last->place_cost;
    sums.squares += cost * cost;
    sums.off += last->off;
  }
  return sums;
}

TEST(costs_have_no_mean_by_the_errors_of_the_player) {
  lay_out_pot();
  carom_review review;
  const review_sums fair = review_strokes(0.0, &review);
  const double spread = sqrt(fair.squares);
  ck_assert(fair.told > 0.2 * STROKES && fair.told < 0.95 * STROKES);
  ck_assert(fabs(fair.kept - fair.told) < 4.0 * 0.5 * sqrt(STROKES));
  ck_assert(fabs(fair.miss + fair.place) < 4.0 * spread && spread > 0.3);
  ck_assert(fabs(fair.off / STROKES) < 4.0 * player.phi / sqrt(STROKES));
  const bool is_long = review.distance > 1.2, is_thin = fabs(review.cut) > 45.0;
  ck_assert(fabs(review.cut) > 15.0);
  ck_assert_int_eq(review.group, CAROM_PRACTICE_CUT + 3 * is_long + is_thin);

  const review_sums beside = review_strokes(0.8, &review);
  ck_assert_double_eq_tol((beside.off - fair.off) / STROKES, 0.8, 0.05);
  ck_assert(beside.miss > fair.miss + 3.0 && beside.kept < fair.kept - 7.0);
}

/* A player of the rating of a drill makes it in about half of other tries; and where the position
 * cost more than the miss, half of the pots end within the radius. */
TEST(drills_suit_the_rating) {
  lay_out_pot();
  carom_review review;
  const carom_cue aim = aim_at_eight();
  expect_ok(carom_review_of(&job, &aim, (carom_call){-1, -1}, &review));
  for (int place = 0; place < 2; place++) {
    carom_drill drill;
    review.place_cost = review.miss_cost + (place == 1 ? 0.1 : -0.1);
    expect_ok(carom_drill_of(&job, &review, &drill));
    ck_assert((drill.radius > 0.0) == (place == 1));
    const carom_player rated = carom_player_fargo(drill.rating);
    int made[2] = {0}, pots = 0;
    for (int n = 0; n < 4 * STROKES; n++)
      for (int who = 0; who < 2; who++) {
        carom_ball_state final[BALLS];
        carom_facts facts;
        carom_shot shot = {.final = final, .facts = &facts};
        carom_cue stroke = drill.aim;
        carom_player_strike(who == 0 ? &rated : &player, 777, (uint64_t)n, &stroke);
        expect_ok(carom_shoot(&table, balls, BALLS, &stroke, NULL, &shot));
        const bool falls = facts.pocket[8] == 2 && (facts.down & 1) == 0;
        made[who] += falls && (place == 0 || distance(final[0].r, drill.place) <= drill.radius);
        pots += falls && who == 1;
      }
    ck_assert_double_eq_tol(made[0] / (4.0 * STROKES), 0.5, 0.15);
    if (place == 1)
      ck_assert_double_eq_tol(made[1] / (double)pots, 0.5, 0.15);
  }
}

/* A stroke at no pocket has no aim, and games that cannot be reviewed are rejected. */
TEST(strokes_without_a_pot_have_no_aim) {
  lay_out_pot();
  carom_cue away = aim_at_eight();
  away.phi += 180.0;
  carom_review review;
  expect_ok(carom_review_of(&job, &away, (carom_call){-1, -1}, &review));
  ck_assert(review.group == CAROM_PRACTICE_OTHER && review.ball == -1 && isnan(review.off));
  carom_drill drill;
  ck_assert_int_eq(carom_drill_of(&job, &review, &drill), CAROM_ERROR_OPTIONS);
  rules = carom_plan_rules_of(CAROM_RULES_POTTING);
  ck_assert_int_eq(carom_review_of(&job, &away, (carom_call){-1, -1}, &review),
                   CAROM_ERROR_OPTIONS);
  ck_assert_str_eq(carom_word_text(CAROM_WORDS_PRACTICE, CAROM_PRACTICE_LONG_THIN),
                   "long thin cut");
  ck_assert_ptr_null(carom_word_text(CAROM_WORDS_PRACTICE, 99));
}
