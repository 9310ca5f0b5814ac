/* Shots on a table that slopes, compared with the equations of SLOPE in motion/path.h: integrated
 * in small steps, as energies, by symmetry, and in the limit of a level table. */
#include "shot_support.h"

static const double two_pi = 6.283185307179586;

static carom_table sloped(double size, double steepness, double direction) {
  carom_table t = empty_table(size);
  t.slope_x = steepness * cos(direction);
  t.slope_y = steepness * sin(direction);
  return t;
}

/* A ball in the middle of that table, at a speed, with slip at random or none. */
static carom_shot_ball moving(random_source *random, double size, double speed, bool slides) {
  carom_shot_ball b = rolling(0.5 * size, 0.5 * size, speed, random_between(random, 0.0, two_pi));
  if (slides)
    random_vector(random, 3, -speed / b.kind.radius, speed / b.kind.radius, b.state.w);
  return b;
}

/* ---- Compared with small steps */

/* Rates of x, y, v_x, v_y, R w_x, R w_y, on the cloth or in the air. */
static void rates_at(const carom_ball_kind *k, const carom_table *t, int64_t label,
                     const double y[6], double rate[6]) {
  const double g = k->gravity, down[2] = {-g * t->slope_x, -g * t->slope_y};
  const double u[2] = {y[2] - y[5], y[3] + y[4]};
  const double slip = planar_size(u), speed = hypot(y[2], y[3]);
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
    expect_ok(carom_shot_at(ball, 1, shot, time, &state));
    if (n == STEPS)
      state = event->before[0];
    numbers_of(&ball->kind, &state, now);
    *end = distance(y, now);
    *speed = distance(&y[2], &now[2]);
    worst = fmax(worst, *end);
  }
  return worst;
}

/* A ball that slides, rolls, and flies: places within 1e-5 m of fine steps, the states at the ends
 * of its phases within 1e-6 m, and then rest. */
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
        place[label] =
            fmax(place[label], follow(&table, &ball, &shot, from, start, &events[k], &end, &speed));
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

/* ---- Complete shots */

/* The energy of a ball with its height on the slope. */
static double energy_of(const carom_shot_ball *ball, const carom_table *t,
                        const carom_ball_state *s) {
  return state_energy(&ball->kind, s) +
         ball->kind.mass * ball->kind.gravity * (t->slope_x * s->r[0] + t->slope_y * s->r[1]);
}

/* A cue ball on a table of 9 ft that slopes, with others to meet. */
static int lay(random_source *random, const carom_table *t, carom_shot_ball *balls,
               carom_cue *cue) {
  enum { BALLS = 4 };
  for (int k = 0; k < BALLS; k++) {
    balls[k] = ball_at(0.2 + 0.27 * k, random_between(random, 0.2, t->length - 0.2));
    balls[k].kind = carom_ball_kind_of(CAROM_GAME_POOL);
  }
  *cue = carom_cue_of(CAROM_GAME_POOL);
  cue->phi = random_between(random, 0.0, 360.0);
  cue->speed = random_between(random, 0.5, 4.0);
  cue->a = random_between(random, -0.4, 0.4);
  cue->b = random_between(random, -0.4, 0.4);
  return BALLS;
}

/* Balls between two events lose energy, and in a contact too, which neglects the slope. */
TEST(slope_takes_no_energy) {
  enum { SHOTS = 40 };
  random_source random = {test_seed()};
  double gain = 0.0;
  for (int n = 0; n < SHOTS; n++) {
    carom_table t;
    carom_shot_ball balls[4];
    carom_cue cue;
    carom_table_make(CAROM_TABLE_POOL_9FT, &t);
    t.slope_x = random_between(&random, -4e-3, 4e-3);
    t.slope_y = random_between(&random, -4e-3, 4e-3);
    const int count = lay(&random, &t, balls, &cue);
    const carom_shot shot = play(&t, balls, count, &cue, NULL, CAROM_OK);
    carom_ball_state last[4];
    for (int i = 0; i < count; i++)
      last[i] = balls[i].state;
    for (int64_t k = 0; k < shot.count; k++) {
      const carom_event *e = &events[k];
      double lost = 0.0;
      for (int side = 0; side < 1 + (e->type == CAROM_EVENT_BALL_BALL); side++) {
        const int i = side == 0 ? e->a : e->b;
        const double before = energy_of(&balls[i], &t, &e->before[side]);
        gain = fmax(gain, before - energy_of(&balls[i], &t, &last[i]));
        lost += before - energy_of(&balls[i], &t, &e->after[side]);
        last[i] = e->after[side];
      }
      if (e->type != CAROM_EVENT_STRIKE && e->type != CAROM_EVENT_POCKET)
        gain = fmax(gain, -lost);
    }
  }
  printf("energy rises by %.2g J at most on a slope\n", gain);
  ck_assert_double_lt(gain, 1e-7);
}

