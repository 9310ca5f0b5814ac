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
 *      F c'\   .-'''-.       x   compression of the tip, along c'
 *           \.'       '.     y   compression of the slate, downwards
 *           (     o     )    s   slip of the foot, along t
 *            '.       .'     F   of the tip, along c'
 *     _________'-.^.-'____   N   of the slate, upwards
 *          <-- f  N  --> t   f   of the cloth, against t
 *
 * c' is the direction of the push, c'_h its horizontal part, q the arm of the tip, and t a unit
 * vector. The slip begins at 0 and the push gives it the direction t, so that direction never
 * changes. Therefore a ball finally rolls where Coriolis found. Weight has no part, and positions
 * stay.
 *
 * SPRINGS. Both contacts load as k d, and unload as k/e^2 (d - rest) with rest = (1 - e^2) d_max,
 * so that e^2 of the work returns. Where the force has reached 0 the contact leaves: it has no
 * force, and the set recovers as d falls. If it closes again before d is 0, it loads along the line
 * of unloading from there. It is open where d < 0; what closes then touches anew. A cue without a
 * follow-through does not touch anew.
 *
 * PHASES. Between two changes of a branch, or of the foot, the equations are linear:
 * z'' = -A z with z = (x, y) less its rest. Each eigenvalue lambda of A is a mode
 *
 *   z(t) = z(0) C(t) + z'(0) U(t)     C'' = -lambda C, C(0) = 1, C'(0) = 0, and U' = C, U(0) = 0
 *
 * and C and U of a sum of two times follow from C and U of both. No step has to be small: steps are
 * taken only to find where a phase ends. That is where a value changes its sign within a step, or
 * dips below 0 and returns. Hermite's cubic gives the time, and one step of Newton's method on the
 * modes themselves makes it exact. Slip and impulses follow from the speeds.
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
#include "platform/sphere.h"
#include "shot/clusters.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { PHASES_MOST = 400, STEPS_OF_PHASE = 3000, FINER_MOST = 5 };
static const double STEP = 0.6;       /* of a phase's faster mode, rad */
static const double FINER = 6.0;      /* subdivisions of a step whose ends do not show what happens
                                        in it */
static const double too_slow = 1e-9;  /* of the cue's speed: contacts that close slower are none */
static const double least_e = 0.2;    /* of a slate */
static const double least_tip = 0.05; /* e of a tip, as in cluster/push.c */

/* A vertex is too near to 0 to determine its sign if it is less than this fraction of its fall. */
#define UNCLEAR_PART 0.1
/* Eigenvalues differ by at least this fraction of their sum, so that there are two modes. */
#define LEAST_SPLIT 1e-8
/* Newton's method corrects the end of a phase by less than this fraction of a step. */
#define CORRECTION_MOST 0.2
/* A phase that ends within this fraction of a step has taken no time. */
#define NO_TIME 1e-9

/* What can end a phase: the branch of a contact, or the state of the foot. The branches:
 *
 *     LOADS      until d' falls to 0: then UNLOADS
 *     UNLOADS    until d falls to its rest: then LEAVES; or rises to its top: then LOADS
 *     LEAVES     until d falls to 0: then OPEN, or GONE; or d' rises to 0: then UNLOADS
 *     OPEN       until d rises to 0: then LOADS */
enum { TIP, SLATE, FOOT, ENDS };
enum { OPEN, LOADS, UNLOADS, LEAVES, GONE }; /* GONE: a cue that does not follow through */

typedef struct push_spring {
  int branch;
  bool returns;                /* touches anew once it is open */
  double loading, restitution; /* over the mass of the ball, 1/s^2; restitution */
  double compression, rate;    /* compression, m, and its rate, m/s */
  double top;                  /* d_max */
  double rest, stiffness; /* of the branch: d without a force, and the rate of the force, 1/s^2 */
} push_spring;

typedef struct push_state {
  double B, S, D, mu;    /* the numbers of the equations */
  double V, mass_ratio;  /* of the cue: speed before the strike, m/s; m/M */
  double follow;         /* m: how far the cue continues */
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
  double z[2][2], z_rate[2][2];     /* [mode][contact] */
  double of_tip, of_slate;          /* the slip by the changes of both speeds */
} push_phase;

