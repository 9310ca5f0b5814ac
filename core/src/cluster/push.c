/* The tip of a cue as a contact of a cluster: directions, arm and stiffness; tip.h has the law.
 *
 * The position p of a touch has the offsets a to the left of the axis c and b above it, in radii R:
 *
 *          above
 *            ^        .-''''-.           seen along c, which points away from the reader
 *            |      .'   a    '.
 *   left <---+     /  p----+    \        p   a left + b above - sqrt(1 - a^2 - b^2) c
 *                 |        | b   |       q   p x c/R = b left - a above, the arm of the push
 *                 |        o     |
 *                  \            /
 *                   '.        .'
 *                     '-....-'
 *
 * Squirt (motion/strike.h): the end mass m_e of the cue follows the side of the ball, so
 *
 *     c' = ((1 + m/m_e + 5/2 (1 - a^2)) c - 5/2 a sqrt(1 - a^2) left), made a unit vector. */
#include "cluster/cluster.h"
#include "cluster/cue.h"
#include "cluster/nose.h"
#include "cluster/tip.h"
#include "cluster/vectors.h"
#include "platform/sphere.h"

#include <math.h>
#include <string.h>

static const double least_tip_restitution = 0.05; /* a tip that gives nothing back parts at once */

/* The positions of the numbers of a cue in cue[], which are in the order of carom_cue. */
enum { SPEED, PHI, THETA, OFFSET_A, OFFSET_B, MASS, END_MASS, RESTITUTION };

void carom_cluster_tip_of(carom_cluster_state *cluster, int struck, const double cue[8],
                          double duration) {
  carom_cluster_tip *tip = &cluster->tip;
  memset(tip, 0, sizeof *tip);
  const double a = cue[OFFSET_A], b = cue[OFFSET_B], inverse = cluster->ball[struck].inverse_mass;
  const double ratio = 1.0 / (inverse * cue[END_MASS]), inside = 1.0 - a * a;
  double cue_axis[3], left[3], above[3];
  carom_cue_axes(cue[PHI], cue[THETA], cue_axis, left, above);

  /* the direction of the push, which squirt turns, and its arm */
  const double aside = -CAROM_SPHERE_TURN * a * sqrt(inside),
               ahead = 1.0 + ratio + CAROM_SPHERE_TURN * inside;
  const double size = sqrt(aside * aside + ahead * ahead);
  for (int axis = 0; axis < 3; axis++) {
    tip->along[axis] = (ahead * cue_axis[axis] + aside * left[axis]) / size;
    tip->arm[axis] = b * left[axis] - a * above[axis];
    tip->axis[axis] = cue_axis[axis];
  }

  /* the cue as a body */
  tip->ball = struck;
  tip->inverse_mass = 1.0 / cue[MASS];
  tip->V = cue[SPEED];
  tip->duration = duration;
  /* a restitution of 0 means 1, and keeps its derivatives */
  tip->restitution = least_tip_restitution;
  if (cue[RESTITUTION] > least_tip_restitution)
    tip->restitution = cue[RESTITUTION];
  else if (cue[RESTITUTION] == 0.0)
    tip->restitution = 1.0 + cue[RESTITUTION];

  /* the stiffness by the duration against 1/M + (1 + 5/2 |q|^2)/m; the speed at which it closes */
  tip->stiffness = carom_linear_stiffness(duration, tip->restitution) /
                   (tip->inverse_mass + (1.0 + CAROM_SPHERE_TURN * (a * a + b * b)) * inverse);
  tip->first = tip->V - cluster_dot(false, cluster->ball[struck].v, tip->along) -
               cluster_dot(false, cluster->ball[struck].W, tip->arm);
  tip->touch_closing = tip->first;
}

