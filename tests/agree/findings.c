/* What a hostile review of an earlier solver found, as tests: results that were wrong with status ok, calls without a bound,
 * and draws in which they could come back. Rows are in findings/, as `carom resolve` reads them.
 */
#include "cases.h"
#include "precisely.h"
#include "reference.h"
#include "regimes.h"
#include "support.h"

#include "ball_ball/frame.h"
#include "impact/impact.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FILL = 40 }; /* more than the lanes of any instruction set */
/* Right-hand sides of one call: those of the precise solver, whose last step may exceed its budget, and what collocation spent.
 */
enum { MOST_EVALUATIONS = 8 * (CAROM_IMPACT_ITERATIONS + 12) + 1000 };

static const double accepted = 1e-5, realistic = 1e-6, precisely = 1e-7, in_single = 2e-5;

static carom_options options_for(carom_slip slip) {
  carom_options options = {0};
  options.slip = slip;
  return options;
}

/* Solved within `bound` of the reference, or said to be unresolved; alone and in a batch, with every instruction set; within
 * the bound on evaluations. Returns whether it was solved. */
static bool expect_solved(const carom_impact *in, carom_slip slip, double bound, const char *what) {
  const carom_options options = options_for(slip);
  carom_result exact, out, many[FILL];
  carom_impact rows[FILL];
  bool solved = false;
  for (int k = 0; k < FILL; k++)
    rows[k] = *in;
  const bool known = reference_collide(in, slip, &exact, NULL) == REFERENCE_OK;
  FOR_EACH_ISA(isa) {
    carom_detail detail;
    const carom_status status = carom_collide_detail(in, &options, &out, &detail);
    ck_assert_msg(status == CAROM_OK || status == CAROM_ERROR_UNRESOLVED, "%s: status %s", what, carom_status_name(status));
    ck_assert_int_le(detail.evaluations, MOST_EVALUATIONS);
    ck_assert_int_eq(carom_collide_batch(rows, FILL, &options, many, NULL), status);
    for (int k = 0; k < FILL; k++)
      ck_assert_mem_eq(&many[k], &out, sizeof out);
    solved = status == CAROM_OK;
    if (solved && known) {
      const double error = result_distance(&out, &exact, in->a.radius);
      ck_assert_msg(error <= bound, "%s: %g off with %s", what, error, carom_isa_name((carom_isa)isa));
    }
  }
  if (solved && known && collide_precisely(in, slip, PRECISELY, &out) == CAROM_OK) {
    const double error = result_distance(&out, &exact, in->a.radius);
    ck_assert_msg(error <= precisely, "%s: the precise solver is %g off", what, error);
  }
  return solved;
}

static void expect_file(const char *file, carom_slip slip) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, file, &cases));
  size_t solved = 0;
  for (size_t k = 0; k < cases.count; k++)
    solved += expect_solved(&cases.impact[k], slip, accepted, file);
  ck_assert_uint_ge(3 * solved, cases.count);
  cases_free(&cases);
}

START_TEST(results_that_were_wrong) {
  expect_file("exact-wrong-paper.csv", CAROM_SLIP_PAPER);
  expect_file("exact-wrong-pooltool.csv", CAROM_SLIP_POOLTOOL);
}
END_TEST

/* The rows are for the pooltool slip; here both. */
START_TEST(single_precision_that_lost_restitution) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "f32-batch-wrong.csv", &cases));
  for (size_t k = 0; k < cases.count; k++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
      carom_impact_f32 in[FILL];
      carom_result_f32 out[FILL];
      carom_impact wide;
      carom_result exact, seen;
      const carom_options options = options_for((carom_slip)slip);
      for (int c = 0; c < 26; c++)
        ((float *)&in[0])[c] = (float)((const double *)&cases.impact[k])[c];
      for (int c = 0; c < 26; c++)
        ((double *)&wide)[c] = ((const float *)&in[0])[c];
      for (int row = 1; row < FILL; row++)
        in[row] = in[0];
      if (reference_collide(&wide, (carom_slip)slip, &exact, NULL) != REFERENCE_OK)
        continue;
      FOR_EACH_ISA(isa) {
        if (carom_collide_batch_f32(in, FILL, &options, out, NULL) != CAROM_OK)
          continue;
        for (int c = 0; c < 12; c++)
          ((double *)&seen)[c] = ((const float *)&out[FILL - 1])[c];
        ck_assert_double_le(result_distance(&seen, &exact, wide.a.radius), in_single);
      }
    }
  cases_free(&cases);
}
END_TEST

