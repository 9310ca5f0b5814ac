/* The cushion against what is known of it: a reference solution in long double, pooltool's
 * recorded impacts, Euler's steps, and the perpendicular rebounds that the 2010 paper fitted. */
#include "kept.h"
#include "random_impacts.h"
#include "support.h"

enum { MOST_ROWS = 600, NUMBERS = 21 };

/* Straight at a cushion with top or back spin both contacts may come to hold, and then the
 * cloth's slip begins again while the nose holds. Whether it does depends on the frictions: all
 * of them have a result. */
TEST(from_both_contacts_at_rest) {
  random_source r = {test_seed()};
  for (int k = 0; k < 20000; k++) {
    const carom_cushion_impact in = {.v = {0.0, 1.0, 0.0},
                                     .w = {random_between(&r, -20.0, 20.0), 0.0, 0.0},
                                     .normal = {0.0, 1.0},
                                     .height = random_between(&r, 0.03, 0.04),
                                     .radius = 0.028575,
                                     .mass = 0.17,
                                     .mu_slide = random_between(&r, 0.15, 0.4),
                                     .mu_cushion = random_between(&r, 0.05, 0.4),
                                     .restitution = 0.8};
    carom_motion out, exact;
    ck_assert_msg(carom_cushion(&in, NULL, &out) == CAROM_OK, "impact %d", k);
    if (k < 20) {
      ck_assert_int_eq(kept_cushion(&in, &exact), REFERENCE_OK);
      ck_assert_double_le(cushion_distance(&in, &out, &exact), 1e-7);
    }
  }
}

/* A ball that meets an infinitely heavy ball meets a wall, touched at the height of its centre. */
TEST(a_heavy_ball_is_a_wall) {
  enum { DRAWS = 15000 };
  int compared = 0, unresolved = 0;
  double worst = 0, worst_call = 0;
  for (uint64_t k = 0; k < DRAWS; k++) {
    carom_impact in = draw_collision(DRAW_REALISTIC, CAROM_SLIP_PAPER, test_seed(), k);
    in.b = (carom_ball){
        .r = {in.b.r[0], in.b.r[1], in.b.r[2]}, .radius = in.b.radius, .mass = 1e14 * in.a.mass};
    carom_cushion_impact wall = {.normal = {in.b.r[0] - in.a.r[0], in.b.r[1] - in.a.r[1]},
                                 .height = in.a.radius,
                                 .radius = in.a.radius,
                                 .mass = in.a.mass,
                                 .mu_slide = in.a.mu_slide,
                                 .mu_cushion = in.mu_ball,
                                 .restitution = in.restitution};
    for (int c = 0; c < 3; c++) {
      wall.v[c] = in.a.v[c];
      wall.w[c] = in.a.w[c];
    }
    carom_result balls;
    carom_motion ball;
    const carom_status status = carom_collide(&in, NULL, &balls),
                       other = carom_cushion(&wall, NULL, &ball);
    ck_assert_msg((status == CAROM_SEPARATING) == (other == CAROM_SEPARATING), "draw %d", (int)k);
    if (status == CAROM_SEPARATING)
      continue;
    compared++;
    unresolved += status != CAROM_OK || other != CAROM_OK;
    if (status == CAROM_OK && other == CAROM_OK)
      worst_call = fmax(worst_call, cushion_distance(&wall, &balls.a, &ball));
    if (collide_precisely(&in, CAROM_SLIP_PAPER, 0.01 * PRECISELY, &balls) == CAROM_OK &&
        cushion_precisely(&wall, 0.01 * PRECISELY, &ball) == CAROM_OK)
      worst = fmax(worst, cushion_distance(&wall, &balls.a, &ball));
  }
  printf("a heavy ball and a wall: %d compared, %d unresolved, precise solver %.2g apart, calls "
         "%.2g\n",
         compared, unresolved, worst, worst_call);
  ck_assert_int_ge(compared, DRAWS / 2);
  ck_assert_int_le(unresolved, compared / 1000);
  ck_assert_double_le(worst, 1e-9);
  ck_assert_double_le(worst_call, 1e-6);
}

/* One recorded impact. */
typedef struct recorded {
  carom_cushion_impact in;
  carom_motion after;
} recorded;

