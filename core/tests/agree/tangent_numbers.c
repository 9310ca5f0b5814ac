/* The derivative by every number of a ball, a cue, a nose and a slope, at its default, at 0 and at
 * the ends of its range: right, or with a flag.
 *
 * Numbers are rows of schema/numbers.h, so one that is added is here too. Each scene, on the cloth
 * and in space, with pairs and clusters, is differentiated by it, and compared with differences of
 * complete shots to each side,
 *
 *     f'(+-0) = (-3 f(0) + 4 f(+-h) - f(+-2h)) / (+-2h),
 *
 * by steps h from 1e-9 to 1e-3 of the number, of which the two adjacent ones that agree best are
 * taken. At an end of the range the tangent is that of the side within. Where the sides differ it
 * is one of them, with CAROM_TANGENT_KINK. Where 0 means a default it is that at the
 * default. */
#include "paths.h"
#include "precise_solver.h"
#include "schema/numbers.h"

#include <stddef.h>

enum { STEPS = 13, MOST = NUMBERS * LAYOUT_BALLS };

typedef struct number {
  const char *name;
  direction by;
  double low, high;
} number;

#define OF_BALL(member, key, unit, low, high, ...) \
  {#member, {OF_KIND, -1, (int)(offsetof(carom_ball_kind, member) / sizeof(double)), 1}, low, high},
#define OF_STICK(member, key, unit, low, high, ...) \
  {#member, {OF_CUE, 0, (int)(offsetof(carom_cue, member) / sizeof(double)), 1}, low, high},
/* clang-format off */
static const number numbers[] = {
    CAROM_NUMBERS(OF_BALL, OF_BALL) CAROM_CUE_NUMBERS(OF_STICK, OF_STICK)
    {"nose.height", {OF_NOSES, 0, 0, 1}, 0.0, 0.05},
    {"nose.mu_cushion", {OF_NOSES, 0, 1, 1}, 0.0, 1.0},
    {"nose.restitution", {OF_NOSES, 0, 2, 1}, 0.0, 1.0},
    {"slope_x", {OF_NOSES, 0, SLOPE, 1}, -0.004, 0.004},
    {"slope_y", {OF_NOSES, 0, SLOPE + 1, 1}, -0.004, 0.004}};
/* clang-format on */
enum { ALL = (int)(sizeof numbers / sizeof *numbers) };

/* Scenes whose first events are of each kind; they stop before small changes grow. */
static const struct scene {
  const char *name;
  carom_game game;
  int count;
  const char *numbers;
} scenes[] = {
    {"on the cloth", CAROM_GAME_POOL, 2, ""},
    {"smooth", CAROM_GAME_POOL, 2,
     "all.smooth_q 0.35 all.roll_loss 0.09 all.smooth_x 1.2 all.smooth_t 1.2"},
    {"billiard", CAROM_GAME_BILLIARD, 2, ""},
    {"in space", CAROM_GAME_POOL, 2, "options.space 3d cue.theta 35 cue.speed 4"},
    {"cluster", CAROM_GAME_POOL, 3, "all.law_a 0.05 all.law_c 1"},
    {"pairs", CAROM_GAME_POOL, 3, "options.simultaneous pairs"},
    {"constant", CAROM_GAME_POOL, 2, "options.friction constant"},
    {"usual smooth", CAROM_GAME_POOL, 2, "options.cushion_model smooth"},
    {"stronge", CAROM_GAME_POOL, 2, "options.cushion_model stronge"},
};

static layout layout_of(const struct scene *of) {
  static carom_table billiard;
  layout l = {.count = of->count, .cue = carom_cue_of(of->game)};
  for (int i = 0; i < 3; i++) {
    l.ball[i] = ball_at(0.5 + 0.31 * i, 0.5 + 0.4 * i);
    l.ball[i].kind = carom_ball_kind_of(of->game);
    l.ball[i].state.r[2] = l.ball[i].kind.radius;
  }
  if (of->game == CAROM_GAME_BILLIARD) {
    carom_table_make(CAROM_TABLE_THREECUSHION, &billiard);
    l.table = &billiard;
  }

  /* of three balls two touch, but for 1 nm */
  l.ball[2].state.r[0] = l.ball[1].state.r[0] + 1.2 * l.ball[0].kind.radius;
  l.ball[2].state.r[1] = l.ball[1].state.r[1] + 1.6 * l.ball[0].kind.radius + 1e-9;
  l.cue.phi = 57.29577951308232 * atan2(0.4, 0.31) + 0.7;
  set_numbers(&l, "cue.speed 1.7 cue.a 0.12 cue.b 0.21 cue.theta 3 options.space flat");
  set_numbers(&l, of->numbers);

  /* of few events, so that differences are exact */
  l.options.time_most = 2.0;
  for (shot.count = ROOM; shot.count > 8; l.options.time_most *= 0.8) {
    shot = empty_shot();
    ck_assert_int_ge(shoot(&l, &shot), CAROM_OK);
  }
  l.options.time_most /= 0.8;
  return l;
}

/* The number, or that of the first ball. */
static double *number_in(layout *l, const direction *by) {
  if (by->of == OF_CUE)
    return (double *)&l->cue + by->row;
  return by->of == OF_KIND ? (double *)&l->ball[0].kind + by->row : &l->nose[by->row];
}

/* The default that a number of 0 means. */
static const struct {
  const char *name, *numbers;
} defaults[] = {
    {"omega_ratio", "all.omega_ratio 1.8"},
    {"restitution_table", "all.restitution_table 0.5"},
    {"modulus", "all.modulus 6.6e9"},
    {"tip_restitution", "cue.tip_restitution 1"},
};

/* Replaces a number that is 0 by the default that this 0 means, if it means one. */
static void stand_for_zero(layout *l, const char *name) {
  const carom_speed_law law = carom_alciatore();
#define IS(word) (strcmp(name, word) == 0)
  for (size_t k = 0; k < COUNT_OF(defaults); k++)
    if (IS(defaults[k].name))
      set_numbers(l, defaults[k].numbers);
  const carom_ball_kind *kind = &l->ball[0].kind;
  if (strncmp(name, "smooth_", 7) == 0 && kind->smooth_q == 0.0 &&
      l->options.cushion_model == CAROM_SHOT_CUSHION_SMOOTH)
    set_numbers(l, "all.smooth_q 0.35 all.smooth_x 1.3 all.smooth_t 1.18 all.smooth_a 0.25 "
                   "all.smooth_g 0.067 all.smooth_g_log -0.059 all.smooth_e 0.06");
  for (int i = 0; i < l->count; i++) {
    carom_ball_kind *k = &l->ball[i].kind;
    k->nose_height = IS("nose_height") ? table_of(l)->rail[0].height : k->nose_height;
    if (strncmp(name, "law_", 4) == 0 && k->law_a + k->law_b + k->law_c == 0.0) {
      k->law_a = law.a;
      k->law_b = law.b;
      k->law_c = law.c;
    }
  }
  if (IS("theta"))
    l->cue.theta = CAROM_LEAST_ELEVATION; /* below it the cue is level */
  l->nose[1] += IS("nose.mu_cushion") ? kind->mu_cushion : 0.0;
  l->nose[2] += IS("nose.restitution") ? kind->restitution_cushion : 0.0;
#undef IS
}

/* The slope of all final numbers to one side, and by how much two steps agree; infinite where
 * the side has other events, or is rejected. */
static double slope_to(const layout *l, const direction *by, double side, double slope[MOST]) {
  double here[MOST], last[MOST], now[MOST], one[MOST], two[MOST], best = INFINITY;
  bool had = false;
  if (!plays_alike(l, by, 0.0, here))
    return INFINITY;
  for (int step = 0; step < STEPS; step++) {
    const double h = side * by->unit * pow(10.0, -9.0 + 0.5 * step);
    const bool alike = plays_alike(l, by, h, one) && plays_alike(l, by, 2.0 * h, two);
    double apart = 0.0;
    for (int x = 0; x < NUMBERS * l->count && alike; x++) {
      now[x] = (4.0 * one[x] - 3.0 * here[x] - two[x]) / (2.0 * h);
      apart = fmax(apart, had ? fabs(now[x] - last[x]) : INFINITY);
    }
    if (alike && apart < best) {
      best = apart;
      memcpy(slope, now, sizeof now);
    }
    memcpy(last, now, sizeof now);
    had = alike;
  }
  return best;
}

static double greatest_change(const double *a, const double *b, int n) {
  double most = 0.0;
  for (int x = 0; x < n; x++)
    most = fmax(most, fabs(a[x] - b[x]));
  return most;
}

/* Compares the tangent of a layout by a number with both sides; false where it is rejected, or
 * neither side has a difference. */
static bool is_compared(const layout *l, const number *row, const char *where) {
  layout at = *l;
  const int n = NUMBERS * l->count;
  double slope[2][MOST];
  int64_t flags;
  shot = empty_shot();
  if (!(l->cue.speed > 0.0) || shoot(l, &shot) < CAROM_OK ||
      tangent_of(l, &row->by, 1, &flags) != CAROM_OK)
    return false;

  /* differences to both sides, of those that settle */
  direction by = row->by;
  if (*number_in(&at, &by) == 0.0)
    stand_for_zero(&at, row->name);
  by.unit = fmax(fabs(*number_in(&at, &by)), 0.03);
  bool has[2];
  double most = 1e-3, off = INFINITY;
  for (int side = 0; side < 2; side++) {
    const double apart = slope_to(&at, &by, 2.0 * side - 1.0, slope[side]);
    has[side] = apart < 1e-4 * fmax(1e-3, largest(slope[side], n, 0, 1));
    most = has[side] ? fmax(most, largest(slope[side], n, 0, 1)) : most;
    off = has[side] ? fmin(off, greatest_change(ends, slope[side], n)) : off;
  }
  if (!has[0] && !has[1])
    return false;

  const bool kink = has[0] && has[1] && greatest_change(slope[0], slope[1], n) > 3e-3 * most;
  const bool told = flags & (CAROM_TANGENT_KINK | CAROM_TANGENT_SIMULTANEOUS);
  ck_assert_msg(told || (off < 3e-3 * most && !kink), "%s, by %s at %g: %g off of %g%s, flags %d",
                where, row->name, *number_in(&at, &by), off, most, kink ? ", a kink" : "",
                (int)flags);
  return true;
}

TEST(every_number) {
  precisely = true;
  for (size_t of = 0; of < COUNT_OF(scenes); of++) {
    const layout l = layout_of(&scenes[of]);
    int compared = 0;
    for (int n = 0; n < ALL; n++) {
      const number *row = &numbers[n];
      layout usual = l;
      if (row->by.of == OF_CUE && row->by.row >= CAROM_CUE_NUMBERS)
        continue;
      double was = row->by.row == 0 ? table_of(&l)->rail[0].height : 0.0;
      if (row->by.of != OF_NOSES)
        was = *number_in(&usual, &row->by);
      const double values[] = {was, 0.0, row->low, row->high, 0.5 * (was + row->high)};
      for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
        layout at = l;
        change(&at, &row->by, values[k] - was);
        compared += is_compared(&at, row, scenes[of].name);
      }
    }
    printf("%s: %d derivatives\n", scenes[of].name, compared);
    ck_assert_int_gt(compared, 60);
  }
}
