/* Contacts in the world carom: where the surfaces touch, at the instant when they touch, by the model.
 *
 * SLOW CONTACTS. A ball that its spin presses against another ball or a cushion bounces in ever smaller hops, infinitely many
 * in a finite time. So a contact that closes at less than s is resolved without friction, and what touches parts at s: hops
 * then last at least 2 s over the acceleration, and end when the spin that presses is used up. The energy that parting takes
 * more than closing gives, some 1e-8 J at first, is taken from the spin of the balls in contact, so energy never rises; it
 * takes half of the spin's at most, so balls that hardly move part at less than s, but soon stop. Momentum is kept.
 *
 * s grows with the number N of instants that had a slow contact,
 *
 *     s = min(1 mm/s / (1 - N / 1500)^2, 0.2 m/s),
 *
 * so that it is 1.6 mm/s after 300, which few shots have, and 0.2 m/s after 1,394. From then on a ball presses on another at
 * most once in 0.2 s, as the cloth accelerates balls by some 2 m/s^2. That bounds the events of balls that press on others: one
 * that pushes a row of 26 along causes a contact of each ball of the row a hop, and balls slide, roll and stop between them.
 * With s at 1 mm/s that would be 100,000 events a second for more than a second. Contacts at one instant count once: there are
 * more of them the more balls touch, and no time passes.
 *
 * 1500 and 0.2 m/s were found with `carom-lab stress --shots 60000 --cushion-model han --seed 3`, whose kind `pressed` is 2 to
 * 32 balls that touch, one at the end with up to 300 rad/s, or two, or all. Most events of a shot: 7,796. With 3000 instead of
 * 1500 237 of 4,000 shots need more than 10,000; with 750 none needs more than 5,873. With 0.1 m/s 4 need more than 10,000;
 * with 0.4 m/s none more than 6,838. What the growth costs: of a row of four balls with 200 rad/s in the first, the last goes
 * 0.760 m, and 0.749 m with s = 0.1 mm/s throughout; of a row of eight 0.035 m, and 0.124 m.
 *
 * CUSHIONS. The formulas of Han and Stronge take what they know of the impact along the inclined normal of the nose, and drop
 * the vertical velocity. Where the restitution is small, below some tan^2 of the inclination, or the nose far from the height
 * of the centre, or the ball spins much for its speed, a ball is left that moves into the cushion. It would hit again at the
 * same instant, a thousand times where the nose is near the cloth. The same event lets it part as a slow contact does.
 *
 * IN SPACE. Where a ball flies, or two radii differ, the line of centres and the normal of a nose have a third component, and
 * the models are those of spheres; the rules above are the same. A ball on the cloth may leave it then: pushed down it is
 * airborne with v_z < 0 and lands at the same instant, as an event of its own, since two balls part long before ball and cloth
 * do.
 *
 * NEAR THE CLOTH. The cloth holds a ball that a cushion presses down, which takes longer than the contact with the cloth; nose
 * and slate one after the other would let it hop by centimetres. A ball on the cloth has the flat model, a flying one that of a
 * free sphere; and with chi = (z - R) / 1 mm < 1 it has (1 - chi) of the flat result and chi of the free one, in v and w, the
 * flat one's v_z being min(v_z, 0). This is continuous at both ends and safe: kinetic energy is convex and neither end has more
 * than before, and both ends part. 1 mm is a convention.
 *
 * PRESSED BY WEIGHT. A ball that lies on another, or on a nose, is pressed by its weight, which does not end as spin does. So a
 * slow contact in space takes energy from the motion of the balls past each other, too, as opposite impulses on both; and what
 * pushes a ball on the cloth down the cloth takes at once, without a landing. The upper ball hops as it rolls off. Where
 * nothing moves, no energy is there: a ball that is balanced on another ends the shot as too_many_events. */
#include "shot/sim.h"

#include <math.h>

static const double slow_first = 1e-3, slow_most = 0.2; /* m/s */
static const double slow_instants = 1500.0;

/* s, above. */
double carom_slow_speed(int64_t instants) {
  const double left = 1.0 - (double)instants / slow_instants;
  return left * left * slow_most > slow_first && left > 0.0 ? slow_first / (left * left) : slow_most;
}

