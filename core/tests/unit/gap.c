/* First contacts against a search in small steps. */
#include "motion/gap.h"
#include "support.h"

static long double gap(const carom_separation *d, long double t) {
  const long double x = d->d0[0] + t * (d->d1[0] + t * d->d2[0]),
                    y = d->d0[1] + t * (d->d1[1] + t * d->d2[1]);
  return sqrtl(x * x + y * y);
}

static carom_separation random_pair(random_source *r, double reach) {
  const double far = reach * pow(10.0, random_between(r, 0.0, 1.5)) + 1e-9,
               way = random_between(r, 0.0, 6.283185307);
  const double speed = pow(10.0, random_between(r, -3.0, 1.0)),
               to = way + 3.14159265 + random_between(r, -1.0, 1.0) * reach / far * 1.5;
  const double push = random_between(r, 0.0, 4.0), along = random_between(r, 0.0, 6.283185307);
  return (carom_separation){{far * cos(way), far * sin(way)},
                            {speed * cos(to), speed * sin(to)},
                            {0.5 * push * cos(along), 0.5 * push * sin(along)}};
}

/* Nothing is stepped over, and what is found is a contact. */
TEST(pairs) {
  random_source r = {test_seed()};
  const double reach = 0.05715;
  int found = 0;
  for (int n = 0; n < 8000; n++) {
    const carom_separation d = random_pair(&r, reach);
    const double horizon = random_between(&r, 0.05, 2.0),
                 t = carom_first_contact(&d, reach, horizon);
    const double until = t < horizon ? t : horizon;
    for (int s = 0; s < 300; s++) {
      const double at = until * s / 300.0;
      if (!(gap(&d, at) > reach - 1e-12L || at >= t))
        ck_abort_msg("pair %d is stepped over at %g before %g", n, at, t);
    }
    if (t <= horizon) {
      found++;
      ck_assert_msg(fabsl(gap(&d, t) - reach) < 1e-13L, "pair %d: the gap at %g is %Lg", n, t,
                    gap(&d, t) - reach);
      const double x = d.d0[0] + t * (d.d1[0] + t * d.d2[0]),
                   y = d.d0[1] + t * (d.d1[1] + t * d.d2[1]);
      ck_assert_double_le(x * (d.d1[0] + 2 * t * d.d2[0]) + y * (d.d1[1] + 2 * t * d.d2[1]), 1e-9);
    }
    ck_assert_double_eq(carom_first_crossing(&d, reach, horizon), t);
  }
  printf("%d of 8000 pairs meet\n", found);
  ck_assert_int_gt(found, 1600);
}

/* Pairs that graze: the least distance differs from reach by 1e-15 to 1e-3 of it, on either
 * side. Below 1e-14 m
 * rounding of the polynomial decides. */
TEST(grazing) {
  random_source r = {test_seed()};
  const double reach = 0.05715;
  for (int n = 0; n < 20000; n++) {
    const double miss = reach * pow(10.0, random_between(&r, -15.0, -3.0)) *
                        (random_between(&r, -1.0, 1.0) > 0.0 ? 1.0 : -1.0);
    /* past the origin at distance reach + miss, speeding up or slowing down along its way */
    const carom_separation d = {{-0.3, reach + miss},
                                {random_between(&r, 0.5, 5.0), 0.0},
                                {random_between(&r, -0.1, 0.4), 0.0}};
    const double t = carom_first_contact(&d, reach, 0.5);
    if (miss > 1e-14)
      ck_assert_msg(isinf(t), "missing by %g is taken for a contact at %g", miss, t);
    else if (miss < -1e-14 && 0.3 / d.d1[0] < 0.4)
      ck_assert_msg(t < 0.5 && fabsl(gap(&d, t) - reach) < 1e-13L,
                    "a contact %g deep is missed: %g", -miss, t);
  }
}

/* Coming from inside the circle, as by pooltool's rules: when it goes out. */
TEST(from_inside) {
  random_source r = {test_seed()};
  const double reach = 0.062;
  int found = 0;
  for (int n = 0; n < 4000; n++) {
    const double far = reach * sqrt(random_between(&r, 0.0, 0.999)),
                 way = random_between(&r, 0.0, 6.283185307);
    const double speed = pow(10.0, random_between(&r, -2.5, 0.5)),
                 to = random_between(&r, 0.0, 6.283185307), push = random_between(&r, 0.0, 1.0);
    const carom_separation d = {{far * cos(way), far * sin(way)},
                                {speed * cos(to), speed * sin(to)},
                                {-push * cos(to), -push * sin(to)}};
    const double horizon = random_between(&r, 0.05, 1.0),
                 t = carom_first_crossing(&d, reach, horizon);
    const double until = t < horizon ? t : horizon;
    for (int s = 0; s < 300; s++)
      ck_assert_msg(gap(&d, until * s / 300.0) < reach + 1e-12L,
                    "path %d leaves the circle before %g", n, t);
    if (t <= horizon) {
      found++;
      ck_assert_msg(fabsl(gap(&d, t) - reach) < 1e-13L, "path %d is at %Lg at %g", n, gap(&d, t),
                    t);
    }
  }
  ck_assert_int_gt(found, 1000);
  ck_assert_int_lt(found, 3900);
  const carom_separation on = {{reach, 0.0}, {-1.0, 0.0}, {0.0, 0.0}};
  ck_assert_double_eq(carom_first_crossing(&on, reach, 1.0), 0.0);
}

