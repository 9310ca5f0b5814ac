/* Which balls take part in a cluster. The contact that starts it lasts T and is delta deep,
 * cluster.h. From ball to ball, a neighbour takes part whose gap is below 2 delta + T max(0,
 * closing speed).
 *
 * In truth a ball takes part that is touched while a contact acts, and for a full hit that border
 * is at a gap of 1.42 delta (core/tests/physics/cluster.c, border). The integrator finds it by
 * itself, so the reach has only to be larger: 1.6 and 3 instead of 2 give the same results, 1 cuts
 * a step of 2e-4 of the speed. Members touch within the cluster if their gap is below 5 delta + T
 * max(0, closing speed). Positions do not change, so a ball from farther away would be seen where
 * it is not. */
#include "carom_shot.h"
#include "cluster/cluster.h"
#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "platform/promise.h"
#include "platform/ranges.h"

#include <math.h>
#include <string.h>

static const double reach = 2.0; /* of delta */
static const double far = 5.0;   /* of delta: the reach, and as far as a ball gets in T; those
                                        that are farther apart meet later */
static const double least_restitution = 0.2; /* below it unloading would take too short steps */
static const double least_reach = 1e-3;      /* of delta: where even this has too many contacts */

/* The factor of Hertz's contact: delta^2.5 = 5/4 v^2/(K B). */
#define CAROM_HERTZ_DEPTH 1.25
/* Smaller numbers count as 0: their fifth roots are below any contact's. */
#define CAROM_LEAST_POWER 1e-300

/* square^(1/5) for square >= 0, by the same operations everywhere: a fifth of the exponent, then
 * Newton's method. */
static double fifth_root(double square) {
  if (!(square > CAROM_LEAST_POWER))
    return 0.0;

  /* a first guess, good to some percent: the exponent and the mantissa by 5 */
  uint64_t bits;
  memcpy(&bits, &square, sizeof bits);
  bits = bits / 5 + 0x3326666666666666u; /* 4/5 of the bits of 1 */
  double root = 0.0;
  memcpy(&root, &bits, sizeof bits);

  /* Newton's method for root^5 = square */
  for (int iteration = 0; iteration < 5; iteration++) {
    const double root2 = root * root;
    root = (1.0 / 5.0) * (4.0 * root + square / (root2 * root2));
  }
  return root;
}

/* delta = (5 v^2/(4 K B))^0.4, by the fifth root of the square. */
double carom_cluster_compression(double stiffness, double mobility, double closing) {
  const double ratio = CAROM_HERTZ_DEPTH * closing * closing / (stiffness * mobility);
  return fifth_root(ratio * ratio);
}

/* T sqrt(delta) of a contact without losses, which does not depend on how fast it closes: T = 2.943
 * delta/v, and v = delta^1.25 sqrt(4 K B/5). */
static double pace_of(double stiffness, double mobility) {
  return CAROM_HERTZ_DURATION * sqrt(CAROM_HERTZ_DEPTH / (stiffness * mobility));
}

double carom_cluster_duration(double pace, double size) {
  return pace / sqrt(sqrt(size));
}

/* K of two balls. */
static double stiffness(const carom_cluster_ball *ball_i, const carom_cluster_ball *ball_j) {
  const double modulus = 1.0 / (1.0 / ball_i->modulus + 1.0 / ball_j->modulus);
  return 4.0 / 3.0 * modulus *
         sqrt(ball_i->radius * ball_j->radius / (ball_i->radius + ball_j->radius));
}

/* Two balls: from one to the other, how far apart, and how fast they close. */
typedef struct two_balls {
  double n[3], gap, closing;
} two_balls;

