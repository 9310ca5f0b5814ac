/* The exact limit by adaptive steps in the impulse p, in double precision: for whatever collocation refuses, and for traces.
 *
 * The unknowns are the integrals Q_1, Q_2, F_x, F_y of reduced.h, of which the slips and v_n are linear functions, and int v_n
 * dp. integrate.c takes the steps, with one tolerance for the error of each.
 *
 * SINGULAR POINTS. The directions of the slips are not smooth where a slip vanishes. u does at stick: a step is at most a share
 * of the way there, so steps shrink geometrically, until |u| is rounding; from there on the balls stick and no more is done.
 * The slip d over the cloth may come near to zero and leave again: a step towards it is at most a share of the way. A d that is
 * zero has the direction in which it is about to begin.
 *
 * EVENTS end a phase: v_n = 0 that of compression, the balance of work that of restitution.
 *
 * WHERE IT GIVES UP. With the pooltool slip the direction of d is unstable: errors grow like exp(int 3/2 mu mu_b sigma / |d|
 * dp). Beyond exp(MOST_GROWTH) the result hangs on rounding, and there is none. Nor is there one if the budget is spent: a
 * pressed ball with all but the mass of the world and friction near 1 loses a share of v_n so small that no step gets there. */
#include "ball_ball/fallback.h"

#include <float.h>
#include <math.h>

static const double TOLERANCE = 1e-13;               /* of a step, over the approach */
static const double SHARE_OF_U = 0.7;                /* of the way to stick that a step may go, */
static const double SHARE_OF_D = 0.8;                /* and of the way to d = 0 */
static const double STUCK = 1e-12, AT_REST = 1e-12;  /* |u| and |d| that are none, over |v_n| / kappa */
static const double PAST_REST = 2.2;                 /* of AT_REST: a step that jumps over d = 0 */
static const double MOST_GROWTH = 13.8;              /* a million */
static const double MOST_SLIP = 1e100;               /* over the approach; squares of more would overflow */
enum { BUDGET = 4000 };                              /* right-hand sides: about 150 us */
enum { Q_1, Q_2, F_X, F_Y, WORK, GROWTH, UNKNOWNS }; /* y */

typedef struct slips {
  double u_x, u_z, d_x, d_y, v_n;
} slips;

static slips slips_of(const carom_reduced *c, double p, const double *y) {
  const double spin = 2.5 * c->s;
  return (slips){.u_x = c->u_x - 3.5 * c->kappa * y[Q_1] + y[F_X],
                 .u_z = c->u_z - 2.5 * c->kappa * y[Q_2] + 2.5 * y[F_Y],
                 .d_x = c->d_x - y[Q_1] + (1 - spin) * y[F_X],
                 .d_y = c->d_y - p + spin * y[Q_2] + (1 - spin) * y[F_Y],
                 .v_n = c->v_n + c->kappa * p - y[F_Y]};
}

static bool sticks(const carom_way *w) {
  return !isnan(w->p_stick);
}

static void slope(const void *model, double p, const double *y, double *f) {
  const carom_way *w = model;
  const carom_reduced *c = &w->c;
  const slips k = slips_of(c, p, y);
  const double u = sqrt(k.u_x * k.u_x + k.u_z * k.u_z);
  f[WORK] = k.v_n;
  if (sticks(w) || u == 0) {
    f[Q_1] = f[Q_2] = f[F_X] = f[F_Y] = f[GROWTH] = 0;
    return;
  }
  f[Q_1] = c->mu_b * (k.u_x / u);
  f[Q_2] = c->mu_b * (k.u_z / u);
  double t_x = k.d_x, t_y = k.d_y, t = sqrt(t_x * t_x + t_y * t_y);
  if (t <= AT_REST * w->unit) {
    t_x = -f[Q_1];
    t_y = 2.5 * c->s * f[Q_2] - 1;
    t = sqrt(t_x * t_x + t_y * t_y);
  }
  f[GROWTH] = c->s > 0 ? 1.5 * c->mu * f[Q_2] / t : 0;
  const double load = t > 0 ? -c->mu * f[Q_2] / t : 0;
  f[F_X] = load * t_x;
  f[F_Y] = load * t_y;
}

