/* What tests of derivatives of complete shots share: a layout, its numbers as directions, and
 * differences of shots.
 *
 * Differences are of order 4, by 15 steps from 1e-9 to 1e-2 of each number. Of adjacent steps at
 * which all shots have the events of the shot itself, the two that agree best are the reference,
 * whatever the tangents are. By how much they disagree is what a reference can tell. */
#ifndef CAROM_TESTS_TANGENT_SUPPORT_H
#define CAROM_TESTS_TANGENT_SUPPORT_H

#include "carom_tangent.h"
#include "shot_support.h"

enum { LAYOUT_BALLS = 16, NUMBERS = CAROM_STATE_NUMBERS, LAYOUT_DIRECTIONS = 24 };
/* Numbers of a table: those of noses, then its slope along x and y. */
enum { SLOPE = CAROM_NOSE_NUMBERS, TABLE_NUMBERS = SLOPE + 2 };

/* All that a shot is played with. */
typedef struct layout {
  int count;
  carom_shot_ball ball[LAYOUT_BALLS];
  carom_cue cue;
  const carom_table *table;   /* NULL: of pool */
  double nose[TABLE_NUMBERS]; /* what its rails and jaws have more, and its slope */
  carom_shot_options options;
} layout;

/* A number of a layout: of the cue, of the state of a ball, or a constant of a ball, -1 for all
 * of them, or of the table; its row among the seeds, and a typical size. */
typedef enum direction_of { OF_OPTIONS = -1, OF_CUE, OF_STATE, OF_KIND, OF_NOSES } direction_of;
typedef struct direction {
  direction_of of;
  int ball, row;
  double unit;
} direction;

/* The numbers of a state among the doubles of a carom_ball_state. */
static const int number_at[] = {0, 1, 3, 4, 6, 7, 8, 2, 5};

static inline void numbers_of(const carom_ball_state *s, double to[NUMBERS]) {
  for (int k = 0; k < NUMBERS; k++)
    to[k] = ((const double *)s)[number_at[k]];
}

/* The table of a layout, which is valid until the next call: of 9 ft with pooltool's pockets, where
 * the edges of these tests are. */
static inline const carom_table *table_of(const layout *l) {
  static carom_table table, nine_feet;
  if (nine_feet.rails == 0) {
    carom_measures m;
    carom_table_measures(CAROM_TABLE_POOLTOOL, &m);
    m.width = 1.27;
    m.length = 2.54;
    carom_table_measured(&m, 0.028575, &nine_feet, NULL);
  }
  table = l->table != NULL ? *l->table : nine_feet;
  for (int k = 0; k < table.rails; k++) {
    table.rail[k].height += l->nose[0];
    table.rail[k].mu_cushion += l->nose[1];
    table.rail[k].restitution += l->nose[2];
  }
  for (int k = 0; k < table.jaws; k++) {
    table.jaw[k].height += l->nose[0];
    table.jaw[k].mu_cushion += l->nose[1];
    table.jaw[k].restitution += l->nose[2];
  }
  table.slope_x = l->nose[SLOPE];
  table.slope_y = l->nose[SLOPE + 1];
  return &table;
}

