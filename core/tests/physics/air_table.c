/* Balls that fly, and the table: noses from any height, jaws, the tops of rails, pockets. A nose is
 * at h = 36.576 mm. */
#include "flight.h"

static const double h = 0.036576;

/* The true nose is a line this far inside the wall that represents it. */
static double shift(void) {
  return R - sqrt(h * (2.0 * R - h));
}

/* ---- Noses */

/* A nose that is met from above: 0.2 m from it, level at 3 m/s and 40 mm above the cloth. The rail
 * of the far side is at y = 40. A separate program computed the numbers; they are right to their
 * last digit. */
TEST(nose_from_above) {
  const carom_table table = empty_table(40.0);
  const carom_shot_ball ball = flying(20.0, 40.0 - shift() - 0.2, R + 0.04, 0.0, 3.0, 0.0);
  play(&table, &ball, 1, NULL, NULL, CAROM_OK);
  const carom_ball_state *before = &events[0].before[0];
  const carom_ball_state *after = &events[0].after[0];
  ck_assert_int_eq(events[0].type, CAROM_EVENT_RAIL);
  NEAR(events[0].time, 0.058592601497, 1e-11);
  NEAR(before->r[2], 0.051735679, 1e-9);
  NEAR((h - before->r[2]) / R, -0.530522452, 1e-8);
  NEAR(after->v[0], 0.0, 1e-15);
  NEAR(after->v[1], -1.633527600, 1e-8);
  NEAR(after->v[2], 1.952917653, 1e-8);
  NEAR(after->w[0], -27.604842, 1e-5);
}

/* The nose 30 degrees below the centre, without friction: every model but the mirror returns e of
 * the speed into the nose, and nothing else changes. */
TEST(nose_below_the_centre) {
  const carom_table table = empty_table(40.0);
  const double cosine = sqrt(0.75);
  const double sine = 0.5;
  const double speed = 3.0;
  carom_shot_ball ball = flying(20.0, 40.0 - shift() - R * cosine, h + R * sine, 0.0, speed, 0.0);
  ball.kind.mu_cushion = 0.0;
  const double change = (1.0 + ball.kind.restitution_cushion) * speed * cosine;
  for (int model = 0; carom_word(CAROM_WORDS_CUSHION_MODEL, model) != NULL; model++) {
    if (model == CAROM_CUSHION_MIRROR)
      continue;
    const carom_shot_options options = {.cushion_model = (carom_shot_cushion)(1 + model)};
    play(&table, &ball, 1, NULL, &options, CAROM_OK);
    ck_assert_double_lt(events[0].time, 1e-9);
    NEAR(events[0].after[0].v[1], speed - change * cosine, 1e-8);
    NEAR(events[0].after[0].v[2], change * sine, 1e-8);
  }
}

/* Restitution changes by the closing speed over cos(theta) of a ball on the cloth, from whatever
 * height the nose is met, and for every model. */
TEST(restitution_by_closing_speed) {
  const carom_table table = empty_table(40.0);
  const double sine = h / R - 1.0, cosine = sqrt(1.0 - sine * sine);
  for (int model = 0; carom_word(CAROM_WORDS_CUSHION_MODEL, model) != NULL; model++)
    for (int k = 0; k < 3; k++) {
      const double up = (const double[]){0.2, -0.1, -0.5}[k]; /* the nose over the centre, R */
      carom_shot_ball ball =
          flying(20.0, 40.0 - shift() - R * sqrt(1.0 - up * up), h - up * R, 0.0, 2.5, 0.0);
      ball.kind.mu_cushion = 0.0;
      ball.kind.restitution_cushion = 0.8;
      ball.kind.restitution_log = -0.1;
      const carom_shot_options options = {.cushion_model = (carom_shot_cushion)(1 + model)};
      play(&table, &ball, 1, NULL, &options, CAROM_OK);
      const double closing = 2.5 * sqrt(1.0 - up * up), e = 0.8 - 0.1 * log(closing / cosine);
      const double after =
          events[0].after[0].v[1] * sqrt(1.0 - up * up) + events[0].after[0].v[2] * up;
      NEAR(after, -e * closing, 1e-6);
    }
}

