/* The integrator of a cluster, cluster.h: leapfrog in tau, with the friction of a step by fixed
 * iterations. A step of h:
 *
 *          0            h/2             h
 *          |-------------|--------------|     tau
 *       v, u0        d, F, J = h F       v', u
 *          s += h/2 v         s += h/2 v'
 *
 *     s += h/2 v;  d and F there, so J = h F for every contact that acts;  v by J
 *     friction, `iterations` times, for all contacts from the same velocities (Jacobi), so that
 *     the numbering does not count:
 *       a contact with |u0| <= 7 B mu J may stick:
 *           f := the projection of f - u/(7 B) on |f| <= mu J, u at the end of the step
 *       another slips:
 *           f := -mu J (u0 + u)/|u0 + u|, the mean slip, of order 2 and dissipative
 *     after each the cloth, which is isotropic: g in closed form by the same two rules, with 2/7
 *     of the mass
 *     s += h/2 v;  where v_n changes its sign, d_max is the vertex of the parabola of d
 *
 * u0 is the slip as the step begins, B = 1/m_i + 1/m_j; an impulse f takes 7/2 B f from the
 * slip, of which half is taken at a time since neighbours act too. f begins with that of the
 * step before, scaled with J. mu is linear in the growth of U within the step.
 *
 * h is e T/steps of the contacts that act, T the duration of each for its compression, in a norm
 * that is nearly that of the shortest and in which contacts that are alike count alike:
 *
 *     h = (sum (steps/(e T))^32)^(-1/32)
 *
 * So which of equal contacts comes first does not count, and h has the derivatives of all. A step
 * in which others touch is taken again, as short as these require. Where nothing acts, contacts
 * that have touched and close again at `slow` or faster touch at once, as positions stay. It ends
 * where there are none: contacts that never touched are met later, as other events.
 *
 * Without friction the order is 2; contacts that stick make it 1 (docs/understanding/clusters.md
 * has the errors). The energy rises by 3e-4 at most where e = 1 and nothing rubs. What it has risen
 * is then taken from the motion about the centre of mass, of a strike first from the parting of tip
 * and ball, so momentum is kept.
 */
#include "cluster/cluster.h"
#include "cluster/closing.h"
#include "cluster/hertz.h"
#include "cluster/vectors.h"
#include "friction/laws.h"
#include "platform/promise.h"
#include "platform/ranges.h"
#include "platform/sphere.h"

#include <math.h>

typedef carom_cluster_state cluster_state;
typedef carom_cluster_contact_state contact_state;
typedef carom_cluster_ball ball_state;

enum { ITERATIONS = 2 };

/* The contacts that are pressed in a step, the ones that act, and their balls. */
typedef struct pushes {
  int pressed, contacts, balls; /* how many; their positions in contact[] and ball[]: */
  uint8_t press[CAROM_CLUSTER_CONTACTS], push[CAROM_CLUSTER_CONTACTS], pushed[CAROM_CLUSTER_BALLS];
} pushes;

/* m: overlaps below it are none; their forces could underflow */
static const double open_overlap = 1e-12;

/* (2 . 2)^2, for squares of twice a mean: a slip of a mean below twice what friction takes may turn
 * back within the step. */
#define CAROM_MAY_TURN_BACK 16.0
/* Rounding, by which a little more is taken from the energy than it has risen: of speeds, and of an
 * impulse that is a difference of close numbers. */
#define CAROM_ROUNDED_SPEED 1e-15
#define CAROM_ROUNDED_IMPULSE 1e-12

/* ---- A contact's geometry and motion */

/* All continue along their velocities: s of a time. */
static inline void move(bool flat, cluster_state *cluster, double time) {
  for (int index = 0; index < cluster->balls; index++)
    cluster_add(flat, cluster->ball[index].s, time, cluster->ball[index].v);
}

/* B */
static inline double mobility(const contact_state *contact) {
  return contact->ball_i->inverse_mass + contact->ball_j->inverse_mass;
}

/* d' */
static inline double closing_of(bool flat, const contact_state *contact) {
  double relative[3];
  cluster_minus(flat, contact->ball_i->v, contact->ball_j->v, relative);
  return cluster_dot(flat, relative, contact->n);
}

/* d */
static inline double overlap_of(bool flat, const contact_state *contact) {
  double moved[3];
  cluster_minus(flat, contact->ball_i->s, contact->ball_j->s, moved);
  return contact->offset + cluster_dot(flat, moved, contact->n);
}

