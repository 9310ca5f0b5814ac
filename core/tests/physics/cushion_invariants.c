/* Invariants of the impact on a cushion: energy, mirror, closed forms, batches, traces. */
#include "carom_tangent.h"
#include "cushion/models.h"
#include "random_impacts.h"
#include "support.h"

enum { DRAWN = 2000 };
enum { MODELS = CAROM_CUSHION_MODEL_COUNT };

/* Twice the kinetic energy, over the mass. */
static double energy(const double v[3], const double w[3], double R) {
  double sum = 0;
  for (int c = 0; c < 3; c++)
    sum += v[c] * v[c] + 0.4 * R * R * w[c] * w[c];
  return sum;
}

TEST(energy_never_rises) {
  int unresolved = 0;
  for (uint64_t k = 0; k < DRAWN; k++)
    for (int m = 0; m < MODELS; m++) {
      const carom_cushion_impact in = draw_cushion(CUSHION_ANY, test_seed(), k);
      const carom_cushion_options options = {.model = (carom_cushion_model)m, .steps = 200};
      carom_motion out;
      const carom_status status = carom_cushion(&in, &options, &out);
      /* a wedged ball is never done */
      if (m == (int)CAROM_CUSHION_EULER && status == CAROM_ERROR_TOO_SLOW)
        continue;
      if (m == (int)CAROM_CUSHION_MATHAVAN && status == CAROM_ERROR_UNRESOLVED) {
        unresolved++; /* one of 10,000 */
        continue;
      }
      expect_ok(status);
      const double before = energy(in.v, in.w, in.radius), after = energy(out.v, out.w, in.radius);
      const double slack = m == (int)CAROM_CUSHION_EULER ? 1e-2 : 1e-9;
      ck_assert_msg(after <= before * (1 + slack), "model %d, impact %d: %.17g becomes %.17g", m,
                    (int)k, before, after);
    }
  ck_assert_int_le(unresolved, 4);
}

/* The other way along the cushion: v_x, w_y and w_z change sign, and the result does likewise,
 * to the last bit. */
TEST(mirror_symmetry) {
  for (uint64_t k = 0; k < DRAWN; k++)
    for (int m = 0; m < MODELS; m++) {
      carom_cushion_impact in = draw_cushion(CUSHION_ANY, test_seed(), k);
      const carom_cushion_options options = {.model = (carom_cushion_model)m, .steps = 100};
      carom_motion out, other;
      in.normal[0] = 0;
      in.normal[1] = 1;
      in.v[1] = fabs(in.v[1]);
      const carom_status status = carom_cushion(&in, &options, &out);
      in.v[0] *= -1;
      in.w[1] *= -1;
      in.w[2] *= -1;
      ck_assert_int_eq(carom_cushion(&in, &options, &other), status);
      if (status < 0)
        continue;
      other.v[0] *= -1;
      other.w[1] *= -1;
      other.w[2] *= -1;
      for (int c = 0; c < 6; c++) /* as numbers, since 0 and -0 are one here */
        ck_assert_msg(((double *)&out)[c] == ((double *)&other)[c],
                      "model %d, impact %d, number %d", m, (int)k, c);
    }
}

static carom_cushion_impact usual(void) {
  const double R = 0.02625;
  return (carom_cushion_impact){.v = {0.7, 1.3, 0},
                                .w = {-20, 15, 30},
                                .normal = {0, 1},
                                .height = 1.4 * R,
                                .radius = R,
                                .mass = 0.1406,
                                .mu_slide = 0.212,
                                .mu_cushion = 0.14,
                                .restitution = 0.98};
}

/* Without friction only the speed into the nose changes. On the cloth nothing lifts the ball: v_y
 * rebounds as -e v_y. Han's law leaves it v_y (1 - (1 + e) cos^2), with the nose at an angle. */
TEST(closed_forms) {
  const carom_cushion_options han = {.model = CAROM_CUSHION_HAN};
  const carom_cushion_options mirror = {.model = CAROM_CUSHION_MIRROR};
  for (int k = 0; k <= 10; k++) {
    carom_cushion_impact in = usual();
    in.mu_slide = 0;
    in.mu_cushion = 0;
    in.restitution = k / 10.0;
    const double rebound = -in.restitution * in.v[1];
    const double sine = in.height / in.radius - 1;
    const double cosine_2 = 1 - sine * sine;
    carom_motion out;
    expect_ok(carom_cushion(&in, NULL, &out));
    ck_assert_double_eq_tol(out.v[1], rebound, 1e-12);
    ck_assert_double_eq_tol(out.v[0], in.v[0], 1e-14);
    NEAR_EACH(out.w, in.w, 3, 1e-12);
    expect_ok(carom_cushion(&in, &han, &out));
    ck_assert_double_eq_tol(out.v[1], in.v[1] * (1 - (1 + in.restitution) * cosine_2), 1e-14);
    expect_ok(carom_cushion(&in, &mirror, &out));
    ck_assert_double_eq(out.v[1], rebound);
    ck_assert_double_eq(out.v[0], in.v[0]);
  }
}