/* Near the cloth the result goes over to that of a ball that is on it, to the last bit at z =
 * R; and energy never rises. */
TEST(near_the_cloth) {
  const carom_table table = empty_table(4.0);
  static const int models[] = {CAROM_CUSHION_MATHAVAN, CAROM_CUSHION_STRONGE, CAROM_CUSHION_HAN,
                               CAROM_CUSHION_MIRROR};
  random_source random = {test_seed()};
  double worst = -1.0;
  for (int n = 0; n < 10000; n++) {
    const carom_shot_options options = {.cushion_model = (carom_shot_cushion)(1 + models[n % 4])};
    const double z = n % 3 == 0 ? R : R + random_between(&random, 0.0, 1.2e-3), up = h - z;
    carom_shot_ball ball = flying(
        2.0, 4.0 - shift() - sqrt(R * R - up * up), z, random_between(&random, -3.0, 3.0),
        random_between(&random, 0.2, 4.0), n % 3 == 0 ? 0.0 : random_between(&random, -0.5, 0.5));
    random_vector(&random, 3, -100.0, 100.0, ball.state.w);
    ball.state.label = CAROM_BALL_AIRBORNE;
    carom_shot shot = {.events = events, .room = ROOM};
    const carom_status status = carom_shoot(&table, &ball, 1, NULL, &options, &shot);
    ck_assert_msg(status == CAROM_OK, "%s", carom_status_name(status));
    if (events[0].type != CAROM_EVENT_RAIL)
      continue; /* it moves down by so much that it lands first, or off the nose */
    const double was = state_energy(&ball.kind, &events[0].before[0]);
    worst = fmax(worst, (state_energy(&ball.kind, &events[0].after[0]) - was) / was);
    if (n % 3 == 0) {
      carom_ball_state lifted = events[0].after[0];
      ball.state.r[1] = 4.0 - R;
      ball.state.label = CAROM_BALL_STATIONARY;
      carom_shoot(&table, &ball, 1, NULL, &options, &shot);
      ck_assert_int_eq(events[0].type, CAROM_EVENT_RAIL);
      ck_assert_mem_eq(lifted.v, events[0].after[0].v, sizeof lifted.v);
      ck_assert_mem_eq(lifted.w, events[0].after[0].w, sizeof lifted.w);
    }
  }
  printf("near the cloth: energy changes by %.1e of it at least\n", worst);
  ck_assert_double_lt(worst, 1e-14);
  /* half the height, half the difference */
  double last = 0.0;
  for (int n = 0; n < 7; n++) { /* below 1e-6 m it lies */
    const double z = R + ldexp(1e-4, -n), up = h - z;
    carom_shot_ball ball = flying(2.0, 4.0 - shift() - sqrt(R * R - up * up), z, 1.0, 2.0, 0.0),
                    low = ball_at(2.0, 4.0 - R);
    low.state.v[0] = 1.0;
    low.state.v[1] = 2.0;
    play(&table, &low, 1, NULL, NULL, CAROM_OK);
    const carom_ball_state flat = events[0].after[0];
    play(&table, &ball, 1, NULL, NULL, CAROM_OK);
    ck_assert_int_eq(events[0].type, CAROM_EVENT_RAIL);
    const double away = hypot(events[0].after[0].v[1] - flat.v[1], events[0].after[0].v[2]);
    ck_assert_msg(n == 0 || (away > 0.4 * last && away < 0.6 * last), "%g of %g", away, last);
    last = away;
  }
}

/* ---- Jaws */

typedef struct track {
  double r[3], v[3];
} track;

/* How far the surface of a flying ball is from a post with a round edge at height h, which is
 * `radius` thick. */
