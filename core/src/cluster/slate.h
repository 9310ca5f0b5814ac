/* The slate as a contact of a push, with every ball on it.
 *
 * A linear contact of the slate and the foot of a ball, per unit of its mass, with the set and the
 * restitution e of the tip (tip.h); friction |g| <= mu F against the slip of the foot, as on the
 * cloth (cluster.h) with F for L. It lasts CAROM_SLATE_TIME alone. The tip presses the struck ball
 * on the slate with the part F_down of its force. That frees a contact of the ball from the cloth:
 * phi grows by min(1, F_down / (mu F)). So a cue that is raised by a hair pushes as a level one. A
 * ball that nothing else touches has the same law in phases: shot/raised.c. */
#ifndef CAROM_SRC_CLUSTER_SLATE_H
#define CAROM_SRC_CLUSTER_SLATE_H

#include "carom_shot.h"
#include "cluster/tip.h"

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

/* The share of the friction `most` of two balls that the tip presses the struck one on the slate
 * by. */
static inline double share_of_tip(const carom_cluster_state *c, int i, int j, double most) {
  const carom_cluster_tip *x = &c->tip;
  if (x->ball != i && x->ball != j)
    return 0.0;
  const double down = -tip_upward(x) * x->J;
  if (!(down > 0.0))
    return 0.0;
  return down < most ? down / most : (double)1.0;
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

/* How long a ball above the slate needs down to it; infinite: it does not come. */
static inline double wait_of_slate(const carom_cluster_state *c, int ball) {
  const carom_cluster_slate *x = &c->slate[ball];
  const double down = -c->ball[ball].v[2];
  const bool comes = x->e > 0.0 && x->d <= 0.0 && down > too_slow * c->tip.first;
  return comes ? -x->d / down : (double)INFINITY;
}

static inline void slate_waits(carom_cluster_slate *x, double down, double wait, bool touches) {
  x->d = touches ? (double)CAROM_LEAST_OVERLAP : x->d + wait * down;
  x->d_max = carom_set_left(x->e, x->d, x->d_max);
}

/* The speed upwards at which the slate lets a ball go that moves at v_z, as a step of h begins, if
 * nothing else acts: by the energy that is stored along the branch it is on. */
static inline double slate_releases(const carom_cluster_slate *x, double v_z, double h) {
  const double d = x->d - 0.5 * h * x->closing;
  if (!(d > 0.0 && x->e > 0.0))
    return v_z;
  const double k = carom_linear_stiffness((double)CAROM_SLATE_TIME, x->e), e2 = x->e * x->e;
  if (d >= x->d_max && v_z < 0.0)
    return x->e * sqrt(k * d * d + v_z * v_z);
  const double top = carom_greater(d, x->d_max), y = carom_greater(d - (1.0 - e2) * top, 0.0);
  const double square = v_z * v_z + k / e2 * y * y, most = k * e2 * top * top;
  if (v_z < 0.0 && square > most) /* it loads again beyond its greatest overlap */
    return x->e * sqrt(k * top * top + square - most);
  return y > 0.0 || v_z < 0.0 ? sqrt(square) : v_z;
}

/* Lets all balls go at once, before a step of h; the cloth rubs their feet meanwhile. */
static inline void slate_lets_go(carom_cluster_state *c, double h) {
  for (int k = 0; k < c->balls; k++) {
    carom_cluster_slate *x = &c->slate[k];
    carom_cluster_ball *p = &c->ball[k];
    if (!(x->d > 0.0 && x->e > 0.0))
      continue;
    const double up = slate_releases(x, p->v[2], h), J = up - p->v[2];
    p->v[2] = up;
    x->impulse += J / p->inverse_mass - x->J;
    x->d = x->d_max = x->J = 0.0;
    const double u_x = p->v[0] - p->W[1], u_y = p->v[1] + p->W[0], u = sqrt(u_x * u_x + u_y * u_y);
    const double g = carom_lesser(p->mu_slide * J, u / 3.5);
    if (!(g > 0.0))
      continue;
    p->v[0] -= g * u_x / u;
    p->v[1] -= g * u_y / u;
    p->W[0] -= 2.5 * g * u_y / u;
    p->W[1] += 2.5 * g * u_x / u;
  }
}

#endif
