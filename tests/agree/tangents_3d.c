/* Derivatives of shots in space against differences (tangent_support.h): elevated cues, balls
 * that fly at the start, unlike radii. The program prints the table of
 * docs/understanding/gradients.md. */
#include "tangent_support.h"

#include <stdio.h>

/* Of the cue; places of two balls, and the rest of the state of ball 0, which may fly; constants
 * of all balls. */
enum { DIRECTIONS = 23 };
static const direction directions[DIRECTIONS] = {
    {OF_CUE, 0, 0, 2},      {OF_CUE, 0, 1, 57},     {OF_CUE, 0, 2, 30},    {OF_CUE, 0, 3, 1},
    {OF_CUE, 0, 4, 1},      {OF_STATE, 0, 0, 1},    {OF_STATE, 0, 1, 1},   {OF_STATE, 1, 0, 1},
    {OF_STATE, 1, 1, 1},    {OF_STATE, 0, 7, 0.1},  {OF_STATE, 0, 2, 1},   {OF_STATE, 0, 8, 1},
    {OF_STATE, 0, 4, 50},   {OF_STATE, 0, 6, 50},   {OF_KIND, -1, 2, 0.2}, {OF_KIND, -1, 4, 0.1},
    {OF_KIND, -1, 6, 1},    {OF_KIND, -1, 7, 0.2},  {OF_KIND, -1, 8, 1},   {OF_KIND, -1, 9, 10},
    {OF_KIND, -1, 1, 0.03}, {OF_KIND, -1, 15, 0.5}, {OF_KIND, 0, 0, 0.2},
};

typedef enum { ELEVATED, JUMPS, FLYING, UNLIKE, NOSES } start_kind;

static const struct {
  const char *name;
  start_kind start;
  carom_shot_options options;
} kinds[] = {
    {"elevated cues",
     ELEVATED,
     {.ball_model = CAROM_BALL_MODEL_INELASTIC, .cushion_model = CAROM_SHOT_CUSHION_HAN}},
    {"jumps at a ball near by",
     JUMPS,
     {.ball_model = CAROM_BALL_MODEL_INELASTIC, .cushion_model = CAROM_SHOT_CUSHION_HAN}},
    {"balls that fly",
     FLYING,
     {.ball_model = CAROM_BALL_MODEL_MIRROR, .cushion_model = CAROM_SHOT_CUSHION_STRONGE}},
    {"unlike radii", UNLIKE, {.cushion_model = CAROM_SHOT_CUSHION_HAN}},
    {"noses, Han", NOSES, {.cushion_model = CAROM_SHOT_CUSHION_HAN}},
    {"noses, Stronge", NOSES, {.cushion_model = CAROM_SHOT_CUSHION_STRONGE}},
    {"noses, mirror", NOSES, {.cushion_model = CAROM_SHOT_CUSHION_MIRROR}},
    {"noses, exact", NOSES, {.cushion_model = CAROM_SHOT_CUSHION_MATHAVAN}},
};

/* Ball 0 flies. */
static void fly(carom_ball_state *s, random_source *random, double height, double speed) {
  for (int k = 0; k < 3; k++) {
    s->v[k] = random_between(random, -speed, speed);
    s->w[k] = random_between(random, -80.0, 80.0);
  }
  s->r[2] += random_between(random, 0.0, height);
}