/* u, along t and t x n. The second has the share phi of the velocity, and on the cloth none. */
static inline void slip_of(bool flat, const contact_state *contact, double slip[2]) {
  const ball_state *ball_i = contact->ball_i, *ball_j = contact->ball_j;
  double relative[3], tangent[3], third[3];

  /* v_i - v_j and W_i + W_j, of which (W_i + W_j) x n has -(t x n) . W along t, and t . W across */
  cluster_minus(flat, ball_i->v, ball_j->v, relative);
  const double spin[3] = {ball_i->W[0] + ball_j->W[0], ball_i->W[1] + ball_j->W[1],
                          ball_i->W[2] + ball_j->W[2]};
  cluster_across(flat, contact->n, tangent, third);
  if (flat) {
    slip[0] = carom_plane_dot(relative, tangent) - spin[2];
    slip[1] = carom_plane_dot(spin, tangent);
  } else {
    slip[0] = cluster_dot(false, relative, tangent) - cluster_dot(false, spin, third);
    slip[1] =
        contact->freedom * cluster_dot(false, relative, third) + cluster_dot(false, spin, tangent);
  }
}

/* Friction's impulse f on i, and -f on j, along t and t x n. */
static inline void rub(bool flat, const contact_state *contact, const double impulse[2]) {
  ball_state *ball_i = contact->ball_i, *ball_j = contact->ball_j;
  /* the changes of velocity of both, each along both directions */
  const double tangent_i = impulse[0] * ball_i->inverse_mass,
               third_i = impulse[1] * ball_i->inverse_mass;
  const double tangent_j = impulse[0] * ball_j->inverse_mass,
               third_j = impulse[1] * ball_j->inverse_mass;
  double tangent[3], third[3];
  cluster_across(flat, contact->n, tangent, third);

  /* along t, and the turn about t by what goes along t x n, alike for both */
  cluster_add(flat, ball_i->v, tangent_i, tangent);
  cluster_add(flat, ball_j->v, -tangent_j, tangent);
  cluster_add(flat, ball_i->W, CAROM_SPHERE_TURN * third_i, tangent);
  cluster_add(flat, ball_j->W, CAROM_SPHERE_TURN * third_j, tangent);

  /* along t x n, which the cloth holds by the share 1 - phi, and the turn about t x n */
  if (flat) {
    ball_i->W[2] -= CAROM_SPHERE_TURN * tangent_i;
    ball_j->W[2] -= CAROM_SPHERE_TURN * tangent_j;
    ball_i->load -= impulse[1];
    ball_j->load += impulse[1];
  } else {
    const double held = (1.0 - contact->freedom) * impulse[1];
    cluster_add(false, ball_i->v, contact->freedom * third_i, third);
    cluster_add(false, ball_j->v, -contact->freedom * third_j, third);
    cluster_add(false, ball_i->W, -CAROM_SPHERE_TURN * tangent_i, third);
    cluster_add(false, ball_j->W, -CAROM_SPHERE_TURN * tangent_j, third);
    ball_i->load -= held;
    ball_j->load += held;
  }
}

/* Two balls that move past each other, apart by x and at the relative velocity v. With the sum R of
 * their radii as the distance, they touch where |x + v time|^2 = R^2, which is
 * A time^2 + 2 B time + C = 0, with the discriminant B^2 - A C. */
typedef struct passing {
  double apart[3], velocity[3];
  double distance, A, B, discriminant;
} passing;

static inline passing passing_of(bool flat, const contact_state *contact) {
  const ball_state *ball_i = contact->ball_i, *ball_j = contact->ball_j;
  passing pass;
  for (int axis = 0; axis < 3; axis++) {
    pass.apart[axis] = ball_j->r[axis] - ball_i->r[axis] + (ball_j->s[axis] - ball_i->s[axis]);
    pass.velocity[axis] = ball_j->v[axis] - ball_i->v[axis];
  }
  pass.distance = ball_i->radius + ball_j->radius + CAROM_TOUCHING;
  const double C = cluster_dot(flat, pass.apart, pass.apart) - pass.distance * pass.distance;
  pass.A = cluster_dot(flat, pass.velocity, pass.velocity);
  pass.B = cluster_dot(flat, pass.apart, pass.velocity);
  pass.discriminant = pass.B * pass.B - pass.A * C;
  return pass;
}

/* If two balls that were apart have met within the last half step, in which all moved by s: the
 * normal of the contact from then on, which is the normal at the touch, at most a step ago. */
static void touch(bool flat, contact_state *contact, double half) {
  const passing pass = passing_of(flat, contact);

  /* n at the touch, which is so long ago; balls that only graze are at their nearest then */
  const double discriminant = carom_greater(pass.discriminant, 0.0);
  const double back =
      pass.A > 0.0 ? carom_greater((-pass.B - sqrt(discriminant)) / pass.A, -2.0 * half) : 0.0;
  for (int axis = 0; axis < 3; axis++)
    contact->n[axis] = pass.apart[axis] + back * pass.velocity[axis];
  if (flat)
    contact->n[2] = 0.0;
  const double size = sqrt(cluster_dot(flat, contact->n, contact->n));
  for (int axis = 0; axis < 3; axis++)
    contact->n[axis] /= size;

  /* the offset with which the overlap is R less the distance along n, as s counts on */
  double moved[3];
  cluster_minus(flat, contact->ball_i->s, contact->ball_j->s, moved);
  contact->offset = pass.distance - cluster_dot(flat, pass.apart, contact->n) -
                    cluster_dot(flat, moved, contact->n);
}