/* Values at one time of a phase. `foot` ends its state as it passes 0: the slip, or the friction
 * that it needs to hold less what it has. */
typedef struct instant {
  double compression[2], rate[2], acceleration[2], slip, foot, foot_rate;
} instant;

/* A value whose sign ends a phase: at the start of a step and at its end, or at its vertex within
 * the step, and its rates there. */
typedef struct ending {
  double start, from_rate, end, to_rate, share; /* share: the fraction of the step up to `to` */
  int next;                                     /* the branch that follows */
} ending;

double carom_slate_under(const carom_ball_kind *kind) {
  return carom_greater(carom_slate_restitution(kind->restitution_table), least_e);
}

/* ---- Contacts */

/* Begins a branch where the last one has ended. */
static void turn_to(push_spring *spring, int next) {
  const double lost = 1.0 - spring->restitution * spring->restitution;
  const bool comes_back = spring->branch == LEAVES;
  spring->stiffness = spring->rest = 0.0;
  spring->branch = next;
  if (next == LOADS) {
    spring->rate = carom_greater(spring->rate, 0.0);
    spring->stiffness = spring->loading;
  } else if (next == UNLOADS) {
    spring->rate = 0.0;
    spring->top = comes_back ? spring->compression / lost : spring->compression;
    spring->rest = lost * spring->top;
    spring->stiffness = spring->loading / (spring->restitution * spring->restitution);
  } else if (next == OPEN || spring->compression <= 0.0 || !(lost > 0.0)) {
    spring->branch = spring->returns ? OPEN : GONE;
    spring->top = 0.0;
    spring->compression = carom_lesser(spring->compression, 0.0); /* it is not beyond by rounding */
  }
}

/* Whether a value that is not beyond 0 at either end of a step is so at its vertex within it.
 * *is_unclear becomes true if that is too close to decide. */
static bool dips(double value, double from_rate, double to_rate, double step, int next,
                 bool *is_unclear, ending *found) {
  const bool falls_first =
      value > 0.0 ? from_rate < 0.0 && to_rate > 0.0 : from_rate > 0.0 && to_rate < 0.0;
  if (!falls_first)
    return false;
  const double share = from_rate / (from_rate - to_rate), fall = 0.5 * from_rate * share * step;
  const double vertex = value + fall;
  *is_unclear |= fabs(vertex) < UNCLEAR_PART * fabs(fall);
  if ((vertex > 0.0) == (value > 0.0))
    return false;
  *found = (ending){value, from_rate, vertex, 0.0, share, next};
  return true;
}

/* The end of a branch that is left as its compression passes `level`, downwards or upwards. */
static bool passes(double level, bool down, int contact, const instant *first, const instant *last,
                   double step, int next, bool *is_unclear, ending *found) {
  const double start = first->compression[contact] - level,
               end = last->compression[contact] - level;
  if (down ? end < 0.0 : end > 0.0) {
    *found = (ending){start, first->rate[contact], end, last->rate[contact], 1.0, next};
    return true;
  }
  const bool inside = down ? start > 0.0 : start < 0.0;
  return inside &&
         dips(start, first->rate[contact], last->rate[contact], step, next, is_unclear, found);
}

/* The same of one that is left as it begins to unload, or to close. */
static bool turns(bool unloads, int contact, const instant *start, const instant *end, double step,
                  bool *is_unclear, ending *found) {
  if (unloads ? end->rate[contact] < 0.0 : end->rate[contact] > 0.0) {
    *found = (ending){start->rate[contact],
                      start->acceleration[contact],
                      end->rate[contact],
                      end->acceleration[contact],
                      1.0,
                      UNLOADS};
    return true;
  }
  return dips(start->rate[contact], start->acceleration[contact], end->acceleration[contact], step,
              UNLOADS, is_unclear, found);
}

