/* The strike of a raised cue at a ball that nothing else touches: tip and slate are contacts that
 * last, by the law of cluster/tip.h. With other balls near, cluster.c integrates the same law.
 *
 * x and y are the compressions of tip and slate, and s is the slip of the foot of the ball. F, N
 * and f are the forces of tip, slate and cloth over the mass m of the ball:
 *
 *   x'' = -B F + S N + D f     B = m/M + 1 + 5/2 |q|^2      f = mu N where the foot slips,
 *   y'' = S F - N              S = -c'_z                    f = 2/7 D F where it holds
 *   s'  = D F - 7/2 f          D t = c'_h + 5/2 z x q
 *
 * c' is the direction of the push, c'_h its horizontal part, q the arm of the tip, and t a unit
 * vector. The slip begins at 0 and the push gives it the direction t, so that direction never
 * changes. Therefore a ball finally rolls where Coriolis found. Weight has no part, and positions
 * stay.
 *
 * SPRINGS. Both contacts load as k d, and unload as k/e^2 (d - rest) with rest = (1 - e^2) d_max,
 * so that e^2 of the work comes back. Where the force has reached 0 the contact leaves: it has no
 * force, and the set recovers as d falls. If it closes again before d is 0, it loads along the line
 * of unloading from there. It is open where d < 0; what closes then touches anew. A cue without a
 * follow-through does not touch anew.
 *
 * PHASES. Between two changes of a branch, or of the foot, the equations are linear:
 * z'' = -A z with z = (x, y) less its rest. Each eigenvalue lambda of A is a mode
 *
 *   z(t) = z(0) C(t) + z'(0) U(t)     C'' = -lambda C, C(0) = 1, C'(0) = 0, and U' = C, U(0) = 0
 *
 * and C and U of a sum of two times follow from those of both. No step has to be small: steps are
 * taken only to find where a phase ends. That is where a value changes its sign within a step, or
 * dips below 0 and comes back. Hermite's cubic gives the time, and one step of Newton's method on
 * the modes themselves makes it exact. Slip and impulses follow from the speeds.
 *
 * The law is homogeneous: all speeds over V are the same for each V, and only the ratio of the
 * times of tip and slate counts. Two limits break this, the end of the follow-through and the end
 * of hops. A slate whose e is below 0.2 is computed with 0.2, and the speed at which the ball
 * leaves it is multiplied by e/0.2.
 *
 * Found by trial (core/tests/physics/strike.c, raised_alone): STEP may be 0.3 to 0.6; at 1.2 the
 * cubic misses ends of phases. Usual strikes have 5 to 8 phases. */
#include "cluster/hertz.h"
#include "platform/ranges.h"
#include "shot/clusters.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { PHASES_MOST = 400, STEPS_OF_PHASE = 3000, FINER_MOST = 5 };
static const double STEP = 0.6;      /* of a phase's faster mode, rad */
static const double FINER = 6.0;     /* parts of a step whose ends do not tell what happens in it */
static const double too_slow = 1e-9; /* of the cue's speed: contacts that close slower are none */
static const double least_e = 0.2;   /* of a slate */
static const double least_tip = 0.05; /* e of a tip, as in cluster/push.c */

enum { TIP, SLATE, FOOT, ENDS };
enum { OPEN, LOADS, UNLOADS, LEAVES, GONE }; /* GONE: a cue that does not follow through */

typedef struct push_spring {
  int branch;
  bool returns;       /* touches anew once it is open */
  double k, e;        /* over the mass of the ball, 1/s^2; restitution */
  double d, v;        /* compression, m, and its rate, m/s */
  double top;         /* d_max */
  double rest, stiff; /* of the branch: d without a force, and the rate of the force, 1/s^2 */
} push_spring;

