/* Where balls start after a cluster.
 *
 * In a shot a contact takes no time: it gives its impulse where two things touch, and they go on
 * from there. A cluster hands on what such instants would have given. Each of its touches k has an
 * instant t_k, at which it would have been if those before it had given their impulses at once, at
 * theirs. With dv_l the change of velocity by touch l, v_0 the velocity before all, D_k how far the
 * two came together before they touched, and tau_k when they did,
 *
 *     (v_0 . n) t_k + sum over l of (dv_l . n) (t_k - t_l) = D_k,     0 <= t_k <= tau_k,
 *
 * solved in the order of touching. A ball then starts from
 *
 *     r' = r - sum over k of dv_k t_k,
 *
 * so that r' + v' t is where it would have been. Balls that touch from the start have D = 0 and do
 * not move; where a gap is so wide that its contact begins as the one before ends, r' + v' t_k is
 * the place of the second of two events in turn. What slate and cloth give counts at t = 0, as in
 * the strike of a ball alone.
 *
 * TIP. Its first touch is at t = 0, and a later one at tau - L, L the centroid of the impulse of a
 * contact with linear branches. At the end tau_e of a push the tip is where it has gone, and the
 * ball where the push has moved it. Its lead is that distance less what both go in t_m, the time
 * from the centroid of the push:
 *
 *     t_m = tau_e - L dv/(dv + v_0 . c)
 *     lead = int V - t_m V' + (r' - r + t_m v' - s) . c - delay
 *     delay = sum over touches with balls of (dv_k . c) (centroid_k - tau_k)
 *
 * For a ball alone the lead is V_0 L. */
#include "cluster/cluster.h"
#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "platform/promise.h"
#include "platform/ranges.h"

#include <math.h>

int carom_cluster_begin_touch(carom_cluster_state *c, int contact_index, int last, double time,
                              double approach) {
  if (last >= 0 && c->repeated == CAROM_CLUSTER_REPEATED)
    return last;
  c->repeated += last >= 0;
  CAROM_PROMISE(c->touches < CAROM_CLUSTER_TOUCHES);
  c->touch[c->touches] = (carom_cluster_touch){
      contact_index, time, carom_greater(approach, 0.0), {0.0, 0.0, 0.0}, 0.0};
  return c->touches++;
}

/* Touches in the order of their times; those of one time as they were noted. */
static void sort(carom_cluster_state *c) {
  for (int k = 1; k < c->touches; k++) {
    const carom_cluster_touch touch = c->touch[k];
    int place = k;
    for (; place > 0 && touch.time < c->touch[place - 1].time; place--)
      c->touch[place] = c->touch[place - 1];
    c->touch[place] = touch;
  }
}

/* The impulse of a touch on the first of its balls. */
static void impulse_of(const carom_cluster_state *c, const carom_cluster_touch *l, double P[3]) {
  const bool flat = !c->in_space;
  for (int n = 0; n < 3; n++)
    P[n] = l->contact < 0 ? l->P[n] : (double)0.0;
  if (l->contact < 0)
    return;
  const carom_cluster_contact_state *x = &c->contact[l->contact];
  double t[3], third[3];
  cluster_across(flat, x->n, t, third);
  cluster_add(flat, P, -l->P[0], x->n);
  cluster_add(flat, P, l->P[1], t);
  if (!flat)
    cluster_add(false, P, l->P[2], third);
}

/* The changes of velocity so far, and of the sums of them with their instants. */
typedef struct changes {
  double v[CAROM_CLUSTER_BALLS][3], moment[CAROM_CLUSTER_BALLS][3];
} changes;

/* Adds a touch at an instant, or takes it away. */
static void add(const carom_cluster_state *c, const carom_cluster_touch *l, double sign,
                double instant, changes *sum) {
  const bool flat = !c->in_space;
  int balls[2] = {c->tip.ball, -1};
  if (l->contact >= 0) {
    balls[0] = c->contact[l->contact].i;
    balls[1] = c->contact[l->contact].j;
  }
  double P[3];
  impulse_of(c, l, P);
  for (int side = 0; side < 2 && balls[side] >= 0; side++) {
    const double share = side == 0 ? sign : -sign,
                 over_mass = share * c->ball[balls[side]].inverse_mass;
    cluster_add(flat, sum->v[balls[side]], over_mass, P);
    cluster_add(flat, sum->moment[balls[side]], over_mass * instant, P);
  }
}

