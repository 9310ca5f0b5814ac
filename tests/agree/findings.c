/* What a hostile review of an earlier solver found, as tests: results that were wrong with
 * status ok, calls without a bound, and draws in which they could come back. Rows are in
 * findings/, as `carom resolve` reads them.
 */
#include "cases.h"
#include "draws.h"
#include "kept.h"
#include "precisely.h"
#include "regimes.h"
#include "support.h"

#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "impact/impact.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FILL = 96 }; /* rows of a batch that every instruction set solves in lanes */
/* Right-hand sides of one call: those of the precise solver, whose last step may exceed its
 * budget, and what collocation spent.
 */
enum { MOST_EVALUATIONS = 8 * (CAROM_IMPACT_ITERATIONS + 12) + 1000 };

static const double accepted = 1e-5, realistic = 1e-6, precisely = 1e-7, in_single = 2e-5;

static carom_options options_for(carom_slip slip) {
  carom_options options = {0};
  options.slip = slip;
  return options;
}

/* Solved within `bound` of the reference, or said to be unresolved; alone and in a batch, with
 * every instruction set; within the bound on evaluations. Returns whether it was solved. */
static bool expect_solved(const carom_impact *in, carom_slip slip, double bound, const char *what) {
  const carom_options options = options_for(slip);
  carom_result exact, out, many[FILL];
  carom_impact rows[FILL];
  bool solved = false;
  for (int k = 0; k < FILL; k++)
    rows[k] = *in;
  const bool known = kept_collide(in, slip, &exact, NULL) == REFERENCE_OK;
  FOR_EACH_ISA(isa) {
    carom_detail detail;
    const carom_status status = carom_collide_detail(in, &options, &out, &detail);
    ck_assert_msg(status == CAROM_OK || status == CAROM_ERROR_UNRESOLVED, "%s: status %s", what,
                  carom_status_name(status));
    ck_assert_int_le(detail.evaluations, MOST_EVALUATIONS);
    ck_assert_int_eq(carom_collide_batch(rows, FILL, &options, many, NULL), status);
    for (int k = 0; k < FILL; k++)
      ck_assert_mem_eq(&many[k], &out, sizeof out);
    solved = status == CAROM_OK;
    if (solved && known) {
      const double error = result_distance(&out, &exact, in->a.radius);
      ck_assert_msg(error <= bound, "%s: %g off with %s", what, error,
                    carom_isa_name((carom_isa)isa));
    }
  }
  if (solved && known && collide_precisely(in, slip, PRECISELY, &out) == CAROM_OK) {
    const double error = result_distance(&out, &exact, in->a.radius);
    ck_assert_msg(error <= precisely, "%s: the precise solver is %g off", what, error);
  }
  return solved;
}

/* The same in single precision, by calls and in batches. Beyond play nothing is promised; some
 * rows are right all the same. */
static void expect_in_single(const carom_impact *in, carom_slip slip, bool beyond_play,
                             const char *what) {
  const carom_options options = options_for(slip);
  carom_impact_f32 rows[FILL];
  carom_result_f32 out, many[FILL];
  carom_result exact;
  for (int row = 0; row < FILL; row++)
    rows[row] = narrowed(in);
  const carom_impact wide = widened(&rows[0]);
  const bool known =
      (beyond_play || is_of_play(&wide)) && kept_collide(&wide, slip, &exact, NULL) == REFERENCE_OK;
  FOR_EACH_ISA(isa) {
    const carom_status status = carom_collide_one(CAROM_F32, &rows[0], &options, &out);
    ck_assert_int_eq(carom_collide_batch_f32(rows, FILL, &options, many, NULL), status);
    for (int row = 0; row < FILL; row++)
      ck_assert_mem_eq(&many[row], &out, sizeof out);
    if (status != CAROM_OK || !known)
      continue;
    const carom_result seen = widened_result(&out);
    const double error = result_distance(&seen, &exact, wide.a.radius);
    ck_assert_msg(error <= in_single, "%s in single precision: %g off with %s", what, error,
                  carom_isa_name((carom_isa)isa));
  }
}

static void expect_file(const char *file, carom_slip slip) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, file, &cases));
  size_t solved = 0;
  for (size_t k = 0; k < cases.count; k++) {
    solved += expect_solved(&cases.impact[k], slip,
                            is_of_play(&cases.impact[k]) ? realistic : accepted, cases.id[k]);
    expect_in_single(&cases.impact[k], slip, false, cases.id[k]);
  }
  ck_assert_uint_ge(3 * solved, cases.count);
  cases_free(&cases);
}

TEST(results_that_were_wrong) {
  expect_file("exact-wrong-paper.csv", CAROM_SLIP_PAPER);
  expect_file("exact-wrong-pooltool.csv", CAROM_SLIP_POOLTOOL);
  for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
    expect_file("stick-before-the-end.csv", (carom_slip)slip);
  expect_file("pooltool-turns.csv", CAROM_SLIP_POOLTOOL);
}

/* Full hits with the slip of pooltool, in which friction makes motion across the line of centres
 * of what counts as none: up to 20 % of the fastest speed, by a reference of 34 digits. */
TEST(rounding_errors_that_friction_drives) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "pooltool-no-drive.csv", &cases));
  const carom_options options = options_for(CAROM_SLIP_POOLTOOL);
  ck_assert_uint_eq(cases.count, 30);
  for (size_t k = 0; k < cases.count; k++)
    FOR_EACH_ISA(isa) {
      carom_result out;
      ck_assert_int_eq(carom_collide(&cases.impact[k], &options, &out), CAROM_ERROR_UNRESOLVED);
    }
  cases_free(&cases);
}

/* The rows are for the pooltool slip; here both. */
TEST(single_precision_that_lost_restitution) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "f32-batch-wrong.csv", &cases));
  for (size_t k = 0; k < cases.count; k++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
      expect_in_single(&cases.impact[k], (carom_slip)slip, true, cases.id[k]);
  cases_free(&cases);
}

/* Euler's method says at once that it would take too long, and never takes more than 16 N steps. */
TEST(euler_is_bounded) {
  case_set cases;
  carom_result out;
  carom_detail detail;
  carom_options options = options_for(CAROM_SLIP_PAPER);
  options.solver = CAROM_SOLVER_EULER;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "euler-hang.csv", &cases));
  for (size_t k = 0; k < cases.count; k++) {
    ck_assert_int_eq(carom_collide(&cases.impact[k], &options, &out), CAROM_ERROR_TOO_SLOW);
    ck_assert_int_eq(carom_collide_batch(&cases.impact[k], 1, &options, &out, NULL),
                     CAROM_ERROR_TOO_SLOW);
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

/* At the ends of the range of double precision: the same status and bits alone and in a batch,
 * and nothing but finite numbers with status ok. */
TEST(ends_of_the_range) {
  static const double radii[] = {2e-308, 1e-300, 1e-160, 1e160, 1e300},
                      spins[] = {1e307, 1e200, 1e160, 1e-300};
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
      ck_assert_int_eq(carom_collide_batch(rows, FILL, &options, many, NULL),
                       status < 0 ? status : CAROM_OK);
      for (int row = 0; row < FILL; row++)
        ck_assert(memcmp(&many[row], &out, sizeof out) == 0);
    }
  }
}