/* Whether two balls that have not touched overlap, some time from now. */
static inline bool meet(bool flat, const contact_state *contact, double time) {
  const ball_state *ball_i = contact->ball_i, *ball_j = contact->ball_j;
  double square = 0.0;
  for (int axis = 0; axis < (flat ? 2 : 3); axis++) {
    const double apart = ball_j->r[axis] + ball_j->s[axis] + time * ball_j->v[axis] -
                         (ball_i->r[axis] + ball_i->s[axis] + time * ball_i->v[axis]);
    square += apart * apart;
  }
  const double distance = ball_i->radius + ball_j->radius + CAROM_TOUCHING;
  return square < distance * distance;
}

/* What a contact of a compression adds to the norm of steps, (1/(e T))^32 = quick^8 size^8; and the
 * step of a sum of these, its 32nd root. */
static inline double quickness(const contact_state *contact, double size) {
  const double pace = contact->quick * size, pace2 = pace * pace, pace4 = pace2 * pace2;
  return pace4 * pace4;
}
static inline double step_of(double norm, double steps) {
  return norm > 0.0 ? 1.0 / (steps * sqrt(sqrt(sqrt(sqrt(sqrt(norm)))))) : INFINITY;
}

/* ---- Forces */

/* The numbers of a contact's friction. */
static inline void law_of(const contact_state *contact, double law[3]) {
  for (int index = 0; index < 3; index++)
    law[index] = 0.5 * (contact->ball_i->law[index] + contact->ball_j->law[index]);
}

/* The contacts that are pressed at half a step: those that were, and open ones that have an
 * overlap, which touch within it and get their sizes and normals. Returns the longest step that
 * suits these and those that touch in the other half, infinite where there are none. */
static inline double find_pressed(bool flat, cluster_state *cluster, double step, pushes *pushed) {
  double norm = 0.0;
  pushed->pressed = 0;
  CAROM_PROMISE(!(step < 0.0));
  for (int index = 0; index < cluster->contacts; index++) {
    contact_state *contact = &cluster->contact[index];

    /* one that was pressed still is */
    if (contact->overlap_max > 0.0) {
      pushed->press[pushed->pressed++] = (uint8_t)index;
      continue;
    }

    /* one that touched as all began, and has parted without an impulse, touches as any other */
    if (contact->touched && contact->time < 0.0 && overlap_of(flat, contact) < -open_overlap &&
        !meet(flat, contact, 0.0))
      contact->touched = false;

    /* one that has never touched: whether it does within the step, and by now */
    const bool first = !contact->touched;
    if (first && !meet(flat, contact, 0.5 * step))
      continue;
    const bool meets = first && meet(flat, contact, 0.0);
    if (meets)
      touch(flat, contact, 0.5 * step);

    /* one that has touched is open since it parted: it has no overlap before it closes again */
    const double closing = closing_of(flat, contact);
    if (!first && closing <= 0.0)
      continue;
    const double overlap = overlap_of(flat, contact);
    if (overlap + 0.5 * step * closing <= open_overlap)
      continue;

    /* it is pressed by now, or will be at the end of the step: its size requires a step */
    if (overlap > open_overlap && (meets || !first))
      pushed->press[pushed->pressed++] = (uint8_t)index;
    contact->size = closing > 0.0
                        ? carom_cluster_compression(contact->stiffness, mobility(contact), closing)
                        : 0.0;
    norm += quickness(contact, contact->size);
  }
  return step_of(norm, cluster->steps);
}

/* The set of a contact of an overlap, where its force has reached 0. */
static inline void recover(contact_state *contact, double overlap) {
  contact->overlap_max = overlap > open_overlap
                             ? carom_set_left(contact->restitution, overlap, contact->overlap_max)
                             : 0.0;
}

/* A contact touches, of an overlap by now: it has since it was 0. */
static inline void begin_contact(bool flat, cluster_state *cluster, contact_state *contact,
                                 double overlap, double tau) {
  const double closing = closing_of(flat, contact);

  /* neither slip nor friction yet */
  double moved[3];
  cluster_minus(flat, contact->ball_i->s, contact->ball_j->s, moved);
  contact->greatest_slip = -1.0; /* less than any slip: the first one sets mu */
  contact->friction[0] = contact->friction[1] = 0.0;

  /* the instant, and how far the two have approached until then */
  const double time = carom_greater(tau - (closing > 0.0 ? overlap / closing : 0.0), 0.0);
  contact->touch = carom_cluster_begin_touch(cluster, (int)(contact - cluster->contact),
                                             contact->time < 0.0 ? -1 : contact->touch, time,
                                             cluster_dot(flat, moved, contact->n) - overlap);
  if (contact->time < 0.0)
    contact->time = time;
}

/* The pressed contacts that act, and their impulses. *norm becomes the norm over all that overlap.
 * Returns whether any does. */
