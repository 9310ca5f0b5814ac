/* Balls that fly, fall on the slate, and meet each other in space. hops.c has single balls with
 * numbers in closed form. */
#include "flight.h"
#include "invariants.h"
#include "random_shots.h"
#include "shot/sim.h"

static const double pi = 3.14159265358979323846;

static int count_of(const carom_shot *shot, int type) {
  int count = 0;
  for (int64_t k = 0; k < shot->count; k++)
    count += events[k].type == type;
  return count;
}

/* ---- Ball and slate */

/* A ball that slips on all the way loses as much speed as if it had lain on the cloth. */
TEST(hops_slow_as_sliding_does) {
  const carom_shot shot = let_go(flying(20.0, 20.0, R, 8.0, 0.0, -2.0));
  const carom_event *last =
      event_of(&shot, CAROM_EVENT_SLATE, count_of(&shot, CAROM_EVENT_SLATE) - 1);
  NEAR(last->time, 0.3976, 1e-4);
  NEAR(8.0 - last->after[0].v[0], 1.180097, 1e-6);
  NEAR(8.0 - last->after[0].v[0], 0.2 * (2.0 + g * last->time), 1e-12);
}

/* Landings are bounded by the formula of core/src/shot/slate.c, energy never rises, and friction
 * does not turn the slip round. */
TEST(random_hops) {
  static const double restitutions[] = {-1.0, 0.3, 0.0, 0.7, 0.9, 0.95, 0.98};
  random_source random = {test_seed()};
  double worst_rise = -1.0;
  int most = 0;
  const int hops = draws_of_test(30000, 100000);
  for (int n = 0; n < hops; n++) {
    const double down = pow(10.0, random_between(&random, -4.0, 0.9));
    carom_shot_ball ball =
        spinning(flying(20.0, 20.0, R, random_between(&random, -5.0, 5.0), 0.0, -down),
                 random_between(&random, -200.0, 200.0), random_between(&random, -200.0, 200.0),
                 random_between(&random, -200.0, 200.0));
    ball.kind.restitution_table = restitutions[n % 7];
    const double given = ball.kind.restitution_table, e = given == 0.0 ? 0.5 : fmax(given, 0.0);
    const carom_shot shot = let_go(ball);
    const int landings = count_of(&shot, CAROM_EVENT_SLATE);
    const double bound =
        e > 0.0 ? 2.0 + log(1.0 + down * down * (1.0 - e * e) / (loss * loss)) / log(1.0 / (e * e))
                : 1.0;
    ck_assert_msg(landings <= bound, "%d landings at %g m/s with %g, at most %g", landings, down, e,
                  bound);
    most = landings > most ? landings : most;
    for (int k = 0; k < landings; k++) {
      const carom_event *event = &events[k]; /* nothing else happens to it before it has come to
                                                lie */
      ck_assert_int_eq(event->type, CAROM_EVENT_SLATE);
      const carom_ball_state *a = &event->before[0], *b = &event->after[0];
      const double was[2] = {a->v[0] - R * a->w[1], a->v[1] + R * a->w[0]},
                   is[2] = {b->v[0] - R * b->w[1], b->v[1] + R * b->w[0]};
      /* by no more than rounding of speeds of some m/s */
      ck_assert(was[0] * is[0] + was[1] * is[1] >= -2e-14 * planar_size(was));
      worst_rise = fmax(worst_rise, (state_energy(&ball.kind, b) - state_energy(&ball.kind, a)) /
                                        state_energy(&ball.kind, a));
    }
  }
  printf("hops: at most %d landings, greatest rise of energy %.1e of it\n", most, worst_rise);
  ck_assert_double_lt(worst_rise, 1e-14);
}

/* ---- The elevated cue */

/* A ball sticks on the slate from 43.6028 degrees on, but for the fixed loss, and rolls in the
 * air. */
TEST(sticking_strikes) {
  const carom_ball_state *after = &events[1].after[0];
  raised_strike(30.0, 43.61, 0.0, CAROM_SPACE_3D);
  NEAR(after->w[0] * R, -after->v[1], 1e-12);
  raised_strike(30.0, 43.59, 0.0, CAROM_SPACE_3D);
  ck_assert_double_gt(after->w[0] * R, -after->v[1] + 1e-6);
}

static const double no_time = 1e-9; /* s: such a tip does not follow through */

/* The speed of a cue whose blow alone gives the ball V. */
static double speed_of_cue(double V, double a, double b) {
  return 0.5 * V * (1.0 + 0.17 / 0.567 + 2.5 * (a * a + b * b));
}

