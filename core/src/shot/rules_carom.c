/* The rules of the world carom: the order of simultaneous events, and which zeros of a gap are
 * contacts.
 *
 * Events within 1e-12 s of the earliest count as simultaneous, since rounding decides between them.
 * Of those, the order is: balls that fall into pockets, then ends of phases on the cloth and balls
 * that leave the table, then contacts, including landings, the fastest closing first; if the speeds
 * are equal to a part in 1e9, the lower index first, and for one ball its landing, then cushions,
 * then balls. So a symmetrical layout is resolved in an order that rounding does not change.
 *
 * A contact is where a gap is 0 and closing (gap.c). */
#include "motion/gap.h"
#include "shot/rules.h"

#include <math.h>
#include <stddef.h>

static const double equal_speeds = 1e-9; /* relative */

/* ---- The order of simultaneous events */

/* How fast the contact closes, m/s. */
static double closing_speed(const carom_sim *sim, const carom_due *pending_event) {
  carom_ball_state a, b;
  double normal[3];
  carom_path_at(&sim->path[pending_event->a], &sim->rates[pending_event->a], pending_event->time,
                &a);
  if (pending_event->type == CAROM_EVENT_SLATE || pending_event->type == CAROM_EVENT_RAIL_TOP)
    return -a.v[2];
  const bool two = pending_event->type == CAROM_EVENT_BALL_BALL;
  if (two)
    carom_path_at(&sim->path[pending_event->b], &sim->rates[pending_event->b], pending_event->time,
                  &b);
  const carom_ball_state *partner = NULL;
  if (two)
    partner = &b;
  carom_contact_normal(sim, pending_event, &a, partner, normal);
  return carom_closing(&a, partner, normal);
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

static carom_due choose(const carom_sim *sim, const carom_due *pending_events, int count) {
  int best = 0;
  double speed = -1.0; /* of the best, where it is a contact and had to be compared */
  for (int index = 1; index < count; index++) {
    const int order = rank(pending_events[index].type) - rank(pending_events[best].type);
    if (order > 0 || (order == 0 && rank(pending_events[index].type) < 2))
      continue;
    if (order == 0) {
      if (speed < 0.0)
        speed = closing_speed(sim, &pending_events[best]);
      const double candidate = closing_speed(sim, &pending_events[index]);
      if (!(candidate > speed * (1.0 + equal_speeds)))
        continue;
      speed = candidate;
    } else {
      speed = -1.0;
    }
    best = index;
  }
  return pending_events[best];
}

/* ---- Contacts */

static int touch_rail(const double gap[3], double horizon, double times[2]) {
  if (gap[0] < -CAROM_BEHIND) { /* coming out of the cushion's back and falling onto it is the only
                                 way */
    const double discriminant = gap[1] * gap[1] - 4.0 * gap[2] * gap[0];
    times[0] = INFINITY;
    if (gap[2] < 0.0 && discriminant > 0.0 && gap[1] > 0.0)
      times[0] = (-gap[1] - sqrt(discriminant)) / (2.0 * gap[2]);
  } else {
    times[0] = carom_first_touch(gap, CAROM_SLACK, horizon);
  }
  return times[0] <= horizon;
}

/* A ball in a pocket's circle is there by rounding, at an event on the circle; a layout has no ball
 * in there. */
static double enter_pocket(const carom_separation *separation, double radius, double horizon) {
  if (carom_plane_dot(separation->d0, separation->d0) <= radius * radius)
    return 0.0;
  return carom_first_crossing(separation, radius, horizon);
}

static const carom_rules rules = {
    .clusters = true,
    .simultaneous = 1e-12,
    .euler_slip = CAROM_SLIP_PAPER,
    .convention = CAROM_CONVENTION_PAPER,
    .choose = choose,
    .touch_rail = touch_rail,
    .touch_jaw = carom_first_contact,
    .touch_ball = carom_first_contact,
    .enter_pocket = enter_pocket,
    .resolve = carom_resolve,
};

const carom_rules *carom_rules_carom(void) {
  return &rules;
}
