/* Euler's method: on the 204 cases pooltool's own result to the last bit, and its step counts; and
 * it is of first order: ten times the steps, a tenth of the error against the exact references. */
#include "accuracy.h"
#include "cases.h"
#include "support.h"

#include <math.h>
#include <string.h>

TEST(every_bit_and_every_step) {
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
    ck_assert_int_eq(carom_collide_detail(&cases.impact[k], &options, &out, &detail), CAROM_OK);
    ck_assert_msg(memcmp(&out, &reference.result[k], sizeof out) == 0, "%s differs", cases.id[k]);
    ck_assert_int_eq(detail.steps, reference.steps[k]);
  }
  reference_free(&reference);
  cases_free(&cases);
}

static double mean_error(const case_set *cases, const reference_set *reference, carom_slip slip,
                         int steps) {
  pair_accuracy each[204];
  carom_options options = {0};
  options.solver = CAROM_SOLVER_EULER;
  options.slip = slip;
  options.steps = steps;
  for (size_t k = 0; k < cases->count; k++) {
    carom_result out;
    ck_assert_int_eq(carom_collide(&cases->impact[k], &options, &out), CAROM_OK);
    each[k] = accuracy_of(&out, &reference->result[k], cases->impact[k].a.radius);
  }
  return accuracy_summarise(each, cases->count).mean;
}

static void expect_first_order(carom_slip slip, const char *file) {
  case_set cases;
  reference_set reference;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  ck_assert(reference_load(CAROM_TEST_DATA, file, &cases, &reference));
  double before = mean_error(&cases, &reference, slip, 100);
  ck_assert_double_lt(before, 5e-3);
  for (int steps = 1000; steps <= 100000; steps *= 10) {
    const double now = mean_error(&cases, &reference, slip, steps);
    const double order = log10(before / now);
    ck_assert_msg(order > 0.9 && order < 1.1, "order %g between N = %d (%g) and %d (%g)", order,
                  steps / 10, before, steps, now);
    before = now;
  }
  reference_free(&reference);
  cases_free(&cases);
}

TEST(paper_slip) {
  expect_first_order(CAROM_SLIP_PAPER, "reference-exact-paper.csv");
}

TEST(pooltool_slip) {
  expect_first_order(CAROM_SLIP_POOLTOOL, "reference-exact-pooltool.csv");
}