static layout draw_in_space(random_source *random, start_kind start) {
  layout l = draw(random, start == NOSES ? 2 : 6);
  l.cue.theta = random_between(random, 3.0, 60.0);
  if (start == JUMPS) { /* onto the next ball, or over it */
    const double turn = random_between(random, -3.1, 3.1), away = random_between(random, 0.15, 0.5);
    l.ball[0] = ball_at(0.6, 1.2);
    l.ball[1] = ball_at(0.6 + away * cos(turn), 1.2 + away * sin(turn));
    l.count = 2;
    l.cue.phi = 57.29577951308232 * turn + random_between(random, -4.0, 4.0);
    l.cue.theta = random_between(random, 25.0, 65.0);
    l.cue.speed = random_between(random, 1.5, 5.0);
  } else if (start == FLYING) {
    fly(&l.ball[0].state, random, 0.1, 1.5);
    const double way[2] = {l.ball[1].state.r[0] - l.ball[0].state.r[0],
                           l.ball[1].state.r[1] - l.ball[0].state.r[1]};
    for (int k = 0; k < 2; k++)
      l.ball[0].state.v[k] = 1.5 * way[k] + random_between(random, -0.1, 0.1);
  } else if (start == UNLIKE) {
    for (int i = 0; i < l.count; i++) {
      l.ball[i].kind.radius *= random_between(random, 0.95, 1.05);
      l.ball[i].kind.mass *= random_between(random, 0.8, 1.2);
      l.ball[i].state.r[2] = l.ball[i].kind.radius;
    }
    l.cue.theta = random_between(random, 0.0, 1.0) < 0.5 ? 0.0 : l.cue.theta;
  } else if (start == NOSES) { /* at a place beside a cushion, a jaw or a pocket */
    const carom_table *table = table_of_pool();
    const int what = (int)random_between(random, 0.0, 2.999);
    const carom_jaw *jaw =
        &table->jaw[(int)random_between(random, 0.0, (double)table->jaws - 0.001)];
    const carom_pocket *pocket =
        &table->pocket[(int)random_between(random, 0.0, (double)table->pockets - 0.001)];
    double to[2] = {random_between(random, 0.2, 1.0),
                    random_between(random, 0.0, 1.0) < 0.5 ? 0.0 : 2.54};
    for (int k = 0; k < 2 && what > 0; k++)
      to[k] =
          (what == 1 ? jaw->centre[k] : pocket->centre[k]) + random_between(random, -0.03, 0.03);
    carom_ball_state *s = &l.ball[0].state;
    s->r[0] = 0.3 + random_between(random, 0.0, 0.6);
    s->r[1] = to[1] < 0.6 ? 0.3 : to[1] > 1.9 ? 2.2 : to[1] + random_between(random, -0.2, 0.2);
    l.count = 1;
    fly(s, random, random_between(random, 0.0, 1.0) < 0.3 ? 5e-4 : 0.05, 1.0);
    for (int k = 0; k < 2; k++)
      s->v[k] = (to[k] - s->r[k]) * random_between(random, 3.9, 4.1);
    if (s->r[2] < 0.029) /* near the cloth still */
      s->v[2] = random_between(random, 0.1, 0.6);
  }
  return l;
}

