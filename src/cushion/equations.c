/* The impact in the exact limit as a differential equation in the slips: for the integrator, and for all that asks where an
 * impact stands. While what slips has a direction sliding.c has the same equation in other unknowns.
 *
 * The unknowns are the four slips of contact.h, int v_y dp, and p = P / M itself; speeds are over the approach v_y. coulomb.c
 * has the rates by p. They say all: v_y = (c_y - s_t) / (1 + sin), and the rest follows at the end (mathavan.c).
 *
 * THE VARIABLE. Directions of slips turn quickly where a slip is small, so p is a poor variable there. With
 *
 *     dp / d(theta) = 1 / (1 + 1/|s| + 1/|c|)
 *
 * a slip that goes straight to zero is an exponential of theta, and one that passes zero at a distance a hyperbolic function:
 * entire both, so steps need not shrink. A contact that sticks, bears nothing or has no friction is left out; so is a slip that
 * has begun from zero, whose direction is smooth in p: a step is then at most a share of |s|/|s'|.
 *
 * EVENTS. One function serves the integrator: the largest of those that end the phase, violate the regime (friction of a
 * contact that sticks leaves its cone, the load of the cloth changes sign), end a slow slip, or reach the p at which to stop.
 */
#include "cushion/equations.h"

#include <float.h>

static const double TOLERANCE = 3e-11;      /* of a step, over the approach */
static const double SHARE = 0.9;            /* of |s|/|s'| that a step may go */
static const double SLOW_DIFFERENCE = 1e-5; /* of |c|/|c'|: a difference for how its direction turns */
static const double DIFFERENCE = 1e-7;      /* of |s|/|s'|: a difference for the rate of an event */

/* dp / d(theta) */
static double pace(const carom_cushion_way *w, const carom_slips *at) {
  double inverse = 1;
  if (w->nose_singular)
    inverse += 1 / length(at->s);
  if (w->cloth_singular)
    inverse += 1 / length(at->c);
  return 1 / inverse;
}

bool carom_slip_is_alone(const carom_cushion_way *w, bool cloth) {
  if (cloth)
    return w->regime.nose_sticks || !(w->law.mu_w > 0);
  return w->regime.cloth_sticks || !w->regime.loaded || !(w->law.mu_s > 0);
}

bool carom_slow_regime(const carom_cushion_way *w, bool cloth, bool falls, carom_slips *slips, carom_regime *regime,
                       double *turns) {
  const carom_vector none = {0, 0}, slip = *slip_at(slips, cloth), there = *slip_at(slips, !cloth);
  const carom_vector *const u = direction_at(regime, cloth);
  *slip_at(slips, cloth) = none;
  *turns = 0;
  if (!carom_slow_direction(&w->law, slips, cloth, falls, 0, none, regime))
    return false;
  const carom_vector now = *u;
  const double other = length(there), size = slip.x * now.x + slip.y * now.y;
  if (carom_slip_is_alone(w, cloth) || !(other > 0))
    return true;
  /* how it turns: from the direction a little later */
  const carom_friction friction = carom_friction_of(&w->law, regime, slips);
  carom_slips rates = carom_slip_rates(&w->law, &friction);
  const carom_vector rate = *slip_at(&rates, !cloth);
  const double h = SLOW_DIFFERENCE * other / (length(rate) + DBL_MIN);
  *slip_at(slips, !cloth) = (carom_vector){there.x + h * rate.x, there.y + h * rate.y};
  const bool later = carom_slow_direction(&w->law, slips, cloth, falls, 0, none, regime);
  const carom_vector turning = {(u->x - now.x) / h, (u->y - now.y) / h};
  *slip_at(slips, !cloth) = there;
  *turns = length(turning);
  return later && carom_slow_direction(&w->law, slips, cloth, falls, size, turning, regime);
}

