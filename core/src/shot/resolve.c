/* Contacts in the world carom: where the surfaces touch, at the instant when they touch, by the
 * model.
 *
 * SLOW CONTACTS. A ball that its spin presses against another ball or a cushion bounces in ever
 * smaller hops, infinitely many in a finite time. So a contact that closes at less than s is
 * resolved without friction, and the two part at s: hops
 * then last at least 2 s over the acceleration, and end when the spin that presses is used up.
 * The energy that parting takes more than closing gives, some 1e-8 J at first, is taken from the
 * spin of the balls in contact, so energy never rises; it takes half of the spin's at most, so
 * balls that hardly move part at less than s, but soon stop. Momentum is kept.
 *
 * s grows with the number N of instants that had a slow contact,
 *
 *     s = min(1 mm/s / (1 - N / 1500)^2, 0.2 m/s),
 *
 * so that it is 1.6 mm/s after 300, which few shots have, and 0.2 m/s after 1,394. From then on
 * a ball presses on another at most once in 0.2 s, as the cloth accelerates balls by some 2
 * m/s^2. That bounds the events of balls that press on others: one that pushes a row of 26 along
 * causes a contact of each ball of the row a hop, and balls slide, roll and stop between them.
 * With s at 1 mm/s that would be 100,000 events a second for more than a second. Contacts at one
 * instant count once: there are more of them the more balls touch, and no time passes.
 *
 * 1500 and 0.2 m/s were found with 60,000 random shots of core/tests/shots, `pressed`, by the model
 * han, of which none has more than 7,796 events. With 3000 instead of 1500 237 of 4,000 shots need
 * more than 10,000, with 750 none more than 5,873; with 0.1 m/s 4, with 0.4 m/s none more than
 * 6,838. The growth has a cost: of a row of four balls with 200 rad/s in the first, the last goes
 * 0.760 m, and 0.749 m with s = 0.1 mm/s throughout; of a row of eight 0.035 m, and 0.124 m.
 *
 * CUSHIONS. The formulas of Han and Stronge take the impact along the inclined normal of the
 * nose, and drop the vertical velocity. Where the restitution is small, below some tan^2 of the
 * inclination, or the nose far from the height of the centre, or the ball spins much for its speed,
 * a ball is left that moves into the cushion. It would hit again at the same instant, a thousand
 * times where the nose is near the cloth. The same event lets it part as a slow contact does.
 *
 * IN SPACE. Where a ball flies, or two radii differ, the line of centres and the normal of a nose
 * have a third component, and, far enough from the cloth, the models for spheres are used; the
 * rules above are the same. A ball on the cloth may leave it then: pushed down it is airborne with
 * v_z < 0 and lands at the same instant, as its own event, since two balls part long before ball
 * and cloth do.
 *
 * NEAR THE CLOTH. The cloth holds a ball that a cushion presses down, which takes longer than the
 * contact with the cloth; nose and slate one after the other would let it hop by centimetres. A
 * ball on the cloth has the flat model, a flying ball the model of a free sphere; and with chi = (z
 * - R) / 1 mm < 1 its v and w are (1 - chi) times the flat result plus chi times the free one,
 * where v_z of the flat result is min(v_z, 0). This is continuous at both ends and safe: kinetic
 * energy is convex and neither end has more than before, and both ends part. 1 mm is a convention.
 *
 * Two balls near the cloth are treated in the same way: (1 - phi) times the model on the cloth plus
 * phi times the model of spheres. cluster/cluster.h has phi, which grows with the height and with
 * the tilt of the line of centres, so that it is 0 for equal balls on the cloth. The model on the
 * cloth has its plane through the line of centres then, and leaves velocities across that plane as
 * they are. Both ends part along the line of centres. A ball that is lifted flies, one that is
 * pressed down lands.
 *
 * PRESSED BY WEIGHT. A ball that is on another, or on a nose, is pressed by its weight, which
 * does not end as spin does. So a slow contact in space takes energy from phi of the motion of
 * the balls past each other, too, as opposite impulses on both. The cloth takes an impulse that
 * pushes a ball down at once, without a landing. The upper ball hops as it rolls off.
 *
 * ON TOP. Two balls above each other, n_z > 0.7, have s >= 20 mm/s: hops of the upper one are as
 * high as the least of the slate. Exactly above each other they would hop on one spot for ever. So
 * near the top, at q = sqrt(n_x^2 + n_y^2) < 0.05, they part aside at (1 - q / 0.05) of the speed
 * at which they part upwards, or of 20 mm/s, at least, with the energy that they have. A ball that
 * is balanced there on one that the cloth holds has no such energy: it parts at 10 mm/s at least,
 * as if it had been laid down from 5 um. Energy rises nowhere else, and there by 9 uJ at most. A
 * fall then ends after 130 events in the mean, and after 301 of 2,912 falls at most
 * (core/tests/physics/air.c). */
