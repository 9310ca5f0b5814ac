/* The integrator of a cluster, cluster.h: leapfrog in tau, with the friction of a step by fixed
 * iterations. A step of h:
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
 * in which others touch is taken again, as short as these ask for. Where nothing acts, contacts
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

#include <math.h>

typedef carom_cluster_state state;
typedef carom_cluster_contact_state contact;
typedef carom_cluster_ball ball;

enum { ITERATIONS = 2 };

/* The contacts that are pressed in a step, those of them that act, and the balls of these. */
typedef struct pushes {
  int pressed, contacts, balls; /* how many; their places in contact[] and ball[]: */
  uint8_t press[CAROM_CLUSTER_CONTACTS], push[CAROM_CLUSTER_CONTACTS], pushed[CAROM_CLUSTER_BALLS];
} pushes;

static const double open_overlap =
    1e-12; /* m: overlaps below it are none; their forces could underflow */

/* ---- A contact's geometry and motion */

static inline void move(bool flat, state *c, double time) {
  for (int k = 0; k < c->balls; k++)
    cluster_add(flat, c->ball[k].s, time, c->ball[k].v);
}

static inline double mobility(const contact *x) { /* B */
  return x->p->inverse_mass + x->q->inverse_mass;
}

static inline double closing_of(bool flat, const contact *x) {
  double v[3];
  cluster_minus(flat, x->p->v, x->q->v, v);
  return cluster_dot(flat, v, x->n);
}

static inline double overlap_of(bool flat, const contact *x) {
  double s[3];
  cluster_minus(flat, x->p->s, x->q->s, s);
  return x->offset + cluster_dot(flat, s, x->n);
}

static inline void slip_of(bool flat, const contact *x, double u[2]) {
  const ball *p = x->p, *q = x->q;
  double v[3], t[3], third[3];
  cluster_minus(flat, p->v, q->v, v);
  const double W[3] = {p->W[0] + q->W[0], p->W[1] + q->W[1], p->W[2] + q->W[2]};
  cluster_across(flat, x->n, t, third);
  if (flat) {
    u[0] = carom_plane_dot(v, t) - W[2];
    u[1] = carom_plane_dot(W, t);
  } else {
    u[0] = cluster_dot(false, v, t) - cluster_dot(false, W, third);
    u[1] = x->freedom * cluster_dot(false, v, third) + cluster_dot(false, W, t);
  }
}

/* Friction's impulse f on i, and -f on j. */
static inline void rub(bool flat, const contact *x, const double f[2]) {
  ball *p = x->p, *q = x->q;
  const double p_0 = f[0] * p->inverse_mass, p_1 = f[1] * p->inverse_mass;
  const double q_0 = f[0] * q->inverse_mass, q_1 = f[1] * q->inverse_mass;
  double t[3], third[3];
  cluster_across(flat, x->n, t, third);
  cluster_add(flat, p->v, p_0, t);
  cluster_add(flat, q->v, -q_0, t);
  cluster_add(flat, p->W, 2.5 * p_1, t);
  cluster_add(flat, q->W, 2.5 * q_1, t);
  if (flat) {
    p->W[2] -= 2.5 * p_0;
    q->W[2] -= 2.5 * q_0;
    p->load -= f[1];
    q->load += f[1];
  } else {
    const double held = (1.0 - x->freedom) * f[1];
    cluster_add(false, p->v, x->freedom * p_1, third);
    cluster_add(false, q->v, -x->freedom * q_1, third);
    cluster_add(false, p->W, -2.5 * p_0, third);
    cluster_add(false, q->W, -2.5 * q_0, third);
    p->load -= held;
    q->load += held;
  }
}

/* Two balls that move past each other: they touch where |d + v time|^2 = R^2, which is
 * A time^2 + 2 B time + C = 0, and D = B^2 - A C. */
typedef struct passing {
  double d[3], v[3];
  double R, A, B, D;
} passing;

