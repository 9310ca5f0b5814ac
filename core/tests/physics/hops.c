/* Hops of one ball: let go, landing, struck by a raised cue, and over another ball. The numbers are
 * those of flight.h, unless a test says otherwise. */
#include "flight.h"

/* ---- On the slate */

/* A ball that is let go 0.1 m above the cloth hops five times. */
TEST(drop) {
  double speed = sqrt(2.0 * g * 0.1);
  double time = speed / g;
  const carom_shot shot = let_go(flying(0.0, 0.0, R + 0.1, 0.0, 0.0, 0.0));
  ck_assert_int_eq(shot.count, 6);
  for (int k = 0; k < 6; k++) {
    const carom_ball_state *before = &events[k].before[0];
    const carom_ball_state *after = &events[k].after[0];
    const bool is_last = k == 5;
    ck_assert_int_eq(events[k].type, CAROM_EVENT_SLATE);
    ck_assert_int_eq(before->label, CAROM_BALL_AIRBORNE);
    ck_assert_int_eq(after->label, is_last ? CAROM_BALL_STATIONARY : CAROM_BALL_AIRBORNE);
    ck_assert_double_eq(before->r[2], R);
    ck_assert_double_eq(after->r[2], R);
    NEAR(events[k].time, time, 1e-9);
    NEAR(before->v[2], -speed, 1e-9);
    speed = bounce(speed);
    NEAR(after->v[2], speed, 1e-9);
    time += 2.0 * speed / g;
  }
  ck_assert_double_eq(speed, 0.0);
}

/* One landing that slips, one that sticks, one of a ball that only spins. w_z falls by the friction
 * of turning on the spot, and by no other: pooltool multiplies it by 2/7 where the ball sticks. */
TEST(one_landing) {
  static const struct {
    flight in;
    double w_z;
  } landings[] = {{{3.0, -1.0, 0.0}, 50.0}, {{0.5, -1.0, 0.0}, 50.0}, {{0.0, -2.0, -2.8575}, 0.0}};
  for (size_t k = 0; k < COUNT_OF(landings); k++) {
    const flight in = landings[k].in;
    const flight out = landed(in);
    const double turn_lost = 2.5 * mu_spin * (out.up - in.up) / R;
    const carom_shot_ball ball = flying(0.0, 0.0, R, in.along, 0.0, in.up);
    let_go(spinning(ball, 0.0, in.spin / R, landings[k].w_z));
    const carom_ball_state *after = &events[0].after[0];
    ck_assert_int_eq(events[0].type, CAROM_EVENT_SLATE);
    ck_assert_double_eq(events[0].time, 0.0);
    NEAR(after->v[0], out.along, 1e-12);
    NEAR(after->v[2], out.up, 1e-9);
    NEAR(R * after->w[1], out.spin, 1e-12);
    NEAR(after->w[2], fmax(landings[k].w_z - turn_lost, 0.0), 1e-6);
  }
}

/* The energy that the landing which slips takes, J: by a separate program. */
TEST(energy_of_a_landing) {
  const carom_shot_ball ball = flying(0.0, 0.0, R, 3.0, 0.0, -1.0);
  let_go(spinning(ball, 0.0, 0.0, 50.0));
  const double before = state_energy(&ball.kind, &events[0].before[0]);
  const double after = state_energy(&ball.kind, &events[0].after[0]);
  NEAR(after - before, -0.194642162, 1e-9);
}

/* A ball that sticks rolls as it leaves the slate. */
TEST(sticking_is_rolling) {
  let_go(flying(0.0, 0.0, R, 0.5, 0.0, -1.0));
  NEAR(R * events[0].after[0].w[1], events[0].after[0].v[0], 1e-15);
  NEAR(events[0].after[0].v[0], 5.0 / 7.0 * 0.5, 1e-12);
}

/* ---- By a raised cue */

/* The blow, the landing that follows at the same instant, and the first hop. */
TEST(raised_strikes_in_closed_form) {
  static const struct {
    double theta;
    double b;
  } strikes[] = {{5.0, 0.0}, {30.0, 0.0}, {40.0, -0.3}, {45.0, 0.0}, {75.0, 0.0}};
  for (size_t k = 0; k < COUNT_OF(strikes); k++) {
    const flight blow = struck(3.0, strikes[k].theta, strikes[k].b);
    const flight hop = landed(blow);
    const carom_shot shot = raised_strike(3.0, strikes[k].theta, strikes[k].b, CAROM_SPACE_3D);
    const carom_ball_state *after_blow = &events[0].after[0];
    const carom_ball_state *after_slate = &events[1].after[0];
    ck_assert_int_eq(events[0].type, CAROM_EVENT_STRIKE);
    ck_assert_int_eq(after_blow->label, CAROM_BALL_AIRBORNE);
    NEAR(after_blow->v[1], blow.along, 1e-9);
    NEAR(after_blow->v[2], blow.up, 1e-9);
    NEAR(R * after_blow->w[0], -blow.spin, 1e-9);
    ck_assert_int_eq(events[1].type, CAROM_EVENT_SLATE);
    ck_assert_double_eq(events[1].time, 0.0);
    NEAR(after_slate->v[1], hop.along, 1e-9);
    NEAR(after_slate->v[2], hop.up, 1e-9);
    NEAR(R * after_slate->w[0], -hop.spin, 1e-9);

    /* the top of the hop */
    const carom_shot_ball ball = ball_at(struck_at, struck_at);
    carom_ball_state top;
    expect_ok(carom_shot_at(&ball, 1, &shot, hop.up / g, &top));
    ck_assert_int_eq(top.label, CAROM_BALL_AIRBORNE);
    NEAR(top.r[2] - R, hop.up * hop.up / (2.0 * g), 1e-9);

    /* the next landing */
    const carom_event *lands = event_of(&shot, CAROM_EVENT_SLATE, 1);
    NEAR(lands->time, 2.0 * hop.up / g, 1e-9);
    NEAR(lands->before[0].r[1] - struck_at, hop.along * lands->time, 1e-9);
  }
}

