/* Batches agree with single calls: every instruction set that the processor has, both precisions, every solver.
 *
 * Euler's method agrees bit for bit in double. What is computed otherwise in lanes than alone has a bound of its own in
 * `agreements`. All sizes from 0 to beyond three vectors are tried, with guards around every array, rows in error and rows of
 * junk between good ones, arrays that are not aligned, and any number of threads.
 */
#include "cases.h"
#include "regimes.h"
#include "support.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDEST = 16, MOST = 3 * WIDEST + 1, MANY = 20000 };

/* Allowed distance from a single call in double, relative to the pair's scale; 0 asks for the same bits. */
static const struct {
  double in_double, in_single;
} agreements[CAROM_SOLVER_COUNT] = {
    [CAROM_SOLVER_EXACT] = {1e-5, 2e-4},
    [CAROM_SOLVER_EULER] = {0.0, 2e-2},
};

typedef carom_impact make_row(random_source *source, size_t k);

static carom_impact good_row(random_source *source, size_t k) {
  (void)k;
  return random_impact(source);
}

/* Good rows, separating rows, and rows in which one of the 26 numbers is spoilt. */
static carom_impact mixed_row(random_source *source, size_t k) {
  static const double spoilt[] = {NAN, INFINITY, -INFINITY, -1.0, 0.0, 1e300, 1e-300, -0.0};
  carom_impact in = random_impact(source);
  double *number = (double *)&in;
  if (k % 3 == 1)
    number[(size_t)random_between(source, 0.0, 26.0)] = spoilt[(size_t)random_between(source, 0.0, 8.0)];
  if (k % 7 == 2)
    for (int c = 0; c < 3; c++) {
      in.a.v[c] = -in.a.v[c];
      in.b.v[c] = -in.b.v[c];
    }
  if (k % 11 == 5)
    in.a.mu_cloth = in.b.mu_cloth = in.mu_ball = 0.0;
  if (k % 13 == 6)
    memset(in.a.w, 0, sizeof in.a.w), memset(in.b.w, 0, sizeof in.b.w);
  if (k % 17 == 7)
    memset(in.b.v, 0, sizeof in.b.v), memset(in.b.w, 0, sizeof in.b.w);
  return in;
}

static carom_options options_for(int solver, int slip) {
  carom_options options = {0};
  options.solver = (carom_solver)solver;
  options.slip = (carom_slip)slip;
  options.steps = 200;
  options.threads = 1;
  return options;
}

static void expect_same_double(const carom_impact *in, const carom_options *options, const carom_result *seen, int status) {
  carom_result alone;
  ck_assert_int_eq(status, carom_collide(in, options, &alone));
  const double allowed = agreements[options->solver].in_double;
  if (allowed == 0.0 || status != CAROM_OK)
    for (int c = 0; c < 12; c++) {
      const double x = ((const double *)seen)[c], y = ((const double *)&alone)[c];
      ck_assert_msg(memcmp(&x, &y, sizeof x) == 0 || (isnan(x) && isnan(y)), "%s: component %d is %.17g, alone %.17g",
                    carom_isa_name(carom_isa_in_force()), c, x, y);
    }
  else
    ck_assert_double_le(result_distance(seen, &alone, in->a.radius), allowed);
}

/* Runs n rows through carom_collide_batch at an odd place in guarded arrays. */
static void expect_agreement(const carom_impact *in, size_t n, const carom_options *options) {
  unsigned char *in_bytes = malloc((n + 2) * sizeof *in), *out_bytes = malloc((n + 2) * sizeof(carom_result));
  int8_t *status = malloc(n + 2);
  memset(out_bytes, 0xA5, (n + 2) * sizeof(carom_result));
  memset(status, 0xA5, n + 2);
  carom_impact *from = (carom_impact *)(void *)(in_bytes + 8); /* aligned for double, not for a vector */
  carom_result *to = (carom_result *)(void *)(out_bytes + 8);
  memcpy(from, in, n * sizeof *in);
  const carom_status whole = carom_collide_batch(from, n, options, to, status + 1);
  carom_status first_error = CAROM_OK;
  for (size_t k = 0; k < n; k++) {
    expect_same_double(&in[k], options, &to[k], status[k + 1]);
    if (first_error == CAROM_OK && status[k + 1] < 0)
      first_error = status[k + 1];
  }
  ck_assert_int_eq(whole, first_error);
  for (size_t k = 0; k < 8; k++)
    ck_assert_uint_eq(out_bytes[k], 0xA5);
  for (size_t k = 8 + n * sizeof(carom_result); k < (n + 2) * sizeof(carom_result); k++)
    ck_assert_uint_eq(out_bytes[k], 0xA5);
  ck_assert_int_eq(status[0], (int8_t)0xA5);
  ck_assert_int_eq(status[n + 1], (int8_t)0xA5);
  free(in_bytes);
  free(out_bytes);
  free(status);
}