static double gap_of(const track *f, double x, double y, double radius, double t) {
  const double z = f->r[2] + t * (f->v[2] - 0.5 * g * t) - h;
  const double q = hypot(f->r[0] + t * f->v[0] - x, f->r[1] + t * f->v[1] - y) - radius;
  return (q >= 0.0 ? hypot(q, z) : z) - R;
}

/* Random flights at one post against samples of the gap and bisection: none is missed, none
 * false, and the gap is 0 there. */
TEST(posts) {
  enum { FLIGHTS = 100000, LOOKS = 800 };
  const int flights = draws_of_test(FLIGHTS / 4, FLIGHTS);
  random_source random = {test_seed()};
  carom_table table = empty_table(40.0);
  int hits = 0, tops = 0;
  double worst = 0.0;
  for (int n = 0; n < flights; n++) {
    const double rho = n % 4 == 0 ? 0.0 : random_between(&random, 0.003, 0.12),
                 radius = rho + shift();
    table.jaws = 1;
    table.jaw[0] = (carom_jaw){.centre = {20.0, 20.0}, .radius = rho, .height = h};
    const double far = radius + R + random_between(&random, 0.001, 0.3),
                 way = random_between(&random, 0.0, 6.2832);
    const double aim = way + 3.14159265 +
                       random_between(&random, -1.0, 1.0) * asin((radius + R) / far),
                 speed = exp(random_between(&random, log(0.05), log(8.0)));
    track f = {{20.0 + far * cos(way), 20.0 + far * sin(way), random_between(&random, R, R + 0.15)},
               {speed * cos(aim), speed * sin(aim), random_between(&random, -2.0, 2.0)}};
    const carom_shot_ball ball = flying(f.r[0], f.r[1], f.r[2], f.v[0], f.v[1], f.v[2]);
    const double T = (f.v[2] + sqrt(f.v[2] * f.v[2] + 2.0 * g * (f.r[2] - R))) / g;
    /* the first sample that is inside, and between it and the one before the contact */
    double first = INFINITY;
    for (int k = 1; k <= LOOKS && first == INFINITY; k++) {
      double low = T * (k - 1) / LOOKS, high = T * k / LOOKS;
      if (gap_of(&f, 20.0, 20.0, radius, high) >= 0.0)
        continue;
      for (int half = 0; half < 60; half++) {
        const double middle = 0.5 * (low + high);
        *(gap_of(&f, 20.0, 20.0, radius, middle) < 0.0 ? &high : &low) = middle;
      }
      first = high;
    }
    const carom_shot_options one = {.events_most = 1};
    carom_shot shot = {.events = events, .room = 1};
    carom_shoot(&table, &ball, 1, NULL, &one, &shot);
    const bool met = events[0].type == CAROM_EVENT_JAW || events[0].type == CAROM_EVENT_RAIL_TOP;
    ck_assert_msg(met || events[0].type == CAROM_EVENT_SLATE, "flight %d: event %d", n,
                  (int)events[0].type);
    ck_assert_msg(met || first == INFINITY || T - first < 1e-9,
                  "flight %d: the post was missed at %.17g s", n, first);
    if (!met)
      continue;
    const double gap = fabs(gap_of(&f, 20.0, 20.0, radius, events[0].time));
    worst = fmax(worst, gap);
    ck_assert_msg(gap < 1e-12 && events[0].time <= first + 1e-9,
                  "flight %d: gap %g at %.17g s, first %.17g", n, gap, events[0].time, first);
    hits++;
    tops += events[0].type == CAROM_EVENT_RAIL_TOP;
  }
  printf("posts: %d of %d flights meet them, %d on top, gap at most %.1e m\n", hits, flights, tops,
         worst);
  ck_assert_int_gt(hits, flights / 100);
  ck_assert_int_gt(tops, flights / 1000);
}