static inline passing passing_of(bool flat, const contact *x) {
  const ball *p = x->p, *q = x->q;
  passing m;
  for (int k = 0; k < 3; k++) {
    m.d[k] = q->r[k] - p->r[k] + (q->s[k] - p->s[k]);
    m.v[k] = q->v[k] - p->v[k];
  }
  m.R = p->radius + q->radius + CAROM_TOUCHING;
  const double C = cluster_dot(flat, m.d, m.d) - m.R * m.R;
  m.A = cluster_dot(flat, m.v, m.v);
  m.B = cluster_dot(flat, m.d, m.v);
  m.D = m.B * m.B - m.A * C;
  return m;
}

/* Where two balls that were apart have come together within the last half step, all moved by s:
 * the normal of the contact from then on, which is that of the touch, at most a step ago. */
static void touch(bool flat, contact *x, double half) {
  const passing m = passing_of(flat, x);
  const double D = carom_greater(m.D, 0.0);
  const double back = m.A > 0.0 ? carom_greater((-m.B - sqrt(D)) / m.A, -2.0 * half) : 0.0;
  for (int k = 0; k < 3; k++)
    x->n[k] = m.d[k] + back * m.v[k];
  if (flat)
    x->n[2] = 0.0;
  const double size = sqrt(cluster_dot(flat, x->n, x->n));
  for (int k = 0; k < 3; k++)
    x->n[k] /= size;

  /* the offset with which the overlap is R less the distance along n, as s counts on */
  double s[3];
  cluster_minus(flat, x->p->s, x->q->s, s);
  x->offset = m.R - cluster_dot(flat, m.d, x->n) - cluster_dot(flat, s, x->n);
}

/* Whether two balls that have not touched overlap, some time from now. */
static inline bool meet(bool flat, const contact *x, double time) {
  const ball *p = x->p, *q = x->q;
  double square = 0.0;
  for (int k = 0; k < (flat ? 2 : 3); k++) {
    const double d = q->r[k] + q->s[k] + time * q->v[k] - (p->r[k] + p->s[k] + time * p->v[k]);
    square += d * d;
  }
  const double R = p->radius + q->radius + CAROM_TOUCHING;
  return square < R * R;
}

/* What a contact of a compression adds to the norm of steps; and the step of a sum of these. */
static inline double quickness(const contact *x, double size) {
  const double q = x->quick * size, q2 = q * q, q4 = q2 * q2;
  return q4 * q4;
}
static inline double step_of(double norm, double steps) {
  return norm > 0.0 ? 1.0 / (steps * sqrt(sqrt(sqrt(sqrt(sqrt(norm)))))) : (double)INFINITY;
}

/* ---- Forces */

/* The numbers of a contact's friction. */
static inline void law_of(const contact *x, double k[3]) {
  for (int n = 0; n < 3; n++)
    k[n] = 0.5 * (x->p->law[n] + x->q->law[n]);
}

/* The contacts that are pressed at half a step: those that were, and open ones that have an
 * overlap, which touch within it and get their sizes and normals. Returns the longest step that
 * suits these and those that touch in the other half, infinite where there are none. */
static inline double find_pressed(bool flat, state *c, double h, pushes *pushed) {
  double norm = 0.0;
  pushed->pressed = 0;
  CAROM_PROMISE(!(h < 0.0));
  for (int k = 0; k < c->contacts; k++) {
    contact *x = &c->contact[k];
    if (x->d_max > 0.0) {
      pushed->press[pushed->pressed++] = (uint8_t)k;
      continue;
    }
    /* one that touched as all began, and has parted without an impulse, touches as any other */
    if (x->touched && x->time < 0.0 && overlap_of(flat, x) < -open_overlap && !meet(flat, x, 0.0))
      x->touched = false;
    const bool first = !x->touched;
    if (first && !meet(flat, x, 0.5 * h))
      continue;
    const bool meets = first && meet(flat, x, 0.0);
    if (meets)
      touch(flat, x, 0.5 * h);
    /* one that has touched is open since it parted: it has no overlap before it closes again */
    const double v = closing_of(flat, x);
    if (!first && v <= 0.0)
      continue;
    const double d = overlap_of(flat, x);
    if (d + 0.5 * h * v <= open_overlap)
      continue;
    if (d > open_overlap && (meets || !first))
      pushed->press[pushed->pressed++] = (uint8_t)k;
    x->size = v > 0.0 ? carom_cluster_compression(x->K, mobility(x), v) : 0.0;
    norm += quickness(x, x->size);
  }
  return step_of(norm, c->steps);
}