static void count_slow(carom_sim *sim) {
  sim->slow_instants += sim->now > sim->slow_last;
  sim->slow_last = sim->now;
}

static double spin_energy(const carom_ball_kind *kind, const carom_ball_state *s) {
  const double w2 = s->w[0] * s->w[0] + s->w[1] * s->w[1] + s->w[2] * s->w[2];
  return 0.2 * kind->mass * kind->radius * kind->radius * w2;
}

static void slow_spin(carom_ball_state *s, double share) {
  for (int k = 0; k < 3; k++)
    s->w[k] *= share;
}

/* Two bodies in contact; b is NULL where it is a cushion. n is the normal from a to b. Where the cloth holds a body it takes
 * the vertical part of what pushes the body down. */
typedef struct contact {
  const carom_ball_kind *kind_a, *kind_b;
  carom_ball_state *a, *b;
  const double *n;
  bool held_a, held_b;
} contact;

/* An impulse of P along a direction, against a and on b. */
static void push(const contact *c, double P, const double along[3]) {
  for (int k = 0; k < 3; k++) {
    if (!(k == 2 && c->held_a))
      c->a->v[k] -= P / c->kind_a->mass * along[k];
    if (c->b != NULL && !(k == 2 && c->held_b))
      c->b->v[k] += P / c->kind_b->mass * along[k];
  }
}

/* What an impulse along an axis changes of the relative velocity. */
static double mobility(const contact *c, int axis) {
  const double of_a = axis == 2 && c->held_a ? 0.0 : 1.0 / c->kind_a->mass;
  return c->b == NULL || (axis == 2 && c->held_b) ? of_a : of_a + 1.0 / c->kind_b->mass;
}

/* The motion of a and b past each other, which an impulse along n does not change: u = v_a - v_b - closing m W n, with the
 * mobilities W and m = 1/(n.W n). Returns its energy, u.u/W / 2. */
static double passing(const contact *c, double m, double closing, double u[3]) {
  double energy = 0.0;
  for (int k = 0; k < 3; k++) {
    const double W = mobility(c, k);
    u[k] = c->a->v[k] - (c->b != NULL ? c->b->v[k] : 0.0) - closing * m * W * c->n[k];
    energy += 0.5 * u[k] * u[k] / W;
  }
  return energy;
}

/* The speed at which a slow contact parts, `s` or less; takes the energy that it needs more from the spins and, in space, in
 * the same proportion from the motion past each other. `m`: the reduced mass along n. */
static double part_slowly(const contact *c, double s, double m, double closing, bool in_space) {
  double u[3] = {0.0};
  const double there = spin_energy(c->kind_a, c->a) + (c->b != NULL ? spin_energy(c->kind_b, c->b) : 0.0) +
                       (in_space ? passing(c, m, closing, u) : 0.0);
  const double taken = fmin(0.5 * m * (s * s - closing * closing), 0.5 * there);
  if (!(taken > 0.0))
    return fmax(closing, 0.0);
  const double share = sqrt(1.0 - taken / there) * (1.0 - 1e-15);
  slow_spin(c->a, share);
  if (c->b != NULL)
    slow_spin(c->b, share);
  if (in_space) {
    for (int k = 0; k < 3; k++)
      u[k] /= mobility(c, k);
    push(c, 1.0 - share, u);
  }
  return sqrt(closing * closing + 2.0 * taken / m);
}

void carom_line_of_centres(const carom_ball_kind *kind_a, const carom_ball_state *a, const carom_ball_kind *kind_b,
                           const carom_ball_state *b, double n[3]) {
  n[0] = b->r[0] - a->r[0];
  n[1] = b->r[1] - a->r[1];
  n[2] = (carom_flies(b) ? b->r[2] : kind_b->radius) - (carom_flies(a) ? a->r[2] : kind_a->radius);
  const double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int k = 0; k < 3; k++)
    n[k] /= size;
}

/* The phase after a contact, which may have lifted the ball or pushed it down if it was `in_space`. */
static void label_after(bool in_space, const carom_ball_kind *kind, carom_ball_state *s) {
  if (!in_space) {
    carom_label_of(s, kind->radius);
    return;
  }
  if (!carom_flies(s))
    s->r[2] = kind->radius;
  carom_label_in_space(s, kind->radius);
}

