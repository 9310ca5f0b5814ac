/* The push of a raised cue at a ball that is alone, on the slate.
 *
 * The cue presses the ball on the slate for the time T of the tip, within which the slate answers
 * several times. The blow alone would give the ball a speed v_n into the slate and a slip u of its
 * surface there; it comes as a half-sine pulse, of which the part Phi has come at the time t. d is
 * the overlap of ball and slate, F/m Hertz's force over the mass with the restitution e of the
 * slate (cluster/hertz.h). The cloth takes a slip s as it comes:
 *
 *   d'' = v_n Phi' - F/m             Phi = (1 - cos(pi t / T)) / 2
 *   s'  = |u| Phi' - 7/2 mu F/m      s >= 0
 *
 * The direction of u never changes: the pulse gives it, and friction is against it. So the impact
 * is that of shot/slate.c with the J and the J_t of this integral, and the direction in which the
 * ball rolls at last is that of the blow alone, as Coriolis found: J_t does not change the angular
 * momentum about the point that touches the slate. Positions stay, and weight has no part. The rest
 * of the contact after the pulse has a closed form, by its energy.
 *
 * METHOD. Nystrom's of order 4 within each branch of the force: off the slate, loading, unloading.
 * A step in which the branch ends, where v or d reaches a value, is taken again up to there, by
 * Hermite's cubic. As the integral of F/m is v_n Phi - v, s needs no quadrature:
 *
 *   X = |u| Phi - 7/2 mu (v_n Phi - v),      s = X + max(0, the greatest -X so far).
 *
 * Only T over the duration of the slate's contact counts: with e = 0.5, v' is 0.46 v_n where that
 * ratio is 0.75, and 0.13 v_n where it is 2 (physics/air). The contact of ball, cloth and slate
 * lasts 0.8 ms at 1 m/s and changes as v_n^-0.2: a convention, as no measurement was found.
 * Hertz's law of a ball on bare slate gives 0.36 ms. e below 0.2 is computed as 0.2, and v'
 * multiplied by e/0.2.
 *
 * v' has jumps where a contact that has nearly ended is loaded again, since one that has ended
 * takes energy once more (physics/air looks for them). */
#include "cluster/hertz.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "shot/clusters.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { PARTS = 32, STEPS_MOST = 4000 };  /* steps of a contact at 1 m/s, or of a shorter pulse */
static const double contact_at_1 = 8e-4; /* s: of ball and slate at 1 m/s */
static const double least_e = 0.2;

/* The contact of ball and slate; forces and impulses over the mass. */
enum { OFF, LOADING, UNLOADING };
typedef struct press {
  int branch;
  double k, e, T;
  double down, blow;   /* v_n, m/s, and v_n pi/(2 T) */
  double stiff, rest;  /* of the branch: its k, and the overlap at which it is without a force */
  double t, d, d_max;  /* s, m */
  double v;            /* down, m/s */
  double sine, cosine; /* of pi t / T */
} press;

/* A step of h: the state at its end, the accelerations at both, and by how much pi t / T turns in
 * half of it. */
typedef struct press_step {
  double h, d, v, a[2];
  double turn_s, turn_c, sine, cosine;
} press_step;

double carom_tip_time(const carom_cue *cue) {
  return cue->tip_time > 0.0 ? cue->tip_time : CAROM_TIP_TIME;
}

static double stiffness_of_slate(void) {
  const double size = contact_at_1 / CAROM_HERTZ_DURATION;
  return 1.25 / (size * size * sqrt(size));
}

void carom_slate_under(const carom_ball_kind *kind, double *k, double *e) {
  *k = stiffness_of_slate();
  *e = carom_greater(carom_slate_restitution(kind->restitution_table), least_e);
}

static press_step step_of(const press *p, double h) {
  press_step to;
  double s, c;
  memset(&to, 0, sizeof to);
  carom_sincos(1.57079632679489662 / p->T * h, &s, &c);
  to.h = h;
  to.turn_s = s;
  to.turn_c = c;
  return to;
}