static inline bool find_acting(bool flat, cluster_state *cluster, double step, double tau,
                               pushes *pushed, double *norm) {
  bool acts = false;
  *norm = 0.0;
  pushed->contacts = 0;
  for (int index = 0; index < pushed->pressed; index++) {
    contact_state *contact = &cluster->contact[pushed->press[index]];
    const double overlap = overlap_of(flat, contact);
    if (overlap <= open_overlap)
      continue;
    contact->touched = true;
    if (contact->overlap_max == 0.0)
      begin_contact(flat, cluster, contact, overlap, tau);

    /* its force, by the overlap at half a step */
    contact->overlap = overlap;
    contact->size =
        overlap >= contact->overlap_max ? carom_greater(contact->size, overlap) : contact->size;
    contact->J = step * carom_hertz_force(contact->stiffness, contact->restitution, overlap,
                                          &contact->overlap_max);
    cluster->touch[contact->touch].P[0] += contact->J;
    cluster->touch[contact->touch].moment += contact->J * tau;

    /* one without a force acts where it closes */
    if (!(contact->J > 0.0) && closing_of(flat, contact) < cluster->slow)
      continue;
    acts = true;
    *norm += quickness(contact, contact->size);
    if (contact->J > 0.0)
      pushed->push[pushed->contacts++] = pushed->press[index];
  }
  return acts;
}

/* Where nothing acts, the contacts that have touched and close again at `slow` or faster touch at
 * once, as positions stay. Returns whether there are any. */
static bool touch_again(bool flat, cluster_state *cluster) {
  bool any = false;
  for (int index = 0; index < cluster->contacts; index++) {
    contact_state *contact = &cluster->contact[index];
    if (contact->time < 0.0 || closing_of(flat, contact) < cluster->slow)
      continue;
    contact->offset += 2.0 * open_overlap - overlap_of(flat, contact);
    any = true;
  }
  return any;
}

/* The friction of the cloth in a step, in closed form: it stops the slip on the cloth, or acts
 * against its mean. */
static inline void rub_on_cloth(ball_state *ball) {
  const double most = ball->mu_slide * ball->load,
               slip_each = CAROM_SPHERE_SLIP * ball->inverse_mass;
  double friction[2] = {0.0, 0.0};
  if (most > 0.0) {
    /* the slip at the end without this friction */
    const double slip_x = ball->v[0] - ball->W[1] - slip_each * ball->g[0],
                 slip_y = ball->v[1] + ball->W[0] - slip_each * ball->g[1];
    const double end2 = slip_x * slip_x + slip_y * slip_y, stops = slip_each * most;
    if (end2 <= stops * stops) {
      friction[0] = -slip_x / slip_each;
      friction[1] = -slip_y / slip_each;
    } else {
      /* a slip that may turn back within the step, of a mean below twice what friction takes, has
       * no mean direction */
      const double mean_x = ball->base[0] + slip_x, mean_y = ball->base[1] + slip_y,
                   mean2 = mean_x * mean_x + mean_y * mean_y;
      const bool by_end = mean2 < CAROM_MAY_TURN_BACK * stops * stops;
      const double scale = -most / sqrt(by_end ? end2 : mean2);
      friction[0] = scale * (by_end ? slip_x : mean_x);
      friction[1] = scale * (by_end ? slip_y : mean_y);
    }
  } else if (ball->g[0] == 0.0 && ball->g[1] == 0.0) {
    return;
  }

  /* instead of the last iterate */
  const double change_x = ball->inverse_mass * (friction[0] - ball->g[0]),
               change_y = ball->inverse_mass * (friction[1] - ball->g[1]);
  ball->v[0] += change_x;
  ball->v[1] += change_y;
  ball->W[0] += CAROM_SPHERE_TURN * change_y;
  ball->W[1] -= CAROM_SPHERE_TURN * change_x;
  ball->g[0] = friction[0];
  ball->g[1] = friction[1];
}

/* The next iterate of a contact's friction; change[] becomes what it changes by. */
static inline void iterate(bool flat, contact_state *contact, double change[2]) {
  double slip[2], friction[2];
  CAROM_PROMISE(!(contact->J <= 0.0 || contact->mu < 0.0));
  slip_of(flat, contact, slip);

  /* the mean slip of the step, twice */
  const double mean_x = slip[0] + contact->slip[0], mean_y = slip[1] + contact->slip[1],
               mean2 = mean_x * mean_x + mean_y * mean_y;

  /* mu falls as the slip grows within the step */
  const double mean = sqrt(mean2);
  double most = contact->mu * contact->J;
  if (mean2 > 4.0 * contact->greatest_slip * contact->greatest_slip) {
    double law[3];
    law_of(contact, law);
    most = carom_friction_ahead(contact->ball_i->friction, law, contact->mu,
                                0.5 * mean - contact->greatest_slip) *
           contact->J;
  }

  /* it holds where friction can stop the slip, and else acts against the mean */
  if (contact->may_stick) {
    const ball_state *ball_i = contact->ball_i, *ball_j = contact->ball_j;
    /* a ball with two contacts gives each of them half of the way */
    const double share = 1.0 / (CAROM_SPHERE_SLIP * (ball_i->acting * ball_i->inverse_mass +
                                                     ball_j->acting * ball_j->inverse_mass));
    friction[0] = contact->friction[0] - share * slip[0];
    friction[1] = contact->friction[1] - share * slip[1];

    /* as large as mu lets it be */
    const double size2 = carom_plane_dot(friction, friction);
    if (size2 > most * most) {
      const double down = most / sqrt(size2);
      friction[0] *= down;
      friction[1] *= down;
    }
  } else {
    const double scale = mean2 > 0.0 ? -most / mean : 0.0;
    friction[0] = scale * mean_x;
    friction[1] = scale * mean_y;
  }

  /* the new iterate */
  for (int axis = 0; axis < 2; axis++) {
    change[axis] = friction[axis] - contact->friction[axis];
    contact->friction[axis] = friction[axis];
  }
}

