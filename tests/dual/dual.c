/* carom_shot_tangent() and carom_cushion_tangent() against dual numbers: against the sources of the shot itself, compiled with
 * a dual number for every double (number.h). These know nothing of tangents, and take no step as differences do, so both agree
 * to rounding, times what contacts multiply it by. Each shot is played once by the library, with the tangents of all
 * directions, and once in dual numbers for each direction, where it must have the bits of the library.
 *
 * Only models in closed form are compared: the exact ones are vectors of double (play.cpp). Nor are balls with drag: a shot
 * follows them in pieces, tangents follow the exact motion. */
#include "carom_tangent.h"
#include "dual/play.h"
#include "shot_support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void dual_usual_law(real law[3]) {
  const carom_speed_law usual = carom_alciatore();
  law[0] = usual.a;
  law[1] = usual.b;
  law[2] = usual.c;
}

/* ---- Random shots ---- */

enum { SHOTS = 60, MOST_DIRECTIONS = 64, NUMBERS = CAROM_STATE_NUMBERS };
/* Where the numbers of a tangent are among r, v, w; the first of them are those of a ball on the cloth. */
enum { ON_CLOTH = 7 };
static const int number[] = {0, 1, 3, 4, 6, 7, 8, 2, 5};

/* How a shot starts: by a level cue; by an elevated one; with two balls that move, without a cue; with a ball that its spin
 * presses on another one, or on a cushion, or that falls on another one, each of which has hundreds of slow contacts; with a
 * ball that flies at another one, or at a cushion. */
typedef enum { STRUCK, ELEVATED, MOVING, PRESSED, AT_RAIL, ON_TOP, FLYING, AT_CUSHIONS } start_kind;

static bool by_cue(start_kind start) {
  return start == STRUCK || start == ELEVATED;
}
static bool flies(start_kind start) {
  return start >= ON_TOP;
}
static bool is_slow(start_kind start) {
  return start == PRESSED || start == AT_RAIL || start == ON_TOP;
}

typedef struct setting {
  const char *name;
  carom_table_kind table;
  carom_ball_model balls;
  carom_shot_cushion cushions;
  carom_ball_friction friction;
  carom_space space;
  start_kind start;
  bool unlike; /* balls differ, and have terms of their own; mu and e of cushions are those of the table */
  bool radii;  /* and have radii of their own */
  double most; /* the largest error that passes; tangents of Stronge's cushions are by differences */
} setting;

static const setting settings[] = {
    {"inelastic, Han, flat", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_HAN, CAROM_FRICTION_ALCIATORE,
     CAROM_SPACE_FLAT, ELEVATED, false, false, 1e-6},
    {"inelastic, Stronge", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_STRONGE,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, STRUCK, false, false, 1e-2},
    {"inelastic, Stronge, unlike balls", CAROM_TABLE_POOL_7FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_STRONGE,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, STRUCK, true, false, 1e-2},
    {"inelastic, Han, unlike balls", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_HAN,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, STRUCK, true, false, 1e-6},
    {"inelastic, Han, balls that move, constant friction", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC,
     CAROM_SHOT_CUSHION_HAN, CAROM_FRICTION_CONSTANT, CAROM_SPACE_3D, MOVING, false, false, 1e-6},
    {"inelastic, Han, pressed balls", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_HAN,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, PRESSED, false, false, 1e-6},
    {"inelastic, Han, a ball pressed on a cushion", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_HAN,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, AT_RAIL, false, false, 1e-6},
    {"inelastic, Han, a ball that falls on another one", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC,
     CAROM_SHOT_CUSHION_HAN, CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, ON_TOP, false, false, 1e-6},
    {"mirror, mirror, unlike balls", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_MIRROR, CAROM_SHOT_CUSHION_MIRROR,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, STRUCK, true, false, 1e-6},
    {"mirror, Han, unlike balls, three cushions", CAROM_TABLE_THREECUSHION, CAROM_BALL_MODEL_MIRROR, CAROM_SHOT_CUSHION_HAN,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, STRUCK, true, false, 1e-6},
    {"inelastic, Han, elevated cues", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_HAN,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, ELEVATED, false, false, 1e-6},
    {"mirror, Stronge, elevated cues, unlike balls", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_MIRROR, CAROM_SHOT_CUSHION_STRONGE,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, ELEVATED, true, false, 1e-2},
    {"inelastic, Han, a ball that flies", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_HAN,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, FLYING, false, false, 1e-6},
    {"Han, unlike radii", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_HAN, CAROM_FRICTION_ALCIATORE,
     CAROM_SPACE_3D, ELEVATED, true, true, 1e-6},
    {"Han, a ball that flies at cushions", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_HAN,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, AT_CUSHIONS, true, true, 1e-6},
    {"Stronge, a ball that flies at cushions", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_INELASTIC, CAROM_SHOT_CUSHION_STRONGE,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, AT_CUSHIONS, true, true, 1e-2},
    {"mirror, a ball that flies at cushions", CAROM_TABLE_POOL_9FT, CAROM_BALL_MODEL_MIRROR, CAROM_SHOT_CUSHION_MIRROR,
     CAROM_FRICTION_ALCIATORE, CAROM_SPACE_3D, AT_CUSHIONS, true, false, 1e-6},
};
enum { SETTINGS = sizeof settings / sizeof settings[0] };

