/* Three-cushion and straight rail: own cue balls, and balls that go to their spots. */
#include "carom_match.h"
#include "game_support.h"

enum { WHITE = 0, YELLOW_CUE = 1, RED = 2, SPOTS = CAROM_MAY_SPOT };

static void begin(carom_match *match, carom_rules_kind kind, int player) {
  carom_table_make(CAROM_TABLE_THREECUSHION, &table);
  ck_assert_int_eq(carom_match_begin(match, kind, &table, 1, player), CAROM_OK);
}

static bool lies_at(const carom_shot_ball *ball, double across, double along) {
  return ball->state.label == CAROM_BALL_STATIONARY &&
         hypot(ball->state.r[0] - across * table.width, ball->state.r[1] - along * table.length) <
             1e-3;
}

/* Who begins has the white or the yellow, beside the other cue ball, and must meet the red. */
TEST(cue_balls_of_straight_rail) {
  static carom_match match;
  for (int player = 0; player < 2; player++) {
    begin(&match, CAROM_RULES_STRAIGHTRAIL, player);
    const carom_shot_ball *lies = match.record.balls;
    ck_assert(match.cue_ball == player && match.on == 1 << RED && match.record.count == 3);
    ck_assert(lies_at(&lies[player], 0.5 + 0.1825 / 1.42, 0.25));
    ck_assert(lies_at(&lies[1 - player], 0.5, 0.25) && lies_at(&lies[RED], 0.5, 0.75));

    /* a stroke that meets none gives the table to the other cue ball, which may meet any ball */
    carom_cue cue = carom_cue_of(CAROM_GAME_BILLIARD);
    cue.ball = match.cue_ball;
    cue.phi = 0.0;
    cue.speed = 0.5;
    ck_assert_int_eq(carom_match_stroke(&match, player, &cue, NULL, NULL), CAROM_OK);
    ck_assert(match.record.player == 1 - player && match.cue_ball == 1 - player);
    ck_assert_int_eq(match.on, 7 & ~(1 << match.cue_ball));
  }
}

/* A ball off the table, and a choice to spot: in straight rail all balls lie as for the opening of
 * the next player; in three-cushion the others stay. */
TEST(balls_are_spotted) {
  static const carom_rules_kind kinds[] = {CAROM_RULES_STRAIGHTRAIL, CAROM_RULES_THREECUSHION};
  for (int k = 0; k < 8; k++) {
    const bool all = k % 2 == 0, asks = k / 2 % 2 == 1, yellow = k / 4 == 1;
    carom_plan_rules of = carom_plan_rules_of(kinds[k % 2]);
    const int count = lay_out(CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION, 7);
    const double R = balls[0].kind.radius;
    const int own = yellow ? YELLOW_CUE : WHITE, other = 1 - own;
    of.state.group = 1 + own;
    of.state.may = asks ? SPOTS : 0;
    put(own, 0.3, 0.9);
    put(other, 1.1, 2.5);
    put(RED, 0.3 + 2.0 * R, 0.9);

    /* the player whose cue ball touches the red asks; or the red leaves the table */
    carom_facts facts = facts_of(NONE, 0, 0, asks ? 0 : 1 << RED);
    if (!asks)
      of.state.group = 1 + other;
    const carom_call call = {asks ? CAROM_CALL_SPOT : NONE, -1};
    carom_turn turn = of.judge(&of.state, 7, own, &facts, call);
    ck_assert_int_eq(turn.outcome, asks ? KEEP : PASS);
    carom_turn_settle(&of, &of.state, &table, balls, count, &turn);
    ck_assert_msg(lies_at(&balls[RED], 0.5, 0.75) && of.state.may == 0, "case %d: red", k);
    if (all) {
      ck_assert_msg(lies_at(&balls[own], 0.5 + 0.1825 / 1.42, 0.25), "case %d: own", k);
      ck_assert_msg(lies_at(&balls[other], 0.5, 0.25), "case %d: other", k);
    } else {
      ck_assert_msg(is_at(other, 1.1, 2.5), "case %d: the other stays", k);
      ck_assert_msg(asks ? lies_at(&balls[own], 0.5, 0.25) : is_at(own, 0.3, 0.9), "case %d", k);
    }
  }
}

/* A plan finds a point of straight rail that three-cushion would not count. */
TEST(a_point_is_planned) {
  const int count = lay_out(CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION, 7);
  put(0, 0.5, 0.8);
  put(1, 0.7, 1.2);
  put(2, 0.8, 1.25);
  const carom_cue cue = carom_cue_of(CAROM_GAME_BILLIARD);
  const carom_player player = carom_player_of(0.5);
  const carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHTRAIL);
  const carom_plan_options options = {.shots = 1000};
  carom_plan_job job = job_of(count, &cue, &player, &of, &options);
  carom_choice best;
  int found;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  ck_assert_msg(best.keep > 0.9, "keeps %g", best.keep);
  free(job.memory);
}
