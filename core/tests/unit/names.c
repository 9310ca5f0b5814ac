/* Names and texts: every status has its own; what there is of each enumeration has a name, and
 * nothing else has. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* setenv */
#endif
#include "support.h"

TEST(statuses_are_distinct) {
  int known = 0;
  for (int j = -128; j < 128; j++) { /* what an int8_t holds */
    const char *name = carom_status_name((carom_status)j);
    if (strcmp(name, "unknown") == 0)
      continue;
    known++;
    for (int k = -128; k < j; k++)
      if (strcmp(carom_status_name((carom_status)k), "unknown") != 0) {
        ck_assert_str_ne(name, carom_status_name((carom_status)k));
        ck_assert_str_ne(carom_status_string((carom_status)j),
                         carom_status_string((carom_status)k));
      }
  }
  ck_assert_int_ge(known, 25);
  ck_assert_str_eq(carom_status_name(CAROM_OK), "ok");
  ck_assert_str_eq(carom_status_name(CAROM_SEPARATING), "separating");
  ck_assert_str_eq(carom_status_name((carom_status)-50), "unknown"); /* retired */
  ck_assert_ptr_nonnull(carom_status_string((carom_status)100));
}

TEST(enumerations_have_names) {
  for (int k = 0; k < CAROM_SOLVER_COUNT; k++)
    ck_assert_ptr_nonnull(carom_word(CAROM_WORDS_SOLVER, k));
  ck_assert_str_eq(carom_word(CAROM_WORDS_SLIP, CAROM_SLIP_PAPER), "paper");
  ck_assert_str_eq(carom_word(CAROM_WORDS_SLIP, CAROM_SLIP_POOLTOOL), "pooltool");
  ck_assert_ptr_null(carom_word(CAROM_WORDS_SOLVER, CAROM_SOLVER_COUNT));
  ck_assert_ptr_null(carom_word(CAROM_WORDS_SLIP, -1));
}

TEST(fields_have_names) {
  ck_assert_str_eq(carom_field_name(0), "a.r[0]");
  ck_assert_str_eq(carom_field_name(11), "a.mu_slide");
  ck_assert_str_eq(carom_field_name(12), "b.r[0]");
  ck_assert_str_eq(carom_field_name(20), "b.w[2]");
  ck_assert_str_eq(carom_field_name(25), "restitution");
  ck_assert_ptr_null(carom_field_name(26));
  ck_assert_ptr_null(carom_field_name(-1));
  ck_assert_str_eq(carom_cushion_field_name(8), "height");
  ck_assert_ptr_null(carom_cushion_field_name(15));
  ck_assert_ptr_null(carom_cushion_field_name(-1));
  ck_assert_str_eq(carom_word(CAROM_WORDS_CUSHION_MODEL, CAROM_CUSHION_STRONGE), "stronge");
  ck_assert_ptr_null(carom_word(CAROM_WORDS_CUSHION_MODEL, 9));
}

TEST(version_is_that_of_the_header) {
  char expected[32];
  snprintf(expected, sizeof expected, "%d.%d.%d", CAROM_VERSION_MAJOR, CAROM_VERSION_MINOR,
           CAROM_VERSION_PATCH);
  ck_assert_str_eq(carom_version(), expected);
  ck_assert_int_eq(carom_version_number(), CAROM_VERSION_NUMBER);
  ck_assert_int_eq(carom_serves(CAROM_VERSION_NUMBER), 1);
  ck_assert_int_eq(carom_serves(CAROM_VERSION_NUMBER + 100), 0);   /* a later minor version */
  ck_assert_int_eq(carom_serves(CAROM_VERSION_NUMBER + 10000), 0); /* a later major one */
  ck_assert_int_eq(carom_serves(-1), 0);
}

/* What the library finds out about the processor is what the compiler's run-time library does;
 * zig's does not. */
TEST(the_processor_is_known) {
#if defined(__x86_64__)
  __builtin_cpu_init();
#ifndef CAROM_WITHOUT_AVX2
  ck_assert_int_eq(carom_isa_available(CAROM_ISA_AVX2),
                   __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
#endif
#ifndef CAROM_WITHOUT_AVX512
  ck_assert_int_eq(carom_isa_available(CAROM_ISA_AVX512), __builtin_cpu_supports("avx512f") &&
                                                              __builtin_cpu_supports("avx512dq") &&
                                                              __builtin_cpu_supports("avx512vl"));
#endif
#endif
}

/* The environment limits the instruction set by its name, which is read anew when the limit of
 * the process is lifted. */
TEST(the_environment_limits_the_instruction_set) {
  const char *given = getenv("CAROM_ISA");
  carom_isa below = CAROM_ISA_PLAIN; /* the best of those up to this one */
  for (int isa = 0; isa < CAROM_ISA_COUNT; isa++) {
    below = carom_isa_available((carom_isa)isa) ? (carom_isa)isa : below;
    setenv("CAROM_ISA", carom_word(CAROM_WORDS_ISA, isa), 1);
    ck_assert_int_eq(carom_isa_limit(CAROM_ISA_ANY), below);
    ck_assert_int_eq(carom_isa_in_force(), below);
  }
  setenv("CAROM_ISA", "none of them", 1);
  ck_assert_int_eq(carom_isa_limit(CAROM_ISA_ANY), below);
  unsetenv("CAROM_ISA");
  ck_assert_int_eq(carom_isa_limit(CAROM_ISA_ANY), below);
  if (given != NULL)
    setenv("CAROM_ISA", given, 1);
}