static carom_shot_options options_of(const setting *s) {
  return (carom_shot_options){.ball_model = s->balls, .cushion_model = s->cushions, .friction = s->friction, .space = s->space};
}

#define CUE_ROW(field) ((int)(offsetof(carom_cue, field) / sizeof(double)))
#define KIND_ROW(field) ((int)(offsetof(carom_ball_kind, field) / sizeof(double)))

/* Ball 0 is above ball 1, or flies at it, or at a place on a rail, a jaw or a pocket. */
static void fly(random_source *random, const setting *s, const carom_table *table, dual_shot *shot) {
  dual_number *state = shot->state[0];
  double to[2] = {shot->state[1][0].x, shot->state[1][1].x};
  if (s->start == AT_CUSHIONS) {
    const int what = (int)random_between(random, 0.0, 3.999);
    const carom_jaw *jaw = &table->jaw[(int)random_between(random, 0.0, (double)table->jaws - 0.001)];
    const carom_pocket *pocket = &table->pocket[(int)random_between(random, 0.0, (double)table->pockets - 0.001)];
    to[0] = what < 2 ? random_between(random, 0.2, 1.0) : (what == 2 ? jaw->centre[0] : pocket->centre[0]);
    to[1] = what < 2 ? (what == 0 ? 0.0 : table->length) : (what == 2 ? jaw->centre[1] : pocket->centre[1]);
    state[0].x = 0.5 * table->width + random_between(random, -0.2, 0.2);
    state[1].x = fmin(fmax(to[1], 0.4), table->length - 0.4) + random_between(random, -0.1, 0.1);
  }
  if (s->start == ON_TOP) {
    for (int k = 0; k < 2; k++)
      state[k].x = to[k] + random_between(random, 1e-3, 0.01);
    state[2].x = 3.0 * shot->kind[0][KIND_ROW(radius)].x + random_between(random, 0.0, 1e-3);
    return;
  }
  const double rate = random_between(random, 1.5, 5.0);
  for (int k = 0; k < 2; k++)
    state[3 + k].x = rate * (to[k] - state[k].x) + random_between(random, -0.1, 0.1);
  state[2].x += random_between(random, 1e-4, 0.05);
  state[5].x = random_between(random, -1.0, 1.5);
  if (s->start == AT_CUSHIONS && random_between(random, 0.0, 1.0) < 0.5) {
    /* to be less than 2 mm above the cloth at a rail across the table: the flat model has a part in it up to 1 mm */
    const double R = shot->kind[0][KIND_ROW(radius)].x, T = (fabs(to[1] - state[1].x) - R) / fabs(state[4].x);
    state[5].x = (R + random_between(random, 0.0, 2e-3) - state[2].x) / T + 0.5 * 9.81 * T;
  }
  for (int k = 6; k < DUAL_STATE; k++)
    state[k].x = random_between(random, -80.0, 80.0);
}

