/* Layouts of balls whose contacts last, and what carom_cluster() makes of them. */
#ifndef CAROM_TESTS_LAYOUT_H
#define CAROM_TESTS_LAYOUT_H

#include "shot_support.h"

enum { MOST = CAROM_BALLS_MOST, MOST_CONTACTS = 200 };
static const double R = 0.028575, PI = 3.14159265358979323846;

typedef struct layout {
  carom_shot_ball ball[MOST];
  int count;
} layout;

static carom_motion out[MOST];
static carom_cluster_contact contacts[MOST_CONTACTS];
static int contacts_count;

static inline carom_shot_options finely(int steps) {
  return (carom_shot_options){.cluster_steps = steps};
}

static inline void resolve(const layout *l, int steps) {
  const carom_shot_options options = finely(steps);
  const carom_status status =
      carom_cluster(l->ball, l->count, &options, out, contacts, MOST_CONTACTS, &contacts_count);
  ck_assert_msg(status == CAROM_OK, "%s", carom_status_name(status));
}

/* So that nothing rubs: no friction of balls, so no load on the cloth. */
static inline void polish(layout *l) {
  for (int k = 0; k < l->count; k++) {
    l->ball[k].kind.law_a = 0.0;
    l->ball[k].kind.law_b = 0.0;
    l->ball[k].kind.law_c = 1.0;
  }
}

static inline void restitution(layout *l, double e) {
  for (int k = 0; k < l->count; k++)
    l->ball[k].kind.restitution = e;
}

/* Rows of 1, 2, 3 and so on, apex at the origin, behind it +y; ball 0 touches the apex along the
 * angle `aim` from +y. */
static inline layout rack(int game, double gap, double speed, double aim, random_source *random) {
  static const int rows[2][5] = {{1, 2, 3, 4, 5}, {1, 2, 3, 2, 1}};
  const double d = 2.0 * R + gap;
  layout l = {.count = 1};
  for (int row = 0; row < 5; row++) {
    const int n = rows[game == 9][row];
    for (int i = 0; i < n; i++) {
      const double turn = gap > 0.0 ? random_between(random, 0.0, 2.0 * PI) : 0.0;
      const double away = gap > 0.0 ? random_between(random, 0.0, 0.25 * gap) : 0.0;
      l.ball[l.count++] = ball_at((i - 0.5 * (n - 1)) * d + away * cos(turn),
                                  row * d * sqrt(0.75) + away * sin(turn));
    }
  }
  l.ball[0] =
      ball_at(l.ball[1].state.r[0] - 2.0 * R * sin(aim), l.ball[1].state.r[1] - 2.0 * R * cos(aim));
  l.ball[0].state.v[1] = speed;
  return l;
}

#endif
