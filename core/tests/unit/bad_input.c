/* Bad input of contacts, in addition to the rows of refusals.txt: fields that are no numbers,
 * options out of their range, noise in the radii, balls that separate, and what represents a
 * default. */
#include "functions.h"

/* The status of a field that is not a number, by its name without the ball and the axis. */
static carom_status status_of(const char *field) {
  static const struct {
    const char *name;
    carom_status status;
  } statuses_of[] = {{"r", CAROM_ERROR_POSITION},
                     {"v", CAROM_ERROR_VELOCITY},
                     {"w", CAROM_ERROR_SPIN},
                     {"radius", CAROM_ERROR_RADIUS},
                     {"mass", CAROM_ERROR_MASS},
                     {"mu_slide", CAROM_ERROR_MU_SLIDE},
                     {"mu_ball", CAROM_ERROR_MU_BALL},
                     {"mu_cushion", CAROM_ERROR_MU_CUSHION},
                     {"restitution", CAROM_ERROR_RESTITUTION},
                     {"normal", CAROM_ERROR_NORMAL},
                     {"height", CAROM_ERROR_NOSE_HEIGHT},
                     {"jaw_radius", CAROM_ERROR_JAW_RADIUS}};
  const char *const dot = strchr(field, '.');
  const char *const name = dot != NULL ? dot + 1 : field;
  const size_t length = strcspn(name, "[");
  for (size_t k = 0; k < COUNT_OF(statuses_of); k++)
    if (strlen(statuses_of[k].name) == length && strncmp(statuses_of[k].name, name, length) == 0)
      return statuses_of[k].status;
  ck_abort_msg("no status is known of the field %s", field);
}

static void expect_all_nan(const void *result, size_t size) {
  const double *const numbers_of = result;
  for (size_t k = 0; k < size / sizeof(double); k++)
    ck_assert(isnan(numbers_of[k]));
}

/* No field of an impact may be infinite or no number. Each is named, by a call, the check and a
 * batch, and nothing but NaN is written. */
TEST(no_number) {
  const char *field;
  for (int k = 0; (field = carom_field_name(k)) != NULL; k++)
    for (size_t n = 0; n < COUNT_OF(wrong_numbers); n++) {
      set_up();
      ((double *)impacts)[k] = wrong_numbers[n];
      const carom_status expected = status_of(field);
      ck_assert_int_eq(carom_collide(impacts, NULL, results), expected);
      expect_all_nan(results, sizeof *results);
      ck_assert_int_eq(carom_check(impacts, NULL, &where), expected);
      ck_assert_int_eq(where, k);
      ck_assert_int_eq(carom_collide_batch(impacts, 1, NULL, results, NULL), expected);
      expect_all_nan(results, sizeof *results);
    }
}

/* The same of an impact on a cushion. */
TEST(no_number_at_a_cushion) {
  const char *field;
  for (int k = 0; (field = carom_cushion_field_name(k)) != NULL; k++)
    for (size_t n = 0; n < COUNT_OF(wrong_numbers); n++) {
      set_up();
      ((double *)rails)[k] = wrong_numbers[n];
      const carom_status expected = status_of(field);
      ck_assert_int_eq(carom_cushion(rails, NULL, motion), expected);
      expect_all_nan(motion, sizeof *motion);
      ck_assert_int_eq(carom_cushion_check(rails, NULL, &where), expected);
      ck_assert_int_eq(where, k);
      ck_assert_int_eq(carom_cushion_batch(rails, 1, NULL, motion, NULL), expected);
      expect_all_nan(motion, sizeof *motion);
    }
}

/* Each option beyond its range, and nothing written by a batch. */
TEST(each_option_is_checked) {
  static const carom_part_kind parts[] = {CAROM_PART_IMPACT_OPTIONS, CAROM_PART_CUSHION_OPTIONS};
  for (int side = 0; side < 2; side++) {
    const bool is_cushion = side == 1;
    void *const object = is_cushion ? (void *)&cushion_options : &impact_options;
    const carom_number *n;
    for (int k = 0; (n = carom_number_of(parts[side], k)) != NULL; k++)
      for (int way = 0; set_up(), set_bad(object, n, way); way++) {
        const carom_status returned[] = {
            is_cushion ? carom_cushion(rails, &cushion_options, motion)
                       : carom_collide(impacts, &impact_options, results),
            is_cushion ? carom_cushion_check(rails, &cushion_options, &where)
                       : carom_check(impacts, &impact_options, &where),
            is_cushion ? carom_cushion_batch(rails, 1, &cushion_options, motion, statuses)
                       : carom_collide_batch(impacts, 1, &impact_options, results, statuses)};
        for (int call = 0; call < 3; call++)
          ck_assert_int_eq(returned[call], n->error);
        ck_assert_int_eq(where, -1);
        ck_assert_int_eq(statuses[0], 77);
        ck_assert(isnan(is_cushion ? motion[0].w[2] : results[0].b.w[2]));
      }
  }
}

