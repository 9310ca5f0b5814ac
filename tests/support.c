/* What several tests share. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#endif
#include "support.h"

#include <sys/mman.h>
#include <unistd.h>

static const double pi = 3.14159265358979323846;

uint64_t test_seed(void) {
  static uint64_t seed;
  if (seed == 0) {
    const char *given = getenv("CAROM_TEST_SEED");
    seed = given != NULL ? strtoull(given, NULL, 10) : 20141;
    printf("seed %llu (replay with CAROM_TEST_SEED)\n", (unsigned long long)seed);
    fflush(stdout);
  }
  return seed;
}

int draws_of_test(int usual, int before_release) {
  const char *const chosen = getenv("CAROM_TEST_DRAWS");
  if (chosen != NULL && atoi(chosen) > 0)
    return atoi(chosen);
  return FEWER(getenv("CAROM_RELEASE") != NULL ? before_release : usual);
}

int draws_within(int usual, int before_release) {
  const int draws = draws_of_test(usual, before_release);
  return draws < before_release ? draws : before_release;
}

/* splitmix64 */
static uint64_t random_bits(random_source *source) {
  uint64_t z = source->state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double random_between(random_source *source, double low, double high) {
  return low + (high - low) * (double)(random_bits(source) >> 11) * 0x1p-53;
}

void random_vector(random_source *source, int count, double low, double high, double *vector) {
  for (int k = 0; k < count; k++)
    vector[k] = random_between(source, low, high);
}

static carom_ball random_ball(random_source *source) {
  const double speed = pow(10.0, random_between(source, -2.0, 1.0)),
               way = random_between(source, 0.0, 2.0 * pi);
  carom_ball ball = {
      .r = {random_between(source, 0.0, 1.0), random_between(source, 0.0, 2.0), 0.03},
      .v = {speed * cos(way), speed * sin(way), 0.0},
      .radius = 0.028575,
      .mass = 0.17,
      .mu_slide = random_between(source, 0.0, 0.5)};
  for (int k = 0; k < 3; k++)
    ball.w[k] = random_between(source, -1.0, 1.0) * speed / ball.radius;
  return ball;
}

carom_impact random_impact(random_source *source) {
  carom_impact in = {.a = random_ball(source),
                     .b = random_ball(source),
                     .mu_ball = random_between(source, 0.0, 0.2),
                     .restitution = random_between(source, 0.5, 1.0)};
  const double way = random_between(source, 0.0, 2.0 * pi);
  const double y[2] = {cos(way), sin(way)};
  in.b.r[0] = in.a.r[0] + 2.0 * in.a.radius * y[0];
  in.b.r[1] = in.a.r[1] + 2.0 * in.a.radius * y[1];
  const double v_n = (in.b.v[0] - in.a.v[0]) * y[0] + (in.b.v[1] - in.a.v[1]) * y[1];
  if (v_n > 0.0) /* turn both balls round */
    for (int k = 0; k < 2; k++) {
      in.a.v[k] = -in.a.v[k];
      in.b.v[k] = -in.b.v[k];
    }
  return in;
}

carom_cushion_impact random_cushion(random_source *source) {
  carom_cushion_impact in = {.normal = {0.0, 1.0},
                             .height = 0.0365,
                             .radius = 0.028575,
                             .mass = 0.17,
                             .mu_slide = 0.2,
                             .mu_cushion = 0.2,
                             .restitution = 0.85};
  in.v[0] = random_between(source, -3.0, 3.0);
  in.v[1] = random_between(source, 0.1, 3.0);
  for (int c = 0; c < 3; c++)
    in.w[c] = random_between(source, -99.0, 99.0);
  return in;
}

carom_impact_f32 narrowed(const carom_impact *in) {
  carom_impact_f32 out;
  for (int c = 0; c < 26; c++)
    ((float *)&out)[c] = (float)((const double *)in)[c];
  return out;
}

static void widen(const float *from, double *to, int n) {
  for (int c = 0; c < n; c++)
    to[c] = from[c];
}

carom_impact widened(const carom_impact_f32 *in) {
  carom_impact out;
  widen((const float *)in, (double *)&out, 26);
  return out;
}

carom_result widened_result(const carom_result_f32 *out) {
  carom_result wide;
  widen((const float *)out, (double *)&wide, 12);
  return wide;
}

int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

double result_distance(const carom_result *a, const carom_result *b, double radius) {
  const double *x = (const double *)a, *y = (const double *)b;
  double scale = 0.0, worst = 0.0;
  for (int k = 0; k < 12; k++) {
    const double weight = k / 3 % 2 == 1 ? radius : 1.0;
    scale = fmax(scale, weight * fabs(y[k]));
    worst = x[k] == y[k] ? worst : fmax(worst, weight * fabs(x[k] - y[k]));
    if (isnan(x[k]) != isnan(y[k]))
      return INFINITY;
  }
  return worst == 0.0 ? 0.0 : worst / scale;
}

edge edge_make(size_t size, bool odd) {
  const size_t page = (size_t)sysconf(_SC_PAGESIZE), whole = (size + page - 1) / page * page;
  edge e = {0};
  if (odd) {
    e.base = malloc(size + 8);
    ck_assert_ptr_nonnull(e.base);
    e.memory = (char *)e.base + 8;
    return e;
  }
  e.size = whole + page;
  e.base = mmap(NULL, e.size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ck_assert_ptr_ne(e.base, MAP_FAILED);
  ck_assert_int_eq(mprotect((char *)e.base + whole, page, PROT_NONE), 0);
  e.memory = (char *)e.base + whole - size;
  return e;
}

void edge_free(const edge *e) {
  if (e->size == 0)
    free(e->base);
  else
    munmap(e->base, e->size);
}

static int run(const char *name, TCase *tcase, enum fork_status fork) {
  Suite *suite = suite_create(name);
  suite_add_tcase(suite, tcase);
  SRunner *runner = srunner_create(suite);
  srunner_set_fork_status(runner, fork);
  srunner_run_all(runner, CK_NORMAL);
  const int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? 0 : 1;
}

uint64_t hash_of(uint64_t h, const void *bytes, size_t size) {
  for (size_t k = 0; k < size; k++)
    h = (h ^ ((const unsigned char *)bytes)[k]) * UINT64_C(0x100000001b3);
  return h;
}

/* Of element `at` where it is an array. */
static void put_number(void *to, const carom_number *n, int at, double x) {
  const size_t sizes[] = {sizeof(double), sizeof(int32_t), sizeof(int64_t), sizeof(uint64_t)};
  const int64_t whole = (int64_t)(n->type == CAROM_TYPE_DOUBLE ? 0 : x);
  const int32_t half = (int32_t)(n->type == CAROM_TYPE_INT32 ? x : 0);
  const void *from = n->type == CAROM_TYPE_INT32 ? (const void *)&half : &whole;
  if (n->type == CAROM_TYPE_DOUBLE)
    from = &x;
  memcpy((char *)to + (size_t)n->offset + (size_t)at * sizes[n->type], from, sizes[n->type]);
}

bool set_bad(void *to, const carom_number *n, int way) {
  const bool whole = n->type != CAROM_TYPE_DOUBLE;
  const double most = n->type == CAROM_TYPE_INT32 ? INT32_MAX : 0x1p63;
  const double beyond[] = {whole ? n->low - 1 : nextafter(n->low, -INFINITY),
                           whole ? n->high + 1 : nextafter(n->high, INFINITY), NAN};
  for (int k = 0; k < 3 * n->count; k++) {
    const int side = k % 3;
    const bool none =
        whole && (side == 2 || (side == 0 && n->type == CAROM_TYPE_UINT64) || beyond[side] >= most);
    if (!none && beyond[side] != n->other && way-- == 0) {
      put_number(to, n, k / 3, beyond[side]);
      return true;
    }
  }
  return false;
}

int run_tests(const char *name, const TTest *const *tests, size_t count) {
  TCase *tcase = tcase_create(name);
  tcase_set_timeout(tcase, 0);
  for (size_t k = 0; k < count; k++)
    tcase_add_test(tcase, tests[k]);
  return run(name, tcase, CK_FORK_GETENV);
}

int run_looped(const char *name, const looped_test *tests, size_t count) {
  TCase *tcase = tcase_create(name);
  for (size_t k = 0; k < count; k++)
    tcase_add_loop_test(tcase, tests[k].test, 0, tests[k].times);
  return run(name, tcase, CK_NOFORK);
}

static TCase *added; /* those of TEST() */

void add_test(const TTest *test) {
  if (added == NULL)
    added = tcase_create("tests");
  tcase_set_timeout(added, 0);
  tcase_add_test(added, test);
}

__attribute__((weak)) int main(void) {
  return added == NULL ? 1 : run("tests", added, CK_FORK_GETENV);
}