void carom_cluster_tip_slides(carom_cluster_state *cluster, double end_mass, double mu,
                              const double tip_place[3]) {
  carom_cluster_tip *tip = &cluster->tip;
  carom_cluster_ball *ball = &cluster->ball[tip->ball];
  tip->slides = true;
  tip->mu = mu;
  tip->end = 1.0 / end_mass;
  for (int axis = 0; axis < 3; axis++) {
    tip->start[axis] = tip_place[axis];
    ball->s[axis] = 0.0;
  }

  /* a tip that is inside the ball by what it is compressed counts as at its surface */
  tip->hold = 1.0;
  tip->beyond = -tip_turns(tip, ball);
  tip_lets_go(tip);
  tip->first = tip_closing(tip, ball);
}

void carom_cluster_put_in_nose(carom_cluster_state *cluster) {
  carom_cluster_tip *tip = &cluster->tip;
  const double lost = 1.0 - tip->restitution * tip->restitution, deep = -tip->beyond;
  tip->beyond = 0.0;
  tip->overlap = carom_lesser(deep, 0.0);
  if (deep > 0.0 && lost > 0.0) {
    tip->overlap = deep;
    tip->overlap_max = deep / lost;
  }
  tip->first = fabs(tip->V) + carom_space_size(cluster->ball[tip->ball].v);
}

bool carom_cluster_tip_comes(carom_cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  const carom_cluster_ball *ball = &cluster->ball[tip->ball];
  carom_cluster_nose nose = cluster->nose; /* it touches in the integrator */
  double v[3], W[3], leaves[3];
  cluster->nose_near = nose.model(nose.context, ball, v, W) && nose_of(ball, v, W, &nose);
  if (!cluster->nose_near || tip->gone)
    return false;
  for (int axis = 0; axis < 3; axis++)
    leaves[axis] = ball->v[axis] + nose.change * nose.v[axis];
  const double fastest = carom_greater(carom_space_size(ball->v), carom_space_size(leaves));
  return -tip->overlap * tip->kappa < nose_lasts(&nose) * (fabs(tip->V) + fastest);
}

void carom_cluster_push_alone(carom_cluster_state *cluster) {
  carom_cluster_tip *tip = &cluster->tip;
  carom_cluster_ball *ball = &cluster->ball[tip->ball];
  /* the impulse takes the closing speed, and e of it again */
  const double arm2 = cluster_dot(false, tip->arm, tip->arm);
  const double mobility = tip->inverse_mass + (1.0 + CAROM_SPHERE_TURN * arm2) * ball->inverse_mass;
  tip->J = tip->impulse = (1.0 + tip->restitution) * tip->first / mobility;
  tip->touches = 1;
  tip->last = tip->duration;

  /* as where the integrator ends: the tip opens, and the ball is where it was pushed to */
  const double rest = tip->duration - carom_linear_lag(tip->duration, tip->restitution);
  cluster->duration = tip->duration;
  tip->travel = tip->V * tip->duration - tip->J * tip->inverse_mass * rest;
  for (int axis = 0; axis < 3; axis++) {
    ball->v0[axis] = ball->v[axis];
    ball->s[axis] = tip->duration * ball->v[axis];
    ball->shift[axis] = 0.0;
  }

  /* the impulse, as if all of it had acted at its centroid */
  cluster_add(!cluster->in_space, ball->s, rest * tip->J * ball->inverse_mass, tip->along);
  tip->V -= tip->J * tip->inverse_mass;
  cluster_add(!cluster->in_space, ball->v, tip->J * ball->inverse_mass, tip->along);
  cluster_add(false, ball->W, CAROM_SPHERE_TURN * tip->J * ball->inverse_mass, tip->arm);
}

void carom_cluster_put_on_slate(carom_cluster_state *cluster) {
  cluster->on_slate = cluster->in_space = true;
  memset(cluster->slate, 0, (size_t)cluster->balls * sizeof *cluster->slate);
  /* the less a cue is raised, the less the slate does, and the longer its steps may be */
  cluster->steepness = carom_freedom_of_balls(0.0, cluster->tip.along[2]);
}

double carom_cluster_slate_impulse(const carom_cluster_state *cluster, int ball) {
  return cluster->on_slate ? cluster->slate[ball].impulse : 0.0;
}
