/* Where balls start after a cluster.
 *
 * In a shot a contact takes no time: it gives its impulse where two things touch, and they continue
 * from there. A cluster hands on what such instants would have given. Each of its touches k has an
 * instant t_k, at which it would have been if those before it had given their impulses at once, at
 * theirs. With dv_l the change of velocity by touch l, v_0 the velocity before all, D_k how far the
 * two approached before they touched, and tau_k when they did,
 *
 *     (v_0 . n) t_k + sum over l of (dv_l . n) (t_k - t_l) = D_k,     0 <= t_k <= tau_k,
 *
 * solved in the order of touching. A ball then starts from
 *
 *     r' = r - sum over k of dv_k t_k,
 *
 *      place |                  _.-
 *            |              _.-'       r' + v' t, of a ball at rest before
 *          r +----------+.-'
 *            |      _.-'|
 *         r' +__.-'     |
 *            +----------+------------- tau
 *            0         t_k
 *
 * so that r' + v' t is where it would have been. Balls that touch from the start have D = 0 and do
 * not move; where a gap is so wide that its contact begins as the one before ends, r' + v' t_k is
 * the position of the second of two successive events. What slate and cloth give counts at t = 0,
 * as in the strike of a single ball.
 *
 * LIMIT. Behind many touches a ball may have to start deep in another one, with which it has no
 * touch. All shifts of a cluster are then reduced by one factor, so that no two balls start nearer
 * than 0.956 of the sum of their radii: 2.5 mm deep in pool. The factor is a convention. Most
 * clusters leave 0.1 mm or less.
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
 * For a ball alone the lead is V_0 L.
 *
 * NOSE. A ball that touches a nose for a time tau_c meanwhile, and moves by s_c in it, is where a
 * ball alone would be, whose cushion takes no time: it starts from r + s - s_c - t_m v', but not
 * from behind the nose, with t_m = tau_e - tau_c. The tip is against it as it is at tau_e. */
#include "cluster/cluster.h"
#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "platform/promise.h"
#include "platform/ranges.h"

#include <math.h>

int carom_cluster_begin_touch(carom_cluster_state *cluster, int contact_index, int last,
                              double time, double approach) {
  if (last >= 0 && cluster->repeated == CAROM_CLUSTER_REPEATED)
    return last;
  cluster->repeated += last >= 0;
  CAROM_PROMISE(cluster->touches < CAROM_CLUSTER_TOUCHES);
  cluster->touch[cluster->touches] = (carom_cluster_touch){
      contact_index, time, carom_greater(approach, 0.0), {0.0, 0.0, 0.0}, 0.0};
  return cluster->touches++;
}

/* Whether a touch goes before another one: the earlier first; of touches of balls at one time the
 * one with the larger impulse. */
static bool is_before(const carom_cluster_state *cluster, const carom_cluster_touch *touch,
                      const carom_cluster_touch *partner) {
  const double later = partner->time - touch->time;
  if (fabs(later) > CAROM_SIMULTANEOUS_TOUCHES * cluster->duration || touch->contact < 0 ||
      partner->contact < 0)
    return later > 0.0;
  return touch->P[0] > (1.0 + CAROM_SIMULTANEOUS_TOUCHES) * partner->P[0];
}

/* Touches in their order, and those that are alike in the order in which they were noted. */
static void sort(carom_cluster_state *cluster) {
  for (int index = 1; index < cluster->touches; index++) {
    const carom_cluster_touch touch = cluster->touch[index];
    int place = index;
    for (; place > 0 && is_before(cluster, &touch, &cluster->touch[place - 1]); place--)
      cluster->touch[place] = cluster->touch[place - 1];
    cluster->touch[place] = touch;
  }
}

/* The impulse of a touch on the first of its balls. */
static void impulse_of(const carom_cluster_state *cluster, const carom_cluster_touch *touch,
                       double P[3]) {
  const bool flat = !cluster->in_space;
  for (int axis = 0; axis < 3; axis++)
    P[axis] = touch->contact < 0 ? touch->P[axis] : 0.0;
  if (touch->contact < 0)
    return;
  const carom_cluster_contact_state *contact = &cluster->contact[touch->contact];
  double tangent[3], third[3];
  cluster_across(flat, contact->n, tangent, third);
  cluster_add(flat, P, -touch->P[0], contact->n);
  cluster_add(flat, P, touch->P[1], tangent);
  if (!flat)
    cluster_add(false, P, touch->P[2], third);
}