typedef struct push_state {
  double B, S, D, mu;    /* the numbers of the equations */
  double V, mass_ratio;  /* of the cue: speed before the strike, m/s; m/M */
  double follow;         /* m: how far the cue goes on */
  push_spring spring[2]; /* of tip and slate */
  double time;           /* s since the touch */
  double slip;           /* s, m/s */
  bool slips;            /* else the foot holds */
  bool lets_go;          /* it has just begun to slip */
  int stuck;             /* phases in a row that took no time */
  carom_raised *out;
} push_state;

/* C and U of both modes, at one time. */
typedef struct swing {
  double C[2], U[2];
} swing;

/* One phase: A, its eigenvalues, and what each mode has of compressions and speeds at its start. */
typedef struct push_phase {
  double A[2][2], lambda[2], quick; /* quick: sqrt(lambda[0]), the faster one */
  double z[2][2], v[2][2];          /* [mode][contact] */
  double of_tip, of_slate;          /* the slip by the changes of both speeds */
} push_phase;

/* Values at one time of a phase. `foot` ends its state as it passes 0: the slip, or the friction
 * that it needs to hold less what it has. */
typedef struct instant {
  double d[2], v[2], a[2], slip, foot, foot_rate;
} instant;

/* A value whose sign ends a phase: at the start of a step and at its end, or at its vertex within
 * the step, and its rates there. */
typedef struct ending {
  double start, from_rate, end, to_rate, share; /* share: the part of the step up to `to` */
  int next;                                     /* the branch that follows */
} ending;

double carom_slate_under(const carom_ball_kind *kind) {
  return carom_greater(carom_slate_restitution(kind->restitution_table), least_e);
}

/* ---- Contacts */

/* Begins a branch where the last one has ended. */
static void turn_to(push_spring *x, int next) {
  const double lost = 1.0 - x->e * x->e;
  const bool comes_back = x->branch == LEAVES;
  x->stiff = x->rest = 0.0;
  x->branch = next;
  if (next == LOADS) {
    x->v = carom_greater(x->v, 0.0);
    x->stiff = x->k;
  } else if (next == UNLOADS) {
    x->v = 0.0;
    x->top = comes_back ? x->d / lost : x->d;
    x->rest = lost * x->top;
    x->stiff = x->k / (x->e * x->e);
  } else if (next == OPEN || x->d <= 0.0 || !(lost > 0.0)) {
    x->branch = x->returns ? OPEN : GONE;
    x->top = 0.0;
    x->d = carom_lesser(x->d, 0.0); /* it is not beyond by rounding */
  }
}

/* Whether a value that is not beyond 0 at either end of a step is so at its vertex within it.
 * *is_unclear becomes true where that is too close to tell. */
static bool dips(double value, double from_rate, double to_rate, double h, int next,
                 bool *is_unclear, ending *e) {
  const bool falls_first =
      value > 0.0 ? from_rate < 0.0 && to_rate > 0.0 : from_rate > 0.0 && to_rate < 0.0;
  if (!falls_first)
    return false;
  const double share = from_rate / (from_rate - to_rate), fall = 0.5 * from_rate * share * h;
  const double vertex = value + fall;
  *is_unclear |= fabs(vertex) < 0.1 * fabs(fall);
  if ((vertex > 0.0) == (value > 0.0))
    return false;
  *e = (ending){value, from_rate, vertex, 0.0, share, next};
  return true;
}

/* The end of a branch that is left as its compression passes `level`, downwards or upwards. */
static bool passes(double level, bool down, int i, const instant *first, const instant *last,
                   double h, int next, bool *is_unclear, ending *e) {
  const double start = first->d[i] - level, end = last->d[i] - level;
  if (down ? end < 0.0 : end > 0.0) {
    *e = (ending){start, first->v[i], end, last->v[i], 1.0, next};
    return true;
  }
  const bool inside = down ? start > 0.0 : start < 0.0;
  return inside && dips(start, first->v[i], last->v[i], h, next, is_unclear, e);
}

