/* First contacts on quadratic paths.
 *
 * For two centres f(t) = |d0 + d1 t + d2 t^2|^2 - reach^2 is a polynomial of degree 4, f = c0 +
 * c1 t + ... + c4 t^4, whose first zero is searched by first_zero.h. f''/2 = c2 + 3 c3 t + 6 c4
 * t^2 is itself a parabola, so its least value on an interval is known in closed form. No case
 * needs c4 or c3 to differ from 0.
 *
 * An event is where the gap is <= 0 and closing: M. N. Bannerman, S. Strobl, A. Formella, T.
 * Poeschel, Stable algorithm for event detection in event-driven particle dynamics, Comp. Part.
 * Mech. 1 (2014) 191-198.
 *
 * PRESSED. Things that touch, do not close and are accelerated into each other are in contact
 * once their gap is 0 and by CAROM_SLACK less than at its greatest, not at once. They close at
 * sqrt(2 slack acceleration) or more there, some 2e-6 m/s for a sliding ball. At once they would
 * close at 0, part at 0 where they have no spin, and be found again at the same instant without
 * end. Where only rounding presses them, as where a ball slides along a rail that it touches,
 * their paths end before the gap has fallen by so much, and there is no contact. */
#include "motion/gap.h"
#include "motion/first_zero.h"
#include "platform/promise.h"

#include <math.h>

/* c0 + c1 t + ... + c4 t^4 */
typedef struct quartic {
  double c[5];
} quartic;

static double value(const quartic *f, double t) {
  return f->c[0] + t * (f->c[1] + t * (f->c[2] + t * (f->c[3] + t * f->c[4])));
}
static double slope(const quartic *f, double t) {
  return f->c[1] + t * (2.0 * f->c[2] + t * (3.0 * f->c[3] + t * 4.0 * f->c[4]));
}
static double half_curvature(const quartic *f, double t) {
  return f->c[2] + t * (3.0 * f->c[3] + t * 6.0 * f->c[4]);
}

static carom_gap_at quartic_at(const void *context, double t) {
  const quartic *f = context;
  return (carom_gap_at){value(f, t), slope(f, t)};
}

/* The least half curvature on [from, to]. */
static double least_half_curvature(const void *context, double start, double end) {
  const quartic *f = context;
  double least = carom_lesser(half_curvature(f, start), half_curvature(f, end));
  if (f->c[4] > 0.0) {
    const double lowest = -f->c[3] / (4.0 * f->c[4]);
    if (lowest > start && lowest < end)
      least = carom_lesser(least, half_curvature(f, lowest));
  }
  return least;
}

static double zero_from_left(const quartic *f, double t, double T, double small) {
  return carom_first_zero(quartic_at, least_half_curvature, f, 0.0, t, T, small);
}

/* The slope as a gap: g = f', and the least g''/2 = 3 c3 + 12 c4 t. */
static carom_gap_at slope_at(const void *context, double t) {
  const quartic *f = context;
  return (carom_gap_at){slope(f, t), 2.0 * half_curvature(f, t)};
}
static double least_third(const void *context, double start, double end) {
  const quartic *f = context;
  return 3.0 * f->c[3] + 12.0 * f->c[4] * (f->c[4] > 0.0 ? start : end);
}

/* The first time up to T when f begins to fall: 0 where it does so at once, the end of a rise
 * otherwise. */
static double end_of_rise(const quartic *f, double T) {
  const carom_gap_at start = slope_at(f, 0.0);
  if (start.value > 0.0)
    return carom_first_zero(slope_at, least_third, f, 0.0, 0.0, T, 0.0);
  if (start.slope < 0.0)
    return 0.0;
  /* where the slope begins at 0 or, by rounding, below, and rises, its bound is back at 0 later;
     where it does not rise either, the third derivative decides: at once if f falls by that */
  const double third = least_third(f, 0.0, T), back = third < 0.0 ? -start.slope / third : INFINITY;
  if (!(back > 0.0 && back <= T))
    return back <= 0.0 ? 0.0 : INFINITY;
  return slope(f, back) > 0.0 ? carom_first_zero(slope_at, least_third, f, 0.0, back, T, 0.0)
                              : back;
}

static quartic squared(const carom_separation *d, double reach) {
  const double *p = d->d0, *v = d->d1, *a = d->d2;
  return (quartic){{carom_plane_dot(p, p) - reach * reach, 2.0 * carom_plane_dot(p, v),
                    carom_plane_dot(v, v) + 2.0 * carom_plane_dot(p, a),
                    2.0 * carom_plane_dot(v, a), carom_plane_dot(a, a)}};
}

/* Adds the third coordinate. */
static void add_height(const carom_separation *d, quartic *f) {
  const double p = d->d0[2], v = d->d1[2], a = d->d2[2];
  f->c[0] += p * p;
  f->c[1] += 2.0 * p * v;
  f->c[2] += v * v + 2.0 * p * a;
  f->c[3] += 2.0 * v * a;
  f->c[4] += a * a;
}

/* The first contact of things whose squared distance is f + reach^2. */
static inline double first_contact(quartic f, double reach, double horizon) {
  const double small = 1e-12 * reach * reach;
  if (f.c[0] > 2.0 * reach * CAROM_SLACK)
    return zero_from_left(&f, 0.0, horizon, small);
  if (f.c[1] < -2.0 * reach * CAROM_NO_SPEED)
    return 0.0;
  /* touching and not closing: the next contact is behind the turn, where it closes again; see
   * PRESSED */
  const double turn = end_of_rise(&f, horizon);
  CAROM_PROMISE(!(turn < 0.0));
  if (!(turn <= horizon))
    return INFINITY;
  f.c[0] += carom_greater(2.0 * reach * CAROM_SLACK - value(&f, turn), 0.0);
  return zero_from_left(&f, turn, horizon, small);
}

double carom_first_contact(const carom_separation *d, double reach, double horizon) {
  return first_contact(squared(d, reach), reach, horizon);
}

double carom_first_contact_in_space(const carom_separation *d, double reach, double horizon) {
  quartic f = squared(d, reach);
  add_height(d, &f);
  return first_contact(f, reach, horizon);
}

double carom_first_crossing(const carom_separation *d, double reach, double horizon) {
  quartic f = squared(d, reach);
  const double small = 1e-12 * reach * reach;
  if (f.c[0] > 0.0)
    return zero_from_left(&f, 0.0, horizon, small);
  if (f.c[0] == 0.0)
    return 0.0;
  for (int k = 0; k < 5; k++)
    f.c[k] = -f.c[k];
  return zero_from_left(&f, 0.0, horizon, small);
}

int carom_quadratic_zeros(double a, double b, double c, double zero[2]) {
  if (a == 0.0) {
    zero[0] = -c / b;
    return b != 0.0;
  }
  const double D = b * b - 4.0 * a * c;
  if (!(D >= 0.0))
    return 0;
  const double q = -b - copysign(sqrt(D), b);
  const double x = q / (2.0 * a), y = q != 0.0 ? 2.0 * c / q : x;
  zero[0] = carom_lesser(x, y);
  zero[1] = carom_greater(x, y);
  CAROM_PROMISE(!(zero[0] > zero[1]));
  return 2;
}