static void draw(random_source *random, const setting *s, dual_shot *shot) {
  carom_table table;
  ck_assert_int_eq(carom_table_make(s->table, &table), CAROM_OK);
  *shot = (dual_shot){.table = (int)s->table,
                      .count = is_slow(s->start) ? 2 : 2 + (int)random_between(random, 0.0, 7.999),
                      .ball_model = (int)s->balls,
                      .cushion_model = (int)s->cushions,
                      .friction = (int)s->friction,
                      .space = (int)s->space};
  for (int i = 0; i < shot->count;) {
    double x = random_between(random, 0.05, table.width - 0.05), y = random_between(random, 0.05, table.length - 0.05);
    if (is_slow(s->start)) {
      x = (s->start == AT_RAIL && i == 0 ? 0.0286 : 0.6) + random_between(random, 0.0, 1e-3);
      y = 0.6 + (s->start == PRESSED ? 0.0575 : 0.1) * i + random_between(random, 0.0, 1e-4);
    }
    bool alone = true;
    for (int j = 0; j < i; j++)
      alone &= hypot(x - shot->state[j][0].x, y - shot->state[j][1].x) > (is_slow(s->start) ? 0.05 : 0.08);
    if (!alone)
      continue;
    carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
    if (s->radii)
      kind.radius *= random_between(random, 0.95, 1.05);
    if (s->unlike) {
      kind.omega_ratio = random_between(random, 1.5, 1.9);
      kind.restitution_table = random_between(random, 0.3, 0.7);
      kind.mass *= s->balls == CAROM_BALL_MODEL_MIRROR ? random_between(random, 0.8, 1.2) : 1.0;
      kind.mu_slide *= random_between(random, 0.8, 1.2);
      kind.restitution *= random_between(random, 0.9, 1.0);
      kind.roll_loss = random_between(random, 0.0, 0.2);
      kind.law_a = random_between(random, 0.0, 0.06);
      kind.law_b = random_between(random, 0.0, 0.06);
      kind.law_c = random_between(random, 0.0, 3.0);
      kind.nose_height = i % 2 == 1 ? random_between(random, 1.1, 1.4) * kind.radius : 0.0;
    }
    for (int k = 0; k < DUAL_KIND; k++)
      shot->kind[i][k].x = ((const double *)&kind)[k];
    shot->state[i][0].x = x;
    shot->state[i][1].x = y;
    shot->state[i][2].x = kind.radius;
    for (int k = 3; k < DUAL_STATE && s->start == MOVING && i < 2; k++)
      shot->state[i][k].x = k == 5 ? 0.0 : k < 5 ? random_between(random, -2.0, 2.0) : random_between(random, -60.0, 60.0);
    if ((s->start == PRESSED || s->start == AT_RAIL) && i == 0)
      shot->state[i][s->start == PRESSED ? 6 : 7].x = random_between(random, -60.0, -30.0);
    i++;
  }
  if (flies(s->start))
    fly(random, s, &table, shot);
  if (s->unlike) {
    shot->nose[1].x = random_between(random, 0.1, 0.3);
    shot->nose[2].x = random_between(random, 0.7, 0.9);
  }
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = random_between(random, 0.8, 5.0);
  cue.phi = 57.29577951308232 * atan2(shot->state[1][1].x - shot->state[0][1].x, shot->state[1][0].x - shot->state[0][0].x) +
            random_between(random, -1.5, 1.5);
  cue.theta = s->start == ELEVATED ? random_between(random, 3.0, 60.0) : 0.0;
  cue.a = random_between(random, -0.3, 0.3);
  cue.b = random_between(random, -0.35, 0.35);
  const double numbers[DUAL_CUE] = {cue.speed, cue.phi, cue.theta, cue.a, cue.b, cue.mass, cue.end_mass};
  for (int k = 0; k < DUAL_CUE; k++)
    shot->cue[k].x = !by_cue(s->start) ? (k < 5 ? 0.0 : 1.0) : numbers[k];
}

/* ---- Directions ---- */

/* Which number changes: of the cue, of all balls, of one ball, of the noses. */
typedef struct direction {
  enum { OF_CUE, OF_KINDS, OF_KIND, OF_STATE, OF_NOSE } of;
  int row, ball;
} direction;

