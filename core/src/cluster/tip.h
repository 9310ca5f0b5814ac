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
 *           cue, M     delta = int V dt - the way of the touched place along c'
 *     ================>.-'''-.
 *           c -->    .'p      '.          p    from the centre to the touch, |p| = R
 *                   /   '.      \         q    p x c / R: into the page for a touch above
 *                   |     'o    |              the centre
 *                   \           /
 *                    '.       .'
 *                      '-...-'
 *
 * so e^2 of the work returns. k is that of a contact which lasts T with the ball alone:
 *
 *     T = pi/2 (1 + e) sqrt(m_e / k),     1/m_e = 1/M + (1 + 5/2 |q|^2)/m.
 *
 * The set that is left where F reaches 0 recovers as delta falls: then delta_max = delta/(1 - e^2),
 * and a tip that closes again loads along the line of unloading. A tip at delta < 0 is open, and
 * touches anew. So no speed jumps where a force reaches 0. In flat play the downward component of
 * the push is lost, with the speed that it would give.
 *
 * FURTHER TOUCH. The ball moves and turns by itself, so that the tip may slide on it. The end of
 * the cue, of mass m_e, is on a shaft that bends: Y is how far the end is aside from the axis, and
 * y its velocity. The position of the tip from the centre of the ball, which moves by s, is
 *
 *     p = p_0 + Y + c int V dt - s.
 *
 * With n = -p/|p|, kappa = n . c, which turn as p does:
 *
 *     r = V c + y - v + W x n          of the tip and the position that it touches
 *     delta' = r . n / kappa
 *     P = N n + f per time, with P . c = k delta,  |f| <= mu N
 *     u = r - delta' c, across n;  f stops it in a step, or is mu N
 *     M V' = -P . c      m v' = P      (2/5) m W' = P x n
 *     Y' = y      m_e y' = -(P - (P . c) c) - K Y - m_e y/tau_s
 *
 *     c -->  ======\ m_e        n     from the tip to the centre, |n| = 1
 *                   \.-'''-.   kappa  n . c: 1 where the axis meets the centre
 *                  .'  '.   '.  y     velocity of the end m_e, across c
 *                 /      'n   \  Y     how far it is aside
 *                 |        'o |
 *
 * and mu = a/sqrt(1 - a^2), a the offset of a miscue. P . r is the power of the spring and of
 * friction, for each n, so that no energy is added. A tip that does not slide has r = delta' c, as
 * the first touch has it, whose push goes along c' too. Where friction holds back as much as it
 * pushes, N is at most 2 k delta/kappa: the rest would wedge the tip.
 *
 * While the tip has no force, delta is what its position gives, (R - |p|)/kappa, and what it
 * differed from that by as the force ended. A touch begins at delta = 0. The light end may bounce:
 * all that follows within the duration of the tip is one touch. The shaft has CAROM_SHAFT_REST to
 * become straight before the push is over. */
#ifndef CAROM_SRC_CLUSTER_TIP_H
#define CAROM_SRC_CLUSTER_TIP_H

#include "carom_shot.h"
#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "platform/ranges.h"
#include "platform/sphere.h"

/* Steps of the duration of tip or slate, for each of a contact of balls: 200 by default, which are
 * 5 us of a leather tip, with errors of 2e-4, and 9e-4 at most. Fewer are not taken. A further
 * touch, whose light end bounces for milliseconds, has half as many. */
enum { CAROM_TIP_STEPS = 200, CAROM_FURTHER_STEPS = 100, CAROM_TIP_STEPS_EACH = 8 };
/* The shaft, by 3 E I/L^3 of 13 mm of maple (E = 12.6 GPa) that is free for L = 0.2 m; how fast its
 * end comes to rest aside, which is a convention; and how long it needs until it is straight. */
#define CAROM_SHAFT_STIFFNESS 6300.0 /* K, N/m */
#define CAROM_SHAFT_TIME 1e-3        /* tau_s, s */
#define CAROM_SHAFT_REST 5e-3        /* s */
static const double too_slow = 1e-9; /* of the speed of the cue: contacts that close slower are
                                        none */
/* kappa at which a tip that slides off the side of the ball begins to lose it, and has lost it */
static const double side_kappa = 0.3, least_kappa = 0.1;
#define CAROM_ARM_STOPS \
  3e-3 /* m: the last part of the follow-through, in which the arm takes the
                                cue away */

