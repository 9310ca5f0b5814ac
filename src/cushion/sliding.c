/* Steps while all that slips has a direction: the equation of equations.c for the directions and sizes of the slips, so that a
 * right-hand side is short and has one division.
 *
 * With s = r u, c = q t, |u| = |t| = 1, the rates s', c' by p of coulomb.c, which are functions of u and t alone, and the pace
 * dp / d(theta) = 1 / (1 + 1/r + 1/q) of equations.c,
 *
 *     r' = s' . u        r u' = (s' x u) (-u_t, u_x)        q' = c' . t        q t' = (c' x t) (-t_y, t_x)
 *
 * where the cross product is that which is positive if s' lies anticlockwise of u. If the nose sticks, r and u are left out.
 *
 * STEPS are those of extrapolate.h. E6 and E5, of which its head tells, are sums over the unknowns, directions counting as much
 * as the slip at the start of the step; since E6 : E5 is as the error of the step : E6, the estimate is E6^2 / E5.
 *
 * EVENTS may lie inside a step. They are located by shorter steps, each from the last point that is known to lie before the
 * event, to the zero of the cubic on the bracket known so far. */
#include "cushion/sliding.h"

#include "cushion/equations.h"
#include "platform/extrapolate.h"

#include <float.h>
#include <stdint.h>
#include <string.h>

/* The tolerance was found with `carom-lab verify --cushion` and tests/physics/cushion_invariants.c: see docs/tried.md. */
static const double TOLERANCE = 1e-12;   /* of a step, over the approach */
static const double SAFETY = 0.9;        /* on the length that the estimate asks for */
static const double SHRINK = 0.2;        /* shortest step after a rejected one, over that */
static const double GROW = 5;            /* longest step after an accepted one, over that */
static const double SHORTEST = 1e-12;    /* step that is taken whatever the estimate */
static const double EVENT_WIDTH = 1e-12; /* of a step: how narrowly an event is located */
static const double NEAR = 0.1;          /* a step that SHORT sequences may do */
enum { LONG = 7, SHORT = 3 };            /* sequences of a step */
enum { MOST_TRIALS = 60, PATIENCE = 6 }; /* of one event; trials without a bisection */

typedef carom_pair pair;
/* The unknowns; HELD of them where the nose sticks, FREE where it slips. */
enum { T_X, T_Y, Q, WORK_DONE, IMPULSE, HELD, U_X = HELD, U_T, R, FREE };

/* What does not change in a regime. */
typedef struct numbers {
  double mu_w, s_by_u_x, anisotropy;    /* s_by_u_x: 7/2 mu_w; (7/2 - k_t) mu_w */
  double k_x, k_y, k_t, free_t, cosine; /* free_t: sin cos */
  double load, load_by_u_t;             /* mu_s g = load + load_by_u_t u_t */
  double b, held_load, held_rate, sine; /* of a nose that sticks */
  double per_sine, nose, cloth;         /* 1 where the pace has 1/r, 1/q */
} numbers;

static numbers numbers_of(const carom_cushion_way *w) {
  const carom_coulomb *k = &w->law;
  return (numbers){.mu_w = k->mu_w,
                   .s_by_u_x = 3.5 * k->mu_w,
                   .anisotropy = (3.5 - k->k_t) * k->mu_w,
                   .k_x = k->k_x,
                   .k_y = k->k_y,
                   .k_t = k->k_t,
                   .free_t = k->sine * k->cosine,
                   .cosine = k->cosine,
                   .load = k->mu_s * k->sine,
                   .load_by_u_t = k->mu_s * k->cosine * k->mu_w,
                   .b = k->k_y * k->mu_s,
                   .held_load = 3.5 * k->sine * k->mu_s,
                   .held_rate = 3.5 - k->k_x * k->k_x * (2.0 / 7.0),
                   .sine = k->sine,
                   .per_sine = w->per_sine,
                   .nose = w->nose_singular,
                   .cloth = w->cloth_singular};
}

/* Both contacts slip. The products of rates and directions are multiplied out: friction at the cloth is along t, so the chain
 * from u to its turning is shorter, and |u| = 1 takes two squares. */