/* A ball that is struck without squirt, such that the blow alone gives it V, and its state just
 * after; *blow, if not NULL, becomes what the blow alone gives. */
static carom_ball_state press(double V, double theta, double a, double b, double tip_time, double e,
                              carom_motion *blow) {
  const carom_table table = empty_table(40.0);
  carom_shot_ball ball = ball_at(20.0, 20.0);
  ball.kind.mass = 0.17;
  ball.kind.restitution_table = e;
  carom_cue cue = {.speed = speed_of_cue(V, a, b),
                   .phi = 90.0,
                   .theta = theta,
                   .a = a,
                   .b = b,
                   .mass = 0.567,
                   .end_mass = 1e-12,
                   .tip_time = -1.0,
                   .follow = tip_time == no_time ? 0.0 : CAROM_CUE_FOLLOW};
  if (blow != NULL) {
    play(&table, &ball, 1, &cue, NULL, CAROM_OK);
    memcpy(blow, events[0].after[0].v, sizeof blow->v + sizeof blow->w);
  }
  cue.tip_time = tip_time;
  play(&table, &ball, 1, &cue, NULL, CAROM_OK);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_STRIKE);
  return events[0].after[0];
}

/* A ball rolls at last in the direction of the blow, 5/7 v + 2/7 R (w_y, -w_x), for any tip;
 * mirrored strikes are mirrored; the ball gets less energy than the cue loses. A tip that has no
 * time and does not follow through is the blow and the landing. */
TEST(raised_strikes) {
  random_source random = {test_seed()};
  double worst_way = 0.0, worst_energy = -1.0, worst_limit = 0.0;
  const carom_ball_kind kind = {.mass = 0.17, .radius = R};
  for (int n = 0; n < 2000; n++) {
    const double V = pow(10.0, random_between(&random, -3.0, 1.2)),
                 theta = random_between(&random, 0.01, 89.0),
                 a = random_between(&random, -0.6, 0.6), b = random_between(&random, -0.6, 0.6),
                 e = random_between(&random, 0.2, 0.98),
                 T = pow(10.0, random_between(&random, -5.0, -2.0));
    carom_motion blow;
    const carom_ball_state m = press(V, theta, -a, b, T, e, NULL),
                           s = press(V, theta, a, b, T, e, &blow);
    const double J = events[0].impulse;
    ck_assert_double_ge(s.v[2], 0.0);
    /* along and across the blow's way */
    const double way[2] = {5.0 / 7.0 * blow.v[0] + 2.0 / 7.0 * R * blow.w[1],
                           5.0 / 7.0 * blow.v[1] - 2.0 / 7.0 * R * blow.w[0]},
                 is[2] = {5.0 / 7.0 * s.v[0] + 2.0 / 7.0 * R * s.w[1],
                          5.0 / 7.0 * s.v[1] - 2.0 / 7.0 * R * s.w[0]};
    const double across = is[0] * way[1] - is[1] * way[0], along = is[0] * way[0] + is[1] * way[1];
    ck_assert_double_ge(along, 0.0);
    worst_way = fmax(worst_way, fabs(across) / (V * V));
    NEAR(m.v[0], -s.v[0], 1e-13 * V);
    ck_assert_double_eq(m.v[2], s.v[2]);
    const double before = speed_of_cue(V, a, b), after = before - J / 0.567;
    const double lost = 0.5 * 0.567 * (before * before - after * after);
    worst_energy = fmax(worst_energy, state_energy(&kind, &s) / lost - 1.0);

    /* no time: events[1] is the landing */
    const carom_ball_state at_once = press(V, theta, a, b, no_time, e, NULL);
    press(V, theta, a, b, -1.0, e, NULL);
    ck_assert_int_eq(events[1].type, CAROM_EVENT_SLATE);
    ck_assert_double_eq(events[1].time, 0.0);
    for (int k = 0; k < 3; k++)
      worst_limit = fmax(worst_limit, fabs(at_once.v[k] - events[1].after[0].v[k]) - 0.2 * loss);
  }
  printf("raised: way off by %.1e, energy by %.1e, no time off by %.1e m/s\n", worst_way,
         worst_energy, worst_limit);
  ck_assert_double_lt(worst_way, 1e-13);
  ck_assert_double_lt(worst_energy, 1e-9);
  ck_assert_double_lt(worst_limit, 1e-3);
}