static int directions_of(const setting *s, direction to[MOST_DIRECTIONS]) {
  int m = 0;
  for (int k = 0; k < DUAL_CUE && by_cue(s->start); k++)
    if (k != CUE_ROW(theta) || s->start == ELEVATED) /* in space a level cue is at a kink */
      to[m++] = (direction){OF_CUE, k, 0};
  for (int k = 0; k < KIND_ROW(modulus); k++) /* which only clusters read */
    to[m++] = (direction){OF_KINDS, k, 0};
  for (int k = 0; k < KIND_ROW(modulus); k++)
    if (k != KIND_ROW(radius) || s->radii) /* balls of one radius change it together */
      to[m++] = (direction){OF_KIND, k, 1};
  for (int i = 0; i < 2; i++) {
    const bool moves = s->start == MOVING || (is_slow(s->start) && i == 0);
    for (int k = 0; k < (flies(s->start) && i == 0 ? NUMBERS : moves ? ON_CLOTH : 2); k++)
      to[m++] = (direction){OF_STATE, k, i};
  }
  for (int k = 0; k < 3; k++)
    to[m++] = (direction){OF_NOSE, k, 0};
  ck_assert_int_le(m, MOST_DIRECTIONS);
  return m;
}

/* Writes the derivatives of the input. */
static void give(const direction *d, dual_shot *shot) {
  for (int k = 0; k < DUAL_CUE; k++)
    shot->cue[k].d = d->of == OF_CUE && d->row == k;
  for (int i = 0; i < shot->count; i++) {
    for (int k = 0; k < DUAL_KIND; k++)
      shot->kind[i][k].d = d->row == k && (d->of == OF_KINDS || (d->of == OF_KIND && d->ball == i));
    for (int k = 0; k < DUAL_STATE; k++)
      shot->state[i][k].d = d->of == OF_STATE && d->ball == i && number[d->row] == k;
    if (shot->state[i][2].x == shot->kind[i][KIND_ROW(radius)].x) /* it lies on the cloth */
      shot->state[i][2].d = shot->kind[i][KIND_ROW(radius)].d;
  }
  for (int k = 0; k < 3; k++)
    shot->nose[k].d = d->of == OF_NOSE && d->row == k;
}

static double seeds_cue[DUAL_CUE * MOST_DIRECTIONS], seeds_kind[DUAL_BALLS * DUAL_KIND * MOST_DIRECTIONS],
    seeds_state[DUAL_BALLS * NUMBERS * MOST_DIRECTIONS], seeds_nose[3 * MOST_DIRECTIONS];

/* The same derivatives as seeds. */
static carom_tangent_seeds seeds_of(const direction *directions, int m, dual_shot *shot) {
  for (int j = 0; j < m; j++) {
    give(&directions[j], shot);
    for (int k = 0; k < DUAL_CUE; k++)
      seeds_cue[k * m + j] = shot->cue[k].d;
    for (int i = 0; i < shot->count; i++) {
      for (int k = 0; k < DUAL_KIND; k++)
        seeds_kind[(i * DUAL_KIND + k) * m + j] = shot->kind[i][k].d;
      for (int k = 0; k < NUMBERS; k++)
        seeds_state[(i * NUMBERS + k) * m + j] = shot->state[i][number[k]].d;
    }
    for (int k = 0; k < 3; k++)
      seeds_nose[k * m + j] = shot->nose[k].d;
  }
  return (carom_tangent_seeds){
      .directions = m, .cue = seeds_cue, .kind = seeds_kind, .state = seeds_state, .table = seeds_nose};
}

/* ---- The shot as the library plays it ---- */

typedef struct layout {
  carom_table table;
  carom_shot_ball ball[DUAL_BALLS];
  carom_cue cue;
} layout;