/* The changes of velocity so far, and of the sums of them with their instants. */
typedef struct changes {
  double v[CAROM_CLUSTER_BALLS][3], moment[CAROM_CLUSTER_BALLS][3];
} changes;

/* Adds a touch at an instant, or takes it away. */
static void add(const carom_cluster_state *cluster, const carom_cluster_touch *touch, double sign,
                double instant, changes *sum) {
  const bool flat = !cluster->in_space;
  int balls[2] = {cluster->tip.ball, -1};
  if (touch->contact >= 0) {
    balls[0] = cluster->contact[touch->contact].i;
    balls[1] = cluster->contact[touch->contact].j;
  }

  /* P on the first ball, or on the one that the tip strikes, and -P on the second one */
  double P[3];
  impulse_of(cluster, touch, P);
  for (int side = 0; side < 2 && balls[side] >= 0; side++) {
    const double share = side == 0 ? sign : -sign,
                 over_mass = share * cluster->ball[balls[side]].inverse_mass;
    cluster_add(flat, sum->v[balls[side]], over_mass, P);
    cluster_add(flat, sum->moment[balls[side]], over_mass * instant, P);
  }
}

/* What slate and cloth give counts from the start: all that changes, less what touches give. */
static void begin(const carom_cluster_state *cluster, changes *sum) {
  for (int index = 0; index < cluster->balls; index++)
    for (int axis = 0; axis < 3; axis++) {
      sum->moment[index][axis] = 0.0;
      sum->v[index][axis] = cluster->ball[index].v[axis] - cluster->ball[index].v0[axis];
    }
  for (int index = 0; index < cluster->touches; index++)
    add(cluster, &cluster->touch[index], -1.0, 0.0, sum);
}

/* The instant t_k of a touch of two balls: where the way that is left of D_k, at the velocities
 * after the touches before, ends. */
static double instant_of(const carom_cluster_state *cluster, const carom_cluster_touch *touch,
                         const changes *sum) {
  const carom_cluster_contact_state *contact = &cluster->contact[touch->contact];
  const bool flat = !cluster->in_space;
  double gained[3], relative[3], moment[3];
  cluster_minus(flat, sum->v[contact->i], sum->v[contact->j], gained);
  cluster_minus(flat, contact->ball_i->v0, contact->ball_j->v0, relative);
  cluster_minus(flat, sum->moment[contact->i], sum->moment[contact->j], moment);
  const double rate =
                   cluster_dot(flat, relative, contact->n) + cluster_dot(flat, gained, contact->n),
               way = touch->approach + cluster_dot(flat, moment, contact->n);
  if (!(way > 0.0))
    return 0.0;
  return way < rate * touch->time ? way / rate : touch->time;
}

/* How far the struck ball is behind as a touch of it lasts. */
static double delay_of(const carom_cluster_state *cluster, const carom_cluster_touch *touch) {
  const carom_cluster_tip *tip = &cluster->tip;
  const carom_cluster_contact_state *contact = &cluster->contact[touch->contact];
  if ((contact->i != tip->ball && contact->j != tip->ball) || !(touch->P[0] > 0.0))
    return 0.0;
  double P[3];
  impulse_of(cluster, touch, P);
  const double late = touch->moment / touch->P[0] - touch->time,
               along = late * cluster->ball[tip->ball].inverse_mass *
                       cluster_dot(!cluster->in_space, P, tip->axis);
  return contact->i == tip->ball ? along : -along;
}

/* The share of the shifts with which two balls start no nearer than the limit: where
 * |d + share D| = limit, with d from one to the other and D its change by all of the shifts. */
static double share_to_limit(const carom_cluster_ball *ball, const carom_cluster_ball *partner) {
  static const double nearest = 0.956; /* of the sum of radii */
  double apart[3], change[3], end[3];
  cluster_minus(false, partner->r, ball->r, apart);
  cluster_minus(false, partner->shift, ball->shift, change);
  for (int axis = 0; axis < 3; axis++)
    end[axis] = apart[axis] + change[axis];
  const double limit = nearest * (ball->radius + partner->radius), limit2 = limit * limit;
  const double C = cluster_dot(false, apart, apart) - limit2;
  if (!(cluster_dot(false, end, end) < limit2 && C > 0.0))
    return 1.0;

  /* A share^2 + 2 B share + C = 0, of which the first zero is between 0 and 1 */
  const double A = cluster_dot(false, change, change), B = cluster_dot(false, apart, change);
  return C / (sqrt(carom_greater(B * B - A * C, 0.0)) - B);
}

