/* Names and texts: every status has its own, and the byte form of a status reads back. */
#include "support.h"

#include <stdio.h>
#include <string.h>

static const carom_status statuses[] = {
#define STATUS(NAME, value, name, text) CAROM_##NAME,
    CAROM_STATUS_LIST(STATUS)
#undef STATUS
};
enum { STATUSES = sizeof statuses / sizeof statuses[0] };

START_TEST(statuses_are_distinct) {
  for (int j = 0; j < STATUSES; j++) {
    ck_assert_int_eq(carom_status_of_byte((uint8_t)statuses[j]), statuses[j]);
    for (int k = 0; k < j; k++) {
      ck_assert_int_ne(statuses[j], statuses[k]);
      ck_assert_str_ne(carom_status_name(statuses[j]), carom_status_name(statuses[k]));
      ck_assert_str_ne(carom_status_string(statuses[j]), carom_status_string(statuses[k]));
    }
  }
  ck_assert_str_eq(carom_status_name(CAROM_OK), "ok");
  ck_assert_str_eq(carom_status_name(CAROM_SEPARATING), "separating");
  ck_assert_str_eq(carom_status_name((carom_status)-100), "unknown");
  ck_assert_ptr_nonnull(carom_status_string((carom_status)100));
}
END_TEST

START_TEST(enumerations_have_names) {
  for (int k = 0; k < CAROM_SOLVER_COUNT; k++)
    ck_assert_ptr_nonnull(carom_solver_name((carom_solver)k));
  ck_assert_str_eq(carom_slip_name(CAROM_SLIP_PAPER), "paper");
  ck_assert_str_eq(carom_slip_name(CAROM_SLIP_POOLTOOL), "pooltool");
  ck_assert_ptr_null(carom_solver_name(CAROM_SOLVER_COUNT));
  ck_assert_ptr_null(carom_slip_name((carom_slip)-1));
}
END_TEST

START_TEST(fields_have_names) {
  ck_assert_str_eq(carom_field_name(0), "a.r[0]");
  ck_assert_str_eq(carom_field_name(11), "a.mu_cloth");
  ck_assert_str_eq(carom_field_name(12), "b.r[0]");
  ck_assert_str_eq(carom_field_name(20), "b.w[2]");
  ck_assert_str_eq(carom_field_name(25), "restitution");
  ck_assert_ptr_null(carom_field_name(26));
  ck_assert_ptr_null(carom_field_name(-1));
}
END_TEST

START_TEST(version_is_that_of_the_header) {
  char expected[32];
  snprintf(expected, sizeof expected, "%d.%d.%d", CAROM_VERSION_MAJOR, CAROM_VERSION_MINOR, CAROM_VERSION_PATCH);
  ck_assert_str_eq(carom_version(), expected);
}
END_TEST

int main(void) {
  return RUN_TESTS("names", statuses_are_distinct, enumerations_have_names, fields_have_names, version_is_that_of_the_header);
}
