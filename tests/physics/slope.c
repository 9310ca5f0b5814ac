/* Shots on a table that slopes, beside the equations of SLOPE in motion/path.h: integrated in
 * small steps, as energies, by symmetry, and in the limit of a level table. */
#include "shot_support.h"

#include <stdio.h>

static const double two_pi = 6.283185307179586;

static carom_table sloped(double size, double steepness, double direction) {
  carom_table t = empty_table(size);
  t.slope_x = steepness * cos(direction);
  t.slope_y = steepness * sin(direction);
  return t;
}

/* A ball in the middle of that table, at a speed, with slip at random or none. */
static carom_shot_ball moving(random_source *random, double size, double speed, bool slides) {
  carom_shot_ball b = ball_at(0.5 * size, 0.5 * size);
  const double way = random_between(random, 0.0, two_pi);
  b.state.v[0] = speed * cos(way);
  b.state.v[1] = speed * sin(way);
  b.state.w[0] = -b.state.v[1] / b.kind.radius;
  b.state.w[1] = b.state.v[0] / b.kind.radius;
  if (slides)
    random_vector(random, 3, -speed / b.kind.radius, speed / b.kind.radius, b.state.w);
  return b;
}

/* ---- Beside small steps */

/* Rates of x, y, v_x, v_y, R w_x, R w_y, on the cloth or in the air. */
static void rates_at(const carom_ball_kind *k, const carom_table *t, int64_t label, const double y[6],
                     double rate[6]) {
  const double g = k->gravity, down[2] = {-g * t->slope_x, -g * t->slope_y};
  const double u[2] = {y[2] - y[5], y[3] + y[4]};
  const double slip = hypot(u[0], u[1]), speed = hypot(y[2], y[3]);
  for (int n = 0; n < 2; n++) {
    rate[n] = y[2 + n];
    rate[2 + n] = down[n];
    rate[4 + n] = 0.0;
  }
  if (label == CAROM_BALL_SLIDING) {
    for (int n = 0; n < 2; n++)
      rate[2 + n] -= k->mu_slide * g * u[n] / slip;
    rate[4] = -2.5 * k->mu_slide * g * u[1] / slip;
    rate[5] = 2.5 * k->mu_slide * g * u[0] / slip;
  } else if (label == CAROM_BALL_ROLLING) {
    for (int n = 0; n < 2; n++)
      rate[2 + n] = 5.0 / 7.0 * down[n] - (k->mu_roll * g / speed + k->drag * speed) * y[2 + n];
    rate[4] = -rate[3];
    rate[5] = rate[2];
  }
}

static void step(const carom_ball_kind *k, const carom_table *t, int64_t label, double h,
                 double y[6]) {
  double rate[4][6], z[6];
  rates_at(k, t, label, y, rate[0]);
  for (int stage = 1; stage < 4; stage++) {
    for (int n = 0; n < 6; n++)
      z[n] = y[n] + (stage < 3 ? 0.5 : 1.0) * h * rate[stage - 1][n];
    rates_at(k, t, label, z, rate[stage]);
  }
  for (int n = 0; n < 6; n++)
    y[n] += h / 6.0 * (rate[0][n] + 2.0 * (rate[1][n] + rate[2][n]) + rate[3][n]);
}

static void numbers_of(const carom_ball_kind *k, const carom_ball_state *s, double y[6]) {
  for (int n = 0; n < 2; n++) {
    y[n] = s->r[n];
    y[2 + n] = s->v[n];
    y[4 + n] = k->radius * s->w[n];
  }
}

/* Follows a phase of a ball in steps from the state where it begins, up to its end, which is an
 * event. Returns the greatest distance of places on the way; *end becomes that of the end, *speed
 * that of the velocities there. */
