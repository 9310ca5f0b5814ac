/* Hardware counters: the table of events, which processor has which, and the whole path by events
 * that Linux counts by itself, so that it is tested in virtual machines too. The system call is
 * wrapped, to reject, and to be a processor that holds two events at a time. */
#define _GNU_SOURCE /* MAP_ANONYMOUS, madvise() */
#include "counters.h"
#include "rounds.h"
#include "support.h"

#include <errno.h>
#include <linux/perf_event.h>
#include <stdarg.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { PAGES = 16, PAIRS = 4 };

long __real_syscall(long number, ...);
long __wrap_syscall(long number, ...);

static int refusal;    /* errno of every call; 0: none */
static int group_size; /* events that fit into a group; 0: any number */
static int last_leader, last_siblings;

long __wrap_syscall(long number, ...) {
  va_list arguments;
  va_start(arguments, number);
  struct perf_event_attr *attributes = va_arg(arguments, struct perf_event_attr *);
  const int process = va_arg(arguments, int), core = va_arg(arguments, int);
  const int leader = va_arg(arguments, int);
  const unsigned long flags = va_arg(arguments, unsigned long);
  va_end(arguments);
  ck_assert_int_eq(number, SYS_perf_event_open);
  errno = refusal;
  if (refusal != 0)
    return -1;
  if (leader != last_leader)
    last_siblings = 0;
  last_leader = leader;
  errno = EINVAL;
  if (leader >= 0 && group_size > 0 && ++last_siblings >= group_size)
    return -1;
  return __real_syscall(number, attributes, process, core, leader, flags);
}

/* The faults of pages are known, except for a few of the program itself, mostly of sanitizers. */
static const counter_row software[] = {
    {CORE_ANY, COUNTER_CYCLES, "task clock", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK, 1.0},
    {CORE_ANY, COUNTER_INSTRUCTIONS, "page faults", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS,
     1.0},
    {CORE_ANY, COUNTER_FLOPS, "page faults", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS, 1.0},
    {CORE_ANY, COUNTER_FLOPS, "page faults", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS_MIN,
     4.0},
    {CORE_ZEN2, COUNTER_FMA, "another core's", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS, 1.0},
};
enum { SOFTWARE = COUNT_OF(software) };

/* Are there such events? A container may forbid them. */
static bool has_software_events(void) {
  counter_set *set = counters_open(software, SOFTWARE, CORE_UNKNOWN);
  const bool has = counters_events(set) > 0;
  if (!has) {
    fputs("skipped: counters of software are not allowed here: ", stdout);
    counters_describe(set, stdout);
    putchar('\n');
  }
  counters_close(set);
  return has;
}

static void touch_pages(void *context) {
  (void)context;
  const size_t page = (size_t)sysconf(_SC_PAGESIZE);
  volatile char *memory =
      mmap(NULL, PAGES * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ck_assert(memory != MAP_FAILED);
  madvise((void *)memory, PAGES * page, MADV_NOHUGEPAGE);
  for (size_t k = 0; k < PAGES; k++)
    memory[k * page] = 1;
  munmap((void *)memory, PAGES * page);
}

static uint64_t no_fingerprint(const void *context) {
  (void)context;
  return 0;
}

static void bench(const counter_set *set, int threads, bench_figure *figure) {
  const bench_subject subject = {.resolve = touch_pages,
                                 .fingerprint = no_fingerprint,
                                 .pairs = PAIRS,
                                 .threads = threads,
                                 .reference = SIZE_MAX};
  const bench_settings settings = {.budget = 0.05, .counters = set};
  bench_rounds(&subject, 1, &settings, figure);
  ck_assert_double_gt(figure->ns.median, 0.0);
}

/* A new text, to be freed. */
static char *description(const counter_set *set) {
  char *text = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&text, &size);
  counters_describe(set, to);
  fclose(to);
  return text;
}

/* ---- The table */