static inline void slope_of_both(const void *model, const pair *y, pair scale, pair *f) {
  const numbers *k = model;
  const pair u_x = y[U_X], u_t = y[U_T], t_x = y[T_X], t_y = y[T_Y], r = y[R], q = y[Q], rq = r * q;
  const pair per = scale / (rq + (k->nose * q + k->cloth * r)), by_s = q * per, by_c = r * per, rho = rq * per;
  const pair load = k->load + k->load_by_u_t * u_t, drive = k->free_t + k->anisotropy * u_t;
  const pair k_u_x = k->k_x * u_x, k_u_t = k->k_y * u_t, both = k_u_x * t_x + k_u_t * t_y;
  const pair s_across = u_x * drive - load * (k->k_y * t_y * u_x - k->k_x * t_x * u_t);
  const pair s_along = (u_t * drive - k->s_by_u_x) - load * both;
  const pair c_across = k->mu_w * (k_u_x * t_y - k_u_t * t_x) - k->cosine * t_x;
  const pair c_along = -(k->mu_w * both + (k->cosine * t_y + 3.5 * load));
  const pair turn_u = by_s * s_across, turn_t = by_c * c_across;
  f[U_X] = -(turn_u * u_t);
  f[U_T] = turn_u * u_x;
  f[R] = rho * s_along;
  f[T_X] = -(turn_t * t_y);
  f[T_Y] = turn_t * t_x;
  f[Q] = rho * c_along;
  f[WORK_DONE] = rho * ((q * t_y - r * u_t) * k->per_sine);
  f[IMPULSE] = rho;
}

/* The nose sticks. */
static inline void slope_of_cloth(const void *model, const pair *y, pair scale, pair *f) {
  const numbers *k = model;
  const pair t_x = y[T_X], t_y = y[T_Y], q = y[Q], b = k->b * t_y, by = 1 / (k->k_t + b * k->cosine);
  const pair by_c = scale / (q + k->cloth), rho = q * by_c;
  const pair load = k->held_load * by, f_t = k->sine * ((b - k->cosine) * by);
  const pair c_x = -(k->held_rate * (load * t_x)), c_y = (k->k_y * f_t - k->cosine) - 3.5 * (load * t_y);
  const pair turn_t = by_c * (c_y * t_x - c_x * t_y);
  f[T_X] = -(turn_t * t_y);
  f[T_Y] = turn_t * t_x;
  f[Q] = rho * (c_x * t_x + c_y * t_y);
  f[WORK_DONE] = rho * (q * t_y * k->per_sine);
  f[IMPULSE] = rho;
}

/* A slip's direction, size and their rates. */
static double split(const double *slip, const double *rate, double *direction, double *turning, double *grows) {
  const double size = sqrt(slip[0] * slip[0] + slip[1] * slip[1]), per = 1 / size;
  const double x = slip[0] * per, y = slip[1] * per, turn = (rate[1] * x - rate[0] * y) * per;
  direction[0] = x;
  direction[1] = y;
  turning[0] = -turn * y;
  turning[1] = turn * x;
  *grows = rate[0] * x + rate[1] * y;
  return size;
}

/* From *at by h, with `columns` sequences and `size` unknowns, to y; the estimate of the error. */
static inline __attribute__((always_inline)) double move(const carom_cushion_way *w, const carom_ode_point *at, double h,
                                                         int columns, int size, carom_lane_slope *slope, double *y) {
  const numbers k = numbers_of(w);
  double y_0[FREE], f_0[FREE], e_6 = 0, e_5 = 0;
  y_0[Q] = split(at->y + C_X, at->f + C_X, y_0 + T_X, f_0 + T_X, f_0 + Q);
  if (size == FREE)
    y_0[R] = split(at->y + S_X, at->f + S_X, y_0 + U_X, f_0 + U_X, f_0 + R);
  y_0[WORK_DONE] = at->y[WORK];
  f_0[WORK_DONE] = at->f[WORK];
  y_0[IMPULSE] = at->y[P];
  f_0[IMPULSE] = at->f[P];
  carom_extrapolated end[FREE];
  carom_extrapolate(columns, size, slope, &k, y_0, f_0, h, end);
  for (int i = 0; i < size; i++) {
    const double weight = i == WORK_DONE ? 0 : i == T_X || i == T_Y ? y_0[Q] : i == U_X || i == U_T ? y_0[R] : 1;
    e_6 += weight * fabs(end[i].e_6);
    e_5 += weight * fabs(end[i].e_5);
  }
  y[S_X] = size == FREE ? end[R].y * end[U_X].y : 0;
  y[S_T] = size == FREE ? end[R].y * end[U_T].y : 0;
  y[C_X] = end[Q].y * end[T_X].y;
  y[C_Y] = end[Q].y * end[T_Y].y;
  y[WORK] = end[WORK_DONE].y;
  y[P] = end[IMPULSE].y;
  return e_6 < e_5 ? e_6 * (e_6 / e_5) : e_6;
}

static double long_of_both(const carom_cushion_way *w, const carom_ode_point *at, double h, double *y) {
  return move(w, at, h, LONG, FREE, slope_of_both, y);
}