static two_balls pair_of(const carom_cluster_ball *ball_i, const carom_cluster_ball *ball_j) {
  two_balls two;
  double relative[3];
  cluster_minus(false, ball_j->r, ball_i->r, two.n);
  cluster_minus(false, ball_i->v, ball_j->v, relative);
  const double size = sqrt(cluster_dot(false, two.n, two.n));
  for (int axis = 0; axis < 3; axis++)
    two.n[axis] /= size;
  two.gap = size - ball_i->radius - ball_j->radius;
  two.closing = cluster_dot(false, relative, two.n);
  return two;
}

/* The fastest of the pairs that touch and close at `slow` or faster; false where there is none. */
static bool fastest_pair(const carom_cluster_state *cluster, int pair[2]) {
  double most = 0.0;
  for (int i = 0; i < cluster->balls; i++)
    for (int j = i + 1; j < cluster->balls; j++) {
      const two_balls two = pair_of(&cluster->ball[i], &cluster->ball[j]);
      if (two.gap >= CAROM_TOUCHING || two.closing < cluster->slow || two.closing <= most)
        continue;
      most = two.closing;
      pair[0] = i;
      pair[1] = j;
    }
  return most > 0.0;
}

/* delta and T of the contact that starts a cluster. */
typedef struct first_contact {
  double delta, duration;
} first_contact;

/* Whether the gap of two balls is below so many delta, and what they close in T. */
static bool reaches(const first_contact *first, double deltas, const two_balls *two) {
  const double closing = two->closing > 0.0 ? two->closing : 0.0;
  return two->gap < deltas * first->delta + first->duration * closing;
}

/* delta and T of a contact by its closing speed. */
static first_contact first_of(const carom_cluster_ball *ball_i, const carom_cluster_ball *ball_j,
                              double closing) {
  const double stiff = stiffness(ball_i, ball_j),
               mobility = ball_i->inverse_mass + ball_j->inverse_mass;
  const double delta = carom_cluster_compression(stiff, mobility, closing);
  return (first_contact){delta, carom_cluster_duration(pace_of(stiff, mobility), delta)};
}

/* Follows the graph of near neighbours from `found` balls of the queue, and marks those that it
 * reaches, breadth first: each ball that is found is asked for its own neighbours. */
static void follow(const carom_cluster_state *cluster, const first_contact *first,
                   int queue[CAROM_CLUSTER_BALLS], int found, bool in[CAROM_CLUSTER_BALLS]) {
  for (int index = 0; index < found; index++)
    in[queue[index]] = true;
  for (int next = 0; next < found; next++)
    for (int neighbor = 0; neighbor < cluster->balls; neighbor++) {
      if (in[neighbor])
        continue;
      const two_balls two = pair_of(&cluster->ball[queue[next]], &cluster->ball[neighbor]);
      if (reaches(first, reach, &two)) {
        in[neighbor] = true;
        queue[found++] = neighbor;
      }
    }
  CAROM_PROMISE(found <= cluster->balls);
}

/* Above the cloth, m. */
static double height_of(const carom_cluster_ball *ball) {
  return ball->flies ? ball->r[2] - ball->radius : 0.0;
}

/* Begins contact[] of balls i < j. */
static void make_contact(carom_cluster_state *cluster, int i, int j, const two_balls *two,
                         carom_cluster_contact_state *contact) {
  carom_cluster_ball *ball_i = &cluster->ball[i], *ball_j = &cluster->ball[j];
  const double restitution = 0.5 * (ball_i->restitution + ball_j->restitution);
  CAROM_PROMISE(i < j && j < cluster->balls);
  memset(contact, 0, sizeof *contact);

  /* its balls, and where they are */
  contact->ball_i = ball_i;
  contact->ball_j = ball_j;
  contact->i = (int8_t)i;
  contact->j = (int8_t)j;
  contact->touched = two->gap < CAROM_TOUCHING;
  contact->offset = contact->touched ? 0.0 : -two->gap;
  memcpy(contact->n, two->n, sizeof contact->n);

  /* its law */
  contact->stiffness = stiffness(ball_i, ball_j);
  contact->restitution = restitution > least_restitution ? restitution : least_restitution;
  /* unloading has K/e^3 over e^2 of the overlap, and so lasts e times as long as loading */
  const double pace = contact->restitution *
                      pace_of(contact->stiffness, ball_i->inverse_mass + ball_j->inverse_mass);
  contact->quick = 1.0 / (pace * pace * (pace * pace));
  contact->time = -1.0; /* not touched yet */
  const double height = carom_greater(height_of(ball_i), height_of(ball_j));
  contact->tilted = contact->freedom = carom_freedom_of_balls(height, two->n[2]);
}