/* ---- A step */

/* Lists a ball, once, as the step begins. */
static inline void list_pushed(const cluster_state *cluster, pushes *pushed, ball_state *ball) {
  if (ball->acting != 0)
    return;
  pushed->pushed[pushed->balls++] = (uint8_t)(ball - cluster->ball);
  ball->base[0] = ball->v[0] - ball->W[1];
  ball->base[1] = ball->v[1] + ball->W[0];
  ball->load = ball->g[0] = ball->g[1] = 0.0;
}

/* The impulse of the nose in a step; by what goes down the ball falls. A ball on the cloth that tip
 * or slate lift is under the nose, whose force holds it down. */
static inline void push_by_nose(cluster_state *cluster) {
  const carom_cluster_nose *nose = &cluster->nose;
  ball_state *ball = &cluster->ball[cluster->tip.ball];
  nose_push(nose, nose->J, ball);
  if (!cluster->on_slate)
    return;
  if (!ball->flies)
    ball->v[2] -= carom_lesser(carom_greater(ball->v[2], 0.0),
                               nose_slope * nose->J * carom_space_size(nose->v));
  carom_cluster_slate *slate = &cluster->slate[cluster->tip.ball];
  slate->falls = carom_lesser(slate->falls + nose->J * nose->v[2], 0.0);
}

/* Slips, limits and speeds as the step begins, and the normal impulses. */
static inline void begin_step(bool flat, cluster_state *cluster, pushes *pushed) {
  for (int index = 0; index < cluster->balls; index++)
    cluster->ball[index].acting = 0;
  pushed->balls = 0;

  double pressing[CAROM_CLUSTER_BALLS]; /* sums of J */
  for (int index = 0; index < pushed->contacts; index++) {
    contact_state *contact = &cluster->contact[pushed->push[index]];

    /* speeds, and mu, which falls only where the slip is the greatest so far */
    contact->closing = closing_of(flat, contact);
    slip_of(flat, contact, contact->slip); /* with the freedom of the step before */
    const double slip = carom_plane_size(contact->slip);
    if (slip > contact->greatest_slip) {
      contact->greatest_slip = slip;
      double law[3];
      law_of(contact, law);
      contact->mu = carom_friction_at(contact->ball_i->friction, law, slip);
    }

    /* phi, and whether friction could stop twice the slip: it takes half of it at a time */
    if (cluster->on_slate)
      contact->freedom = carom_lesser(
          contact->tilted + share_of_tip(cluster, contact->i, contact->j, contact->mu * contact->J),
          1.0);
    contact->may_stick =
        slip <= 2.0 * CAROM_SPHERE_SLIP * mobility(contact) * contact->mu * contact->J;
    contact->impulse += contact->J;

    /* its two balls, each listed once, as the step begins */
    for (int side = 0; side < 2; side++) {
      ball_state *ball = side == 0 ? contact->ball_i : contact->ball_j;
      list_pushed(cluster, pushed, ball);
      pressing[ball - cluster->ball] =
          ball->acting > 0 ? pressing[ball - cluster->ball] + contact->J : contact->J;
      ball->acting = (int8_t)(ball->acting < 2 ? ball->acting + 1 : 2);
    }
  }

  /* the balls that the slate pushes */
  for (int index = 0; cluster->on_slate && index < cluster->balls; index++)
    if (cluster->slate[index].J > 0.0)
      list_pushed(cluster, pushed, &cluster->ball[index]);
  CAROM_PROMISE(pushed->contacts <= pushed->pressed && pushed->balls <= cluster->balls);

  /* all normal impulses, when all of that is known */
  for (int index = 0; index < pushed->contacts; index++) {
    const contact_state *contact = &cluster->contact[pushed->push[index]];
    const double others = carom_greater(pressing[contact->i], pressing[contact->j]) - contact->J;
    cluster->shared += carom_lesser(contact->J, others);
    cluster_add(flat, contact->ball_i->v, -contact->J * contact->ball_i->inverse_mass, contact->n);
    cluster_add(flat, contact->ball_j->v, contact->J * contact->ball_j->inverse_mass, contact->n);
  }

  /* the impulses of tip and slate; the slate's is the load of the cloth's friction */
  if (cluster->struck)
    tip_push(flat, cluster);
  if (cluster->nose_near)
    push_by_nose(cluster);
  for (int index = 0; cluster->on_slate && index < cluster->balls; index++) {
    ball_state *ball = &cluster->ball[index];
    ball->v[2] += cluster->slate[index].J * ball->inverse_mass;
    ball->load = cluster->slate[index].J;
  }
}

