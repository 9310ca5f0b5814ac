/* Results are smooth to rounding errors: collisions, and the shots that are on them. So
 * differences by any step agree with derivatives.
 *
 * A collision may be solved by another kind or number of steps on the two sides of a position,
 * where the result jumps by an error of the solver (carom.h). Such places are rare, so a line of a
 * millionth of the speed meets one in a few of 100,000 lines; the tests leave out none. */
#include "paths.h"

/* ---- Collisions along a line of inputs ---- */

enum { POINTS = 64, LINES = 200, SPINS = 3 };

/* A pool ball at 0.5 to 5 m/s that meets another at rest: with any spin, rolling or sliding. */
static carom_impact play_of(random_source *random, int spin) {
  const carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  const carom_ball ball = {.r = {0, 0, kind.radius},
                           .radius = kind.radius,
                           .mass = kind.mass,
                           .mu_slide = kind.mu_slide};
  carom_impact in = {.a = ball, .b = ball, .mu_ball = 0.06, .restitution = 0.95};
  const double angle = random_between(random, 0.0, 6.28), cut = random_between(random, -1.2, 1.2),
               speed = random_between(random, 0.5, 5.0);
  in.b.r[0] = 2.0 * kind.radius * cos(angle);
  in.b.r[1] = 2.0 * kind.radius * sin(angle);
  in.a.v[0] = speed * cos(angle + cut);
  in.a.v[1] = speed * sin(angle + cut);
  for (int k = 0; k < 3 && spin == 0; k++)
    in.a.w[k] = random_between(random, -1.0, 1.0) * speed / kind.radius;
  if (spin == 1) {
    in.a.w[0] = -in.a.v[1] / kind.radius;
    in.a.w[1] = in.a.v[0] / kind.radius;
  }
  return in;
}

/* The largest second difference of any number of the result, spins times the radius, in m/s, along
 * a line of `step` m/s of the velocity of ball a. */
static double roughness(const carom_impact *in, double step, const carom_options *options) {
  double at[POINTS + 1][12], most = 0.0;
  for (int k = 0; k <= POINTS; k++) {
    carom_impact moved = *in;
    carom_result out;
    moved.a.v[0] += step * (k - POINTS / 2);
    expect_ok(carom_collide(&moved, options, &out));
    memcpy(at[k], &out, sizeof out);
  }
  for (int k = 1; k < POINTS; k++)
    for (int c = 0; c < 12; c++) {
      const double unit = c / 3 % 2 == 0 ? 1.0 : in->a.radius;
      most = fmax(most, unit * fabs(at[k + 1][c] - 2.0 * at[k][c] + at[k - 1][c]));
    }
  return most;
}

TEST(collisions_have_no_steps) {
  random_source random = {test_seed()};
  const carom_options exact = {0}, fast = {.solver = CAROM_SOLVER_FAST};
  double rough[SPINS] = {0}, rough_fast[SPINS] = {0};
  for (int spin = 0; spin < SPINS; spin++)
    for (int line = 0; line < LINES; line++) {
      const carom_impact in = play_of(&random, spin);
      rough[spin] = fmax(rough[spin], roughness(&in, 1e-9, &exact));
      rough_fast[spin] = fmax(rough_fast[spin], roughness(&in, 1e-9, &fast));
    }
  ck_assert_double_gt(rough_fast[0], 1e-10); /* as carom.h says of it */
  for (int spin = 0; spin < SPINS; spin++) {
    printf("spin %d: second differences up to %.1e m/s, with the solver fast %.1e\n", spin,
           rough[spin], rough_fast[spin]);
    ck_assert_double_lt(rough[spin], 2e-14);
  }
}

/* The two solvers differ by no more than single precision inside explains. */
TEST(fast_is_the_same_law) {
  random_source random = {test_seed()};
  double most = 0.0;
  for (int k = 0; k < 20000; k++) {
    const carom_impact in = random_impact(&random);
    carom_result exact, fast;
    expect_ok(carom_collide(&in, NULL, &exact));
    expect_ok(carom_collide(&in, &(carom_options){.solver = CAROM_SOLVER_FAST}, &fast));
    most = fmax(most, result_distance(&fast, &exact, in.a.radius));
  }
  printf("fast and exact differ by up to %.1e of the fastest speed\n", most);
  ck_assert_double_gt(most, 0.0);
  ck_assert_double_lt(most, 1e-6);
}

/* ---- Differences of a shot with one contact, compared with its tangents ---- */

static const double steps[] = {1e-7, 1e-6, 1e-5, 1e-4};
enum { STEPS = COUNT_OF(steps), SHOTS = 200 };

static const double DEGREE = 3.14159265358979323846 / 180.0;

/* Two balls apart by a gap; the cue ball is aimed at a cut of up to 55 degrees. */
static layout one_contact(random_source *random, double gap) {
  layout l = {.count = 2, .cue = carom_cue_of(CAROM_GAME_POOL)};
  const double angle = random_between(random, 60.0, 120.0) * DEGREE,
               cut = random_between(random, -55.0, 55.0) * DEGREE;
  l.ball[0] = ball_at(0.635, 0.6);
  const double R = l.ball[0].kind.radius, d = 2.0 * R + gap;
  l.ball[1] = ball_at(0.635 + d * cos(angle), 0.6 + d * sin(angle));
  l.cue.speed = random_between(random, 0.8, 4.0);
  l.cue.phi = (angle + asin(2.0 * R * sin(cut) / d)) / DEGREE;
  l.cue.a = random_between(random, -0.3, 0.3);
  l.cue.b = random_between(random, -0.3, 0.3);
  l.cue.follow = 0.0;
  return l;
}