static void layout_of(const dual_shot *shot, layout *l) {
  ck_assert_int_eq(carom_table_make((carom_table_kind)shot->table, &l->table), CAROM_OK);
  for (int k = 0; k < l->table.rails; k++) {
    l->table.rail[k].mu_cushion = shot->nose[1].x;
    l->table.rail[k].restitution = shot->nose[2].x;
  }
  for (int k = 0; k < l->table.jaws; k++) {
    l->table.jaw[k].mu_cushion = shot->nose[1].x;
    l->table.jaw[k].restitution = shot->nose[2].x;
  }
  for (int i = 0; i < shot->count; i++) {
    for (int k = 0; k < DUAL_KIND; k++)
      ((double *)&l->ball[i].kind)[k] = shot->kind[i][k].x;
    for (int k = 0; k < DUAL_STATE; k++)
      ((double *)&l->ball[i].state)[k] = shot->state[i][k].x;
    l->ball[i].state.label = 0;
  }
  l->cue = (carom_cue){0};
  for (int k = 0; k < DUAL_CUE; k++)
    ((double *)&l->cue)[k] = shot->cue[k].x;
}

static bool same_state(const carom_ball_state *s, const dual_number n[DUAL_STATE]) {
  bool same = true;
  for (int k = 0; k < DUAL_STATE; k++)
    same &= ((const double *)s)[k] == n[k].x;
  return same;
}

/* That the dual numbers played the same shot, to the last bit. */
static bool same_shot(const carom_shot *played, const dual_shot *shot) {
  bool same = shot->status == CAROM_OK && shot->events == played->count;
  for (int k = 0; same && k < shot->events; k++) {
    const carom_event *event = &played->events[k];
    const dual_event *other = &shot->event[k];
    same = event->type == other->type && event->a == other->a && event->b == other->b && event->time == other->time.x;
    for (int side = 0; side < (event->type == CAROM_EVENT_BALL_BALL ? 2 : 1); side++)
      same =
          same && same_state(&event->before[side], other->before[side]) && same_state(&event->after[side], other->after[side]);
  }
  for (int i = 0; i < shot->count; i++)
    same = same && same_state(&played->final[i], shot->final[i]);
  return same;
}

/* ---- Comparison ---- */

/* Errors of one kind of result: of each event, or of each shot, the largest difference of a number, over the largest derivative
 * of the direction so far. Directions that change nothing have rounding alone: so it is at least 1e-6 of the largest of any
 * direction, and 1e-3. */
enum { MOST_ERRORS = 1 << 20 };
typedef struct errors {
  const char *name;
  int count;
  int64_t numbers, nonzero; /* that were compared, and those that are not 0 */
  double *of;
} errors;

typedef struct comparison {
  double off, most;
} comparison;

static const comparison nothing_yet = {0.0, 1e-3};

/* The largest of n numbers that are not less than `most`. */
static double largest(double most, const double *of, int n) {
  for (int k = 0; k < n; k++)
    most = fmax(most, fabs(of[k]));
  return most;
}

static void compare(errors *e, comparison *c, double tangent, double dual) {
  c->off = fmax(c->off, isfinite(tangent) && isfinite(dual) ? fabs(tangent - dual) : INFINITY);
  c->most = fmax(c->most, fabs(dual));
  e->numbers++;
  e->nonzero += dual != 0.0;
}