/* The same of one that is left as it begins to unload, or to close. */
static bool turns(bool unloads, int i, const instant *start, const instant *end, double h,
                  bool *is_unclear, ending *e) {
  if (unloads ? end->v[i] < 0.0 : end->v[i] > 0.0) {
    *e = (ending){start->v[i], start->a[i], end->v[i], end->a[i], 1.0, UNLOADS};
    return true;
  }
  return dips(start->v[i], start->a[i], end->a[i], h, UNLOADS, is_unclear, e);
}

/* Whether the branch of contact i ends within a step of h. */
static bool branch_ends(const push_spring *x, int i, const instant *start, const instant *end,
                        double h, bool *is_unclear, ending *e) {
  switch (x->branch) {
  case LOADS:
    return turns(true, i, start, end, h, is_unclear, e);
  case UNLOADS:
    return passes(x->rest, true, i, start, end, h, LEAVES, is_unclear, e) ||
           passes(x->top, false, i, start, end, h, LOADS, is_unclear, e);
  case LEAVES:
    return dips(start->d[i], start->v[i], end->v[i], h, OPEN, is_unclear, e) ||
           turns(false, i, start, end, h, is_unclear, e) ||
           passes(0.0, true, i, start, end, h, OPEN, is_unclear, e);
  case OPEN:
    return passes(0.0, false, i, start, end, h, LOADS, is_unclear, e);
  default:
    return false;
  }
}

/* Whether the foot begins to hold, or to slip, within a step of h. */
static bool foot_ends(const push_state *p, const instant *start, const instant *end, double h,
                      bool *is_unclear, ending *e) {
  const bool passed = p->slips ? end->foot < 0.0 : end->foot > 0.0,
             inside = p->slips ? start->foot > 0.0 : start->foot < 0.0;
  if (passed) {
    *e = (ending){start->foot, start->foot_rate, end->foot, end->foot_rate, 1.0, 0};
    return true;
  }
  return inside && dips(start->foot, start->foot_rate, end->foot_rate, h, 0, is_unclear, e);
}

/* The part of a step of h at which an ending is 0: of Hermite's cubic, less the zeros that it has
 * at its start, by Newton's method within bounds. */
static double part_of_step(const ending *e, double step) {
  const double h = e->share * step, rise = e->end - e->start;
  double c[4] = {e->start, h * e->from_rate, 3.0 * rise - h * (2.0 * e->from_rate + e->to_rate),
                 h * (e->from_rate + e->to_rate) - 2.0 * rise};
  for (int n = 0; n < 2 && c[0] == 0.0; n++) {
    c[0] = c[1];
    c[1] = c[2];
    c[2] = c[3];
    c[3] = 0.0;
  }
  const double end = c[0] + c[1] + c[2] + c[3];
  if ((c[0] > 0.0) == (end > 0.0))
    return 0.0; /* it is beyond at once */

  double low = 0.0, high = 1.0, t = c[0] / (c[0] - end);
  for (int n = 0; n < 3; n++) {
    const double q = c[0] + t * (c[1] + t * (c[2] + t * c[3])),
                 slope = c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]);
    *((q > 0.0) == (c[0] > 0.0) ? &low : &high) = t;
    const double next = t - q / slope;
    t = next >= low && next <= high ? next : 0.5 * (low + high);
  }
  return e->share * t;
}

/* ---- A phase */

/* C and U of an eigenvalue at a time up to STEP of the faster mode, to 1e-15, by sums and products
 * alone: C is the sum of q^n/(2n)!, and U/t that of q^n/(2n + 1)!, each by its even and its odd
 * powers, which are computed at one time. */