/* delta': the speed at which the tip closes. */
static inline double tip_closing(const carom_cluster_tip *tip, const carom_cluster_ball *ball) {
  if (tip->slides)
    return tip->V +
           (cluster_dot(false, tip->y, tip->n) - cluster_dot(false, ball->v, tip->n)) / tip->kappa;
  return tip->V - cluster_dot(false, ball->v, tip->along) - tip->lost * tip->along[2] -
         cluster_dot(false, ball->W, tip->arm);
}

/* By how much the tip closes less for each m/s that the ball rises. */
static inline double tip_upward(const carom_cluster_tip *tip) {
  return tip->slides ? tip->n[2] / tip->kappa : tip->along[2];
}

/* The longest step that suits a contact of tip or slate that lasts so long: unloading, which takes
 * e/(1 + e) of the duration, has half as many steps. */
static inline double push_step(const carom_cluster_state *cluster, double duration,
                               double restitution) {
  const double least = (double)(cluster->tip.slides ? CAROM_FURTHER_STEPS : CAROM_TIP_STEPS),
               each = least / (double)(CAROM_TIP_STEPS / CAROM_TIP_STEPS_EACH);
  const double steps = carom_greater(least, cluster->steps * each);
  return 2.0 * restitution / (1.0 + restitution) * duration / steps;
}

/* The longest step in which an open tip that is to touch goes no deeper than one of its own steps.
 */
static inline double step_to_touch(const carom_cluster_state *cluster, double step) {
  const carom_cluster_tip *tip = &cluster->tip;
  const double free_step = push_step(cluster, tip->duration, tip->restitution);
  if (tip->gone || !(step > free_step) || tip->overlap > 0.0)
    return step;
  const double closing = tip_closing(tip, &cluster->ball[tip->ball]);
  return closing > 0.0 ? carom_lesser(step, free_step - tip->overlap / closing) : step;
}

/* FURTHER TOUCH: the impulse P of which J is the part along the axis. With c_t the component of c
 * across n (`aside`), A = 1/m_e + 7/2/m (`across`) and g = 1/m_e + 1/m, the slip after a step is
 *
 *     u = u0 - A f + g (N/kappa) c_t,     N = (J - f . c_t)/kappa.
 *
 * So f = u0/A + share c_t stops it, with G = g/kappa^2 (`gain`) and
 *
 *     share = G (J - u0 . c_t/A) / (A + G c_t . c_t). */
static inline void slide(const carom_cluster_tip *tip, const carom_cluster_ball *ball,
                         double P[3]) {
  const double *normal = tip->n, *cue_axis = tip->axis, kappa = tip->kappa;
  const double inverse_mass = ball->inverse_mass,
               turn[3] = {ball->W[2] * normal[1] - ball->W[1] * normal[2],
                          ball->W[0] * normal[2] - ball->W[2] * normal[0],
                          ball->W[1] * normal[0] - ball->W[0] * normal[1]};

  /* the slip u0 as the step begins: the end against the ball, less delta' c */
  double velocity[3], slip[3], aside[3], friction[3];
  cluster_minus(false, ball->v, tip->y, velocity);
  const double closing = cluster_dot(false, velocity, normal) / kappa;
  for (int axis = 0; axis < 3; axis++) {
    aside[axis] = cue_axis[axis] - kappa * normal[axis];
    slip[axis] = closing * cue_axis[axis] - velocity[axis] - turn[axis];
  }

  /* the friction that stops the slip: along c_t it counts more, as N does too */
  const double across = tip->end + CAROM_SPHERE_SLIP * inverse_mass,
               gain = (inverse_mass + tip->end) / (kappa * kappa);
  const double share = gain * (tip->J - cluster_dot(false, slip, aside) / across) /
                       (across + gain * cluster_dot(false, aside, aside));
  for (int axis = 0; axis < 3; axis++)
    friction[axis] = slip[axis] / across + share * aside[axis];

  /* or as large as N lets it be, by P . c = N (kappa + mu part) = J; and where it holds back, so
   * that N is at most 2 J/kappa: the rest would wedge the tip */
  const double size = sqrt(cluster_dot(false, friction, friction)),
               part = size > 0.0 ? cluster_dot(false, friction, aside) / size : 0.0;
  double rub = size;
  if (kappa + tip->mu * part > 0.0)
    rub = carom_lesser(rub, tip->mu * tip->J / (kappa + tip->mu * part));
  if (part < 0.0)
    rub = carom_lesser(rub, -tip->J / part);
  if (size > 0.0)
    for (int axis = 0; axis < 3; axis++)
      friction[axis] *= rub / size;
  const double N = (tip->J - rub * part) / kappa;
  for (int axis = 0; axis < 3; axis++)
    P[axis] = N * normal[axis] + friction[axis];
}

