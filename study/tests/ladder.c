/* The ladder: every rung in every configuration of every compiler, against its parent, and on bad
 * input. Against pooltool: study/tests/lab/verify.sh. */
#include "ladder.h"
#include "accuracy.h"
#include "cases.h"
#include "support.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

static const ladder_module *load(size_t k) {
  char why[LADDER_WHY_SIZE];
  const ladder_module *module = ladder_module_find(ladder_module_name(k), why);
  ck_assert_msg(module != NULL, "%s", why);
  return module;
}

#define FOR_EACH_MODULE(module)                                                     \
  for (size_t module##_k = 0; ladder_module_name(module##_k) != NULL; module##_k++) \
    for (const ladder_module *module = load(module##_k); module != NULL; module = NULL)
#define FOR_EACH_RUNG(rung)                                                             \
  for (size_t rung##_k = 0; ladder_rung_at(rung##_k) != NULL; rung##_k++)               \
    for (const ladder_rung *rung = ladder_rung_at(rung##_k); rung != NULL; rung = NULL) \
      if (ladder_rung_runs(rung))

static carom_options pooltool(int steps) {
  carom_options options = {0};
  options.slip = CAROM_SLIP_POOLTOOL;
  options.steps = steps;
  return options;
}

/* How far a rung may be from its parent on a pair of N steps, beyond its own bound.
 *
 * The collision ends on a whole step, and which one may hang on a last bit: that is dv = (1 +
 * e)|v_n|/(2N) on a speed. And where slip between the balls ends during the collision, Euler's
 * method does not stay there: it goes back and forth across u = 0, pressing now one ball into
 * the cloth, now the other, as the last bits have it. What the cloth can then do in all is μ_s
 * μ_b (1 + e)|v_n|/2, and 5/2 of that on R w. */
static double allowance(const carom_impact *in, const carom_options *options,
                        const carom_result *parent) {
  const carom_frame frame = carom_frame_of(in);
  const double R = in->a.radius, *x = frame.x, *y = frame.y;
  const double P = 0.5 * (1.0 + in->restitution) *
                   fabs(carom_dot(in->b.v, y) - carom_dot(in->a.v, y)),
               dv = P / options->steps;
  const double u_x =
      carom_dot(parent->a.v, x) - carom_dot(parent->b.v, x) - R * (parent->a.w[2] + parent->b.w[2]);
  const double u_z = R * (carom_dot(parent->a.w, x) + carom_dot(parent->b.w, x));
  const bool slip_ended = hypot(u_x, u_z) <= 10.0 * in->mu_ball * dv;
  double scale = 0.0;
  for (int k = 0; k < 12; k++)
    scale = fmax(scale, fabs(((const double *)parent)[k]) * (k / 3 % 2 == 1 ? R : 1.0));
  return (dv + (slip_ended ? 2.5 * fmax(in->a.mu_slide, in->b.mu_slide) * in->mu_ball * P : 0.0)) /
         scale;
}

TEST(each_rung_agrees_with_its_parent) {
  static const int steps[] = {100, 1000, 10000};
  random_source source = {test_seed()};
  for (int trial = 0; trial < 60; trial++) {
    carom_impact impact = random_impact(&source);
    impact.b.mass = impact.a.mass;
    carom_options options = pooltool(steps[trial % 3]);
    options.slip = trial % 2 == 0 ? CAROM_SLIP_PAPER : CAROM_SLIP_POOLTOOL;
    FOR_EACH_MODULE(module)
    FOR_EACH_RUNG(rung) {
      carom_result out, parent;
      const carom_status status = ladder_resolve(module, rung, &impact, &options, &out);
      if (status == CAROM_ERROR_TOO_SLOW) /* a grazing hit in single precision */
        continue;
      expect_ok(status);
      expect_ok(ladder_resolve(module, ladder_rung_find(rung->parent), &impact, &options, &parent));
      const double off = result_distance(&out, &parent, impact.a.radius);
      const double bound = rung->bound + allowance(&impact, &options, &parent);
      ck_assert_msg(off <= bound, "%s in %s, %d steps, trial %d: %g from %s", rung->name,
                    module->name, options.steps, trial, off, rung->parent);
    }
  }
}

TEST(base_is_euler) {
  char why[LADDER_WHY_SIZE];
  const ladder_module *module = ladder_module_find("o3", why);
  if (ladder_module_name(0) == NULL)
    return;
  ck_assert_msg(module != NULL, "%s", why);
  random_source source = {test_seed()};
  for (int trial = 0; trial < 500; trial++) {
    carom_impact impact = random_impact(&source);
    impact.b.mass = impact.a.mass;
    carom_options options = pooltool(1 + trial);
    options.solver = CAROM_SOLVER_EULER;
    options.slip = trial % 2 == 0 ? CAROM_SLIP_PAPER : CAROM_SLIP_POOLTOOL;
    carom_result base, euler;
    expect_ok(ladder_resolve(module, ladder_rung_at(0), &impact, &options, &base));
    expect_ok(carom_collide(&impact, &options, &euler));
    for (int k = 0; k < 12; k++)
      ck_assert(((const double *)&base)[k] == ((const double *)&euler)[k]);
  }
}

static carom_impact head_on(void) {
  return (carom_impact){
      .a = {.v = {0.0, 1.0, 0.0}, .radius = 0.028, .mass = 0.17, .mu_slide = 0.2},
      .b = {.r = {0.0, 0.056, 0.0}, .radius = 0.028, .mass = 0.17, .mu_slide = 0.2},
      .mu_ball = 0.05,
      .restitution = 0.95,
  };
}

/* Every rung of every module must give this status, and NaN or the state before with it; and
 * must return at all. */
static void expect(carom_impact impact, int steps, carom_status expected) {
  const carom_options options = pooltool(steps);
  FOR_EACH_MODULE(module)
  FOR_EACH_RUNG(rung) {
    carom_result out;
    const carom_status status = ladder_resolve(module, rung, &impact, &options, &out);
    ck_assert_msg(status == expected, "%s in %s: %s, not %s", rung->name, module->name,
                  carom_status_name(status), carom_status_name(expected));
    if (status < 0)
      ck_assert(isnan(out.a.v[0]) && isnan(out.b.w[2]));
    else if (status == CAROM_SEPARATING)
      ck_assert_mem_eq(out.a.v, impact.a.v, sizeof out.a.v);
    else
      ck_assert(isfinite(out.a.v[1]) && isfinite(out.b.w[0]));
  }
}

/* Head-on collisions whose speeds and sizes are extreme are rejected or solved. */
TEST(what_cannot_be_solved_is_refused_and_the_rest_ends) {
  static const struct {
    double v_a, v_b;
    double mass_a, mass_b;
    double radius;
    double mu_ball, restitution;
    carom_status status;
  } cases[] = {
      {1, 0, 0.17, 0.17, 0.028, 0.05, 0.95, CAROM_OK},
      {0, 0, 0.17, 0.17, 0.028, 0.05, 0.95, CAROM_SEPARATING},
      {-1, 0, 0.17, 0.17, 0.028, 0.05, 0.95, CAROM_SEPARATING},
      {1, 0, 0.17, 0.16, 0.028, 0.05, 0.95, CAROM_ERROR_MASSES_DIFFER},
      {1, 0, 0.17, 0.17, 0.028, 0, 1.5, CAROM_ERROR_RESTITUTION},
      {1, 0, 0.17, 0.17, 0.028, 0.05, 0, CAROM_OK},
      {1, 0, 0.17, 0.17, 0.028, 1, 1, CAROM_OK},
      {1, 0, 0.17, 0.17, 0.028, 0, 1, CAROM_OK},
      {1e8, 0, 0.17, 0.17, 0.028, 0.05, 0.95, CAROM_OK},
      {1e-12, 0, 0.17, 0.17, 0.028, 0.05, 0.95, CAROM_OK},
      {1e12, 0, 0.17, 0.17, 0.028, 0.05, 0.95, CAROM_ERROR_OVERFLOW},
      /* in single precision */
      {1, 0, 1e-40, 1e-40, 0.028, 0.05, 0.95, CAROM_ERROR_OVERFLOW},
      {1, 0, 1e-9, 1e-9, 1e-9, 0.05, 0.95, CAROM_OK},
      {1, 0, 1e9, 1e9, 1e9, 0.05, 0.95, CAROM_OK},
      /* a step below what a slip must be to count, and steps that are rounded away */
      {1e-14, 0, 0.17, 0.17, 0.028, 0.05, 0.95, CAROM_ERROR_TOO_SLOW},
      {1e3, 1e3 - 1e-10, 0.17, 0.17, 0.028, 0.05, 0.95, CAROM_ERROR_TOO_SLOW},
  };
  for (size_t k = 0; k < COUNT_OF(cases); k++) {
    const carom_ball ball = {.radius = cases[k].radius, .mu_slide = 0.2};
    carom_impact impact = {
        .a = ball, .b = ball, .mu_ball = cases[k].mu_ball, .restitution = cases[k].restitution};
    impact.b.r[1] = 2.0 * cases[k].radius;
    impact.a.v[1] = cases[k].v_a;
    impact.b.v[1] = cases[k].v_b;
    impact.a.mass = cases[k].mass_a;
    impact.b.mass = cases[k].mass_b;
    expect(impact, 1000, cases[k].status);
  }
}

TEST(steps_are_checked) {
  expect(head_on(), 1, CAROM_OK);
  expect(head_on(), -1, CAROM_ERROR_STEPS);
}

TEST(wrong_numbers_are_refused) {
  carom_impact impact = head_on();
  impact.a.v[0] = NAN;
  expect(impact, 1000, CAROM_ERROR_VELOCITY);
  impact = head_on();
  impact.a.w[2] = INFINITY;
  expect(impact, 1000, CAROM_ERROR_SPIN);
  impact = head_on();
  impact.b.r[1] = NAN;
  expect(impact, 1000, CAROM_ERROR_POSITION);
  impact = head_on();
  impact.b.r[1] = 0.0;
  expect(impact, 1000, CAROM_ERROR_COINCIDENT);
}

/* All frictions are 1, and the first ball spins about each axis. */
TEST(much_friction_is_solved) {
  carom_impact impact = head_on();
  impact.mu_ball = 1.0;
  impact.a.mu_slide = 1.0;
  impact.b.mu_slide = 1.0;
  impact.restitution = 1.0;
  impact.a.w[0] = 300.0;
  impact.a.w[1] = -200.0;
  impact.a.w[2] = 100.0;
  expect(impact, 1000, CAROM_OK);
}

/* The limit of steps is each precision's own. */
TEST(single_precision_takes_fewer_steps) {
  const carom_impact impact = head_on();
  const carom_options options = pooltool(2000000);
  FOR_EACH_MODULE(module) {
    carom_result out;
    ck_assert_int_eq(ladder_resolve(module, ladder_rung_find("float"), &impact, &options, &out),
                     CAROM_ERROR_TOO_SLOW);
    expect_ok(ladder_resolve(module, ladder_rung_find("double"), &impact, &options, &out));
  }
}

#define FOR_EACH_RUNG_OF_LANES(rung) \
  FOR_EACH_RUNG(rung)                \
  if (rung->width > 1)

enum { MOST_PAIRS = 100 };

/* Pairs of equal mass. Every fifth approaches and is rejected (masses differ), and every seventh
 * separates, if `mixed`. */
static void draw_pairs(carom_impact pair[MOST_PAIRS], random_source *source, bool mixed) {
  for (int k = 0; k < MOST_PAIRS; k++) {
    pair[k] = random_impact(source);
    pair[k].b.mass = pair[k].a.mass;
    if (mixed && k % 5 == 3)
      pair[k].b.mass *= 2.0;
    if (mixed && k % 7 == 2)
      for (int c = 0; c < 3; c++) {
        pair[k].a.v[c] = -pair[k].a.v[c];
        pair[k].b.v[c] = -pair[k].b.v[c];
      }
  }
}

/* A lane has the same bits whatever the other lanes hold: a batch of any size and any mixture has
 * the bits of the single pair, whose other lanes are copies of it. So a lane that has ended keeps
 * its final state while slower ones run. */
TEST(a_lane_depends_on_no_other) {
  random_source source = {test_seed()};
  carom_impact pair[MOST_PAIRS];
  carom_options options = pooltool(300);
  for (int mixed = 0; mixed < 2; mixed++) {
    draw_pairs(pair, &source, mixed != 0);
    FOR_EACH_MODULE(module)
    FOR_EACH_RUNG_OF_LANES(rung) {
      const size_t sizes[] = {
          0, 1, rung->width - 1, rung->width, rung->width + 1, 2 * rung->width + 3, MOST_PAIRS};
      carom_result alone[MOST_PAIRS];
      int8_t status_alone[MOST_PAIRS];
      for (int k = 0; k < MOST_PAIRS; k++)
        status_alone[k] = (int8_t)ladder_resolve(module, rung, &pair[k], &options, &alone[k]);
      for (size_t size = 0; size < sizeof sizes / sizeof sizes[0]; size++) {
        const size_t n = sizes[size];
        carom_result out[MOST_PAIRS];
        int8_t status[MOST_PAIRS];
        memset(out, 0x55, sizeof out);
        memset(status, 0x55, sizeof status);
        const carom_status first =
            ladder_resolve_batch(module, rung, pair, n, &options, out, status);
        carom_status expected = CAROM_OK;
        for (size_t k = 0; k < n; k++) {
          if (expected == CAROM_OK && status_alone[k] < 0)
            expected = (carom_status)status_alone[k];
          ck_assert_msg(status[k] == status_alone[k], "%s in %s, pair %zu of %zu: %d, not %d",
                        rung->name, module->name, k, n, status[k], status_alone[k]);
          ck_assert_msg(memcmp(&out[k], &alone[k], sizeof out[k]) == 0,
                        "%s in %s, pair %zu of %zu: other bits than alone", rung->name,
                        module->name, k, n);
        }
        ck_assert_int_eq(first, expected);
        for (size_t k = n; k < MOST_PAIRS; k++)
          ck_assert_int_eq(status[k], 0x55);
      }
    }
  }
}

/* Grazing and slow pairs next to fast ones: single precision rejects them row by row, and the rest
 * agree with the parent. */
TEST(lanes_beside_refused_ones_agree_with_the_parent) {
  random_source source = {test_seed()};
  carom_impact pair[MOST_PAIRS];
  draw_pairs(pair, &source, true);
  for (int k = 0; k < MOST_PAIRS; k += 4)
    for (int c = 0; c < 3; c++) { /* approaches that single precision cannot resolve */
      pair[k].a.v[c] *= 1e-14;
      pair[k].b.v[c] *= 1e-14;
    }
  carom_options options = pooltool(1000);
  FOR_EACH_MODULE(module)
  FOR_EACH_RUNG_OF_LANES(rung) {
    carom_result out[MOST_PAIRS];
    int8_t status[MOST_PAIRS];
    int solved = 0, refused = 0;
    ladder_resolve_batch(module, rung, pair, MOST_PAIRS, &options, out, status);
    for (int k = 0; k < MOST_PAIRS; k++) {
      carom_result parent;
      const carom_status of_parent =
          ladder_resolve(module, ladder_rung_find(rung->parent), &pair[k], &options, &parent);
      ck_assert_int_eq(status[k], of_parent);
      refused += status[k] < 0;
      solved += status[k] == CAROM_OK;
      if (status[k] < 0)
        ck_assert(isnan(out[k].a.v[0]) && isnan(out[k].b.w[2]));
      if (status[k] != CAROM_OK)
        continue;
      const double off = result_distance(&out[k], &parent, pair[k].a.radius);
      const double bound = rung->bound + allowance(&pair[k], &options, &parent);
      ck_assert_msg(off <= bound, "%s in %s, pair %d: %g from %s", rung->name, module->name, k, off,
                    rung->parent);
    }
    ck_assert_int_gt(solved, 0);
    ck_assert_int_gt(refused, 0);
  }
}

/* Linking with -ffast-math makes a library switch the complete process to flushing subnormal
 * numbers when it is loaded. */
TEST(loading_leaves_arithmetic_alone) {
#if defined(__x86_64__)
  const unsigned before = _mm_getcsr() & ~(unsigned)_MM_EXCEPT_MASK;
  FOR_EACH_MODULE(module)
  ck_assert_ptr_nonnull(module);
  ck_assert_uint_eq(_mm_getcsr() & ~(unsigned)_MM_EXCEPT_MASK, before);
#endif
}