static carom_friction slow_friction(const carom_cushion_way *w, const carom_slips *slips) {
  carom_regime regime = w->regime;
  carom_slips at = *slips;
  double turns;
  if (carom_slip_is_alone(w, w->slow == CAROM_CLOTH_IS_SLOW)) /* the direction does not change */
    *slip_at(&at, w->slow == CAROM_CLOTH_IS_SLOW) = (carom_vector){0, 0};
  else
    carom_slow_regime(w, w->slow == CAROM_CLOTH_IS_SLOW, w->falls, &at, &regime, &turns);
  return carom_friction_of(&w->law, &regime, &at);
}

carom_friction carom_friction_here(const carom_cushion_way *w, const carom_slips *slips) {
  return w->slow != CAROM_NO_SLIP_IS_SLOW ? slow_friction(w, slips) : carom_friction_of(&w->law, &w->regime, slips);
}

/* The right-hand side while both contacts slip and neither slip is slow: what follows, with each root taken once. */
static void slipping_slope(const carom_cushion_way *w, const double *y, double *f) {
  const carom_coulomb *k = &w->law;
  const double s_2 = y[S_X] * y[S_X] + y[S_T] * y[S_T], c_2 = y[C_X] * y[C_X] + y[C_Y] * y[C_Y];
  const double by_s = 1 / sqrt(s_2), by_c = 1 / sqrt(c_2);
  const double u_x = s_2 > 0 ? y[S_X] * by_s : w->regime.nose.x, u_t = s_2 > 0 ? y[S_T] * by_s : w->regime.nose.y;
  const double t_x = c_2 > 0 ? y[C_X] * by_c : w->regime.cloth.x, t_y = c_2 > 0 ? y[C_Y] * by_c : w->regime.cloth.y;
  const double rho = 1 / (1 + (w->nose_singular ? by_s : 0) + (w->cloth_singular ? by_c : 0));
  const double f_x = -k->mu_w * u_x, f_t = -k->mu_w * u_t, load = w->regime.loaded ? k->mu_s * (k->sine - k->cosine * f_t) : 0;
  const double F_x = -load * t_x, F_y = -load * t_y;
  f[S_X] = rho * (3.5 * f_x + k->k_x * F_x);
  f[S_T] = rho * (k->sine * k->cosine + k->k_t * f_t + k->k_y * F_y);
  f[C_X] = rho * (k->k_x * f_x + 3.5 * F_x);
  f[C_Y] = rho * (k->k_y * f_t + 3.5 * F_y - k->cosine);
  f[WORK] = rho * ((y[C_Y] - y[S_T]) * w->per_sine);
  f[P] = rho;
}

static void slope(const void *model, double x, const double *y, double *f) {
  (void)x;
  const carom_cushion_way *w = model;
  if (!w->regime.nose_sticks && !w->regime.cloth_sticks && w->slow == CAROM_NO_SLIP_IS_SLOW) {
    slipping_slope(w, y, f);
    return;
  }
  const carom_slips slips = slips_of(y);
  const carom_friction friction = carom_friction_here(w, &slips);
  const carom_slips rates = carom_slip_rates(&w->law, &friction);
  const double rho = pace(w, &slips), nose = w->regime.nose_sticks ? 0 : rho, cloth = w->regime.cloth_sticks ? 0 : rho;
  f[S_X] = nose * rates.s.x;
  f[S_T] = nose * rates.s.y;
  f[C_X] = cloth * rates.c.x;
  f[C_Y] = cloth * rates.c.y;
  f[WORK] = rho * speed_into(&w->law, y);
  f[P] = rho;
}

/* How far a slip may go that had been zero, before it comes near to zero again. */
static double reach(carom_vector slip, carom_vector rate) {
  return slip.x * rate.x + slip.y * rate.y < 0 ? SHARE * length(slip) / length(rate) : DBL_MAX;
}

