/* Contacts that last whose results are known: in closed form, or from measurements that players and
 * writers published. cluster.c has the laws that all contacts keep. */
#include "layout.h"

static double degrees(double radians) {
  return radians * 180.0 / PI;
}

/* ---- In closed form */

/* The cue ball on two balls that touch, in few steps and in many. */
TEST(two_at_once) {
  static const double restitutions[] = {1.0, 0.95, 0.8, 0.5};
  static const struct {
    int steps;
    double within;
  } runs[] = {{30, 3e-4}, {300, 2e-5}};
  for (size_t k = 0; k < COUNT_OF(restitutions); k++)
    for (size_t n = 0; n < COUNT_OF(runs); n++) {
      const double e = restitutions[k];
      layout l = {.ball = {ball_at(0.0, -R * sqrt(3.0)), ball_at(-R, 0.0), ball_at(R, 0.0)},
                  .count = 3};
      l.ball[0].state.v[1] = 1.0;
      polish(&l);
      restitution(&l, e);
      resolve(&l, runs[n].steps);
      NEAR(out[0].v[1], 1.0 - 0.6 * (1.0 + e), runs[n].within);
      NEAR(planar_size(out[1].v), (1.0 + e) * sqrt(3.0) / 5.0, runs[n].within);
      NEAR(out[1].v[0], -out[2].v[0], 1e-14);
    }
}

/* A ball falls on three that touch each other. */
TEST(ball_on_three) {
  layout l = {.count = 4};
  for (int k = 0; k < 3; k++) {
    const double angle = 2.0 / 3.0 * PI * k;
    l.ball[k] = ball_at(2.0 * R / sqrt(3.0) * cos(angle), 2.0 * R / sqrt(3.0) * sin(angle));
  }
  l.ball[3] = ball_at(0.0, 0.0);
  l.ball[3].state.r[2] = R + 2.0 * R * sqrt(2.0 / 3.0);
  l.ball[3].state.v[2] = -2.0;
  polish(&l);
  restitution(&l, 1.0);
  resolve(&l, 200);
  NEAR(out[3].v[2], 2.0 / 3.0, 1e-4);
  ck_assert_int_eq(contacts_count, 3);
}

/* ---- What players see */

/* Two frozen balls along y, and the cue ball that drives the first at an angle from the kiss line,
 * x. The first ball leaves between the kiss line and the drive, at this part of the way: "ten times
 * fuller" says 0.1. */
TEST(frozen_kiss) {
  static const struct {
    double angle;
    double part;
  } known[] = {{10.0, 0.050}, {30.0, 0.067}, {50.0, 0.082},
               {60.0, 0.092}, {70.0, 0.107}, {80.0, 0.117}};
  const double speed = 2.0;
  for (size_t k = 0; k < COUNT_OF(known); k++) {
    const double drive = known[k].angle * PI / 180.0;
    const double x = cos(drive);
    const double y = sin(drive);
    layout l = {
        .ball = {ball_at(-2.0 * R * x, -2.0 * R * y), ball_at(0.0, 0.0), ball_at(0.0, 2.0 * R)},
        .count = 3};
    l.ball[0].state.v[0] = speed * x;
    l.ball[0].state.v[1] = speed * y;
    resolve(&l, 100);
    NEAR(out[1].v[1] / out[1].v[0] / tan(drive), known[k].part, 2e-3);
  }
}

/* The throw of a frozen combination whose first ball a rolling one hits 30 degrees off its line:
 * "the softer you hit, the more throw" (cuesportsaustralia.com.au). */