static double long_of_cloth(const carom_cushion_way *w, const carom_ode_point *at, double h, double *y) {
  return move(w, at, h, LONG, HELD, slope_of_cloth, y);
}

static double short_of_both(const carom_cushion_way *w, const carom_ode_point *at, double h, double *y) {
  return move(w, at, h, SHORT, FREE, slope_of_both, y);
}

static double short_of_cloth(const carom_cushion_way *w, const carom_ode_point *at, double h, double *y) {
  return move(w, at, h, SHORT, HELD, slope_of_cloth, y);
}

/* From *start by h; the estimate of the error. */
static double go(carom_cushion_way *w, const carom_ode_point *start, double h, double *y) {
  w->point.evaluations += 2 * LONG - 1;
  return (w->regime.nose_sticks ? long_of_cloth : long_of_both)(w, start, h, y);
}

/* The same, by fewer sequences where they do. */
static void go_near(carom_cushion_way *w, const carom_ode_point *start, double h, double *y) {
  if (h < NEAR) {
    w->point.evaluations += 2 * SHORT - 1;
    if ((w->regime.nose_sticks ? short_of_cloth : short_of_both)(w, start, h, y) <= TOLERANCE)
      return;
  }
  go(w, start, h, y);
}

/* Puts the present point to y, a distance x on. */
static void arrive(carom_cushion_way *w, double x, const double *y) {
  w->point.x = x;
  memcpy(w->point.y, y, UNKNOWNS * sizeof *y);
  const carom_ode ode = carom_cushion_equations(w);
  carom_ode_set(&ode, &w->point);
}

bool carom_sliding_applies(const carom_cushion_way *w) {
  const double *y = w->point.y;
  if (w->slow != CAROM_NO_SLIP_IS_SLOW || w->regime.cloth_sticks || !w->regime.loaded || !(w->law.mu_s > 0) ||
      (y[C_X] == 0 && y[C_Y] == 0))
    return false;
  return w->regime.nose_sticks || (w->law.mu_w > 0 && (y[S_X] != 0 || y[S_T] != 0));
}

/* The root of order 16, to some parts in a thousand: its exponent and, nearly, its mantissa are a sixteenth. */
static double root_16(double x) {
  uint64_t bits;
  const uint64_t one = 1023ull << 52;
  memcpy(&bits, &x, sizeof bits);
  bits = bits / 16 + (one - one / 16);
  memcpy(&x, &bits, sizeof x);
  return x;
}

/* What the estimate makes of a step's length, as a factor; a number that is not finite counts as a large error. */
static double factor(double error) {
  if (!(error <= DBL_MAX))
    return SHRINK;
  const double share = SAFETY * root_16(TOLERANCE / error);
  return share > GROW ? GROW : share > SHRINK ? share : SHRINK;
}

void carom_sliding_step(carom_cushion_way *w) {
  const carom_ode_point start = w->point;
  const carom_ode ode = carom_cushion_equations(w);
  double y[UNKNOWNS], h = fmin(start.next, ode.longest(w, start.x, start.y, start.f)), error;
  while (error = go(w, &start, h, y), !(error <= TOLERANCE) && h > SHORTEST)
    h *= fmin(factor(error), SAFETY);
  w->point.next = h * factor(error);
  arrive(w, start.x + h, y);
}

static carom_ode_reading read_event(const carom_cushion_way *w, const carom_ode_point *at, double x) {
  carom_ode_reading r = {.x = x};
  r.g = carom_cushion_event(w, at->y, at->f, &r.rate);
  return r;
}

void carom_sliding_locate(carom_cushion_way *w, const carom_ode_point *start) {
  carom_ode_point behind = *start;
  carom_ode_reading low = read_event(w, start, start->x), high = read_event(w, &w->point, w->point.x);
  const double width = high.x - low.x;
  double nearest = high.g / fmin(fabs(high.rate), 1);
  for (int k = 0; k < MOST_TRIALS && !(nearest <= CAROM_CUSHION_EVENT_TOLERANCE); k++) {
    const double x = k >= PATIENCE && k % 2 == 0 ? 0.5 * (low.x + high.x) : carom_ode_zero_between(&low, &high);
    if (!(x - low.x > EVENT_WIDTH * width))
      break;
    double y[UNKNOWNS];
    go_near(w, &behind, x - low.x, y);
    arrive(w, x, y);
    const carom_ode_reading here = read_event(w, &w->point, x);
    nearest = fabs(here.g) / fmin(fabs(here.rate), 1);
    if (here.g >= 0)
      high = here;
    else {
      low = here;
      behind = w->point;
    }
  }
}