START_TEST(shots_agree_with_differences) {
  enum { SHOTS = 80 };
  const carom_shot_options *options = &kinds[_i].options;
  random_source random = {3};
  const carom_tangent_seeds seeds = seeds_of(directions, DIRECTIONS);
  static double errors[SHOTS * DIRECTIONS], ends[LAYOUT_BALLS * NUMBERS * DIRECTIONS];
  int seen[CAROM_EVENT_LEFT_TABLE + 1] = {0};
  int pairs = 0, without = 0, wrong = 0, flagged = 0, shots = 0, in_flight[4] = {0};
  for (int k = 0; k < SHOTS * 2 && shots < SHOTS; k++) {
    const layout l = draw_in_space(&random, kinds[_i].start);
    carom_shot shot = {.events = events, .room = ROOM, .final = final};
    if (carom_shoot(table_of_pool(), l.ball, l.count, &l.cue, options, &shot) != CAROM_OK)
      continue;
    shots++;
    for (int64_t e = 0; e < shot.count; e++) {
      seen[events[e].type]++;
      if (events[e].before[0].label == CAROM_BALL_AIRBORNE ||
          events[e].before[1].label == CAROM_BALL_AIRBORNE)
        for (int n = 0; n < 4; n++)
          in_flight[n] += events[e].type == CAROM_EVENT_BALL_BALL + n;
    }
    carom_tangent tangent = {.final = ends};
    ck_assert_int_eq(carom_shot_tangent(table_of_pool(), l.ball, l.count, &l.cue, options, &shot,
                                        &seeds, &tangent),
                     CAROM_OK);
    for (int j = 0; j < DIRECTIONS; j++) {
      const double most = largest(ends, NUMBERS * l.count, j, DIRECTIONS);
      double error, plateau;
      if (most == 0.0)
        continue;
      if (!compare(table_of_pool(), &l, options, &shot, &directions[j], ends, j, DIRECTIONS, &error,
                   &plateau)) {
        without++;
        continue;
      }
      errors[pairs++] = error / most;
      if (error / most > 1e-5 && error > 30.0 * plateau) {
        wrong += tangent.all_flags == 0;
        flagged += tangent.all_flags != 0;
        printf("shot %d, direction %d: %.1e off, plateau %.1e, size %.1e, %lld events, flags %d\n",
               k, j, error / most, plateau / most, most, (long long)shot.count,
               (int)tangent.all_flags);
      }
    }
  }
  qsort(errors, (size_t)pairs, sizeof *errors, by_size);
  printf("%-24s %d shots, %4d pairs (%d without a plateau): error median %.1e, 90 %% %.1e, 99 %% "
         "%.1e, largest %.1e; %d wrong "
         "with a "
         "flag\n",
         kinds[_i].name, shots, pairs, without, errors[pairs / 2], errors[pairs * 9 / 10],
         errors[pairs * 99 / 100], errors[pairs - 1], flagged);
  printf("  in flight: %d pairs, %d rails, %d jaws, %d pockets; %d landings, %d tops, %d left\n",
         in_flight[0], in_flight[1], in_flight[2], in_flight[3], seen[CAROM_EVENT_SLATE],
         seen[CAROM_EVENT_RAIL_TOP], seen[CAROM_EVENT_LEFT_TABLE]);
  ck_assert_int_eq(wrong, 0);
  ck_assert_int_gt(pairs, 500);
  ck_assert_double_lt(errors[pairs / 2], 1e-8);
}
END_TEST

/* Two balls in the air that meet head-on without slip, up to the contact; friction holds them,
 * whatever the change is. */
START_TEST(head_on_without_slip) {
  static const direction by = {OF_STATE, 0, 3, 1.0};
  const carom_shot_options options = {.stop_at = CAROM_STOP_AT(CAROM_EVENT_BALL_BALL)};
  layout l = {.count = 2, .ball = {ball_at(0.5, 1.2), ball_at(0.7, 1.2)}};
  l.ball[0].state.v[0] = 2.0;
  for (int i = 0; i < 2; i++)
    l.ball[i].state.r[2] = 0.2;
  static double ends[2 * NUMBERS];
  carom_tangent tangent = {.final = ends};
  const carom_tangent_seeds seeds = seeds_of(&by, 1);
  const carom_shot shot = play(table_of_pool(), l.ball, 2, NULL, &options, CAROM_STOPPED_AT_EVENT);
  ck_assert_int_eq(
      carom_shot_tangent(table_of_pool(), l.ball, 2, NULL, &options, &shot, &seeds, &tangent),
      CAROM_OK);
  double error, plateau;
  ck_assert(compare(table_of_pool(), &l, &options, &shot, &by, ends, 0, 1, &error, &plateau));
  ck_assert_double_lt(error / largest(ends, 2 * NUMBERS, 0, 1), 1e-6);
}
END_TEST

int main(void) {
  const looped_test tests[] = {{shots_agree_with_differences, sizeof kinds / sizeof kinds[0]},
                               {head_on_without_slip, 1}};
  return RUN_LOOPED("tangents_3d", tests);
}