TEST(frozen_throw) {
  static const struct {
    double speed;
    double degrees;
  } known[] = {{0.5, 5.12}, {1.0, 4.62}, {2.0, 3.22}, {5.0, 1.18}};
  const double off_line = PI / 6.0;
  const double x = sin(off_line);
  const double y = cos(off_line);
  for (size_t k = 0; k < COUNT_OF(known); k++) {
    const layout l = {
        .ball = {rolling(-2.0 * R * x, -2.0 * R * y, known[k].speed, 0.5 * PI - off_line),
                 ball_at(0.0, 0.0), ball_at(0.0, 2.0 * R)},
        .count = 3};
    resolve(&l, 0);
    NEAR(degrees(atan2(out[2].v[0], out[2].v[1])), known[k].degrees, 0.02);
  }
}

/* The wing ball of a nine-ball rack that is hit from the side, on the side from which the cue ball
 * comes. */
TEST(wing_ball_from_the_side) {
  const double aside = atan2(0.45, 1.27);
  const double speed = 10.5;
  const double roll = 0.62; /* m/s, R times the spin */
  layout l = rack(9, 0.0, 0.0, -aside, NULL);
  l.ball[0].state.v[0] = -speed * sin(aside);
  l.ball[0].state.v[1] = speed * cos(aside);
  l.ball[0].state.w[0] = -roll * cos(aside) / R;
  l.ball[0].state.w[1] = -roll * sin(aside) / R;
  resolve(&l, 100);
  const double *wing = out[6].v;
  NEAR(degrees(atan2(wing[1], wing[0])), 39.8, 0.2);
  NEAR(planar_size(wing) / speed, 0.34, 5e-3);
}

/* ---- In a shot */

static const carom_shot_options briefly = {.time_most = 0.01};

/* The contact that is due is reported first: the one that closes fastest, also where another one of
 * the same instant has lower indices. */
TEST(due_contact_is_first) {
  static const double angles[2] = {0.96, -0.26}; /* from +y */
  const carom_table table = empty_table(4.0);
  carom_shot_ball balls[3];
  for (int i = 0; i < 2; i++)
    balls[i] = ball_at(2.0 + 2.0 * R * sin(angles[i]), 2.0 + 2.0 * R * cos(angles[i]));
  balls[2] = ball_at(2.0, 2.0);
  balls[2].state.v[1] = 2.0;
  play(&table, balls, 3, NULL, &briefly, CAROM_STOPPED_AT_TIME);
  for (int k = 0; k < 2; k++) {
    ck_assert_int_eq(events[k].cluster, 2);
    ck_assert_int_eq(events[k].a, 1 - k);
    ck_assert_int_eq(events[k].b, 2);
  }
}

/* A third ball takes part that is touched while the contact lasts: up to a gap of 1.42 times the
 * compression, 0.84 mm at 10 m/s, where it is, and of what it closes in that time. In a row along
 * x, along y, and between. */
TEST(third_ball_near_by) {
  static const struct {
    double gap;
    double closing;
    int contacts;
  } cases[] = {
      {3e-4, 0.0, 2}, {1.0e-3, 0.0, 2}, {1.5e-3, 0.0, 0}, {3e-3, 20.0, 2}, {2e-2, 20.0, 0}};
  const carom_table table = empty_table(4.0);
  for (size_t k = 0; k < COUNT_OF(cases); k++)
    for (int turn = 0; turn < 3; turn++) {
      const double x = cos(0.25 * PI * turn);
      const double y = sin(0.25 * PI * turn);
      const double far = 2.0 * R + cases[k].gap;
      carom_shot_ball balls[3] = {ball_at(2.0 - 2.0 * R * x, 2.0 - 2.0 * R * y), ball_at(2.0, 2.0),
                                  ball_at(2.0 + far * x, 2.0 + far * y)};
      balls[0].state.v[0] = 10.0 * x;
      balls[0].state.v[1] = 10.0 * y;
      balls[2].state.v[0] = -cases[k].closing * x;
      balls[2].state.v[1] = -cases[k].closing * y;
      play(&table, balls, 3, NULL, &briefly, CAROM_STOPPED_AT_TIME);
      ck_assert_msg(events[0].cluster == cases[k].contacts, "gap %g m: %d contacts", cases[k].gap,
                    events[0].cluster);
    }
}