/* Whether the branch of a contact ends within a step. */
static bool branch_ends(const push_spring *spring, int contact, const instant *start,
                        const instant *end, double step, bool *is_unclear, ending *found) {
  switch (spring->branch) {
  case LOADS:
    return turns(true, contact, start, end, step, is_unclear, found);
  case UNLOADS:
    return passes(spring->rest, true, contact, start, end, step, LEAVES, is_unclear, found) ||
           passes(spring->top, false, contact, start, end, step, LOADS, is_unclear, found);
  case LEAVES:
    return dips(start->compression[contact], start->rate[contact], end->rate[contact], step, OPEN,
                is_unclear, found) ||
           turns(false, contact, start, end, step, is_unclear, found) ||
           passes(0.0, true, contact, start, end, step, OPEN, is_unclear, found);
  case OPEN:
    return passes(0.0, false, contact, start, end, step, LOADS, is_unclear, found);
  default:
    return false;
  }
}

/* Whether the foot begins to hold, or to slip, within a step. */
static bool foot_ends(const push_state *push, const instant *start, const instant *end, double step,
                      bool *is_unclear, ending *found) {
  const bool passed = push->slips ? end->foot < 0.0 : end->foot > 0.0,
             inside = push->slips ? start->foot > 0.0 : start->foot < 0.0;
  if (passed) {
    *found = (ending){start->foot, start->foot_rate, end->foot, end->foot_rate, 1.0, 0};
    return true;
  }
  return inside && dips(start->foot, start->foot_rate, end->foot_rate, step, 0, is_unclear, found);
}

/* The fraction of a step at which an ending is 0: of Hermite's cubic, without the zeros that it has
 * at its start, by Newton's method within bounds. */
static double part_of_step(const ending *found, double step) {

  /* the cubic over the span, by the values and rates at its ends */
  const double span = found->share * step, rise = found->end - found->start;
  double cubic[4] = {found->start, span * found->from_rate,
                     3.0 * rise - span * (2.0 * found->from_rate + found->to_rate),
                     span * (found->from_rate + found->to_rate) - 2.0 * rise};

  /* it begins at a zero, where the phase has just begun: that one is left out */
  for (int zero = 0; zero < 2 && cubic[0] == 0.0; zero++) {
    cubic[0] = cubic[1];
    cubic[1] = cubic[2];
    cubic[2] = cubic[3];
    cubic[3] = 0.0;
  }
  const double end = cubic[0] + cubic[1] + cubic[2] + cubic[3];
  if ((cubic[0] > 0.0) == (end > 0.0))
    return 0.0; /* it is beyond at once */

  /* from where the chord is 0; within bounds, which halve where a step leads out of them */
  double low = 0.0, high = 1.0, part = cubic[0] / (cubic[0] - end);
  for (int iteration = 0; iteration < 3; iteration++) {
    const double value = cubic[0] + part * (cubic[1] + part * (cubic[2] + part * cubic[3])),
                 slope = cubic[1] + part * (2.0 * cubic[2] + 3.0 * part * cubic[3]);
    *((value > 0.0) == (cubic[0] > 0.0) ? &low : &high) = part;
    const double next = part - value / slope;
    part = next >= low && next <= high ? next : 0.5 * (low + high);
  }
  return found->share * part;
}

/* ---- A phase */

/* C and U of an eigenvalue at a time t up to STEP of the faster mode, to 1e-15, only by sums and
 * products. With q = -lambda t^2, C is the sum of q^n/(2n)!, and U/t that of q^n/(2n + 1)!, each by
 * its even and its odd powers, which are computed together. */
static void swing_of(double lambda, double time, double *C, double *U) {
  const double q = -lambda * time * time, q2 = q * q;
  const double c_even = 1.0 + q2 * (1.0 / 24.0 + q2 * (1.0 / 40320.0 + q2 * (1.0 / 479001600.0)));
  const double c_odd =
      1.0 / 2.0 + q2 * (1.0 / 720.0 + q2 * (1.0 / 3628800.0 + q2 * (1.0 / 87178291200.0)));
  const double u_even =
      1.0 + q2 * (1.0 / 120.0 + q2 * (1.0 / 362880.0 + q2 * (1.0 / 6227020800.0)));
  const double u_odd =
      1.0 / 6.0 + q2 * (1.0 / 5040.0 + q2 * (1.0 / 39916800.0 + q2 * (1.0 / 1307674368000.0)));
  *C = c_even + q * c_odd;
  *U = time * (u_even + q * u_odd);
}

