/* Bad input: each field at fault gets its own status, hangs nothing, and disturbs no neighbour. */
#include "carom_tangent.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Index of a field among the 26 doubles. */
#define FIELD(member) ((int)(offsetof(carom_impact, member) / sizeof(double)))

typedef struct bad_case {
  int field;
  double value;
  carom_status status;
  int blamed; /* the field that carom_check names */
} bad_case;

#define ALONE(member, value, status) \
  { FIELD(member), value, status, FIELD(member) }

static const bad_case bad_cases[] = {
    ALONE(a.radius, 0.0, CAROM_ERROR_RADIUS),
    ALONE(a.radius, -1.0, CAROM_ERROR_RADIUS),
    ALONE(b.radius, 0.026, CAROM_ERROR_RADII_DIFFER),
    ALONE(a.mass, 0.0, CAROM_ERROR_MASS),
    ALONE(b.mass, -0.17, CAROM_ERROR_MASS),
    ALONE(a.mu_slide, -1e-9, CAROM_ERROR_MU_SLIDE),
    ALONE(b.mu_slide, 1.5, CAROM_ERROR_MU_SLIDE),
    ALONE(mu_ball, -0.1, CAROM_ERROR_MU_BALL),
    ALONE(mu_ball, 1.0000001, CAROM_ERROR_MU_BALL),
    ALONE(restitution, -1.0, CAROM_ERROR_RESTITUTION),
    ALONE(restitution, 1.01, CAROM_ERROR_RESTITUTION),
    ALONE(a.v[2], 0.1, CAROM_ERROR_VERTICAL),
    ALONE(b.v[2], -0.1, CAROM_ERROR_VERTICAL),
    {FIELD(b.r[2]), 0.04, CAROM_ERROR_HEIGHTS_DIFFER, FIELD(b.r[2])},
    {FIELD(a.r[2]), 0.02, CAROM_ERROR_HEIGHTS_DIFFER, FIELD(b.r[2])},
};
enum { BAD_CASES = sizeof bad_cases / sizeof bad_cases[0] };

/* A straight shot of a rolling ball on a resting one. */
static carom_impact good_impact(void) {
  carom_impact in = {.a = {.r = {0.0, 0.0, 0.03},
                           .v = {0.3, 1.0, 0.0},
                           .radius = 0.03,
                           .mass = 0.17,
                           .mu_slide = 0.2},
                     .mu_ball = 0.05,
                     .restitution = 0.95};
  in.b = in.a;
  in.b.r[1] = 0.06;
  memset(in.b.v, 0, sizeof in.b.v);
  in.a.w[0] = -33.0;
  in.a.w[1] = 10.0;
  return in;
}

static carom_impact with(int field, double value) {
  carom_impact in = good_impact();
  ((double *)&in)[field] = value;
  return in;
}

/* Refused by a call, with nothing but NaN; by the check, which names the field; and by a batch. */
static void expect_refused(const carom_impact *in, const carom_options *options,
                           carom_status expected, int field) {
  carom_result out;
  int blamed;
  ck_assert_msg(carom_collide(in, options, &out) == expected, "field %d: not %s", field,
                carom_status_name(expected));
  for (int k = 0; k < 12; k++)
    ck_assert(isnan(((const double *)&out)[k]));
  ck_assert_int_eq(carom_check(in, options, &blamed), expected);
  ck_assert_int_eq(blamed, field);
  ck_assert_int_eq(carom_collide_batch(in, 1, options, &out, NULL), expected);
}

TEST(each_field_is_named) {
  for (int k = 0; k < BAD_CASES; k++) {
    const carom_impact in = with(bad_cases[k].field, bad_cases[k].value);
    expect_refused(&in, NULL, bad_cases[k].status, bad_cases[k].blamed);
  }
  /* no field may be infinite or NaN */
  static const carom_status of_ball[12] = {
      CAROM_ERROR_POSITION, CAROM_ERROR_POSITION, CAROM_ERROR_POSITION, CAROM_ERROR_VELOCITY,
      CAROM_ERROR_VELOCITY, CAROM_ERROR_VELOCITY, CAROM_ERROR_SPIN,     CAROM_ERROR_SPIN,
      CAROM_ERROR_SPIN,     CAROM_ERROR_RADIUS,   CAROM_ERROR_MASS,     CAROM_ERROR_MU_SLIDE};
  for (int k = 0; k < 26 * 3; k++) {
    static const double not_finite[3] = {NAN, INFINITY, -INFINITY};
    const carom_impact in = with(k / 3, not_finite[k % 3]);
    carom_status expected = k / 3 == 24 ? CAROM_ERROR_MU_BALL : CAROM_ERROR_RESTITUTION;
    if (k / 3 < 24)
      expected = of_ball[k / 3 % 12];
    expect_refused(&in, NULL, expected, k / 3);
  }
  carom_impact in = good_impact();
  memcpy(in.b.r, in.a.r, sizeof in.b.r);
  expect_refused(&in, NULL, CAROM_ERROR_COINCIDENT, -1);
  carom_result out;
  in.b.r[1] += 1e-200; /* distinct, but the square of the distance is not */
  ck_assert_int_eq(carom_collide(&in, NULL, &out), CAROM_ERROR_COINCIDENT);
}