static void swing_of(double lambda, double t, double *C, double *U) {
  const double q = -lambda * t * t, q2 = q * q;
  const double c_even = 1.0 + q2 * (1.0 / 24.0 + q2 * (1.0 / 40320.0 + q2 * (1.0 / 479001600.0)));
  const double c_odd =
      1.0 / 2.0 + q2 * (1.0 / 720.0 + q2 * (1.0 / 3628800.0 + q2 * (1.0 / 87178291200.0)));
  const double u_even =
      1.0 + q2 * (1.0 / 120.0 + q2 * (1.0 / 362880.0 + q2 * (1.0 / 6227020800.0)));
  const double u_odd =
      1.0 / 6.0 + q2 * (1.0 / 5040.0 + q2 * (1.0 / 39916800.0 + q2 * (1.0 / 1307674368000.0)));
  *C = c_even + q * c_odd;
  *U = t * (u_even + q * u_odd);
}

static swing swing_by(const push_phase *f, double t) {
  swing change;
  for (int n = 0; n < 2; n++)
    swing_of(f->lambda[n], t, &change.C[n], &change.U[n]);
  return change;
}

/* At the sum of two times. */
static swing swing_on(const push_phase *f, const swing *a, const swing *b) {
  swing sum;
  for (int n = 0; n < 2; n++) {
    sum.C[n] = a->C[n] * b->C[n] - f->lambda[n] * a->U[n] * b->U[n];
    sum.U[n] = a->U[n] * b->C[n] + a->C[n] * b->U[n];
  }
  return sum;
}

/* The two modes of the phase that begins. */
static void begin_phase(const push_state *p, push_phase *f) {
  const push_spring *tip = &p->spring[TIP], *slate = &p->spring[SLATE];
  const double held = p->D * p->D / 3.5;
  const double B = p->slips ? p->B : p->B - held,
               S = p->slips ? p->S + p->mu * p->D : p->S; /* of N in x'' */
  f->A[TIP][TIP] = B * tip->stiff;
  f->A[TIP][SLATE] = -S * slate->stiff;
  f->A[SLATE][TIP] = -p->S * tip->stiff;
  f->A[SLATE][SLATE] = slate->stiff;

  /* eigenvalues: the first is the greater; a steep cue on a rough cloth wedges the ball where the
   * second is below 0 */
  const double half = 0.5 * (f->A[0][0] - f->A[1][1]), sum = f->A[0][0] + f->A[1][1];
  const double root = carom_greater(sqrt(half * half + f->A[0][1] * f->A[1][0]), 1e-8 * sum);
  f->lambda[0] = 0.5 * sum + root;
  f->lambda[1] = tip->stiff * slate->stiff * (B - p->S * S) / f->lambda[0];
  f->quick = sqrt(f->lambda[0]);

  /* the first mode has (A - lambda_1) z / (lambda_0 - lambda_1), the second the rest */
  const double over = 0.5 / root;
  const double y[2] = {tip->d - tip->rest, slate->d - slate->rest}, w[2] = {tip->v, slate->v};
  for (int i = 0; i < 2; i++) {
    f->z[0][i] = f->v[0][i] = 0.0;
    for (int j = 0; j < 2; j++) {
      const double share = over * (i == j ? f->A[i][j] - f->lambda[1] : f->A[i][j]);
      f->z[0][i] += share * y[j];
      f->v[0][i] += share * w[j];
    }
    f->z[1][i] = y[i] - f->z[0][i];
    f->v[1][i] = w[i] - f->v[0][i];
  }

  /* s' as a sum of x'' and y'' */
  const double both = p->B - p->S * (p->S + p->mu * p->D);
  f->of_tip = p->slips && both != 0.0 ? -(p->D - 3.5 * p->mu * p->S) / both : (double)0.0;
  f->of_slate = p->slips ? f->of_tip * S + 3.5 * p->mu : (double)0.0;
}