/* The set of a contact that is d deep, where its force has reached 0. */
static inline void recover(contact *x, double d) {
  x->d_max = d > open_overlap ? carom_set_left(x->e, d, x->d_max) : (double)0.0;
}

/* A contact touches, d deep by now. */
static inline void begin_contact(bool flat, state *c, contact *x, double d, double tau) {
  const double v = closing_of(flat, x);
  double s[3];
  cluster_minus(flat, x->p->s, x->q->s, s);
  x->U = -1.0; /* less than any slip: the first one sets mu */
  x->f[0] = x->f[1] = 0.0;
  const double time = carom_greater(tau - (v > 0.0 ? d / v : 0.0), 0.0);
  x->touch = carom_cluster_begin_touch(c, (int)(x - c->contact), x->time < 0.0 ? -1 : x->touch,
                                       time, cluster_dot(flat, s, x->n) - d);
  if (x->time < 0.0)
    x->time = time;
}

/* Those of the pressed contacts that act, and their impulses. *norm becomes that of all that
 * overlap. Returns whether any does. */
static inline bool find_acting(bool flat, state *c, double h, double tau, pushes *pushed,
                               double *norm) {
  bool overlap = false;
  *norm = 0.0;
  pushed->contacts = 0;
  for (int k = 0; k < pushed->pressed; k++) {
    contact *x = &c->contact[pushed->press[k]];
    const double d = overlap_of(flat, x);
    if (d <= open_overlap)
      continue;
    x->touched = true;
    if (x->d_max == 0.0)
      begin_contact(flat, c, x, d, tau);

    /* its force, by the overlap at half a step */
    x->d = d;
    x->size = d >= x->d_max ? carom_greater(x->size, d) : x->size;
    x->J = h * carom_hertz_force(x->K, x->e, d, &x->d_max);
    c->touch[x->touch].P[0] += x->J;
    c->touch[x->touch].moment += x->J * tau;

    /* one without a force acts where it closes */
    if (!(x->J > 0.0) && closing_of(flat, x) < c->slow)
      continue;
    overlap = true;
    *norm += quickness(x, x->size);
    if (x->J > 0.0)
      pushed->push[pushed->contacts++] = pushed->press[k];
  }
  return overlap;
}

/* Where nothing acts, the contacts that have touched and close again at `slow` or faster touch at
 * once, as positions stay. Returns whether there are any. */
static bool touch_again(bool flat, state *c) {
  bool any = false;
  for (int k = 0; k < c->contacts; k++) {
    contact *x = &c->contact[k];
    if (x->time < 0.0 || closing_of(flat, x) < c->slow)
      continue;
    x->offset += 2.0 * open_overlap - overlap_of(flat, x);
    any = true;
  }
  return any;
}

/* The friction of the cloth in a step, in closed form: it stops the slip on the cloth, or acts
 * against its mean. */
static inline void rub_on_cloth(ball *p) {
  const double most = p->mu_slide * p->load, m = 3.5 * p->inverse_mass;
  double g[2] = {0.0, 0.0};
  if (most > 0.0) {
    /* the slip at the end without this friction */
    const double u_x = p->v[0] - p->W[1] - m * p->g[0], u_y = p->v[1] + p->W[0] - m * p->g[1];
    const double end2 = u_x * u_x + u_y * u_y, stops = m * most;
    if (end2 <= stops * stops) {
      g[0] = -u_x / m;
      g[1] = -u_y / m;
    } else {
      /* a slip that may turn back within the step, of a mean below twice what friction takes, has
       * no mean direction */
      const double x = p->base[0] + u_x, y = p->base[1] + u_y, mean2 = x * x + y * y;
      const bool by_end = mean2 < 16.0 * stops * stops;
      const double k = -most / sqrt(by_end ? end2 : mean2);
      g[0] = k * (by_end ? u_x : x);
      g[1] = k * (by_end ? u_y : y);
    }
  } else if (p->g[0] == 0.0 && p->g[1] == 0.0) {
    return;
  }
  const double d_x = p->inverse_mass * (g[0] - p->g[0]), d_y = p->inverse_mass * (g[1] - p->g[1]);
  p->v[0] += d_x;
  p->v[1] += d_y;
  p->W[0] += 2.5 * d_y;
  p->W[1] -= 2.5 * d_x;
  p->g[0] = g[0];
  p->g[1] = g[1];
}