static void every_size(make_row *row) {
  carom_impact in[MOST] = {0};
  random_source source = {test_seed()};
  FOR_EACH_ISA(isa)
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
      for (size_t n = 0; n <= MOST; n++) {
        for (size_t k = 0; k < n; k++)
          in[k] = row(&source, k);
        const carom_options options = options_for(solver, slip);
        expect_agreement(in, n, &options);
      }
}

START_TEST(good_rows_at_every_size) {
  every_size(good_row);
}
END_TEST

START_TEST(mixed_rows_at_every_size) {
  every_size(mixed_row);
}
END_TEST

START_TEST(the_204_cases) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  FOR_EACH_ISA(isa)
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
      carom_options options = options_for(solver, slip);
      options.steps = 1000;
      expect_agreement(cases.impact, cases.count, &options);
    }
  cases_free(&cases);
}
END_TEST

static carom_impact_f32 to_single(const carom_impact *in) {
  carom_impact_f32 narrow;
  for (int k = 0; k < 26; k++)
    ((float *)&narrow)[k] = (float)((const double *)in)[k];
  return narrow;
}

START_TEST(single_precision_is_near) {
  random_source source = {test_seed()};
  carom_impact_f32 in[MOST];
  carom_result_f32 out[MOST + 1];
  int8_t status[MOST];
  FOR_EACH_ISA(isa)
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++)
    for (size_t n = 0; n <= MOST; n++) {
      const carom_options options = options_for(solver, CAROM_SLIP_PAPER);
      for (size_t k = 0; k < n; k++) {
        const carom_impact wide = n % 2 == 0 ? good_row(&source, k) : mixed_row(&source, k);
        in[k] = to_single(&wide);
      }
      memset(out, 0xA5, sizeof out);
      carom_collide_batch_f32(in, n, &options, out, status);
      for (size_t k = 0; k < n; k++) {
        carom_impact wide;
        carom_result alone, seen;
        carom_result_f32 alone_f32;
        for (int c = 0; c < 26; c++)
          ((double *)&wide)[c] = ((const float *)&in[k])[c];
        const carom_status expected = carom_collide_f32(&in[k], &options, &alone_f32);
        ck_assert_int_eq(status[k], expected);
        for (int c = 0; c < 12; c++)
          ((double *)&seen)[c] = ((const float *)&out[k])[c];
        if (expected == CAROM_OK && carom_collide(&wide, &options, &alone) == CAROM_OK)
          ck_assert_double_le(result_distance(&seen, &alone, wide.a.radius), agreements[solver].in_single);
        else
          ck_assert(expected == CAROM_SEPARATING || isnan(out[k].a.v[0]));
      }
      for (size_t k = 0; k < sizeof out[n]; k++)
        ck_assert_uint_eq(((unsigned char *)&out[n])[k], 0xA5);
    }
}
END_TEST

START_TEST(any_number_of_threads) {
  random_source source = {test_seed()};
  carom_impact *in = malloc(MANY * sizeof *in);
  carom_result *one = malloc(MANY * sizeof *one), *many = malloc(MANY * sizeof *many);
  int8_t *status_one = malloc(MANY), *status_many = malloc(MANY);
  for (size_t k = 0; k < MANY; k++)
    in[k] = mixed_row(&source, k);
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++) {
    carom_options options = options_for(solver, CAROM_SLIP_PAPER);
    options.steps = 50;
    const carom_status whole = carom_collide_batch(in, MANY, &options, one, status_one);
    for (options.threads = 0; options.threads <= 8; options.threads++) {
      const size_t n = options.threads % 2 == 0 ? MANY : MANY - 77;
      memset(many, 0xA5, MANY * sizeof *many);
      ck_assert_int_eq(carom_collide_batch(in, n, &options, many, status_many), whole);
      ck_assert_mem_eq(many, one, n * sizeof *one);
      ck_assert_mem_eq(status_many, status_one, n);
    }
  }
  free(in), free(one), free(many), free(status_one), free(status_many);
}
END_TEST