/* Stops the shot just after its contact; false where there is none. */
static bool stop_behind_contact(layout *l) {
  l->options.stop_at = CAROM_STOP_AT_CONTACT;
  carom_shot s = {.events = events, .room = ROOM, .final = final};
  if (shoot(l, &s) != CAROM_STOPPED_AT_EVENT)
    return false;
  l->options.stop_at = 0;
  l->options.time_most = s.time + 0.01;
  shot = empty_shot();
  return shoot(l, &shot) == CAROM_STOPPED_AT_TIME;
}

TEST(differences_by_any_step) {
  static const direction by_phi = {OF_CUE, 0, 1, 57};
  static const double gaps[] = {0.003, 0.05, 0.8};
  random_source random = {test_seed()};
  for (int g = 0; g < 3; g++) {
    static double errors[STEPS][SHOTS];
    size_t n = 0;
    while (n < SHOTS) {
      layout l = one_contact(&random, gaps[g]);
      int64_t flags;
      if (!stop_behind_contact(&l) || tangent_of(&l, &by_phi, 1, &flags) != CAROM_OK)
        continue;
      double before[2 * NUMBERS];
      for (int i = 0; i < 2; i++)
        numbers_of(&final[i], before + i * NUMBERS);
      const double size = largest(ends, 2 * NUMBERS, 0, 1);
      for (int k = 0; k < STEPS; k++) {
        const double step = l.cue.phi + steps[k] - l.cue.phi;
        carom_shot s;
        ck_assert_int_eq(shoot_changed(&l, &by_phi, steps[k], &s), CAROM_STOPPED_AT_TIME);
        double after[2 * NUMBERS], off = 0.0;
        for (int i = 0; i < 2; i++)
          numbers_of(&s.final[i], after + i * NUMBERS);
        for (int x = 0; x < 2 * NUMBERS; x++)
          off = fmax(off, fabs((after[x] - before[x]) / step - ends[x]));
        errors[k][n] = off / size;
      }
      n++;
    }
    for (int k = 0; k < STEPS; k++) {
      qsort(errors[k], SHOTS, sizeof(double), by_size);
      const double median = errors[k][SHOTS / 2], of_ten = errors[k][SHOTS * 9 / 10];
      printf(
          "gap %g m, step %g degrees: error of a difference %.1e in the median, %.1e in 1 of 10\n",
          gaps[g], steps[k], median, of_ten);
      /* rounding errors over the step, the curvature times the step, and the solver's error */
      ck_assert_double_lt(median, 1e-13 / steps[k] + steps[k] + 1e-6);
      ck_assert_double_lt(of_ten, 3e-13 / steps[k] + 2.0 * steps[k] + 3e-6);
    }
  }
}

/* ---- Shots with rails along a line of inputs ---- */

/* Solves for a + b x + c x^2 through points at x from -1 to 1, and returns the largest residual. */
static double off_parabola(const double *y, int count) {
  double sum[5] = {0}, with[3] = {0};
  for (int k = 0; k < count; k++) {
    const double x = 2.0 * k / (count - 1) - 1.0, from = y[k] - y[0];
    for (int p = 0; p < 5; p++)
      sum[p] += pow(x, p);
    for (int p = 0; p < 3; p++)
      with[p] += from * pow(x, p);
  }
  /* odd sums vanish, as the points lie evenly */
  const double b = with[1] / sum[2], divisor = sum[0] * sum[4] - sum[2] * sum[2],
               a = (with[0] * sum[4] - with[2] * sum[2]) / divisor,
               c = (with[2] * sum[0] - with[0] * sum[2]) / divisor;
  double most = 0.0;
  for (int k = 0; k < count; k++) {
    const double x = 2.0 * k / (count - 1) - 1.0;
    most = fmax(most, fabs(y[k] - y[0] - (a + x * (b + x * c))));
  }
  return most;
}

TEST(final_places_lie_on_a_parabola) {
  enum { MOVES = 201, PLACES = 6 };
  static const carom_shot_cushion cushions[] = {
      CAROM_SHOT_CUSHION_HAN, CAROM_SHOT_CUSHION_SMOOTH, CAROM_SHOT_CUSHION_MATHAVAN,
      CAROM_SHOT_CUSHION_STRONGE, CAROM_SHOT_CUSHION_MIRROR};
  direction by[4];
  read_directions("cue.speed 2 cue.phi 57 cue.a 1 cue.b 1", by);
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  layout l = {.count = 3, .cue = carom_cue_of(CAROM_GAME_POOL), .table = &table};
  l.ball[0] = ball_at(0.4, 0.5);
  l.ball[1] = ball_at(0.6, 1.5);
  l.ball[2] = ball_at(0.9, 1.9);
  set_numbers(&l, "cue.speed 1.6 cue.phi 79 cue.a 0.1 cue.b -0.1");
  for (size_t m = 0; m < COUNT_OF(cushions); m++)
    for (int d = 0; d < 4; d++) {
      static double place[PLACES][MOVES];
      l.options.cushion_model = cushions[m];
      for (int k = 0; k < MOVES; k++) {
        layout moved = l;
        carom_shot s = {.final = final};
        change(&moved, &by[d], 1e-7 * (2.0 * k / (MOVES - 1) - 1.0));
        expect_ok(shoot(&moved, &s));
        for (int x = 0; x < PLACES; x++)
          place[x][k] = final[x / 2].r[x % 2];
      }
      double most = 0.0;
      for (int x = 0; x < PLACES; x++)
        most = fmax(most, off_parabola(place[x], MOVES));
      printf("cushion model %d, number %d of the cue: %.1e m off a parabola\n", (int)cushions[m],
             by[d].row, most);
      ck_assert_double_lt(most, 1e-12);
    }
}
