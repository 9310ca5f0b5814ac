/* The slate as a contact of a push, with every ball on it.
 *
 * A linear contact of the slate and the foot of a ball, per unit of its mass, with the set and the
 * restitution e of the tip (tip.h); friction |g| <= mu F against the slip of the foot, as on the
 * cloth (cluster.h) with F for L. By itself it lasts CAROM_SLATE_TIME. The tip presses the struck
 * ball on the slate with the part F_down of its force. That frees a contact of the ball from the
 * cloth: phi grows by min(1, F_down / (mu F)). So a cue that is raised by a hair pushes as a level
 * one. A ball that nothing else touches has the same law in phases: shot/raised.c.
 *
 * A ball that a nose throws down (nose.h), or that comes down to one, lands afterwards, as another
 * event, as it does where no tip is. So the slate does not see what it `falls` by: the speed that
 * closes here is -(v_z - falls). */
#ifndef CAROM_SRC_CLUSTER_SLATE_H
#define CAROM_SRC_CLUSTER_SLATE_H

#include "carom_shot.h"
#include "cluster/tip.h"
#include "platform/sphere.h"

/* The upward speed of a ball that the slate sees. */
static inline double slate_sees(const carom_cluster_state *cluster, int ball) {
  return cluster->ball[ball].v[2] - cluster->slate[ball].falls;
}

/* Half a step of the overlaps of all, and their impulses; whether one acts. */
static inline bool slate_acts(carom_cluster_state *cluster, double step) {
  bool any = false;
  for (int index = 0; index < cluster->balls; index++) {
    carom_cluster_slate *slate = &cluster->slate[index];
    const carom_cluster_ball *ball = &cluster->ball[index];

    /* half a step, by the speed at which it begins */
    slate->J = 0.0;
    slate->closing = -slate_sees(cluster, index);
    slate->overlap += 0.5 * step * slate->closing;
    if (slate->overlap <= 0.0 || !(slate->restitution > 0.0))
      continue;

    /* the force of a unit of mass, on the mass of the ball */
    const double stiff = carom_linear_stiffness(CAROM_SLATE_TIME, slate->restitution);
    slate->J = step *
               carom_linear_force(stiff, slate->restitution, slate->overlap, &slate->overlap_max) /
               ball->inverse_mass;
    slate->impulse += slate->J;
    any |= slate->J > 0.0 || slate->closing > too_slow * cluster->tip.first;
  }
  return any;
}

/* The fraction of the friction `most` of two balls that the tip presses the struck one on the slate
 * by. */
static inline double share_of_tip(const carom_cluster_state *cluster, int i, int j, double most) {
  const carom_cluster_tip *tip = &cluster->tip;
  if (tip->ball != i && tip->ball != j)
    return 0.0;
  const double down = -tip_upward(tip) * tip->J;
  if (!(down > 0.0))
    return 0.0;
  return down < most ? down / most : 1.0;
}

/* The other half of a step, after which contacts may be open. */
static inline void slate_parts(carom_cluster_state *cluster, double step) {
  for (int index = 0; index < cluster->balls; index++) {
    carom_cluster_slate *slate = &cluster->slate[index];
    const double closing = -slate_sees(cluster, index), middle = slate->overlap;
    slate->overlap += 0.5 * step * closing;
    if (slate->overlap_max == 0.0)
      continue;
    slate->overlap_max =
        carom_hertz_vertex(middle, slate->overlap_max, step, slate->closing, closing);
    slate->overlap_max = carom_set_left(slate->restitution, slate->overlap, slate->overlap_max);
  }
}

/* How long a ball above the slate needs down to it; infinite: it does not reach it. */
static inline double wait_of_slate(const carom_cluster_state *cluster, int ball) {
  const carom_cluster_slate *slate = &cluster->slate[ball];
  const double down = -slate_sees(cluster, ball);
  const bool comes =
      slate->restitution > 0.0 && slate->overlap <= 0.0 && down > too_slow * cluster->tip.first;
  return comes ? -slate->overlap / down : INFINITY;
}

/* A wait of the push, in which nothing acts; `touches` at its end. */
static inline void slate_waits(carom_cluster_slate *slate, double down, double wait, bool touches) {
  slate->overlap = touches ? CAROM_LEAST_OVERLAP : slate->overlap + wait * down;
  slate->overlap_max = carom_set_left(slate->restitution, slate->overlap, slate->overlap_max);
}

/* The speed upwards at which the slate lets a ball go that moves at v_z, as a step begins, if
 * nothing else acts: by the energy that is stored along the branch it is on. */
static inline double slate_releases(const carom_cluster_slate *slate, double v_z, double step) {
  const double overlap = slate->overlap - 0.5 * step * slate->closing;
  if (!(overlap > 0.0 && slate->restitution > 0.0))
    return v_z;
  const double stiffness = carom_linear_stiffness(CAROM_SLATE_TIME, slate->restitution),
               returned = slate->restitution * slate->restitution;

  /* it loads: all of this energy and of the speed returns by e^2 */
  if (overlap >= slate->overlap_max && v_z < 0.0)
    return slate->restitution * sqrt(stiffness * overlap * overlap + v_z * v_z);

  /* it unloads, from d_max: the energy without what the set has lost */
  const double top = carom_greater(overlap, slate->overlap_max),
               elastic = carom_greater(overlap - (1.0 - returned) * top, 0.0);
  const double square = v_z * v_z + stiffness / returned * elastic * elastic,
               most = stiffness * returned * top * top;
  if (v_z < 0.0 && square > most) /* it loads again beyond its greatest overlap */
    return slate->restitution * sqrt(stiffness * top * top + square - most);
  return elastic > 0.0 || v_z < 0.0 ? sqrt(square) : v_z;
}

/* Lets all balls go at once, before a step; the cloth rubs their feet meanwhile. */
static inline void slate_lets_go(carom_cluster_state *cluster, double step) {
  for (int index = 0; index < cluster->balls; index++) {
    carom_cluster_slate *slate = &cluster->slate[index];
    carom_cluster_ball *ball = &cluster->ball[index];
    if (!(slate->overlap > 0.0 && slate->restitution > 0.0))
      continue;

    /* the rest of the impulse, in place of this step's */
    const double v_z = slate_sees(cluster, index), gain = slate_releases(slate, v_z, step) - v_z;
    ball->v[2] += gain;
    slate->impulse += gain / ball->inverse_mass - slate->J;
    slate->overlap = slate->overlap_max = slate->J = 0.0;

    /* friction against the slip of the foot, which it stops at most */
    const double slip_x = ball->v[0] - ball->W[1], slip_y = ball->v[1] + ball->W[0],
                 slip = sqrt(slip_x * slip_x + slip_y * slip_y);
    const double friction = carom_lesser(ball->mu_slide * gain, slip / CAROM_SPHERE_SLIP);
    if (!(friction > 0.0))
      continue;
    ball->v[0] -= friction * slip_x / slip;
    ball->v[1] -= friction * slip_y / slip;
    ball->W[0] -= CAROM_SPHERE_TURN * friction * slip_y / slip;
    ball->W[1] += CAROM_SPHERE_TURN * friction * slip_x / slip;
  }
}

#endif