/* With e = 0 and the usual friction a ball stays at the cushion. */
TEST(no_rebound) {
  carom_cushion_impact in = usual();
  carom_motion out;
  in.restitution = 0;
  expect_ok(carom_cushion(&in, NULL, &out));
  ck_assert_double_eq_tol(out.v[1], 0, 1e-12);
}

/* Han's fits: what they say for one ball, by hand. */
TEST(han_law) {
  carom_cushion_impact in = usual();
  in.v[0] = 1.3;
  const carom_cushion_options fitted = {.law = CAROM_CUSHION_LAW_HAN}, given = {0};
  carom_motion a, b;
  expect_ok(carom_cushion(&in, &fitted, &a));
  in.restitution = 0.39 + 0.257 * 1.3 - 0.044 * 1.3 * 1.3;
  in.mu_cushion = 0.471 - 0.241 * 0.78539816339744831;
  expect_ok(carom_cushion(&in, &given, &b));
  ck_assert_msg(cushion_distance(&in, &a, &b) < 1e-12, "%g", cushion_distance(&in, &a, &b));
}

/* ---- The smooth law */

static const carom_cushion_options nearly_han = {
    .model = CAROM_CUSHION_SMOOTH, .smooth_q = 1e-11, .smooth_x = 1, .smooth_t = 1};

/* Without its five constants it is Han's. */
TEST(smooth_has_the_limit_of_han) {
  const carom_cushion_options han = {.model = CAROM_CUSHION_HAN};
  for (uint64_t k = 0; k < DRAWN; k++) {
    const carom_cushion_impact in =
        draw_cushion(k % 2 == 0 ? CUSHION_ANY : CUSHION_PLAY, test_seed(), k);
    carom_motion a, b;
    expect_ok(carom_cushion(&in, &nearly_han, &a));
    expect_ok(carom_cushion(&in, &han, &b));
    ck_assert_msg(cushion_distance(&in, &a, &b) < 1e-9, "impact %d: %g", (int)k,
                  cushion_distance(&in, &a, &b));
  }
}

/* A million draws before a release, by all constants that are accepted, most of them at an end of
 * their range: energy does not rise, and the impulse is one that acts at the nose, so the angular
 * momentum about it stays. */
TEST(smooth_keeps_the_laws) {
  random_source r = {test_seed()};
  const uint64_t draws = (uint64_t)draws_of_test(100 * DRAWN, 500 * DRAWN);
  for (uint64_t k = 0; k < draws; k++) {
    carom_cushion_impact in = draw_cushion(k % 2 == 0 ? CUSHION_ANY : CUSHION_PLAY, test_seed(), k);
    double c[11];
    for (int j = 0; j < 11; j++)
      c[j] = fmin(fmax(random_between(&r, -0.5, 1.5), 1e-6), 1);
    in.normal[0] = 0;
    in.normal[1] = 1;
    in.v[1] = fabs(in.v[1]);
    in.restitution = k % 3 == 0 ? 1 : in.restitution;
    const carom_cushion_options options = {.model = CAROM_CUSHION_SMOOTH,
                                           .smooth_q = 0.5 * c[0],
                                           .smooth_x = 2 * c[1],
                                           .smooth_t = 2 * c[2],
                                           .smooth_a = c[3],
                                           .smooth_k = k % 2 == 0 ? c[4] : 0,
                                           .smooth_g = 2 * c[7] - 1,
                                           .smooth_g_log = 2 * c[8] - 1,
                                           .smooth_e = 2 * c[9] - 1,
                                           .restitution_log2 = 2 * c[10] - 1,
                                           .restitution_log = 2 * c[5] - 1,
                                           .mu_log = 2 * c[6] - 1};
    carom_motion out;
    expect_ok(carom_cushion(&in, &options, &out));
    const double R = in.radius, before = energy(in.v, in.w, R), after = energy(out.v, out.w, R);
    ck_assert_msg(after <= before * (1 + 1e-12), "impact %d: %.17g becomes %.17g", (int)k, before,
                  after);
    const double sine = in.height / R - 1, cosine = sqrt((1 - sine) * (1 + sine)),
                 slack = 1e-12 * sqrt(before);
    const double f_x = out.v[0] - in.v[0], W_y = R * (out.w[1] - in.w[1]),
                 W_z = R * (out.w[2] - in.w[2]);
    ck_assert_double_eq_tol(W_y, 2.5 * sine * f_x, slack);
    ck_assert_double_eq_tol(W_z, -2.5 * cosine * f_x, slack);
  }
}