#include "cluster/cluster.h"
#include "platform/promise.h"
#include "platform/sphere.h"
#include "shot/sim.h"

#include <math.h>

static const double slow_first = 1e-3, slow_most = 0.2; /* m/s */
static const double slow_instants = 1500.0;
/* Rounding, by which a little more is taken from the spin than parting adds. */
#define ROUNDED_ENERGY 1e-15
/* ON TOP: n_z, the s there in m/s, the bound of q, and the speed of a balanced ball, m/s */
static const double steep = 0.7, slow_steep = 0.02, on_top = 0.05, balanced = 0.01;

/* s, above. */
double carom_slow_speed(int64_t instants) {
  const double left = 1.0 - (double)instants / slow_instants;
  CAROM_PROMISE(instants >= 0);
  return left * left * slow_most > slow_first && left > 0.0 ? slow_first / (left * left)
                                                            : slow_most;
}

static void count_slow(carom_sim *sim) {
  sim->slow_instants += sim->time > sim->slow_last;
  sim->slow_last = sim->time;
}

static double spin_energy(const carom_ball_kind *kind, const carom_ball_state *state) {
  const double w2 = carom_space_dot(state->w, state->w);
  return CAROM_SPHERE_ENERGY * kind->mass * kind->radius * kind->radius * w2;
}

static void slow_spin(carom_ball_state *state, double share) {
  for (int axis = 0; axis < 3; axis++)
    state->w[axis] *= share;
}

/* A contact. b is NULL where it is one with a cushion. */
typedef struct contact_pair {
  const carom_ball_kind *kind_a, *kind_b;
  carom_ball_state *a, *b;
  double normal[3];    /* from a to b, or into the cushion */
  bool in_space;       /* a ball flies, or the radii differ */
  double freedom;      /* phi, NEAR THE CLOTH */
  bool held_a, held_b; /* the cloth receives the vertical component of an impulse that pushes the
                          ball down */
} contact_pair;

/* An impulse along a direction, against a and on b. */
static void push(const contact_pair *contact, double impulse, const double along[3]) {
  for (int axis = 0; axis < 3; axis++) {
    if (!(axis == 2 && contact->held_a))
      contact->a->v[axis] -= impulse / contact->kind_a->mass * along[axis];
    if (contact->b != NULL && !(axis == 2 && contact->held_b))
      contact->b->v[axis] += impulse / contact->kind_b->mass * along[axis];
  }
}

/* The change of the relative velocity along an axis for a unit impulse along it. */
static double mobility(const contact_pair *contact, int axis) {
  const double of_a = axis == 2 && contact->held_a ? 0.0 : 1.0 / contact->kind_a->mass;
  return contact->b == NULL || (axis == 2 && contact->held_b) ? of_a
                                                              : of_a + 1.0 / contact->kind_b->mass;
}

/* The reduced mass along n. */
static double reduced_mass(const contact_pair *contact) {
  const double level = carom_plane_dot(contact->normal, contact->normal),
               m_a = contact->kind_a->mass;
  if (contact->b == NULL)
    return m_a;
  return contact->held_a || contact->held_b
             ? 1.0 / (level * mobility(contact, 0) +
                      contact->normal[2] * contact->normal[2] * mobility(contact, 2))
             : m_a * contact->kind_b->mass / (m_a + contact->kind_b->mass);
}

/* The motion of a and b past each other, which an impulse along n does not change: u = v_a - v_b
 * - closing m W n, with the mobilities W and m = 1/(n.W n). Returns its energy, u.u/W / 2. */
static double passing(const contact_pair *contact, double m, double closing, double u[3]) {
  double energy = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    const double W = mobility(contact, axis);
    u[axis] = contact->a->v[axis] - (contact->b != NULL ? contact->b->v[axis] : 0.0) -
              closing * m * W * contact->normal[axis];
    energy += 0.5 * u[axis] * u[axis] / W;
  }
  return energy;
}

/* The speed at which a slow contact parts, `slow` or less; takes the energy that it needs more from
 * the spins and, in space, in the same proportion from the motion past each other. `m`: the
 * reduced mass along n. */