static void instant_at(const push_state *p, const push_phase *f, const swing *q, instant *values) {
  double force[2], rate[2], y[2];
  for (int i = 0; i < 2; i++) {
    y[i] = values->v[i] = 0.0;
    for (int n = 0; n < 2; n++) {
      y[i] += f->z[n][i] * q->C[n] + f->v[n][i] * q->U[n];
      values->v[i] += f->v[n][i] * q->C[n] - f->lambda[n] * f->z[n][i] * q->U[n];
    }
    values->d[i] = y[i] + p->spring[i].rest;
    force[i] = p->spring[i].stiff * y[i];
    rate[i] = p->spring[i].stiff * values->v[i];
  }
  for (int i = 0; i < 2; i++)
    values->a[i] = -carom_plane_dot(f->A[i], y);

  /* the foot */
  values->slip = p->slip + f->of_tip * (values->v[TIP] - p->spring[TIP].v) +
                 f->of_slate * (values->v[SLATE] - p->spring[SLATE].v);
  if (p->slips) {
    values->foot = values->slip;
    values->foot_rate = p->D * force[TIP] - 3.5 * p->mu * force[SLATE];
  } else {
    values->foot = p->D / 3.5 * force[TIP] - p->mu * force[SLATE];
    values->foot_rate = p->D / 3.5 * rate[TIP] - p->mu * rate[SLATE];
  }
}

/* Which of the endings comes first within a step, or -1, and at which part of it. */
static int first_ending(const push_state *p, const instant *start, const instant *end, double h,
                        bool *is_unclear, double *part, ending *first) {
  int contact = -1;
  *part = 2.0;
  *first = (ending){0.0, 0.0, 0.0, 0.0, 1.0, 0};
  for (int k = 0; k < ENDS; k++) {
    ending e;
    const bool ends = k == FOOT ? foot_ends(p, start, end, h, is_unclear, &e)
                                : branch_ends(&p->spring[k], k, start, end, h, is_unclear, &e);
    const double share = ends ? part_of_step(&e, h) : (double)2.0;
    if (!(share < *part))
      continue;
    *part = share;
    *first = e;
    contact = k;
  }
  return contact;
}

/* The value of an ending, and its rate. */
static double value_of(const push_state *p, int contact, int next, const instant *values,
                       double *rate) {
  if (contact == FOOT) {
    *rate = values->foot_rate;
    return values->foot;
  }
  const push_spring *x = &p->spring[contact];
  if (next == UNLOADS) {
    *rate = values->a[contact];
    return values->v[contact];
  }
  *rate = values->v[contact];
  double level = 0.0;
  if (next == LEAVES)
    level = x->rest;
  else if (x->branch == UNLOADS)
    level = x->top;
  return values->d[contact] - level;
}

static bool held(const push_state *p) {
  const push_spring *tip = &p->spring[TIP], *slate = &p->spring[SLATE];
  return p->D / 3.5 * tip->stiff * (tip->d - tip->rest) <=
         p->mu * slate->stiff * (slate->d - slate->rest);
}

/* The tip touches anew. */
static void count_touch(push_state *p) {
  p->out->touches++;
  if (p->out->touches == 2)
    p->out->second = p->spring[TIP].v;
}

/* Ends the phase where an ending is 0, near the time of q. */
static void end_phase(push_state *p, const push_phase *f, swing q, double elapsed, double h,
                      int contact, int next) {
  instant values;
  double rate;
  instant_at(p, f, &q, &values);
  const double value = value_of(p, contact, next, &values, &rate);
  double off = rate != 0.0 ? -value / rate : (double)0.0;
  off = fabs(off) < 0.2 * h ? carom_greater(off, -elapsed) : (double)0.0;
  const swing change = swing_by(f, off), total = swing_on(f, &q, &change);
  p->time = p->time + elapsed + off;
  p->stuck = elapsed + off > 1e-9 * h ? 0 : p->stuck + 1;
  instant_at(p, f, &total, &values);

  /* the state there, and the branch that follows */
  for (int i = 0; i < 2; i++) {
    p->spring[i].d = values.d[i];
    p->spring[i].v = values.v[i];
  }
  p->slip = carom_greater(values.slip, 0.0);
  p->out->course = p->out->course * 31U + (unsigned)(contact * 4 + next) + 1U;
  p->lets_go = false;
  if (contact == FOOT) {
    p->slips = !p->slips;
    p->lets_go = p->slips;
    p->slip = 0.0;
    return;
  }
  if (p->spring[contact].branch == OPEN) {
    p->spring[contact].d = 0.0;
    if (contact == TIP)
      count_touch(p);
  }
  turn_to(&p->spring[contact], next);
  p->slips = p->slips || !held(p);
}