/* The friction of a step, of all contacts and of the cloth. */
static inline void rub_all(bool flat, cluster_state *cluster, const pushes *pushed) {
  double change[CAROM_CLUSTER_CONTACTS][2];

  /* initially the previous step's */
  for (int index = 0; index < pushed->contacts; index++) {
    contact_state *contact = &cluster->contact[pushed->push[index]];
    contact->friction[0] *= contact->J;
    contact->friction[1] *= contact->J;
    rub(flat, contact, contact->friction);
  }

  /* the cloth, and all contacts from the same velocities, alternately; the cloth is the last, and
     acts once where it is alone */
  for (int iteration = 0; iteration <= ITERATIONS; iteration++) {
    for (int index = 0; index < pushed->balls; index++)
      rub_on_cloth(&cluster->ball[pushed->pushed[index]]);
    if (iteration == ITERATIONS || pushed->contacts == 0)
      return;
    for (int index = 0; index < pushed->contacts; index++)
      iterate(flat, &cluster->contact[pushed->push[index]], change[index]);
    for (int index = 0; index < pushed->contacts; index++)
      rub(flat, &cluster->contact[pushed->push[index]], change[index]);
  }
}

/* The other half of the step, after which contacts may be open. */
static inline void end_step(bool flat, cluster_state *cluster, double step, double tau,
                            const pushes *pushed) {
  move(flat, cluster, 0.5 * step);

  /* sums of friction, which is kept over J for the next step; and the greatest overlap */
  for (int index = 0; index < pushed->contacts; index++) {
    contact_state *contact = &cluster->contact[pushed->push[index]];
    const double each = 1.0 / contact->J;
    for (int axis = 0; axis < 2; axis++) {
      contact->rubbed[axis] += contact->friction[axis];
      cluster->touch[contact->touch].P[1 + axis] +=
          axis == 1 && !flat ? contact->freedom * contact->friction[axis] : contact->friction[axis];
      contact->friction[axis] *= each;
    }
    contact->overlap_max = carom_hertz_vertex(contact->overlap, contact->overlap_max, step,
                                              contact->closing, closing_of(flat, contact));
  }

  /* where the force has reached 0 the set recovers as the overlap falls */
  for (int index = 0; index < pushed->pressed; index++) {
    contact_state *contact = &cluster->contact[pushed->press[index]];
    recover(contact, overlap_of(flat, contact));
  }
  if (cluster->struck)
    tip_parts(cluster, step);
  if (cluster->on_slate)
    slate_parts(cluster, step);
  if (cluster->nose_near)
    nose_parts(&cluster->nose, &cluster->ball[cluster->tip.ball], step, tau + 0.5 * step);
}

/* ---- All of it */

/* Of the balls, and of a cue with its end mass. */
static double energy_of(const cluster_state *cluster) {
  const carom_cluster_tip *tip = &cluster->tip;
  double sum = cluster->struck ? 0.5 * tip->V * tip->V / tip->inverse_mass : 0.0;
  if (cluster->struck && tip->slides)
    sum += 0.5 * cluster_dot(false, tip->y, tip->y) / tip->end;
  for (int index = 0; index < cluster->balls; index++) {
    const ball_state *ball = &cluster->ball[index];
    sum += (0.5 * cluster_dot(false, ball->v, ball->v) +
            CAROM_SPHERE_ENERGY * cluster_dot(false, ball->W, ball->W)) /
           ball->inverse_mass;
  }
  return sum;
}

/* Takes what the integrator has added to the energy from the motion about the centre of mass, so
 * momentum is kept. */