static swing swing_by(const push_phase *phase, double time) {
  swing change;
  for (int mode = 0; mode < 2; mode++)
    swing_of(phase->lambda[mode], time, &change.C[mode], &change.U[mode]);
  return change;
}

/* At the sum of two times. */
static swing swing_on(const push_phase *phase, const swing *first, const swing *second) {
  swing sum;
  for (int mode = 0; mode < 2; mode++) {
    sum.C[mode] =
        first->C[mode] * second->C[mode] - phase->lambda[mode] * first->U[mode] * second->U[mode];
    sum.U[mode] = first->U[mode] * second->C[mode] + first->C[mode] * second->U[mode];
  }
  return sum;
}

/* The two modes of the phase that begins. */
static void begin_phase(const push_state *push, push_phase *phase) {
  const push_spring *tip = &push->spring[TIP], *slate = &push->spring[SLATE];

  /* A, with the friction of the foot: the friction that holds, or mu N */
  const double held = push->D * push->D / CAROM_SPHERE_SLIP;
  const double B = push->slips ? push->B : push->B - held,
               S = push->slips ? push->S + push->mu * push->D : push->S; /* of N in x'' */
  phase->A[TIP][TIP] = B * tip->stiffness;
  phase->A[TIP][SLATE] = -S * slate->stiffness;
  phase->A[SLATE][TIP] = -push->S * tip->stiffness;
  phase->A[SLATE][SLATE] = slate->stiffness;

  /* eigenvalues: the first is the greater; a steep cue on a rough cloth wedges the ball where the
   * second is below 0 */
  const double half = 0.5 * (phase->A[0][0] - phase->A[1][1]),
               sum = phase->A[0][0] + phase->A[1][1];
  const double root =
      carom_greater(sqrt(half * half + phase->A[0][1] * phase->A[1][0]), LEAST_SPLIT * sum);
  phase->lambda[0] = 0.5 * sum + root;
  phase->lambda[1] = tip->stiffness * slate->stiffness * (B - push->S * S) / phase->lambda[0];
  phase->quick = sqrt(phase->lambda[0]);

  /* the first mode has (A - lambda_1) z / (lambda_0 - lambda_1), the second the rest */
  const double over = 0.5 / root;
  const double compression[2] = {tip->compression - tip->rest, slate->compression - slate->rest},
               rate[2] = {tip->rate, slate->rate};
  for (int row = 0; row < 2; row++) {
    phase->z[0][row] = phase->z_rate[0][row] = 0.0;
    for (int column = 0; column < 2; column++) {
      const double share =
          over * (row == column ? phase->A[row][column] - phase->lambda[1] : phase->A[row][column]);
      phase->z[0][row] += share * compression[column];
      phase->z_rate[0][row] += share * rate[column];
    }
    phase->z[1][row] = compression[row] - phase->z[0][row];
    phase->z_rate[1][row] = rate[row] - phase->z_rate[0][row];
  }

  /* s' as a sum of x'' and y'' */
  const double both = push->B - push->S * (push->S + push->mu * push->D);
  phase->of_tip =
      push->slips && both != 0.0 ? -(push->D - CAROM_SPHERE_SLIP * push->mu * push->S) / both : 0.0;
  phase->of_slate = push->slips ? phase->of_tip * S + CAROM_SPHERE_SLIP * push->mu : 0.0;
}