/* What the measured constants say: the fraction of its speed across the cushion that a rolling ball
 * without side spin keeps, by the sine of the angle and that speed. */
TEST(smooth_rebounds_as_measured) {
  enum { SPEEDS = 4, SINES = 6 };
  static const double speeds[SPEEDS] = {0.3, 1, 2, 4};
  static const double sines[SINES] = {0, 0.3, 0.6, 0.8, 0.9, 0.95};
  static const double share[SPEEDS][SINES] = {{0.873, 0.875, 0.886, 0.908, 0.939, 0.972},
                                              {0.861, 0.862, 0.864, 0.870, 0.879, 0.890},
                                              {0.853, 0.852, 0.849, 0.844, 0.841, 0.840},
                                              {0.844, 0.842, 0.832, 0.817, 0.801, 0.788}};
  const double R = 0.03075;
  const carom_cushion_options options = {.model = CAROM_CUSHION_SMOOTH, .mu_log = -0.010};
  for (int i = 0; i < SPEEDS; i++)
    for (int j = 0; j < SINES; j++) {
      const double v_y = speeds[i];
      const double v_x = v_y * sines[j] / sqrt(1 - sines[j] * sines[j]);
      const carom_cushion_impact in = {.v = {v_x, v_y},
                                       .w = {-v_y / R, v_x / R},
                                       .normal = {0, 1},
                                       .height = 0.0364,
                                       .radius = R,
                                       .mass = 0.21,
                                       .mu_slide = 0.196,
                                       .mu_cushion = 0.255,
                                       .restitution = 0.799};
      carom_motion out;
      expect_ok(carom_cushion(&in, &options, &out));
      ck_assert_msg(fabs(-out.v[1] / v_y - share[i][j]) < 1.5e-3, "%g m/s, sine %g: %.4f", v_y,
                    sines[j], -out.v[1] / v_y);
    }
}

/* How far the derivatives of two impacts by the side spin are apart, over the first. */
static double slope_change(const carom_cushion_options *options, double w_z, double step) {
  double slope[2][6], most = 0, size = 0;
  for (int k = 0; k < 2; k++) {
    carom_cushion_impact in = usual();
    const double seeds[15] = {[5] = 1};
    in.w[2] = w_z + k * step;
    expect_ok(carom_cushion_tangent(&in, options, 1, seeds, slope[k], NULL));
  }
  for (int c = 0; c < 6; c++) {
    most = fmax(most, fabs(slope[1][c] - slope[0][c]));
    size = fmax(size, fabs(slope[0][c]));
  }
  return most / size;
}

/* Where Han's derivative by the side spin jumps, that of the smooth law continues. */
TEST(smooth_has_no_corner) {
  const carom_cushion_options han = {.model = CAROM_CUSHION_HAN},
                              smooth = {.model = CAROM_CUSHION_SMOOTH};
  double han_most = 0, smooth_most = 0;
  for (double w_z = -100; w_z < 150; w_z += 0.01) {
    han_most = fmax(han_most, slope_change(&han, w_z, 0.01));
    smooth_most = fmax(smooth_most, slope_change(&smooth, w_z, 0.01));
  }
  ck_assert_double_gt(han_most, 0.1);
  ck_assert_double_lt(smooth_most, 2e-3);
}

TEST(separating_is_unchanged) {
  for (int m = 0; m < MODELS; m++) {
    carom_cushion_impact in = usual();
    const carom_cushion_options options = {.model = (carom_cushion_model)m};
    for (double v = 0; v >= -1; v -= 0.5) {
      carom_motion out;
      in.v[1] = v;
      ck_assert_int_eq(carom_cushion(&in, &options, &out), CAROM_SEPARATING);
      ck_assert_mem_eq(out.v, in.v, sizeof out.v);
      ck_assert_mem_eq(out.w, in.w, sizeof out.w);
      /* the derivatives too: a direction for each of the 15 numbers */
      double seeds[15][15] = {{0}}, tangent[6][15];
      for (int k = 0; k < 15; k++)
        seeds[k][k] = k + 1;
      ck_assert_int_eq(carom_cushion_tangent(&in, &options, 15, seeds[0], tangent[0], NULL),
                       CAROM_SEPARATING);
      ck_assert_mem_eq(tangent, seeds, sizeof tangent);
    }
  }
}