/* A shot and its mirror image end alike. */
TEST(slope_in_a_mirror) {
  enum { SHOTS = 30 };
  random_source random = {test_seed()};
  for (int n = 0; n < SHOTS; n++) {
    carom_table t;
    carom_shot_ball ball[2];
    carom_ball_state ends[2];
    carom_table_make(CAROM_TABLE_THREECUSHION, &t);
    const double slope = random_between(&random, -3e-3, 3e-3),
                 y = random_between(&random, 0.3, 2.5);
    ball[0] = ball_at(0.4, y);
    ball[0].kind = carom_ball_kind_of(CAROM_GAME_BILLIARD);
    ball[0].state.r[2] = ball[0].kind.radius;
    random_vector(&random, 2, -2.0, 2.0, ball[0].state.v);
    random_vector(&random, 3, -60.0, 60.0, ball[0].state.w);
    ball[1] = ball[0];
    ball[1].state.r[0] = t.width - 0.4;
    ball[1].state.v[0] = -ball[0].state.v[0];
    for (int axis = 1; axis < 3; axis++) /* a spin is an axial vector */
      ball[1].state.w[axis] = -ball[0].state.w[axis];
    t.slope_y = random_between(&random, -3e-3, 3e-3);
    for (int side = 0; side < 2; side++) {
      t.slope_x = side == 0 ? slope : -slope;
      play(&t, &ball[side], 1, NULL, NULL, CAROM_OK);
      ends[side] = final[0];
    }
    NEAR(ends[0].r[0], t.width - ends[1].r[0], 1e-7);
    NEAR(ends[0].r[1], ends[1].r[1], 1e-7);
  }
}

/* Half the slope moves the end of a shot half as far from that of a level table. */
TEST(slope_of_nearly_nothing) {
  enum { SHOTS = 30 };
  random_source random = {test_seed()};
  int moved = 0;
  for (int n = 0; n < SHOTS; n++) {
    const double size = 50.0, way = random_between(&random, 0.0, two_pi);
    carom_shot_ball ball = moving(&random, size, random_between(&random, 0.3, 2.0), n % 2 == 0);
    ball.kind.drag = n % 3 == 0 ? 0.0107 : 0.0;
    double ends[3][2], times[3];
    for (int k = 0; k < 3; k++) {
      const carom_table t = sloped(size, 5e-6 * k, way);
      times[k] = play(&t, &ball, 1, NULL, NULL, CAROM_OK).time;
      memcpy(ends[k], final[0].r, sizeof ends[k]);
    }
    const double whole = distance(ends[0], ends[2]),
                 middle[2] = {0.5 * (ends[0][0] + ends[2][0]), 0.5 * (ends[0][1] + ends[2][1])};
    moved += whole > 1e-5;
    ck_assert_msg(distance(middle, ends[1]) < 1e-6 + 0.01 * whole, "%g of %g m",
                  distance(middle, ends[1]), whole);
    ck_assert_double_lt(fabs(times[2] - times[0]), 2e-3 * times[0]);
  }
  ck_assert_int_gt(moved, SHOTS / 2);
}

/* Breaks on a slope stop. At any time the balls stand as a layout may. */
TEST(slope_and_breaks) {
  enum { BREAKS = 12, LOOKS = 40 };
  random_source random = {test_seed()};
  for (int n = 0; n < FEWER(BREAKS); n++) {
    carom_table t;
    carom_shot_ball balls[22];
    carom_ball_state at[22];
    const bool snooker = n % 3 == 2;
    carom_table_make(snooker ? CAROM_TABLE_SNOOKER : CAROM_TABLE_POOL_9FT, &t);
    const carom_rack_kind kind = snooker ? CAROM_RACK_SNOOKER : CAROM_RACK_NINEBALL;
    const int count = carom_rack_size(kind);
    expect_ok(carom_rack(kind, &t, 1e-4, (uint64_t)n, balls, count));
    t.slope_x = random_between(&random, -4e-3, 4e-3);
    t.slope_y = random_between(&random, -4e-3, 4e-3);
    carom_cue cue = carom_cue_of(snooker ? CAROM_GAME_SNOOKER : CAROM_GAME_POOL);
    cue.speed = random_between(&random, 3.0, 8.0);
    cue.theta = n % 2 == 0 ? 0.0 : random_between(&random, 5.0, 30.0);
    const carom_shot shot = play(&t, balls, count, &cue, NULL, CAROM_OK);
    for (int i = 0; i < count; i++)
      ck_assert(final[i].label == CAROM_BALL_STATIONARY || final[i].label == CAROM_BALL_POCKETED ||
                final[i].label == CAROM_BALL_OFF);
    for (int k = 0; k < LOOKS; k++) {
      const double time = random_between(&random, 0.1, shot.time);
      expect_ok(carom_shot_at(balls, count, &shot, time, at));
      carom_shot_ball there[22];
      for (int i = 0; i < count; i++) {
        there[i] = balls[i];
        there[i].state = at[i];
        if (at[i].label == CAROM_BALL_AIRBORNE)
          there[i].state.label = CAROM_BALL_OFF;
      }
      int where;
      const carom_status status = carom_shot_check(&t, there, count, NULL, NULL, &where);
      ck_assert_msg(status == CAROM_OK, "break %d at %g s: %s, ball %d", n, time,
                    carom_status_name(status), where);
    }
  }
}

/* A slope on which a ball would not stop is rejected, by its greater number. */
TEST(slope_too_steep) {
  const carom_shot_ball ball = ball_at(1.0, 1.0);
  carom_table t = empty_table(2.0);
  carom_fault fault;
  char text[100];
  t.slope_x = 0.3 * ball.kind.mu_roll;
  t.slope_y = -0.9 * ball.kind.mu_roll;
  expect_ok(carom_shot_check(&t, &ball, 1, NULL, NULL, NULL));
  t.slope_y = -0.96 * ball.kind.mu_roll;
  ck_assert_int_eq(carom_shot_fault(&t, &ball, 1, NULL, NULL, &fault, text, sizeof text),
                   CAROM_ERROR_SLOPE);
  ck_assert_str_eq(fault.row->name, "slope_y");
  ck_assert_double_eq(fault.value, t.slope_y);
}
