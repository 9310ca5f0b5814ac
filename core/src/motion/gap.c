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
 * their paths end before the gap has fallen by so much, and there is no contact.
 *
 *     gap     ____
 *      |    .'    `.         Things that touch and part: `turn` is where the gap is greatest. The
 *      |  .'        `.       contact is where it has returned to 0, and has fallen by CAROM_SLACK
 *      | /            \      at least.
 *    --+/------|-------\---- time
 *      0      turn   contact
 */
#include "motion/gap.h"
#include "motion/first_zero.h"
#include "platform/promise.h"

#include <math.h>

/* A gap below this fraction of reach^2 is at its zero, but for one last step: first_zero.h. */
static const double SMALL = 1e-12;

/* c0 + c1 t + ... + c4 t^4 */
typedef struct quartic {
  double c[5];
} quartic;

static double value(const quartic *gap, double time) {
  return gap->c[0] +
         time * (gap->c[1] + time * (gap->c[2] + time * (gap->c[3] + time * gap->c[4])));
}
static double slope(const quartic *gap, double time) {
  return gap->c[1] + time * (2.0 * gap->c[2] + time * (3.0 * gap->c[3] + time * 4.0 * gap->c[4]));
}
static double half_curvature(const quartic *gap, double time) {
  return gap->c[2] + time * (3.0 * gap->c[3] + time * 6.0 * gap->c[4]);
}

static carom_gap_at quartic_at(const void *context, double time) {
  const quartic *gap = context;
  return (carom_gap_at){value(gap, time), slope(gap, time)};
}

/* The least half curvature on [start, end]. */
static double least_half_curvature(const void *context, double start, double end) {
  const quartic *gap = context;
  double least = carom_lesser(half_curvature(gap, start), half_curvature(gap, end));
  if (gap->c[4] > 0.0) {
    const double lowest = -gap->c[3] / (4.0 * gap->c[4]);
    if (lowest > start && lowest < end)
      least = carom_lesser(least, half_curvature(gap, lowest));
  }
  return least;
}

static double zero_from_left(const quartic *gap, double time, double horizon, double small) {
  return carom_first_zero(quartic_at, least_half_curvature, gap, 0.0, time, horizon, small);
}

/* The slope as a gap: g = f', and the least g''/2 = 3 c3 + 12 c4 t. */
static carom_gap_at slope_at(const void *context, double time) {
  const quartic *gap = context;
  return (carom_gap_at){slope(gap, time), 2.0 * half_curvature(gap, time)};
}
static double least_third(const void *context, double start, double end) {
  const quartic *gap = context;
  return 3.0 * gap->c[3] + 12.0 * gap->c[4] * (gap->c[4] > 0.0 ? start : end);
}

/* The first time up to the horizon when the gap begins to fall: 0 where it does so at once, the end
 * of a rise otherwise. */
static double end_of_rise(const quartic *gap, double horizon) {
  const carom_gap_at start = slope_at(gap, 0.0);
  if (start.value > 0.0)
    return carom_first_zero(slope_at, least_third, gap, 0.0, 0.0, horizon, 0.0);
  if (start.slope < 0.0)
    return 0.0;

  /* where the slope begins at 0 or, by rounding, below, and rises, its bound is back at 0 later;
     where it does not rise either, the third derivative decides: at once if it falls by that */
  const double third = least_third(gap, 0.0, horizon);
  const double back = third < 0.0 ? -start.slope / third : INFINITY;
  if (!(back > 0.0 && back <= horizon))
    return back <= 0.0 ? 0.0 : INFINITY;
  return slope(gap, back) > 0.0
             ? carom_first_zero(slope_at, least_third, gap, 0.0, back, horizon, 0.0)
             : back;
}

/* |d|^2 - reach^2 by its coefficients, in the plane. */
static quartic squared(const carom_separation *separation, double reach) {
  const double *position = separation->d0, *velocity = separation->d1;
  const double *half_acceleration = separation->d2;
  return (quartic){
      {carom_plane_dot(position, position) - reach * reach,
       2.0 * carom_plane_dot(position, velocity),
       carom_plane_dot(velocity, velocity) + 2.0 * carom_plane_dot(position, half_acceleration),
       2.0 * carom_plane_dot(velocity, half_acceleration),
       carom_plane_dot(half_acceleration, half_acceleration)}};
}

/* Adds the third coordinate. */
static void add_height(const carom_separation *separation, quartic *gap) {
  const double position = separation->d0[2], velocity = separation->d1[2];
  const double half_acceleration = separation->d2[2];
  gap->c[0] += position * position;
  gap->c[1] += 2.0 * position * velocity;
  gap->c[2] += velocity * velocity + 2.0 * position * half_acceleration;
  gap->c[3] += 2.0 * velocity * half_acceleration;
  gap->c[4] += half_acceleration * half_acceleration;
}

/* The first contact of things whose squared distance is gap + reach^2. The gap of the squares is 2
 * reach times the gap of the lengths, to first order, and so is its slope. */
static inline double first_contact(quartic gap, double reach, double horizon) {
  const double small = SMALL * reach * reach;
  if (gap.c[0] > 2.0 * reach * CAROM_SLACK)
    return zero_from_left(&gap, 0.0, horizon, small);
  if (gap.c[1] < -2.0 * reach * CAROM_NO_SPEED)
    return 0.0;

  /* touching and not closing: the next contact is behind the turn, where it closes again; see
   * PRESSED */
  const double turn = end_of_rise(&gap, horizon);
  CAROM_PROMISE(!(turn < 0.0));
  if (!(turn <= horizon))
    return INFINITY;
  gap.c[0] += carom_greater(2.0 * reach * CAROM_SLACK - value(&gap, turn), 0.0);
  return zero_from_left(&gap, turn, horizon, small);
}

double carom_first_contact(const carom_separation *separation, double reach, double horizon) {
  return first_contact(squared(separation, reach), reach, horizon);
}

double carom_first_contact_in_space(const carom_separation *separation, double reach,
                                    double horizon) {
  quartic gap = squared(separation, reach);
  add_height(separation, &gap);
  return first_contact(gap, reach, horizon);
}

double carom_first_crossing(const carom_separation *separation, double reach, double horizon) {
  quartic gap = squared(separation, reach);
  const double small = SMALL * reach * reach;
  if (gap.c[0] > 0.0)
    return zero_from_left(&gap, 0.0, horizon, small);
  if (gap.c[0] == 0.0)
    return 0.0;

  /* from inside: the gap with the other sign reaches 0 from above */
  for (int power = 0; power < 5; power++)
    gap.c[power] = -gap.c[power];
  return zero_from_left(&gap, 0.0, horizon, small);
}

int carom_quadratic_zeros(double a, double b, double c, double zero[2]) {
  if (a == 0.0) {
    zero[0] = -c / b;
    return b != 0.0;
  }
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0))
    return 0;

  /* a sum of two numbers with the same sign, which does not cancel; a zero by each of its forms */
  const double sum = -b - copysign(sqrt(discriminant), b);
  const double over_a = sum / (2.0 * a), under_c = sum != 0.0 ? 2.0 * c / sum : over_a;
  zero[0] = carom_lesser(over_a, under_c);
  zero[1] = carom_greater(over_a, under_c);
  CAROM_PROMISE(!(zero[0] > zero[1]));
  return 2;
}