/* The slip after an impact on a nose of two springs, over the approach, by small steps in time:
 * the force of the spring along the nose is at most mu times that of the spring across it. */
static double slip_by_steps(double rho, double mu, double e, double ratio) {
  const int steps = 20000;
  const double half = acos(0.0), per = half * (1 + e) / steps, softness = 3.5 / (ratio * ratio);
  double slip = rho, x = 0;
  int way = rho > mu * softness; /* 0: sticks */
  for (int k = 0; k < steps; k++) {
    const double tau = (k + 0.5) * per, phase = tau <= half ? tau : half + (tau - half) / e;
    const double most = softness * mu * sin(phase),
                 rate = softness * mu * cos(phase) / (tau <= half ? 1 : e);
    if (way != 0 && way * (slip - way * rate) <= 0)
      way = 0;
    if (way == 0) {
      x += slip * per;
      way = (x > most) - (x < -most);
    }
    if (way != 0)
      x = way * most;
    slip -= 3.5 * x / softness * per;
  }
  return slip;
}

TEST(stronge_is_two_springs) {
  for (int k = 0; k < 400; k++) {
    const double mu = (const double[]){0.1, 0.3, 0.8, 1}[k % 4],
                 e = (const double[]){0.5, 0.7, 0.85, 1, 0.95}[k / 4 % 5],
                 ratio = (const double[]){1.7, 1.8, 1.9, 2}[k / 20 % 4],
                 rho = mu * (const double[]){0.3, 1, 1.5, 3, 6}[k / 80];
    const carom_contact contact = {.mu_w = mu, .e = e};
    const carom_cushion_options options = {.omega_ratio = ratio};
    const double slip = rho - 3.5 * carom_stronge_friction(&contact, 1, rho, &options),
                 stepped = slip_by_steps(rho, mu, e, ratio);
    ck_assert_msg(fabs(slip - stepped) < 2e-3 * rho, "mu %g, e %g, ratio %g, rho %g: %g, not %g",
                  mu, e, ratio, rho, slip, stepped);
  }
}

TEST(batches_are_single_calls) {
  static carom_cushion_impact in[1000];
  static carom_motion out[1000], alone[1000];
  static int8_t status[1000], expected[1000];
  for (int m = 0; m < MODELS; m++) {
    for (uint64_t k = 0; k < 1000; k++) {
      in[k] = draw_cushion(CUSHION_ANY, test_seed(), k);
      if (k % 7 == 3)
        ((double *)&in[k])[k % 15] = k % 2 == 0 ? NAN : -INFINITY;
      if (k % 7 == 5)
        in[k].v[0] = -in[k].v[0], in[k].v[1] = -in[k].v[1];
      const carom_cushion_options one = {.model = (carom_cushion_model)m, .steps = 50};
      expected[k] = (int8_t)carom_cushion(&in[k], &one, &alone[k]);
    }
    static const int threads[] = {0, 1, 3, 7, CAROM_ALL_THREADS};
    for (int t = 0; t < 5; t++) {
      const carom_cushion_options options = {
          .model = (carom_cushion_model)m, .steps = 50, .threads = threads[t]};
      memset(out, 0, sizeof out);
      const carom_status first = carom_cushion_batch(in, 1000, &options, out, status);
      ck_assert_int_lt(first, 0);
      ck_assert_mem_eq(out, alone, sizeof out);
      ck_assert_mem_eq(status, expected, sizeof status);
      /* without statuses the first error is returned, of rows 0 to 2 seldom one */
      int8_t error = 0;
      for (int row = 2; row >= 0; row--)
        if (expected[row] < 0)
          error = expected[row];
      ck_assert_int_eq(carom_cushion_batch(in, 3, &options, out, NULL), error);
    }
  }
}