/* The end mass after an impulse -P: it gives way across c. */
static inline void end_gives_way(carom_cluster_tip *tip, const double P[3]) {
  cluster_add(false, tip->y, -tip->end, P);
  cluster_add(false, tip->y, tip->end * tip->J, tip->axis);
}

/* Gives the ball an impulse P of a tip that slides. */
static inline void slide_on(carom_cluster_state *cluster, const double P[3]) {
  carom_cluster_tip *tip = &cluster->tip;
  carom_cluster_ball *ball = &cluster->ball[tip->ball];
  const double *normal = tip->n, inverse_mass = ball->inverse_mass;
  double turn[3];
  carom_cross(P, normal, turn);
  cluster_add(!cluster->in_space, ball->v, inverse_mass, P);
  cluster_add(false, ball->W, CAROM_SPHERE_TURN * inverse_mass, turn);
  cluster_add(false, cluster->touch[tip->touch].P, 1.0, P);
}

/* Pushes the ball with J. */
static inline void tip_push(bool flat, carom_cluster_state *cluster) {
  carom_cluster_tip *tip = &cluster->tip;
  carom_cluster_ball *ball = &cluster->ball[tip->ball];
  tip->V -= tip->J * tip->inverse_mass;
  if (!(tip->J > 0.0))
    return;
  if (tip->slides) {
    double P[3];
    slide(tip, ball, P);
    end_gives_way(tip, P);
    slide_on(cluster, P);
    return;
  }

  /* a first touch: along c' and by the arm; on the cloth the part downwards is lost */
  const double gain = tip->J * ball->inverse_mass;
  cluster_add(flat, ball->v, gain, tip->along);
  tip->lost += flat ? gain * tip->along[2] : 0.0;
  cluster_add(false, ball->W, CAROM_SPHERE_TURN * gain, tip->arm);
  cluster_add(false, cluster->touch[tip->touch].P, tip->J, tip->along);
}

/* What is left of the force as the tip slides off the side of the ball, and as the arm takes the
 * cue away: 1 to 0. It never grows while the tip is compressed, so that no energy is added. */
static inline void tip_lets_go(carom_cluster_tip *tip) {
  const double side = (tip->kappa - least_kappa) / (side_kappa - least_kappa),
               arm = (tip->reach - tip->arm_way) / CAROM_ARM_STOPS;
  const double hold = carom_lesser(carom_lesser(side, arm), 1.0);
  tip->hold = tip->overlap > 0.0 ? carom_lesser(tip->hold, hold) : hold;
  tip->gone |= !(tip->hold > 0.0);
}

/* n and kappa of a tip that slides, from where it is. Returns how deep that is in the ball, along
 * the axis. A tip that has passed the side of the ball misses. */
static inline double tip_turns(carom_cluster_tip *tip, const carom_cluster_ball *ball) {
  double tip_place[3];
  for (int axis = 0; axis < 3; axis++)
    tip_place[axis] =
        tip->start[axis] + tip->bend[axis] + tip->travel * tip->axis[axis] - ball->s[axis];
  const double size = sqrt(cluster_dot(false, tip_place, tip_place)),
               kappa = -cluster_dot(false, tip_place, tip->axis) / size;
  tip->gone |= !(kappa >= least_kappa);
  if (tip->gone)
    return tip->overlap;
  for (int axis = 0; axis < 3; axis++)
    tip->n[axis] = -tip_place[axis] / size;
  tip->kappa = kappa;
  return (ball->radius - size) / kappa;
}

/* A tip that slides has a force: whether that begins a touch, which what its light end bounces does
 * not. */
static inline void tip_presses(carom_cluster_state *cluster, double tau) {
  carom_cluster_tip *tip = &cluster->tip;
  const bool begins = tip->touches == 0 || tip->apart > tip->duration;
  tip->apart = 0.0;
  if (!begins)
    return;
  tip->touch = carom_cluster_begin_touch(cluster, -1, tip->touches > 0 ? tip->touch : -1, tau, 0.0);
  tip->touches++;
  if (tip->touches == 1)
    tip->touch_closing = tip->closing;
  else if (tip->touches == 2)
    tip->second = tip->closing;
}