static void take_back(cluster_state *cluster, double energy) {
  const double new_energy = energy_of(cluster);
  if (!(new_energy > energy))
    return;

  /* of the balls that were touched; a bystander keeps its motion */
  bool touched[CAROM_CLUSTER_BALLS] = {false};
  for (int index = 0; index < cluster->contacts; index++)
    if (cluster->contact[index].impulse > 0.0)
      touched[cluster->contact[index].i] = touched[cluster->contact[index].j] = true;

  /* their momentum, and the energy about the centre of mass */
  double mass = 0.0, momentum[3] = {0.0, 0.0, 0.0}, about = 0.0;
  for (int index = 0; index < cluster->balls; index++) {
    if (!touched[index])
      continue;
    mass += 1.0 / cluster->ball[index].inverse_mass;
    cluster_add(false, momentum, 1.0 / cluster->ball[index].inverse_mass, cluster->ball[index].v);
  }
  if (!(mass > 0.0))
    return;

  /* the motion about the centre of mass */
  const double centre[3] = {momentum[0] / mass, momentum[1] / mass, momentum[2] / mass};
  for (int index = 0; index < cluster->balls; index++) {
    if (!touched[index])
      continue;
    double relative[3];
    cluster_minus(false, cluster->ball[index].v, centre, relative);
    about += 0.5 * cluster_dot(false, relative, relative) / cluster->ball[index].inverse_mass;
  }

  /* a little less than all of it, so that rounding adds nothing */
  const double share =
      sqrt(carom_greater(1.0 - (new_energy - energy) / about, 0.0)) * (1.0 - CAROM_ROUNDED_SPEED);
  for (int index = 0; index < cluster->balls; index++)
    for (int axis = 0; axis < 3 && touched[index]; axis++)
      cluster->ball[index].v[axis] =
          centre[axis] + share * (cluster->ball[index].v[axis] - centre[axis]);
}

/* The same of a ball in a nose: by an impulse -J of that, over the mass, which takes
 * J b - J^2/2 of the speed b along D. */
static void take_back_from_nose(cluster_state *cluster, double energy) {
  ball_state *ball = &cluster->ball[cluster->tip.ball];
  const double more = (energy_of(cluster) - energy) * ball->inverse_mass,
               parting = nose_dot(&cluster->nose, ball->v, ball->W);
  if (!(more > 0.0 && parting > 0.0))
    return;
  const double left = sqrt(carom_greater(parting * parting - 2.0 * more, 0.0));
  nose_push(&cluster->nose, (left - parting) * (1.0 + CAROM_ROUNDED_IMPULSE), ball);
}

/* The same of a strike: by an impulse -J of the tip, which takes J |b| - J^2 k/2 where b is the
 * speed `parting` of the tip, below 0, and k the `response`, by how much J changes it. A tip that
 * slides gives J along n. */
static void take_back_from_tip(bool flat, cluster_state *cluster, double energy) {
  carom_cluster_tip *tip = &cluster->tip;
  ball_state *ball = &cluster->ball[tip->ball];
  const double *way = tip->slides ? tip->n : tip->along, none[3] = {0.0, 0.0, 0.0},
               *arm = tip->slides ? none : tip->arm, kappa = tip->slides ? tip->kappa : 1.0;

  /* only what is more, and while they part */
  const double more = energy_of(cluster) - energy;
  const double parting =
      kappa * tip->V - cluster_dot(flat, ball->v, way) - cluster_dot(false, ball->W, arm);
  if (!(more > 0.0 && parting < 0.0))
    return;

  /* the lesser zero of J |b| - J^2 k/2 - more, a little more, so that rounding adds nothing */
  const double inverse_mass = ball->inverse_mass, of_cue = kappa * tip->inverse_mass,
               response = kappa * of_cue +
                          inverse_mass * (cluster_dot(flat, way, way) +
                                          CAROM_SPHERE_TURN * cluster_dot(false, arm, arm));
  const double left = sqrt(carom_greater(parting * parting - 2.0 * response * more, 0.0));
  const double J = (parting + left) / response * (1.0 + CAROM_ROUNDED_IMPULSE);
  tip->V -= of_cue * J;
  tip->impulse += kappa * J;
  cluster_add(flat, ball->v, J * inverse_mass, way);
  cluster_add(false, ball->W, CAROM_SPHERE_TURN * J * inverse_mass, arm);
  cluster_add(flat, cluster->touch[tip->touch].P, J, way);
}

/* The duration of a step before any contact has acted: by those that touch and close. */
static inline double first_step(bool flat, const cluster_state *cluster) {
  double norm = 0.0;
  for (int index = 0; index < cluster->contacts; index++) {
    const contact_state *contact = &cluster->contact[index];
    const double closing = contact->touched ? closing_of(flat, contact) : 0.0;
    if (closing > 0.0)
      norm += quickness(contact,
                        carom_cluster_compression(contact->stiffness, mobility(contact), closing));
  }
  return step_of(norm, cluster->steps);
}

/* How long until two balls touch that have not. */
static inline double wait_of_first(bool flat, const contact_state *contact) {
  const passing pass = passing_of(flat, contact);
  if (!(pass.B < 0.0 && pass.discriminant > 0.0))
    return INFINITY;
  return carom_greater((-pass.B - sqrt(pass.discriminant)) / pass.A, 0.0);
}

/* How long until balls touch; infinite: none do. */
static inline double wait_of_balls(bool flat, const cluster_state *cluster) {
  double least = INFINITY;
  for (int index = 0; index < cluster->contacts; index++) {
    const contact_state *contact = &cluster->contact[index];
    double wait = INFINITY;
    if (!contact->touched) {
      wait = wait_of_first(flat, contact);
    } else {
      const double closing = closing_of(flat, contact);
      if (closing >= cluster->slow)
        wait = carom_greater(-overlap_of(flat, contact) / closing, 0.0);
    }
    least = carom_lesser(least, wait);
  }
  return least;
}