void carom_cluster_limit_shifts(carom_cluster_state *cluster) {
  double share = 1.0;
  for (int index = 0; index < cluster->balls; index++)
    for (int partner = index + 1; partner < cluster->balls; partner++)
      share = carom_lesser(share, share_to_limit(&cluster->ball[index], &cluster->ball[partner]));
  if (!(share < 1.0))
    return;
  for (int index = 0; index < cluster->balls; index++)
    for (int axis = 0; axis < 3; axis++)
      cluster->ball[index].shift[axis] *= share;
}

/* The shift of a ball that has touched a nose. */
static void place_past_nose(carom_cluster_state *cluster) {
  const carom_cluster_nose *nose = &cluster->nose;
  carom_cluster_ball *ball = &cluster->ball[cluster->tip.ball];
  const double late = cluster->duration - nose->lasted;
  for (int axis = 0; axis < 3; axis++)
    ball->shift[axis] = ball->s[axis] - nose->moved[axis] - late * ball->v[axis];
  ball->shift[2] = ball->flies ? carom_greater(ball->shift[2], ball->radius - ball->r[2]) : 0.0;
  const double gap = nose->first_gap + carom_space_dot(nose->normal, ball->shift);
  if (gap < CAROM_TOUCHING) /* not behind the nose */
    cluster_add(false, ball->shift, CAROM_TOUCHING - gap, nose->normal);
}

void carom_cluster_find_places(carom_cluster_state *cluster) {
  changes sum;
  sort(cluster);
  begin(cluster, &sum);
  cluster->tip.delay = 0.0;
  for (int index = 0; index < cluster->touches; index++) {
    const carom_cluster_touch *touch = &cluster->touch[index];
    double instant;
    if (touch->contact < 0) {
      instant = carom_greater(
          touch->time - carom_linear_lag(cluster->tip.duration, cluster->tip.restitution), 0.0);
    } else {
      instant = instant_of(cluster, touch, &sum);
      cluster->tip.delay += cluster->struck ? delay_of(cluster, touch) : 0.0;
    }
    add(cluster, touch, 1.0, instant, &sum);
  }
  for (int index = 0; index < cluster->balls; index++) {
    carom_cluster_ball *ball = &cluster->ball[index];
    for (int axis = 0; axis < 3; axis++)
      ball->shift[axis] = -sum.moment[index][axis];
    /* one on the slate starts from there, and none from below it */
    ball->shift[2] = ball->flies ? carom_greater(ball->shift[2], ball->radius - ball->r[2]) : 0.0;
  }
  if (cluster->nose_near && cluster->nose.lasted > 0.0)
    place_past_nose(cluster);
  carom_cluster_limit_shifts(cluster);
}

double carom_cluster_tip_lead(const carom_cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  const carom_cluster_ball *ball = &cluster->ball[tip->ball];

  /* t_m: less by the lag of the centroid, as far as the ball moves by the push */
  const double by_tip = tip->impulse * ball->inverse_mass,
               ahead = cluster_dot(false, ball->v0, tip->axis);
  const double share = ahead > 0.0 ? by_tip / (by_tip + ahead) : 1.0;
  const double late = cluster->duration - carom_linear_lag(tip->duration, tip->restitution) * share;
  double place[3]; /* of the ball from where it starts on, against where it is */
  for (int axis = 0; axis < 3; axis++)
    place[axis] = ball->shift[axis] + late * ball->v[axis] - ball->s[axis];
  return tip->travel - late * tip->V - tip->delay + cluster_dot(false, place, tip->axis);
}

carom_next_tip carom_cluster_next_tip(const carom_cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  const carom_cluster_ball *ball = &cluster->ball[tip->ball];
  double last = tip->last;
  if (cluster->nose_near)
    last = carom_greater(last, cluster->nose.lasted);
  const double late = cluster->duration - last;
  carom_next_tip out;
  out.travel = tip->travel - late * tip->V;
  out.arm = tip->arm_way - late * carom_greater(tip->V, tip->slowest);
  for (int axis = 0; axis < 3; axis++)
    out.moved[axis] = ball->shift[axis] + late * ball->v[axis] - ball->s[axis];
  return out;
}

double carom_cluster_separation(const carom_cluster_state *cluster) {
  static const double overlap = 2e-3; /* a 500th of the largest impulse */
  if (cluster->struck || cluster->balls > CAROM_CLUSTER_IN_TURN)
    return 0.0;
  double most = 0.0;
  for (int index = 0; index < cluster->contacts; index++)
    most = carom_greater(most, cluster->contact[index].impulse);
  const double left = 1.0 - cluster->shared / (overlap * most);
  return left > 0.0 ? left * left : 0.0;
}