/* Speeds are continuous by the elevation and the time of the tip: a step that is halved 30 times
 * becomes nothing. */
TEST(raised_strikes_are_continuous) {
  int steep = 0;
  for (int by_time = 0; by_time < 2; by_time++)
    for (int n = 0; n < 2000; n++) {
      double low = n / 2000.0, high = (n + 1) / 2000.0, step = 1.0;
      for (int half = 0; half < 31; half++) {
        double up[3];
        for (int k = 0; k < 3; k++) {
          const double x = low + 0.5 * k * (high - low);
          const carom_ball_state s = by_time
                                         ? press(3.0, 60.0, 0.3, 0.1, 5e-4 + 1.5e-3 * x, 0.5, NULL)
                                         : press(3.0, 1.0 + 88.0 * x, 0.3, 0.1, 0.0, 0.5, NULL);
          up[k] = sqrt(s.v[2] * s.v[2] + loss * loss) + s.v[1];
        }
        step = fabs(up[2] - up[0]);
        if (step < 2e-3)
          break;
        steep += half == 0;
        if (fabs(up[1] - up[0]) > fabs(up[2] - up[1]))
          high = 0.5 * (low + high);
        else
          low = 0.5 * (low + high);
      }
      ck_assert_double_lt(step, 2e-3);
    }
  printf("raised: %d steep steps, no jump\n", steep);
}

/* A shot in which nothing leaves the cloth has the same bits in both spaces; the header promises
 * it. */
TEST(level_shots_are_flat_shots) {
  static carom_event kept[ROOM];
  for (int n = 0; n < 300; n++) {
    random_shot s;
    random_shot_make(n % random_shot_kinds(), test_seed(), (uint64_t)n, &s);
    s.cue.theta = 0.0;
    static const carom_shot_cushion models[] = {CAROM_SHOT_CUSHION_HAN, CAROM_SHOT_CUSHION_STRONGE,
                                                CAROM_SHOT_CUSHION_DEFAULT};
    carom_shot_options options = {.cushion_model = models[n % 3], .space = CAROM_SPACE_FLAT};
    carom_shot flat = {.events = kept, .room = ROOM}, space = {.events = events, .room = ROOM};
    const carom_status status = carom_shoot(&s.table, s.ball, s.count, &s.cue, &options, &flat);
    options.space = CAROM_SPACE_3D;
    ck_assert_int_eq(carom_shoot(&s.table, s.ball, s.count, &s.cue, &options, &space), status);
    ck_assert_int_eq(space.count, flat.count);
    ck_assert_mem_eq(events, kept, (size_t)(flat.count < ROOM ? flat.count : ROOM) * sizeof *kept);
  }
}

/* ---- Two balls */

/* Two balls that fly on a straight line towards each other meet whatever their common fall. */
TEST(two_flying_balls) {
  static const struct {
    double height;
    double v_z;
  } flights[] = {{1.0, 3.0}, {0.5, 0.0}, {1.0, 1.0}, {1.0, -0.5}, {1.0, 2.0}};
  const carom_table table = empty_table(40.0);
  const double meet_at = (0.5 - 2.0 * R) / (2.5 - 0.5);
  for (size_t k = 0; k < COUNT_OF(flights); k++) {
    const double z = R + flights[k].height;
    const carom_shot_ball balls[2] = {flying(20.0, 20.0, z, 2.5, 0.0, flights[k].v_z),
                                      flying(20.5, 20.0, z, 0.5, 0.0, flights[k].v_z)};
    const carom_shot shot = play(&table, balls, 2, NULL, NULL, CAROM_OK);
    NEAR(event_of(&shot, CAROM_EVENT_BALL_BALL, 0)->time, meet_at, 1e-12);
  }
}

static carom_impact impact_of(const carom_shot_ball *a, const carom_shot_ball *b, double mu) {
  carom_impact in = {.a = {.radius = a->kind.radius, .mass = a->kind.mass},
                     .b = {.radius = b->kind.radius, .mass = b->kind.mass},
                     .mu_ball = mu,
                     .restitution = 0.95};
  memcpy(in.a.r, a->state.r, 9 * sizeof(double)); /* r, v and w */
  memcpy(in.b.r, b->state.r, 9 * sizeof(double));
  return in;
}

/* An oblique hit in the air with spin, in a shot and alone. A separate program computed the numbers
 * from the closed form of core/src/shot/spheres.c; they are right to their last digit. */