/* What slate and cloth give counts from the start: all that changes, less what touches give. */
static void begin(const carom_cluster_state *c, changes *sum) {
  for (int k = 0; k < c->balls; k++)
    for (int n = 0; n < 3; n++) {
      sum->moment[k][n] = 0.0;
      sum->v[k][n] = c->ball[k].v[n] - c->ball[k].v0[n];
    }
  for (int k = 0; k < c->touches; k++)
    add(c, &c->touch[k], -1.0, 0.0, sum);
}

/* The instant of a touch of two balls. */
static double instant_of(const carom_cluster_state *c, const carom_cluster_touch *l,
                         const changes *sum) {
  const carom_cluster_contact_state *x = &c->contact[l->contact];
  const bool flat = !c->in_space;
  double v[3], v0[3], moment[3];
  cluster_minus(flat, sum->v[x->i], sum->v[x->j], v);
  cluster_minus(flat, x->p->v0, x->q->v0, v0);
  cluster_minus(flat, sum->moment[x->i], sum->moment[x->j], moment);
  const double rate = cluster_dot(flat, v0, x->n) + cluster_dot(flat, v, x->n),
               way = l->approach + cluster_dot(flat, moment, x->n);
  if (!(way > 0.0))
    return 0.0;
  return way < rate * l->time ? way / rate : l->time;
}

/* How far the struck ball is behind as a touch of it lasts. */
static double delay_of(const carom_cluster_state *c, const carom_cluster_touch *l) {
  const carom_cluster_tip *tip = &c->tip;
  const carom_cluster_contact_state *x = &c->contact[l->contact];
  if ((x->i != tip->ball && x->j != tip->ball) || !(l->P[0] > 0.0))
    return 0.0;
  double P[3];
  impulse_of(c, l, P);
  const double late = l->moment / l->P[0] - l->time,
               along =
                   late * c->ball[tip->ball].inverse_mass * cluster_dot(!c->in_space, P, tip->axis);
  return x->i == tip->ball ? along : -along;
}

void carom_cluster_find_places(carom_cluster_state *c) {
  changes sum;
  sort(c);
  begin(c, &sum);
  c->tip.delay = 0.0;
  for (int k = 0; k < c->touches; k++) {
    const carom_cluster_touch *l = &c->touch[k];
    double instant;
    if (l->contact < 0) {
      instant = carom_greater(l->time - carom_linear_lag(c->tip.T, c->tip.e), 0.0);
    } else {
      instant = instant_of(c, l, &sum);
      c->tip.delay += c->struck ? delay_of(c, l) : (double)0.0;
    }
    add(c, l, 1.0, instant, &sum);
  }
  for (int k = 0; k < c->balls; k++) {
    carom_cluster_ball *p = &c->ball[k];
    for (int n = 0; n < 3; n++)
      p->shift[n] = -sum.moment[k][n];
    /* one on the slate starts from there, and none from below it */
    p->shift[2] = p->flies ? carom_greater(p->shift[2], p->radius - p->r[2]) : (double)0.0;
  }
}

double carom_cluster_tip_lead(const carom_cluster_state *c) {
  const carom_cluster_tip *x = &c->tip;
  const carom_cluster_ball *b = &c->ball[x->ball];
  const double by_tip = x->impulse * b->inverse_mass, ahead = cluster_dot(false, b->v0, x->axis);
  const double share = ahead > 0.0 ? by_tip / (by_tip + ahead) : (double)1.0;
  const double t = c->duration - carom_linear_lag(x->T, x->e) * share;
  double place[3]; /* of the ball from where it starts on, against where it is */
  for (int k = 0; k < 3; k++)
    place[k] = b->shift[k] + t * b->v[k] - b->s[k];
  return x->travel - t * x->V - x->delay + cluster_dot(false, place, x->axis);
}

double carom_cluster_separation(const carom_cluster_state *c) {
  static const double overlap = 2e-3; /* of the largest impulse */
  if (c->struck || c->balls > CAROM_CLUSTER_IN_TURN)
    return 0.0;
  double most = 0.0;
  for (int k = 0; k < c->contacts; k++)
    most = carom_greater(most, c->contact[k].impulse);
  const double left = 1.0 - c->shared / (overlap * most);
  return left > 0.0 ? left * left : (double)0.0;
}