/* All values at a time of the phase, by C and U of it. */
static void instant_at(const push_state *push, const push_phase *phase, const swing *swung,
                       instant *values) {

  /* compressions and speeds, of which each mode has a part; and the forces */
  double force[2], rate[2], pressed[2];
  for (int contact = 0; contact < 2; contact++) {
    pressed[contact] = values->rate[contact] = 0.0;
    for (int mode = 0; mode < 2; mode++) {
      pressed[contact] +=
          phase->z[mode][contact] * swung->C[mode] + phase->z_rate[mode][contact] * swung->U[mode];
      values->rate[contact] += phase->z_rate[mode][contact] * swung->C[mode] -
                               phase->lambda[mode] * phase->z[mode][contact] * swung->U[mode];
    }
    values->compression[contact] = pressed[contact] + push->spring[contact].rest;
    force[contact] = push->spring[contact].stiffness * pressed[contact];
    rate[contact] = push->spring[contact].stiffness * values->rate[contact];
  }
  for (int contact = 0; contact < 2; contact++)
    values->acceleration[contact] = -carom_plane_dot(phase->A[contact], pressed);

  /* the foot */
  values->slip = push->slip + phase->of_tip * (values->rate[TIP] - push->spring[TIP].rate) +
                 phase->of_slate * (values->rate[SLATE] - push->spring[SLATE].rate);
  if (push->slips) {
    values->foot = values->slip;
    values->foot_rate = push->D * force[TIP] - CAROM_SPHERE_SLIP * push->mu * force[SLATE];
  } else {
    values->foot = push->D / CAROM_SPHERE_SLIP * force[TIP] - push->mu * force[SLATE];
    values->foot_rate = push->D / CAROM_SPHERE_SLIP * rate[TIP] - push->mu * rate[SLATE];
  }
}

/* Which of the endings is first within a step, or -1, and at which fraction of it. */
static int first_ending(const push_state *push, const instant *start, const instant *end,
                        double step, bool *is_unclear, double *part, ending *first) {
  int contact = -1;
  *part = 2.0;
  *first = (ending){0.0, 0.0, 0.0, 0.0, 1.0, 0};
  for (int candidate = 0; candidate < ENDS; candidate++) {
    ending found;
    const bool ends = candidate == FOOT ? foot_ends(push, start, end, step, is_unclear, &found)
                                        : branch_ends(&push->spring[candidate], candidate, start,
                                                      end, step, is_unclear, &found);
    const double share = ends ? part_of_step(&found, step) : 2.0;
    if (!(share < *part))
      continue;
    *part = share;
    *first = found;
    contact = candidate;
  }
  return contact;
}

/* The value of an ending, and its rate. */
static double value_of(const push_state *push, int contact, int next, const instant *values,
                       double *rate) {
  if (contact == FOOT) {
    *rate = values->foot_rate;
    return values->foot;
  }
  const push_spring *spring = &push->spring[contact];
  if (next == UNLOADS) {
    *rate = values->acceleration[contact];
    return values->rate[contact];
  }
  *rate = values->rate[contact];
  double level = 0.0;
  if (next == LEAVES)
    level = spring->rest;
  else if (spring->branch == UNLOADS)
    level = spring->top;
  return values->compression[contact] - level;
}

/* Whether the friction that the foot needs to hold is at most what it has. */
static bool held(const push_state *push) {
  const push_spring *tip = &push->spring[TIP], *slate = &push->spring[SLATE];
  return push->D / CAROM_SPHERE_SLIP * tip->stiffness * (tip->compression - tip->rest) <=
         push->mu * slate->stiffness * (slate->compression - slate->rest);
}

/* The tip touches anew. */
static void count_touch(push_state *push) {
  push->out->touches++;
  if (push->out->touches == 2)
    push->out->second = push->spring[TIP].rate;
}

/* Ends the phase where an ending is 0, near the time of C and U. */
static void end_phase(push_state *push, const push_phase *phase, swing swung, double elapsed,
                      double step, int contact, int next) {
  instant values;
  double rate;
  instant_at(push, phase, &swung, &values);

  /* the exact time, by one step of Newton's method on the modes; not before the phase began */
  const double value = value_of(push, contact, next, &values, &rate);
  double off = rate != 0.0 ? -value / rate : 0.0;
  off = fabs(off) < CORRECTION_MOST * step ? carom_greater(off, -elapsed) : 0.0;
  const swing change = swing_by(phase, off), total = swing_on(phase, &swung, &change);
  push->time = push->time + elapsed + off;
  push->stuck = elapsed + off > NO_TIME * step ? 0 : push->stuck + 1;
  instant_at(push, phase, &total, &values);

  /* the state there, and the branch that follows */
  for (int side = 0; side < 2; side++) {
    push->spring[side].compression = values.compression[side];
    push->spring[side].rate = values.rate[side];
  }
  push->slip = carom_greater(values.slip, 0.0);

  /* the course, by which derivatives know whether another one is near */
  push->out->course = push->out->course * 31U + (unsigned)(contact * 4 + next) + 1U;
  push->lets_go = false;
  if (contact == FOOT) {
    push->slips = !push->slips;
    push->lets_go = push->slips;
    push->slip = 0.0;
    return;
  }
  if (push->spring[contact].branch == OPEN) {
    push->spring[contact].compression = 0.0;
    if (contact == TIP)
      count_touch(push);
  }
  turn_to(&push->spring[contact], next);
  push->slips = push->slips || !held(push);
}

