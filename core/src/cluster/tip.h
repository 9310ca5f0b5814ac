/* The tip of a cue as a contact of a cluster, with one ball.
 *
 * FIRST TOUCH. The cue is a body of mass M that moves along its axis c at V, and has no other
 * freedom. Its tip touches the ball at p from the centre, and pushes along c', which is c turned by
 * the squirt of the end mass. With q = p x c / R, the arm of the axis, W = R w and delta the
 * compression of the tip,
 *
 *     delta' = V - v . c' - W . q
 *     F = k delta                                        while delta > delta_max: loading
 *     F = k/e^2 (delta - (1 - e^2) delta_max), or 0      below it
 *     M V' = -F      m v' = F c'      (2/5) m W' = F q
 *
 * so e^2 of the work comes back. k is that of a contact which lasts T with the ball alone:
 *
 *     T = pi/2 (1 + e) sqrt(m_e / k),     1/m_e = 1/M + (1 + 5/2 |q|^2)/m.
 *
 * The set that is left where F reaches 0 recovers as delta falls: then delta_max = delta/(1 - e^2),
 * and a tip that closes again loads along the line of unloading. A tip at delta < 0 is open, and
 * touches anew. So no speed jumps where a force reaches 0. In flat play the part of the push that
 * goes down is lost, with the speed that it would give.
 *
 * FURTHER TOUCH. The ball moves and turns by itself, so that the tip may slide on it. With n the
 * unit vector from the place of the touch to the centre, kappa = n . c, and y the velocity of the
 * end mass m_e across c, which begins at 0,
 *
 *     r = V c + y - v - W x p,  p = -n         of the tip and the place that it touches
 *     delta' = r . n / kappa
 *     P = N n + f per time, with P . c = k delta,  |f| <= mu N
 *     u = r - delta' c, across n;  f stops it in a step, or is mu N
 *     M V' = -P . c      m_e y' = -(P - (P . c) c)      m v' = P      (2/5) m W' = p x P
 *
 * and mu = a/sqrt(1 - a^2), a the offset of a miscue. The power P . r is that of the spring and of
 * friction. A tip that does not slide has r = delta' c, as the first touch has it, whose push goes
 * along c' too. Where friction holds back as much as it pushes, N is at most 2 k delta/kappa: the
 * rest would wedge the tip. The end gives way, but the shaft holds it where friction would draw it
 * into the ball. It springs back where the force has reached 0. If the axis closes from the place
 * that the tip has slid to, the light end would bounce until it does not: one impulse stands for
 * these. */
#ifndef CAROM_SRC_CLUSTER_TIP_H
#define CAROM_SRC_CLUSTER_TIP_H

#include "carom_shot.h"
#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "platform/ranges.h"

/* Steps of the duration of tip or slate, for each of a contact of balls: 200 by default, which are
 * 5 us of a leather tip, with errors of 2e-4, and 9e-4 at most. Fewer are not taken. */
enum { CAROM_TIP_STEPS = 200, CAROM_TIP_STEPS_EACH = 8 };
static const double too_slow = 1e-9;   /* of the speed of the cue: contacts that close slower are
                                        none */
static const double least_kappa = 0.1; /* a tip that slides past it misses */

static inline double tip_closing(const carom_cluster_tip *x, const carom_cluster_ball *p) {
  if (x->slides)
    return x->V + (cluster_dot(false, x->y, x->n) - cluster_dot(false, p->v, x->n)) / x->kappa;
  return x->V - cluster_dot(false, p->v, x->along) - x->lost * x->along[2] -
         cluster_dot(false, p->W, x->arm);
}

/* By how much the tip closes less for each m/s that the ball rises. */
static inline double tip_upward(const carom_cluster_tip *x) {
  return x->slides ? x->n[2] / x->kappa : x->along[2];
}

/* The longest step that suits a contact of tip or slate: unloading is shorter than loading by e. */
static inline double push_step(const carom_cluster_state *c, double T, double e) {
  const double steps =
      carom_greater((double)CAROM_TIP_STEPS, c->steps * (double)CAROM_TIP_STEPS_EACH);
  return 2.0 * e / (1.0 + e) * T / steps;
}

/* The longest step in which an open tip that is to touch goes no deeper than one of its own steps.
 */
