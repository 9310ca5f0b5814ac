/* Balls that fly, and the table: noses from any height, and jaws. A nose is at h = 36.576 mm;
 * known_shots.txt has shots with known numbers. */
#include "shot_support.h"

static const double R = 0.028575, g = 9.81, h = 0.036576;

/* The true nose is a line this far inside the wall that stands for it. */
static double shift(void) {
  return R - sqrt(h * (2.0 * R - h));
}

/* ---- Noses */

/* Restitution changes by the closing speed over cos(theta) of a ball on the cloth, from whatever
 * height the nose is met, and for every model. */
TEST(restitution_by_closing_speed) {
  const carom_table table = empty_table(40.0);
  const double sine = h / R - 1.0, cosine = sqrt(1.0 - sine * sine);
  for (int model = 0; carom_cushion_model_name((carom_cushion_model)model) != NULL; model++)
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

/* Near the cloth the result goes over to that of a ball that lies on it, to the last bit at z =
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
  random_source random = {test_seed()};
  carom_table table = empty_table(40.0);
  int hits = 0, tops = 0;
  double worst = 0.0;
  for (int n = 0; n < FLIGHTS; n++) {
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
  printf("posts: %d of %d flights meet them, %d on top, gap at most %.1e m\n", hits, FLIGHTS, tops,
         worst);
  ck_assert_int_gt(hits, 1000);
  ck_assert_int_gt(tops, 100);
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
