/* The slip of an event, for sounds: how fast the two surfaces pass each other as they meet. */
#include "shot/sim.h"

#include <math.h>
#include <stdint.h>

static carom_ball moving(const carom_ball_kind *kind, const carom_ball_state *state) {
  return (carom_ball){.v = {state->v[0], state->v[1], state->v[2]},
                      .w = {state->w[0], state->w[1], state->w[2]},
                      .radius = kind->radius};
}

/* Whether an event is one of this table and of balls 0 to count - 1. */
static bool is_of_shot(const carom_table *table, int count, const carom_event *event) {
  const bool has_balls = count >= 1 && count <= CAROM_BALLS_MOST;
  const bool has_parts = table->rails >= 0 && table->rails <= CAROM_RAILS_MOST &&
                         table->jaws >= 0 && table->jaws <= CAROM_JAWS_MOST;
  return has_balls && has_parts && event->a >= 0 && event->a < count;
}

/* The unit vector from the ball's centre into the nose of a rail or a jaw, or down. */
static void find_normal(const carom_table *table, const carom_event *event, double usual_radius,
                        const carom_ball_kind *kind, double normal[3]) {
  if (event->type != CAROM_EVENT_RAIL && event->type != CAROM_EVENT_JAW) {
    normal[0] = normal[1] = 0.0;
    normal[2] = -1.0;
    return;
  }
  const carom_due contact = {.type = event->type, .a = event->a, .b = event->b};
  double line[3] = {0.0};
  if (event->type == CAROM_EVENT_RAIL)
    carom_rail_line(&table->rail[event->b], line);
  carom_into_nose(table, line, carom_reference_of(table, usual_radius), kind, &contact,
                  &event->before[0], normal);
}

double carom_event_slip(const carom_table *table, const carom_shot_ball *balls, int count,
                        const carom_event *event) {
  if (table == NULL || balls == NULL || event == NULL || !is_of_shot(table, count, event))
    return NAN;
  const int64_t parts = carom_others_of(table, count, event->type);
  const bool slate = event->type == CAROM_EVENT_SLATE;
  if (event->type == CAROM_EVENT_POCKET || (parts == INT64_MAX && !slate))
    return 0.0;
  if (!slate && (event->b < 0 || event->b >= parts))
    return NAN;

  const carom_ball_kind *kind = &balls[event->a].kind;
  const carom_ball_state *state = &event->before[0];
  double normal[3];
  if (event->type == CAROM_EVENT_BALL_BALL) {
    const carom_ball_kind *partner = &balls[event->b].kind;
    carom_line_of_centres(kind, state, partner, &event->before[1], normal);
    const carom_impact in = {.a = moving(kind, state), .b = moving(partner, &event->before[1])};
    return carom_spheres_slip(&in, normal);
  }
  find_normal(table, event, balls[count - 1].kind.radius, kind, normal);
  return carom_touch_of(normal, kind->radius, state).slip;
}