static size_t load(const char *name, recorded rows[MOST_ROWS]) {
  char path[1024], line[2048];
  snprintf(path, sizeof path, "%s/%s", CAROM_TEST_DATA, name);
  FILE *file = fopen(path, "r");
  ck_assert_msg(file != NULL && fgets(line, sizeof line, file) != NULL, "%s cannot be read", path);
  size_t count = 0;
  while (count < MOST_ROWS && fgets(line, sizeof line, file) != NULL) {
    char *at = line;
    while (*at != ',')
      at++;
    double number[NUMBERS];
    for (int k = 0; k < NUMBERS; k++) {
      char *end;
      number[k] = strtod(at + 1, &end);
      ck_assert_msg(end > at + 1, "%s: row %zu", path, count);
      at = end;
    }
    for (int k = 0; k < NUMBERS; k++)
      (k < 15 ? (double *)&rows[count].in + k : (double *)&rows[count].after + (k - 15))[0] =
          number[k];
    count++;
  }
  fclose(file);
  return count;
}

TEST(stronge_as_recorded) {
  static recorded rows[MOST_ROWS];
  const size_t count = load("cushion-stronge.csv", rows);
  const carom_cushion_options options = {.model = CAROM_CUSHION_STRONGE,
                                         .convention = CAROM_CONVENTION_POOLTOOL};
  ck_assert_uint_eq(count, 479);
  for (size_t k = 0; k < count; k++) {
    carom_motion out;
    expect_ok(carom_cushion(&rows[k].in, &options, &out));
    ck_assert_msg(cushion_distance(&rows[k].in, &out, &rows[k].after) <= 1e-9, "row %zu", k);
  }
}

/* A ball that rolls slips on the cloth only by rounding, so pooltool's first step goes where
 * its own rounding points. Two more differ by less than 1e-5: spins that amplify it. */
TEST(euler_as_recorded) {
  static recorded rows[MOST_ROWS];
  const size_t count = load("cushion-mathavan2010.csv", rows);
  const carom_cushion_options options = {
      .model = CAROM_CUSHION_EULER, .convention = CAROM_CONVENTION_POOLTOOL, .least_step = 0.001};
  size_t near = 0, rolling = 0;
  ck_assert_uint_eq(count, 432);
  for (size_t k = 0; k < count; k++) {
    const carom_cushion_impact *in = &rows[k].in;
    carom_motion out;
    expect_ok(carom_cushion(in, &options, &out));
    const double error = cushion_distance(in, &out, &rows[k].after);
    near += error <= 1e-9;
    const bool rolls =
        hypot(in->v[0] - in->radius * in->w[1], in->v[1] + in->radius * in->w[0]) < 1e-9;
    rolling += rolls;
    ck_assert_msg(error <= (rolls ? 1e-2 : 1e-5), "row %zu: %.3g", k, error);
  }
  ck_assert_uint_ge(near + rolling, count - 2);
  ck_assert_uint_ge(near, 390);
}

/* Not where friction may lift the ball, sin < mu cos: there steps that chatter about stick load
 * the cloth alternately, on the mean more than sticking does. */
TEST(euler_converges_at_first_order) {
  double mean[3] = {0};
  for (uint64_t k = 0; k < 100; k++) {
    carom_cushion_impact in = draw_cushion(CUSHION_PLAY, 1, k);
    carom_motion exact, out;
    in.mu_cushion = fmin(in.mu_cushion, in.height / in.radius - 1);
    expect_ok(carom_cushion(&in, NULL, &exact));
    for (int j = 0; j < 3; j++) {
      const carom_cushion_options options = {.model = CAROM_CUSHION_EULER, .steps = 1000 << 2 * j};
      expect_ok(carom_cushion(&in, &options, &out));
      mean[j] += cushion_distance(&in, &out, &exact) / 100;
    }
  }
  ck_assert_double_lt(mean[0], 3e-3);
  for (int j = 0; j < 2; j++)
    ck_assert_msg(mean[j] / mean[j + 1] > 3 && mean[j] / mean[j + 1] < 5, "%g, then %g", mean[j],
                  mean[j + 1]);
}

/* Figure 7 of the 2010 paper: rolling balls straight into the cushion, as measured up to the
 * speed for which a rigid cushion is said to hold. The restitution and friction are those that
 * the paper fitted. */
TEST(measured_rebounds) {
  for (double speed = 0.3; speed <= 2.5; speed += 0.1) {
    const double R = 0.02625;
    const carom_cushion_impact in = {.v = {0, speed, 0},
                                     .w = {-speed / R, 0, 0},
                                     .normal = {0, 1},
                                     .height = 1.4 * R,
                                     .radius = R,
                                     .mass = 0.1406,
                                     .mu_slide = 0.212,
                                     .mu_cushion = 0.14,
                                     .restitution = 0.98};
    carom_motion out;
    expect_ok(carom_cushion(&in, NULL, &out));
    const double measured = (-0.0877 * speed + 1.131) * speed - 0.0953;
    ck_assert_msg(fabs(-out.v[1] - measured) < 0.08, "%g m/s: %g, measured %g", speed, -out.v[1],
                  measured);
  }
}
