/* The impact of a ball with something that does not move: the slate, the top of a rail, a nose
 * in flight. See fixed.c. */
#ifndef CAROM_SRC_SHOT_FIXED_H
#define CAROM_SRC_SHOT_FIXED_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

/* A ball that touches something fixed. N is the unit vector from its centre into that. */
typedef struct carom_touch {
  double N[3];
  double closing; /* v . N, m/s */
  double slip;    /* |u|, m/s, u = v - (v . N) N + R w x N the velocity of its surface there */
  double t[3];    /* u/|u|, or 0 */
} carom_touch;

carom_touch carom_touch_of(const double N[3], double radius, const carom_ball_state *state);

/* Takes the impulses J N and J_t t, over the mass, m/s, from the ball. */
void carom_take_impulse(const carom_touch *touch, double radius, double J, double J_t,
                        carom_ball_state *state);

/* The speed at which a ball that falls at v_n on the slate leaves it, for a restitution e. */
double carom_rebound(double v_n, double e);

/* Of a ball with the slate, from restitution_table of its kind: 0 stands for the default, -1 for
 * none. */
static inline double carom_slate_restitution(double given) {
  return given == 0.0 ? 0.5 : given > 0.0 ? given : 0.0;
}

/* The ball, with v[2] < 0, falls on the slate or the top of a rail, at the height at which it
 * is. Its label does not change. */
void carom_hit_slate(const carom_ball_kind *kind, carom_ball_state *state);

/* The ball on the slate, with v[2] <= 0 by a blow alone, is pressed for tip_time, s; 0 stands for
 * CAROM_TIP_TIME. Afterwards v[2] >= 0. Returns the speed at which it would leave the slate but
 * for the end of hops. */
double carom_press_on_slate(const carom_ball_kind *kind, double tip_time, carom_ball_state *state);

#endif
