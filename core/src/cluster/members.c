/* Which balls take part in a cluster. The contact that starts it lasts T and is delta deep,
 * cluster.h. From ball to ball, a neighbour takes part whose gap is below 2 delta + T max(0,
 * closing speed).
 *
 * In truth a ball takes part that is touched while a contact acts, and for a full hit that
 * border lies at a gap of 1.42 delta (core/tests/physics/cluster.c, border). The integrator finds
 * it by itself, so the reach has only to be larger: 1.6 and 3 instead of 2 give the same results, 1
 * cuts a step of 2e-4 of the speed. Members touch within the cluster if their gap is below 5 delta
 * + T max(0, closing speed). Positions stay, so a ball that came from farther would be seen where
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
static const double least_restitution = 0.2;

/* x^(1/5) for x >= 0, by the same operations everywhere: a fifth of the exponent, then Newton's
 * method. */
static double fifth_root(double x) {
  if (!(x > 1e-300))
    return 0.0;
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  bits = bits / 5 + 0x3326666666666666u; /* 4/5 of the bits of 1 */
  double y = 0.0;
  memcpy(&y, &bits, sizeof bits);
  for (int k = 0; k < 5; k++) {
    const double y2 = y * y;
    y = 0.2 * (4.0 * y + x / (y2 * y2));
  }
  return y;
}

double carom_cluster_compression(double K, double B, double v) {
  const double x = 1.25 * v * v / (K * B);
  return fifth_root(x * x);
}

static double pace_of(double K, double B) {
  return CAROM_HERTZ_DURATION * sqrt(1.25 / (K * B));
}

double carom_cluster_duration(double pace, double size) {
  return pace / sqrt(sqrt(size));
}

static double stiffness(const carom_cluster_ball *a, const carom_cluster_ball *b) {
  const double E = 1.0 / (1.0 / a->modulus + 1.0 / b->modulus);
  return 4.0 / 3.0 * E * sqrt(a->radius * b->radius / (a->radius + b->radius));
}

/* Two balls: from one to the other, how far apart, and how fast they close. */
typedef struct two_balls {
  double n[3], gap, closing;
} two_balls;

static two_balls pair_of(const carom_cluster_ball *a, const carom_cluster_ball *b) {
  two_balls two;
  double v[3];
  cluster_minus(false, b->r, a->r, two.n);
  cluster_minus(false, a->v, b->v, v);
  const double size = sqrt(cluster_dot(false, two.n, two.n));
  for (int k = 0; k < 3; k++)
    two.n[k] /= size;
  two.gap = size - a->radius - b->radius;
  two.closing = cluster_dot(false, v, two.n);
  return two;
}

/* The fastest of the pairs that touch and close at `slow` or faster; false where there is none. */
static bool fastest_pair(const carom_cluster_state *c, int pair[2]) {
  double most = 0.0;
  for (int i = 0; i < c->balls; i++)
    for (int j = i + 1; j < c->balls; j++) {
      const two_balls two = pair_of(&c->ball[i], &c->ball[j]);
      if (two.gap >= CAROM_TOUCHING || two.closing < c->slow || two.closing <= most)
        continue;
      most = two.closing;
      pair[0] = i;
      pair[1] = j;
    }
  return most > 0.0;
}

/* delta and T of the contact that starts a cluster. */
typedef struct first_contact {
  double delta, T;
} first_contact;

/* Whether the gap of two balls is below so many delta, and what they close in T. */
static bool reaches(const first_contact *first, double deltas, const two_balls *two) {
  const double closing = two->closing > 0.0 ? two->closing : 0.0;
  return two->gap < deltas * first->delta + first->T * closing;
}

/* delta and T of a contact that closes at v. */
static first_contact first_of(const carom_cluster_ball *a, const carom_cluster_ball *b, double v) {
  const double K = stiffness(a, b), B = a->inverse_mass + b->inverse_mass;
  const double delta = carom_cluster_compression(K, B, v);
  return (first_contact){delta, carom_cluster_duration(pace_of(K, B), delta)};
}

/* Follows the graph of near neighbours from `found` balls of the queue, and marks those that it
 * reaches, breadth first: each ball that is found is asked for its own neighbours. */
static void follow(const carom_cluster_state *c, const first_contact *first,
                   int queue[CAROM_CLUSTER_BALLS], int found, bool in[CAROM_CLUSTER_BALLS]) {
  for (int k = 0; k < found; k++)
    in[queue[k]] = true;
  for (int k = 0; k < found; k++)
    for (int j = 0; j < c->balls; j++) {
      if (in[j])
        continue;
      const two_balls two = pair_of(&c->ball[queue[k]], &c->ball[j]);
      if (reaches(first, reach, &two)) {
        in[j] = true;
        queue[found++] = j;
      }
    }
  CAROM_PROMISE(found <= c->balls);
}