/* Down, of the pulse and the force of the branch. */
static inline double acceleration(const press *p, double sine, double d) {
  const double pulse = p->blow * sine, y = d - p->rest;
  return y <= 0.0 ? pulse : pulse - p->stiff * y * sqrt(y);
}

/* Nystrom's method from the state of p. */
static inline void take_step(const press *p, press_step *to) {
  const double h = to->h, s = to->turn_s, c = to->turn_c, a0 = acceleration(p, p->sine, p->d);
  const double middle = p->sine * c + p->cosine * s, of_middle = p->cosine * c - p->sine * s;
  to->sine = middle * c + of_middle * s;
  to->cosine = of_middle * c - middle * s;
  const double a1 = acceleration(p, middle, p->d + 0.5 * h * (p->v + 0.25 * h * a0));
  const double a2 = acceleration(p, to->sine, p->d + h * (p->v + 0.5 * h * a1));
  to->d = p->d + h * (p->v + h / 6.0 * (a0 + 2.0 * a1));
  to->v = p->v + h / 6.0 * (a0 + 4.0 * a1 + a2);
  to->a[0] = a0;
  to->a[1] = a2;
}

/* The part of a step of h at which a number that goes from q0 to q1, at the rates v0 and v1, is 0:
 * of Hermite's cubic, by Newton's method within bounds. */
static double zero_within(double q0, double v0, double q1, double v1, double h) {
  double low = 0.0, high = 1.0, t = q0 / (q0 - q1);
  for (int k = 0; k < 5; k++) {
    const double u = 1.0 - t;
    const double q =
        u * u * (1.0 + 2.0 * t) * q0 + t * t * (3.0 - 2.0 * t) * q1 + h * t * u * (u * v0 - t * v1);
    const double slope = 6.0 * t * u * (q1 - q0) +
                         h * ((1.0 - 4.0 * t + 3.0 * t * t) * v0 + (3.0 * t * t - 2.0 * t) * v1);
    *((q > 0.0) == (q0 > 0.0) ? &low : &high) = t;
    const double next = t - q / slope;
    t = next >= low && next <= high ? next : 0.5 * (low + high);
  }
  return t;
}

/* Where the branch ends within a step, as a part of it; 1: it does not. *next becomes the branch
 * that follows. */
static double end_of_branch(const press *p, const press_step *to, int *next) {
  const double rest = p->rest;
  *next = p->branch == LOADING ? UNLOADING : LOADING;
  if (p->branch == LOADING && p->v > 0.0 && to->v < 0.0)
    return zero_within(p->v, to->a[0], to->v, to->a[1], to->h);
  if (p->branch == UNLOADING && to->d < rest) {
    *next = OFF;
    return zero_within(p->d - rest, p->v, to->d - rest, to->v, to->h);
  }
  if (p->branch == UNLOADING && to->d > p->d_max)
    return zero_within(p->d - p->d_max, p->v, to->d - p->d_max, to->v, to->h);
  if (p->branch == OFF && to->d > 0.0 && to->v > 0.0)
    return p->d < 0.0 ? zero_within(p->d, p->v, to->d, to->v, to->h) : 0.0;
  return 1.0;
}

/* Begins the next branch where the last one has ended. */
static void turn_to(press *p, int next) {
  const double e2 = p->e * p->e;
  p->stiff = next == OFF ? 0.0 : p->k;
  p->rest = 0.0;
  if (next == UNLOADING) {
    p->d_max = p->d;
    p->v = 0.0;
    p->stiff = p->k / (e2 * p->e);
    p->rest = (1.0 - e2) * p->d_max;
  } else if (next == OFF) {
    p->d = p->d_max = 0.0;
  }
  p->branch = next;
}