TEST(oblique_hit) {
  static const double v_a[] = {0.386991560, -0.034744861, 0.533907161};
  static const double w_a[] = {-1.595693, 27.088457, 7.412700};
  static const double w_b[] = {-1.595693, -2.911543, -2.587300};
  static const double v_b_landed[] = {1.302920043, 0.036728760, 0.516566554};
  static const double energy_lost = 0.017383078;
  const carom_shot_options constant = {.friction = CAROM_FRICTION_CONSTANT};
  const carom_table table = empty_table(40.0);
  const double above = 0.03;
  const double beside = sqrt(4.0 * R * R - above * above);
  const carom_shot_ball balls[2] = {
      spinning(flying(20.0, 20.0, R + above, 2.0, 0.0, -0.5), 0.0, 30.0, 10.0),
      ball_at(20.0 + beside, 20.0)};
  play(&table, balls, 2, NULL, &constant, CAROM_OK);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_BALL_BALL);
  ck_assert_double_lt(events[0].time, 1e-12);
  double change = 0.0;
  for (int side = 0; side < 2; side++) {
    change += state_energy(&balls[side].kind, &events[0].after[side]);
    change -= state_energy(&balls[side].kind, &events[0].before[side]);
  }
  NEAR(change, -energy_lost, 1e-9);

  const carom_impact in = impact_of(&balls[0], &balls[1], 0.05);
  carom_result out;
  expect_ok(carom_impact3(&in, &out));
  for (int k = 0; k < 3; k++) {
    NEAR(events[0].after[0].v[k], v_a[k], 1e-9);
    NEAR(events[0].after[0].w[k], w_a[k], 1e-6);
    NEAR(events[0].after[1].w[k], w_b[k], 1e-6);
    NEAR(out.a.v[k], v_a[k], 1e-9);
    NEAR(out.b.w[k], w_b[k], 1e-6);
    NEAR(out.a.v[k] + out.b.v[k], in.a.v[k], 1e-15);
  }

  /* the ball that is pushed into the cloth lands at the same instant */
  ck_assert_int_eq(events[1].type, CAROM_EVENT_SLATE);
  ck_assert_int_eq(events[1].a, 1);
  ck_assert_double_eq(events[1].time, events[0].time);
  for (int k = 0; k < 3; k++)
    NEAR(events[1].after[0].v[k], v_b_landed[k], 1e-9);
}

/* 45 degrees from above at 2 m/s, without friction of balls: each component of the speed that is
 * exchanged is (1 + e)/2 of 1 m/s. */
TEST(hit_from_above) {
  const carom_shot_options constant = {.friction = CAROM_FRICTION_CONSTANT};
  const carom_table table = empty_table(40.0);
  const double aside = 2.0 * R * sqrt(0.5);
  carom_shot_ball balls[2] = {flying(20.0 - aside, 20.0, R + aside, 0.0, 0.0, -2.0),
                              ball_at(20.0, 20.0)};
  balls[0].kind.mu_ball = 0.0;
  balls[1].kind.mu_ball = 0.0;
  play(&table, balls, 2, NULL, &constant, CAROM_OK);
  const double exchanged = 0.5 * (1.0 + balls[0].kind.restitution);
  NEAR(events[0].after[0].v[0], -exchanged, 1e-9);
  NEAR(events[0].after[0].v[2], exchanged - 2.0, 1e-9);
  NEAR(events[0].after[1].v[0], exchanged, 1e-9);
  NEAR(events[0].after[1].v[2], -exchanged, 1e-9);

  const flight out = landed((flight){exchanged, -exchanged, 0.0});
  ck_assert_int_eq(events[1].type, CAROM_EVENT_SLATE);
  NEAR(events[1].after[0].v[0], out.along, 1e-9);
  NEAR(events[1].after[0].v[2], out.up, 1e-9);
  NEAR(events[1].after[0].w[1], out.spin / R, 1e-6);
}

