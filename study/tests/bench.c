/* The benchmark's engine: statistics on made-up samples, turns and figures under a clock that
 * the test turns by hand. Nothing here asserts a real time. */
#include "machine.h"
#include "pinning.h"
#include "program/monotonic.h"
#include "rounds.h"
#include "support.h"

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

/* A machine made of a number: its clock only advances while a subject works. */
static double made_up_now;
static char order[64];
static size_t ordered;

typedef struct made_up {
  char name;
  double cost; /* ns for the workload */
  int changes; /* how often its results will still change */
} made_up;

static double now_made_up(void) {
  return made_up_now;
}

static void work_made_up(void *context) {
  made_up *m = context;
  made_up_now += m->cost;
  m->changes -= m->changes > 0;
  if (ordered + 1 < sizeof order && (ordered == 0 || order[ordered - 1] != m->name))
    order[ordered++] = m->name;
}

static uint64_t fingerprint_made_up(const void *context) {
  return (uint64_t)((const made_up *)context)->changes;
}

static bench_subject subject_of(made_up *m, size_t reference) {
  return (bench_subject){.context = m,
                         .resolve = work_made_up,
                         .fingerprint = fingerprint_made_up,
                         .pairs = 10,
                         .threads = 1,
                         .reference = reference};
}

TEST(turns_and_figures) {
  made_up slow = {.name = 'A', .cost = 1e6}, fast = {.name = 'B', .cost = 2.5e5, .changes = 50};
  const bench_subject subjects[] = {subject_of(&slow, 0), subject_of(&fast, 0),
                                    subject_of(&fast, SIZE_MAX)};
  bench_figure figure[3];
  const bench_settings settings = {.budget = 1.0, .clock = now_made_up};
  bench_rounds(subjects, 3, &settings, figure);
  ck_assert_double_eq_tol(figure[0].ns.median, 1e5, 1e-3);
  ck_assert_double_eq_tol(figure[1].ns.median, 2.5e4, 1e-3);
  ck_assert_double_eq_tol(figure[0].speedup.median, 1.0, 1e-12);
  ck_assert_double_eq_tol(figure[1].speedup.median, 4.0, 1e-6);
  ck_assert(isnan(figure[2].speedup.median)); /* without a reference */
  ck_assert_uint_ge(figure[1].ns.count, 81);
  ck_assert_uint_eq(figure[1].ns.count % 2, 1);
  ck_assert_uint_ge(figure[1].loops, 4);
  ck_assert(figure[0].unchanged && !figure[1].unchanged);
  ck_assert(strncmp(order, "ABABABAB", 8) == 0);
  ck_assert(made_up_now > 0.8e9 && made_up_now < 1.01e9);
}

/* What slows both in a round, as a clock that falls does, is hardly in their ratio. */
static void work_slower(void *context) {
  made_up_now += ((made_up *)context)->cost * (1.0 + fmod(made_up_now, 4e9) / 4e9);
}

/* A core cycle of that clock, 0.25 ns at its fastest. */
static double cycle_made_up(void) {
  return 0.25 * (1.0 + fmod(made_up_now, 4e9) / 4e9);
}

TEST(ratios_cancel_what_slows_both) {
  made_up slow = {.cost = 4e6}, fast = {.cost = 2e6};
  bench_subject subjects[] = {subject_of(&slow, 0), subject_of(&fast, 0)};
  subjects[0].resolve = subjects[1].resolve = work_slower;
  bench_figure figure[2];
  bench_settings settings = {.budget = 8.0, .clock = now_made_up, .processor = now_made_up};
  bench_rounds(subjects, 2, &settings, figure);
  ck_assert(isnan(figure[0].core_cycles));
  settings.cycle = cycle_made_up;
  bench_rounds(subjects, 2, &settings, figure);
  const double cycles = 4e6 / 0.25 / (double)subjects[0].pairs;
  ck_assert_double_eq_tol(figure[0].core_cycles / cycles, 1.0, 0.04);
  ck_assert_double_eq_tol(figure[1].core_cycles / cycles, 0.5, 0.02);
  ck_assert_double_gt(figure[1].ns.spread, 0.1 * figure[1].ns.median);
  ck_assert_double_eq_tol(figure[1].speedup.median, 2.0, 0.04);
  ck_assert_double_lt(figure[1].speedup.spread, 0.01);
}

/* Other programs take half of the time, so the processor's clock advances half as fast. */
static double processor_shared(void) {
  return 0.5 * made_up_now;
}

static double cycle_of_1_ns(void) {
  return 1.0;
}

TEST(cycles_are_of_processor_time) {
  made_up one = {.cost = 4e6};
  bench_subject subjects[] = {subject_of(&one, SIZE_MAX), subject_of(&one, SIZE_MAX)};
  subjects[1].threads = 2;
  bench_figure figure[2];
  const bench_settings settings = {
      .budget = 1.0, .clock = now_made_up, .processor = processor_shared, .cycle = cycle_of_1_ns};
  bench_rounds(subjects, 2, &settings, figure);
  const double pairs = (double)subjects[0].pairs;
  ck_assert_double_eq_tol(figure[0].ns.median, 4e6 / pairs, 1e-3);
  ck_assert_double_eq_tol(figure[0].core_cycles, 2e6 / pairs, 1e-3);
  ck_assert(isnan(figure[1].core_cycles)); /* the thread that waits has no time of the others */
}

TEST(budget_too_small_for_one_round) {
  made_up slow = {.name = 'A', .cost = 1e9};
  const bench_subject subject = subject_of(&slow, 0);
  bench_figure figure;
  const bench_settings settings = {.budget = 0.5, .clock = now_made_up};
  bench_rounds(&subject, 1, &settings, &figure);
  ck_assert_uint_eq(figure.ns.count, 5);
  ck_assert_uint_eq(figure.loops, 1);
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