/* The next iterate of a contact's friction; change[] becomes what it changes by. */
static inline void iterate(bool flat, contact *x, double change[2]) {
  double u[2], f[2];
  CAROM_PROMISE(!(x->J <= 0.0 || x->mu < 0.0));
  slip_of(flat, x, u);

  /* the mean slip of the step, twice */
  const double m_x = u[0] + x->u[0], m_y = u[1] + x->u[1], mean2 = m_x * m_x + m_y * m_y;

  /* mu falls as the slip grows within the step */
  const double mean = sqrt(mean2);
  double most = x->mu * x->J;
  if (mean2 > 4.0 * x->U * x->U) {
    double law[3];
    law_of(x, law);
    most = carom_friction_ahead(x->p->friction, law, x->mu, 0.5 * mean - x->U) * x->J;
  }

  /* it holds where friction can stop the slip, and else acts against the mean */
  if (x->may_stick) {
    const ball *p = x->p, *q = x->q;
    const double share = 1.0 / (3.5 * (p->acting * p->inverse_mass + q->acting * q->inverse_mass));
    f[0] = x->f[0] - share * u[0];
    f[1] = x->f[1] - share * u[1];

    /* as large as mu lets it be */
    const double size2 = carom_plane_dot(f, f);
    if (size2 > most * most) {
      const double down = most / sqrt(size2);
      f[0] *= down;
      f[1] *= down;
    }
  } else {
    const double k = mean2 > 0.0 ? -most / mean : 0.0;
    f[0] = k * m_x;
    f[1] = k * m_y;
  }

  /* the new iterate */
  for (int k = 0; k < 2; k++) {
    change[k] = f[k] - x->f[k];
    x->f[k] = f[k];
  }
}

/* ---- A step */

/* Lists a ball, once, as the step begins. */
static inline void list_pushed(const state *c, pushes *pushed, ball *p) {
  if (p->acting != 0)
    return;
  pushed->pushed[pushed->balls++] = (uint8_t)(p - c->ball);
  p->base[0] = p->v[0] - p->W[1];
  p->base[1] = p->v[1] + p->W[0];
  p->load = p->g[0] = p->g[1] = 0.0;
}

