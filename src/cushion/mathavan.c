/* The exact limit of the model of the 2010 paper: impulses at nose and cloth as a differential equation in p = P / M.
 *
 * The unknowns are the four slips of contact.h, whose rates coulomb.c gives, and int v_y dp. They say all:
 * v_y = (c_y - s_t) / (1 + sin), and the frictions' impulses Q = int f dp, G = int F dp follow at the end from the changes of
 * the slips, in which they are linear:
 *
 *     7/2 Q_x + k_x G_x = s_x - s_x0                              k_x Q_x + 7/2 G_x = c_x - c_x0
 *     k_t Q_t + k_y G_y = s_t - s_t0 - sin cos p                  k_y Q_t + 7/2 G_y = c_y - c_y0 + cos p
 *
 * so the balance of momentum is exact. Speeds are over the approach v_y; platform/integrate.c takes the steps.
 *
 * REGIMES. Within a regime (what sticks, whether the cloth is loaded) the right-hand side is smooth but for the direction of a
 * slip that comes near to zero; a step is at most a share of |s|/|s'|, the radius in which the solution is analytic. A regime
 * ends
 *
 *     where a slip is zero (REST)                                           steps shrink towards it until it is
 *     where the friction that holds a contact leaves the cone               event
 *     where the load of the cloth, g, passes zero                           event
 *
 * and carom_decide() says what follows. Compression ends at v_y = 0, the impact where the work given back is e^2 of that of
 * compression: events too. A ball that is wedged (both contacts stick, v_y = 0) stays so whatever the impulse: the impact ends
 * there, and what has not been given back is lost.
 *
 * BOUNDS. MOST_CHANGES of the regime and CAROM_CUSHION_BUDGET right-hand sides; beyond either the result is
 * CAROM_ERROR_UNRESOLVED. */
#include "cushion/mathavan.h"
#include "cushion/models.h"

#include <float.h>

static const double TOLERANCE = 3e-11; /* of a step, over the approach */
static const double EVENT_TOLERANCE = 1e-8;
static const double SHARE = 0.9; /* of |s|/|s'| that a step may go */
static const double NEARLY = 1e-6;
static const double REST = 1e-11;           /* a slip that is none, over the approach and the largest slip together */
static const double CORNER = 5e-9;          /* slips at both contacts together that are none, likewise */
static const double MOST_SLIP = 1e100;      /* over the approach; squares of more would overflow */
static const double SLOW = 1e-5;            /* a slow slip times how fast its direction turns, over what friction does to it */
static const double ALIGNED = 1e-4;         /* rate across a slip, over what friction does to it, that may be quasi-steady */
static const double SLOW_SHARE = 1e-3;      /* of the other slip: the most that a slow one may be */
static const double SMALL = 0.1;            /* a slip that may be slow, over the approach */
static const double STIFF = 2;              /* the rate of a slow slip, over that by friction alone */
static const double SLOW_DIFFERENCE = 1e-5; /* of |c|/|c'|: a difference for how its direction turns */
static const double DIFFERENCE = 1e-7;      /* of |s|/|s'|: a difference for the rate of an event */
enum { MOST_CHANGES = 64 };
enum { S_X, S_T, C_X, C_Y, WORK, P, UNKNOWNS }; /* y */

static carom_slips slips_of(const double *y) {
  return (carom_slips){{y[S_X], y[S_T]}, {y[C_X], y[C_Y]}};
}

static double length(carom_vector a) {
  return sqrt(a.x * a.x + a.y * a.y);
}

static double speed_into(const carom_coulomb *law, const double *y) {
  return (y[C_Y] - y[S_T]) / (1 + law->sine);
}

/* dp / d(theta) */
static double pace(const carom_cushion_way *w, const carom_slips *at) {
  double inverse = 1;
  if (w->nose_singular)
    inverse += 1 / length(at->s);
  if (w->cloth_singular)
    inverse += 1 / length(at->c);
  return 1 / inverse;
}

static carom_vector *slip_at(carom_slips *slips, bool cloth) {
  return cloth ? &slips->c : &slips->s;
}