/* All regimes side by side: whoever its neighbours are, a row keeps its bits. */
START_TEST(neighbours_make_no_difference) {
  enum { EACH = 16 };
  const size_t n = (size_t)regimes_count() * EACH;
  carom_impact *in = malloc(n * sizeof *in), *turned = malloc(n * sizeof *turned);
  carom_result *out = malloc(n * sizeof *out), *back = malloc(n * sizeof *back);
  FOR_EACH_ISA(isa)
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
      const carom_options options = options_for(solver, slip);
      regimes_rng rng = {test_seed()};
      for (size_t k = 0; k < n; k++) {
        in[k] = regimes_draw((int)k % regimes_count(), slip == CAROM_SLIP_POOLTOOL ? 1.0 : -1.0, &rng);
        turned[n - 1 - k] = in[k];
      }
      carom_collide_batch(in, n, &options, out, NULL); /* some regimes are too slow for Euler: what counts is the rows */
      carom_collide_batch(turned, n, &options, back, NULL);
      for (size_t k = 0; k < n; k++)
        ck_assert_msg(memcmp(&out[k], &back[n - 1 - k], sizeof out[k]) == 0, "%s: row %zu of %s depends on its neighbours",
                      carom_isa_name((carom_isa)isa), k, regimes_name((int)k % regimes_count()));
    }
  free(in), free(turned), free(out), free(back);
}
END_TEST

typedef struct caller {
  const carom_impact *in;
  carom_result *out;
  carom_status whole;
} caller;

static void *call(void *argument) {
  caller *c = argument;
  carom_options options = {0};
  options.threads = 2;
  c->whole = carom_collide_batch(c->in, MANY, &options, c->out, NULL);
  return NULL;
}

START_TEST(many_callers_at_once) {
  enum { CALLERS = 4 };
  random_source source = {test_seed()};
  carom_impact *in = malloc(MANY * sizeof *in);
  caller each[CALLERS];
  pthread_t thread[CALLERS];
  for (size_t k = 0; k < MANY; k++)
    in[k] = random_impact(&source);
  for (int k = 0; k < CALLERS; k++) {
    each[k] = (caller){.in = in, .out = malloc(MANY * sizeof *each[k].out)};
    ck_assert_int_eq(pthread_create(&thread[k], NULL, call, &each[k]), 0);
  }
  for (int k = 0; k < CALLERS; k++) {
    ck_assert_int_eq(pthread_join(thread[k], NULL), 0);
    ck_assert_int_eq(each[k].whole, CAROM_OK);
    ck_assert_mem_eq(each[k].out, each[0].out, MANY * sizeof *each[k].out);
  }
  for (int k = 0; k < CALLERS; k++)
    free(each[k].out);
  free(in);
}
END_TEST

START_TEST(lower_sets_can_be_asked_for) {
  const carom_isa best = carom_isa_limit(CAROM_ISA_ANY);
  ck_assert(carom_isa_available(best));
  ck_assert_int_eq(carom_isa_limit(CAROM_ISA_PLAIN), CAROM_ISA_PLAIN);
  ck_assert_int_eq(carom_isa_in_force(), CAROM_ISA_PLAIN);
  ck_assert_int_eq(carom_isa_limit((carom_isa)-1), best);
  ck_assert_int_eq(carom_isa_available((carom_isa)99), 0);
  ck_assert_ptr_null(carom_isa_name((carom_isa)99));
  printf("instruction sets tested:");
  FOR_EACH_ISA(isa) printf(" %s", carom_isa_name((carom_isa)isa));
  printf("\n");
}
END_TEST

int main(void) {
  return RUN_TESTS("batch", good_rows_at_every_size, mixed_rows_at_every_size, the_204_cases, single_precision_is_near,
                   any_number_of_threads, neighbours_make_no_difference, many_callers_at_once, lower_sets_can_be_asked_for);
}
