/* The solvers of two balls against the exact references and against the reference of
 * core/reference, which shares nothing with them. Here is what `carom-lab verify` and `carom-lab
 * stress` do not compare: details, speeds of all orders, and what once was wrong.
 *
 * Random collisions come by regime (core/reference/regimes.c): slow and fast, grazing and head-on,
 * draw, follow and stun, sidespin, both moving, stick at every moment and just missed, the cloth's
 * slip passing near zero or through it, friction and restitution from 0 to 1, unequal masses.
 * $CAROM_TEST_DRAWS reports how many of each.
 */
#include "cases.h"
#include "kept.h"
#include "random_impacts.h"
#include "support.h"

#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "contact_law/impact.h"

/* The reference itself against the data: what it is trusted for. */
TEST(reference_agrees_with_the_data) {
  case_set cases;
  reference_set reference;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  ck_assert(reference_load(CAROM_TEST_DATA, "reference-exact-paper.csv", &cases, &reference));
  for (size_t k = 0; k < cases.count; k += 7) {
    carom_result out;
    ck_assert_int_eq(reference_collide(&cases.impact[k], CAROM_SLIP_PAPER, &out, NULL),
                     REFERENCE_OK);
    ck_assert_double_le(result_distance(&out, &reference.result[k], cases.impact[k].a.radius),
                        1e-11);
  }
  reference_free(&reference);
  cases_free(&cases);
}

/* What the solver tells of a collision: the impulses balance, the works are in the ratio of
 * restitution, stick is seen. `normal`: the impulse and the work of the reference. */
static void expect_details(const carom_impact *in, const carom_result *out, const carom_detail *d,
                           const double normal[2]) {
  /* what is subtracted on the way: speeds of both balls */
  const double speed = fabs(in->a.v[0]) + fabs(in->a.v[1]) + fabs(in->b.v[0]) + fabs(in->b.v[1]);
  const double scale = fabs(d->normal) + in->a.mass * speed;
  const double length = distance(in->b.r, in->a.r);
  for (int c = 0; c < 2; c++) { /* in the plane of the table */
    const double y = (in->b.r[c] - in->a.r[c]) / length;
    const double on_a = -d->normal * y + d->friction[c] + d->cloth_a[c];
    const double on_b = d->normal * y - d->friction[c] + d->cloth_b[c];
    ck_assert_double_le(fabs(in->a.mass * (out->a.v[c] - in->a.v[c]) - on_a), 1e-12 * scale);
    ck_assert_double_le(fabs(in->b.mass * (out->b.v[c] - in->b.v[c]) - on_b),
                        1e-11 * (scale + in->b.mass * speed));
  }
  ck_assert_double_eq_tol(d->work, (1.0 + in->restitution * in->restitution) * d->work_compression,
                          1e-12 * fabs(d->work));
  ck_assert_double_eq_tol(d->normal, normal[0], 1e-4 * normal[0] + 1e-15 * scale);
  ck_assert_double_eq_tol(d->work_compression, normal[1],
                          1e-3 * normal[1] + 1e-14 * speed * normal[0]);
  ck_assert(d->steps == 0 && d->evaluations >= 0);
  ck_assert((d->stick == CAROM_STICK_NEVER) == (isnan(d->stick_normal) != 0));
}

/* A few say that they are unresolved. `carom-lab stress` has the same regimes in batches, in single
 * precision and in far greater numbers (agree/stress). */
TEST(details_in_every_regime) {
  int count = 0, unresolved = 0, stuck[3] = {0};
  const int draws = draws_of_test(8, 8);
  for (int regime = 0; regime < regimes_count(); regime++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
      lab_random rng = {test_seed() + 1000003u * (uint64_t)(2 * regime + slip)};
      const carom_options options = {.slip = (carom_slip)slip};
      for (int k = 0; k < draws; k++) {
        const carom_impact in = regimes_draw(regime, carom_spin_sign(options.slip), &rng);
        carom_result out, exact;
        carom_detail detail;
        double normal[2];
        const carom_status status = carom_collide_detail(&in, &options, &out, &detail);
        if (status == CAROM_SEPARATING ||
            kept_collide(&in, options.slip, &exact, normal) != REFERENCE_OK)
          continue;
        unresolved += status == CAROM_ERROR_UNRESOLVED;
        if (status == CAROM_ERROR_UNRESOLVED)
          continue;
        const double error = result_distance(&out, &exact, in.a.radius);
        ck_assert_msg(error <= 1e-5, "%s, slip %d, draw %d is %g off", regimes_name(regime), slip,
                      k, error);
        expect_details(&in, &out, &detail, normal);
        stuck[detail.stick]++;
        count++;
      }
    }
  /* of 400 seeds 389 of 211,200 draws are unresolved; eight standard deviations more may be */
  const double expected = count / 543.0;
  ck_assert_double_le(unresolved, expected + 8.0 * sqrt(expected));
  for (int k = 0; k < 3; k++)
    ck_assert_int_gt(stuck[k], 10);
}

