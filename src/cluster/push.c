/* The tip of a cue as a contact of a cluster: directions, arm and stiffness; tip.h has the law. */
#include "cluster/cluster.h"
#include "cluster/cue.h"
#include "cluster/tip.h"
#include "cluster/vectors.h"

#include <math.h>
#include <string.h>

static const double least_tip_restitution = 0.05; /* a tip that gives nothing back parts at once */

void carom_cluster_tip_of(carom_cluster_state *cluster, int struck, const double cue[8],
                          double duration) {
  carom_cluster_tip *tip = &cluster->tip;
  memset(tip, 0, sizeof *tip);
  const double a = cue[3], b = cue[4], inverse = cluster->ball[struck].inverse_mass;
  const double ratio = 1.0 / (inverse * cue[6]), inside = 1.0 - a * a;
  double cue_axis[3], left[3], above[3];
  carom_cue_axes(cue[1], cue[2], cue_axis, left, above);

  /* squirt turns the push, motion/strike.h; the arm p x c / R */
  const double aside = -2.5 * a * sqrt(inside), ahead = 1.0 + ratio + 2.5 * inside;
  const double size = sqrt(aside * aside + ahead * ahead);
  for (int axis = 0; axis < 3; axis++) {
    tip->along[axis] = (ahead * cue_axis[axis] + aside * left[axis]) / size;
    tip->arm[axis] = b * left[axis] - a * above[axis];
    tip->axis[axis] = cue_axis[axis];
  }

  tip->ball = struck;
  tip->inverse_mass = 1.0 / cue[5];
  tip->V = cue[0];
  tip->duration = duration;
  /* a restitution of 0 stands for 1, and keeps its derivatives */
  tip->restitution = least_tip_restitution;
  if (cue[7] > least_tip_restitution)
    tip->restitution = cue[7];
  else if (cue[7] == 0.0)
    tip->restitution = 1.0 + cue[7];
  tip->stiffness = carom_linear_stiffness(duration, tip->restitution) /
                   (tip->inverse_mass + (1.0 + 2.5 * (a * a + b * b)) * inverse);
  tip->first = tip->V - cluster_dot(false, cluster->ball[struck].v, tip->along) -
               cluster_dot(false, cluster->ball[struck].W, tip->arm);
}

void carom_cluster_tip_slides(carom_cluster_state *cluster, const double cue[8], double mu) {
  carom_cluster_tip *tip = &cluster->tip;
  double left[3], above[3];
  carom_cue_axes(cue[1], cue[2], tip->axis, left, above);
  tip->slides = true;
  tip->mu = mu;
  tip->end = 1.0 / cue[6];
  tip->kappa = sqrt(1.0 - cue[3] * cue[3] - cue[4] * cue[4]);
  for (int axis = 0; axis < 3; axis++)
    tip->n[axis] = tip->kappa * tip->axis[axis] - cue[3] * left[axis] - cue[4] * above[axis];
  for (int axis = 0; axis < 3; axis++)
    tip->place[axis] = -tip->n[axis];
  tip->first = tip_closing(tip, &cluster->ball[tip->ball]);
}

void carom_cluster_push_alone(carom_cluster_state *cluster) {
  carom_cluster_tip *tip = &cluster->tip;
  carom_cluster_ball *ball = &cluster->ball[tip->ball];
  const double arm2 = cluster_dot(false, tip->arm, tip->arm);
  const double mobility = tip->inverse_mass + (1.0 + 2.5 * arm2) * ball->inverse_mass;
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
  cluster_add(!cluster->in_space, ball->s, rest * tip->J * ball->inverse_mass, tip->along);
  tip->V -= tip->J * tip->inverse_mass;
  cluster_add(!cluster->in_space, ball->v, tip->J * ball->inverse_mass, tip->along);
  cluster_add(false, ball->W, 2.5 * tip->J * ball->inverse_mass, tip->arm);
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