static carom_vector *direction_at(carom_regime *regime, bool cloth) {
  return cloth ? &regime->cloth : &regime->nose;
}

/* Whether nothing that changes acts on the direction of a slip, as the other contact sticks or has no friction. */
static bool is_alone(const carom_cushion_way *w, bool cloth) {
  if (cloth)
    return w->regime.nose_sticks || !(w->law.mu_w > 0);
  return w->regime.cloth_sticks || !w->regime.loaded || !(w->law.mu_s > 0);
}

/* The regime with the direction of a slow slip (see coulomb.c), which *slips is left without, and how fast it turns. False if
 * there is none. */
static bool slow_regime(const carom_cushion_way *w, bool cloth, bool falls, carom_slips *slips, carom_regime *regime,
                        double *turns) {
  const carom_vector none = {0, 0}, slip = *slip_at(slips, cloth), there = *slip_at(slips, !cloth);
  const carom_vector *const u = direction_at(regime, cloth);
  *slip_at(slips, cloth) = none;
  *turns = 0;
  if (!carom_slow_direction(&w->law, slips, cloth, falls, 0, none, regime))
    return false;
  const carom_vector now = *u;
  const double other = length(there), size = slip.x * now.x + slip.y * now.y;
  if (is_alone(w, cloth) || !(other > 0))
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
  if (is_alone(w, w->slow == CAROM_CLOTH_IS_SLOW)) /* the direction does not change */
    *slip_at(&at, w->slow == CAROM_CLOTH_IS_SLOW) = (carom_vector){0, 0};
  else
    slow_regime(w, w->slow == CAROM_CLOTH_IS_SLOW, w->falls, &at, &regime, &turns);
  return carom_friction_of(&w->law, &regime, &at);
}