/* Slips, limits and speeds as the step begins, and the normal impulses. */
static inline void begin_step(bool flat, state *c, pushes *pushed) {
  for (int k = 0; k < c->balls; k++)
    c->ball[k].acting = 0;
  pushed->balls = 0;
  double pressing[CAROM_CLUSTER_BALLS]; /* sums of J */
  for (int a = 0; a < pushed->contacts; a++) {
    contact *x = &c->contact[pushed->push[a]];
    /* speeds, and mu, which falls only where the slip is the greatest so far */
    x->closing = closing_of(flat, x);
    slip_of(flat, x, x->u); /* with the freedom of the step before */
    const double u = carom_plane_size(x->u);
    if (u > x->U) {
      x->U = u;
      double law[3];
      law_of(x, law);
      x->mu = carom_friction_at(x->p->friction, law, u);
    }

    if (c->on_slate)
      x->freedom = carom_lesser(x->tilted + share_of_tip(c, x->i, x->j, x->mu * x->J), 1.0);
    x->may_stick = u <= 7.0 * mobility(x) * x->mu * x->J;
    x->impulse += x->J;

    /* its two balls, each listed once, as the step begins */
    for (int side = 0; side < 2; side++) {
      ball *p = side == 0 ? x->p : x->q;
      list_pushed(c, pushed, p);
      pressing[p - c->ball] = p->acting > 0 ? pressing[p - c->ball] + x->J : x->J;
      p->acting = (int8_t)(p->acting < 2 ? p->acting + 1 : 2);
    }
  }
  for (int k = 0; c->on_slate && k < c->balls; k++)
    if (c->slate[k].J > 0.0)
      list_pushed(c, pushed, &c->ball[k]);
  CAROM_PROMISE(pushed->contacts <= pushed->pressed && pushed->balls <= c->balls);

  /* all normal impulses, when all of that is known */
  for (int a = 0; a < pushed->contacts; a++) {
    const contact *x = &c->contact[pushed->push[a]];
    const double others = carom_greater(pressing[x->i], pressing[x->j]) - x->J;
    c->shared += carom_lesser(x->J, others);
    cluster_add(flat, x->p->v, -x->J * x->p->inverse_mass, x->n);
    cluster_add(flat, x->q->v, x->J * x->q->inverse_mass, x->n);
  }
  if (c->struck)
    tip_push(flat, c);
  for (int k = 0; c->on_slate && k < c->balls; k++) {
    ball *p = &c->ball[k];
    p->v[2] += c->slate[k].J * p->inverse_mass;
    p->load = c->slate[k].J;
  }
}

/* The friction of a step, of all contacts and of the cloth. */
static inline void rub_all(bool flat, state *c, const pushes *pushed) {
  double change[CAROM_CLUSTER_CONTACTS][2];
  /* first that of the step before */
  for (int a = 0; a < pushed->contacts; a++) {
    contact *x = &c->contact[pushed->push[a]];
    x->f[0] *= x->J;
    x->f[1] *= x->J;
    rub(flat, x, x->f);
  }
  for (int iteration = 0; iteration <= ITERATIONS; iteration++) {
    for (int k = 0; k < pushed->balls; k++)
      rub_on_cloth(&c->ball[pushed->pushed[k]]);
    if (iteration == ITERATIONS)
      return;
    for (int a = 0; a < pushed->contacts; a++)
      iterate(flat, &c->contact[pushed->push[a]], change[a]);
    for (int a = 0; a < pushed->contacts; a++)
      rub(flat, &c->contact[pushed->push[a]], change[a]);
  }
}

/* The other half of the step, after which contacts may be open. */
static inline void end_step(bool flat, state *c, double h, const pushes *pushed) {
  move(flat, c, 0.5 * h);
  for (int a = 0; a < pushed->contacts; a++) {
    contact *x = &c->contact[pushed->push[a]];
    const double each = 1.0 / x->J;
    for (int k = 0; k < 2; k++) {
      x->rubbed[k] += x->f[k];
      c->touch[x->touch].P[1 + k] += k == 1 && !flat ? x->freedom * x->f[k] : x->f[k];
      x->f[k] *= each;
    }
    x->d_max = carom_hertz_vertex(x->d, x->d_max, h, x->closing, closing_of(flat, x));
  }
  /* where the force has reached 0 the set recovers as the overlap falls */
  for (int k = 0; k < pushed->pressed; k++) {
    contact *x = &c->contact[pushed->press[k]];
    recover(x, overlap_of(flat, x));
  }
  if (c->struck)
    tip_parts(c, h);
  if (c->on_slate)
    slate_parts(c, h);
}

/* ---- All of it */

static double energy_of(const state *c) {
  const carom_cluster_tip *x = &c->tip;
  double sum = c->struck ? 0.5 * x->V * x->V / x->inverse_mass : (double)0.0;
  if (c->struck && x->slides)
    sum += 0.5 * cluster_dot(false, x->y, x->y) / x->end;
  for (int k = 0; k < c->balls; k++) {
    const ball *p = &c->ball[k];
    sum += (0.5 * cluster_dot(false, p->v, p->v) + 0.2 * cluster_dot(false, p->W, p->W)) /
           p->inverse_mass;
  }
  return sum;
}