/* The longest step that nothing singular lies on. */
static double longest(const void *model, double p, const double *y, const double *f) {
  const carom_way *w = model;
  const carom_reduced *c = &w->c;
  if (sticks(w))
    return DBL_MAX;
  const slips k = slips_of(c, p, y);
  const double spin = 2.5 * c->s;
  const double du_x = -3.5 * c->kappa * f[Q_1] + f[F_X], du_z = -2.5 * c->kappa * f[Q_2] + 2.5 * f[F_Y];
  const double dd_x = -f[Q_1] + (1 - spin) * f[F_X], dd_y = -1 + spin * f[Q_2] + (1 - spin) * f[F_Y];
  const double u = sqrt(k.u_x * k.u_x + k.u_z * k.u_z), du = sqrt(du_x * du_x + du_z * du_z);
  const double h = u / (du + DBL_MIN) * SHARE_OF_U;
  if (!(c->mu * f[Q_2] > 0 && k.d_x * dd_x + k.d_y * dd_y < 0)) /* no ball is pressed, or d grows */
    return h;
  const double d = sqrt(k.d_x * k.d_x + k.d_y * k.d_y), dd = sqrt(dd_x * dd_x + dd_y * dd_y);
  return fmin(h, fmax(SHARE_OF_D * d, PAST_REST * AT_REST * w->unit) / (dd + DBL_MIN));
}

/* Positive behind the end of the phase. */
static double event(const void *model, double p, const double *y, const double *f, double *rate) {
  const carom_way *w = model;
  const carom_reduced *c = &w->c;
  if (w->in_restitution) {
    *rate = f[WORK];
    return y[WORK] + c->e * c->e * w->work_c;
  }
  *rate = c->kappa - f[F_Y];
  return slips_of(c, p, y).v_n;
}

static carom_ode equations(const carom_way *w, const double *weight) {
  return (carom_ode){.size = UNKNOWNS,
                     .slope = slope,
                     .longest = longest,
                     .event = event,
                     .model = w,
                     .weight = weight,
                     .tolerance = TOLERANCE};
}

void carom_way_begin(const carom_reduced *c, carom_way *way) {
  const double per = -1 / c->v_n;
  *way = (carom_way){.p_stick = NAN, .approach = -c->v_n, .c = *c, .unit = 1 / c->kappa};
  way->c.u_x *= per;
  way->c.u_z *= per;
  way->c.d_x *= per;
  way->c.d_y *= per;
  way->c.v_n = -1;
  way->point.next = way->unit;
  const carom_ode ode = equations(way, NULL);
  carom_ode_set(&ode, &way->point);
}

carom_status carom_way_on(carom_way *way, double to, int budget) {
  const double kappa = way->c.kappa, weight[UNKNOWNS] = {kappa, kappa, kappa, kappa, 0, 0};
  const double approach = way->approach, p = to / approach, energy = approach * approach;
  const carom_reduced *c = &way->c;
  if (!(fabs(c->u_x) + c->u_z + fabs(c->d_x) + fabs(c->d_y) < MOST_SLIP))
    return CAROM_ERROR_OVERFLOW;
  const carom_ode ode = equations(way, weight);
  carom_ode_point *at = &way->point;
  while (!way->ended && at->x < p && at->evaluations < budget) {
    const slips k = slips_of(c, at->x, at->y);
    if (!sticks(way) && sqrt(k.u_x * k.u_x + k.u_z * k.u_z) <= STUCK * way->unit) {
      way->p_stick = at->x * approach;
      at->next = 4 * way->unit; /* what is left is a parabola: one step */
      carom_ode_set(&ode, at);
    }
    if (!carom_ode_step(&ode, at, p))
      continue;
    if (way->in_restitution)
      way->ended = true;
    else {
      way->in_restitution = true;
      way->work_c = at->y[WORK];
      at->y[WORK] = 0;
      way->ended = !(c->e * c->e * way->work_c < 0);
    }
  }
  way->compression = energy * (way->in_restitution ? way->work_c : at->y[WORK]);
  way->restitution = way->in_restitution ? energy * at->y[WORK] : 0;
  way->at = (carom_integrals){approach * at->x, approach * at->y[Q_1], approach * at->y[Q_2], approach * at->y[F_X],
                              approach * at->y[F_Y]};
  way->evaluations = at->evaluations;
  if (!isfinite(at->x + at->y[Q_1] + at->y[Q_2] + at->y[F_X] + at->y[F_Y] + at->y[WORK]))
    return CAROM_ERROR_OVERFLOW;
  const bool arrived = way->ended || at->x >= p;
  return arrived && at->y[GROWTH] <= MOST_GROWTH ? CAROM_OK : CAROM_ERROR_UNRESOLVED;
}

carom_status carom_fallback(const carom_reduced *c, carom_way *way) {
  carom_way_begin(c, way);
  return carom_way_on(way, INFINITY, BUDGET);
}