static double part_slowly(const contact_pair *contact, double slow, double m, double closing) {
  double u[3] = {0.0};
  const double spin =
      spin_energy(contact->kind_a, contact->a) +
      (contact->b != NULL ? spin_energy(contact->kind_b, contact->b) : 0.0) +
      (contact->in_space ? contact->freedom * passing(contact, m, closing, u) : 0.0);
  const double lost = fmin(0.5 * m * (slow * slow - closing * closing), 0.5 * spin);
  if (!(lost > 0.0))
    return fmax(closing, 0.0);

  /* the same fraction of all spins and of the motion past each other */
  const double share = sqrt(1.0 - lost / spin) * (1.0 - ROUNDED_ENERGY);
  CAROM_PROMISE(!(share < 0.5 || share > 1.0));
  slow_spin(contact->a, share);
  if (contact->b != NULL)
    slow_spin(contact->b, share);
  if (contact->in_space) {
    const double of_all = sqrt(1.0 - contact->freedom * (1.0 - share * share));
    for (int axis = 0; axis < 3; axis++)
      u[axis] /= mobility(contact, axis);
    push(contact, 1.0 - (contact->freedom < 1.0 ? of_all : share), u);
  }
  return sqrt(closing * closing + 2.0 * lost / m);
}

/* A contact that closes slowly, or that its model has left closing. */
static void resolve_slowly(const contact_pair *contact, double slow, double closing) {
  const double m = reduced_mass(contact), q2 = carom_plane_dot(contact->normal, contact->normal);
  double parting = closing < slow ? part_slowly(contact, slow, m, closing) : slow;
  if ((contact->held_a || contact->held_b) && q2 < on_top * on_top)
    parting = carom_greater(parting, balanced);
  const double change = closing + parting;
  if (contact->b != NULL)
    push(contact, m * change, contact->normal);
  else
    for (int axis = 0; axis < 3; axis++)
      contact->a->v[axis] -= change * contact->normal[axis];
}

/* ON TOP: the smallest fraction of the motion that is sideways. Returns whether it was less. Apart,
 * for the stack of derivatives. */
__attribute__((noinline, cold)) static bool part_aside(const contact_pair *contact, double slow) {
  const double q2 = carom_plane_dot(contact->normal, contact->normal),
               q = q2 > 0.0 ? sqrt(q2) : 0.0;
  if (!(q < on_top))
    return false;

  /* the upper ball seen from the lower one: how fast it moves away from the axis, and up */
  const double up = contact->normal[2] > 0.0 ? 1.0 : -1.0, upward[3] = {0.0, 0.0, 1.0};
  const double outward[3] = {q > 0.0 ? up * contact->normal[0] / q : up,
                             q > 0.0 ? up * contact->normal[1] / q : 0.0, 0.0};
  const double aside = -up * carom_closing(contact->a, contact->b, outward),
               rise = -up * carom_closing(contact->a, contact->b, upward);
  const double least = (1.0 - q / on_top) * (rise > slow ? slow / rise : 1.0);
  if (!(fabs(aside) < least * rise))
    return false;

  /* impulses aside and up change energy each by itself: aside = least rise, and its sum stays */
  const double level = 1.0 / mobility(contact, 0), upright = 1.0 / mobility(contact, 2);
  const double energy = level * aside * aside + upright * rise * rise;
  const double risen = sqrt(energy / (level * least * least + upright)) * (1.0 - ROUNDED_ENERGY);
  push(contact, up * level * (least * risen - aside), outward);
  push(contact, up * upright * (risen - rise), upward);
  return true;
}

/* The phase after a contact. One in space may have lifted the ball or pushed it down. */
void carom_label_after(bool in_space, const carom_ball_kind *kind, carom_ball_state *state) {
  if (!in_space) {
    carom_label_of(state, kind->radius);
    return;
  }
  if (!carom_flies(state))
    state->r[2] = kind->radius;
  carom_label_in_space(state, kind->radius);
}

void carom_into_nose(const carom_table *table, const double line[3], double reference,
                     const carom_ball_kind *kind, const carom_due *pending_event,
                     const carom_ball_state *state, double N[3]) {
  const double *centre = state->r;
  double out[2], across, height; /* the horizontal direction from the nose to the centre; the
                                    distance from the wall */
  if (pending_event->type == CAROM_EVENT_RAIL) {
    out[0] = line[0];
    out[1] = line[1];
    across = carom_plane_dot(line, centre) + line[2];
    height = table->rail[pending_event->b].height;
  } else {
    const carom_jaw *jaw = &table->jaw[pending_event->b];
    const double x = centre[0] - jaw->centre[0], y = centre[1] - jaw->centre[1],
                 distance = sqrt(x * x + y * y);
    out[0] = distance > 0.0 ? x / distance : 0.0;
    out[1] = distance > 0.0 ? y / distance : 0.0;
    across = distance - jaw->radius;
    height = jaw->height;
  }

  /* a ball on the cloth meets the wall, one that flies the nose itself */
  N[0] = -out[0];
  N[1] = -out[1];
  N[2] = 0.0;
  if (!carom_flies(state))
    return;
  const double nose = carom_nose_height(kind, height), up = centre[2] - nose;
  across -= carom_nose_shift(nose, reference);
  const double size = sqrt(across * across + up * up);
  N[0] = -across / size * out[0];
  N[1] = -across / size * out[1];
  N[2] = -up / size;
}

