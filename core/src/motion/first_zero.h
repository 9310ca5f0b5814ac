/* The first zero of a gap, approached from the left so that none is stepped over.
 *
 * A gap g has its value and slope at t, and a bound m <= g''/2 on any [t, T]. Then
 *
 *     g(t + s) >= g + g' s + m s^2     for t + s <= T
 *
 * so the first zero of the parabola, s = 2 g / (-g' + sqrt(g'^2 - 4 m g)), is not behind that of g,
 * and where the parabola has no zero, g has none. As t rises, [t, T] and with it the bound tighten;
 * after some short steps the bound is only used for a short piece ahead.
 *
 *     gap
 *      |\
 *      | \ .            . the parabola below g, which has its value and slope at t
 *      |  \  .
 *      |    \_ .  ____      its zero is before that of g, or at it
 *      |      `-.'    \
 *    --+---------.-----\----- time
 *      t        t+s      zero of g
 */
#ifndef CAROM_SRC_MOTION_FIRST_ZERO_H
#define CAROM_SRC_MOTION_FIRST_ZERO_H

#include "motion/path.h"

#include <math.h>

/* The root of the discriminant is the slope but for this fraction of its square: then their
 * difference has lost half of its digits. */
#define CAROM_ROOT_IS_SLOPE 1e-8

/* The first s >= 0 at which value + slope s + bend s^2 is 0, for value > 0; infinite where it is
 * not. Where the usual form of the zero would lose half of its digits, or all of them, it has the
 * other. */
static inline double carom_first_fall(double value, double slope, double bend) {
  const double discriminant = slope * slope - 4.0 * bend * value;
  if (!(discriminant >= 0.0))
    return INFINITY;
  if (!(slope > 0.0 && discriminant < slope * slope * (1.0 + CAROM_ROOT_IS_SLOPE)))
    return 2.0 * value / (-slope + sqrt(discriminant));
  return bend < 0.0 ? (slope + sqrt(discriminant)) / (-2.0 * bend) : INFINITY;
}

typedef struct carom_gap_at {
  double value, slope;
} carom_gap_at;

/* A gap, as functions of its description. They are constants where the search is inlined. */
typedef carom_gap_at carom_gap(const void *context, double t);
typedef double carom_gap_bound(const void *context, double start, double end);

/* The first zero of g + raise at or after `time`, where that is positive, up to `horizon`; or
 * infinity. `small`: a value that counts as none but for a last step, by the parabola that touches
 * g there. */
static inline __attribute__((always_inline)) double
carom_first_zero(carom_gap *gap, carom_gap_bound *bound, const void *context, double raise,
                 double time, double horizon, double small) {
  /* after LONG_STEPS the bound reaches AHEAD times as far as the last step, or as the last bound */
  enum { MOST_STEPS = 1000, LONG_STEPS = 8 };
#define AHEAD 4.0
  double ahead = horizon; /* how far the bound reaches */
  for (int steps = 0; steps < MOST_STEPS; steps++) {
    const carom_gap_at gap_here = gap(context, time);
    const double value = gap_here.value + raise, slope = gap_here.slope;

    /* nearly at the zero: the last step */
    if (value <= small && slope < 0.0) {
      const double discriminant = slope * slope - 4.0 * bound(context, time, time) * value;
      if (discriminant >= 0.0) {
        const double last = time + 2.0 * value / (-slope + sqrt(discriminant));
        return last <= horizon ? carom_greater(last, 0.0) : INFINITY;
      }
    }

    const double step = carom_first_fall(value, slope, bound(context, time, ahead));
    if (!(step > 0.0) || time + step > ahead) {
      /* no zero up to `ahead` */
      if (ahead >= horizon)
        return INFINITY;
      const double reached = ahead;
      ahead = carom_lesser(horizon, reached + AHEAD * (reached - time));
      time = reached;
      if (gap(context, time).value + raise <= 0.0) /* by rounding it is here */
        return time;
      continue;
    }

    /* a step too short to count: at the zero, or where the gap rises from it */
    if (time + step == time)
      return slope < 0.0 ? time : INFINITY;
    time += step;
    if (steps >= LONG_STEPS)
      ahead = carom_lesser(horizon, time + AHEAD * step);
  }
#undef AHEAD
  return time; /* not reached in practice: g is as near to 0 as rounding allows */
}

#endif