TEST(table_is_well_formed) {
  unsigned cores_of[COUNTER_COLUMNS] = {0};
  for (size_t k = 0; k < counter_table_size; k++) {
    const counter_row *row = &counter_table[k];
    ck_assert_uint_ne(row->cores, 0);
    ck_assert_uint_eq(row->cores & ~(unsigned)CORE_ANY, 0);
    ck_assert_int_lt(row->column, COUNTER_COLUMNS);
    ck_assert_double_gt(row->weight, 0.0);
    ck_assert_ptr_null(strpbrk(row->name, ";\n")); /* a note separates by ; */
    /* raw codes are a processor's own */
    ck_assert((row->type == PERF_TYPE_HARDWARE) == (row->cores == CORE_ANY));
    ck_assert((row->cores & CORE_UNKNOWN) == 0 || row->type == PERF_TYPE_HARDWARE);
    for (size_t j = 0; j < k; j++)
      ck_assert_msg((row->cores & counter_table[j].cores) == 0 ||
                        row->type != counter_table[j].type || row->code != counter_table[j].code,
                    "%s and %s have the same code", row->name, counter_table[j].name);
    cores_of[row->column] |= row->cores;
  }
  for (int c = 0; c < COUNTER_COLUMNS; c++)
    ck_assert_msg(cores_of[c] != 0, "%s has no row", counter_column_name((counter_column)c));
  /* what the paper reads from a Zen 2 */
  for (int c = 0; c < COUNTER_STALLS_RESOURCES; c++)
    ck_assert_uint_ne(cores_of[c] & CORE_ZEN2, 0);
  /* AMD's stalls by resource, or Intel's by all of them together: never both */
  const unsigned intel = CORE_SKYLAKE + CORE_SKYLAKE_SERVER + CORE_ICE_LAKE + CORE_SAPPHIRE_RAPIDS;
  ck_assert_uint_eq(cores_of[COUNTER_STALLS_RESOURCES], intel);
  ck_assert_uint_eq(cores_of[COUNTER_STALLS_FP_SCHEDULER] & intel, 0);
}

TEST(cores_by_signature) {
  ck_assert_int_eq(counter_core_of("AuthenticAMD", 0x17, 0x71), CORE_ZEN2);
  ck_assert_int_eq(counter_core_of("AuthenticAMD", 0x17, 0x01), CORE_UNKNOWN); /* Zen 1 */
  ck_assert_int_eq(counter_core_of("AuthenticAMD", 0x19, 0x21), CORE_ZEN3);
  ck_assert_int_eq(counter_core_of("AuthenticAMD", 0x19, 0x11), CORE_ZEN4);
  ck_assert_int_eq(counter_core_of("AuthenticAMD", 0x19, 0x61), CORE_ZEN4);
  ck_assert_int_eq(counter_core_of("AuthenticAMD", 0x1a, 0x44), CORE_ZEN5);
  ck_assert_int_eq(counter_core_of("AuthenticAMD", 0x1a, 0x50), CORE_UNKNOWN); /* Zen 6 */
  ck_assert_int_eq(counter_core_of("GenuineIntel", 6, 0x9e), CORE_SKYLAKE);
  ck_assert_int_eq(counter_core_of("GenuineIntel", 6, 0x55), CORE_SKYLAKE_SERVER);
  ck_assert_int_eq(counter_core_of("GenuineIntel", 6, 167), CORE_ICE_LAKE);
  ck_assert_int_eq(counter_core_of("GenuineIntel", 6, 207), CORE_SAPPHIRE_RAPIDS);
  ck_assert_int_eq(counter_core_of("GenuineIntel", 6, 0x97), CORE_UNKNOWN); /* two kinds of cores */
  ck_assert_int_eq(counter_core_of("AuthenticAMD", 6, 0x55), CORE_UNKNOWN);
}

/* ---- Counting */