/* One phase, to its end. False: it takes too many steps. */
static bool run_phase(push_state *push) {
  push_phase phase;
  begin_phase(push, &phase);
  const double whole = STEP / phase.quick;
  double step = whole, short_steps = 1.0, done = 0.0;
  int finer = 0;
  for (; finer < push->stuck - 2 && finer < FINER_MOST; finer++) {
    /* where the cubic sees two endings at once, as it is not exact, shorter steps part them */
    step = step / FINER;
    short_steps = short_steps * FINER;
  }
  swing total = {{1.0, 1.0}, {0.0, 0.0}}, change = swing_by(&phase, step);
  instant start, end;
  instant_at(push, &phase, &total, &start);
  if (push->lets_go && start.slip == 0.0)
    start.foot_rate = 0.0; /* as it lets go, it begins to slip without a rate */

  for (int count = 0; count < STEPS_OF_PHASE; count++) {
    const swing next = swing_on(&phase, &total, &change);
    instant_at(push, &phase, &next, &end);
    bool is_unclear = false;
    double part;
    ending found;
    const int contact = first_ending(push, &start, &end, step, &is_unclear, &part, &found);
    if (is_unclear && finer < FINER_MOST) { /* the same once more, in shorter steps */
      short_steps = finer == 0 ? FINER : short_steps * FINER;
      finer++;
      step = step / FINER;
      change = swing_by(&phase, step);
      continue;
    }
    if (contact >= 0) { /* back from the end of the step */
      const swing back = swing_by(&phase, part * step - step);
      end_phase(push, &phase, swing_on(&phase, &next, &back), done + part * step, step, contact,
                found.next);
      return true;
    }
    total = next;
    start = end;
    done = done + step;

    /* past it, in long steps again */
    short_steps -= 1.0;
    if (finer > 0 && short_steps < 0.5) {
      finer = 0;
      step = whole;
      change = swing_by(&phase, step);
    }
  }
  return false;
}

/* ---- All of it */

/* The impulse of the tip so far. */
static double impulse_of_tip(const push_state *push) {
  const double both = push->B - push->S * push->S - push->D * push->D / CAROM_SPHERE_SLIP;
  return (push->V - push->spring[TIP].rate - push->S * push->spring[SLATE].rate -
          push->D / CAROM_SPHERE_SLIP * push->slip) /
         both;
}

/* How long a contact without a force needs until it has one again; infinite: it never has one
 * again. */
static double wait_of(const push_state *push, int contact) {
  const push_spring *spring = &push->spring[contact];
  if (spring->branch == LEAVES)
    return spring->rate > 0.0 ? 0.0 : INFINITY;
  if (spring->branch == GONE || !(spring->rate > too_slow * push->V))
    return INFINITY;
  const double wait = -spring->compression / spring->rate;
  const double speed = push->V - push->mass_ratio * impulse_of_tip(push);
  return contact == TIP && wait * speed > push->follow ? INFINITY : wait;
}

/* Nothing acts: on to where a contact does. False: none will. */
static bool fly(push_state *push) {
  const double wait[2] = {wait_of(push, TIP), wait_of(push, SLATE)},
               first = carom_lesser(wait[TIP], wait[SLATE]);
  if (!(first < INFINITY))
    return false;
  push->time = push->time + first;
  for (int contact = 0; contact < 2; contact++) {
    push_spring *spring = &push->spring[contact];
    spring->compression += first * spring->rate;
    if (spring->branch == LEAVES && spring->compression < 0.0)
      turn_to(spring, OPEN);
  }
  for (int contact = 0; contact < 2; contact++) {
    push_spring *spring = &push->spring[contact];
    if (wait[contact] > first)
      continue;
    if (spring->branch == OPEN) {
      spring->compression = 0.0;
      turn_to(spring, LOADS);
      if (contact == TIP)
        count_touch(push);
    } else {
      turn_to(spring, UNLOADS);
    }
  }
  push->slips = true;
  push->out->course = push->out->course * 31U + 17U;
  return true;
}