/* Euler's method says at once that it would take too long, and never takes more than 16 N steps. */
START_TEST(euler_is_bounded) {
  case_set cases;
  carom_result out;
  carom_detail detail;
  carom_options options = options_for(CAROM_SLIP_PAPER);
  options.solver = CAROM_SOLVER_EULER;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "euler-hang.csv", &cases));
  for (size_t k = 0; k < cases.count; k++) {
    ck_assert_int_eq(carom_collide(&cases.impact[k], &options, &out), CAROM_ERROR_TOO_SLOW);
    ck_assert_int_eq(carom_collide_batch(&cases.impact[k], 1, &options, &out, NULL), CAROM_ERROR_TOO_SLOW);
    expect_solved(&cases.impact[k], CAROM_SLIP_PAPER, accepted, "euler-hang.csv");
  }
  random_source source = {test_seed()};
  options.steps = 100;
  for (int k = 0; k < 3000; k++) {
    carom_impact in = random_impact(&source);
    in.mu_ball = random_between(&source, 0, 1);
    in.a.mu_cloth = in.b.mu_cloth = random_between(&source, 0, 1);
    in.a.mass = in.b.mass * exp(random_between(&source, -20, 20));
    if (carom_collide_detail(&in, &options, &out, &detail) == CAROM_OK)
      ck_assert_int_le(detail.steps, 16 * options.steps);
  }
  cases_free(&cases);
}
END_TEST

/* A pressed ball that rolls, so that the cloth slip starts at zero: 1e-6 was exceeded mostly there. */
START_TEST(rolling_balls) {
  random_source source = {test_seed()};
  for (int k = 0; k < 120; k++) {
    carom_impact in = random_impact(&source);
    in.mu_ball = random_between(&source, 0.05, 0.2);
    in.a.mu_cloth = in.b.mu_cloth = random_between(&source, 0.1, 0.5);
    in.restitution = random_between(&source, 0.5, 1);
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
      const double per = -carom_spin_sign((carom_slip)slip) / in.a.radius; /* no slip by that sign */
      in.a.w[0] = -per * -in.a.v[1], in.a.w[1] = per * in.a.v[0];
      in.b.w[0] = -per * -in.b.v[1], in.b.w[1] = per * in.b.v[0];
      ck_assert(expect_solved(&in, (carom_slip)slip, realistic, "a rolling ball"));
    }
  }
}
END_TEST

/* Masses within 1 : 2, mu_b <= 0.5, mu <= 0.8. */
START_TEST(strong_friction) {
  random_source source = {test_seed()};
  int solved = 0;
  enum { DRAWS = 150 };
  for (int k = 0; k < DRAWS; k++) {
    carom_impact in = random_impact(&source);
    in.mu_ball = random_between(&source, 0, 0.5);
    in.a.mu_cloth = random_between(&source, 0, 0.8), in.b.mu_cloth = random_between(&source, 0, 0.8);
    in.a.mass = in.b.mass * exp2(random_between(&source, -1, 1));
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
      solved += expect_solved(&in, (carom_slip)slip, accepted, "strong friction");
  }
  ck_assert_int_ge(solved, DRAWS * CAROM_SLIP_COUNT - 3);
}
END_TEST

/* At the ends of the range of double precision: the same status and bits alone and in a batch, and nothing but finite numbers
 * with status ok. */
START_TEST(ends_of_the_range) {
  static const double radii[] = {2e-308, 1e-300, 1e-160, 1e160, 1e300}, spins[] = {1e307, 1e200, 1e160, 1e-300};
  random_source source = {test_seed()};
  for (int k = 0; k < 40; k++) {
    carom_impact in = random_impact(&source);
    if (k % 2) {
      const double R = radii[k / 2 % 5];
      for (int c = 0; c < 3; c++)
        in.b.r[c] = in.a.r[c] + (in.b.r[c] - in.a.r[c]) / in.a.radius * R;
      in.a.radius = in.b.radius = R;
    } else
      in.a.w[k / 2 % 3] = spins[k / 2 % 4];
    const carom_options options = options_for((carom_slip)(k / 4 % 2));
    carom_impact rows[FILL];
    for (int row = 0; row < FILL; row++)
      rows[row] = in;
    carom_result out, many[FILL];
    FOR_EACH_ISA(isa) {
      const carom_status status = carom_collide(&in, &options, &out);
      for (int c = 0; c < 12; c++)
        ck_assert_int_eq(isfinite(((const double *)&out)[c]) != 0, status >= 0);
      ck_assert_int_eq(carom_collide_batch(rows, FILL, &options, many, NULL), status < 0 ? status : CAROM_OK);
      for (int row = 0; row < FILL; row++)
        ck_assert(memcmp(&many[row], &out, sizeof out) == 0);
    }
  }
}
END_TEST

int main(void) {
  return RUN_TESTS("findings", results_that_were_wrong, single_precision_that_lost_restitution, euler_is_bounded, rolling_balls,
                   strong_friction, ends_of_the_range);
}