/* The contacts of all balls that are nearer than so many delta, and what they close; -1 where there
 * is no room for them. */
static int list_contacts(carom_cluster_state *cluster, const first_contact *first, double deltas) {
  int count = 0;
  for (int i = 0; i < cluster->balls; i++)
    for (int j = i + 1; j < cluster->balls; j++) {
      const two_balls two = pair_of(&cluster->ball[i], &cluster->ball[j]);
      if (two.gap >= CAROM_TOUCHING && !reaches(first, deltas, &two))
        continue;
      if (count == CAROM_CLUSTER_CONTACTS)
        return -1;
      make_contact(cluster, i, j, &two, &cluster->contact[count++]);
    }
  return count;
}

/* Keeps the members, in the caller's order, and lists their contacts. */
static int keep(carom_cluster_state *cluster, const first_contact *first,
                const bool in[CAROM_CLUSTER_BALLS]) {
  int reached = 0;
  for (int index = 0; index < cluster->balls; index++)
    if (in[index])
      cluster->ball[reached++] = cluster->ball[index];
  cluster->balls = reached;
  cluster->in_space = false;
  for (int index = 0; index < reached; index++)
    cluster->in_space |=
        cluster->ball[index].flies || cluster->ball[index].radius != cluster->ball[0].radius;
  /* small balls around a large one may have more neighbours than there is room for: then only
   * the nearest */
  int count = -1;
  for (double limit = far; count < 0 && limit > least_reach; limit *= 0.5)
    count = list_contacts(cluster, first, limit);
  cluster->contacts = count > 0 ? count : 0;
  return count;
}

int carom_cluster_members(carom_cluster_state *cluster, int first, int second) {
  bool in[CAROM_CLUSTER_BALLS] = {false};
  int pair[CAROM_CLUSTER_BALLS] = {first, second};
  cluster->contacts = 0;
  if (first < 0 && !fastest_pair(cluster, pair))
    return 0;
  const carom_cluster_ball *ball_i = &cluster->ball[pair[0]], *ball_j = &cluster->ball[pair[1]];
  const double closing = pair_of(ball_i, ball_j).closing;
  if (closing < cluster->slow)
    return 0;
  const first_contact starts = first_of(ball_i, ball_j, closing);
  follow(cluster, &starts, pair, 2, in);
  return keep(cluster, &starts, in);
}

int carom_cluster_members_of_tip(carom_cluster_state *cluster, double most) {
  bool in[CAROM_CLUSTER_BALLS] = {false};
  int queue[CAROM_CLUSTER_BALLS] = {cluster->tip.ball};
  const int struck = cluster->ball[cluster->tip.ball].index;
  /* as far as the ball gets in twice the duration of tip, slate or nose, next to what a contact is
   * deep */
  first_contact starts =
      first_of(&cluster->ball[cluster->tip.ball], &cluster->ball[cluster->tip.ball], most);
  double lasts = carom_greater(cluster->tip.duration, CAROM_SLATE_TIME);
  if (cluster->nose_near)
    lasts = carom_greater(lasts, CAROM_NOSE_TIME);
  starts.delta += most * lasts;
  follow(cluster, &starts, queue, 1, in);
  const int count = keep(cluster, &starts, in);
  for (int index = 0; index < cluster->balls; index++)
    if (cluster->ball[index].index == struck)
      cluster->tip.ball = index;
  return count;
}
