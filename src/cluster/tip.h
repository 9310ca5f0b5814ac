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
 * The set that is left where F reaches 0 recovers as delta falls: then delta_max = delta/(1 - e^2),
 * and a tip that closes again loads along the line of unloading. A tip at delta < 0 is open, and
 * touches anew. So no speed jumps where a force reaches 0. In flat play the part of the push that
 * goes down is lost, with the speed that it would give.
 *
 * A cue goes on for a `reach` after it has parted. Without one it never touches anew. Where nothing
 * acts, balls that touch before the set has recovered still do so within the push. A raised cue
 * goes on to its next touch, and a ball above the slate down to it. Contacts that close slower than
 * 1e-9 of the speed of the cue are none.
 *
 * SLATE. A linear contact of the slate and the foot of a ball, per unit of its mass, with the same
 * set and the restitution e of both; friction |g| <= mu F against the slip of the foot, as on the
 * cloth (cluster.h) with F for L. It lasts CAROM_SLATE_TIME alone. Contacts of balls are the more
 * those of space the steeper the push: phi grows by min(1, (c'_z / 0.1)^2), cluster.h. So a cue
 * that is raised by a hair pushes as a level one. A ball that nothing else touches
 * has the same law in phases: shot/raised.c. */
#ifndef CAROM_SRC_CLUSTER_TIP_H
#define CAROM_SRC_CLUSTER_TIP_H

#include "carom_shot.h"
#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "platform/ranges.h"

/* Steps of the duration of tip or slate, for each of a contact of balls: 200 by default, which are
 * 5 us of a leather tip, with errors of 2e-4, and 9e-4 at most. Fewer are not taken. */
enum { CAROM_TIP_STEPS = 200, CAROM_TIP_STEPS_EACH = 8 };
static const double long_tip = 1e-4;   /* s: a shorter tip that is open takes steps of this one */
static const double far_behind = 20.0; /* of how far the cue goes in the duration of the tip */
static const double too_slow = 1e-9;   /* of the speed of the cue */

/* ---- The tip */

static inline double tip_closing(const carom_cluster_tip *x, const carom_cluster_ball *p) {
  return x->V - cluster_dot(false, p->v, x->along) - x->lost * x->along[2] -
         cluster_dot(false, p->W, x->arm);
}

/* The longest step that suits a contact of tip or slate: unloading is shorter than loading by e. */
static inline double push_step(const carom_cluster_state *c, double T, double e) {
  const double steps =
      carom_greater((double)CAROM_TIP_STEPS, c->steps * (double)CAROM_TIP_STEPS_EACH);
  return 2.0 * e / (1.0 + e) * T / steps;
}

/* The longest step of a strike. A cue that is far behind does not count, as contacts of balls may
 * last long where they are slow. */
static inline double strike_step(const carom_cluster_state *c) {
  const carom_cluster_tip *x = &c->tip;
  const bool open = x->touches > 0 && x->d <= 0.0;
  const double T = open ? carom_greater(x->T, long_tip) : x->T;
  const bool far = open && x->d < -far_behind * T * x->first;
  double h = far ? (double)INFINITY : push_step(c, T, x->e);
  for (int k = 0; c->on_slate && k < c->balls; k++)
    if (c->slate[k].e > 0.0 && (!far || c->slate[k].J > 0.0))
      h = carom_lesser(h, push_step(c, (double)CAROM_SLATE_TIME, c->slate[k].e) / c->steepness);
  return h;
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

/* Half a step of its compression, and its impulse; whether it acts. */
static inline bool tip_acts(carom_cluster_state *c, double h, double tau) {
  carom_cluster_tip *x = &c->tip;
  x->J = 0.0;
  x->closing = tip_closing(x, &c->ball[x->ball]);
  x->d += 0.5 * h * x->closing;
  if (x->d <= 0.0 || x->gone)
    return false;
  if (x->d_max == 0.0) { /* it touches */
    x->touches++;
    if (x->touches == 2)
      x->second = x->closing;
  }
  x->J = h * carom_linear_force(x->k, x->e, x->d, &x->d_max);
  x->impulse += x->J;

  /* a tip without a force acts where it closes */
  const bool acts = x->J > 0.0 || x->closing > too_slow * x->first;
  x->last = acts ? tau : x->last;
  return acts;
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
  x->d_max = carom_set_left(x->e, x->d, x->d_max);
  x->gone = x->d_max == 0.0 && !(x->reach > 0.0);
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

/* ---- The slate */

/* The same of a ball above the slate. */
static inline double wait_of_slate(const carom_cluster_state *c, int ball) {
  const carom_cluster_slate *x = &c->slate[ball];
  const double down = -c->ball[ball].v[2];
  const bool comes = x->e > 0.0 && x->d <= 0.0 && down > too_slow * c->tip.first;
  return comes ? -x->d / down : (double)INFINITY;
}

/* How long a contact at d needs until its set has recovered. */
static inline double recovery(double d, double closing) {
  return d > 0.0 && closing < 0.0 ? -d / closing : (double)0.0;
}

/* The longest recovery of tip and slate. */
static inline double longest_recovery(const carom_cluster_state *c) {
  const carom_cluster_tip *x = &c->tip;
  double longest = recovery(x->d, tip_closing(x, &c->ball[x->ball]));
  for (int k = 0; c->on_slate && k < c->balls; k++)
    longest = carom_greater(longest, recovery(c->slate[k].d, -c->ball[k].v[2]));
  return longest;
}

/* Nothing acts: all goes on to the next touch of balls, which need `of_balls`, or under a raised
 * cue of tip or slate. Balls that touch after the last recovery are met later, unless tip or slate
 * touch behind them. Returns whether there is a touch. */
static inline bool go_to_touch(bool flat, carom_cluster_state *c, double of_balls, double *tau) {
  const double of_tip = c->on_slate ? wait_of_tip(c) : (double)INFINITY;
  double wait = of_tip;
  for (int k = 0; c->on_slate && k < c->balls; k++)
    wait = carom_lesser(wait, wait_of_slate(c, k));
  if (of_balls < (wait < INFINITY ? wait : longest_recovery(c)))
    wait = of_balls;
  if (!(wait < INFINITY))
    return false;

  /* a set recovers meanwhile */
  carom_cluster_tip *tip = &c->tip;
  tip->d += wait * tip_closing(tip, &c->ball[tip->ball]);
  tip->d = of_tip <= wait ? (double)CAROM_LEAST_OVERLAP : tip->d;
  tip->d_max = carom_set_left(tip->e, tip->d, tip->d_max);
  /* without follow-through it is over once it is not pressed any more */
  tip->gone |= tip->d_max == 0.0 && !(tip->reach > 0.0);
  for (int k = 0; c->on_slate && k < c->balls; k++) {
    carom_cluster_slate *x = &c->slate[k];
    const bool touches = wait_of_slate(c, k) <= wait;
    x->d -= wait * c->ball[k].v[2];
    x->d = touches ? (double)CAROM_LEAST_OVERLAP : x->d;
    x->d_max = carom_set_left(x->e, x->d, x->d_max);
  }
  for (int k = 0; k < c->balls; k++)
    cluster_add(flat, c->ball[k].s, wait, c->ball[k].v);
  *tau += wait;
  return true;
}

/* Half a step of the overlaps of all, and their impulses; whether one acts. */
static inline bool slate_acts(carom_cluster_state *c, double h) {
  bool any = false;
  for (int k = 0; k < c->balls; k++) {
    carom_cluster_slate *x = &c->slate[k];
    const carom_cluster_ball *p = &c->ball[k];
    x->J = 0.0;
    x->closing = -p->v[2];
    x->d += 0.5 * h * x->closing;
    if (x->d <= 0.0 || !(x->e > 0.0))
      continue;
    const double stiff = carom_linear_stiffness((double)CAROM_SLATE_TIME, x->e);
    x->J = h * carom_linear_force(stiff, x->e, x->d, &x->d_max) / p->inverse_mass;
    x->impulse += x->J;
    any |= x->J > 0.0 || x->closing > too_slow * c->tip.first;
  }
  return any;
}

static inline void slate_parts(carom_cluster_state *c, double h) {
  for (int k = 0; k < c->balls; k++) {
    carom_cluster_slate *x = &c->slate[k];
    const double closing = -c->ball[k].v[2], middle = x->d;
    x->d += 0.5 * h * closing;
    if (x->d_max == 0.0)
      continue;
    x->d_max = carom_hertz_vertex(middle, x->d_max, h, x->closing, closing);
    x->d_max = carom_set_left(x->e, x->d, x->d_max);
  }
}

#endif