/* From the touch of the tip until nothing acts. False: that takes too long. */
static bool push_on(push_state *push) {
  for (int phases = 0; phases < PHASES_MOST; phases++) {
    /* a contact without a force at which nothing moves any more has parted */
    for (int contact = 0; contact < 2; contact++) {
      push_spring *spring = &push->spring[contact];
      if (spring->branch == UNLOADS && push->spring[1 - contact].stiffness == 0.0 &&
          spring->compression <= spring->rest && spring->rate <= 0.0)
        turn_to(spring, LEAVES);
    }
    const bool acts = push->spring[TIP].stiffness > 0.0 || push->spring[SLATE].stiffness > 0.0;
    if (acts ? !run_phase(push) : !fly(push))
      return !acts;
  }
  return false;
}

bool carom_push_alone(const carom_ball_kind *kind, const carom_cue *cue, carom_ball_state *state,
                      carom_raised *out) {
  const carom_touch touch = carom_touch_slate(kind, state);
  const double speed = carom_strike_speed(cue, kind), over = 1.0 / speed;
  push_state push;
  memset(&push, 0, sizeof push);
  memset(out, 0, sizeof *out);
  push.out = out;
  push.mass_ratio = kind->mass / cue->mass;
  push.B = 1.0 + push.mass_ratio + CAROM_SPHERE_TURN * (cue->a * cue->a + cue->b * cue->b);
  push.S = touch.closing * over;
  push.D = touch.slip * over;
  push.mu = kind->mu_slide;
  push.V = cue->speed;
  push.follow = cue->follow;
  push.slips = true;

  /* both contacts at their touch */
  push_spring *tip = &push.spring[TIP], *slate = &push.spring[SLATE];
  tip->restitution = carom_greater(carom_tip_of(cue), least_tip);
  tip->loading = carom_linear_stiffness(carom_tip_time(cue), tip->restitution) / push.B;
  tip->rate = push.V;
  slate->restitution = carom_slate_under(kind);
  slate->loading = carom_linear_stiffness(CAROM_SLATE_TIME, slate->restitution);
  tip->returns = push.follow > 0.0;
  slate->returns = true;
  turn_to(tip, LOADS);
  turn_to(slate, LOADS);
  out->touches = 1;
  if (!push_on(&push))
    return false;

  /* the impulses of tip, slate and cloth */
  const double of_tip = impulse_of_tip(&push), of_slate = push.S * of_tip - slate->rate,
               of_cloth = (push.D * of_tip - push.slip) / CAROM_SPHERE_SLIP;
  const double part = of_tip * over;
  out->impulse = of_tip * kind->mass;
  out->V = push.V - push.mass_ratio * of_tip;
  out->lead = tip->compression -
              tip->rate * (push.time - carom_linear_lag(carom_tip_time(cue), tip->restitution));
  for (int axis = 0; axis < 3; axis++) {
    state->v[axis] *= part;
    state->w[axis] *= part;
  }
  carom_take_impulse(&touch, kind->radius, of_slate, of_cloth, state);
  carom_leave_slate(kind, of_slate, state);
  out->leaves = -slate->rate;
  return true;
}

void carom_leave_slate(const carom_ball_kind *kind, double J, carom_ball_state *state) {
  const double restitution = carom_slate_restitution(kind->restitution_table);
  const double fall = CAROM_SPHERE_TURN * kind->mu_spin * J / kind->radius;
  state->w[2] = fabs(state->w[2]) <= fall ? 0.0 : state->w[2] - copysign(fall, state->w[2]);
  if (state->v[2] > 0.0)
    state->v[2] =
        carom_rebound(state->v[2] * (restitution < least_e ? restitution / least_e : 1.0), 1.0);
}
