/* Counters in a build without PAPI: every value is NAN, and the reason is a sentence that says what to do. */
#include "counters.h"
#include "support.h"

#include <math.h>
#include <string.h>

static void work(void *context) {
  (void)context;
}

START_TEST(absence_has_a_reason) {
  const char *text = counters_begin();
  ck_assert(strncmp(text, "NA: ", 4) == 0);
  ck_assert(strstr(text, "libpapi-dev") != NULL);
  double value[COUNTER_COUNT] = {0};
  counters_measure(work, NULL, value);
  for (int k = 0; k < COUNTER_COUNT; k++) {
    ck_assert(isnan(value[k]));
    ck_assert_str_eq(counter_reason(k), text);
  }
  counters_end();
}
END_TEST

int main(void) {
  return RUN_TESTS("counters", absence_has_a_reason);
}
