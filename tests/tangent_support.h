/* What tests of derivatives of whole shots share: a layout, its numbers as directions, and
 * differences of shots.
 *
 * Differences are of order 4, by 15 steps from 1e-9 to 1e-2 of each number. Of adjacent steps at
 * which all shots have the events of the shot itself, the two that agree best are the reference,
 * whatever the tangents are. By how much they disagree is what a reference can tell. */
#ifndef CAROM_TESTS_TANGENT_SUPPORT_H
#define CAROM_TESTS_TANGENT_SUPPORT_H

#include "carom_tangent.h"
#include "shot_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LAYOUT_BALLS = 16, NUMBERS = CAROM_STATE_NUMBERS, LAYOUT_DIRECTIONS = 24 };

typedef struct layout {
  int count;
  carom_shot_ball ball[LAYOUT_BALLS];
  carom_cue cue;
} layout;

/* A number of a layout: of the cue, of the state of a ball, or a constant of a ball, -1 for all
 * of them; its row among the seeds, and a typical size. */
typedef struct direction {
  enum { OF_CUE, OF_STATE, OF_KIND } of;
  int ball, row;
  double unit;
} direction;

/* The numbers of a state among the doubles of a carom_ball_state. */
static const int number_at[] = {0, 1, 3, 4, 6, 7, 8, 2, 5};

static inline void numbers_of(const carom_ball_state *s, double to[NUMBERS]) {
  for (int k = 0; k < NUMBERS; k++)
    to[k] = ((const double *)s)[number_at[k]];
}

static inline void change(layout *l, const direction *d, double by) {
  if (d->of == OF_CUE) {
    ((double *)&l->cue)[d->row] += by;
    return;
  }
  for (int i = d->ball < 0 ? 0 : d->ball; i < (d->ball < 0 ? l->count : d->ball + 1); i++)
    if (d->of == OF_STATE) {
      ((double *)&l->ball[i].state)[number_at[d->row]] += by;
    } else {
      const bool lies = l->ball[i].state.r[2] == l->ball[i].kind.radius;
      ((double *)&l->ball[i].kind)[d->row] += by;
      l->ball[i].state.r[2] += lies && d->row == 1 ? by : 0.0; /* the radius */
    }
}

/* Seeds of m directions, which stand until the next call. */
static inline carom_tangent_seeds seeds_of(const direction *d, int m) {
  static double cue[CAROM_CUE_NUMBERS * LAYOUT_DIRECTIONS],
      state[LAYOUT_BALLS * NUMBERS * LAYOUT_DIRECTIONS],
      kind[LAYOUT_BALLS * sizeof(carom_ball_kind) / sizeof(double) * LAYOUT_DIRECTIONS];
  memset(cue, 0, sizeof cue);
  memset(state, 0, sizeof state);
  memset(kind, 0, sizeof kind);
  for (int j = 0; j < m; j++)
    for (int i = d[j].ball < 0 ? 0 : d[j].ball; i < (d[j].ball < 0 ? LAYOUT_BALLS : d[j].ball + 1);
         i++)
      if (d[j].of == OF_CUE)
        cue[d[j].row * m + j] = 1.0;
      else if (d[j].of == OF_STATE)
        state[(i * NUMBERS + d[j].row) * m + j] = 1.0;
      else
        kind[(i * CAROM_KIND_NUMBERS + d[j].row) * m + j] = 1.0;
  return (carom_tangent_seeds){.directions = m, .cue = cue, .kind = kind, .state = state};
}

/* The final numbers of a shot, if it has the same events as `shot`. */
static inline bool plays_alike(const carom_table *table, const layout *l,
                               const carom_shot_options *options, const carom_shot *shot,
                               double *to) {
  static carom_event other[ROOM];
  carom_ball_state end[LAYOUT_BALLS];
  carom_shot s = {.events = other, .room = ROOM, .final = end};
  if (carom_shoot(table, l->ball, l->count, &l->cue, options, &s) < CAROM_OK ||
      s.count != shot->count)
    return false;
  for (int64_t k = 0; k < s.count; k++)
    if (other[k].type != shot->events[k].type || other[k].a != shot->events[k].a ||
        other[k].b != shot->events[k].b)
      return false;
  for (int i = 0; i < l->count; i++)
    numbers_of(&end[i], to + NUMBERS * i);
  return true;
}

/* Largest difference of the tangents in column j of m from the best plateau, and by how much
 * that itself disagrees; false if there is none. */
static inline bool compare(const carom_table *table, const layout *l,
                           const carom_shot_options *options, const carom_shot *shot,
                           const direction *by, const double *tangent, int j, int m, double *error,
                           double *plateau) {
  double last[NUMBERS * LAYOUT_BALLS] = {0};
  bool had = false;
  *plateau = *error = INFINITY;
  for (int step = 0; step < 15; step++) {
    const double h = pow(10.0, -9.0 + 0.5 * step) * by->unit;
    static const double steps[4] = {-2, -1, 1, 2};
    double f[4][NUMBERS * LAYOUT_BALLS], apart = 0.0, off = 0.0;
    bool same = true;
    for (int s = 0; s < 4 && same; s++) {
      layout changed = *l;
      change(&changed, by, steps[s] * h);
      same = plays_alike(table, &changed, options, shot, f[s]);
    }
    for (int x = 0; x < NUMBERS * l->count && same; x++) {
      const double d = (8.0 * (f[2][x] - f[1][x]) - (f[3][x] - f[0][x])) / (12.0 * h);
      apart = fmax(apart, had ? fabs(d - last[x]) : INFINITY);
      off = fmax(off, fabs(d - tangent[x * m + j]));
      last[x] = d;
    }
    had = same;
    if (same && apart < *plateau) {
      *plateau = apart;
      *error = off;
    }
  }
  return *plateau < INFINITY;
}

static inline double largest(const double *tangent, int numbers, int j, int m) {
  double most = 0.0;
  for (int x = 0; x < numbers; x++)
    most = fmax(most, fabs(tangent[x * m + j]));
  return most;
}

static inline const carom_table *table_of_pool(void) {
  static carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  return &table;
}

/* Balls at random on the table, of which the first is shot at the second. */
static inline layout draw(random_source *random, int most) {
  layout l = {.count = 2 + (int)random_between(random, 0.0, most - 1.001),
              .cue = carom_cue_of(CAROM_GAME_POOLTOOL_POOL)};
  for (int i = 0; i < l.count;) {
    const double y = random_between(random, 0.05, 2.49);
    l.ball[i] = ball_at(random_between(random, 0.05, 1.22), y);
    bool alone = true;
    for (int j = 0; j < i; j++)
      alone &= hypot(l.ball[i].state.r[0] - l.ball[j].state.r[0],
                     l.ball[i].state.r[1] - l.ball[j].state.r[1]) > 0.07;
    i += alone;
  }
  const double *to = l.ball[1].state.r, *from = l.ball[0].state.r;
  l.cue.speed = random_between(random, 0.8, 5.0);
  l.cue.phi = 57.29577951308232 * atan2(to[1] - from[1], to[0] - from[0]) +
              random_between(random, -1.5, 1.5);
  l.cue.a = random_between(random, -0.3, 0.3);
  l.cue.b = random_between(random, -0.4, 0.4);
  return l;
}

#endif
