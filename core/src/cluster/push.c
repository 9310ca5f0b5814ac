/* The tip of a cue as a contact of a cluster: directions, arm and stiffness; tip.h has the law. */
#include "cluster/cluster.h"
#include "cluster/cue.h"
#include "cluster/tip.h"
#include "cluster/vectors.h"

#include <math.h>
#include <string.h>

static const double least_tip_restitution = 0.05; /* a tip that gives nothing back parts at once */

void carom_cluster_tip_of(carom_cluster_state *c, int struck, const double cue[8], double T) {
  carom_cluster_tip *x = &c->tip;
  memset(x, 0, sizeof *x);
  const double a = cue[3], b = cue[4], inverse = c->ball[struck].inverse_mass;
  const double ratio = 1.0 / (inverse * cue[6]), inside = 1.0 - a * a;
  double axis[3], left[3], above[3];
  carom_cue_axes(cue[1], cue[2], axis, left, above);

  /* squirt turns the push, motion/strike.h; the arm p x c / R */
  const double aside = -2.5 * a * sqrt(inside), ahead = 1.0 + ratio + 2.5 * inside;
  const double size = sqrt(aside * aside + ahead * ahead);
  for (int k = 0; k < 3; k++) {
    x->along[k] = (ahead * axis[k] + aside * left[k]) / size;
    x->arm[k] = b * left[k] - a * above[k];
    x->axis[k] = axis[k];
  }

  x->ball = struck;
  x->inverse_mass = 1.0 / cue[5];
  x->V = cue[0];
  x->T = T;
  /* a restitution of 0 stands for 1, and keeps its derivatives */
  x->e = least_tip_restitution;
  if (cue[7] > least_tip_restitution)
    x->e = cue[7];
  else if (cue[7] == 0.0)
    x->e = 1.0 + cue[7];
  x->k =
      carom_linear_stiffness(T, x->e) / (x->inverse_mass + (1.0 + 2.5 * (a * a + b * b)) * inverse);
  x->first = x->V - cluster_dot(false, c->ball[struck].v, x->along) -
             cluster_dot(false, c->ball[struck].W, x->arm);
}

void carom_cluster_tip_slides(carom_cluster_state *c, const double cue[8], double mu) {
  carom_cluster_tip *x = &c->tip;
  double left[3], above[3];
  carom_cue_axes(cue[1], cue[2], x->axis, left, above);
  x->slides = true;
  x->mu = mu;
  x->end = 1.0 / cue[6];
  x->kappa = sqrt(1.0 - cue[3] * cue[3] - cue[4] * cue[4]);
  for (int k = 0; k < 3; k++)
    x->n[k] = x->kappa * x->axis[k] - cue[3] * left[k] - cue[4] * above[k];
  for (int k = 0; k < 3; k++)
    x->place[k] = -x->n[k];
  x->first = tip_closing(x, &c->ball[x->ball]);
}

void carom_cluster_push_alone(carom_cluster_state *c) {
  carom_cluster_tip *x = &c->tip;
  carom_cluster_ball *p = &c->ball[x->ball];
  const double arm2 = cluster_dot(false, x->arm, x->arm);
  const double mobility = x->inverse_mass + (1.0 + 2.5 * arm2) * p->inverse_mass;
  x->J = x->impulse = (1.0 + x->e) * x->first / mobility;
  x->touches = 1;
  x->last = x->T;

  /* as where the integrator ends: the tip opens, and the ball is where it was pushed to */
  const double rest = x->T - carom_linear_lag(x->T, x->e);
  c->duration = x->T;
  x->travel = x->V * x->T - x->J * x->inverse_mass * rest;
  for (int k = 0; k < 3; k++) {
    p->v0[k] = p->v[k];
    p->s[k] = x->T * p->v[k];
    p->shift[k] = 0.0;
  }
  cluster_add(!c->in_space, p->s, rest * x->J * p->inverse_mass, x->along);
  x->V -= x->J * x->inverse_mass;
  cluster_add(!c->in_space, p->v, x->J * p->inverse_mass, x->along);
  cluster_add(false, p->W, 2.5 * x->J * p->inverse_mass, x->arm);
}

void carom_cluster_put_on_slate(carom_cluster_state *c) {
  c->on_slate = c->in_space = true;
  memset(c->slate, 0, (size_t)c->balls * sizeof *c->slate);
  /* the less a cue is raised, the less the slate does, and the longer its steps may be */
  c->steepness = carom_freedom_of_balls(0.0, c->tip.along[2]);
}

double carom_cluster_slate_impulse(const carom_cluster_state *c, int ball) {
  return c->on_slate ? c->slate[ball].impulse : 0.0;
}
