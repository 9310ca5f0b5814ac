/* What several tests share: random numbers with a seed, random collisions, running a suite, and
 * the headers of the C library that most tests use. */
#ifndef CAROM_TESTS_SUPPORT_H
#define CAROM_TESTS_SUPPORT_H

#include "carom_shot.h"
#include "platform/enumerations.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The interface of this version, which packaging/tests/abi compares with the library. */
#define TEXT_OF_VERSION(major, minor) #major "." #minor
#define ABI_OF_VERSION(major, minor) \
  CAROM_TEST_DATA "/../packaging/tests/abi-" TEXT_OF_VERSION(major, minor) ".expected"
#define CAROM_ABI_FILE ABI_OF_VERSION(CAROM_VERSION_MAJOR, CAROM_VERSION_MINOR)

/* The seed of this run: $CAROM_TEST_SEED, or a fixed one. Printed once, so that a failure can be
 * replayed. */
uint64_t test_seed(void);

/* 1 where the sanitizer of addresses or of threads is in, else 0. gcc and clang tell it in
 * different ways. */
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0
#endif

/* `count`, and a quarter of it where a sanitizer is in, which makes all slower: for sizes that
 * must be constant. */
#define FEWER(count) (SANITIZED ? ((count) + 3) / 4 : (count))

/* How many draws a random test makes: `usual` ones; before a release, where $CAROM_RELEASE is set,
 * `before_release`; or $CAROM_TEST_DRAWS. A quarter of the first two where a sanitizer is in. */
int draws_of_test(int usual, int before_release);

/* The same of a test that has room for so many as are made before a release: never more. */
int draws_within(int usual, int before_release);

/* Random numbers; each test starts its own from test_seed(). */
typedef struct random_source {
  uint64_t state;
} random_source;

/* Of two positions in the plane, m. */
static inline double distance(const double a[2], const double b[2]) {
  return hypot(a[0] - b[0], a[1] - b[1]);
}

/* The size of a vector in the plane. */
static inline double planar_size(const double a[2]) {
  return hypot(a[0], a[1]);
}

double random_between(random_source *source, double low, double high);

/* The same for each number of a vector. */
void random_vector(random_source *source, int count, double low, double high, double *vector);

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

/* A call that has a result. */
#define expect_ok(status) ck_assert_int_eq(status, CAROM_OK)

/* Each number of an array is within so much of that of another. */
#define NEAR_EACH(is, says, count, within)         \
  for (int k_near = 0; k_near < (count); k_near++) \
  ck_assert_double_eq_tol((is)[k_near], (says)[k_near], within)

/* A random approaching pair of real size: both balls may move and spin, in any direction and
 * with any friction up to the values of real balls. */
carom_impact random_impact(random_source *source);

/* A pool ball of any spin that meets a usual cushion along y. */
carom_cushion_impact random_cushion(random_source *source);

/* The same numbers in single precision, and those again in double. */
carom_impact_f32 narrowed(const carom_impact *in);
carom_impact widened(const carom_impact_f32 *in);
carom_result widened_result(const carom_result_f32 *out);

/* Compares two doubles, for qsort(). */
int by_size(const void *a, const void *b);

/* Largest difference of two results, times `radius` for angular velocities, over the largest
 * such value of `b`. */
double result_distance(const carom_result *a, const carom_result *b, double radius);

/* Memory that ends exactly: so that reading or writing past it is seen. With `odd` it is a block
 * of the exact size at a position that is aligned for double, not for a vector: the address
 * sanitizer sees what is beyond it. Else it ends at a page which may not be touched, so every
 * build does. */
typedef struct edge {
  void *memory, *base;
  size_t size; /* of what is mapped, 0 for a block */
} edge;

edge edge_make(size_t size, bool odd);
void edge_free(const edge *e);

/* A loop over the instruction sets that this processor has, each in force within. */
#define FOR_EACH_ISA(isa)                         \
  for (int isa = 0; isa < CAROM_ISA_COUNT; isa++) \
    if (carom_isa_available((carom_isa)isa) && carom_isa_limit((carom_isa)isa) == (carom_isa)isa)

/* TEST(name) { ... } is a test that main() of support.c runs. A program with a main() of its own
 * lists its tests. */
#define TEST(name)                                              \
  START_TEST(name);                                             \
  __attribute__((constructor)) static void name##_added(void) { \
    add_test(name);                                             \
  }                                                             \
  static void name##_fn(int _i CK_ATTRIBUTE_UNUSED)
void add_test(const TTest *test);

/* A test that runs for each index from 0 on. */
typedef struct looped_test {
  const TTest *test;
  int times;
} looped_test;

/* Runs tests in this process, so that later ones see what earlier ones left, and returns main's
 * exit code. */
int run_looped(const char *name, const looped_test *tests, size_t count);
#define RUN_LOOPED(name, tests) run_looped(name, tests, COUNT_OF(tests))

/* Runs one test case and returns main's exit code. */
int run_tests(const char *name, const TTest *const *tests, size_t count);

/* Continues an FNV-1a hash, h, over bytes. */
uint64_t hash_of(uint64_t h, const void *bytes, size_t size);

/* Sets a number, or one of an array, just beyond its range, in way 0, 1, ...; false where there is
 * no such way. */
bool set_bad(void *to, const carom_number *number, int way);
#define RUN_TESTS(name, ...)                           \
  run_tests(name, (const TTest *const[]){__VA_ARGS__}, \
            sizeof((const TTest *const[]){__VA_ARGS__}) / sizeof(const TTest *))

#endif
