/* The contacts of a strike, as members of a cluster: the tip of a cue with one ball, and of a
 * raised cue the slate with every ball on it.
 *
 * TIP. The cue is a body of mass M that moves along its axis c at V, and has no other freedom. Its
 * tip touches the ball at p from the centre, and pushes along c', which is c turned by the squirt
 * of the end mass. With q = p x c / R, the arm of the axis, W = R w and delta the compression of
 * the tip,
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
 * Where F has reached 0 the rest is forgotten, and a further touch counts from 0. On the cloth the
 * part of the push that goes down is lost, with the speed that it would give.
 *
 * SLATE. Hertz's contact (hertz.h) of the slate and the foot of a ball, per unit of its mass, with
 * the restitution e of both; friction |g| <= mu F against the slip of the foot, as on the cloth
 * (cluster.h) with F for L. shot/pulse.c has its duration. */
#ifndef CAROM_SRC_CLUSTER_TIP_H
#define CAROM_SRC_CLUSTER_TIP_H

#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "platform/ranges.h"

enum { CAROM_TIP_STEPS = 200 }; /* of T: 5 us of a leather tip; errors of 2e-4, 9e-4 at most */

/* ---- The tip */

static inline double tip_closing(const carom_cluster_tip *x, const carom_cluster_ball *p) {
  return x->V - cluster_dot(false, p->v, x->along) - x->lost * x->along[2] -
         cluster_dot(false, p->W, x->arm);
}

/* The longest step that suits the tip: unloading is shorter than loading by e. */
static inline double tip_step(const carom_cluster_tip *x) {
  return 2.0 * x->e / (1.0 + x->e) * x->T / (double)CAROM_TIP_STEPS;
}

/* Half a step of its compression, and its impulse; whether it acts. */
static inline bool tip_acts(carom_cluster_state *c, double h, double tau) {
  carom_cluster_tip *x = &c->tip;
  x->J = 0.0;
  x->closing = tip_closing(x, &c->ball[x->ball]);
  x->d += 0.5 * h * x->closing;
  if (x->d <= 0.0)
    return false;
  if (x->d_max == 0.0) { /* it touches */
    x->touches++;
    if (x->touches == 2)
      x->second = x->closing;
  }
  const double e2 = x->e * x->e;
  if (x->d >= x->d_max) {
    x->d_max = x->d;
    x->J = h * x->k * x->d;
  } else {
    x->J = h * x->k / e2 * carom_greater(x->d - (1.0 - e2) * x->d_max, 0.0);
  }
  x->impulse += x->J;
  x->last = tau;
  return true;
}

static inline void tip_push(bool flat, carom_cluster_state *c) {
  carom_cluster_tip *x = &c->tip;
  carom_cluster_ball *p = &c->ball[x->ball];
  const double J = x->J * p->inverse_mass;
  x->V -= x->J * x->inverse_mass;
  cluster_add(flat, p->v, J, x->along);
  x->lost += flat ? J * x->along[2] : 0.0;
  cluster_add(false, p->W, 2.5 * J, x->arm);
}

/* The other half of the step. */
static inline void tip_parts(carom_cluster_state *c, double h) {
  carom_cluster_tip *x = &c->tip;
  const double closing = tip_closing(x, &c->ball[x->ball]), middle = x->d;
  x->d += 0.5 * h * closing;
  if (x->d_max == 0.0)
    return;
  x->d_max = carom_hertz_vertex(middle, x->d_max, h, x->closing, closing);
  const double rest = (1.0 - x->e * x->e) * x->d_max;
  if (x->d <= rest) {
    x->d -= rest;
    x->d_max = 0.0;
  }
}

/* ---- The slate */

/* Half a step of the overlaps of all, and their impulses; whether one acts. */
static inline bool slate_acts(carom_cluster_state *c, double h) {
  bool any = false;
  for (int k = 0; k < c->slates; k++) {
    carom_cluster_slate *x = &c->slate[k];
    const carom_cluster_ball *p = &c->ball[x->ball];
    x->J = 0.0;
    x->closing = -p->v[2];
    x->d += 0.5 * h * x->closing;
    if (x->d <= 0.0)
      continue;
    x->J = h * carom_hertz_force(x->k, x->e, x->d, &x->d_max) / p->inverse_mass;
    x->impulse += x->J;
    any = true;
  }
  return any;
}

static inline void slate_parts(carom_cluster_state *c, double h) {
  for (int k = 0; k < c->slates; k++) {
    carom_cluster_slate *x = &c->slate[k];
    const double closing = -c->ball[x->ball].v[2], middle = x->d;
    x->d += 0.5 * h * closing;
    if (x->d_max == 0.0)
      continue;
    x->d_max = carom_hertz_vertex(middle, x->d_max, h, x->closing, closing);
    const double rest = (1.0 - x->e * x->e) * x->d_max;
    if (x->d <= rest) {
      x->d -= rest;
      x->d_max = 0.0;
    }
  }
}

#endif
