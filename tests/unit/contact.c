/* First contacts against a search in small steps. */
#include "shot/contact.h"
#include "support.h"

#include <math.h>
#include <stdio.h>

static long double gap(const carom_separation *d, long double t) {
  const long double x = d->d0[0] + t * (d->d1[0] + t * d->d2[0]), y = d->d0[1] + t * (d->d1[1] + t * d->d2[1]);
  return sqrtl(x * x + y * y);
}

static carom_separation random_pair(random_source *r, double reach) {
  const double far = reach * pow(10.0, random_between(r, 0.0, 1.5)) + 1e-9, way = random_between(r, 0.0, 6.283185307);
  const double speed = pow(10.0, random_between(r, -3.0, 1.0)),
               to = way + 3.14159265 + random_between(r, -1.0, 1.0) * reach / far * 1.5;
  const double push = random_between(r, 0.0, 4.0), along = random_between(r, 0.0, 6.283185307);
  return (carom_separation){
      {far * cos(way), far * sin(way)}, {speed * cos(to), speed * sin(to)}, {0.5 * push * cos(along), 0.5 * push * sin(along)}};
}

/* Nothing is stepped over, and what is found is a contact. */
START_TEST(pairs) {
  random_source r = {test_seed()};
  const double reach = 0.05715;
  int found = 0;
  for (int n = 0; n < 8000; n++) {
    const carom_separation d = random_pair(&r, reach);
    const double horizon = random_between(&r, 0.05, 2.0), t = carom_first_contact(&d, reach, 1e-12, horizon);
    const double until = t < horizon ? t : horizon;
    for (int s = 0; s < 300; s++) {
      const double at = until * s / 300.0;
      if (!(gap(&d, at) > reach - 1e-12L || at >= t))
        ck_abort_msg("pair %d is stepped over at %g before %g", n, at, t);
    }
    if (t <= horizon) {
      found++;
      ck_assert_msg(fabsl(gap(&d, t) - reach) < 1e-13L, "pair %d: the gap at %g is %Lg", n, t, gap(&d, t) - reach);
      const double x = d.d0[0] + t * (d.d1[0] + t * d.d2[0]), y = d.d0[1] + t * (d.d1[1] + t * d.d2[1]);
      ck_assert_double_le(x * (d.d1[0] + 2 * t * d.d2[0]) + y * (d.d1[1] + 2 * t * d.d2[1]), 1e-9);
    }
    ck_assert_double_eq(carom_first_crossing(&d, reach, horizon), t);
  }
  printf("%d of 8000 pairs meet\n", found);
  ck_assert_int_gt(found, 1600);
}
END_TEST

/* Pairs that graze: the least distance differs from reach by 1e-15 to 1e-3 of it, on either side. Below 1e-14 m
 * rounding of the polynomial decides. */
START_TEST(grazing) {
  random_source r = {test_seed()};
  const double reach = 0.05715;
  for (int n = 0; n < 20000; n++) {
    const double miss = reach * pow(10.0, random_between(&r, -15.0, -3.0)) * (random_between(&r, -1.0, 1.0) > 0.0 ? 1.0 : -1.0);
    /* past the origin at distance reach + miss, speeding up or slowing down along its way */
    const carom_separation d = {
        {-0.3, reach + miss}, {random_between(&r, 0.5, 5.0), 0.0}, {random_between(&r, -0.1, 0.4), 0.0}};
    const double t = carom_first_contact(&d, reach, 1e-12, 0.5);
    if (miss > 1e-14)
      ck_assert_msg(isinf(t), "missing by %g is taken for a contact at %g", miss, t);
    else if (miss < -1e-14 && 0.3 / d.d1[0] < 0.4)
      ck_assert_msg(t < 0.5 && fabsl(gap(&d, t) - reach) < 1e-13L, "a contact %g deep is missed: %g", -miss, t);
  }
}
END_TEST

/* Touching at first: now if closing; never if parting for good; where it closes again if not. */
START_TEST(touching) {
  const double reach = 0.05;
  carom_separation d = {{reach, 0.0}, {-1.0, 0.0}, {0.0, 0.0}};
  ck_assert_double_eq(carom_first_contact(&d, reach, 1e-12, 9.0), 0.0);
  d.d1[0] = 1.0;
  ck_assert(isinf(carom_first_contact(&d, reach, 1e-12, 9.0)));
  d.d2[0] = -0.5; /* back after 2 s */
  ck_assert_double_eq_tol(carom_first_contact(&d, reach, 1e-12, 9.0), 2.0, 1e-12);
  ck_assert(isinf(carom_first_contact(&d, reach, 1e-12, 1.9)));
  d.d0[0] -= 1e-14; /* and with a trace of an overlap */
  ck_assert_double_eq_tol(carom_first_contact(&d, reach, 1e-12, 9.0), 2.0, 1e-12);
  const double g[3] = {0.0, 1.0, -0.5}, pressed[3] = {0.0, 0.0, -1.0}, parting[3] = {-1e-15, 1.0, 0.1};
  ck_assert_double_eq_tol(carom_first_touch(g, 1e-12, 9.0), 2.0, 1e-15);
  ck_assert_double_eq(carom_first_touch(pressed, 1e-12, 9.0), 0.0);
  ck_assert(isinf(carom_first_touch(parting, 1e-12, 9.0)));
}
END_TEST

int main(void) {
  return RUN_TESTS("contact", pairs, grazing, touching);
}