/* Takes what the integrator has added to the energy from the motion about the centre of mass, so
 * momentum is kept. */
static void take_back(state *c, double energy) {
  const double new_energy = energy_of(c);
  if (!(new_energy > energy))
    return;
  /* of the balls that were touched; a bystander keeps its motion */
  bool touched[CAROM_CLUSTER_BALLS] = {false};
  for (int k = 0; k < c->contacts; k++)
    if (c->contact[k].impulse > 0.0)
      touched[c->contact[k].i] = touched[c->contact[k].j] = true;

  /* their momentum, and the energy about the centre of mass */
  double mass = 0.0, P[3] = {0.0, 0.0, 0.0}, about = 0.0;
  for (int k = 0; k < c->balls; k++) {
    if (!touched[k])
      continue;
    mass += 1.0 / c->ball[k].inverse_mass;
    cluster_add(false, P, 1.0 / c->ball[k].inverse_mass, c->ball[k].v);
  }
  if (!(mass > 0.0))
    return;
  const double centre[3] = {P[0] / mass, P[1] / mass, P[2] / mass};
  for (int k = 0; k < c->balls; k++) {
    if (!touched[k])
      continue;
    double v[3];
    cluster_minus(false, c->ball[k].v, centre, v);
    about += 0.5 * cluster_dot(false, v, v) / c->ball[k].inverse_mass;
  }

  /* a little less than all of it, so that rounding adds nothing */
  const double share =
      sqrt(carom_greater(1.0 - (new_energy - energy) / about, 0.0)) * (1.0 - 1e-15);
  for (int k = 0; k < c->balls; k++)
    for (int axis = 0; axis < 3 && touched[k]; axis++)
      c->ball[k].v[axis] = centre[axis] + share * (c->ball[k].v[axis] - centre[axis]);
}

/* The same of a strike: by an impulse -J of the tip, which takes J |b| - J^2 k/2. A tip that slides
 * gives it along n. */
static void take_back_from_tip(bool flat, state *c, double energy) {
  carom_cluster_tip *x = &c->tip;
  ball *p = &c->ball[x->ball];
  const double *way = x->slides ? x->n : x->along, none[3] = {0.0, 0.0, 0.0},
               *arm = x->slides ? none : x->arm, kappa = x->slides ? x->kappa : (double)1.0;
  const double more = energy_of(c) - energy;
  const double b = kappa * x->V - cluster_dot(flat, p->v, way) - cluster_dot(false, p->W, arm);
  if (!(more > 0.0 && b < 0.0))
    return;
  const double m = p->inverse_mass, of_cue = kappa * x->inverse_mass,
               k = kappa * of_cue +
                   m * (cluster_dot(flat, way, way) + 2.5 * cluster_dot(false, arm, arm));
  const double left = sqrt(carom_greater(b * b - 2.0 * k * more, 0.0));
  const double J =
      (b + left) / k * (1.0 + 1e-12); /* a little more, so that rounding adds nothing */
  x->V -= of_cue * J;
  x->impulse += kappa * J;
  cluster_add(flat, p->v, J * m, way);
  cluster_add(false, p->W, 2.5 * J * m, arm);
  cluster_add(flat, c->touch[x->touch].P, J, way);
}

/* The duration of a step before any contact has acted: by those that touch and close. */
static inline double first_step(bool flat, const state *c) {
  double norm = 0.0;
  for (int k = 0; k < c->contacts; k++) {
    const contact *x = &c->contact[k];
    const double v = x->touched ? closing_of(flat, x) : (double)0.0;
    if (v > 0.0)
      norm += quickness(x, carom_cluster_compression(x->K, mobility(x), v));
  }
  return step_of(norm, c->steps);
}

/* How long until two balls touch that have not. */
static inline double wait_of_first(bool flat, const contact *x) {
  const passing m = passing_of(flat, x);
  if (!(m.B < 0.0 && m.D > 0.0))
    return (double)INFINITY;
  return carom_greater((-m.B - sqrt(m.D)) / m.A, 0.0);
}

