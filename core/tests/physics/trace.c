/* carom_trace: it ends where carom_collide does, and on the way the books balance.
 *
 * The exact solver's trace is computed by another method than its result, so their agreement is
 * a test of both.
 */
#include "cases.h"
#include "random_impacts.h"
#include "support.h"

enum { POINTS = 41 };

static carom_options options_for(carom_solver solver, carom_slip slip) {
  carom_options options = {0};
  options.solver = solver;
  options.slip = slip;
  return options;
}

static case_set load_cases(void) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  ck_assert_uint_eq(cases.count, 204);
  return cases;
}

/* What must hold for every trace of a collision that took place. */
static void expect_order(const carom_impact *in, const carom_trace_point *point,
                         const carom_detail *detail, carom_solver solver) {
  /* a step; the solver's error */
  const double per = 1.0 / (POINTS - 1), apart = solver == CAROM_SOLVER_EULER ? 1e-3 : 1e-6;
  ck_assert_double_eq(point[0].normal, 0.0);
  ck_assert_double_eq(point[0].work, 0.0);
  ck_assert_int_eq(point[0].phase, CAROM_PHASE_COMPRESSION);
  ck_assert_int_eq(point[POINTS - 1].phase, CAROM_PHASE_RESTITUTION);
  ck_assert_double_eq_tol(point[POINTS - 1].work, detail->work, 1e-6 * detail->work);
  for (int k = 0; k < POINTS; k++) {
    ck_assert_double_eq_tol(point[k].normal, k * per * detail->normal, apart * detail->normal);
    ck_assert(point[k].phase == CAROM_PHASE_RESTITUTION || point[k].v_n <= 0.0);
    ck_assert(!point[k].sticks || (point[k].u_x == 0.0 && point[k].u_z == 0.0));
    ck_assert_int_eq(point[k].sticks,
                     detail->stick != CAROM_STICK_NEVER && point[k].normal >= detail->stick_normal);
    /* the vertical slip is that of both spins, whatever the convention of the other */
    const double *w = point[k].state.a.w, *o = point[k].state.b.w, x = in->b.r[0] - in->a.r[0],
                 y = in->b.r[1] - in->a.r[1];
    const double up = in->a.radius * ((w[0] + o[0]) * y - (w[1] + o[1]) * x) / hypot(x, y);
    ck_assert(point[k].sticks || fabs(fabs(point[k].u_z) - fabs(up)) <= 1e-9);
    if (k == 0)
      continue;
    ck_assert_double_ge(point[k].work, point[k - 1].work * (1.0 - 1e-12));
    ck_assert_double_gt(point[k].v_n, point[k - 1].v_n);
    ck_assert_int_ge(point[k].phase, point[k - 1].phase);
  }
}

/* The largest distance of the trace's end from the result. */
static double worst_end(carom_solver solver, carom_slip slip) {
  case_set cases = load_cases();
  const carom_options options = options_for(solver, slip);
  double worst = 0.0;
  for (size_t k = 0; k < cases.count; k++) {
    carom_trace_point point[POINTS];
    carom_result out;
    carom_detail detail;
    expect_ok(carom_trace(&cases.impact[k], &options, POINTS, point));
    expect_ok(carom_collide_detail(&cases.impact[k], &options, &out, &detail));
    expect_order(&cases.impact[k], point, &detail, solver);
    worst = fmax(worst, result_distance(&point[POINTS - 1].state, &out, cases.impact[k].a.radius));
  }
  cases_free(&cases);
  return worst;
}

TEST(ends_at_the_result) {
  for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
    const double exact = worst_end(CAROM_SOLVER_EXACT, (carom_slip)slip);
    printf("exact, %s: the ends differ by %.2g at most\n", carom_word(CAROM_WORDS_SLIP, slip),
           exact);
    ck_assert_double_le(exact, 1e-6);
    ck_assert_double_eq(worst_end(CAROM_SOLVER_EULER, (carom_slip)slip), 0.0);
  }
}

/* The same on hard collisions of every regime, where a few results of the exact solver are off
 * by up to 1e-5. */
TEST(ends_at_the_result_everywhere) {
  lab_random rng = {test_seed()};
  double worst = 0.0;
  int at = 0;
  for (int regime = 0; regime < regimes_count(); regime++) {
    for (int k = 0; k < 10; k++) {
      const carom_slip slip = (carom_slip)(k % CAROM_SLIP_COUNT);
      const carom_impact in = regimes_draw(regime, slip == CAROM_SLIP_PAPER ? -1.0 : 1.0, &rng);
      const carom_options options = options_for(CAROM_SOLVER_EXACT, slip);
      carom_trace_point point[3];
      carom_result out;
      const carom_status status = carom_collide(&in, &options, &out);
      ck_assert_int_eq(carom_trace(&in, &options, 3, point), status);
      const double distance =
          status == CAROM_OK ? result_distance(&point[2].state, &out, in.a.radius) : 0.0;
      at = distance > worst ? regime : at;
      worst = fmax(worst, distance);
    }
  }
  printf("exact, all regimes: the ends differ by %.2g at most, in regime %s\n", worst,
         regimes_name(at));
  ck_assert_double_le(worst, 5e-5);
}

/* What is between does not depend on how many points there are, and is what Euler's method
 * comes to with many steps. */
TEST(the_way_is_one) {
  case_set cases = load_cases();
  double worst_points = 0.0, worst_euler = 0.0;
  for (size_t k = 0; k < cases.count; k++) {
    carom_options options = options_for(CAROM_SOLVER_EXACT, CAROM_SLIP_PAPER);
    carom_trace_point coarse[5], fine[17], euler[5];
    const double R = cases.impact[k].a.radius;
    carom_trace(&cases.impact[k], &options, 5, coarse);
    carom_trace(&cases.impact[k], &options, 17, fine);
    options.solver = CAROM_SOLVER_EULER;
    options.steps = 20000;
    carom_trace(&cases.impact[k], &options, 5, euler);
    for (int p = 0; p < 5; p++) {
      worst_points = fmax(worst_points, result_distance(&coarse[p].state, &fine[4 * p].state, R));
      worst_euler = fmax(worst_euler, result_distance(&euler[p].state, &coarse[p].state, R));
      ck_assert_double_eq_tol(coarse[p].work, fine[4 * p].work, 1e-8 * fine[16].work);
    }
  }
  printf("other points: %.2g; Euler's method with N = 20,000: %.2g\n", worst_points, worst_euler);
  ck_assert_double_le(worst_points, 1e-8);
  ck_assert_double_le(worst_euler, 2e-4);
  cases_free(&cases);
}

/* Balls that separate stay, and errors are those of carom_collide(). */
TEST(nothing_to_trace) {
  random_source source = {test_seed()};
  carom_impact in = random_impact(&source);
  for (int k = 0; k < 3; k++) {
    in.a.v[k] = -in.a.v[k];
    in.b.v[k] = -in.b.v[k];
  }
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++) {
    const carom_options options = options_for((carom_solver)solver, CAROM_SLIP_PAPER);
    carom_trace_point point[4];
    ck_assert_int_eq(carom_trace(&in, &options, 4, point), CAROM_SEPARATING);
    for (int k = 0; k < 4; k++) {
      ck_assert_double_eq(point[k].normal, 0.0);
      ck_assert_double_eq(point[k].work, 0.0);
      ck_assert_mem_eq(point[k].state.a.v, in.a.v, sizeof in.a.v);
      ck_assert_mem_eq(point[k].state.b.w, in.b.w, sizeof in.b.w);
    }
  }
}
