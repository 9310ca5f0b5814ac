/* Slips whose rate is small against what friction does to them: the equation is stiff there, and the direction is the
 * quasi-steady one of coulomb.c. A slip is slow
 *
 *     where it begins from zero with a rate below STIFF, as where friction has just left its cone;
 *     where it falls, once it is small and has come to that direction; likewise where it grows again
 *
 * as long as r |u'| is below SLOW of what friction does to it, and r below SLOW_SHARE of the other slip, since u' may soon be
 * larger where that one is small. Where little p is left till it ends, at zero or because it is too large, one step goes there;
 * else the integrator does. The limits were found with `carom-lab verify --cushion`: ten times larger ones let errors
 * above 1e-8 through, smaller ones cost steps. */
#include "cushion/slow.h"

#include "cushion/equations.h"

static const double SLOW = 1e-5;       /* a slow slip times how fast its direction turns, over what friction does to it */
static const double ALIGNED = 1e-4;    /* rate across a slip, over what friction does to it, that may be quasi-steady */
static const double SLOW_SHARE = 3e-3; /* of the other slip: the most that a slow one may be */
static const double SMALL = 0.1;       /* a slip that may be slow, over the approach */
static const double SHORT = 0.02;      /* p, over the other slip or 1, in which one step may take it to its end */
static const double STIFF = 2;         /* the rate of a slow slip, over that by friction alone */

/* What friction alone does to the slip of a contact; 0 if it does not slip. */
static double friction_rate(const carom_cushion_way *w, bool cloth) {
  if (cloth ? w->regime.cloth_sticks || !w->regime.loaded : w->regime.nose_sticks)
    return 0;
  const carom_slips at = slips_of(w->point.y);
  return 3.5 * (cloth ? w->law.mu_s * carom_friction_here(w, &at).g : w->law.mu_w);
}

bool carom_slip_is_stiff(const carom_cushion_way *w, bool cloth) {
  carom_slips rate = slips_of(w->point.f);
  return length(*slip_at(&rate, cloth)) < STIFF * friction_rate(w, cloth) * w->point.f[P];
}

/* How large a slow slip may be: small against what turns it, now and where the other slip may soon be. */
static double most_slow(const carom_cushion_way *w, bool cloth, double turns) {
  carom_slips at = slips_of(w->point.y);
  const double other = length(*slip_at(&at, !cloth));
  return carom_slip_is_alone(w, cloth)
             ? INFINITY
             : fmin(SLOW * friction_rate(w, cloth) / turns, other > 0 ? SLOW_SHARE * other : INFINITY);
}

/* Takes a slip as slow from here on, if it is small against what turns it. `regime` has the direction with which to begin. */
bool carom_slow_begin(carom_cushion_way *w, bool cloth, bool falls, carom_regime regime) {
  carom_slips at = slips_of(w->point.y);
  const carom_vector slip = *slip_at(&at, cloth), *const u = direction_at(&regime, cloth);
  double turns;
  if (!carom_slow_regime(w, cloth, falls, &at, &regime, &turns) || !(fabs(slip.x * u->y - slip.y * u->x) <= w->rest) ||
      slip.x * u->x + slip.y * u->y < 0)
    return false;
  const double most = most_slow(w, cloth, turns);
  if (!(length(slip) <= most))
    return false;
  w->most = fmin(most, 1);
  w->regime = regime;
  w->falls = falls;
  w->slow = cloth ? CAROM_CLOTH_IS_SLOW : CAROM_NOSE_IS_SLOW;
  *(cloth ? &w->cloth_singular : &w->nose_singular) = false;
  const carom_ode ode = carom_cushion_equations(w);
  carom_ode_set(&ode, &w->point);
  return true;
}

/* A slip may have become slow: small, stiff, and in the quasi-steady direction. */
bool carom_slow_try(carom_cushion_way *w, bool cloth) {
  carom_slips at = slips_of(w->point.y), rates = slips_of(w->point.f);
  const carom_vector slip = *slip_at(&at, cloth), rate = *slip_at(&rates, cloth);
  const double size = length(slip);
  const bool falls = slip.x * rate.x + slip.y * rate.y < 0;
  if (!(size > 0 && size < SMALL) || !carom_slip_is_stiff(w, cloth))
    return false;
  /* in the quasi-steady direction the slip turns slowly: else there is no need to look closer */
  const double turns = fabs(slip.x * rate.y - slip.y * rate.x) / size;
  if (turns > ALIGNED * friction_rate(w, cloth) * w->point.f[P])
    return false;
  carom_regime regime = w->regime;
  *direction_at(&regime, cloth) = (carom_vector){slip.x / size, slip.y / size};
  return carom_slow_begin(w, cloth, falls, regime);
}

/* After a step of a slow slip: its direction is the quasi-steady one, whatever errors have added up to. False if it is too
 * large for that now. */
