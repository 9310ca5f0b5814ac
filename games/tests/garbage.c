/* Garbage is rejected. Every public function is called with arguments that are right, and then with
 * each of them wrong in turn: NULL, numbers that are none, counts and indices out of range. A
 * status says so; functions without one only have to return. Then numbers of structs: NaN and those
 * next to the range. The sanitizers' build looks for undefined behaviour.
 *
 * The list of functions is that of packaging/tests/abi-MINOR.expected, so that none is forgotten.
 * */
#define _POSIX_C_SOURCE 200809L
#include "functions.h"

#include <sys/wait.h>
#include <unistd.h>

/* Calls one function with all its garbage; returns how many calls were wrong. */
static int call_with_garbage(int f) {
  int wrong = 0;
  wrong_argument = -1;
  argument = 0;
  set_up();
  const int64_t right = functions[f].call();
  if (right < 0 && ++wrong)
    printf("%s: refuses arguments that are right: %s\n", functions[f].name,
           carom_status_name((carom_status)right));
  const int arguments = argument;
  for (wrong_argument = 0; wrong_argument < arguments; wrong_argument++)
    for (value_index = 0, value_count = 1; value_index < value_count; value_index++) {
      argument = 0;
      set_up();
      must_be_refused = has_null = false;
      const int64_t told = functions[f].call();
      if ((has_null ? told != CAROM_ERROR_NULL : must_be_refused && told >= 0) && ++wrong)
        printf("%s: takes wrong argument %d, value %d\n", functions[f].name, wrong_argument,
               value_index);
    }
  fflush(stdout);
  return wrong;
}

TEST(every_function_refuses_garbage) {
  int wrong = 0;
  for (int f = 0; f < COUNT; f++) {
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0)
      _exit(call_with_garbage(f) > 0);
    int ended = 0;
    ck_assert_int_eq(waitpid(child, &ended, 0), child);
    if (!WIFEXITED(ended) || WEXITSTATUS(ended) > 1)
      printf("%s: crashes on garbage\n", functions[f].name);
    wrong += !WIFEXITED(ended) || WEXITSTATUS(ended) != 0;
  }
  fflush(stdout);
  ck_assert_int_eq(wrong, 0);
}

TEST(no_function_is_forgotten) {
  FILE *f = fopen(CAROM_ABI_FILE, "r");
  char line[200], name[200];
  int exported = 0;
  ck_assert_ptr_nonnull(f);
  while (fgets(line, sizeof line, f) != NULL) {
    if (sscanf(line, "exported: %199s", name) != 1)
      continue;
    int k = 0;
    while (k < COUNT && strcmp(functions[k].name, name) != 0)
      k++;
    ck_assert_msg(k < COUNT, "core/tests/unit/calls.h does not call %s", name);
    exported++;
  }
  fclose(f);
  ck_assert_int_eq(exported, COUNT);
}

/* ---- Numbers of structs */

/* Each number beyond its range, in addition to those of shot_input.c and bad_input.c. */
TEST(numbers_of_plans_and_measures) {
  const carom_number *row;
  for (int k = 0; (row = carom_number_of(CAROM_PART_PLAN_OPTIONS, k)) != NULL; k++)
    for (int way = 0; set_up(), set_bad(&plan_options, row, way); way++)
      ck_assert_msg(carom_plan_memory(&plan_options) == 0, "%s, way %d", row->name, way);
  for (int k = 0; (row = carom_number_of(CAROM_PART_MEASURES, k)) != NULL; k++)
    for (int way = 0; set_up(), set_bad(&measures, row, way); way++)
      ck_assert_msg(carom_table_measured(&measures, radius, &table, NULL) < 0, "%s, way %d",
                    row->name, way);
}

/* Indices and counts in structs that a caller fills. */
TEST(counts_and_indices_of_structs) {
  for (int n = 0; n < 4; n++) {
    const int bad = wrong_integers[n];
    set_up();
    int64_t *const counts[] = {&table.rails, &table.jaws, &table.pockets};
    for (int k = 0; k < 3; k++) {
      const int64_t kept = *counts[k];
      *counts[k] = bad;
      ck_assert_int_lt(carom_table_check(&table, 0.028575, NULL), 0);
      ck_assert_int_lt(carom_shoot(&table, balls, BALLS, &cue, NULL, &shot), 0);
      *counts[k] = kept;
    }
    cue.ball = bad;
    ck_assert_int_lt(carom_shoot(&table, balls, BALLS, &cue, NULL, &shot), 0);
    pot.ball = bad;
    ck_assert_int_lt(carom_aim(&table, balls, BALLS, NULL, &pot, &aimed), 0);
    pot.ball = 1;
    whole();
    for (int kind_of = 0; carom_rules_about_of((carom_rules_kind)kind_of) != NULL; kind_of++) {
      rules = carom_plan_rules_of((carom_rules_kind)kind_of);
      for (int k = 0; k < 2; k++) {
        const int kept = facts.first[k];
        facts.first[k] = bad;
        const carom_status told =
            carom_referee(&rules, &table, balls, BALLS, 0, &shot, (carom_call){1, 1}, &ruling);
        ck_assert(told < 0 || bad == -1);
        carom_foul_of(&facts, 2, 0);
        carom_stroke_marks(&facts, 0);
        facts.first[k] = kept;
      }
    }
  }
}

TEST(a_rating_without_games_is_that_of_the_header) {
  expect_ok(carom_rating_of(NULL, 0, &rating));
  ck_assert_double_eq_tol(rating.mean, 426.0, 0.5);
  ck_assert_int_eq(rating.row, -1);
}