static double height_of(const carom_cluster_ball *p) {
  return p->flies ? p->r[2] - p->radius : (double)0.0;
}

static void make_contact(carom_cluster_state *c, int i, int j, const two_balls *two,
                         carom_cluster_contact_state *x) {
  carom_cluster_ball *a = &c->ball[i], *b = &c->ball[j];
  const double e = 0.5 * (a->restitution + b->restitution);
  CAROM_PROMISE(i < j && j < c->balls);
  memset(x, 0, sizeof *x);
  x->p = a;
  x->q = b;
  x->i = (int8_t)i;
  x->j = (int8_t)j;
  x->touched = two->gap < CAROM_TOUCHING;
  x->offset = x->touched ? 0.0 : -two->gap;
  memcpy(x->n, two->n, sizeof x->n);
  x->K = stiffness(a, b);
  x->e = e > least_restitution ? e : least_restitution;
  /* unloading has K/e^3 over e^2 of the overlap, and so lasts e times as long as loading */
  const double pace = x->e * pace_of(x->K, a->inverse_mass + b->inverse_mass);
  x->quick = 1.0 / (pace * pace * (pace * pace));
  x->time = -1.0;
  const double height = carom_greater(height_of(a), height_of(b));
  x->tilted = x->freedom = carom_freedom_of_balls(height, two->n[2]);
}

/* The contacts of all balls that are nearer than so many delta, and what they close; -1 where there
 * is no room for them. */
static int list_contacts(carom_cluster_state *c, const first_contact *first, double deltas) {
  int count = 0;
  for (int i = 0; i < c->balls; i++)
    for (int j = i + 1; j < c->balls; j++) {
      const two_balls two = pair_of(&c->ball[i], &c->ball[j]);
      if (two.gap >= CAROM_TOUCHING && !reaches(first, deltas, &two))
        continue;
      if (count == CAROM_CLUSTER_CONTACTS)
        return -1;
      make_contact(c, i, j, &two, &c->contact[count++]);
    }
  return count;
}

/* Keeps the members, in the caller's order, and lists their contacts. */
static int keep(carom_cluster_state *c, const first_contact *first,
                const bool in[CAROM_CLUSTER_BALLS]) {
  int reached = 0;
  for (int k = 0; k < c->balls; k++)
    if (in[k])
      c->ball[reached++] = c->ball[k];
  c->balls = reached;
  c->in_space = false;
  for (int k = 0; k < reached; k++)
    c->in_space |= c->ball[k].flies || c->ball[k].radius != c->ball[0].radius;
  /* small balls around a large one may have more neighbours than there is room for: then only
   * the nearest */
  int count = -1;
  for (double limit = far; count < 0 && limit > 1e-3; limit *= 0.5)
    count = list_contacts(c, first, limit);
  c->contacts = count > 0 ? count : 0;
  return count;
}

int carom_cluster_members(carom_cluster_state *c, int first, int second) {
  bool in[CAROM_CLUSTER_BALLS] = {false};
  int pair[CAROM_CLUSTER_BALLS] = {first, second};
  c->contacts = 0;
  if (first < 0 && !fastest_pair(c, pair))
    return 0;
  const carom_cluster_ball *a = &c->ball[pair[0]], *b = &c->ball[pair[1]];
  const double closing = pair_of(a, b).closing;
  if (closing < c->slow)
    return 0;
  const first_contact starts = first_of(a, b, closing);
  follow(c, &starts, pair, 2, in);
  return keep(c, &starts, in);
}

int carom_cluster_members_of_tip(carom_cluster_state *c, double most) {
  bool in[CAROM_CLUSTER_BALLS] = {false};
  int queue[CAROM_CLUSTER_BALLS] = {c->tip.ball};
  const int struck = c->ball[c->tip.ball].index;
  /* as far as the ball gets in twice the duration of tip or slate, beside what a contact is deep */
  first_contact starts = first_of(&c->ball[c->tip.ball], &c->ball[c->tip.ball], most);
  starts.delta += most * carom_greater(c->tip.T, CAROM_SLATE_TIME);
  follow(c, &starts, queue, 1, in);
  const int count = keep(c, &starts, in);
  for (int k = 0; k < c->balls; k++)
    if (c->ball[k].index == struck)
      c->tip.ball = k;
  return count;
}