/* One phase, to its end. False: it takes too many steps. */
static bool run_phase(push_state *p) {
  push_phase f;
  begin_phase(p, &f);
  const double whole = STEP / f.quick;
  double h = whole, short_steps = 1.0, done = 0.0;
  int finer = 0;
  for (; finer < p->stuck - 2 && finer < FINER_MOST; finer++) {
    /* where the cubic sees two endings at once, as it is not exact, shorter steps part them */
    h = h / FINER;
    short_steps = short_steps * FINER;
  }
  swing total = {{1.0, 1.0}, {0.0, 0.0}}, change = swing_by(&f, h);
  instant start, end;
  instant_at(p, &f, &total, &start);
  if (p->lets_go && start.slip == 0.0)
    start.foot_rate = 0.0; /* as it lets go, it begins to slip without a rate */

  for (int n = 0; n < STEPS_OF_PHASE; n++) {
    const swing next = swing_on(&f, &total, &change);
    instant_at(p, &f, &next, &end);
    bool is_unclear = false;
    double part;
    ending e;
    const int contact = first_ending(p, &start, &end, h, &is_unclear, &part, &e);
    if (is_unclear && finer < FINER_MOST) { /* the same once more, in shorter steps */
      short_steps = finer == 0 ? FINER : short_steps * FINER;
      finer++;
      h = h / FINER;
      change = swing_by(&f, h);
      continue;
    }
    if (contact >= 0) { /* back from the end of the step */
      const swing back = swing_by(&f, part * h - h);
      end_phase(p, &f, swing_on(&f, &next, &back), done + part * h, h, contact, e.next);
      return true;
    }
    total = next;
    start = end;
    done = done + h;

    /* past it, in long steps again */
    short_steps -= 1.0;
    if (finer > 0 && short_steps < 0.5) {
      finer = 0;
      h = whole;
      change = swing_by(&f, h);
    }
  }
  return false;
}

/* ---- All of it */

/* The impulse of the tip so far. */
static double impulse_of_tip(const push_state *p) {
  const double both = p->B - p->S * p->S - p->D * p->D / 3.5;
  return (p->V - p->spring[TIP].v - p->S * p->spring[SLATE].v - p->D / 3.5 * p->slip) / both;
}

/* How long contact i, which has no force, needs until it has one again; infinite: it has none any
 * more. */
static double wait_of(const push_state *p, int i) {
  const push_spring *x = &p->spring[i];
  if (x->branch == LEAVES)
    return x->v > 0.0 ? (double)0.0 : (double)INFINITY;
  if (x->branch == GONE || !(x->v > too_slow * p->V))
    return INFINITY;
  const double wait = -x->d / x->v;
  const double V = p->V - p->mass_ratio * impulse_of_tip(p);
  return i == TIP && wait * V > p->follow ? (double)INFINITY : wait;
}

/* Nothing acts: on to where a contact does. False: none will. */
static bool fly(push_state *p) {
  const double wait[2] = {wait_of(p, TIP), wait_of(p, SLATE)},
               first = carom_lesser(wait[TIP], wait[SLATE]);
  if (!(first < INFINITY))
    return false;
  p->time = p->time + first;
  for (int i = 0; i < 2; i++) {
    push_spring *x = &p->spring[i];
    x->d += first * x->v;
    if (x->branch == LEAVES && x->d < 0.0)
      turn_to(x, OPEN);
  }
  for (int i = 0; i < 2; i++) {
    push_spring *x = &p->spring[i];
    if (wait[i] > first)
      continue;
    if (x->branch == OPEN) {
      x->d = 0.0;
      turn_to(x, LOADS);
      if (i == TIP)
        count_touch(p);
    } else {
      turn_to(x, UNLOADS);
    }
  }
  p->slips = true;
  p->out->course = p->out->course * 31U + 17U;
  return true;
}

