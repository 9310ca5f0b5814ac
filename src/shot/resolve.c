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
 * same instant, a thousand times where the nose is near the cloth. The same event lets it part as a slow contact does. */
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

/* The speed at which a slow contact parts, `s` or less; takes the energy that it needs more from the spins. `m`: the reduced
 * mass. */
static double part_slowly(double s, double m, double closing, const carom_ball_kind *kind_a, carom_ball_state *a,
                          const carom_ball_kind *kind_b, carom_ball_state *b) {
  const double there = spin_energy(kind_a, a) + (b != NULL ? spin_energy(kind_b, b) : 0.0);
  const double taken = fmin(0.5 * m * (s * s - closing * closing), 0.5 * there);
  if (!(taken > 0.0))
    return fmax(closing, 0.0);
  const double share = sqrt(1.0 - taken / there) * (1.0 - 1e-15);
  slow_spin(a, share);
  if (b != NULL)
    slow_spin(b, share);
  return sqrt(closing * closing + 2.0 * taken / m);
}

carom_status carom_resolve_balls(carom_sim *sim, int i, int j, carom_ball_state *a, carom_ball_state *b) {
  const carom_ball_kind *kind_a = &sim->ball[i].kind, *kind_b = &sim->ball[j].kind;
  double n[2] = {b->r[0] - a->r[0], b->r[1] - a->r[1]};
  const double size = sqrt(n[0] * n[0] + n[1] * n[1]);
  n[0] /= size;
  n[1] /= size;
  const double closing = (a->v[0] - b->v[0]) * n[0] + (a->v[1] - b->v[1]) * n[1];
  const double slow = carom_slow_speed(sim->slow_instants);
  carom_status status = CAROM_OK;
  if (closing >= slow) {
    status = carom_model_balls(sim, i, j, n, a, b);
  } else {
    count_slow(sim);
    const double m = kind_a->mass * kind_b->mass / (kind_a->mass + kind_b->mass);
    const double P = m * (closing + part_slowly(slow, m, closing, kind_a, a, kind_b, b));
    for (int k = 0; k < 2; k++) {
      a->v[k] -= P / kind_a->mass * n[k];
      b->v[k] += P / kind_b->mass * n[k];
    }
  }
  carom_label_of(a, kind_a->radius);
  carom_label_of(b, kind_b->radius);
  return status < 0 ? status : CAROM_OK;
}

carom_status carom_resolve_cushion(carom_sim *sim, int i, const carom_due *due, carom_ball_state *s) {
  const carom_ball_kind *kind = &sim->ball[i].kind;
  const carom_nose nose = carom_nose_of(sim->table, due);
  double n[2];
  if (due->type == CAROM_EVENT_RAIL) {
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
  double closing = s->v[0] * n[0] + s->v[1] * n[1];
  const double slow = carom_slow_speed(sim->slow_instants);
  const bool fast = closing >= slow;
  carom_status status = CAROM_OK;
  if (fast) {
    status = carom_model_cushion(sim, i, n, &nose, s);
    closing = s->v[0] * n[0] + s->v[1] * n[1];
  }
  /* slow, or left moving into the cushion by the model, as the file's head says */
  if (!fast || closing > 0.0) {
    count_slow(sim);
    const double part = closing < slow ? part_slowly(slow, kind->mass, closing, kind, s, NULL, NULL) : slow;
    for (int k = 0; k < 2; k++)
      s->v[k] -= (closing + part) * n[k];
  }
  carom_label_of(s, kind->radius);
  return status < 0 ? status : CAROM_OK;
}