/* Of a strike where nothing acts: on to the next touch. Contacts that are too slow to be waited for
 * stay open. */
static bool go_on(bool flat, cluster_state *cluster, double *tau) {
  if (!go_to_touch(flat, cluster, wait_of_balls(flat, cluster), tau))
    return false;
  for (int index = 0; index < cluster->contacts; index++) {
    contact_state *contact = &cluster->contact[index];
    const double overlap = overlap_of(flat, contact);
    if (contact->overlap_max > 0.0)
      recover(contact, overlap);
    else if (contact->touched)
      contact->offset -= carom_greater(overlap, 0.0);
  }
  return true;
}

/* The contacts that act at half a step, at tau. Returns whether any does, or a shaft is bent;
 * *balls whether one of balls does. */
static inline bool act(bool flat, cluster_state *cluster, double step, double tau, pushes *pushed,
                       double *norm, bool *balls) {
  *balls = find_acting(flat, cluster, step, tau, pushed, norm);
  bool cue = false, slate = false, nose = false;
  if (cluster->struck)
    cue = tip_acts(cluster, step, tau);
  if (cluster->on_slate)
    slate = slate_acts(cluster, step);
  if (cluster->nose_near)
    nose =
        nose_acts(&cluster->nose, &cluster->ball[cluster->tip.ball], step, tau, cluster->tip.gone);
  if (*balls || cue || nose || (cluster->struck && shaft_straightens(cluster)))
    return true;
  if (!slate)
    return false;
  const bool lets_go = slate_ends(cluster, step);
  return !lets_go;
}

/* The end of the integration, which has begun with an energy. */
static inline void end_all(bool flat, cluster_state *cluster, double energy) {
  carom_cluster_nose *nose = &cluster->nose;
  if (cluster->nose_near && nose->touches)
    nose_ends(nose, &cluster->ball[cluster->tip.ball], cluster->duration);
  if (cluster->nose_near && nose->lasted > 0.0)
    take_back_from_nose(cluster, energy);
  if (cluster->struck)
    take_back_from_tip(flat, cluster, energy);
  take_back(cluster, energy);
}

/* Step by step, until no contact acts. */
static inline bool solve(bool flat, cluster_state *cluster) {
  const double energy = energy_of(cluster);
  double step = first_step(flat, cluster), tau = 0.0, norm;
  if (cluster->struck)
    step = strike_step(cluster);
  const int least = cluster->steps > (double)CAROM_CLUSTER_STEPS ? (int)cluster->steps
                                                                 : CAROM_CLUSTER_STEPS,
            most = CAROM_CLUSTER_STEPS_MOST * least;
  for (cluster->steps_done = 0;; cluster->steps_done++) {
    if (cluster->steps_done == most)
      return false;

    /* half a step of the positions */
    pushes pushed;
    move(flat, cluster, 0.5 * step);

    /* a touch that is faster than what acts requires a shorter step */
    const double longest = find_pressed(flat, cluster, step, &pushed);
    if (longest < step) {
      move(flat, cluster, 0.5 * (longest - step));
      step = longest;
      find_pressed(flat, cluster, step, &pushed);
    }

    /* where no contact acts, one may touch again, from where the balls are; else all is over */
    tau += 0.5 * step;
    bool balls;
    if (!act(flat, cluster, step, tau, &pushed, &norm, &balls)) {
      if (!touch_again(flat, cluster) && !(cluster->struck && go_on(flat, cluster, &tau)))
        break;
      if (cluster->struck)
        step =
            carom_lesser(step, push_step(cluster, cluster->tip.duration, cluster->tip.restitution));
      continue;
    }

    /* impulses, friction and the other half */
    begin_step(flat, cluster, &pushed);
    rub_all(flat, cluster, &pushed);
    end_step(flat, cluster, step, tau, &pushed);
    tau += 0.5 * step;
    step = step_of(balls ? norm : 0.0, cluster->steps);
    if (cluster->struck)
      step = step_to_touch(cluster, carom_lesser(step, strike_step(cluster)));
  }
  cluster->duration = tau;
  end_all(flat, cluster, energy);
  return true;
}

bool carom_cluster_solve(carom_cluster_state *cluster) {
  CAROM_PROMISE((cluster->struck || cluster->contacts >= 1) && cluster->balls >= 1 &&
                cluster->slow > 0.0);
  cluster->touches = cluster->repeated = 0;
  cluster->shared = 0.0;
  for (int index = 0; index < cluster->balls; index++)
    for (int axis = 0; axis < 3; axis++) {
      cluster->ball[index].s[axis] = 0.0;
      cluster->ball[index].v0[axis] = cluster->ball[index].v[axis];
    }
  if (!(cluster->in_space ? solve(false, cluster) : solve(true, cluster)))
    return false;
  carom_cluster_find_places(cluster);
  return true;
}
