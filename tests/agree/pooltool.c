/* Parity: on the 204 cases, pooltool's own result to the last bit, and its step counts. */
#include "cases.h"
#include "support.h"

#include <stdbool.h>
#include <string.h>

static carom_options parity(void) {
  carom_options options = {0};
  options.solver = CAROM_SOLVER_EULER;
  options.slip = CAROM_SLIP_POOLTOOL;
  return options;
}

TEST(every_bit_and_every_step) {
  case_set cases;
  reference_set reference;
  const carom_options options = parity();
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

TEST(a_batch_is_single_calls) {
  case_set cases;
  const carom_options options = parity();
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  carom_result out[204], one;
  int8_t status[204];
  ck_assert_int_eq(carom_collide_batch(cases.impact, cases.count, &options, out, status), CAROM_OK);
  for (size_t k = 0; k < cases.count; k++) {
    ck_assert_int_eq(carom_collide(&cases.impact[k], &options, &one), CAROM_OK);
    ck_assert_mem_eq(&one, &out[k], sizeof one);
    ck_assert_int_eq(status[k], CAROM_OK);
  }
  cases_free(&cases);
}

TEST(separating_pairs_of_real_shots) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_DATA, "separating-20.csv", &cases));
  ck_assert_uint_eq(cases.count, 20);
  for (size_t k = 0; k < cases.count; k++) {
    carom_result out;
    ck_assert_int_eq(carom_collide(&cases.impact[k], NULL, &out), CAROM_SEPARATING);
    ck_assert_mem_eq(out.a.v, cases.impact[k].a.v, sizeof out.a.v);
    ck_assert_mem_eq(out.b.w, cases.impact[k].b.w, sizeof out.b.w);
  }
  cases_free(&cases);
}