bool carom_slow_keep(carom_cushion_way *w) {
  const bool cloth = w->slow == CAROM_CLOTH_IS_SLOW;
  carom_slips at = slips_of(w->point.y);
  const carom_vector slip = *slip_at(&at, cloth), *const u = direction_at(&w->regime, cloth);
  double turns;
  if (!carom_slow_regime(w, cloth, w->falls, &at, &w->regime, &turns))
    return false;
  const double size = slip.x * u->x + slip.y * u->y;
  w->point.y[cloth ? C_X : S_X] = size * u->x;
  w->point.y[cloth ? C_Y : S_T] = size * u->y;
  carom_slips rates = slips_of(w->point.f);
  const carom_vector rate = *slip_at(&rates, cloth);
  w->falls = size * (rate.x * u->x + rate.y * u->y) < 0;
  w->most = fmin(most_slow(w, cloth, turns), 1);
  return size <= w->most;
}

/* What changes while a slip is slow: its size, the other slip, p, and the work. */
typedef struct state {
  double size, x, y, p, work;
} state;

/* from + h slope */
static state beyond(const state *from, double h, const state *slope) {
  return (state){from->size + h * slope->size, from->x + h * slope->x, from->y + h * slope->y, from->p + h * slope->p,
                 from->work + h * slope->work};
}

/* Its derivative: by the size while that falls, as nothing is singular where it is zero; by p otherwise. Directions are found
 * with and put into *regime. False if the size does not change as w->falls says. */
static bool rates_of(const carom_cushion_way *w, const state *k, carom_regime *regime, state *slope) {
  const bool cloth = w->slow == CAROM_CLOTH_IS_SLOW;
  const carom_vector *const u = direction_at(regime, cloth);
  carom_slips at;
  double turns;
  *slip_at(&at, cloth) = (carom_vector){k->size * u->x, k->size * u->y};
  *slip_at(&at, !cloth) = (carom_vector){k->x, k->y};
  const double v = (at.c.y - at.s.y) * w->per_sine;
  if (!carom_slow_regime(w, cloth, w->falls, &at, regime, &turns))
    return false;
  const carom_friction friction = carom_friction_of(&w->law, regime, &at);
  carom_slips rates = carom_slip_rates(&w->law, &friction);
  const carom_vector own = *slip_at(&rates, cloth), other = *slip_at(&rates, !cloth);
  const double rate = own.x * u->x + own.y * u->y;
  const double per = w->falls ? 1 / rate : 1;
  *slope = (state){per * rate, per * other.x, per * other.y, per, per * v};
  return w->falls == (rate < 0);
}

/* One step of the classical method of order 4. */
bool carom_slow_finish(carom_cushion_way *w) {
  const bool cloth = w->slow == CAROM_CLOTH_IS_SLOW;
  if (w->slow == CAROM_NO_SLIP_IS_SLOW || carom_slip_is_alone(w, cloth))
    return false;
  const int own = cloth ? C_X : S_X, other = cloth ? S_X : C_X;
  const carom_ode_point start = w->point;
  carom_ode_point *const at = &w->point;
  const state y = {length((carom_vector){at->y[own], at->y[own + 1]}), at->y[other], at->y[other + 1], at->y[P], at->y[WORK]};
  const double longest = SHORT * fmin(length((carom_vector){y.x, y.y}), 1);
  carom_regime regime = w->regime;
  state k_1, k_2, k_3, k_4, to;
  if (!rates_of(w, &y, &regime, &k_1))
    return false;
  const double h = w->falls ? -y.size : (w->most - y.size) / k_1.size;
  if (!(h * k_1.p <= longest))
    return false;
  to = beyond(&y, 0.5 * h, &k_1);
  if (!rates_of(w, &to, &regime, &k_2))
    return false;
  to = beyond(&y, 0.5 * h, &k_2);
  if (!rates_of(w, &to, &regime, &k_3))
    return false;
  to = beyond(&y, h, &k_3);
  if (!rates_of(w, &to, &regime, &k_4) || !(h * k_4.p <= longest))
    return false;
  to = beyond(&y, h / 6, &k_1);
  to = beyond(&to, h / 3, &k_2);
  to = beyond(&to, h / 3, &k_3);
  to = beyond(&to, h / 6, &k_4);
  const carom_vector u = *direction_at(&regime, cloth);
  at->y[own] = w->falls ? 0 : to.size * u.x;
  at->y[own + 1] = w->falls ? 0 : to.size * u.y;
  at->y[other] = to.x;
  at->y[other + 1] = to.y;
  at->y[P] = to.p;
  at->y[WORK] = to.work;
  at->evaluations += 4;
  const carom_slips slips = slips_of(at->y);
  double unused;
  if (to.size <= 1.1 * w->most && carom_phase_event(w, at->y, at->f, &unused) < 0 && at->y[P] < w->to &&
      carom_violation(w, &slips) < 0)
    return true;
  *at = start;
  return false;
}

/* A slow slip has become zero, which may change the regime, or too large. */
bool carom_slow_end(carom_cushion_way *w) {
  const bool cloth = w->slow == CAROM_CLOTH_IS_SLOW;
  const carom_slips at = slips_of(w->point.y);
  w->slow = CAROM_NO_SLIP_IS_SLOW;
  if (w->falls && length(cloth ? at.c : at.s) < 0.5 * w->most) {
    w->point.y[cloth ? C_X : S_X] = w->point.y[cloth ? C_Y : S_T] = 0;
    return true;
  }
  *(cloth ? &w->cloth_singular : &w->nose_singular) = true;
  const carom_ode ode = carom_cushion_equations(w);
  carom_ode_set(&ode, &w->point);
  return false;
}
