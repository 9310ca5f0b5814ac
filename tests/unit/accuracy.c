/* The error measures on made-up results. */
#include "accuracy.h"
#include "support.h"

#include <math.h>

TEST(pair_and_component_errors) {
  const carom_result reference = {.a.v = {2.0, 0.001, 0.0}, .b.w = {0.0, 0.0, 100.0}};
  carom_result result = reference;
  pair_accuracy a = accuracy_of(&result, &reference, 0.03);
  ck_assert(a.identical);
  ck_assert_double_eq(a.pair, 0.0);
  ck_assert_double_eq(a.component, 0.0);
  result.a.v[1] = 0.003; /* 0.002 off: of the scale 3 = 0.03 * 100; itself below a thousandth of
                            it */
  a = accuracy_of(&result, &reference, 0.03);
  ck_assert(!a.identical);
  ck_assert_double_eq_tol(a.pair, 0.002 / 3.0, 1e-15);
  ck_assert_double_eq_tol(a.component, 0.002 / 0.003, 1e-12);
  result = reference;
  result.b.w[2] = 101.0;
  a = accuracy_of(&result, &reference, 0.03);
  ck_assert_double_eq_tol(a.pair, 0.01, 1e-12);
  ck_assert_double_eq_tol(a.component, 0.01, 1e-12);
  result.b.v[0] = NAN;
  a = accuracy_of(&result, &reference, 0.03);
  ck_assert(isinf(a.pair) && isinf(a.component) && !a.identical);
}

TEST(summary) {
  pair_accuracy each[200];
  for (int k = 0; k < 200; k++)
    each[(k * 77) % 200] = (pair_accuracy){.pair = k, .component = 1e-4 * k, .identical = k == 0};
  const accuracy_summary s = accuracy_summarise(each, 200);
  ck_assert_uint_eq(s.cases, 200);
  ck_assert_uint_eq(s.identical, 1);
  ck_assert_double_eq_tol(s.mean, 99.5, 1e-9);
  ck_assert_double_eq(s.median, 99.5);
  ck_assert_double_eq(s.p99, 197.0);
  ck_assert_double_eq(s.max, 199.0);
  ck_assert_uint_eq(s.component_1e3, 189);
  ck_assert_uint_eq(s.component_1e2, 99);
}