static inline double step_to_touch(const carom_cluster_state *c, double h) {
  const carom_cluster_tip *x = &c->tip;
  const double free_step = push_step(c, x->T, x->e);
  if (x->gone || !(h > free_step) || x->d > 0.0)
    return h;
  const double closing = tip_closing(x, &c->ball[x->ball]);
  return closing > 0.0 ? carom_lesser(h, free_step - x->d / closing) : h;
}

/* FURTHER TOUCH: the impulse P of which J is the part along the axis. With g = 1/m_e + 1/m, u after
 * a step is u0 - (1/m_e + 7/2/m) f + g (N/kappa) c_t, c_t the part of c across n. */
static inline void slide(const carom_cluster_tip *x, const carom_cluster_ball *p, double P[3]) {
  const double *n = x->n, *c = x->axis, kappa = x->kappa;
  const double m = p->inverse_mass,
               turn[3] = {p->W[2] * n[1] - p->W[1] * n[2], p->W[0] * n[2] - p->W[2] * n[0],
                          p->W[1] * n[0] - p->W[0] * n[1]};
  double v[3], u[3], aside[3], f[3]; /* v of the ball against the end; aside: c_t */
  cluster_minus(false, p->v, x->y, v);
  const double closing = cluster_dot(false, v, n) / kappa;
  for (int k = 0; k < 3; k++) {
    aside[k] = c[k] - kappa * n[k];
    u[k] = closing * c[k] - v[k] - turn[k];
  }

  /* the friction that stops the slip: along c_t it counts more, as N does too */
  const double across = x->end + 3.5 * m, gain = (m + x->end) / (kappa * kappa);
  const double share = gain * (x->J - cluster_dot(false, u, aside) / across) /
                       (across + gain * cluster_dot(false, aside, aside));
  for (int k = 0; k < 3; k++)
    f[k] = u[k] / across + share * aside[k];
  const double f_c = cluster_dot(false, f, aside), size = sqrt(cluster_dot(false, f, f));
  double N = (x->J - f_c) / kappa;

  /* or as large as N lets it be */
  if (size > 0.0 && !(size <= x->mu * N)) {
    const double part = f_c / size, push = kappa + x->mu * part;
    const bool wedges = push < 0.5 * kappa;
    N = wedges ? 2.0 * x->J / kappa : x->J / push;
    const double rub = wedges ? -x->J / part : x->mu * N;
    for (int k = 0; k < 3; k++)
      f[k] *= rub / size;
  }
  for (int k = 0; k < 3; k++)
    P[k] = N * n[k] + f[k];
}

/* The end mass after an impulse -P: it gives way, and is not drawn into the ball. */
static inline void end_gives_way(carom_cluster_tip *x, const double P[3]) {
  cluster_add(false, x->y, -x->end, P);
  cluster_add(false, x->y, x->end * x->J, x->axis);
  const double inward = cluster_dot(false, x->y, x->n), across = 1.0 - x->kappa * x->kappa;
  if (!(inward > 0.0 && across > 0.0))
    return;
  cluster_add(false, x->y, -inward / across, x->n);
  cluster_add(false, x->y, inward / across * x->kappa, x->axis);
}

/* Gives the ball an impulse P of a tip that slides. */
static inline void slide_on(carom_cluster_state *c, const double P[3]) {
  carom_cluster_tip *x = &c->tip;
  carom_cluster_ball *p = &c->ball[x->ball];
  const double *n = x->n, m = p->inverse_mass;
  double turn[3];
  carom_cross(P, n, turn);
  cluster_add(!c->in_space, p->v, m, P);
  cluster_add(false, p->W, 2.5 * m, turn);
  cluster_add(false, c->touch[x->touch].P, 1.0, P);
}

/* Pushes the ball with J. */
static inline void tip_push(bool flat, carom_cluster_state *c) {
  carom_cluster_tip *x = &c->tip;
  carom_cluster_ball *p = &c->ball[x->ball];
  x->V -= x->J * x->inverse_mass;
  if (!(x->J > 0.0))
    return;
  if (x->slides) {
    double P[3];
    slide(x, p, P);
    end_gives_way(x, P);
    slide_on(c, P);
    return;
  }
  const double J = x->J * p->inverse_mass;
  cluster_add(flat, p->v, J, x->along);
  x->lost += flat ? J * x->along[2] : 0.0;
  cluster_add(false, p->W, 2.5 * J, x->arm);
  cluster_add(false, c->touch[x->touch].P, x->J, x->along);
}

