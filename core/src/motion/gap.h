/* When two things on quadratic paths first touch: zeros of polynomials of the time since now,
 * that cannot be stepped over. See gap.c. */
#ifndef CAROM_SRC_MOTION_GAP_H
#define CAROM_SRC_MOTION_GAP_H

#include <math.h>

#include "platform/arithmetic.h"
#include "platform/ranges.h"
#include "platform/vectors.h"

#include <stdbool.h>

/* Touching things that close at less than this, m/s, do so by rounding. */
#define CAROM_NO_SPEED 1e-11
/* A gap, m, up to which things that close are in contact. */
#define CAROM_SLACK 1e-12
/* A ball that is deeper than this, m, in a rail or a nose is not in contact with it. */
#define CAROM_BEHIND 1e-6

/* d(t) = d0 + d1 t + d2 t^2: from one centre to the other. The third coordinate is only read by
 * functions that say so. */
typedef struct carom_separation {
  double d0[3], d1[3], d2[3];
} carom_separation;

/* The first time in [0, horizon] when |d(t)| = reach, or infinity: coming from outside, or, if
 * the start is inside, going out.
 */
double carom_first_crossing(const carom_separation *separation, double reach, double horizon);

/* The first time in [0, horizon] when |d(t)| <= reach and falling, or infinity. A start with a
 * gap up to CAROM_SLACK, closing, is a contact now; one that does not close is in contact where
 * the gap has fallen by that from its greatest. */
double carom_first_contact(const carom_separation *separation, double reach, double horizon);

/* The same in space, with the third coordinate. */
double carom_first_contact_in_space(const carom_separation *separation, double reach,
                                    double horizon);

/* The same for a gap of gap[0] + gap[1] t + gap[2] t^2: its distance, its speed and its bend, which
 * is half of its acceleration. The first time when it is <= 0 and falling, with `slack`, m,
 * instead. */
static inline double carom_first_touch(const double gap[3], double slack, double horizon) {
  if (gap[0] <= slack && gap[1] < -CAROM_NO_SPEED)
    return 0.0;
  /* a gap that bends down and is open at the horizon has no zero before it */
  if (gap[2] <= 0.0 && gap[0] + horizon * (gap[1] + horizon * gap[2]) > CAROM_SLACK)
    return INFINITY;

  double time;
  if (gap[0] > slack) {
    /* of the two forms of this zero the one whose sum does not cancel: a gap of 2e-9 m that opens
       at 0.5 m/s and closes again was met 3e-9 s late by the other */
    const double discriminant = gap[1] * gap[1] - 4.0 * gap[2] * gap[0];
    const double root = sqrt(carom_greater(discriminant, 0.0));
    const double over = gap[1] > 0.0 ? -gap[1] - root : 2.0 * gap[0];
    const double under = gap[1] > 0.0 ? 2.0 * gap[2] : root - gap[1];
    time = discriminant >= 0.0 ? over / under : INFINITY;
    return time >= 0.0 && time <= horizon ? time : INFINITY;
  }
  if (!(gap[2] < 0.0))
    return INFINITY;

  /* touching and not closing: where it falls to 0 again; see PRESSED */
  const double highest = gap[1] > 0.0 ? gap[0] - 0.25 * gap[1] * gap[1] / gap[2] : gap[0];
  const double end = carom_lesser(highest - slack, 0.0);
  time = (-gap[1] - sqrt(carom_greater(gap[1] * gap[1] - 4.0 * gap[2] * (gap[0] - end), 0.0))) /
         (2.0 * gap[2]);
  return time <= horizon ? time : INFINITY;
}

/* Both real zeros of a t^2 + b t + c, the earlier first; the number of them. a may be 0. */
int carom_quadratic_zeros(double a, double b, double c, double zero[2]);

#endif