TEST(software_events_are_counted) {
  if (!has_software_events())
    return;
  counter_set *set = counters_open(software, SOFTWARE, CORE_UNKNOWN);
  ck_assert_uint_eq(counters_events(set), 4);
  bench_figure figure;
  bench(set, 1, &figure);
  ck_assert_double_eq_tol(figure.counted[COUNTER_INSTRUCTIONS], 1.0 * PAGES / PAIRS, 0.1);
  ck_assert_double_eq_tol(figure.counted[COUNTER_FLOPS], 5.0 * PAGES / PAIRS, 0.5);
  ck_assert_double_gt(figure.counted[COUNTER_CYCLES], 0.0);
  ck_assert(isnan(figure.counted[COUNTER_FMA]));
  char *text = description(set);
  ck_assert_ptr_nonnull(strstr(text, "cycles, instructions, flops counted"));
  ck_assert_ptr_nonnull(strstr(text, "fma"));
  ck_assert_ptr_nonnull(strstr(text, "no event of this processor"));
  free(text);

  /* another thread's work would be missed */
  bench(set, 2, &figure);
  for (int c = 0; c < COUNTER_COLUMNS; c++)
    ck_assert(isnan(figure.counted[c]));
  counters_close(set);
}

TEST(groups_take_turns) {
  if (!has_software_events())
    return;
  group_size = 2;
  counter_set *set = counters_open(software, SOFTWARE, CORE_UNKNOWN);
  group_size = 0;
  ck_assert_uint_eq(counters_events(set), 4);
  ck_assert_uint_eq(counters_groups(set), 2);
  bench_figure figure;
  bench(set, 1, &figure);
  ck_assert_double_eq_tol(figure.counted[COUNTER_INSTRUCTIONS], 1.0 * PAGES / PAIRS, 0.1);
  ck_assert_double_eq_tol(figure.counted[COUNTER_FLOPS], 5.0 * PAGES / PAIRS, 0.5);

  /* an event of the other group is not 0, but unknown */
  double count[4];
  counters_start(set, 1);
  touch_pages(NULL);
  counters_stop(set, 1, count);
  ck_assert(isnan(count[0]) && isnan(count[1]));
  ck_assert_double_ge(count[2], PAGES);
  ck_assert_double_lt(count[2], 2 * PAGES); /* a single count may have a few other faults */
  counters_close(set);
}

/* ---- Refusals */

TEST(refusals_have_reasons) {
  static const struct {
    int error;
    const char *words;
  } reasons[] = {{EACCES, "does not allow it"},
                 {EPERM, "kernel.perf_event_paranoid=2"},
                 {ENOENT, "virtual machines"},
                 {ENOSYS, "errno 38"}};
  for (size_t k = 0; k < COUNT_OF(reasons); k++) {
    refusal = reasons[k].error;
    counter_set *set = counters_open(counter_table, counter_table_size, CORE_ZEN2);
    refusal = 0;
    ck_assert_uint_eq(counters_events(set), 0);
    char *text = description(set);
    ck_assert_msg(strstr(text, reasons[k].words) != NULL, "%s", text);
    ck_assert_ptr_nonnull(strstr(text, "cycles, instructions, flops"));
    ck_assert_ptr_nonnull(strstr(text, "perf_event_paranoid"));
    ck_assert_ptr_null(strstr(text, "counted per collision"));
    free(text);
    bench_figure figure; /* the clock continues */
    bench(set, 1, &figure);
    for (int c = 0; c < COUNTER_COLUMNS; c++)
      ck_assert(isnan(figure.counted[c]));
    counters_close(set);
  }
}

/* A column that lacks one of its events is no sum of the others. */
TEST(part_of_a_column_is_unknown) {
  if (!has_software_events())
    return;
  counter_row rows[] = {software[2], software[3]};
  rows[1].code = PERF_COUNT_SW_MAX + 1000;
  counter_set *set = counters_open(rows, 2, CORE_UNKNOWN);
  ck_assert_uint_eq(counters_events(set), 1);
  bench_figure figure;
  bench(set, 1, &figure);
  ck_assert(isnan(figure.counted[COUNTER_FLOPS]));
  counters_close(set);
}