static double longest(const void *model, double p, const double *y, const double *f) {
  (void)p;
  const carom_cushion_way *w = model;
  const carom_slips at = slips_of(y), rate = slips_of(f);
  double h = DBL_MAX;
  if (!w->regime.nose_sticks && w->law.mu_w > 0 && !w->nose_singular)
    h = reach(at.s, rate.s);
  if (!w->regime.cloth_sticks && w->regime.loaded && w->law.mu_s > 0 && !w->cloth_singular)
    h = fmin(h, reach(at.c, rate.c));
  return h;
}

static bool may_be_violated(const carom_cushion_way *w) {
  return w->law.mu_w > 0 && (w->law.mu_s > 0 || w->regime.nose_sticks);
}

double carom_violation(const carom_cushion_way *w, const carom_slips *slips) {
  if (!may_be_violated(w))
    return -INFINITY;
  const carom_friction friction = carom_friction_here(w, slips);
  if (w->regime.nose_sticks)
    return length(friction.f) / w->law.mu_w - 1;
  if (w->regime.cloth_sticks)
    return length(friction.F) / (w->law.mu_s * friction.g) - 1;
  return w->regime.loaded ? -friction.g : friction.g;
}

/* Positive behind the end of the phase. */
double carom_phase_event(const carom_cushion_way *w, const double *y, const double *f, double *rate) {
  if (w->in_restitution) {
    *rate = -f[WORK];
    return (1 - w->e * w->e) * w->work_c - y[WORK];
  }
  *rate = -speed_into(&w->law, f);
  return -speed_into(&w->law, y);
}

/* Positive where a slow slip has become zero or too large for that. */
double carom_slow_event(const carom_cushion_way *w, const double *y, const double *f, double *rate) {
  if (w->slow == CAROM_NO_SLIP_IS_SLOW)
    return -INFINITY;
  const int at = w->slow == CAROM_CLOTH_IS_SLOW ? C_X : S_X;
  const carom_vector u = w->slow == CAROM_CLOTH_IS_SLOW ? w->regime.cloth : w->regime.nose;
  const double size = (u.x * y[at] + u.y * y[at + 1]) / w->most, grows = (u.x * f[at] + u.y * f[at + 1]) / w->most;
  *rate = w->falls && size < 0.5 ? -grows : grows;
  return w->falls && size < 0.5 ? -size : size - 1;
}

double carom_cushion_event(const carom_cushion_way *w, const double *y, const double *f, double *rate) {
  double value = carom_phase_event(w, y, f, rate);
  const carom_slips at = slips_of(y);
  double slow_rate;
  const double slow = carom_slow_event(w, y, f, &slow_rate);
  if (slow > value) {
    value = slow;
    *rate = slow_rate;
  }
  if (y[P] - w->to > value) {
    value = y[P] - w->to;
    *rate = f[P];
  }
  const double other = carom_violation(w, &at);
  if (!(other > value))
    return value;
  const carom_slips by = slips_of(f);
  const double h = DIFFERENCE * fmin((length(at.s) + w->rest) / (length(by.s) + DBL_MIN),
                                     (length(at.c) + w->rest) / (length(by.c) + DBL_MIN));
  const carom_slips next = {{at.s.x + h * by.s.x, at.s.y + h * by.s.y}, {at.c.x + h * by.c.x, at.c.y + h * by.c.y}};
  *rate = (carom_violation(w, &next) - other) / h;
  return other;
}

static double event(const void *model, double x, const double *y, const double *f, double *rate) {
  (void)x;
  return carom_cushion_event(model, y, f, rate);
}

carom_ode carom_cushion_equations(const carom_cushion_way *w) {
  static const double weight[UNKNOWNS] = {1, 1, 1, 1, 0, 1};
  return (carom_ode){.size = UNKNOWNS,
                     .slope = slope,
                     .longest = longest,
                     .event = event,
                     .model = w,
                     .weight = weight,
                     .tolerance = TOLERANCE,
                     .event_tolerance = CAROM_CUSHION_EVENT_TOLERANCE};
}