static double follow(const carom_table *table, const carom_shot_ball *ball, const carom_shot *shot,
                     const carom_ball_state *from, double start, const carom_event *event,
                     double *end, double *speed) {
  enum { STEPS = 6000, LOOKS = 300 };
  const double stop = event->time;
  double y[6], now[6], worst = 0.0, time = start;
  numbers_of(&ball->kind, from, y);
  for (int n = 1; n <= STEPS; n++) {
    /* steps become short where the direction turns fast, at the end */
    const double left = 1.0 - (double)n / STEPS, next = stop - (stop - start) * left * left * left;
    step(&ball->kind, table, from->label, next - time, y);
    time = next;
    if (n % (STEPS / LOOKS) != 0)
      continue;
    carom_ball_state state;
    ck_assert_int_eq(carom_shot_at(ball, 1, shot, time, &state), CAROM_OK);
    if (n == STEPS)
      state = event->before[0];
    numbers_of(&ball->kind, &state, now);
    *end = distance(y, now);
    *speed = distance(&y[2], &now[2]);
    worst = fmax(worst, *end);
  }
  return worst;
}

/* A ball that slides, rolls, and flies: places within 1e-5 m of fine steps, the states at the ends of
 * its phases within 1e-6 m, and then rest. */
TEST(slope_beside_small_steps) {
  enum { BALLS = 150 };
  static const double size = 4e3;
  static const char *const phases[] = {[CAROM_BALL_SLIDING] = "slides",
                                       [CAROM_BALL_ROLLING] = "rolls",
                                       [CAROM_BALL_AIRBORNE] = "flies"};
  random_source random = {test_seed()};
  double place[8] = {0.0}, ends[8] = {0.0}, speeds[8] = {0.0};
  for (int n = 0; n < FEWER(BALLS); n++) {
    carom_shot_ball ball = moving(&random, size, random_between(&random, 0.05, 8.0), n % 2 == 0);
    ball.kind.mu_roll = random_between(&random, 0.004, 0.02);
    if (n % 3 != 0)
      ball.kind.drag = n % 3 == 1 ? 0.0107 : pow(10.0, random_between(&random, -5.0, 0.0));
    if (n % 4 == 0)
      ball.state.v[2] = random_between(&random, 0.5, 3.0);
    /* real slopes, and up to nine tenths of the steepest */
    const double steepness =
        n % 2 == 0 ? 1e-3 : ball.kind.mu_roll * pow(10.0, random_between(&random, -4.0, -0.05));
    const carom_table table = sloped(size, steepness, random_between(&random, 0.0, two_pi));
    const carom_shot shot = play(&table, &ball, 1, NULL, NULL, CAROM_OK);

    const carom_ball_state *from = &ball.state;
    double start = 0.0;
    ball.state.label = CAROM_BALL_ROLLING;
    if (n % 2 == 0)
      ball.state.label = CAROM_BALL_SLIDING;
    if (n % 4 == 0)
      ball.state.label = CAROM_BALL_AIRBORNE;
    for (int64_t k = 0; k < shot.count; k++) {
      const int64_t label = from->label;
      double end = 0.0, speed = 0.0;
      if (events[k].time > start && label <= CAROM_BALL_AIRBORNE && phases[label] != NULL)
        place[label] = fmax(place[label], follow(&table, &ball, &shot, from, start, &events[k],
                                                 &end, &speed));
      ends[label] = fmax(ends[label], end);
      speeds[label] = fmax(speeds[label], speed);
      from = &events[k].after[0];
      start = events[k].time;
    }
    ck_assert_int_eq(final[0].label, CAROM_BALL_STATIONARY);
  }
  for (int label = 0; label < 8; label++)
    if (label < (int)COUNT_OF(phases) && phases[label] != NULL)
      printf("a ball that %s on a slope is within %.3g m of small steps, and at the end within "
             "%.3g m and %.3g m/s\n",
             phases[label], place[label], ends[label], speeds[label]);
  for (int label = 0; label < 8; label++) {
    ck_assert_msg(place[label] < 1e-5, "label %d: %g m", label, place[label]);
    ck_assert_msg(ends[label] < 1e-6, "label %d: %g m at the end", label, ends[label]);
  }
}
