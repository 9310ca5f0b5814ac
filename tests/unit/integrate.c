/* The adaptive integrator by itself, on problems whose solution is known. */
#include "platform/integrate.h"
#include "platform/extrapolate.h"
#include "support.h"

#include <float.h>
#include <math.h>

static double anything(const void *model, double x, const double *y, const double *f) {
  (void)model, (void)x, (void)y, (void)f;
  return DBL_MAX;
}

static double no_event(const void *model, double x, const double *y, const double *f, double *rate) {
  (void)model, (void)x, (void)y, (void)f;
  *rate = 0;
  return -1;
}

/* y'' = -y: a circle. */
static void circle(const void *model, double x, const double *y, double *f) {
  (void)model, (void)x;
  f[0] = y[1];
  f[1] = -y[0];
}

static double at_height(const void *model, double x, const double *y, const double *f, double *rate) {
  (void)x;
  *rate = f[0];
  return y[0] - *(const double *)model;
}

static const double evenly[] = {1, 1, 1};

START_TEST(tolerance_is_kept) {
  for (double tolerance = 1e-6; tolerance > 1e-13; tolerance *= 0.1) {
    const carom_ode ode = {
        .size = 2, .slope = circle, .longest = anything, .event = no_event, .weight = evenly, .tolerance = tolerance};
    carom_ode_point at = {.y = {0, 1}, .next = 1};
    carom_ode_set(&ode, &at);
    int steps = 0;
    while (at.x < 20) {
      ck_assert_int_eq(carom_ode_step(&ode, &at, 20), 0);
      steps++;
    }
    ck_assert_double_eq(at.x, 20);
    ck_assert_double_le(hypot(at.y[0] - sin(20.0), at.y[1] - cos(20.0)), 20 * tolerance + 1e-14);
    ck_assert_int_lt(steps, 200);
    ck_assert_int_le(at.evaluations, 13 * steps + 100);
  }
}
END_TEST

START_TEST(events_are_located) {
  random_source source = {test_seed()};
  for (int k = 0; k < 200; k++) {
    const double height = random_between(&source, 0.01, 0.999), first = random_between(&source, 0.01, 3);
    const carom_ode ode = {.size = 2,
                           .slope = circle,
                           .longest = anything,
                           .event = at_height,
                           .model = &height,
                           .weight = evenly,
                           .tolerance = 1e-13};
    carom_ode_point at = {.y = {0, 1}, .next = first};
    carom_ode_set(&ode, &at);
    while (!carom_ode_step(&ode, &at, 10))
      ck_assert_double_lt(at.x, 10);
    ck_assert_double_le(fabs(at.x - asin(height)), 1e-11);
    ck_assert_double_le(fabs(at.y[0] - height), 1e-12);
  }
}
END_TEST

/* y' = -1 / (2 y), which ends at y = 0: the system asks for steps that shrink towards it. */
static void falling_root(const void *model, double x, const double *y, double *f) {
  (void)model, (void)x;
  f[0] = -0.5 / y[0];
}

static double half_the_way(const void *model, double x, const double *y, const double *f) {
  (void)model, (void)x, (void)f;
  return 0.5 * y[0] * y[0];
}

START_TEST(singularities_are_approached) {
  const carom_ode ode = {
      .size = 1, .slope = falling_root, .longest = half_the_way, .event = no_event, .weight = evenly, .tolerance = 1e-12};
  carom_ode_point at = {.y = {1}, .next = 1};
  carom_ode_set(&ode, &at);
  while (at.y[0] > 1e-4)
    carom_ode_step(&ode, &at, 1);
  ck_assert_double_le(fabs(at.y[0] * at.y[0] + at.x - 1), 1e-12);
  ck_assert_int_lt(at.evaluations, 3000);
}
END_TEST

static void nothing_finite(const void *model, double x, const double *y, double *f) {
  (void)model, (void)y;
  f[0] = x < 0.5 ? 1 : NAN;
}

START_TEST(ends_on_what_is_not_finite) {
  const carom_ode ode = {
      .size = 1, .slope = nothing_finite, .longest = anything, .event = no_event, .weight = evenly, .tolerance = 1e-10};
  carom_ode_point at = {.next = 0.3};
  carom_ode_set(&ode, &at);
  for (int k = 0; k < 100; k++)
    carom_ode_step(&ode, &at, 1);
  ck_assert_int_lt(at.evaluations, 100 * 12 * 60);
}
END_TEST

static void circle_in_lanes(const void *model, const carom_pair *y, carom_pair scale, carom_pair *f) {
  (void)model;
  f[0] = scale * y[1];
  f[1] = -(scale * y[0]);
}

/* One extrapolated step along the circle: its error, and what it says of the two lower orders. */
static double extrapolated_error(int columns, double h, double *e_6, double *e_5) {
  const double y_0[] = {0, 1}, f_0[] = {1, 0};
  carom_extrapolated out[2];
  if (columns == 3)
    carom_extrapolate(3, 2, circle_in_lanes, NULL, y_0, f_0, h, out);
  else
    carom_extrapolate(7, 2, circle_in_lanes, NULL, y_0, f_0, h, out);
  *e_6 = hypot(out[0].e_6, out[1].e_6);
  *e_5 = hypot(out[0].e_5, out[1].e_5);
  return hypot(out[0].y - sin(h), out[1].y - cos(h));
}

/* Halving a step of an order p divides its error by 2^(p + 1), and so do the errors of the orders p - 2 and p - 4. */
START_TEST(extrapolation_has_its_order) {
  static const struct {
    int columns;
    double h;
  } of[] = {{3, 0.5}, {7, 2.5}};
  for (int k = 0; k < 2; k++) {
    double e_6[2], e_5[2];
    const int order = 2 * of[k].columns;
    const double whole = extrapolated_error(of[k].columns, of[k].h, &e_6[0], &e_5[0]);
    const double half = extrapolated_error(of[k].columns, of[k].h / 2, &e_6[1], &e_5[1]);
    ck_assert_double_eq_tol(log2(whole / half), order + 1, 1);
    ck_assert_double_eq_tol(log2(e_6[0] / e_6[1]), order - 1, 1);
    ck_assert_double_eq_tol(log2(e_5[0] / e_5[1]), order - 3, 1);
    /* the estimate that sliding.c makes of them is that of the step, within a factor */
    const double estimate = e_6[0] * e_6[0] / e_5[0];
    ck_assert_msg(estimate > whole / 10 && estimate < 1000 * whole, "%g, estimated %g", whole, estimate);
  }
}
END_TEST

int main(void) {
  return RUN_TESTS("integrate", tolerance_is_kept, events_are_located, singularities_are_approached, ends_on_what_is_not_finite,
                   extrapolation_has_its_order);
}