/* Straight from above a ball hops on the spot. */
TEST(straight_from_above) {
  raised_strike(3.0, 90.0, 0.0, CAROM_SPACE_3D);
  const carom_ball_state *after = &events[1].after[0];
  ck_assert_double_eq(after->v[0], 0.0);
  ck_assert_double_eq(after->v[1], 0.0);
  ck_assert_double_gt(after->v[2], 0.0);
}

/* Flat play loses the part of a blow that goes down. */
TEST(flat_play) {
  raised_strike(3.0, 45.0, 0.0, CAROM_SPACE_FLAT);
  const carom_ball_state *after = &events[0].after[0];
  ck_assert_double_eq(after->v[2], 0.0);
  ck_assert_int_eq(after->label, CAROM_BALL_SLIDING);
  NEAR(after->v[1], struck(3.0, 45.0, 0.0).along, 1e-9);
}

/* How high a strike with this cue, whose tip touches for a while, lets a ball hop, m. */
static double height_of_hop(const carom_cue *cue) {
  const carom_table table = empty_table(2.0 * struck_at);
  const carom_shot_ball ball = ball_at(struck_at, struck_at);
  play(&table, &ball, 1, cue, NULL, CAROM_OK);
  const double up = events[0].after[0].v[2];
  return up * up / (2.0 * g);
}

/* A masse by a tip of leather stays on the cloth, but for 3 mm: from above a ball hops little, as
 * the cue holds it down. */
TEST(masse_stays_low) {
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 3.0;
  cue.theta = 60.0;
  cue.a = 0.45;
  cue.b = 0.0;
  ck_assert_double_lt(height_of_hop(&cue), 0.003);
}

/* A jump cue lifts a ball over another. */
TEST(jump_cue_lifts) {
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 4.0;
  cue.theta = 45.0;
  cue.b = 0.0;
  cue.mass = 0.25;
  cue.tip_time = 0.0008;
  cue.tip_restitution = 0.85;
  ck_assert_double_gt(height_of_hop(&cue), 2.0 * R);
}

/* The least speed that carries a ball over one 0.305 m (12 inches) ahead, within 2 mm/s. */
TEST(jump_over_a_ball) {
  static const struct {
    double theta;
    double speed;
  } least[] = {{30.0, 2.762}, {40.0, 2.281}, {45.0, 2.221}, {60.0, 2.264}};
  const carom_table table = empty_table(40.0);
  const carom_shot_ball balls[2] = {ball_at(20.0, 20.0), ball_at(20.0, 20.305)};
  for (size_t k = 0; k < COUNT_OF(least); k++)
    for (int is_faster = 0; is_faster < 2; is_faster++) {
      const double speed = least[k].speed + (is_faster ? 0.002 : -0.002);
      const carom_cue cue = raised_cue(speed, least[k].theta, 0.0);
      const carom_shot shot = play(&table, balls, 2, &cue, NULL, CAROM_OK);
      const bool is_hit = event_of(&shot, CAROM_EVENT_BALL_BALL, 0) != NULL;
      ck_assert_msg(is_hit != (bool)is_faster, "%g degrees, %g m/s", cue.theta, cue.speed);
      ck_assert(is_hit == (final[1].r[1] != balls[1].state.r[1]));
    }
}

/* How high a ball hops that the usual cue of pool strikes in the middle, mm at 10 m/s. The heights
 * come from the integrator of strike.c. All speeds are in proportion to the cue's, so heights go by
 * its square. */
TEST(heights_go_by_the_square_of_the_speed) {
  static const struct {
    double theta;
    double height;
  } known[] = {{20.0, 214.0}, {30.0, 485.0}, {45.0, 138.0}};
  for (size_t n = 0; n < COUNT_OF(known); n++)
    for (int speed = 2; speed <= 10; speed += 2) {
      carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
      cue.speed = speed;
      cue.theta = known[n].theta;
      cue.a = 0.0;
      cue.b = 0.0;
      cue.tip_time = CAROM_TIP_TIME;
      const double expected = known[n].height * 0.01 * speed * speed;
      NEAR(1e3 * height_of_hop(&cue), expected, fmax(1.0, 0.02 * expected));
    }
}