/* Real shots are not left to the fallback. */
TEST(collocation_takes_the_references) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  FOR_EACH_ISA(isa) for (int sign = -1; sign <= 1; sign += 2) {
    carom_result out;
    for (size_t k = 0; k < cases.count; k++)
      ck_assert_int_gt(
          carom_kernels_of_call(0)->call[CAROM_F64](&cases.impact[k], sign, &out, NULL), 0);
  }
  cases_free(&cases);
}

/* The same collision at other speeds, down to where squares vanish and up to where they are
 * infinite. */
TEST(speeds_scale) {
  static const int powers[] = {-980, -600, -100, -40, 40, 100, 600, 980};
  random_source source = {test_seed()};
  for (int k = 0; k < 200; k++) {
    const carom_impact in = random_impact(&source);
    carom_result out, scaled;
    expect_ok(carom_collide(&in, NULL, &out));
    for (size_t j = 0; j < COUNT_OF(powers); j++) {
      carom_impact other = in;
      /* velocities and spins, those of b 12 numbers behind those of a */
      for (int c = 3; c < 9; c++) {
        double *const number = (double *)&other + c;
        number[0] = ldexp(number[0], powers[j]);
        number[12] = ldexp(number[12], powers[j]);
      }
      expect_ok(carom_collide(&other, NULL, &scaled));
      for (int c = 0; c < 12; c++)
        ((double *)&scaled)[c] = ldexp(((double *)&scaled)[c], -powers[j]);
      const double distance = result_distance(&scaled, &out, in.a.radius);
      ck_assert_msg(distance <= 3e-6, "collision %d at 2^%d times its speed: %g apart", k,
                    powers[j], distance);
    }
  }
}

/* Whether what Euler's steps tell of a collision is near the exact solver's. */
static bool is_near(const carom_detail *euler, const carom_detail *exact) {
  const double most = 1e-3 * exact->normal;
  bool near =
      fabs(euler->normal - exact->normal) < most &&
      fabs(euler->work_compression - exact->work_compression) < 1e-3 * exact->work_compression;
  for (int c = 0; c < 3; c++) {
    near = near && fabs(euler->friction[c] - exact->friction[c]) < most;
    /* where they stick, Euler's steps press now one ball and now the other into the cloth */
    near = near && (exact->stick != CAROM_STICK_NEVER ||
                    (fabs(euler->cloth_a[c] - exact->cloth_a[c]) < most &&
                     fabs(euler->cloth_b[c] - exact->cloth_b[c]) < most));
  }
  return near;
}

/* Of balls that stick, one in two thousand is off by more with 20,000 steps, not with others. */
TEST(details_of_euler_come_near) {
  random_source source = {test_seed()};
  int again = 0;
  for (int k = 0; k < 200; k++) {
    const carom_impact in = random_impact(&source);
    carom_options options = {0};
    carom_result out;
    carom_detail exact, euler;
    expect_ok(carom_collide_detail(&in, &options, &out, &exact));
    options.solver = CAROM_SOLVER_EULER;
    options.steps = 20000;
    expect_ok(carom_collide_detail(&in, &options, &out, &euler));
    ck_assert_int_ge(euler.steps, 10000);
    if (is_near(&euler, &exact))
      continue;
    ck_assert_int_ne(exact.stick, CAROM_STICK_NEVER);
    again++;
    options.steps = 200000;
    expect_ok(carom_collide_detail(&in, &options, &out, &euler));
    ck_assert_msg(is_near(&euler, &exact), "collision %d", k);
  }
  ck_assert_int_le(again, 4);
}

/* ---- What a hostile review of an earlier solver found: results that were wrong with status ok,
 * and calls without a bound. Rows are in findings/, as `carom resolve` reads them. */

enum { FILL = 96 }; /* rows of a batch that every instruction set solves in lanes */
/* Right-hand sides of one call: those of the precise solver, whose last step may exceed its
 * budget, and what collocation spent.
 */
enum { MOST_EVALUATIONS = 8 * (CAROM_IMPACT_ITERATIONS + 12) + 1000 };

static const double accepted = 1e-5, realistic = 1e-6, precisely = 1e-7, hardly = 1e-9,
                    in_single = 2e-5;

/* Solved within `bound` of the reference, or said to be unresolved; alone and in a batch, with
 * every instruction set; within the bound on evaluations; and by the precise solver within that of
 * its own. Returns whether it was solved. */