TEST(traces_end_where_calls_do) {
  enum { POINTS = 101 };
  static const carom_cushion_model traced[] = {CAROM_CUSHION_MATHAVAN, CAROM_CUSHION_EULER};
  for (uint64_t k = 0; k < 100; k++)
    for (int m = 0; m < 2; m++) {
      const carom_cushion_impact in = draw_cushion(CUSHION_PLAY, test_seed(), k);
      /* restitution and friction that change with the speed, too */
      const double logs = k % 2 == 0 ? 0.0 : 0.05;
      const carom_cushion_options options = {
          .model = traced[m], .restitution_log = -logs, .mu_log = -logs};
      carom_cushion_point point[POINTS];
      carom_motion out;
      expect_ok(carom_cushion(&in, &options, &out));
      expect_ok(carom_cushion_trace(&in, &options, POINTS, point));
      ck_assert_msg(cushion_distance(&in, &point[POINTS - 1].state, &out) < 1e-6, "impact %d",
                    (int)k);
      double work_c = 0;
      for (int j = 1; j < POINTS; j++) {
        ck_assert_double_gt(point[j].normal, point[j - 1].normal);
        ck_assert_double_ge(point[j].work, point[j - 1].work - 1e-12);
        ck_assert_int_ge(point[j].phase, point[j - 1].phase);
        if (m == 0)
          ck_assert_msg((point[j].phase == CAROM_PHASE_RESTITUTION) == (point[j].v_n <= 1e-9),
                        "impact %d, point %d", (int)k, j);
        work_c = point[j].phase == CAROM_PHASE_COMPRESSION ? point[j].work : work_c;
      }
      const double all = point[POINTS - 1].work / (1 + in.restitution * in.restitution);
      ck_assert_msg(logs != 0.0 || (work_c <= all * 1.02 && work_c >= 0.95 * all),
                    "impact %d: %g of %g", (int)k, work_c, all);
    }
}

/* Along the cushion's axes, which are the table's here: the state, and the slips that it has by
 * its geometry. */
static void expect_point(const carom_cushion_impact *in, const carom_cushion_point *p) {
  const double R = in->radius, sine = in->height / R - 1, cosine = sqrt(1 - sine * sine),
               *v = p->state.v, *w = p->state.w;
  const double s_x = v[0] + R * (w[1] * sine - w[2] * cosine), s_t = R * w[0] - v[1] * sine;
  const double c_x = v[0] - R * w[1], c_y = v[1] + R * w[0];
  ck_assert_double_eq_tol(p->v_n, v[1] * cosine, 1e-9);
  ck_assert_double_eq_tol(p->s_x, s_x, 1e-8);
  ck_assert_double_eq_tol(p->s_t, s_t, 1e-8);
  ck_assert_double_eq_tol(p->c_x, c_x, 1e-8);
  ck_assert_double_eq_tol(p->c_y, c_y, 1e-8);
  /* what sticks does not slip: not by rounding either */
  ck_assert(!p->nose_sticks || (p->s_x == 0.0 && p->s_t == 0.0));
  ck_assert(!p->cloth_sticks || (p->c_x == 0.0 && p->c_y == 0.0));
}

/* The first point is the motion before, and every point is told alike in its state and its
 * slips. */
TEST(traces_tell_every_point) {
  enum { POINTS = 41 };
  static const carom_cushion_model traced[] = {CAROM_CUSHION_MATHAVAN, CAROM_CUSHION_EULER};
  int nose = 0, cloth = 0;
  for (int k = 0; k < 36; k++)
    for (int m = 0; m < 2; m++) {
      carom_cushion_impact in = usual();
      in.mu_cushion = (const double[]){0.14, 0.5, 0.9}[k % 3];
      in.mu_slide = k / 3 % 2 == 0 ? 0.2 : 1.0;
      in.w[2] = (const double[]){-40, 0, 40}[k / 6 % 3];
      if (k >= 18) { /* rolls, slowly along the cushion */
        in.v[0] = 0.1;
        in.w[0] = -in.v[1] / in.radius;
        in.w[1] = in.v[0] / in.radius;
      }
      const carom_cushion_options options = {.model = traced[m]};
      carom_cushion_point point[POINTS];
      const carom_status status = carom_cushion_trace(&in, &options, POINTS, point);
      /* a wedged ball is never done by Euler's method */
      if (m == 1 && status == CAROM_ERROR_TOO_SLOW)
        continue;
      expect_ok(status);
      ck_assert(point[0].normal == 0.0 && point[0].work == 0.0);
      ck_assert_int_eq(point[0].phase, CAROM_PHASE_COMPRESSION);
      for (int c = 0; c < 3; c++) {
        ck_assert_double_eq_tol(point[0].state.v[c], in.v[c], 1e-14);
        ck_assert_double_eq_tol(point[0].state.w[c], in.w[c], 1e-12);
      }
      for (int j = 0; j < POINTS; j++) {
        expect_point(&in, &point[j]);
        ck_assert_int_eq(point[j].unused, 0);
        ck_assert(m == 0 || (!point[j].nose_sticks && !point[j].cloth_sticks));
        nose += point[j].nose_sticks;
        cloth += point[j].cloth_sticks;
      }
    }
  ck_assert_int_ge(nose, 100);
  ck_assert_int_ge(cloth, 100);
}