/* The pulse, from its begin to its end. Returns the slip that is left. */
static double press_on(press *p, double slip, double friction) {
  const double least = carom_lesser(p->T, contact_at_1) / (double)PARTS,
               of_pulse = slip - friction * p->down,
               of_rate = of_pulse * (1.57079632679489662 / p->T);
  /* The first loading is smooth: twice as long steps keep the errors of physics/strike at 5e-5 in
   * 99 of 100, three times as long 7e-5. Unloading is as much shorter as e is below 1. */
  const double first = p->T < contact_at_1 ? 1.5 : 2.0;
  press_step whole = step_of(p, first * least), shorter = step_of(p, p->e * least);
  double lowest = 0.0, X = 0.0, rate = 0.0;
  bool more = true;
  for (int n = 0; more && n < STEPS_MOST; n++) {
    press_step to = p->branch == UNLOADING ? shorter : whole;
    more = p->t + to.h < p->T * (1.0 - 1e-12);
    if (!more)
      to = step_of(p, p->T - p->t);
    take_step(p, &to);

    /* up to the end of the branch */
    int next;
    const double part = end_of_branch(p, &to, &next);
    if (part < 1.0) {
      more = true;
      to = step_of(p, part * to.h);
      take_step(p, &to);
    }
    p->t += to.h;
    p->d = to.d;
    p->v = to.v;
    p->sine = to.sine;
    p->cosine = to.cosine;

    /* the least X, within a step the vertex of a parabola */
    const double before = X, rate_before = rate;
    X = of_pulse * (0.5 * (1.0 - p->cosine)) + friction * p->v;
    rate = of_rate * p->sine + friction * to.a[1];
    lowest = carom_lesser(lowest, X);
    if (rate_before < 0.0 && rate > 0.0)
      lowest = carom_lesser(lowest,
                            before + 0.5 * to.h * rate_before * rate_before / (rate_before - rate));
    if (part < 1.0) {
      turn_to(p, next);
      whole = step_of(p, least);
    }
  }
  return X - lowest;
}

/* The speed at which the ball leaves the slate, with no push any more. */
static double press_parts(const press *p) {
  const double k = 0.4 * p->k, e2 = p->e * p->e, kinetic = 0.5 * p->v * p->v;
  if (p->branch == OFF)
    return p->v > 0.0 ? p->e * p->v : -p->v;
  if (p->branch == LOADING)
    return p->e * sqrt(2.0 * (kinetic + k * p->d * p->d * sqrt(p->d)));
  const double y = carom_greater(p->d - (1.0 - e2) * p->d_max, 0.0);
  const double energy = kinetic + k / (p->e * e2) * y * y * sqrt(y),
               work = k * p->d_max * p->d_max * sqrt(p->d_max);
  /* loading again takes only the energy above that given back so far */
  const bool again = p->v > 0.0 && energy > e2 * work;
  return again ? p->e * sqrt(2.0 * (work + energy - e2 * work)) : sqrt(2.0 * energy);
}

double carom_press_on_slate(const carom_ball_kind *kind, double tip_time, carom_ball_state *s) {
  const double e = carom_slate_restitution(kind->restitution_table),
               friction = 3.5 * kind->mu_slide;
  const carom_touch touch = carom_touch_slate(kind, s);
  press p;
  memset(&p, 0, sizeof p);
  p.k = stiffness_of_slate();
  p.e = carom_greater(e, least_e);
  p.T = tip_time > 0.0 ? tip_time : CAROM_TIP_TIME;
  p.down = touch.closing;
  p.blow = p.down * (1.57079632679489662 / p.T);
  p.cosine = 1.0;
  turn_to(&p, LOADING);
  const double left = press_on(&p, touch.slip, friction);

  /* the rest of the contact, and the end of hops */
  const double parts = press_parts(&p);
  const double slip = carom_greater(left - friction * (parts + p.v), 0.0);
  const double leaves = parts * (e / p.e), up = carom_rebound(leaves, 1.0);
  carom_answer_of_slate(
      kind, &touch, up,
      carom_lesser(2.0 / 7.0 * (touch.slip - slip), kind->mu_slide * (touch.closing + up)), s);
  return leaves;
}

void carom_leave_slate(const carom_ball_kind *kind, double J, carom_ball_state *s) {
  const double fall = 2.5 * kind->mu_spin * J / kind->radius;
  s->w[2] = fabs(s->w[2]) <= fall ? 0.0 : s->w[2] - copysign(fall, s->w[2]);
  s->v[2] = s->v[2] > 0.0 ? carom_rebound(s->v[2], 1.0) : s->v[2];
}