static bool expect_solved(const carom_impact *in, carom_slip slip, double bound, double of_precise,
                          const char *what) {
  const carom_options options = {.slip = slip};
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
                    carom_word(CAROM_WORDS_ISA, isa));
    }
  }
  if (solved && known && collide_precisely(in, slip, PRECISELY, &out) == CAROM_OK) {
    const double error = result_distance(&out, &exact, in->a.radius);
    ck_assert_msg(error <= of_precise, "%s: the precise solver is %g off", what, error);
  }
  return solved;
}

/* The same in single precision, by calls and in batches. Beyond play nothing is promised; some
 * rows are right all the same. */
static void expect_in_single(const carom_impact *in, carom_slip slip, bool beyond_play,
                             const char *what) {
  const carom_options options = {.slip = slip};
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
                  carom_word(CAROM_WORDS_ISA, isa));
  }
}

/* A file of findings, at least one of `of` rows of which is solved. */
static void expect_file(const char *file, carom_slip slip, double of_precise, size_t of) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, file, &cases));
  size_t solved = 0;
  for (size_t k = 0; k < cases.count; k++) {
    solved +=
        expect_solved(&cases.impact[k], slip, is_of_play(&cases.impact[k]) ? realistic : accepted,
                      of_precise, cases.id[k]);
    expect_in_single(&cases.impact[k], slip, false, cases.id[k]);
  }
  ck_assert_uint_ge(of * solved, cases.count);
  cases_free(&cases);
}

TEST(results_that_were_wrong) {
  expect_file("exact-wrong-paper.csv", CAROM_SLIP_PAPER, precisely, 3);
  expect_file("exact-wrong-pooltool.csv", CAROM_SLIP_POOLTOOL, precisely, 3);
  for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
    expect_file("stick-before-the-end.csv", (carom_slip)slip, precisely, 3);
  expect_file("pooltool-turns.csv", CAROM_SLIP_POOLTOOL, precisely, 3);
}

/* Collisions that a class of arcs once accepted wrongly: stick just at the end, hardly any u_z,
 * strong friction next to a light ball, no ball slip at all, a light pressed ball on rough cloth,
 * friction so weak that the sweeps leave p rough. All are solved. */
TEST(hard_cases) {
  expect_file("hard-paper.csv", CAROM_SLIP_PAPER, hardly, 1);
  expect_file("hard-pooltool.csv", CAROM_SLIP_POOLTOOL, hardly, 1);
}

/* Full hits with the slip of pooltool, in which friction makes motion across the line of centres
 * of what counts as none: up to 20 % of the fastest speed, by a reference of 34 digits. */
TEST(rounding_errors_that_friction_drives) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "pooltool-no-drive.csv", &cases));
  const carom_options options = {.slip = CAROM_SLIP_POOLTOOL};
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
  carom_options options = {.solver = CAROM_SOLVER_EULER};
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "euler-hang.csv", &cases));
  for (size_t k = 0; k < cases.count; k++) {
    ck_assert_int_eq(carom_collide(&cases.impact[k], &options, &out), CAROM_ERROR_TOO_SLOW);
    ck_assert_int_eq(carom_collide_batch(&cases.impact[k], 1, &options, &out, NULL),
                     CAROM_ERROR_TOO_SLOW);
    expect_solved(&cases.impact[k], CAROM_SLIP_PAPER, accepted, precisely, "euler-hang.csv");
  }
  random_source source = {test_seed()};
  options.steps = 100;
  for (int k = 0; k < 3000; k++) {
    carom_impact in = random_impact(&source);
    in.mu_ball = random_between(&source, 0, 1);
    in.a.mu_slide = in.b.mu_slide = random_between(&source, 0, 1);
    in.a.mass = in.b.mass * exp(random_between(&source, -20, 20));
    if (carom_collide_detail(&in, &options, &out, &detail) == CAROM_OK)
      ck_assert_int_le(detail.steps, 16 * options.steps);
  }
  cases_free(&cases);
}

/* Euler's method: pooltool's step counts on the 204 cases; `carom-lab verify` compares the bits. */
TEST(every_step_of_euler) {
  case_set cases;
  reference_set reference;
  const carom_options options = {.solver = CAROM_SOLVER_EULER, .slip = CAROM_SLIP_POOLTOOL};
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  ck_assert_uint_eq(cases.count, 204);
  ck_assert(reference_load(CAROM_TEST_DATA, "reference-pooltool-n1000.csv", &cases, &reference));
  ck_assert_ptr_nonnull(reference.steps);
  for (size_t k = 0; k < cases.count; k++) {
    carom_result out;
    carom_detail detail;
    expect_ok(carom_collide_detail(&cases.impact[k], &options, &out, &detail));
    ck_assert_int_eq(detail.steps, reference.steps[k]);
  }
  reference_free(&reference);
  cases_free(&cases);
}