static bool is_finite(const carom_ball_state *s) {
  return isfinite(s->v[0] + s->v[1] + s->v[2] + s->w[0] + s->w[1] + s->w[2]);
}

carom_status carom_resolve_balls(carom_sim *sim, int i, int j, carom_ball_state *a, carom_ball_state *b) {
  const carom_ball_kind *kind_a = &sim->ball[i].kind, *kind_b = &sim->ball[j].kind;
  const bool in_space = carom_flies(a) || carom_flies(b) || kind_a->radius != kind_b->radius;
  double n[3], closing = 0.0;
  carom_line_of_centres(kind_a, a, kind_b, b, n);
  for (int k = 0; k < 3; k++)
    closing += (a->v[k] - b->v[k]) * n[k];
  const double slow = carom_slow_speed(sim->slow_instants);
  carom_status status = CAROM_OK;
  if (closing >= slow && in_space) {
    carom_model_spheres(sim, i, j, n, a, b);
  } else if (closing >= slow) {
    status = carom_model_balls(sim, i, j, n, a, b);
  } else {
    count_slow(sim);
    const contact c = {.kind_a = kind_a,
                       .kind_b = kind_b,
                       .a = a,
                       .b = b,
                       .n = n,
                       .held_a = in_space && !carom_flies(a) && n[2] > 0.0,
                       .held_b = in_space && !carom_flies(b) && n[2] < 0.0};
    const double level = n[0] * n[0] + n[1] * n[1];
    const double m = c.held_a || c.held_b ? 1.0 / (level * mobility(&c, 0) + n[2] * n[2] * mobility(&c, 2))
                                          : kind_a->mass * kind_b->mass / (kind_a->mass + kind_b->mass);
    push(&c, m * (closing + part_slowly(&c, slow, m, closing, in_space)), n);
  }
  label_after(in_space, kind_a, a);
  label_after(in_space, kind_b, b);
  return status < 0 ? status : is_finite(a) && is_finite(b) ? CAROM_OK : CAROM_ERROR_OVERFLOW;
}

carom_status carom_resolve_cushion(carom_sim *sim, int i, const carom_due *due, carom_ball_state *s) {
  const carom_ball_kind *kind = &sim->ball[i].kind;
  const carom_nose nose = carom_nose_of(sim->table, due);
  const bool in_space = carom_flies(s);
  double n[3] = {0.0};
  if (in_space) {
    carom_into_nose(sim, kind, due->type, due->b, s->r, n);
  } else if (due->type == CAROM_EVENT_RAIL) {
    n[0] = -sim->features->line[due->b][0];
    n[1] = -sim->features->line[due->b][1];
  } else {
    const carom_jaw *jaw = &sim->table->jaw[due->b];
    n[0] = jaw->centre[0] - s->r[0];
    n[1] = jaw->centre[1] - s->r[1];
    const double size = sqrt(n[0] * n[0] + n[1] * n[1]);
    n[0] /= size;
    n[1] /= size;
  }
  double closing = s->v[0] * n[0] + s->v[1] * n[1] + s->v[2] * n[2];
  const double slow = carom_slow_speed(sim->slow_instants);
  const bool fast = closing >= slow;
  carom_status status = CAROM_OK;
  if (fast) {
    status = in_space ? carom_model_nose(sim, i, n, &nose, s) : carom_model_cushion(sim, i, n, &nose, s);
    closing = s->v[0] * n[0] + s->v[1] * n[1] + s->v[2] * n[2];
  }
  /* slow, or left moving into the cushion by the model, as the file's head says */
  if (!fast || closing > 0.0) {
    count_slow(sim);
    const contact c = {.kind_a = kind, .a = s, .n = n};
    const double part = closing < slow ? part_slowly(&c, slow, kind->mass, closing, in_space) : slow;
    for (int k = 0; k < 3; k++)
      s->v[k] -= (closing + part) * n[k];
  }
  label_after(in_space, kind, s);
  return status < 0 ? status : is_finite(s) ? CAROM_OK : CAROM_ERROR_OVERFLOW;
}