TEST(good_input_passes_the_check) {
  carom_impact in = good_impact();
  carom_result out;
  int blamed;
  ck_assert_int_eq(carom_check(&in, NULL, &blamed), CAROM_OK);
  ck_assert_int_eq(blamed, -1);
  ck_assert_int_eq(carom_check(&in, NULL, NULL), CAROM_OK);
  ck_assert_int_eq(carom_collide(&in, NULL, &out), CAROM_OK);
  in.b.r[2] += 1e-15; /* noise in the heights */
  in.a.v[2] = 1e-15;
  ck_assert_int_eq(carom_collide(&in, NULL, &out), CAROM_OK);
}

/* Radii that differ by rounding are one radius, ball a's, in single calls and in rows of a
 * batch, by each solver. */
TEST(noise_in_the_radii_passes) {
  enum { ROWS = 40 };
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++) {
    const carom_options options = {.solver = (carom_solver)solver};
    carom_impact in[ROWS];
    carom_result out[ROWS], expected, alone;
    int8_t status[ROWS];
    in[0] = good_impact();
    ck_assert_int_eq(carom_collide(&in[0], &options, &expected), CAROM_OK);
    for (int k = 0; k < ROWS; k++) {
      in[k] = good_impact();
      in[k].b.radius *= 1.0 + (k - ROWS / 2) * 1e-10; /* from 2e-9 below */
    }
    carom_collide_batch(in, ROWS, &options, out, status);
    for (int k = 0; k < ROWS; k++) {
      const int off = abs(k - ROWS / 2); /* at 10 rounding decides, but for both alike */
      const carom_status as_one = carom_collide(&in[k], &options, &alone);
      ck_assert_int_eq(status[k], as_one);
      if (off != 10)
        ck_assert_int_eq(as_one, off < 10 ? CAROM_OK : CAROM_ERROR_RADII_DIFFER);
      if (as_one == CAROM_OK) {
        ck_assert_mem_eq(&alone, &expected, sizeof alone);
        ck_assert_mem_eq(&out[k], &expected, sizeof alone);
      }
    }
  }
}

TEST(bad_options) {
  const carom_impact in = good_impact();
  const carom_options reserved[] = {
      {.reserved = {1}}, {.reserved = {[4] = (uint64_t)1 << 63}}, {.unused = 1}};
  for (int k = 0; k < 3; k++)
    expect_refused(&in, &reserved[k], CAROM_ERROR_OPTIONS, -1);
  const carom_number *n;
  carom_options options;
  for (int k = 0; (n = carom_number_of(CAROM_PART_IMPACT_OPTIONS, k)) != NULL; k++)
    for (int way = 0; options = (carom_options){0}, set_bad(&options, n, way); way++) {
      carom_result out;
      int8_t status = 77;
      expect_refused(&in, &options, n->error, -1);
      carom_collide_batch(&in, 1, &options, &out, &status);
      ck_assert_int_eq(status, 77);
    }
}

static void expect_same(const carom_impact *in, const carom_options *one,
                        const carom_options *other) {
  carom_result x, y;
  int8_t of_x, of_y;
  ck_assert_int_eq(carom_collide(in, one, &x), CAROM_OK);
  ck_assert_int_eq(carom_collide(in, other, &y), CAROM_OK);
  ck_assert_mem_eq(&x, &y, sizeof x);
  ck_assert_int_eq(carom_collide_batch(in, 1, one, &x, &of_x), CAROM_OK);
  ck_assert_int_eq(carom_collide_batch(in, 1, other, &y, &of_y), CAROM_OK);
  ck_assert_mem_eq(&x, &y, sizeof x);
  ck_assert(of_x == CAROM_OK && of_y == CAROM_OK);
}