/* Flights that graze a post by less and less: contact and miss are told apart down to 1e-13 m. The
 * least gap of each is at a time t, where the ball's centre is z above the nose and q outside the
 * edge: the gap sqrt(q^2 + z^2) - R does not change there, so q q' = -z z', and the way to the post
 * is where the ball's velocity has the part q' away from it. */
TEST(grazed_posts) {
  random_source random = {test_seed()};
  carom_table table = empty_table(40.0);
  table.jaws = 1;
  int told = 0;
  for (int n = 0; n < 3000; n++) {
    const double speed = random_between(&random, 0.5, 6.0), v_z = random_between(&random, 0.0, 2.0),
                 low = random_between(&random, 0.0, 0.1),
                 radius = shift() + random_between(&random, 1e-4, 0.2);
    const double T = (v_z + sqrt(v_z * v_z + 2.0 * g * low)) / g,
                 t = T * random_between(&random, 0.0, 1.0);
    const double graze = (n % 2 == 0 ? R : -R) * pow(10.0, random_between(&random, -11.5, -3.0));
    const double z = R + low + t * (v_z - 0.5 * g * t) - h, q2 = (R + graze) * (R + graze) - z * z;
    const double q = sqrt(q2), away = -z * (v_z - g * t) / q;
    if (!(q2 > 0.0) || fabs(away) > speed || t < 1e-6 || t > T - 1e-6)
      continue;
    const double turn = random_between(&random, 0.0, 6.2832),
                 way = turn + (n % 4 < 2 ? 1.0 : -1.0) * acos(away / speed),
                 v[2] = {speed * cos(way), speed * sin(way)};
    const track f = {{20.0 + (radius + q) * cos(turn) - t * v[0],
                      20.0 + (radius + q) * sin(turn) - t * v[1], R + low},
                     {v[0], v[1], v_z}};
    /* it is the least of all its flight, and the flight does not begin in the post */
    const double least = gap_of(&f, 20.0, 20.0, radius, t);
    bool good =
        fabs(least - graze) < 0.1 * fabs(graze) && gap_of(&f, 20.0, 20.0, radius, 0.0) > 1e-5;
    for (int k = 0; k <= 400 && good; k++)
      good = gap_of(&f, 20.0, 20.0, radius, T * k / 400) > least - 1e-15;
    if (!good)
      continue;
    table.jaw[0] = (carom_jaw){.centre = {20.0, 20.0}, .radius = radius - shift(), .height = h};
    const carom_shot_ball ball = flying(f.r[0], f.r[1], f.r[2], f.v[0], f.v[1], f.v[2]);
    const carom_shot_options one = {.events_most = 1};
    carom_shot shot = {.events = events, .room = 1};
    ck_assert_int_eq(carom_shoot(&table, &ball, 1, NULL, &one, &shot), CAROM_ERROR_TOO_MANY_EVENTS);
    const bool met = events[0].type == CAROM_EVENT_JAW || events[0].type == CAROM_EVENT_RAIL_TOP;
    ck_assert_msg(met == (least < 0.0), "flight %d, gap %g: event %d at %g, least gap at %g", n,
                  least, (int)events[0].type, events[0].time, t);
    told++;
  }
  printf("grazed posts: %d told apart\n", told);
  ck_assert_int_gt(told, 500);
}

/* ---- Over the rail */

/* How far in front of the rail, at y = 40, the ball is that jumps_the_rail() strikes. */
static const double before_the_rail = 0.4;

/* A strike at 3 m/s, raised by 45 degrees, which carries the ball over the rail. */
static carom_shot jumps_the_rail(const carom_table *table, const carom_shot_ball *ball) {
  const carom_cue cue = raised_cue(3.0, 45.0, 0.0);
  return play(table, ball, 1, &cue, NULL, CAROM_OK);
}