static carom_friction friction_at(const carom_cushion_way *w, const carom_slips *slips) {
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
  const carom_friction friction = friction_at(w, &slips);
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

/* By how much the regime is violated: the friction of a contact that sticks beyond the cone, as a share of it, or the load of
 * the wrong sign. */
static double violation(const carom_cushion_way *w, const carom_slips *slips) {
  const carom_friction friction = friction_at(w, slips);
  if (w->regime.nose_sticks)
    return length(friction.f) / w->law.mu_w - 1;
  if (w->regime.cloth_sticks)
    return length(friction.F) / (w->law.mu_s * friction.g) - 1;
  return w->regime.loaded ? -friction.g : friction.g;
}

static bool may_be_violated(const carom_cushion_way *w) {
  return w->law.mu_w > 0 && (w->law.mu_s > 0 || w->regime.nose_sticks);
}

/* Positive behind the end of the phase. */
static double phase_event(const carom_cushion_way *w, const double *y, const double *f, double *rate) {
  if (w->in_restitution) {
    *rate = -f[WORK];
    return (1 - w->e * w->e) * w->work_c - y[WORK];
  }
  *rate = -speed_into(&w->law, f);
  return -speed_into(&w->law, y);
}

/* Positive where a slow slip has become zero or too large for that. */
static double slow_event(const carom_cushion_way *w, const double *y, const double *f, double *rate) {
  if (w->slow == CAROM_NO_SLIP_IS_SLOW)
    return -INFINITY;
  const int at = w->slow == CAROM_CLOTH_IS_SLOW ? C_X : S_X;
  const carom_vector u = w->slow == CAROM_CLOTH_IS_SLOW ? w->regime.cloth : w->regime.nose;
  const double size = (u.x * y[at] + u.y * y[at + 1]) / w->most, grows = (u.x * f[at] + u.y * f[at + 1]) / w->most;
  *rate = w->falls && size < 0.5 ? -grows : grows;
  return w->falls && size < 0.5 ? -size : size - 1;
}

/* Positive behind the end of the regime or of the phase: the larger of the two. */
static double event(const void *model, double p, const double *y, const double *f, double *rate) {
  (void)p;
  const carom_cushion_way *w = model;
  double value = phase_event(w, y, f, rate);
  const carom_slips at = slips_of(y);
  double slow_rate;
  const double slow = slow_event(w, y, f, &slow_rate);
  if (slow > value) {
    value = slow;
    *rate = slow_rate;
  }
  if (y[P] - w->to > value) {
    value = y[P] - w->to;
    *rate = f[P];
  }
  if (!may_be_violated(w))
    return value;
  const double other = violation(w, &at);
  if (!(other > value))
    return value;
  const carom_slips by = slips_of(f);
  const double h = DIFFERENCE * fmin((length(at.s) + w->rest) / (length(by.s) + DBL_MIN),
                                     (length(at.c) + w->rest) / (length(by.c) + DBL_MIN));
  const carom_slips next = {{at.s.x + h * by.s.x, at.s.y + h * by.s.y}, {at.c.x + h * by.c.x, at.c.y + h * by.c.y}};
  *rate = (violation(w, &next) - other) / h;
  return other;
}

static carom_ode equations(const carom_cushion_way *w) {
  static const double weight[UNKNOWNS] = {1, 1, 1, 1, 0, 1};
  return (carom_ode){.size = UNKNOWNS,
                     .slope = slope,
                     .longest = longest,
                     .event = event,
                     .model = w,
                     .weight = weight,
                     .tolerance = TOLERANCE,
                     .event_tolerance = EVENT_TOLERANCE};
}

/* What friction alone does to the slip of a contact; 0 if it does not slip. */
static double friction_rate(const carom_cushion_way *w, bool cloth) {
  if (cloth ? w->regime.cloth_sticks || !w->regime.loaded : w->regime.nose_sticks)
    return 0;
  const carom_slips at = slips_of(w->point.y);
  return 3.5 * (cloth ? w->law.mu_s * friction_at(w, &at).g : w->law.mu_w);
}

static bool is_stiff(const carom_cushion_way *w, bool cloth) {
  carom_slips rate = slips_of(w->point.f);
  return length(*slip_at(&rate, cloth)) < STIFF * friction_rate(w, cloth) * w->point.f[P];
}

/* How large a slow slip may be: small against what turns it, now and where the other slip may soon be. */
static double most_slow(const carom_cushion_way *w, bool cloth, double turns) {
  carom_slips at = slips_of(w->point.y);
  const double other = length(*slip_at(&at, !cloth));
  return is_alone(w, cloth) ? INFINITY
                            : fmin(SLOW * friction_rate(w, cloth) / turns, other > 0 ? SLOW_SHARE * other : INFINITY);
}

/* Takes a slip as slow from here on, if it is small against what turns it. `regime` has the direction with which to begin. */
static bool begin_slow(carom_cushion_way *w, bool cloth, bool falls, carom_regime regime) {
  carom_slips at = slips_of(w->point.y);
  const carom_vector slip = *slip_at(&at, cloth), *const u = direction_at(&regime, cloth);
  double turns;
  if (!slow_regime(w, cloth, falls, &at, &regime, &turns) || !(fabs(slip.x * u->y - slip.y * u->x) <= w->rest))
    return false;
  const double most = most_slow(w, cloth, turns);
  if (!(length(slip) <= most))
    return false;
  w->most = fmin(most, 1);
  w->regime = regime;
  w->falls = falls;
  w->slow = cloth ? CAROM_CLOTH_IS_SLOW : CAROM_NOSE_IS_SLOW;
  *(cloth ? &w->cloth_singular : &w->nose_singular) = false;
  const carom_ode ode = equations(w);
  carom_ode_set(&ode, &w->point);
  return true;
}

/* A slip may have become slow: small, stiff, and in the quasi-steady direction. One that grows stays so only alone. */
static bool becomes_slow(carom_cushion_way *w, bool cloth) {
  carom_slips at = slips_of(w->point.y), rates = slips_of(w->point.f);
  const carom_vector slip = *slip_at(&at, cloth), rate = *slip_at(&rates, cloth);
  const double size = length(slip);
  const bool falls = slip.x * rate.x + slip.y * rate.y < 0;
  if (!(size > 0 && size < SMALL) || !(falls || is_alone(w, cloth)) || !is_stiff(w, cloth))
    return false;
  /* in the quasi-steady direction the slip turns slowly: else there is no need to look closer */
  const double turns = fabs(slip.x * rate.y - slip.y * rate.x) / size;
  if (turns > ALIGNED * friction_rate(w, cloth) * w->point.f[P])
    return false;
  carom_regime regime = w->regime;
  *direction_at(&regime, cloth) = (carom_vector){slip.x / size, slip.y / size};
  return begin_slow(w, cloth, falls, regime);
}

/* After a step of a slow slip: its direction is the quasi-steady one, whatever errors have added up to. False if it is too
 * large for that now. */
static bool keep_slow(carom_cushion_way *w) {
  const bool cloth = w->slow == CAROM_CLOTH_IS_SLOW;
  carom_slips at = slips_of(w->point.y);
  const carom_vector slip = *slip_at(&at, cloth), *const u = direction_at(&w->regime, cloth);
  double turns;
  if (!slow_regime(w, cloth, w->falls, &at, &w->regime, &turns))
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

/* The regime from here on. */
static carom_status change(carom_cushion_way *w) {
  carom_slips at = slips_of(w->point.y);
  if (w->changes++ >= MOST_CHANGES || !carom_decide(&w->law, &at, w->rest, &w->regime))
    return CAROM_ERROR_UNRESOLVED;
  w->point.y[S_X] = at.s.x;
  w->point.y[S_T] = at.s.y;
  w->point.y[C_X] = at.c.x;
  w->point.y[C_Y] = at.c.y;
  w->nose_singular = w->law.mu_w > 0 && !w->regime.nose_sticks && length(at.s) > 0;
  w->cloth_singular = w->law.mu_s > 0 && w->regime.loaded && !w->regime.cloth_sticks && length(at.c) > 0;
  w->wedged = w->regime.nose_sticks && w->regime.cloth_sticks;
  w->slow = CAROM_NO_SLIP_IS_SLOW;
  const carom_ode ode = equations(w);
  carom_ode_set(&ode, &w->point);
  /* slips that begin with a small rate */
  if (!w->nose_singular && is_stiff(w, false))
    begin_slow(w, false, false, w->regime);
  else if (!w->cloth_singular && is_stiff(w, true))
    begin_slow(w, true, false, w->regime);
  return CAROM_OK;
}

carom_status carom_cushion_way_begin(const carom_contact *c, carom_cushion_way *w) {
  const double per = 1 / c->v_y;
  *w = (carom_cushion_way){
      .per_sine = 1 / (1 + c->sine),

      .law = {.sine = c->sine,
              .cosine = c->cosine,
              .mu_s = c->mu_s,
              .mu_w = c->mu_w,
              .k_x = 1 - 2.5 * c->sine,
              .k_t = 2.5 + c->sine * c->sine,
              .k_y = 2.5 - c->sine},
      .e = c->e,
      .approach = c->v_y,
      .start = {{per * carom_slip_x(c), per * carom_slip_t(c)}, {per * carom_cloth_x(c), per * carom_cloth_y(c)}}};
  const double most = fabs(w->start.s.x) + fabs(w->start.s.y) + fabs(w->start.c.x) + fabs(w->start.c.y);
  if (!(most < MOST_SLIP))
    return CAROM_ERROR_OVERFLOW;
  w->rest = REST * (1 + most);
  w->point = (carom_ode_point){.y = {w->start.s.x, w->start.s.y, w->start.c.x, w->start.c.y}, .next = 0.5};
  return change(w);
}

/* Goes on by a small p along the tangent. */
static void go_on(carom_ode_point *at, double p) {
  for (int k = 0; k < UNKNOWNS; k++)
    at->y[k] += at->f[k] / at->f[P] * p;
}

/* From where a phase has ended, but for EVENT_TOLERANCE, to its end by the parabola of the work. */
static void end_phase(carom_cushion_way *w) {
  carom_ode_point *at = &w->point;
  const double v = speed_into(&w->law, at->y), dv = speed_into(&w->law, at->f) / at->f[P];
  if (!w->in_restitution) {
    w->in_restitution = true;
    w->work_c = at->y[WORK] - v * v / (2 * dv);
    w->ended = !(w->e * w->e * w->work_c > 0);
    if (w->ended)
      go_on(at, -v / dv);
  } else {
    /* v q + dv q^2 / 2 = what is missing of the work */
    const double missing = (1 - w->e * w->e) * w->work_c - at->y[WORK], root = sqrt(fmax(v * v + 2 * dv * missing, 0));
    go_on(at, missing != 0 ? 2 * missing / (v - root) : 0);
    w->ended = true;
  }
}

/* One regime, or what is left to `most` (of p) of it, of an impact without motion along the cushion. Then the directions of the
 * slips are constant, and so are all rates: closed form. Returns whether the regime has ended. */
static bool go_straight(carom_cushion_way *w, double most) {
  carom_ode_point *at = &w->point;
  double rate[UNKNOWNS];
  for (int k = 0; k < UNKNOWNS; k++)
    rate[k] = at->f[k] / at->f[P];
  const double v = speed_into(&w->law, at->y), dv = speed_into(&w->law, rate);
  /* the end of the phase */
  double p = -v / dv;
  if (w->in_restitution) {
    const double missing = (1 - w->e * w->e) * w->work_c - at->y[WORK];
    p = 2 * missing / (v - sqrt(v * v + 2 * dv * missing));
  }
  const double to_end = p >= 0 ? p : INFINITY;
  /* slips that come to rest before */
  const bool nose = at->y[S_T] * rate[S_T] < 0 && w->law.mu_w > 0;
  const bool cloth = at->y[C_Y] * rate[C_Y] < 0 && w->law.mu_s > 0 && w->regime.loaded;
  p = fmin(fmin(most, to_end), fmin(nose ? -at->y[S_T] / rate[S_T] : INFINITY, cloth ? -at->y[C_Y] / rate[C_Y] : INFINITY));
  for (int k = 0; k < UNKNOWNS; k++)
    at->y[k] += k == WORK ? p * (v + 0.5 * dv * p) : p * rate[k];
  if (p == to_end)
    end_phase(w);
  at->evaluations++;
  return !w->ended && ((nose && fabs(at->y[S_T]) <= w->rest) || (cloth && fabs(at->y[C_Y]) <= w->rest));
}

/* Whether a slip comes to rest here: it is nearly zero, and what is left goes straight to zero. Then it is taken there. */
static bool comes_to_rest(carom_cushion_way *w, int k_x, int k_y) {
  const double *y = w->point.y, *f = w->point.f, x = y[k_x], t = y[k_y], dx = f[k_x], dt = f[k_y];
  const double left = sqrt(x * x + t * t), rate = sqrt(dx * dx + dt * dt);
  if (!(x * dx + t * dt < 0) || !(left <= w->rest || (left <= NEARLY && fabs(x * dt - t * dx) <= w->rest * rate)))
    return false;
  if (left > w->rest)
    go_on(&w->point, left / rate * f[P]);
  w->point.y[k_x] = w->point.y[k_y] = 0;
  return true;
}

/* A slow slip has become zero, which may change the regime, or too large. */
static bool end_slow(carom_cushion_way *w) {
  const bool cloth = w->slow == CAROM_CLOTH_IS_SLOW;
  const carom_slips at = slips_of(w->point.y);
  w->slow = CAROM_NO_SLIP_IS_SLOW;
  if (w->falls && length(cloth ? at.c : at.s) < 0.5 * w->most) {
    w->point.y[cloth ? C_X : S_X] = w->point.y[cloth ? C_Y : S_T] = 0;
    return true;
  }
  *(cloth ? &w->cloth_singular : &w->nose_singular) = true;
  const carom_ode ode = equations(w);
  carom_ode_set(&ode, &w->point);
  return false;
}

/* Takes to zero what is as good as that: slips along the cushion where both are REST, which leaves a planar impact; and, once
 * in an impact, all slips where they are CORNER. Contacts that come to rest in turns would go round that corner without end.
 * Returns whether there was anything. */
static bool tidy(carom_cushion_way *w) {
  double *y = w->point.y;
  const carom_slips at = slips_of(y);
  if (!w->cornered && length(at.s) + length(at.c) <= CORNER * w->rest / REST) {
    w->cornered = true;
    y[S_X] = y[S_T] = y[C_X] = y[C_Y] = 0;
    return true;
  }
  if (fmax(fabs(y[S_X]), fabs(y[C_X])) > w->rest || (y[S_X] == 0 && y[C_X] == 0))
    return false;
  y[S_X] = y[C_X] = 0;
  return true;
}

carom_status carom_cushion_way_on(carom_cushion_way *w, double to, int budget) {
  const double p = w->to = to / w->approach;
  carom_ode_point *at = &w->point;
  while (!w->ended && !w->wedged && at->y[P] < p && at->evaluations < budget) {
    if (at->y[S_X] == 0 && at->y[C_X] == 0) {
      const carom_status status = go_straight(w, p - at->y[P]) ? change(w) : CAROM_OK;
      if (status != CAROM_OK)
        return status;
      continue;
    }
    const carom_ode ode = equations(w);
    bool changes = carom_ode_step(&ode, at, INFINITY) != 0;
    if (changes && fabs(at->y[P] - p) <= EVENT_TOLERANCE) {
      go_on(at, p - at->y[P]);
      at->y[P] = p;
      break;
    }
    double unused;
    if (changes && fabs(phase_event(w, at->y, at->f, &unused)) <= EVENT_TOLERANCE) {
      end_phase(w);
      changes = false;
    }
    if (w->slow != CAROM_NO_SLIP_IS_SLOW) {
      const bool ends = changes && fabs(slow_event(w, at->y, at->f, &unused)) <= EVENT_TOLERANCE;
      if (!w->ended && (!keep_slow(w) || ends))
        changes = end_slow(w);
    } else if (!w->ended && !becomes_slow(w, false))
      becomes_slow(w, true);
    if (!w->ended && !w->regime.nose_sticks && w->law.mu_w > 0)
      changes |= comes_to_rest(w, S_X, S_T);
    if (!w->ended && !w->regime.cloth_sticks && w->regime.loaded && w->law.mu_s > 0)
      changes |= comes_to_rest(w, C_X, C_Y);
    if (!w->ended && tidy(w))
      changes = true;
    if (changes && !w->ended) {
      const carom_status status = change(w);
      if (status != CAROM_OK)
        return status;
    }
  }
  return w->ended || w->wedged || at->y[P] >= p ? CAROM_OK : CAROM_ERROR_UNRESOLVED;
}

double carom_cushion_way_work(const carom_cushion_way *w) {
  return w->point.y[WORK];
}

carom_impulse carom_cushion_way_impulse(const carom_cushion_way *w) {
  const carom_coulomb *k = &w->law;
  const double *y = w->point.y, p = y[P], all = w->approach;
  const double s_x = y[S_X] - w->start.s.x, c_x = y[C_X] - w->start.c.x, det_x = 12.25 - k->k_x * k->k_x;
  const double s_t = y[S_T] - w->start.s.y - k->sine * k->cosine * p, c_y = y[C_Y] - w->start.c.y + k->cosine * p;
  const double det_t = 2.5 * (1 + k->sine) * (1 + k->sine);
  return (carom_impulse){.P = all * p,
                         .f_x = all * (3.5 * s_x - k->k_x * c_x) / det_x,
                         .f_t = all * (3.5 * s_t - k->k_y * c_y) / det_t,
                         .F_x = all * (3.5 * c_x - k->k_x * s_x) / det_x,
                         .F_y = all * (k->k_t * c_y - k->k_y * s_t) / det_t};
}

carom_status carom_mathavan(carom_contact *c) {
  carom_cushion_way way;
  carom_status status = carom_cushion_way_begin(c, &way);
  if (status == CAROM_OK)
    status = carom_cushion_way_on(&way, INFINITY, CAROM_CUSHION_BUDGET);
  if (status != CAROM_OK)
    return status;
  const carom_impulse q = carom_cushion_way_impulse(&way);
  carom_push(c, &q);
  return CAROM_OK;
}