TEST(zero_is_the_default) {
  const carom_impact in = good_impact();
  const carom_options zero = {0}, said = {.solver = CAROM_SOLVER_EXACT,
                                          .slip = CAROM_SLIP_PAPER,
                                          .steps = 1000,
                                          .threads = 1};
  expect_same(&in, NULL, &zero);
  expect_same(&in, &zero, &said);
  const carom_options euler = {.solver = CAROM_SOLVER_EULER},
                      of_1000 = {.solver = CAROM_SOLVER_EULER, .steps = 1000};
  expect_same(&in, &euler, &of_1000);
  carom_trace_point point[2], other[2];
  ck_assert_int_eq(carom_trace(&in, &euler, 2, point), CAROM_OK);
  ck_assert_int_eq(carom_trace(&in, &of_1000, 2, other), CAROM_OK);
  ck_assert_double_eq(point[1].normal, other[1].normal);
  const carom_options all = {.threads = CAROM_ALL_THREADS};
  expect_same(&in, &zero, &all);
}

TEST(null_pointers) {
  const carom_impact in = good_impact();
  carom_result out;
  carom_detail detail = {.steps = 7};
  int8_t status;
  ck_assert_int_eq(carom_collide(NULL, NULL, &out), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_collide(&in, NULL, NULL), CAROM_ERROR_NULL);
  const carom_impact_f32 single = narrowed(&in);
  carom_result_f32 out_single;
  ck_assert_int_eq(carom_collide_batch_f32(&single, 1, NULL, &out_single, NULL), CAROM_OK);
  ck_assert_int_eq(carom_collide_batch_f32(NULL, 1, NULL, &out_single, &status), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_collide_batch_f32(&single, 1, NULL, NULL, &status), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_collide_detail(&in, NULL, NULL, &detail), CAROM_ERROR_NULL);
  ck_assert_int_eq(detail.steps, 0);
  ck_assert_int_eq(carom_check(NULL, NULL, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_collide_batch(NULL, 1, NULL, &out, &status), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_collide_batch(&in, 1, NULL, NULL, &status), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_collide_batch(NULL, 0, NULL, NULL, NULL), CAROM_OK);
}

static void expect_unchanged(const carom_impact *in) {
  carom_result out;
  carom_detail detail = {.steps = 7};
  ck_assert_int_eq(carom_collide_detail(in, NULL, &out, &detail), CAROM_SEPARATING);
  ck_assert_int_eq(detail.steps, 0);
  ck_assert_mem_eq(out.a.v, in->a.v, sizeof out.a.v);
  ck_assert_mem_eq(out.a.w, in->a.w, sizeof out.a.w);
  ck_assert_mem_eq(out.b.v, in->b.v, sizeof out.b.v);
  ck_assert_mem_eq(out.b.w, in->b.w, sizeof out.b.w);
  /* the derivatives of what is unchanged are the seeds: a direction for each of the 26 numbers */
  static double seeds[26][26], tangent[12][26];
  for (int k = 0; k < 26; k++)
    seeds[k][k] = k + 1;
  ck_assert_int_eq(carom_collide_tangent(in, NULL, 26, seeds[0], tangent[0], NULL),
                   CAROM_SEPARATING);
  for (int k = 0; k < 12; k++)
    ck_assert_mem_eq(tangent[k], seeds[FIELD(a.v) + k % 6 + (k < 6 ? 0 : FIELD(b.v) - FIELD(a.v))],
                     sizeof tangent[k]);
}

TEST(separating_pairs_are_unchanged) {
  carom_impact in = good_impact();
  in.a.v[1] = -1.0;
  expect_unchanged(&in);
  memcpy(in.b.v, in.a.v, sizeof in.b.v); /* equal velocities */
  expect_unchanged(&in);
  memset(in.a.v, 0, sizeof in.a.v); /* both at rest */
  memset(in.b.v, 0, sizeof in.b.v);
  expect_unchanged(&in);
}

TEST(overflow_is_told) {
  carom_impact in = good_impact();
  carom_result out;
  in.a.v[0] = in.a.v[1] = 1e200; /* none yet: only its square is too large */
  ck_assert_int_eq(carom_collide(&in, NULL, &out), CAROM_OK);
  in.a.v[0] = in.a.v[1] = 1e308; /* spins are these over the radius */
  ck_assert_int_eq(carom_collide(&in, NULL, &out), CAROM_ERROR_OVERFLOW);
  ck_assert(isnan(out.a.v[0]) && isnan(out.b.w[2]));
  in = with(FIELD(b.r[1]), 1e300);
  ck_assert_int_eq(carom_collide(&in, NULL, &out), CAROM_ERROR_OVERFLOW);
  /* the impulses of Euler's method carry the mass; for the exact solver only ratios count */
  in = good_impact();
  in.a.mass = in.b.mass = 1e-310;
  ck_assert_int_lt(carom_collide(&in, &(carom_options){.solver = CAROM_SOLVER_EULER}, &out), 0);
}