/* Beyond the rail a ball has left the table, 0.12 m from the nose. */
TEST(over_the_rail) {
  const carom_table table = empty_table(40.0);
  const carom_shot_ball ball = ball_at(20.0, 40.0 - before_the_rail);
  const flight hop = landed(struck(3.0, 45.0, 0.0));
  const carom_shot shot = jumps_the_rail(&table, &ball);

  const double over_the_nose = before_the_rail / hop.along;
  carom_ball_state over;
  expect_ok(carom_shot_at(&ball, 1, &shot, over_the_nose, &over));
  NEAR(over.r[1], 40.0, 1e-9);
  NEAR(over.r[2] - R, (hop.up - 0.5 * g * over_the_nose) * over_the_nose, 1e-9);

  const carom_event *left = event_of(&shot, CAROM_EVENT_LEFT_TABLE, 0);
  NEAR(left->time, (before_the_rail + 0.12) / hop.along, 1e-9);
  ck_assert_int_eq(left->after[0].label, CAROM_BALL_OFF);
  ck_assert_double_eq(left->after[0].v[1], 0.0);
  NEAR(left->after[0].r[1], 40.12, 1e-12);
  ck_assert_int_eq(final[0].label, CAROM_BALL_OFF);
}

static carom_table table_with_wide_rails(void) {
  carom_table table = empty_table(40.0);
  table.rail_width = 0.5;
  return table;
}

/* On the top of a wide rail a ball hops on. */
TEST(top_of_a_rail) {
  const carom_table table = table_with_wide_rails();
  const carom_shot_ball ball = ball_at(20.0, 40.0 - before_the_rail);
  const flight hop = landed(struck(3.0, 45.0, 0.0));
  const carom_shot shot = jumps_the_rail(&table, &ball);
  const carom_event *top = event_of(&shot, CAROM_EVENT_RAIL_TOP, 0);
  NEAR(top->time, (hop.up + sqrt(hop.up * hop.up - 2.0 * g * h)) / g, 1e-9);
  NEAR(top->before[0].r[1], ball.state.r[1] + hop.along * top->time, 1e-9);
  ck_assert_double_eq(top->before[0].r[2], h + R);
  ck_assert_int_eq(top->b, 2);
  ck_assert_double_gt(top->after[0].v[2], 0.0);
}

/* A ball that stops on the top has left the table, at the instant at which it does not hop
 * any more; the others continue. */
