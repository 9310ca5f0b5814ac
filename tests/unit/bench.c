/* The benchmark's engine: statistics on made-up samples, turns and figures under a clock that
 * the test turns by hand. Nothing here asserts a real time. */
#include "machine.h"
#include "monotonic.h"
#include "pinning.h"
#include "rounds.h"
#include "statistics.h"
#include "support.h"

#include <math.h>
#include <string.h>

TEST(summaries) {
  double odd[] = {5.0, 1.0, 100.0, 3.0, 4.0};
  sample_summary s = summarise(odd, 5);
  ck_assert_uint_eq(s.count, 5);
  ck_assert_double_eq(s.median, 4.0);
  ck_assert_double_eq(s.min, 1.0);
  ck_assert_double_eq(s.max, 100.0);
  ck_assert_double_eq(s.spread, 1.0); /* of 3 1 0 1 96 */
  double even[] = {1.0, 2.0, 4.0, 8.0};
  s = summarise(even, 4);
  ck_assert_double_eq(s.median, 3.0);
  ck_assert_double_eq(s.spread, 1.5); /* of 1 1 2 5 */
  double one[] = {7.0};
  s = summarise(one, 1);
  ck_assert_double_eq(s.median, 7.0);
  ck_assert_double_eq(s.spread, 0.0);
  ck_assert(isnan(summarise(one, 0).median));
  double unknown[] = {1.0, NAN, 2.0};
  s = summarise(unknown, 3);
  ck_assert(isnan(s.median) && isnan(s.min) && isnan(s.max) && isnan(s.spread));
}

TEST(ratios_cancel_what_slows_both) {
  const double reference[] = {20.0, 40.0, 20.0, 60.0}, other[] = {10.0, 20.0, 10.0, 30.0};
  double scratch[4];
  const sample_summary s = summarise_ratios(reference, other, 4, scratch);
  ck_assert_double_eq(s.median, 2.0);
  ck_assert_double_eq(s.spread, 0.0);
  ck_assert_double_eq(reference[1], 40.0);
}

/* A machine made of a number: its clock stands still but while a subject works. */
static double made_up_now;
static char order[64];
static size_t ordered;

typedef struct made_up {
  char name;
  double cost, call; /* ns for the workload; for its empty calls */
  uint64_t result;
} made_up;

static double now_made_up(void) {
  return made_up_now;
}

static void work_made_up(void *context) {
  made_up *m = context;
  made_up_now += m->cost + m->call;
  if (ordered + 1 < sizeof order && (ordered == 0 || order[ordered - 1] != m->name))
    order[ordered++] = m->name;
}

static void empty_made_up(void *context) {
  made_up_now += ((made_up *)context)->call;
}

static uint64_t fingerprint_made_up(const void *context) {
  return ((const made_up *)context)->result;
}

static bench_subject subject_of(made_up *m, size_t reference) {
  return (bench_subject){.threads = 1,
                         .pairs = 10,
                         .resolve = work_made_up,
                         .empty = empty_made_up,
                         .fingerprint = fingerprint_made_up,
                         .context = m,
                         .verified = 42,
                         .reference = reference};
}

TEST(turns_and_figures) {
  made_up slow = {.name = 'A', .cost = 1e6, .call = 100.0, .result = 42};
  made_up fast = {.name = 'B', .cost = 2.5e5, .call = 100.0, .result = 43};
  const bench_subject subjects[] = {subject_of(&slow, 0), subject_of(&fast, 0),
                                    subject_of(&fast, SIZE_MAX)};
  bench_figure figure[3];
  ordered = 0;
  const bench_settings settings = {.budget = 1.0, .now = now_made_up};
  ck_assert(bench_rounds(subjects, 2, &settings, figure));
  ck_assert_double_eq_tol(figure[0].ns.median, 1e5, 1e-3);
  ck_assert_double_eq_tol(figure[1].ns.median, 2.5e4, 1e-3);
  ck_assert_double_eq_tol(figure[1].empty_ns, 10.0, 1e-6);
  ck_assert_double_eq_tol(figure[0].speedup.median, 1.0, 1e-12);
  ck_assert_double_eq_tol(figure[1].speedup.median, 4.0, 1e-6);
  ck_assert_uint_eq(figure[1].ns.count, 101);
  ck_assert_uint_ge(figure[1].loops, 4);
  ck_assert(figure[0].unchanged);
  ck_assert(!figure[1].unchanged);
  ck_assert(strncmp(order, "ABABABAB", 8) == 0);
  ck_assert_double_le(made_up_now, 1.1e9);
  ck_assert(bench_rounds(subjects, 3, &settings, figure));
  ck_assert(isnan(figure[2].speedup.median)); /* without a reference */
}

TEST(budget_too_small_for_one_round) {
  made_up slow = {.name = 'A', .cost = 1e9, .call = 0.0, .result = 42};
  const bench_subject subject = subject_of(&slow, 0);
  bench_figure figure;
  const bench_settings settings = {.budget = 0.5, .now = now_made_up};
  ck_assert(bench_rounds(&subject, 1, &settings, &figure));
  ck_assert_uint_eq(figure.ns.count, 5);
  ck_assert_uint_eq(figure.loops, 1);
}

TEST(fingerprints) {
  double numbers[] = {1.0, 2.0, 3.0};
  const uint64_t before = bench_fingerprint(numbers, sizeof numbers);
  ck_assert_uint_eq(bench_fingerprint(numbers, sizeof numbers), before);
  numbers[2] = nextafter(3.0, 4.0);
  ck_assert_uint_ne(bench_fingerprint(numbers, sizeof numbers), before);
}

TEST(clocks_go_forward) {
  const double before = clock_ns(), cycle = clock_core_cycle();
  ck_assert_double_gt(clock_ns(), before);
#if defined(__x86_64__) || defined(__aarch64__)
  ck_assert(cycle > 0.1 && cycle < 20.0); /* from 10 GHz down to an emulator's */
#else
  ck_assert(isnan(cycle));
#endif
}

TEST(pinning_says_what_it_reached) {
  const char *text = pinning_begin();
  ck_assert(strstr(text, "pinned") != NULL);
  pinning_suspend();
  pinning_resume();
  pinning_end();
  pinning_resume(); /* nothing is pinned any more */
}