static void note(errors *e, comparison *c) {
  if (e->count == MOST_ERRORS)
    ck_abort_msg("more than %d comparisons", MOST_ERRORS);
  e->of[e->count++] = c->off / c->most;
  c->off = 0.0;
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Prints the errors, and asserts that they are small and that there were some to make. */
static void conclude(errors *e, double most) {
  qsort(e->of, (size_t)e->count, sizeof *e->of, by_size);
  const int n = e->count - 1;
  printf("  %-7s %7d comparisons of %8lld numbers, %7lld not 0: median %.1e, 99 %% %.1e, largest %.1e\n", e->name, e->count,
         (long long)e->numbers, (long long)e->nonzero, e->of[n / 2], e->of[n - n / 100], e->of[n]);
  ck_assert_int_gt(e->nonzero, 50);
  ck_assert_double_lt(e->of[n / 2], 1e-12);
  ck_assert_double_lt(e->of[n - n / 100], 1e-8);
  ck_assert_double_lt(e->of[n], most);
}

enum { TIMES, BEFORE, AFTER, FINAL, KINDS };
static errors all[KINDS] = {{.name = "times"}, {.name = "before"}, {.name = "after"}, {.name = "final"}};

static bool share_a_ball(const carom_event *p, const carom_event *q) {
  const int b = p->type == CAROM_EVENT_BALL_BALL ? p->b : p->a, d = q->type == CAROM_EVENT_BALL_BALL ? q->b : q->a;
  return p->a == q->a || p->a == d || b == q->a || b == d;
}

/* Whether two events of different balls happen at one instant. The clock of a shot does not go back by rounding, so in dual
 * numbers the second has the time of the first with its derivative, even where a change separates them. */
static bool coincide(const carom_shot *played) {
  bool any = false;
  for (int64_t k = 1; k < played->count; k++)
    any |= played->events[k].time - played->events[k - 1].time < 1e-12 &&
           !share_a_ball(&played->events[k], &played->events[k - 1]);
  return any;
}

/* The largest derivatives of any direction so far: of the times of events, and of states. */
static double largest_time[DUAL_EVENTS], largest_state[DUAL_EVENTS];

static void find_largest(int64_t count, const carom_tangent *t, int m) {
  double time = 0.0, state = 0.0;
  for (int64_t k = 0; k < count; k++) {
    largest_time[k] = time = largest(time, t->time + k * m, m);
    state = largest(state, t->before + 2 * k * NUMBERS * m, 2 * NUMBERS * m);
    largest_state[k] = state = largest(state, t->after + 2 * k * NUMBERS * m, 2 * NUMBERS * m);
  }
}

/* One direction of a shot. */
static void compare_direction(const dual_shot *shot, const carom_tangent *t, int j, int m) {
  comparison time = nothing_yet, states = nothing_yet, ends = nothing_yet;
  for (int k = 0; k < shot->events; k++) {
    const dual_event *event = &shot->event[k];
    time.most = fmax(time.most, 1e-6 * largest_time[k]);
    states.most = ends.most = fmax(states.most, 1e-6 * largest_state[k]);
    const int sides = event->type == CAROM_EVENT_BALL_BALL ? 2 : 1;
    compare(&all[TIMES], &time, t->time[k * m + j], event->time.d);
    for (int n = 0; n < sides * NUMBERS; n++)
      compare(&all[BEFORE], &states, t->before[(2 * k * NUMBERS + n) * m + j],
              event->before[n / NUMBERS][number[n % NUMBERS]].d);
    note(&all[BEFORE], &states);
    for (int n = 0; n < sides * NUMBERS; n++)
      compare(&all[AFTER], &states, t->after[(2 * k * NUMBERS + n) * m + j], event->after[n / NUMBERS][number[n % NUMBERS]].d);
    note(&all[AFTER], &states);
  }
  note(&all[TIMES], &time);
  for (int n = 0; n < shot->count * NUMBERS; n++)
    compare(&all[FINAL], &ends, t->final[n * m + j], shot->final[n / NUMBERS][number[n % NUMBERS]].d);
  note(&all[FINAL], &ends);
}

/* What was seen in all shots: events by type, those in flight too; noses less than 1 mm above the cloth; slow contacts; and
 * which numbers changed anything. */
static int events_seen[CAROM_EVENT_LEFT_TABLE + 1], in_flight_seen[CAROM_EVENT_LEFT_TABLE + 1], near_cloth_seen,
    slow_seen[CAROM_EVENT_LEFT_TABLE + 1][2];
static bool acted[OF_NOSE + 1][DUAL_KIND];

static void see(const dual_shot *shot, const int32_t *flags) {
  for (int k = 0; k < shot->events; k++) {
    const dual_event *event = &shot->event[k];
    const double up = event->before[0][2].x - shot->kind[event->a][KIND_ROW(radius)].x;
    events_seen[event->type]++;
    in_flight_seen[event->type] += up > 0.0;
    near_cloth_seen += event->type == CAROM_EVENT_RAIL && up > 0.0 && up < 1e-3;
    slow_seen[event->type][up > 0.0] += (flags[k] & CAROM_TANGENT_SLOW) != 0;
  }
}

static bool acts(const dual_shot *shot) {
  for (int k = 0; k < shot->events; k++)
    if (shot->event[k].time.d != 0.0)
      return true;
  return false;
}

START_TEST(shots_agree_with_dual_numbers) {
  const setting *s = &settings[_i];
  const carom_shot_options options = options_of(s);
  random_source random = {test_seed()};
  static dual_shot shot;
  static layout l;
  static double of_time[DUAL_EVENTS * MOST_DIRECTIONS], of_state[2][DUAL_EVENTS * 2 * NUMBERS * MOST_DIRECTIONS],
      ends[DUAL_BALLS * NUMBERS * MOST_DIRECTIONS];
  static int32_t flags[DUAL_EVENTS];
  direction directions[MOST_DIRECTIONS];
  const int m = directions_of(s, directions);
  int64_t count = 0;
  int left_out = 0;
  for (int k = 0; k < KINDS; k++)
    all[k] = (errors){.name = all[k].name, .of = all[k].of};
  const int shots = is_slow(s->start) ? SHOTS / 10 : SHOTS; /* of hundreds of events */
  for (int n = 0; n < shots; n++) {
    draw(&random, s, &shot);
    layout_of(&shot, &l);
    carom_shot played = {.events = events, .room = ROOM, .final = final};
    if (carom_shoot(&l.table, l.ball, shot.count, &l.cue, &options, &played) != CAROM_OK) {
      left_out++; /* a ball that is put where it flies from may be in another one */
      continue;
    }
    ck_assert_int_le(played.count, DUAL_EVENTS);
    if (coincide(&played)) {
      left_out++;
      continue;
    }
    count += played.count;
    const carom_tangent_seeds seeds = seeds_of(directions, m, &shot);
    carom_tangent tangent = {.final = ends, .time = of_time, .before = of_state[0], .after = of_state[1], .flags = flags};
    ck_assert_int_eq(carom_shot_tangent(&l.table, l.ball, shot.count, &l.cue, &options, &played, &seeds, &tangent), CAROM_OK);
    find_largest(played.count, &tangent, m);
    for (int j = 0; j < m; j++) {
      give(&directions[j], &shot);
      dual_play(&shot);
      ck_assert_msg(same_shot(&played, &shot), "shot %d of '%s' by dual numbers is another one", n, s->name);
      compare_direction(&shot, &tangent, j, m);
      acted[directions[j].of][directions[j].row] |= acts(&shot);
    }
    see(&shot, flags);
  }
  ck_assert_int_le(left_out, shots / 10);
  printf("%s: %d shots, %lld events, %d directions\n", s->name, shots - left_out, (long long)count, m);
  for (int k = 0; k < KINDS; k++)
    conclude(&all[k], s->most);
}
END_TEST

/* ---- Single impacts ---- */

static const carom_cushion_model cushions[] = {CAROM_CUSHION_HAN, CAROM_CUSHION_MIRROR, CAROM_CUSHION_STRONGE};
enum { CUSHIONS = sizeof cushions / sizeof cushions[0] };

START_TEST(cushions_agree_with_dual_numbers) {
  enum { IMPACTS = 3000 };
  const carom_cushion_model model = cushions[_i / 2];
  const carom_cushion_options options = {.model = model,
                                         .law = _i % 2 == 0 ? CAROM_CUSHION_LAW_CONSTANT : CAROM_CUSHION_LAW_HAN};
  random_source random = {test_seed()};
  double seeds[DUAL_IMPACT][DUAL_IMPACT] = {{0}};
  for (int k = 0; k < DUAL_IMPACT; k++)
    seeds[k][k] = 1.0;
  errors *e = &all[AFTER];
  *e = (errors){.name = "impact", .of = e->of};
  int kinks = 0;
  for (int n = 0; n < IMPACTS; n++) {
    const double angle = random_between(&random, 0.0, 6.28), to = angle + random_between(&random, -1.5, 1.5);
    const double v = random_between(&random, 0.1, 5.0), R = random_between(&random, 0.026, 0.031), s = v / R;
    carom_cushion_impact in = {.v = {v * cos(to), v * sin(to), 0.0},
                               .normal = {3.0 * cos(angle), 3.0 * sin(angle)},
                               .height = random_between(&random, 1.0, 1.5) * R,
                               .radius = R,
                               .mass = random_between(&random, 0.1, 0.3),
                               .mu_cloth = random_between(&random, 0.1, 0.3),
                               .mu_cushion = random_between(&random, 0.05, 0.5),
                               .restitution = random_between(&random, 0.5, 1.0)};
    for (int k = 0; k < 3; k++)
      in.w[k] = random_between(&random, -s, s);
    carom_motion out;
    double tangent[DUAL_MOTION][DUAL_IMPACT];
    int32_t flags;
    ck_assert_int_eq(carom_cushion(&in, &options, &out), CAROM_OK);
    ck_assert_int_eq(carom_cushion_tangent(&in, &options, DUAL_IMPACT, &seeds[0][0], &tangent[0][0], &flags), CAROM_OK);
    kinks += (flags & CAROM_TANGENT_KINK) != 0;
    for (int j = 0; j < DUAL_IMPACT; j++) {
      dual_number dual_in[DUAL_IMPACT], dual_out[DUAL_MOTION];
      for (int k = 0; k < DUAL_IMPACT; k++)
        dual_in[k] = (dual_number){((const double *)&in)[k], seeds[k][j]};
      ck_assert_int_eq(dual_cushion(dual_in, (int)model, (int)options.law, dual_out), CAROM_OK);
      comparison c = nothing_yet;
      bool same = true;
      for (int k = 0; k < DUAL_MOTION; k++) {
        same &= dual_out[k].x == ((const double *)&out)[k];
        compare(e, &c, tangent[k][j], dual_out[k].d);
      }
      ck_assert(same);
      if ((flags & CAROM_TANGENT_KINK) == 0)
        note(e, &c);
    }
  }
  ck_assert_int_le(kinks, IMPACTS / 100);
  printf("%s, %s: %d impacts, %d at a kink\n", carom_cushion_model_name(model),
         options.law == CAROM_CUSHION_LAW_HAN ? "Han's law" : "constant", IMPACTS, kinks);
  conclude(e, model == CAROM_CUSHION_STRONGE ? 1e-3 : 1e-6);
}
END_TEST

/* After all shots: that each kind of event and slow contacts took part, and each number of the input. */
START_TEST(everything_took_part) {
  for (int type = CAROM_EVENT_STRIKE; type <= CAROM_EVENT_LEFT_TABLE; type++) {
    printf("type %2d: %5d events, %4d above the cloth\n", type, events_seen[type], in_flight_seen[type]);
    ck_assert_int_ge(events_seen[type], 3);
    if (type >= CAROM_EVENT_BALL_BALL && type <= CAROM_EVENT_POCKET)
      ck_assert_int_ge(in_flight_seen[type], 3);
  }
  const int slow[3] = {slow_seen[CAROM_EVENT_BALL_BALL][0], slow_seen[CAROM_EVENT_BALL_BALL][1],
                       slow_seen[CAROM_EVENT_RAIL][0]};
  printf("%d at a nose less than 1 mm above the cloth; slow: %d of balls, %d in flight, %d at cushions\n", near_cloth_seen,
         slow[0], slow[1], slow[2]);
  ck_assert_int_ge(near_cloth_seen, 3);
  for (int k = 0; k < 3; k++)
    ck_assert_int_ge(slow[k], 10);
  static const int rows[OF_NOSE + 1] = {
      [OF_CUE] = DUAL_CUE, [OF_KINDS] = KIND_ROW(modulus), [OF_KIND] = KIND_ROW(modulus), [OF_STATE] = NUMBERS, [OF_NOSE] = 3};
  for (int of = 0; of <= OF_NOSE; of++)
    for (int row = 0; row < rows[of]; row++) {
      const bool drag = (of == OF_KINDS || of == OF_KIND) && row == KIND_ROW(drag);
      ck_assert_msg(acted[of][row] != drag, "direction %d %d", of, row);
    }
}
END_TEST

int main(void) {
  for (int k = 0; k < KINDS; k++)
    all[k].of = malloc(MOST_ERRORS * sizeof *all[k].of);
  const looped_test tests[] = {
      {shots_agree_with_dual_numbers, SETTINGS}, {cushions_agree_with_dual_numbers, 2 * CUSHIONS}, {everything_took_part, 1}};
  return RUN_LOOPED("dual", tests);
}
