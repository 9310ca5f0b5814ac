/* The floating-point environment of the caller, as carom.h describes it: rounding to nearest is
 * needed, though nothing breaks without; flushing to zero makes no difference to ordinary
 * collisions; the environment itself is left as it was, but for the flags. */
#include "random_impacts.h"
#include "support.h"

#include <fenv.h>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

enum { ROWS = 33 * 20 };

static carom_impact ordinary[ROWS], regimes[ROWS];

static void make_rows(void) {
  random_source source = {test_seed()};
  lab_random rng = {test_seed()};
  for (int k = 0; k < ROWS; k++) {
    ordinary[k] = random_impact(&source);
    regimes[k] = regimes_draw(k % regimes_count(), -1.0, &rng);
  }
}

/* All that the library computes of the rows, in both precisions. */
typedef struct results {
  carom_result out[ROWS];
  carom_result_f32 out_f32[ROWS];
  int8_t status[ROWS];
} results;

static void resolve(const carom_impact *in, int solver, results *r) {
  static carom_impact_f32 in_f32[ROWS];
  const carom_options options = {.solver = (carom_solver)solver, .steps = 100};
  for (size_t k = 0; k < ROWS; k++)
    in_f32[k] = narrowed(&in[k]);
  memset(r, 0, sizeof *r);
  carom_collide_batch(in, ROWS, &options, r->out, r->status);
  carom_collide_batch_f32(in_f32, ROWS, &options, r->out_f32, NULL);
}

static results expected, seen;

TEST(rounding_to_nearest_is_needed) {
  static const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  double worst = 0.0;
  make_rows();
  FOR_EACH_ISA(isa)
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++) {
    resolve(ordinary, solver, &expected);
    for (int mode = 0; mode < 3; mode++) {
      ck_assert_int_eq(fesetround(modes[mode]), 0);
      resolve(ordinary, solver, &seen);
      const int after = fegetround();
      fesetround(FE_TONEAREST);
      ck_assert_int_eq(after, modes[mode]);
      ck_assert_mem_eq(seen.status, expected.status, sizeof seen.status);
      for (int k = 0; k < ROWS; k++)
        worst = fmax(worst, result_distance(&seen.out[k], &expected.out[k], ordinary[k].a.radius));
    }
  }
  printf("rounding otherwise than to nearest changes ordinary collisions by %.1e at most\n", worst);
  ck_assert_double_gt(worst, 0.0);
  ck_assert_double_lt(worst, 1e-5);
}

/* Flushes results to zero that are subnormal, and reads operands that are so as zero; false
 * where this is not known here. */
static bool flush_to_zero(bool on) {
#if defined(__SSE__)
  const unsigned both = 0x8040;
  _mm_setcsr(on ? _mm_getcsr() | both : _mm_getcsr() & ~both);
  return true;
#elif defined(__aarch64__)
  uint64_t control;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  control = on ? control | (uint64_t)1 << 24 : control & ~((uint64_t)1 << 24);
  __asm__ volatile("msr fpcr, %0" : : "r"(control));
  return true;
#else
  (void)on;
  return false;
#endif
}

TEST(flushing_to_zero_makes_no_difference) {
  make_rows();
  const carom_impact *const rows[] = {ordinary, regimes};
  FOR_EACH_ISA(isa)
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++)
    for (int set = 0; set < 2; set++) {
      resolve(rows[set], solver, &expected);
      if (!flush_to_zero(true))
        return;
      resolve(rows[set], solver, &seen);
      flush_to_zero(false);
      ck_assert_mem_eq(&seen, &expected, sizeof seen);
    }
}

/* Rounding, masks and flushing, without the flags, which may be raised. */
static unsigned control(void) {
#if defined(__SSE__)
  return _mm_getcsr() & ~0x3fu;
#else
  return (unsigned)fegetround();
#endif
}

TEST(the_environment_is_left_alone) {
  make_rows();
  FOR_EACH_ISA(isa)
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++)
    for (int with = 0; with < 2; with++) {
      flush_to_zero(with == 1);
      const unsigned before = control();
      resolve(regimes, solver, &seen);
      const unsigned after = control();
      flush_to_zero(false);
      ck_assert_uint_eq(after, before);
    }
}