/* Radii that differ by rounding are one radius, ball a's, in single calls and in rows of a
 * batch, by each solver. */
TEST(noise_in_the_radii_passes) {
  enum { ROWS = 40 };
  set_up();
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++) {
    const carom_options solving = {.solver = (carom_solver)solver};
    carom_impact in[ROWS];
    carom_result out[ROWS], expected, alone;
    int8_t said[ROWS];
    expect_ok(carom_collide(impacts, &solving, &expected));
    for (int k = 0; k < ROWS; k++) {
      in[k] = impacts[0];
      in[k].b.radius *= 1.0 + (k - ROWS / 2) * 1e-10; /* from 2e-9 below */
    }
    carom_collide_batch(in, ROWS, &solving, out, said);
    for (int k = 0; k < ROWS; k++) {
      const int off = abs(k - ROWS / 2); /* at 10 rounding decides, but for both alike */
      const carom_status as_one = carom_collide(&in[k], &solving, &alone);
      ck_assert_int_eq(said[k], as_one);
      if (off != 10)
        ck_assert_int_eq(as_one, off < 10 ? CAROM_OK : CAROM_ERROR_RADII_DIFFER);
      if (as_one == CAROM_OK) {
        ck_assert_mem_eq(&alone, &expected, sizeof alone);
        ck_assert_mem_eq(&out[k], &expected, sizeof alone);
      }
    }
  }
}

static void expect_same(const carom_impact *in, const carom_options *one,
                        const carom_options *other) {
  carom_result x, y;
  int8_t of_x, of_y;
  expect_ok(carom_collide(in, one, &x));
  expect_ok(carom_collide(in, other, &y));
  ck_assert_mem_eq(&x, &y, sizeof x);
  expect_ok(carom_collide_batch(in, 1, one, &x, &of_x));
  expect_ok(carom_collide_batch(in, 1, other, &y, &of_y));
  ck_assert_mem_eq(&x, &y, sizeof x);
  ck_assert(of_x == CAROM_OK && of_y == CAROM_OK);
}

TEST(zero_is_the_default) {
  set_up();
  const carom_options zero = {0}, said = {.solver = CAROM_SOLVER_EXACT,
                                          .slip = CAROM_SLIP_PAPER,
                                          .steps = 1000,
                                          .threads = 1};
  expect_same(impacts, NULL, &zero);
  expect_same(impacts, &zero, &said);
  const carom_options euler = {.solver = CAROM_SOLVER_EULER},
                      of_1000 = {.solver = CAROM_SOLVER_EULER, .steps = 1000};
  expect_same(impacts, &euler, &of_1000);
  carom_trace_point point[2], other[2];
  expect_ok(carom_trace(impacts, &euler, 2, point));
  expect_ok(carom_trace(impacts, &of_1000, 2, other));
  ck_assert_double_eq(point[1].normal, other[1].normal);
  const carom_options all = {.threads = CAROM_ALL_THREADS};
  expect_same(impacts, &zero, &all);
}

static void expect_unchanged(const carom_impact *in) {
  carom_result out;
  detail.steps = 7;
  ck_assert_int_eq(carom_collide_detail(in, NULL, &out, &detail), CAROM_SEPARATING);
  ck_assert_int_eq(detail.steps, 0);
  ck_assert_mem_eq(&out.a, in->a.v, sizeof out.a); /* v and w */
  ck_assert_mem_eq(&out.b, in->b.v, sizeof out.b);
  /* the derivatives of what is unchanged are the seeds: a direction for each of the 26 numbers */
  static double seed[26][26], slope[12][26];
  for (int k = 0; k < 26; k++)
    seed[k][k] = k + 1;
  ck_assert_int_eq(carom_collide_tangent(in, NULL, 26, seed[0], slope[0], NULL), CAROM_SEPARATING);
  for (int k = 0; k < 12; k++)
    ck_assert_mem_eq(slope[k], seed[3 + k % 6 + (k < 6 ? 0 : 12)], sizeof slope[k]); /* v and w */
}

TEST(separating_pairs_are_unchanged) {
  set_up();
  carom_impact in = impacts[0];
  in.a.v[1] = -1.0;
  expect_unchanged(&in);
  memcpy(in.b.v, in.a.v, sizeof in.b.v); /* equal velocities */
  expect_unchanged(&in);
  memset(in.a.v, 0, sizeof in.a.v); /* both at rest */
  memset(in.b.v, 0, sizeof in.b.v);
  expect_unchanged(&in);
}

/* What has no row: a batch without rows, and details of a call that is rejected. */
TEST(nothing_to_solve) {
  set_up();
  expect_ok(carom_collide_batch(NULL, 0, NULL, NULL, NULL));
  expect_ok(carom_cushion_batch(NULL, 0, NULL, NULL, NULL));
  detail.steps = 7;
  ck_assert_int_eq(carom_collide_detail(impacts, NULL, NULL, &detail), CAROM_ERROR_NULL);
  ck_assert_int_eq(detail.steps, 0);
}