/* How long until balls touch; infinite: none do. */
static inline double wait_of_balls(bool flat, const state *c) {
  double least = INFINITY;
  for (int k = 0; k < c->contacts; k++) {
    const contact *x = &c->contact[k];
    double wait = INFINITY;
    if (!x->touched) {
      wait = wait_of_first(flat, x);
    } else {
      const double v = closing_of(flat, x);
      if (v >= c->slow)
        wait = carom_greater(-overlap_of(flat, x) / v, 0.0);
    }
    least = carom_lesser(least, wait);
  }
  return least;
}

/* Of a strike where nothing acts: on to the next touch. Contacts that are too slow to be waited for
 * stay open. */
static bool go_on(bool flat, state *c, double *tau) {
  if (!go_to_touch(flat, c, wait_of_balls(flat, c), tau))
    return false;
  for (int k = 0; k < c->contacts; k++) {
    contact *x = &c->contact[k];
    const double d = overlap_of(flat, x);
    if (x->d_max > 0.0)
      recover(x, d);
    else if (x->touched)
      x->offset -= carom_greater(d, 0.0);
  }
  return true;
}

/* The contacts that act at half a step of h, at tau. Returns whether any does; *balls whether one
 * of balls does. */
static inline bool act(bool flat, state *c, double h, double tau, pushes *pushed, double *norm,
                       bool *balls) {
  *balls = find_acting(flat, c, h, tau, pushed, norm);
  const bool cue = c->struck && tip_acts(c, h, tau), slate = c->on_slate && slate_acts(c, h);
  if (*balls || cue)
    return true;
  return slate && !slate_ends(c, h);
}

/* Step by step, until no contact acts. */
static inline bool solve(bool flat, state *c) {
  const double energy = energy_of(c);
  double h = first_step(flat, c), tau = 0.0, norm;
  if (c->struck)
    h = strike_step(c);
  const int least = c->steps > (double)CAROM_CLUSTER_STEPS ? (int)c->steps : CAROM_CLUSTER_STEPS,
            most = CAROM_CLUSTER_STEPS_MOST * least;
  for (c->steps_done = 0;; c->steps_done++) {
    if (c->steps_done == most)
      return false;

    /* half a step of the positions */
    pushes pushed;
    move(flat, c, 0.5 * h);

    /* a touch that is faster than what acts asks for a shorter step */
    const double longest = find_pressed(flat, c, h, &pushed);
    if (longest < h) {
      move(flat, c, 0.5 * (longest - h));
      h = longest;
      find_pressed(flat, c, h, &pushed);
    }

    /* where no contact acts, one may touch again, from where the balls are; else all is over */
    tau += 0.5 * h;
    bool balls;
    if (!act(flat, c, h, tau, &pushed, &norm, &balls)) {
      if (!touch_again(flat, c) && !(c->struck && go_on(flat, c, &tau)))
        break;
      if (c->struck)
        h = carom_lesser(h, push_step(c, c->tip.T, c->tip.e));
      continue;
    }

    /* impulses, friction and the other half */
    begin_step(flat, c, &pushed);
    rub_all(flat, c, &pushed);
    end_step(flat, c, h, &pushed);
    tau += 0.5 * h;
    h = step_of(balls ? norm : (double)0.0, c->steps);
    if (c->struck)
      h = step_to_touch(c, carom_lesser(h, strike_step(c)));
  }
  c->duration = tau;
  if (c->struck)
    take_back_from_tip(flat, c, energy);
  take_back(c, energy);
  return true;
}

bool carom_cluster_solve(carom_cluster_state *c) {
  CAROM_PROMISE((c->struck || c->contacts >= 1) && c->balls >= 1 && c->slow > 0.0);
  c->touches = c->repeated = 0;
  c->shared = 0.0;
  for (int k = 0; k < c->balls; k++)
    for (int n = 0; n < 3; n++) {
      c->ball[k].s[n] = 0.0;
      c->ball[k].v0[n] = c->ball[k].v[n];
    }
  if (!(c->in_space ? solve(false, c) : solve(true, c)))
    return false;
  carom_cluster_find_places(c);
  return true;
}