/* Touching at first: now if closing; never if parting for good; where it closes again if not. */
TEST(touching) {
  const double reach = 0.05;
  carom_separation d = {{reach, 0.0}, {-1.0, 0.0}, {0.0, 0.0}};
  ck_assert_double_eq(carom_first_contact(&d, reach, 9.0), 0.0);
  d.d1[0] = 1.0;
  ck_assert(isinf(carom_first_contact(&d, reach, 9.0)));
  d.d2[0] = -0.5; /* back after 2 s */
  ck_assert_double_eq_tol(carom_first_contact(&d, reach, 9.0), 2.0, 1e-12);
  ck_assert(isinf(carom_first_contact(&d, reach, 1.9)));
  d.d0[0] -= 1e-14; /* and with a trace of an overlap */
  ck_assert_double_eq_tol(carom_first_contact(&d, reach, 9.0), 2.0, 1e-12);
  /* away along the tangent but for a trace that rounding leaves, and back: 0.6 t^2 - 0.6 t^3 +
   * 0.13 t^4 */
  carom_separation tangent = {{1.0, 0.0}, {0.0, 1.0}, {-0.2, -0.3}};
  for (int k = 0; k < 4; k++) {
    tangent.d1[0] = (double[]){0.0, 4e-19, 1e-17, -1e-19}[k];
    ck_assert_double_eq_tol(carom_first_contact(&tangent, 1.0, 3.0), (0.6 - sqrt(0.048)) / 0.26,
                            1e-9);
  }
  const double g[3] = {0.0, 1.0, -0.5}, parting[3] = {-1e-15, 1.0, 0.1},
               closing[3] = {1e-13, -1e-9, 0.0};
  ck_assert_double_eq_tol(carom_first_touch(g, 1e-12, 9.0), 2.0, 1e-15);
  ck_assert(isinf(carom_first_touch(parting, 1e-12, 9.0)));
  ck_assert_double_eq(carom_first_touch(closing, 1e-12, 9.0), 0.0);
  /* a gap of exactly the slack is a contact now; a speed of exactly CAROM_NO_SPEED closes
   * nothing */
  const double on_slack[3] = {1e-12, -1.0, 0.0}, no_speed[3] = {0.0, -CAROM_NO_SPEED, 0.0};
  ck_assert_double_eq(carom_first_touch(on_slack, 1e-12, 9.0), 0.0);
  ck_assert(isinf(carom_first_touch(no_speed, 1e-12, 9.0)));
}

/* Touching and pressed: where the gap has fallen by the slack from its greatest, so that it
 * closes there. */
TEST(pressed) {
  const double reach = 0.05, slack = 1e-12;
  static const double gaps[] = {0.0, 1e-13, -1e-13, 1e-12, -1e-9};
  for (int k = 0; k < 5; k++)
    for (int rise = 0; rise < 2; rise++) {
      /* at rest, or on a hop of 1e-13 m */
      const double g[3] = {gaps[k], rise ? sqrt(4e-13) : 0.0, -1.0},
                   top = gaps[k] + (rise ? 1e-13 : 0.0);
      const double deep = top - slack < 0.0 ? top - slack : 0.0,
                   t = (g[1] + sqrt(g[1] * g[1] + 4.0 * (g[0] - deep))) / 2.0;
      ck_assert_double_eq_tol(carom_first_touch(g, slack, 1.0), t, 1e-9 * t);
      ck_assert(isinf(carom_first_touch(g, slack, 0.99 * t)));
      const carom_separation d = {{reach + gaps[k], 0.0}, {g[1], 0.0}, {-1.0, 0.0}};
      /* a gap of some 1e-12 m is known to the rounding of `reach` */
      ck_assert_double_eq_tol(carom_first_contact(&d, reach, 1.0), t, 1e-3 * t);
    }
  /* only by rounding: not before the path ends */
  const double rounding[3] = {0.0, 0.0, -1e-17};
  ck_assert(isinf(carom_first_touch(rounding, slack, 10.0)));
  const carom_separation tangential = {{reach, 0.0}, {0.0, 1e-9}, {-1e-17, -1.0}};
  ck_assert(isinf(carom_first_contact(&tangential, reach, 5e-10)));
}

/* Touching, with slope and curvature exactly 0: |d|^2 - 1 = -2 t^3 + 5/4 t^4 falls by its third
 * derivative, and the same with the other sign rises. */
TEST(third_derivative) {
  const carom_separation falls = {{1.0, 0.0}, {0.0, 1.0}, {-0.5, -1.0}},
                         rises = {{1.0, 0.0}, {0.0, 1.0}, {-0.5, 1.0}};
  const double t = carom_first_contact(&falls, 1.0, 0.8);
  ck_assert_double_eq_tol(t, 1e-4, 1e-6); /* where it has fallen by twice the slack */
  ck_assert(isinf(carom_first_contact(&rises, 1.0, 0.8)));
  /* coming from outside to a zero of order 3: (1 - t)^3 + O((1 - t)^4) */
  const carom_separation comes = {{0.5, -2.0}, {1.0, 3.0}, {-0.5, -1.0}};
  ck_assert_double_eq_tol(carom_first_crossing(&comes, 1.0, 3.0), 1.0, 1e-4);
  ck_assert_double_eq_tol(carom_first_contact(&comes, 1.0, 3.0), 1.0, 1e-4);
}