/* Half a step of its compression, and its impulse; whether it acts. */
static inline bool tip_acts(carom_cluster_state *cluster, double step, double tau) {
  carom_cluster_tip *tip = &cluster->tip;

  /* half a step, by the speed at which it begins */
  tip->J = 0.0;
  tip->closing = tip_closing(tip, &cluster->ball[tip->ball]);
  tip->overlap += 0.5 * step * tip->closing;
  tip->travel += 0.5 * step * tip->V;
  tip->apart += step;
  if (tip->overlap <= 0.0 || tip->gone)
    return false;

  /* a first touch begins where the tip is closed, another where it has a force */
  if (!tip->slides && tip->overlap_max == 0.0) {
    tip->touch =
        carom_cluster_begin_touch(cluster, -1, tip->touches > 0 ? tip->touch : -1, tau, 0.0);
    tip->touches++;
    if (tip->touches == 2)
      tip->second = tip->closing;
  }

  /* the impulse of the step */
  tip->J =
      step * carom_linear_force(tip->stiffness, tip->restitution, tip->overlap, &tip->overlap_max);
  if (tip->slides)
    tip->J *= tip->hold;
  tip->impulse += tip->J;
  if (tip->slides && tip->J > 0.0)
    tip_presses(cluster, tau);

  /* a tip without a force acts where it closes */
  const bool acts = tip->J > 0.0 || tip->closing > too_slow * tip->first;
  tip->last = acts ? tau : tip->last;
  return acts;
}

/* The set recovers; the tip is open where none is left. */
static inline void tip_recovers(carom_cluster_tip *tip) {
  tip->overlap_max = carom_set_left(tip->restitution, tip->overlap, tip->overlap_max);
  if (tip->overlap_max > 0.0)
    return;
  tip->gone |= !(tip->reach > 0.0); /* without follow-through it is over */
}

/* The end on its shaft, a step later; and where the tip is then. The arm takes away a cue that has
 * used up its length, once it does not press. */
static inline void shaft_bends(carom_cluster_tip *tip, const carom_cluster_ball *ball,
                               double step) {
  for (int axis = 0; axis < 3; axis++) {
    tip->bend[axis] += step * tip->y[axis];
    tip->y[axis] -= step * (tip->y[axis] / CAROM_SHAFT_TIME +
                            CAROM_SHAFT_STIFFNESS * tip->end * tip->bend[axis]);
  }
  tip->arm_way += step * carom_greater(tip->V, tip->slowest);
  if (tip->gone)
    return;
  const double deep = tip_turns(tip, ball);
  tip_lets_go(tip);
  if (tip->J > 0.0)
    tip->beyond = tip->overlap - deep;
  else
    tip->overlap = deep + tip->beyond;
}

/* The other half of the step. */
static inline void tip_parts(carom_cluster_state *cluster, double step) {
  carom_cluster_tip *tip = &cluster->tip;
  const carom_cluster_ball *ball = &cluster->ball[tip->ball];
  const double closing = tip_closing(tip, ball), middle = tip->overlap;
  tip->overlap += 0.5 * step * closing;
  tip->travel += 0.5 * step * tip->V;
  if (tip->overlap_max > 0.0)
    tip->overlap_max = carom_hertz_vertex(middle, tip->overlap_max, step, tip->closing, closing);
  const bool was_closed = tip->overlap_max > 0.0;
  if (tip->slides)
    shaft_bends(tip, ball, step);
  if (was_closed)
    tip_recovers(tip);
}

/* A wait of the push, in which nothing acts; `touches` at its end. */
static inline void tip_waits(carom_cluster_tip *tip, const carom_cluster_ball *ball, double wait,
                             bool touches) {
  tip->overlap = touches ? CAROM_LEAST_OVERLAP : tip->overlap + wait * tip_closing(tip, ball);
  tip->travel += wait * tip->V;
  tip_recovers(tip);
}

/* How long the cue needs to its next touch, where nothing acts; infinite: it does not touch. */
static inline double wait_of_tip(const carom_cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  const double closing = tip_closing(tip, &cluster->ball[tip->ball]);
  if (tip->gone || tip->overlap > 0.0 || !(closing > too_slow * tip->first))
    return INFINITY;
  const double wait = -tip->overlap / closing;
  return wait * tip->V <= tip->reach ? wait : INFINITY;
}

#endif
