/* Complete shots where pooltool's default engine fails (commit 9a8abfe0): full hits with follow
 * along x, balls that roll alike, some Newton's cradles, and a ball that moves into its rail. They
 * are right in the world carom, and by pooltool's rules an error or its own answer, never a crash,
 * a hang or a lost ball. */
#include "random_shots.h"
#include "shot_support.h"

static const carom_shot_options pooltool = {.world = CAROM_WORLD_POOLTOOL};

/* Full hits with follow along x: two balls with equal accelerations, of which pooltool makes a
 * polynomial without leading coefficient. They stay exactly straight. */
TEST(straight_follow) {
  carom_table t;
  carom_table_make(CAROM_TABLE_POOLTOOL, &t);
  const carom_shot_ball b[2] = {ball_at(0.3, 0.5), ball_at(0.6, 0.5)};
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.phi = 0.0;
  for (int n = 0; n < 21; n++) {
    cue.speed = 0.5 + 0.25 * n;
    cue.b = 0.1 + 0.02 * n;
    for (int world = 0; world < 2; world++) {
      play(&t, b, 2, &cue, world == 0 ? NULL : &pooltool, CAROM_OK);
      ck_assert_double_eq(final[0].r[1], 0.5);
      ck_assert_double_eq(final[1].r[1], 0.5);
    }
  }
}

/* Two balls that roll in exactly the same direction. */
TEST(rolling_together) {
  carom_table t = empty_table(30.0);
  carom_shot_ball b[2] = {ball_at(5.0, 10.0), ball_at(5.3, 10.0)};
  for (int world = 0; world < 2; world++) {
    b[0].state.v[0] = 1.0;
    b[1].state.v[0] = 0.9;
    for (int k = 0; k < 2; k++)
      b[k].state.w[1] = b[k].state.v[0] / b[k].kind.radius;
    const carom_shot shot = play(&t, b, 2, NULL, world == 0 ? NULL : &pooltool, CAROM_OK);
    /* the gap of 0.3 - 2R closes at 0.1 m/s, as both slow down alike */
    ck_assert_int_eq(events[0].type, CAROM_EVENT_BALL_BALL);
    ck_assert_double_eq_tol(events[0].time, (0.3 - 2.0 * b[0].kind.radius) / 0.1, 1e-9);
    ck_assert_int_gt(shot.count, 3);
    ck_assert_double_ge(final[1].r[0] - final[0].r[0], 2.0 * b[0].kind.radius - 1e-9);
  }
}

/* Newton's cradle: the last ball of a row goes; the others move by the rest of the first one's
 * topspin only. It ends. By pooltool's rules it ends or a bound ends it. */
TEST(cradle) {
  const carom_table t = empty_table(30.0);
  for (int n = 2; n <= 6; n++) {
    carom_shot_ball b[8];
    const double R = ball_at(0.0, 0.0).kind.radius;
    b[0] = ball_at(5.0, 10.0);
    for (int k = 1; k <= n; k++)
      b[k] = ball_at(6.0 + 2.0 * R * k, 10.0);
    for (int k = 0; k <= n; k++)
      b[k].kind.restitution = 1.0;
    b[0].state.v[0] = 1.0;
    const carom_shot_options smooth = {.ball_model = CAROM_BALL_MODEL_MIRROR};
    const carom_shot shot = play(&t, b, n + 1, NULL, &smooth, CAROM_OK);
    ck_assert_double_gt(final[n].r[0] - b[n].state.r[0], 0.5);
    for (int k = 1; k < n; k++)
      ck_assert_double_eq_tol(final[k].r[0], b[k].state.r[0], 0.1);
    ck_assert_int_lt(shot.count, 5000);
    carom_shot bounded = {0};
    carom_shot_options theirs = pooltool;
    const carom_status status = carom_shoot(&t, b, n + 1, NULL, &theirs, &bounded);
    ck_assert(status == CAROM_OK || status == CAROM_ERROR_TOO_MANY_EVENTS ||
              status == CAROM_ERROR_UNRESOLVED);
  }
}

/* A ball that starts in contact with a rail and moves into it; pooltool lets it through (commit
 * 9a8abfe0). By its rules it is found from a gap of 1e-12 m on; else it is lost, which is an error
 * and no endless flight. */