/* The force has reached 0: the end springs back, and the tip has slid on. If the axis closes from
 * there, the end would press again, and bounce: all of that is one impulse, after which it does not
 * close. */
static inline void end_springs_back(carom_cluster_state *c) {
  carom_cluster_tip *x = &c->tip;
  const carom_cluster_ball *p = &c->ball[x->ball];
  double n[3], P[3];
  for (int k = 0; k < 3; k++) {
    x->y[k] = 0.0;
    n[k] = -x->place[k] - (x->travel * x->axis[k] - p->s[k]) / p->radius;
  }
  const double over = 1.0 / sqrt(cluster_dot(false, n, n)),
               kappa = over * cluster_dot(false, n, x->axis);
  x->gone |= kappa < least_kappa;
  if (x->gone)
    return;
  x->kappa = kappa;
  for (int k = 0; k < 3; k++)
    x->n[k] = over * n[k];

  /* J by its response, which is linear in it unless the slip ends */
  const double closing = tip_closing(x, p), m = p->inverse_mass, end = x->end;
  x->closing = carom_lesser(closing, 0.0);
  if (!(closing > 0.0))
    return;
  x->end = 0.0;
  x->J = closing / (x->inverse_mass + m / (kappa * kappa));
  for (int k = 0; k < 3; k++) {
    slide(x, p, P);
    x->J *= closing / (x->J * x->inverse_mass + m * cluster_dot(!c->in_space, P, x->n) / kappa);
  }
  slide(x, p, P);
  x->end = end;
  x->V -= x->J * x->inverse_mass;
  x->impulse += x->J;
  slide_on(c, P);
  x->J = 0.0;
}

/* Half a step of its compression, and its impulse; whether it acts. */
static inline bool tip_acts(carom_cluster_state *c, double h, double tau) {
  carom_cluster_tip *x = &c->tip;
  const bool pressed = x->J > 0.0;
  x->J = 0.0;
  x->closing = tip_closing(x, &c->ball[x->ball]);
  x->d += 0.5 * h * x->closing;
  x->travel += 0.5 * h * x->V;
  if (x->d <= 0.0 || x->gone)
    return false;
  if (x->d_max == 0.0) { /* it touches */
    x->touch = carom_cluster_begin_touch(c, -1, x->touches > 0 ? x->touch : -1, tau, 0.0);
    x->touches++;
    if (x->touches == 2)
      x->second = x->closing;
  }
  x->J = h * carom_linear_force(x->k, x->e, x->d, &x->d_max);
  x->impulse += x->J;
  if (x->slides && pressed && !(x->J > 0.0))
    end_springs_back(c);

  /* a tip without a force acts where it closes */
  const bool acts = x->J > 0.0 || x->closing > too_slow * x->first;
  x->last = acts ? tau : x->last;
  return acts;
}

/* The set recovers; the tip is open where none is left. */
static inline void tip_recovers(carom_cluster_tip *x) {
  x->d_max = carom_set_left(x->e, x->d, x->d_max);
  if (x->d_max > 0.0)
    return;
  x->gone |= !(x->reach > 0.0); /* without follow-through it is over */
}

/* The other half of the step. */
static inline void tip_parts(carom_cluster_state *c, double h) {
  carom_cluster_tip *x = &c->tip;
  const double closing = tip_closing(x, &c->ball[x->ball]), middle = x->d;
  x->d += 0.5 * h * closing;
  x->travel += 0.5 * h * x->V;
  if (x->d_max == 0.0)
    return;
  x->d_max = carom_hertz_vertex(middle, x->d_max, h, x->closing, closing);
  tip_recovers(x);
}

/* A wait of the push, in which nothing acts; `touches` at its end. */
static inline void tip_waits(carom_cluster_tip *x, const carom_cluster_ball *p, double wait,
                             bool touches) {
  x->d = touches ? (double)CAROM_LEAST_OVERLAP : x->d + wait * tip_closing(x, p);
  x->travel += wait * x->V;
  tip_recovers(x);
}

/* How long the cue needs to its next touch, where nothing acts; infinite: it does not touch. */
static inline double wait_of_tip(const carom_cluster_state *c) {
  const carom_cluster_tip *x = &c->tip;
  const double closing = tip_closing(x, &c->ball[x->ball]);
  if (x->gone || x->d > 0.0 || !(closing > too_slow * x->first))
    return INFINITY;
  const double wait = -x->d / closing;
  return wait * x->V <= x->reach ? wait : (double)INFINITY;
}

#endif