TEST(rests_on_a_rail) {
  const carom_table table = table_with_wide_rails();
  const carom_shot_ball balls[2] = {flying(20.0, 40.2, h + R + 0.01, 0.0, 0.0, 0.0),
                                    flying(10.0, 10.0, R, 1.0, 0.0, 0.0)};
  carom_shot shot = play(&table, balls, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(events[shot.count - 2].type, CAROM_EVENT_RAIL_TOP);
  ck_assert_int_eq(events[shot.count - 1].type, CAROM_EVENT_LEFT_TABLE);
  ck_assert_double_eq(events[shot.count - 1].time, events[shot.count - 2].time);
  ck_assert_double_eq(shot.time, events[shot.count - 1].time);
  shot = play(&table, balls, 2, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(final[0].label, CAROM_BALL_OFF);
  ck_assert_int_eq(final[1].label, CAROM_BALL_STATIONARY);
  ck_assert_double_gt(shot.time, 1.0);
}

/* Over the nose, lower than the top by what counts as rounding, and on its way up: a ball falls on
 * the top when its own flight takes it there; with hardly any speed it is on the top at once. */
TEST(a_hair_under_the_top) {
  const carom_table table = table_with_wide_rails();
  const double lower = 4e-10;
  const double rise = 1.5e-3;
  const carom_shot_ball up = flying(20.0, 40.05, h + R - lower, 0.0, 0.1, rise);
  play(&table, &up, 1, NULL, NULL, CAROM_OK);
  const double rounded_lower = h + R - up.state.r[2];
  ck_assert_int_eq(events[0].type, CAROM_EVENT_RAIL_TOP);
  NEAR(events[0].time, (rise + sqrt(rise * rise - 2.0 * g * rounded_lower)) / g, 1e-15);

  const double hardly = 1e-5;
  const carom_shot_ball slow = flying(20.0, 40.05, h + R - lower, 0.0, 0.1, hardly);
  play(&table, &slow, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_RAIL_TOP);
  NEAR(events[0].time, 2.0 * hardly / g, 1e-15);
}

/* ---- Into pockets */

static const double pocket_radius = 0.06;

/* A pocket in the middle of a table, at 2 m. */
static carom_table table_with_a_pocket(void) {
  carom_table table = empty_table(4.0);
  table.pockets = 1;
  table.pocket[0] = (carom_pocket){.centre = {2.0, 2.0}, .radius = pocket_radius, .depth = 0.08};
  return table;
}

/* A ball that flies over the middle of that table at 2 m/s. */
static carom_shot_ball across(double x, double z) {
  return flying(x, 2.0, z, 2.0, 0.0, 0.0);
}

/* A ball that lands inside falls there and then, not on the slate. */
TEST(lands_in_a_pocket) {
  const carom_table table = table_with_a_pocket();
  const double time = sqrt(2.0 * 0.02 / g);
  const carom_shot_ball ball = across(2.0 - 2.0 * time, R + 0.02);
  play(&table, &ball, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_POCKET);
  NEAR(events[0].time, time, 1e-12);
  NEAR(events[0].before[0].r[0], 2.0, 1e-12);
  NEAR(events[0].before[0].r[2], R, 1e-15);
}

/* A ball that comes in at 10 cm leaves above the back of the pocket, and lands beyond it. */
TEST(over_a_pocket) {
  const carom_table table = table_with_a_pocket();
  const carom_shot_ball ball = across(1.9, 0.1);
  play(&table, &ball, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_SLATE);
  ck_assert_double_gt(events[0].before[0].r[0], 2.0 + pocket_radius);
}

/* A ball that leaves the circle 1 mm lower than the nose meets the back of the pocket, and falls.
 * It passes over a back that is lower still. A high back stops a higher ball. */
TEST(back_of_a_pocket) {
  carom_table table = table_with_a_pocket();
  const double time = (0.1 + pocket_radius) / 2.0; /* from x = 1.9 m at 2 m/s */
  const double fallen = 0.5 * g * time * time;
  carom_shot_ball ball = across(1.9, h - 0.001 + fallen);
  play(&table, &ball, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_POCKET);
  NEAR(events[0].time, time, 1e-12);

  table.pocket_back = h - 0.002;
  play(&table, &ball, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_ne(events[0].type, CAROM_EVENT_POCKET);

  table.pocket_back = 0.2;
  ball.state.r[2] += 0.1;
  play(&table, &ball, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_POCKET);
}

/* A ball that rises while it is over the pocket comes down in it. */
TEST(rises_over_a_pocket) {
  const carom_table table = table_with_a_pocket();
  const carom_shot_ball ball = flying(2.0, 2.0, 0.1, 0.05, 0.0, 1.0);
  play(&table, &ball, 1, NULL, NULL, CAROM_OK);
  ck_assert_int_eq(events[0].type, CAROM_EVENT_POCKET);
  NEAR(events[0].before[0].r[2], R, 1e-15);
}

/* Hops of 1 um do not carry a ball over a pocket. */
TEST(tiny_hops_into_a_pocket) {
  const carom_table table = table_with_a_pocket();
  carom_shot_ball ball = flying(1.9, 2.0, R, 1.0, 0.0, sqrt(2.0 * g * 1e-6));
  ball.kind.mu_slide = 1e-6;
  const carom_shot shot = play(&table, &ball, 1, NULL, NULL, CAROM_OK);
  ck_assert_ptr_nonnull(event_of(&shot, CAROM_EVENT_POCKET, 0));
}