double carom_height_on_top(const carom_sim *sim, int ball, int part) {
  const carom_ball_kind *kind = sim->layout->kind[ball];
  const int jaw = part - sim->features->rails;
  return carom_nose_height(kind,
                           jaw < 0 ? sim->table->rail[part].height : sim->table->jaw[jaw].height) +
         kind->radius;
}

void carom_contact_normal(const carom_sim *sim, const carom_due *pending_event,
                          const carom_ball_state *a, const carom_ball_state *b, double normal[3]) {
  if (b != NULL)
    carom_line_of_centres(sim->layout->kind[pending_event->a], a,
                          sim->layout->kind[pending_event->b], b, normal);
  else
    carom_into_nose(
        sim->table,
        sim->features->line[pending_event->type == CAROM_EVENT_RAIL ? pending_event->b : 0],
        sim->features->reference, sim->layout->kind[pending_event->a], pending_event, a, normal);
}

double carom_closing(const carom_ball_state *a, const carom_ball_state *b, const double normal[3]) {
  double closing = 0.0;
  for (int axis = 0; axis < 3; axis++)
    closing += (a->v[axis] - (b != NULL ? b->v[axis] : 0.0)) * normal[axis];
  return closing;
}

/* Which things touch, along which line, and what the cloth holds. */
static void find_contact(const carom_sim *sim, const carom_due *pending_event, carom_ball_state *a,
                         carom_ball_state *b, contact_pair *contact) {
  *contact = (contact_pair){.kind_a = sim->layout->kind[pending_event->a], .a = a, .b = b};
  contact->in_space = carom_flies(a);
  carom_contact_normal(sim, pending_event, a, b, contact->normal);
  CAROM_PROMISE(!(fabs(carom_space_dot(contact->normal, contact->normal) - 1.0) > 1e-9));
  if (b == NULL) {
    contact->freedom =
        contact->in_space
            ? carom_lesser(carom_freedom_of_height(a->r[2] - contact->kind_a->radius), 1.0)
            : 0.0;
    return;
  }
  contact->kind_b = sim->layout->kind[pending_event->b];
  contact->in_space =
      contact->in_space || carom_flies(b) || contact->kind_a->radius != contact->kind_b->radius;
  contact->freedom = carom_freedom_of_pair(sim, pending_event, contact->normal, a, b);
  contact->held_a = contact->in_space && !carom_flies(a) && contact->normal[2] > 0.0;
  contact->held_b = contact->in_space && !carom_flies(b) && contact->normal[2] < 0.0;
}

/* The motion by the model, which leaves what the cloth holds to the slate. *closing becomes how
 * fast a ball still moves into a cushion. */
static carom_status take_model(const carom_sim *sim, const carom_due *pending_event,
                               contact_pair *contact, double *closing) {
  contact->held_a = contact->held_b = false;
  if (contact->b != NULL) {
    *closing = 0.0;
    return carom_model_balls(sim, pending_event, contact->normal, contact->in_space, contact->a,
                             contact->b);
  }
  const carom_status status = carom_model_cushion(sim, pending_event, contact->normal, contact->a);
  *closing = carom_closing(contact->a, NULL, contact->normal);
  return status;
}

static bool has_finite_motion(const carom_ball_state *state) {
  return carom_is_finite(state->v) && carom_is_finite(state->w);
}

carom_status carom_resolve(carom_sim *sim, const carom_due *pending_event, carom_ball_state *a,
                           carom_ball_state *b) {
  contact_pair contact;
  find_contact(sim, pending_event, a, b, &contact);
  const bool above = b != NULL && fabs(contact.normal[2]) > steep;
  const double usual = carom_slow_speed(sim->slow_instants),
               speed = carom_closing(a, b, contact.normal),
               slow = above ? carom_greater(usual, slow_steep) : usual;

  /* by the model, or slowly; a ball that the model leaves moving into a cushion separates slowly,
   * as explained above */
  carom_status status = CAROM_OK;
  double closing = speed;
  if (speed >= slow)
    status = take_model(sim, pending_event, &contact, &closing);
  if (speed < slow || closing > 0.0) {
    count_slow(sim);
    resolve_slowly(&contact, slow, closing);
  }
  if (above && part_aside(&contact, slow))
    count_slow(sim);

  /* the phases that follow */
  carom_label_after(contact.in_space, contact.kind_a, a);
  if (b != NULL)
    carom_label_after(contact.in_space, contact.kind_b, b);
  if (status < 0)
    return status;
  const bool good = has_finite_motion(a) && (b == NULL || has_finite_motion(b));
  return good ? CAROM_OK : CAROM_ERROR_OVERFLOW;
}
