/* First contacts on quadratic paths.
 *
 * For two centres f(t) = |d0 + d1 t + d2 t^2|^2 - reach^2 is a polynomial of degree 4, f = c0 + c1 t + ... + c4 t^4. Its first
 * zero is approached from the left: with m the least f''/2 on [t, T],
 *
 *     f(t + s) >= f + f' s + m s^2     for t + s <= T
 *
 * so the first zero of the parabola, s = 2 f / (-f' + sqrt(f'^2 - 4 m f)), is not behind that of f, and where the parabola has
 * no zero, f has none. f''/2 = c2 + 3 c3 t + 6 c4 t^2 is itself a parabola, so m is known in closed form. As t rises, [t, T]
 * and with it the bound tighten; after some steps that were short the bound is taken on a short piece ahead only. No case needs
 * c4 or c3 to differ from 0.
 *
 * An event is where the gap is <= 0 and closing: M. N. Bannerman, S. Strobl, A. Formella, T. Poeschel, Stable algorithm for
 * event detection in event-driven particle dynamics, Comp. Part. Mech. 1 (2014) 191-198.
 *
 * PRESSED. Things that touch, do not close and are accelerated into each other are in contact once their gap is 0 and by
 * CAROM_SLACK less than at its greatest, not at once. They close at sqrt(2 slack acceleration) or more there, some 2e-6 m/s for
 * a sliding ball. At once they would close at 0, part at 0 where they have no spin, and be found again at the same instant
 * without end. Where only rounding presses them, as where a ball slides along a rail that it touches, their paths end before
 * the gap has fallen by so much, and there is no contact. */
#include "shot/contact.h"
#include "shot/path.h"

#include <math.h>

enum { MOST_STEPS = 1000, LONG_STEPS = 8 };

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

/* The least half curvature on [from, to]. */
static double least_half_curvature(const quartic *f, double from, double to) {
  double least = carom_lesser(half_curvature(f, from), half_curvature(f, to));
  if (f->c[4] > 0.0) {
    const double lowest = -f->c[3] / (4.0 * f->c[4]);
    if (lowest > from && lowest < to)
      least = carom_lesser(least, half_curvature(f, lowest));
  }
  return least;
}

/* The first zero of f at or after t, where f(t) > 0, up to T; or infinity. `small`: a value of f that counts as none but for a
 * last step of Newton's. */
static double zero_from_left(const quartic *f, double t, double T, double small) {
  double ahead = T; /* how far the bound reaches */
  for (int k = 0; k < MOST_STEPS; k++) {
    const double y = value(f, t), y1 = slope(f, t);
    if (y <= small && y1 < 0.0) { /* the last step, by the parabola that touches f here */
      const double own = y1 * y1 - 4.0 * half_curvature(f, t) * y;
      if (own >= 0.0) {
        const double last = t + 2.0 * y / (-y1 + sqrt(own));
        return last <= T ? carom_greater(last, 0.0) : INFINITY;
      }
    }
    const double s = carom_first_fall(y, y1, least_half_curvature(f, t, ahead));
    if (!(s > 0.0) || t + s > ahead) {
      /* nothing up to `ahead` */
      if (ahead >= T)
        return INFINITY;
      const double reached = ahead;
      ahead = carom_lesser(T, reached + 4.0 * (reached - t));
      t = reached;
      if (value(f, t) <= 0.0) /* rounding: the zero is here */
        return t;
      continue;
    }
    if (t + s == t)
      return y1 < 0.0 ? t : INFINITY;
    t += s;
    if (k >= LONG_STEPS)
      ahead = carom_lesser(T, t + 4.0 * s);
  }
  return t; /* not reached in practice: f has come as near to 0 as rounding lets it */
}

/* The first time from t on, up to T, when f begins to fall: t itself where it does so at once, the end of a rise otherwise. */
static double end_of_rise(const quartic *f, double t, double T) {
  for (int k = 0; k < MOST_STEPS; k++) {
    /* g = f' >= g(t) + g'(t) s + n s^2, n the least g''/2 = 3 c3 + 12 c4 t on [t, T] */
    const double y = slope(f, t), y1 = 2.0 * half_curvature(f, t);
    const double n = 3.0 * f->c[3] + 12.0 * f->c[4] * (f->c[4] > 0.0 ? t : T);
    if (y <= 0.0 && (y1 < 0.0 || k > 0))
      return t;
    /* where it begins at 0 or, by rounding, below, and rises, the bound is back at 0 later; where it does not rise either, the
       third derivative decides, 6 n: s = 0 if f falls by that */
    const double s = y <= 0.0 ? (n < 0.0 ? -y1 / n : INFINITY) : carom_first_fall(y, y1, n);
    if (!(s >= 0.0) || t + s > T)
      return INFINITY;
    if (s <= 1e-15 * (t + s))
      return t + s;
    t += s;
  }
  return t;
}

static quartic squared(const carom_separation *d, double reach) {
  const double *p = d->d0, *v = d->d1, *a = d->d2;
  return (quartic){{p[0] * p[0] + p[1] * p[1] - reach * reach, 2.0 * (p[0] * v[0] + p[1] * v[1]),
                    v[0] * v[0] + v[1] * v[1] + 2.0 * (p[0] * a[0] + p[1] * a[1]), 2.0 * (v[0] * a[0] + v[1] * a[1]),
                    a[0] * a[0] + a[1] * a[1]}};
}

/* What the third coordinate adds. */
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
  /* touching and not closing: the next contact is behind the turn, where it closes again; see PRESSED */
  const double turn = end_of_rise(&f, 0.0, horizon);
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

double carom_first_touch(const double g[3], double slack, double horizon) {
  double t;
  if (g[0] > slack) {
    const double D = g[1] * g[1] - 4.0 * g[2] * g[0];
    t = D >= 0.0 ? 2.0 * g[0] / (-g[1] + sqrt(D)) : INFINITY;
    return t >= 0.0 && t <= horizon ? t : INFINITY;
  }
  if (g[1] < -CAROM_NO_SPEED)
    return 0.0;
  if (!(g[2] < 0.0))
    return INFINITY;
  /* touching and not closing: where it falls to 0 again; see PRESSED */
  const double highest = g[1] > 0.0 ? g[0] - 0.25 * g[1] * g[1] / g[2] : g[0], end = carom_lesser(highest - slack, 0.0);
  t = (-g[1] - sqrt(carom_greater(g[1] * g[1] - 4.0 * g[2] * (g[0] - end), 0.0))) / (2.0 * g[2]);
  return t <= horizon ? t : INFINITY;
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
  return 2;
}