/* Straight down at 1 m/s on a ball that is at rest: four impacts at one instant. */
TEST(hit_straight_down) {
  const carom_table table = empty_table(40.0);
  const carom_shot_ball balls[2] = {flying(20.0, 20.0, 3.0 * R, 0.0, 0.0, -1.0),
                                    ball_at(20.0, 20.0)};
  play(&table, balls, 2, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(events[4].type, CAROM_EVENT_SLIDING_ROLLING);
  for (int k = 0; k < 4; k++) {
    ck_assert_double_lt(events[k].time, 1e-12);
    ck_assert_int_eq(events[k].type, k % 2 == 0 ? CAROM_EVENT_BALL_BALL : CAROM_EVENT_SLATE);
  }
  NEAR(events[2].after[0].v[2], 0.474287, 1e-3); /* and 20 mm/s aside */
  ck_assert_double_eq(events[3].after[0].v[2], 0.0);
}

/* x and z, turned about y. */
static void turn(double cosine, double sine, double x[3]) {
  const double along = cosine * x[0] + sine * x[2];
  x[2] = cosine * x[2] - sine * x[0];
  x[0] = along;
}

/* Two balls on the cloth, in the plane y = 0, by the law between the laws of equal balls and of
 * spheres: (1 - phi) of carom_collide() with its plane turned through the line of centres and
 * R_b w_b for the second ball, phi of carom_impact3(), phi = (n_z / 0.1)^2. */
static carom_result between_the_laws(const carom_impact *in) {
  const double x = in->b.r[0] - in->a.r[0], z = in->b.r[2] - in->a.r[2], size = hypot(x, z),
               phi = pow(z / size / 0.1, 2.0), ratio = in->b.radius / in->a.radius;
  carom_result space, level;
  expect_ok(carom_impact3(in, &space));

  carom_impact turned = *in;
  carom_ball *ball[2] = {&turned.a, &turned.b};
  double rise[2];
  turned.b.radius = in->a.radius;
  memcpy(turned.b.r, turned.a.r, sizeof turned.b.r);
  turned.b.r[0] += 2.0 * in->a.radius;
  for (int axis = 0; axis < 3; axis++)
    turned.b.w[axis] *= ratio;
  for (int side = 0; side < 2; side++) {
    turn(x / size, z / size, ball[side]->v);
    turn(x / size, z / size, ball[side]->w);
    rise[side] = ball[side]->v[2];
    ball[side]->v[2] = 0.0;
  }
  expect_ok(carom_collide(&turned, NULL, &level));

  carom_motion *of_level[2] = {&level.a, &level.b}, *of_space[2] = {&space.a, &space.b};
  for (int side = 0; side < 2; side++) {
    of_level[side]->v[2] = rise[side];
    turn(x / size, -z / size, of_level[side]->v);
    turn(x / size, -z / size, of_level[side]->w);
    for (int axis = 0; axis < 3; axis++) {
      const double own = side == 0 ? 1.0 : ratio;
      double *v = &of_space[side]->v[axis], *w = &of_space[side]->w[axis];
      *v = phi * *v + (1.0 - phi) * of_level[side]->v[axis];
      *w = phi * *w + (1.0 - phi) * of_level[side]->w[axis] / own;
    }
  }
  return space;
}

/* A ball of 30.2 mm and 0.2 kg rolls into a pool ball. */
TEST(unlike_radii) {
  const carom_table table = empty_table(40.0);
  carom_shot_ball balls[2] = {ball_at(20.0, 20.0), ball_at(20.3, 20.0)};
  balls[0].kind.radius = balls[0].state.r[2] = 0.0302;
  balls[0].kind.mass = 0.2;
  balls[0].kind.mu_roll = 1e-12; /* so that it still has 2 m/s */
  balls[0].state.v[0] = 2.0;
  balls[0].state.w[1] = 2.0 / 0.0302;
  const carom_shot_options constant = {.friction = CAROM_FRICTION_CONSTANT};
  const carom_shot shot = play(&table, balls, 2, NULL, &constant, CAROM_OK);
  const carom_event *hit = event_of(&shot, CAROM_EVENT_BALL_BALL, 0);
  NEAR(hit->before[1].r[0] - hit->before[0].r[0], 0.058752532, 1e-9);

  memcpy(&balls[0].state, &hit->before[0], sizeof balls[0].state);
  carom_impact in = impact_of(&balls[0], &balls[1], 0.05);
  in.a.mu_slide = in.b.mu_slide = 0.2;
  const carom_result expected = between_the_laws(&in);
  for (int axis = 0; axis < 3; axis++) {
    NEAR(hit->after[0].v[axis], expected.a.v[axis], 1e-6);
    NEAR(hit->after[1].v[axis], expected.b.v[axis], 1e-6);
    NEAR(hit->after[0].w[axis], expected.a.w[axis], 1e-4);
    NEAR(hit->after[1].w[axis], expected.b.w[axis], 1e-4);
  }
  ck_assert_double_gt(hit->after[0].v[2], 0.05);
  ck_assert_double_lt(hit->after[1].v[2], -0.05);
  ck_assert_int_eq(hit->after[0].label, CAROM_BALL_AIRBORNE);
}

/* The largest difference of two positions, m, or speeds, m/s. */
static double farthest(const carom_ball_state *a, const carom_ball_state *b, int count) {
  double most = 0.0;
  for (int k = 0; k < count; k++)
    for (int axis = 0; axis < 3; axis++)
      most = fmax(most, fmax(fabs(a[k].r[axis] - b[k].r[axis]), fabs(a[k].v[axis] - b[k].v[axis])));
  return most;
}

/* A cue ball that is larger or smaller by dR changes where follow, stun, draw and a cut end by
 * about as much, to either side of equal balls. */
TEST(radii_have_no_jump) {
  static const double tip[] = {0.4, -0.05, -0.4, -0.05}, change[] = {1e-9, 1e-6, 1e-4};
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (int way = 0; way < 4; way++) {
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.speed = 2.1;
    cue.phi = 90.0;
    cue.b = tip[way];
    carom_shot_ball balls[2] = {ball_at(way == 3 ? 0.665 : 0.635, 0.6), ball_at(0.635, 1.2)};
    play(&table, balls, 2, &cue, NULL, CAROM_OK);
    const carom_ball_state equal[2] = {final[0], final[1]};
    for (int k = 0; k < 6; k++) {
      const double dR = k % 2 == 0 ? change[k / 2] : -change[k / 2];
      balls[0].kind.radius = balls[0].state.r[2] = R + dR;
      play(&table, balls, 2, &cue, NULL, CAROM_OK);
      ck_assert_double_lt(farthest(final, equal, 2), 200.0 * fabs(dR) + 1e-6);
    }
  }
}

/* Two balls that meet with one a height above the cloth, or larger by as much; and a third that
 * touches them, which makes a cluster of them. A height or a difference of 1 um changes no speed by
 * a jump. */
TEST(a_hair_above_the_cloth_is_no_jump) {
  static const double change[] = {1e-9, 1e-6, 1e-5};
  for (int count = 2; count <= 3; count++)
    for (int way = 0; way < 8; way++) {
      const double angle = way / 4 * 0.5, spin = (way / 2 % 2 - 0.5) * 80.0;
      const double x = 2.0 * R * cos(angle), y = 2.0 * R * sin(angle);
      carom_shot_ball balls[3] = {ball_at(0.0, 0.0), ball_at(x, y), ball_at(2.0 * x, 2.0 * y)};
      balls[0].state.v[0] = 2.0;
      balls[0].state.w[1] = spin;
      balls[0].state.label = CAROM_BALL_SLIDING;
      carom_motion flat[3], near[3];
      expect_ok(carom_cluster(balls, count, NULL, flat, NULL, 0, NULL));
      for (int k = 0; k < 3; k++) {
        carom_shot_ball other[3];
        memcpy(other, balls, sizeof other);
        other[0].state.r[2] += change[k];
        if (way % 2 == 0)
          other[0].kind.radius += change[k];
        else
          other[0].state.label = CAROM_BALL_AIRBORNE;
        expect_ok(carom_cluster(other, count, NULL, near, NULL, 0, NULL));
        for (int i = 0; i < count; i++)
          for (int axis = 0; axis < 3; axis++) {
            NEAR(near[i].v[axis], flat[i].v[axis], 300.0 * change[k] + 1e-9);
            NEAR(R * near[i].w[axis], R * flat[i].w[axis], 300.0 * change[k] + 1e-9);
          }
      }
    }
}

/* How far spheres in space are from the 2014 model for two balls on the cloth: nothing for stun
 * shots, at most 0.6 % of the speed in the rolling velocities that the balls end with. */
TEST(jump_at_the_cloth) {
  /* mm/s: roll full, half; draw full */
  static const double told[3][4] = {{2.7, 3.2, 4.3}, {0.0, 2.1, 0.0}, {0.0, 0.0, -4.2}};
  double worst = 0.0;
  for (int spin = -1; spin <= 1; spin++)
    for (int cut = 0; cut < 3; cut++)
      for (int q = 0; q < 3; q++) {
        const double V = (double[]){0.5, 2.0, 6.0}[q],
                     angle = (double[]){0.0, 30.0, 60.0}[cut] * pi / 180.0;
        carom_shot_ball a = ball_at(0.0, 0.0),
                        b = ball_at(2.0 * R * cos(angle), 2.0 * R * sin(angle));
        a.state.v[0] = V;
        a.state.w[1] = spin * V / R;
        carom_impact in = impact_of(&a, &b, 0.0);
        in.a.mu_slide = in.b.mu_slide = 0.2;
        in.mu_ball = carom_mu_ball(&in, carom_alciatore());
        carom_result flat, space;
        expect_ok(carom_collide(&in, NULL, &flat));
        expect_ok(carom_impact3(&in, &space));
        double p[3], s[3];
        carom_rolling_velocity(flat.a.v, flat.a.w, R, p);
        carom_rolling_velocity(space.a.v, space.a.w, R, s);
        const double change = fmax(fabs(s[0] - p[0]), fabs(s[1] - p[1])) / V;
        worst = fmax(worst, change);
        if (spin == 0)
          ck_assert_double_lt(change, 1e-9);
        if (spin == 1 && cut == 0)
          NEAR(1e3 * (s[0] - p[0]), told[0][q], 0.05);
        if (spin == -1 && cut == 0 && q == 2)
          NEAR(1e3 * (s[0] - p[0]), told[2][q], 0.05);
      }
  ck_assert_double_lt(worst, 0.006);
}

/* A ball on another one, which lies or falls, neither of which spins: it rolls off in some hops,
 * from exactly above it, too. From there it came to 10,000 events. Energy rises by 9 uJ alone. */
TEST(rolls_off_a_ball) {
  static const double up[] = {0.0, 1e-12, 1e-6, 0.001, 0.01, 0.1}, fall[] = {0.0, 1e-3, 0.2},
                      off[] = {0.0, 1e-12, 1e-6, 1e-4, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05};
  for (int k = 0; k < 180; k++) {
    const double aside = off[k % 10], high = fall[k / 60];
    const double above = R + sqrt(4.0 * R * R - aside * aside) + up[k / 10 % 6];
    const carom_shot_ball balls[2] = {flying(20.0, 20.0, R + high, 0.0, 0.0, 0.0),
                                      flying(20.0 + aside, 20.0, above + high, 0.0, 0.0, 0.0)};
    const carom_table table = empty_table(40.0);
    const carom_shot shot = play(&table, balls, 2, NULL, NULL, CAROM_OK);
    shot_measures m = shot_measure(&table, balls, 2, &shot, CAROM_OK, 3);
    m.gain -= aside < 0.0028 ? 1e-4 : 0.0;
    EXPECT_SOUND(m, 1e-9, "off a ball", k);
    ck_assert_int_le(shot.count, 400);
    /* both reach the cloth, and move apart */
    ck_assert_int_eq(final[1].label, CAROM_BALL_STATIONARY);
    ck_assert_double_gt(final[1].r[0] - final[0].r[0], 2.0 * R);
  }
}

/* carom_impact3() keeps momentum, loses energy, does the same with both balls swapped, and rejects
 * what has no meaning. */
TEST(spheres) {
  random_source random = {test_seed()};
  double worst = 0.0, rise = -1.0;
  for (int n = 0; n < 20000; n++) {
    carom_impact in = {.mu_ball = random_between(&random, 0.0, 1.0),
                       .restitution = random_between(&random, 0.0, 1.0)};
    carom_ball *ball[2] = {&in.a, &in.b};
    for (int side = 0; side < 2; side++) {
      for (int k = 0; k < 3; k++) {
        ball[side]->r[k] = random_between(&random, -1.0, 1.0);
        ball[side]->v[k] = random_between(&random, -5.0, 5.0);
        ball[side]->w[k] = random_between(&random, -200.0, 200.0);
      }
      ball[side]->radius = random_between(&random, 0.01, 0.05);
      ball[side]->mass = random_between(&random, 0.05, 0.5);
    }
    carom_result out, back;
    const carom_status status = carom_impact3(&in, &out);
    ck_assert_int_ge(status, 0);
    double before = 0.0, after = 0.0;
    const carom_motion *is[2] = {&out.a, &out.b};
    for (int k = 0; k < 3; k++) {
      double p = 0.0;
      for (int side = 0; side < 2; side++) {
        const double I = 0.4 * ball[side]->radius * ball[side]->radius;
        p += ball[side]->mass * (is[side]->v[k] - ball[side]->v[k]);
        before += 0.5 * ball[side]->mass *
                  (ball[side]->v[k] * ball[side]->v[k] + I * ball[side]->w[k] * ball[side]->w[k]);
        after += 0.5 * ball[side]->mass *
                 (is[side]->v[k] * is[side]->v[k] + I * is[side]->w[k] * is[side]->w[k]);
      }
      worst = fmax(worst, fabs(p));
    }
    rise = fmax(rise, (after - before) / before);
    if (status == CAROM_OK) { /* they part, and swapped they do the same */
      double parting = 0.0;
      for (int k = 0; k < 3; k++)
        parting += (out.b.v[k] - out.a.v[k]) * (in.b.r[k] - in.a.r[k]);
      ck_assert_double_ge(parting, -1e-12);
      const carom_impact swapped = {
          .a = in.b, .b = in.a, .mu_ball = in.mu_ball, .restitution = in.restitution};
      carom_impact3(&swapped, &back);
      for (int k = 0; k < 3; k++) {
        NEAR(back.a.v[k], out.b.v[k], 1e-13);
        NEAR(back.b.w[k], out.a.w[k], 1e-11);
      }
    }
  }
  printf("spheres: momentum within %.1e kg m/s, energy rises by %.1e at most\n", worst, rise);
  ck_assert_double_lt(worst, 1e-14);
  ck_assert_double_lt(rise, 1e-14);
  carom_result out;
  /* friction at any speed: the same as at 1 m/s, in that unit */
  static const double units[] = {1e-280, 1e-200, 1e-160, 1e-100, 1e150, 1e155, 1e200, 1e290};
  const carom_impact slow = {.a = {.v = {1, 0.5, 0.2}, .w = {5, 7, 9}, .radius = R, .mass = 1},
                             .b = {.r = {1, 0, 0}, .radius = R, .mass = 1},
                             .mu_ball = 0.1,
                             .restitution = 0.9};
  carom_result expected;
  expect_ok(carom_impact3(&slow, &expected));
  for (int n = 0; n < 8; n++) {
    carom_impact fast = slow;
    for (int k = 0; k < 3; k++) {
      fast.a.v[k] *= units[n];
      fast.a.w[k] *= units[n];
    }
    expect_ok(carom_impact3(&fast, &out));
    for (int k = 0; k < 3; k++) {
      NEAR(out.a.v[k] / units[n], expected.a.v[k], 1e-14);
      NEAR(out.b.w[k] / units[n], expected.b.w[k], 1e-12);
    }
  }
}

/* carom_impact3() rejects each bad argument with a status of its own, and the result is NaN. */
#define REJECTED(member, wrong, expected)                               \
  do {                                                                  \
    carom_impact in = good;                                             \
    in.member = wrong;                                                  \
    ck_assert_int_eq(carom_impact3(&in, &out), CAROM_ERROR_##expected); \
    for (int axis = 0; axis < 3; axis++)                                \
      ck_assert(isnan(out.a.v[axis]) && isnan(out.b.w[axis]));          \
  } while (0)

TEST(spheres_are_checked) {
  const carom_impact good = {.a = {.v = {0.0, 1.0, 0.0}, .radius = 0.03, .mass = 0.17},
                             .b = {.r = {0.0, 0.06, 0.0}, .radius = 0.03, .mass = 0.17},
                             .mu_ball = 0.1,
                             .restitution = 0.9};
  carom_result out;
  ck_assert_int_eq(carom_impact3(NULL, &out), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_impact3(&good, NULL), CAROM_ERROR_NULL);
  expect_ok(carom_impact3(&good, &out));
  REJECTED(a.r[2], NAN, POSITION);
  REJECTED(b.v[1], INFINITY, VELOCITY);
  REJECTED(b.w[1], NAN, SPIN);
  REJECTED(a.radius, 0.0, RADIUS);
  REJECTED(b.mass, -1.0, MASS);
  REJECTED(mu_ball, 1.1, MU_BALL);
  REJECTED(mu_ball, -0.1, MU_BALL);
  REJECTED(restitution, NAN, RESTITUTION);
  REJECTED(restitution, 1.01, RESTITUTION);
  REJECTED(restitution, -0.01, RESTITUTION);
  REJECTED(b.r[1], 0.0, COINCIDENT);
  REJECTED(b.v[1] = -1e308; in.a.v[1], 1.7e308, OVERFLOW);
  REJECTED(a.mass, 1e-310, OVERFLOW);
  carom_impact parting = good;
  parting.a.v[1] = -1.0;
  ck_assert_int_eq(carom_impact3(&parting, &out), CAROM_SEPARATING);
  ck_assert_double_eq(out.a.v[1], -1.0);
}
