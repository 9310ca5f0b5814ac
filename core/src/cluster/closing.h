/* What closes a push, and what comes next in one where nothing acts.
 *
 * A push is open while the tip or a contact of balls acts. The slate keeps it open only if it would
 * bring the struck ball back to the tip. With v_z' the speed at which it would let that ball go,
 *
 *     delta' <= 0  and  delta' - c'_z (v_z' - v_z) > 0.
 *
 * Otherwise the slate lets go at once. So its part goes to 0 with c'_z, and a level cue is the
 * limit of a raised one. Then only what touches within the recovery of the tip belongs to the push,
 * and balls above the slate come down to it. A tip that would close without the impulse of the
 * slate too touches again as it follows through (shot/follow_through.c). All else is met in flight,
 * from places that make both the same: places.c. */
#ifndef CAROM_SRC_CLUSTER_CLOSING_H
#define CAROM_SRC_CLUSTER_CLOSING_H

#include "cluster/slate.h"

static const double long_tip = 1e-4;   /* s: a shorter tip that is open takes steps of this one */
static const double far_behind = 20.0; /* of how far the cue goes in the duration of the tip */

/* The longest step of a strike. A cue that is far behind does not count, as contacts of balls may
 * last long where they are slow. */
static inline double strike_step(const carom_cluster_state *c) {
  const carom_cluster_tip *x = &c->tip;
  const bool open = x->touches > 0 && x->d <= 0.0;
  const double T = open ? carom_greater(x->T, long_tip) : x->T;
  const bool far = open && x->d < -far_behind * T * x->first;
  double h = far ? (double)INFINITY : push_step(c, T, x->e);
  for (int k = 0; c->on_slate && k < c->balls; k++)
    if (c->slate[k].e > 0.0 && ((k == x->ball && !far) || c->slate[k].J > 0.0))
      h = carom_lesser(h, push_step(c, (double)CAROM_SLATE_TIME, c->slate[k].e) / c->steepness);
  return h;
}

/* Where neither tip nor balls act in a step of h, whether the slate has let the balls go. */
static inline bool slate_ends(carom_cluster_state *c, double h) {
  const carom_cluster_tip *tip = &c->tip;
  const carom_cluster_ball *b = &c->ball[tip->ball];
  const double least = too_slow * tip->first, closing = tip_closing(tip, b),
               up = slate_releases(&c->slate[tip->ball], b->v[2], h) - b->v[2];
  if (!tip->gone && closing <= least && closing - tip_upward(tip) * up > least)
    return false;
  slate_lets_go(c, h);
  return true;
}

/* How long the tip needs until its set has recovered, and no longer than it touches. */
static inline double recovery(const carom_cluster_state *c) {
  const carom_cluster_tip *x = &c->tip;
  const double closing = tip_closing(x, &c->ball[x->ball]);
  return x->d > 0.0 && closing < 0.0 ? carom_lesser(-x->d / closing, x->T) : (double)0.0;
}

/* Whether the tip would close without the slate too. */
static inline bool follows_through(const carom_cluster_state *c) {
  const carom_cluster_tip *x = &c->tip;
  const carom_cluster_ball *p = &c->ball[x->ball];
  const double by_slate = -tip_upward(x) * c->slate[x->ball].impulse * p->inverse_mass;
  return tip_closing(x, p) - by_slate > too_slow * x->first;
}

/* Nothing acts: all goes on to the next touch of balls, which need `of_balls`, or under a raised
 * cue of tip or slate. Returns whether there is one in the push. */
static inline bool go_to_touch(bool flat, carom_cluster_state *c, double of_balls, double *tau) {
  carom_cluster_tip *tip = &c->tip;
  const double of_tip = c->on_slate && !follows_through(c) ? wait_of_tip(c) : (double)INFINITY;
  double wait = of_tip;
  for (int k = 0; c->on_slate && k < c->balls; k++)
    wait = carom_lesser(wait, wait_of_slate(c, k));
  if (of_balls < wait && !(of_balls < recovery(c)))
    return false;
  wait = carom_lesser(wait, of_balls);
  if (!(wait < INFINITY))
    return false;

  /* sets recover meanwhile */
  tip_waits(tip, &c->ball[tip->ball], wait, of_tip <= wait);
  for (int k = 0; c->on_slate && k < c->balls; k++)
    slate_waits(&c->slate[k], -c->ball[k].v[2], wait, wait_of_slate(c, k) <= wait);
  for (int k = 0; k < c->balls; k++)
    cluster_add(flat, c->ball[k].s, wait, c->ball[k].v);
  *tau += wait;
  return true;
}

#endif