static inline void change(layout *l, const direction *d, double by) {
  if (d->of == OF_NOSES) {
    l->nose[d->row] += by;
    return;
  }
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

/* Seeds of m directions, which are valid until the next call. */
static inline carom_tangent_seeds seeds_of(const direction *d, int m) {
  static double cue[CAROM_CUE_NUMBERS * LAYOUT_DIRECTIONS],
      state[LAYOUT_BALLS * NUMBERS * LAYOUT_DIRECTIONS],
      kind[LAYOUT_BALLS * sizeof(carom_ball_kind) / sizeof(double) * LAYOUT_DIRECTIONS],
      noses[TABLE_NUMBERS * LAYOUT_DIRECTIONS];
  memset(cue, 0, sizeof cue);
  memset(state, 0, sizeof state);
  memset(kind, 0, sizeof kind);
  memset(noses, 0, sizeof noses);
  for (int j = 0; j < m; j++)
    for (int i = d[j].ball < 0 ? 0 : d[j].ball; i < (d[j].ball < 0 ? LAYOUT_BALLS : d[j].ball + 1);
         i++)
      if (d[j].of == OF_CUE)
        cue[d[j].row * m + j] = 1.0;
      else if (d[j].of == OF_NOSES)
        noses[d[j].row * m + j] = 1.0;
      else if (d[j].of == OF_STATE)
        state[(i * NUMBERS + d[j].row) * m + j] = 1.0;
      else
        kind[(i * CAROM_KIND_NUMBERS + d[j].row) * m + j] = 1.0;
  return (carom_tangent_seeds){.directions = m,
                               .cue = cue,
                               .kind = kind,
                               .state = state,
                               .table = noses,
                               .slope = noses + SLOPE * m};
}

static inline carom_status shoot(const layout *l, carom_shot *s) {
  return carom_shoot(table_of(l), l->ball, l->count, l->cue.speed > 0.0 ? &l->cue : NULL,
                     &l->options, s);
}

/* The shot that was played last, with events[] and final[], and its derivatives. */
static carom_shot shot;
static double ends[LAYOUT_BALLS * NUMBERS * LAYOUT_DIRECTIONS], times[ROOM * LAYOUT_DIRECTIONS],
    reach[LAYOUT_DIRECTIONS];
static int32_t event_flags[ROOM];
static double largest_error; /* of all derivatives so far that were found by differences */

/* By seeds, the derivatives of the shot that was played last. */
static inline carom_status shot_tangent(const layout *l, const carom_tangent_seeds *seeds,
                                        carom_tangent *t) {
  return carom_shot_tangent(table_of(l), l->ball, l->count, &l->cue, &l->options, &shot, seeds, t);
}

/* The derivatives of the shot that was played last, with all its flags. */
static inline carom_status tangent_of(const layout *l, const direction *by, int m, int64_t *flags) {
  const carom_tangent_seeds seeds = seeds_of(by, m);
  carom_tangent t = {.final = ends, .time = times, .flags = event_flags, .reach = reach};
  const carom_status status = shot_tangent(l, &seeds, &t);
  *flags = t.all_flags;
  const double most = (t.all_flags & CAROM_TANGENT_DIFFERENCES) ? 1e-4 : 0.0;
  ck_assert((t.all_flags & CAROM_TANGENT_KINK) || t.error <= most);
  largest_error = fmax(largest_error, t.error);
  return status;
}
static inline int64_t derive(const layout *l, const direction *by, int m) {
  int64_t flags;
  const carom_status status = tangent_of(l, by, m, &flags);
  ck_assert_msg(status == CAROM_OK, "%s", carom_status_name(status));
  return flags;
}

/* Plays a shot, without an error, and derives it. */
static inline int64_t differentiate(const layout *l, const direction *by, int m) {
  shot = empty_shot();
  const carom_status status = shoot(l, &shot);
  ck_assert_msg(status >= CAROM_OK, "%s", carom_status_name(status));
  return derive(l, by, m);
}

/* Plays a layout of which a number is changed; its events and its end are valid until the next
 * call. */
static inline carom_status shoot_changed(const layout *l, const direction *by, double change_of,
                                         carom_shot *s) {
  static carom_event other[ROOM];
  static carom_ball_state end[LAYOUT_BALLS];
  layout changed = *l;
  change(&changed, by, change_of);
  *s = (carom_shot){.events = other, .room = ROOM, .final = end};
  return shoot(&changed, s);
}

/* The final numbers of a layout of which one is changed, if it has the same events as the shot
 * that was played last. */
static inline bool plays_alike(const layout *l, const direction *by, double change_of, double *to) {
  carom_shot s;
  if (shoot_changed(l, by, change_of, &s) < CAROM_OK || s.count != shot.count)
    return false;
  for (int64_t k = 0; k < s.count; k++)
    if (s.events[k].type != events[k].type || s.events[k].a != events[k].a ||
        s.events[k].b != events[k].b)
      return false;
  for (int i = 0; i < l->count; i++)
    numbers_of(&s.final[i], to + NUMBERS * i);
  return true;
}

/* Of differences of order 4, f at -2, -1, 1 and 2 steps h. */
static inline double slope_of_four(double f_2, double f_1, double f1, double f2, double h) {
  return (8.0 * (f1 - f_1) - (f2 - f_2)) / (12.0 * h);
}

static double least_error; /* of the last comparison, by any of its steps */

/* Largest difference of the tangents in column j of m from the best plateau, and by how much
 * that itself disagrees; false if there is none. Next to a kink there are two plateaus, of which
 * the better one may be that of larger steps. */
static inline bool compare(const layout *l, const direction *by, const double *tangent, int j,
                           int m, double *error, double *plateau) {
  double last[NUMBERS * LAYOUT_BALLS] = {0};
  bool had = false;
  *plateau = *error = least_error = INFINITY;
  for (int step = 0; step < 15; step++) {
    const double h = pow(10.0, -9.0 + 0.5 * step) * by->unit;
    static const double steps[4] = {-2, -1, 1, 2};
    double f[4][NUMBERS * LAYOUT_BALLS], apart = 0.0, off = 0.0;
    bool same = true;
    for (int s = 0; s < 4 && same; s++)
      same = plays_alike(l, by, steps[s] * h, f[s]);
    for (int x = 0; x < NUMBERS * l->count && same; x++) {
      const double d = slope_of_four(f[0][x], f[1][x], f[2][x], f[3][x], h);
      apart = fmax(apart, had ? fabs(d - last[x]) : INFINITY);
      off = fmax(off, fabs(d - tangent[x * m + j]));
      last[x] = d;
    }
    had = same;
    least_error = same ? fmin(least_error, off) : least_error;
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

/* Sorts errors and prints their distribution behind some words; returns the p-th of 1. */
static inline double tell(double *errors, int n, double p, const char *words) {
  qsort(errors, (size_t)n, sizeof *errors, by_size);
  printf("%s: %d derivatives, error median %.1e, 90 %% %.1e, 99 %% %.1e, largest %.1e\n", words, n,
         errors[n / 2], errors[n * 9 / 10], errors[n * 99 / 100], errors[n - 1]);
  return errors[(int)(n * p)];
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
      alone &= distance(l.ball[i].state.r, l.ball[j].state.r) > 0.07;
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
