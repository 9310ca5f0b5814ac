/* The rules of the world carom: the order of simultaneous events, and which zeros of a gap are contacts.
 *
 * Events within 1e-12 s of the earliest count as simultaneous, since rounding decides between them. Of those, balls that fall
 * into pockets come first, then ends of phases on the cloth and balls that leave the table, then contacts, landings among them,
 * the one that closes fastest first; where that too is equal to a part in 1e9, the one of the lower index, and of one ball its
 * landing, then cushions, then balls. So a symmetrical layout is resolved in an order that rounding does not change.
 *
 * A contact is where a gap is 0 and closing (contact.c). */
#include "shot/contact.h"
#include "shot/rules.h"

#include <math.h>

static const double equal_speeds = 1e-9; /* relative */

/* ---- The order of simultaneous events */

/* How fast a contact of a ball that flies, or of unlike balls, closes. */
static double closing_in_space(const carom_sim *sim, const carom_due *due, const carom_ball_state *a) {
  if (due->type == CAROM_EVENT_SLATE || due->type == CAROM_EVENT_RAIL_TOP)
    return -a->v[2];
  carom_ball_state b = {.v = {0.0}};
  double n[3], closing = 0.0;
  if (due->type == CAROM_EVENT_BALL_BALL) {
    carom_path_at(&sim->path[due->b], &sim->rates[due->b], due->time, &b);
    carom_line_of_centres(&sim->ball[due->a].kind, a, &sim->ball[due->b].kind, &b, n);
  } else {
    carom_into_nose(sim, &sim->ball[due->a].kind, due->type, due->b, a->r, n);
  }
  for (int k = 0; k < 3; k++)
    closing += (a->v[k] - b.v[k]) * n[k];
  return closing;
}

/* How fast the contact closes, m/s. */
static double closing_speed(const carom_sim *sim, const carom_due *due) {
  carom_ball_state a, b = {.v = {0.0}};
  double n[2];
  carom_path_at(&sim->path[due->a], &sim->rates[due->a], due->time, &a);
  const int64_t other = due->type == CAROM_EVENT_BALL_BALL ? sim->path[due->b].from.label : CAROM_BALL_STATIONARY;
  if (a.label == CAROM_BALL_AIRBORNE || other == CAROM_BALL_AIRBORNE || (sim->unlike && due->type == CAROM_EVENT_BALL_BALL))
    return closing_in_space(sim, due, &a);
  if (due->type == CAROM_EVENT_RAIL) {
    n[0] = -sim->features->line[due->b][0];
    n[1] = -sim->features->line[due->b][1];
  } else {
    if (due->type == CAROM_EVENT_BALL_BALL)
      carom_path_at(&sim->path[due->b], &sim->rates[due->b], due->time, &b);
    const double *to = due->type == CAROM_EVENT_JAW ? sim->table->jaw[due->b].centre : b.r;
    n[0] = to[0] - a.r[0];
    n[1] = to[1] - a.r[1];
    const double size = sqrt(n[0] * n[0] + n[1] * n[1]);
    n[0] /= size;
    n[1] /= size;
  }
  return (a.v[0] - b.v[0]) * n[0] + (a.v[1] - b.v[1]) * n[1];
}

static int rank(int type) {
  switch (type) {
  case CAROM_EVENT_POCKET:
    return 0;
  case CAROM_EVENT_BALL_BALL:
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
  case CAROM_EVENT_SLATE:
  case CAROM_EVENT_RAIL_TOP:
    return 2;
  default:
    return 1;
  }
}

static carom_due choose(const carom_sim *sim, const carom_due *due, int count) {
  int best = 0;
  double speed = -1.0; /* of the best, where it is a contact and had to be compared */
  for (int k = 1; k < count; k++) {
    const int order = rank(due[k].type) - rank(due[best].type);
    if (order > 0 || (order == 0 && rank(due[k].type) < 2))
      continue;
    if (order == 0) {
      speed = speed < 0.0 ? closing_speed(sim, &due[best]) : speed;
      const double other = closing_speed(sim, &due[k]);
      if (!(other > speed * (1.0 + equal_speeds)))
        continue;
      speed = other;
    } else {
      speed = -1.0;
    }
    best = k;
  }
  return due[best];
}

/* ---- Contacts */

static int touch_rail(const double g[3], double T, double times[2]) {
  if (g[0] < -CAROM_BEHIND) { /* coming out of the cushion's back and falling onto it is the only way */
    const double D = g[1] * g[1] - 4.0 * g[2] * g[0];
    times[0] = g[2] < 0.0 && D > 0.0 && g[1] > 0.0 ? (-g[1] - sqrt(D)) / (2.0 * g[2]) : INFINITY;
  } else {
    times[0] = carom_first_touch(g, CAROM_SLACK, T);
  }
  return times[0] <= T;
}

/* A ball in a pocket's circle is there by rounding, at an event on the circle: a layout has none in there. */
static double enter_pocket(const carom_separation *d, double radius, double T) {
  return d->d0[0] * d->d0[0] + d->d0[1] * d->d0[1] <= radius * radius ? 0.0 : carom_first_crossing(d, radius, T);
}

static const carom_rules rules = {
    .simultaneous = 1e-12,
    .ball_model = CAROM_BALL_MODEL_EXACT,
    .cushion_model = CAROM_CUSHION_HAN,
    .euler_slip = CAROM_SLIP_PAPER,
    .convention = CAROM_CONVENTION_PAPER,
    .choose = choose,
    .touch_rail = touch_rail,
    .touch_jaw = carom_first_contact,
    .touch_ball = carom_first_contact,
    .enter_pocket = enter_pocket,
    .balls = carom_resolve_balls,
    .cushion = carom_resolve_cushion,
};

const carom_rules *carom_rules_carom(void) {
  return &rules;
}
