/* The first zero of a gap, approached from the left so that none is stepped over.
 *
 * A gap g has its value and slope at t, and a bound m <= g''/2 on any [t, T]. Then
 *
 *     g(t + s) >= g + g' s + m s^2     for t + s <= T
 *
 * so the first zero of the parabola, s = 2 g / (-g' + sqrt(g'^2 - 4 m g)), is not behind that of
 * g, and where the parabola has no zero, g has none. As t rises, [t, T] and with it the bound
 * tighten; after some steps that were short the bound is taken on a short piece ahead only. */
#ifndef CAROM_SRC_MOTION_FIRST_ZERO_H
#define CAROM_SRC_MOTION_FIRST_ZERO_H

#include "motion/path.h"

#include <math.h>

/* The first s >= 0 at which y + y1 s + m s^2 is 0, for y > 0; infinite where it is not. Where
 * the usual form of the zero would lose half of its digits, or all of them, it has the other. */
static inline double carom_first_fall(double y, double y1, double m) {
  const double D = y1 * y1 - 4.0 * m * y;
  if (!(D >= 0.0))
    return INFINITY;
  if (!(y1 > 0.0 && D < y1 * y1 * (1.0 + 1e-8)))
    return 2.0 * y / (-y1 + sqrt(D));
  return m < 0.0 ? (y1 + sqrt(D)) / (-2.0 * m) : INFINITY;
}

typedef struct carom_gap_at {
  double value, slope;
} carom_gap_at;

/* A gap, as functions of its description. They are constants where the search is inlined. */
typedef carom_gap_at carom_gap(const void *context, double t);
typedef double carom_gap_bound(const void *context, double start, double end);

/* The first zero of g + raise at or after t, where that is positive, up to T; or infinity.
 * `small`: a value that counts as none but for a last step, by the parabola that touches g
 * there. */
static inline __attribute__((always_inline)) double
carom_first_zero(carom_gap *gap, carom_gap_bound *bound, const void *context, double raise,
                 double t, double T, double small) {
  enum { MOST_STEPS = 1000, LONG_STEPS = 8 };
  double ahead = T; /* how far the bound reaches */
  for (int k = 0; k < MOST_STEPS; k++) {
    const carom_gap_at gap_here = gap(context, t);
    const double y = gap_here.value + raise, y1 = gap_here.slope;
    if (y <= small && y1 < 0.0) {
      const double discriminant = y1 * y1 - 4.0 * bound(context, t, t) * y;
      if (discriminant >= 0.0) {
        const double last = t + 2.0 * y / (-y1 + sqrt(discriminant));
        return last <= T ? carom_greater(last, 0.0) : INFINITY;
      }
    }

    const double s = carom_first_fall(y, y1, bound(context, t, ahead));
    if (!(s > 0.0) || t + s > ahead) {
      /* no zero up to `ahead` */
      if (ahead >= T)
        return INFINITY;
      const double reached = ahead;
      ahead = carom_lesser(T, reached + 4.0 * (reached - t));
      t = reached;
      if (gap(context, t).value + raise <= 0.0) /* by rounding it is here */
        return t;
      continue;
    }
    if (t + s == t)
      return y1 < 0.0 ? t : INFINITY;
    t += s;
    if (k >= LONG_STEPS)
      ahead = carom_lesser(T, t + 4.0 * s);
  }
  return t; /* not reached in practice: g has come as near to 0 as rounding lets it */
}

#endif