TEST(starts_at_a_rail) {
  static const struct {
    double inside;
    carom_status by_pooltool;
  } starts[] = {{0.0, CAROM_ERROR_LEFT_TABLE},
                {1e-15, CAROM_ERROR_LEFT_TABLE},
                {-1e-9, CAROM_OK},
                {9e-7, CAROM_ERROR_LEFT_TABLE}};
  carom_table t;
  carom_table_make(CAROM_TABLE_THREECUSHION, &t);
  carom_shot_ball b = {.kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_BILLIARD)};
  const double R = b.kind.radius;
  for (size_t n = 0; n < COUNT_OF(starts); n++) {
    b.state =
        (carom_ball_state){.r = {t.width - R + starts[n].inside, 1.0, R}, .v = {1.0, 0.3, 0.0}};
    play(&t, &b, 1, NULL, NULL, CAROM_OK);
    ck_assert_int_eq(events[0].type, CAROM_EVENT_RAIL);
    ck_assert_double_lt(final[0].r[0], t.width - R + 1e-9);
    play(&t, &b, 1, NULL, &pooltool, starts[n].by_pooltool);
  }
}

/* Two contacts at the same instant, mirror images of each other: one is resolved after the
 * other, by index, in a way that rounding does not decide; where both closings are alike the
 * results are the same from one position on the table to another. */
TEST(two_at_once) {
  const carom_table t = empty_table(30.0);
  double first[3][2];
  for (int place = 0; place < 50; place++) {
    carom_shot_ball b[3] = {ball_at(10.0 + 0.0137 * place, 10.0),
                            ball_at(11.0 + 0.0137 * place, 10.0),
                            ball_at(11.0 + 0.0137 * place, 10.0)};
    const double R = b[0].kind.radius;
    b[1].state.r[1] += R;
    b[2].state.r[1] -= R;
    b[0].state.v[0] = 2.0;
    play(&t, b, 3, NULL, NULL, CAROM_OK);
    int k = 0;
    while (events[k].type != CAROM_EVENT_BALL_BALL)
      k++;
    ck_assert_int_eq(events[k].b, 1);
    ck_assert_int_eq(events[k + 1].b, 2);
    ck_assert_double_eq_tol(events[k + 1].time, events[k].time, 1e-12);
    for (int i = 0; i < 3; i++)
      for (int axis = 0; axis < 2; axis++) {
        const double moved = final[i].r[axis] - b[i].state.r[axis];
        if (place == 0)
          first[i][axis] = moved;
        ck_assert_double_eq_tol(moved, first[i][axis], 1e-9);
      }
  }
}

/* pooltool hands velocity on between balls that touch for long by a rule that depends on their
 * order; world carom does not. */
TEST(order_of_balls) {
  static random_shot s;
  static carom_ball_state other[CAROM_BALLS_MOST];
  for (int n = 0; n < 40; n++) {
    random_shot_make(5, test_seed(), (uint64_t)n, &s); /* layouts: no two contacts at one instant */
    const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN};
    const carom_shot shot = play(&s.table, s.ball, s.count, &s.cue, &options, CAROM_OK);
    memcpy(other, final, sizeof other);
    random_shot turned = s;
    for (int k = 0; k < s.count; k++)
      turned.ball[k] = s.ball[s.count - 1 - k];
    turned.cue.ball = s.count - 1;
    const carom_shot back =
        play(&turned.table, turned.ball, s.count, &turned.cue, &options, CAROM_OK);
    ck_assert_int_eq(back.count, shot.count);
    for (int k = 0; k < s.count; k++)
      ck_assert_double_eq_tol(final[s.count - 1 - k].r[0], other[k].r[0], 1e-6);
  }
}

/* A ball that begins in a pocket is rejected, where pooltool waits until it leaves. One that begins
 * at its edge and moves into it falls. */
TEST(begins_in_a_pocket) {
  carom_table t;
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  const carom_pocket *pocket = &t.pocket[1];
  carom_shot_ball b = ball_at(pocket->centre[0] + pocket->radius - 1e-9, pocket->centre[1]);
  b.state.v[0] = -0.1;
  for (int world = 0; world < 2; world++)
    play(&t, &b, 1, NULL, world == 0 ? NULL : &pooltool, CAROM_ERROR_OFF_TABLE);
  b.state.r[0] += 2e-9;
  play(&t, &b, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(final[0].label, CAROM_BALL_POCKETED);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_POCKET);
  ck_assert_double_le(events[0].time, 2e-8);

  /* it may be in it from the beginning */
  b.state.label = CAROM_BALL_POCKETED;
  play(&t, &b, 1, NULL, NULL, CAROM_OK);
}
