/* What closes a push, and what is next in one where nothing acts.
 *
 * A push is open while the tip or a contact of balls acts. The slate keeps it open only if it would
 * bring the struck ball back to the tip. With v_z' the speed at which it would let that ball go,
 *
 *     delta' <= 0  and  delta' - c'_z (v_z' - v_z) > 0.
 *
 * Otherwise the slate lets go at once. So its part goes to 0 with c'_z, and a level cue is the
 * limit of a raised one. Then only what touches within the recovery of the tip belongs to the push,
 * and balls above the slate fall to it. A tip that would close without the impulse of the slate too
 * touches again as it follows through (shot/follow_through.c). All else is met in flight, from
 * positions that make both the same: places.c. After a further touch the push lasts until the
 * shaft is straight, and in a nose until the ball has left it. */
#ifndef CAROM_SRC_CLUSTER_CLOSING_H
#define CAROM_SRC_CLUSTER_CLOSING_H

#include "cluster/nose.h"
#include "cluster/slate.h"

/* s: a tip that lasts shorter takes the steps of this one while it is open, as it has no force */
static const double long_tip = 1e-4;
/* of how far the cue goes in the duration of the tip: beyond it the tip will not touch soon */
static const double far_behind = 20.0;

/* Steps of CAROM_SHAFT_TIME, while only the end of the shaft moves. */
static const double shaft_steps = 50.0;

/* The longest step that suits a nose: as of the tip, and so that it is touched no deeper. */
static inline double step_of_nose(const carom_cluster_state *cluster) {
  const carom_cluster_nose *nose = &cluster->nose;
  const carom_cluster_ball *ball = &cluster->ball[cluster->tip.ball];
  const double step =
      push_step(cluster, CAROM_NOSE_TIME, nose->touches ? nose->restitution : least_nose);
  if (nose->touches)
    return step;
  const double gap = nose_gap(nose, ball), approach = nose_approach(nose, ball);
  return approach > 0.0 ? step + carom_greater(gap, 0.0) / approach : INFINITY;
}

/* The longest step of a strike. A cue that is far behind does not count, as contacts of balls may
 * last long where they are slow. */
static inline double strike_step(const carom_cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  const bool open = (tip->touches > 0 || cluster->nose_near) && tip->overlap <= 0.0;
  const double duration = open ? carom_greater(tip->duration, long_tip) : tip->duration;
  const bool far = open && tip->overlap < -far_behind * duration * tip->first;
  const bool swings = tip->slides && open;
  double step = cluster->nose_near ? step_of_nose(cluster) : INFINITY;

  /* the shorter of the times of the tip, and of each slate that acts or carries the struck ball */
  if (swings)
    step = carom_lesser(step, CAROM_SHAFT_TIME / shaft_steps);
  else if (!far)
    step = carom_lesser(step, push_step(cluster, duration, tip->restitution));
  for (int index = 0; cluster->on_slate && index < cluster->balls; index++)
    if (cluster->slate[index].restitution > 0.0 &&
        ((index == tip->ball && !far && !swings) || cluster->slate[index].J > 0.0))
      step = carom_lesser(step,
                          push_step(cluster, CAROM_SLATE_TIME, cluster->slate[index].restitution) /
                              cluster->steepness);
  return step;
}

/* Where neither tip nor balls act in a step, whether the slate has let the balls go. */
static inline bool slate_ends(carom_cluster_state *cluster, double step) {
  const carom_cluster_tip *tip = &cluster->tip;
  const carom_cluster_ball *ball = &cluster->ball[tip->ball];
  const double v_z = slate_sees(cluster, tip->ball);
  const double least = too_slow * tip->first, closing = tip_closing(tip, ball),
               up = slate_releases(&cluster->slate[tip->ball], v_z, step) - v_z;
  /* the condition of the head: the ball would return to the tip */
  if (!tip->gone && closing <= least && closing - tip_upward(tip) * up > least)
    return false;
  slate_lets_go(cluster, step);
  return true;
}

/* Whether the end of the shaft, bent after a further touch, may touch the ball once more: so long
 * the push lasts. It does not where the axis recedes, farther away than the end may swing. */
static inline bool shaft_straightens(const carom_cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  const carom_cluster_ball *ball = &cluster->ball[tip->ball];
  if (!tip->slides || tip->gone || tip->touches == 0 || !(tip->apart < CAROM_SHAFT_REST))
    return false;
  const double swing = carom_space_size(tip->bend) + CAROM_SHAFT_TIME * carom_space_size(tip->y);
  return tip->kappa * tip->V > cluster_dot(false, ball->v, tip->n) ||
         -tip->kappa * tip->overlap < swing;
}

/* How long the tip needs until its set has recovered, and no longer than it touches. */
static inline double recovery(const carom_cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  const double closing = tip_closing(tip, &cluster->ball[tip->ball]);
  return tip->overlap > 0.0 && closing < 0.0 ? carom_lesser(-tip->overlap / closing, tip->duration)
                                             : 0.0;
}

/* Whether the tip would close without the slate too. */
static inline bool follows_through(const carom_cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  const carom_cluster_ball *ball = &cluster->ball[tip->ball];
  const double by_slate = -tip_upward(tip) * cluster->slate[tip->ball].impulse * ball->inverse_mass;
  return tip_closing(tip, ball) - by_slate > too_slow * tip->first;
}

/* Nothing acts: all continues to the next touch of balls, which need `of_balls`, or under a raised
 * cue of tip or slate. Returns whether there is one in the push. */
static inline bool go_to_touch(bool flat, carom_cluster_state *cluster, double of_balls,
                               double *tau) {
  carom_cluster_tip *tip = &cluster->tip;
  if (tip->slides) /* what is next is another event */
    return false;
  const bool waits = cluster->on_slate && !follows_through(cluster);
  const double of_tip = waits ? wait_of_tip(cluster) : INFINITY;

  /* the first touch: of the tip, of a ball and the slate, or of two balls */
  double wait = of_tip;
  for (int index = 0; cluster->on_slate && index < cluster->balls; index++)
    wait = carom_lesser(wait, wait_of_slate(cluster, index));
  if (of_balls < wait && !(of_balls < recovery(cluster)))
    return false;
  wait = carom_lesser(wait, of_balls);
  if (!(wait < INFINITY))
    return false;

  /* sets recover meanwhile */
  tip_waits(tip, &cluster->ball[tip->ball], wait, of_tip <= wait);
  for (int index = 0; cluster->on_slate && index < cluster->balls; index++)
    slate_waits(&cluster->slate[index], -slate_sees(cluster, index), wait,
                wait_of_slate(cluster, index) <= wait);
  for (int index = 0; index < cluster->balls; index++)
    cluster_add(flat, cluster->ball[index].s, wait, cluster->ball[index].v);
  *tau += wait;
  return true;
}

#endif