/* From the touch of the tip until nothing acts. False: that takes too long. */
static bool push_on(push_state *p) {
  for (int n = 0; n < PHASES_MOST; n++) {
    /* a contact without a force at which nothing moves any more has parted */
    for (int i = 0; i < 2; i++) {
      push_spring *x = &p->spring[i];
      if (x->branch == UNLOADS && p->spring[1 - i].stiff == 0.0 && x->d <= x->rest && x->v <= 0.0)
        turn_to(x, LEAVES);
    }
    const bool acts = p->spring[TIP].stiff > 0.0 || p->spring[SLATE].stiff > 0.0;
    if (acts ? !run_phase(p) : !fly(p))
      return !acts;
  }
  return false;
}

bool carom_push_alone(const carom_ball_kind *kind, const carom_cue *cue, carom_ball_state *s,
                      carom_raised *out) {
  const carom_touch touch = carom_touch_slate(kind, s);
  const double speed = carom_strike_speed(cue, kind), over = 1.0 / speed;
  push_state p;
  memset(&p, 0, sizeof p);
  memset(out, 0, sizeof *out);
  p.out = out;
  p.mass_ratio = kind->mass / cue->mass;
  p.B = 1.0 + p.mass_ratio + 2.5 * (cue->a * cue->a + cue->b * cue->b);
  p.S = touch.closing * over;
  p.D = touch.slip * over;
  p.mu = kind->mu_slide;
  p.V = cue->speed;
  p.follow = cue->follow;
  p.slips = true;

  /* both contacts at their touch */
  push_spring *tip = &p.spring[TIP], *slate = &p.spring[SLATE];
  tip->e = carom_greater(carom_tip_of(cue), least_tip);
  tip->k = carom_linear_stiffness(carom_tip_time(cue), tip->e) / p.B;
  tip->v = p.V;
  slate->e = carom_slate_under(kind);
  slate->k = carom_linear_stiffness(CAROM_SLATE_TIME, slate->e);
  tip->returns = p.follow > 0.0;
  slate->returns = true;
  turn_to(tip, LOADS);
  turn_to(slate, LOADS);
  out->touches = 1;
  if (!push_on(&p))
    return false;

  /* the impulses of tip, slate and cloth */
  const double P = impulse_of_tip(&p), Q = p.S * P - slate->v, G = (p.D * P - p.slip) / 3.5;
  const double part = P * over;
  out->impulse = P * kind->mass;
  out->V = p.V - p.mass_ratio * P;
  out->lead = tip->d - tip->v * (p.time - carom_linear_lag(carom_tip_time(cue), tip->e));
  for (int k = 0; k < 3; k++) {
    s->v[k] *= part;
    s->w[k] *= part;
  }
  carom_take_impulse(&touch, kind->radius, Q, G, s);
  carom_leave_slate(kind, Q, s);
  out->leaves = -slate->v;
  return true;
}

void carom_leave_slate(const carom_ball_kind *kind, double J, carom_ball_state *s) {
  const double e = carom_slate_restitution(kind->restitution_table);
  const double fall = 2.5 * kind->mu_spin * J / kind->radius;
  s->w[2] = fabs(s->w[2]) <= fall ? 0.0 : s->w[2] - copysign(fall, s->w[2]);
  if (s->v[2] > 0.0)
    s->v[2] = carom_rebound(s->v[2] * (e < least_e ? e / least_e : (double)1.0), 1.0);
}
