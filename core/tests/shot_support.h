/* What tests of complete shots share: playing one with room for its events, a large empty table, a
 * ball on it. */
#ifndef CAROM_TESTS_SHOT_SUPPORT_H
#define CAROM_TESTS_SHOT_SUPPORT_H

#include "carom_shot.h"
#include "support.h"

enum { ROOM = 12000 };
static carom_event events[ROOM];
static carom_ball_state final[CAROM_BALLS_MOST];

/* A shot that is not yet played, whose events and final states go to events[] and final[]. */
static inline carom_shot empty_shot(void) {
  return (carom_shot){.events = events, .room = ROOM, .final = final};
}

/* Plays a shot into events[] and final[], which must end with this status. */
static inline carom_shot play(const carom_table *table, const carom_shot_ball *balls, int count,
                              const carom_cue *cue, const carom_shot_options *options,
                              carom_status expected) {
  carom_shot shot = empty_shot();
  const carom_status status = carom_shoot(table, balls, count, cue, options, &shot);
  ck_assert_msg(status == expected, "%s, not %s", carom_status_name(status),
                carom_status_name(expected));
  return shot;
}

/* Four rails and nothing else. */
static inline carom_table empty_table(double size) {
  carom_table t = {.width = size, .length = size, .rails = 4};
  const double corner[5][2] = {{0.0, 0.0}, {size, 0.0}, {size, size}, {0.0, size}, {0.0, 0.0}};
  for (int k = 0; k < 4; k++)
    t.rail[k] = (carom_rail){.p = {corner[k][0], corner[k][1]},
                             .q = {corner[k + 1][0], corner[k + 1][1]},
                             .height = 0.036576,
                             .side = 1};
  return t;
}

/* A ball of the size of pool at rest. Its cushions have restitution and friction alone, and the
 * noses of the table. */
static inline carom_shot_ball ball_at(double x, double y) {
  carom_shot_ball b = {.kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL)};
  b.state.r[0] = x;
  b.state.r[1] = y;
  b.state.r[2] = b.kind.radius;
  return b;
}

/* One that rolls in the direction `way`, rad. */
static inline carom_shot_ball rolling(double x, double y, double speed, double way) {
  carom_shot_ball b = ball_at(x, y);
  b.state.v[0] = speed * cos(way);
  b.state.v[1] = speed * sin(way);
  b.state.w[0] = -b.state.v[1] / b.kind.radius;
  b.state.w[1] = b.state.v[0] / b.kind.radius;
  return b;
}

/* The impact of a ball of a kind on a cushion; the nose of pool where the kind has none. */
static inline carom_cushion_impact at_cushion(const carom_ball_kind *k, const double v[3],
                                              const double w[3], double n_x, double n_y) {
  return (carom_cushion_impact){.v = {v[0], v[1], v[2]},
                                .w = {w[0], w[1], w[2]},
                                .normal = {n_x, n_y},
                                .height = k->nose_height > 0.0 ? k->nose_height : 0.036576,
                                .radius = k->radius,
                                .mass = k->mass,
                                .mu_slide = k->mu_slide,
                                .mu_cushion = k->mu_cushion,
                                .restitution = k->restitution_cushion};
}

#define NEAR(is, says, within)                                                                \
  ck_assert_msg(fabs((is) - (says)) <= (within), "%s is %.12g, not %.12g", #is, (double)(is), \
                (double)(says))

/* A pool ball that moves, with its centre at z. */
static inline carom_shot_ball flying(double x, double y, double z, double v_x, double v_y,
                                     double v_z) {
  carom_shot_ball b = ball_at(x, y);
  const double v[3] = {v_x, v_y, v_z};
  b.state.r[2] = z;
  memcpy(b.state.v, v, sizeof v);
  return b;
}

static inline double state_energy(const carom_ball_kind *k, const carom_ball_state *s) {
  double sum = k->mass * k->gravity * (s->r[2] - k->radius);
  for (int axis = 0; axis < 3; axis++)
    sum += 0.5 * k->mass *
           (s->v[axis] * s->v[axis] + 0.4 * k->radius * k->radius * s->w[axis] * s->w[axis]);
  return sum;
}

/* The n-th event of a type, from 0; NULL where there are fewer. */
static inline const carom_event *event_of(const carom_shot *shot, int type, int n) {
  for (int64_t k = 0; k < shot->count; k++)
    if (events[k].type == type && n-- == 0)
      return &events[k];
  return NULL;
}

/* Gives each ball of a layout the terms of measured tables, drawn for each by itself; a third of
 * the balls have none. */
static inline void give_terms(carom_shot_ball *balls, int count, random_source *random) {
  for (int k = 0; k < count; k++) {
    carom_ball_kind *kind = &balls[k].kind;
    if (random_between(random, 0.0, 3.0) < 1.0)
      continue;
    kind->drag = random_between(random, 0.0, 2.0) < 1.0 ? 0.0129 : random_between(random, 0.0, 1.0);
    kind->roll_loss =
        random_between(random, 0.0, 2.0) < 1.0 ? 0.087 : random_between(random, 0.0, 1.0);
    kind->law_a = random_between(random, 0.0, 0.06);
    kind->law_b = random_between(random, 0.0, 0.06);
    kind->law_c = random_between(random, 0.0, 3.0);
    kind->nose_height = random_between(random, 1.0, 1.4) * kind->radius;
    kind->omega_ratio = random_between(random, 1.3, 1.95);
  }
}

#endif
