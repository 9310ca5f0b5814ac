/* Run-outs as one answer: zones by their values, tolerances and shares by strokes that are played
 * anew, and the chance of the whole by matches. */
#include "carom_coach.h"
#include "carom_match.h"
#include "plan_support.h"

static carom_sequence_stroke strokes[CAROM_SEQUENCE_MOST];
static const double within = 0.03;
static const double bad_step = 0.1 / 16.0; /* degrees from a tolerance to a stroke that fails */

static int find_sequence(uint64_t seed, int in_play) {
  int found = 0;
  make_layout(seed, in_play);
  options = (carom_plan_options){.shots = 300, .seed = seed};
  job.memory_size = carom_sequence_memory(&options);
  memory = edge_make(job.memory_size, true);
  job.memory = memory.memory;
  expect_ok(carom_sequence(&job, 0, within, strokes, CAROM_SEQUENCE_MOST, &found));
  return found;
}

/* The estimated value of what a stroke leaves, with the cue ball at a position; -1: it cannot lie
 * there. */
static double value_at(const carom_sequence_stroke *s, double x, double y) {
  carom_plan_rules next_rules = rules;
  carom_plan_job next = job;
  static carom_shot_ball left[CAROM_BALLS_MOST];
  memcpy(left, s->ruling.balls, sizeof left);
  left[0].state.r[0] = x;
  left[0].state.r[1] = y;
  next_rules.state = s->ruling.state;
  next.rules = &next_rules;
  next.balls = left;
  options.chance_opponent = 1.0;
  double value = -1.0;
  carom_plan_value(&next, 0, &value);
  options.chance_opponent = 0.0;
  return value;
}

static bool is_in_zone(const carom_sequence_stroke *s, const double *place) {
  double turns = 0.0; /* of the border about the position */
  for (int k = 0; k < CAROM_ZONE_CORNERS; k++) {
    const double *a = s->zone[k], *b = s->zone[(k + 1) % CAROM_ZONE_CORNERS];
    const double u[2] = {a[0] - place[0], a[1] - place[1]},
                 v[2] = {b[0] - place[0], b[1] - place[1]};
    turns += atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
  }
  return fabs(turns) > 1.0;
}

/* 2: a stroke wins, or plays on into the zone; 1: it plays on elsewhere; 0: neither. */
static int result_of(const carom_sequence_stroke *s, const carom_shot_ball *layout,
                     const carom_rules_state *state, const carom_cue *struck) {
  static carom_ruling ruling;
  carom_facts facts;
  carom_ball_state final[BALLS];
  carom_shot shot = {.facts = &facts, .final = final};
  carom_plan_rules now = rules;
  now.state = *state;
  ck_assert_int_ge(carom_shoot(&table, layout, BALLS, struck, NULL, &shot), 0);
  const carom_call call = {s->choice.ball, s->choice.pocket};
  expect_ok(carom_referee(&now, &table, layout, BALLS, 0, &shot, call, &ruling));
  if (ruling.turn.outcome == CAROM_TURN_WIN)
    return 2;
  if (ruling.turn.outcome != CAROM_TURN_KEEP)
    return 0;
  return 1 + is_in_zone(s, ruling.balls[0].state.r);
}

/* Of 8 run-outs: values at the corners of zones, just within and beyond; strokes without errors at
 * the ends of the tolerances and beyond; and fractions of strokes with other errors. */
TEST(zones_and_tolerances) {
  enum { LAYOUTS = 8, TRIES = 200 };
  double told[2] = {0.0}, came[2] = {0.0};
  int wins = 0, corners = 0, turns = 0;
  for (uint64_t seed = 1; seed <= LAYOUTS; seed++) {
    const int found = find_sequence(seed, 6);
    const carom_shot_ball *layout = balls;
    const carom_rules_state *state = &rules.state;
    for (int n = 0; n < found; n++) {
      const carom_sequence_stroke *s = &strokes[n];
      const double *middle = s->ruling.balls[0].state.r;
      const bool keeps = s->ruling.turn.outcome == CAROM_TURN_KEEP;
      wins += s->ruling.turn.outcome == CAROM_TURN_WIN;
      turns += s->turn_ball >= 0;

      /* a corner is between the last good place and the first bad one, 5 mm apart at most */
      for (int k = 0; k < CAROM_ZONE_CORNERS && keeps; k++) {
        const double x = s->zone[k][0] - middle[0], y = s->zone[k][1] - middle[1];
        const double far = hypot(x, y), more = 1.0 + 0.006 / fmax(far, 1e-9);
        const double beyond = value_at(s, middle[0] + more * x, middle[1] + more * y);
        ck_assert(value_at(s, s->zone[k][0], s->zone[k][1]) >= s->leave_value - within - 1e-12);
        ck_assert(far < 1e-9 || beyond < s->leave_value - within + 1e-3);
        corners += far > 0.01;
      }
      const carom_cue own = s->choice.cue;
      if (result_of(s, layout, state, &own) == 2)
        for (int side = 0; side < 2; side++) {
          carom_cue fast = own, aside = own;
          fast.speed = s->speed[side];
          aside.phi = s->phi[side];
          ck_assert_int_eq(result_of(s, layout, state, &fast), 2);
          ck_assert_int_eq(result_of(s, layout, state, &aside), 2);
          aside.phi += side == 0 ? -bad_step : bad_step;
          const double width = fabs(s->phi[side] - own.phi);
          ck_assert(width > 5.9 || result_of(s, layout, state, &aside) < 2);
        }
      told[1] += s->zone_share / found / LAYOUTS;
      told[0] += s->stray_share / found / LAYOUTS;
      for (uint64_t k = 0; k < TRIES; k++) {
        carom_cue struck = own;
        carom_player_strike(&player, 1000 + seed, k, &struck);
        const int result = result_of(s, layout, state, &struck);
        if (result > 0)
          came[result - 1] += 1.0 / TRIES / found / LAYOUTS;
      }
      layout = s->ruling.balls;
      state = &s->ruling.state;
    }
    edge_free(&memory);
  }
  printf("zone told %.3f, came %.3f; strays %.3f, %.3f; %d wins, %d turns\n", told[1], came[1],
         told[0], came[0], wins, turns);
  ck_assert(fabs(told[1] - came[1]) < 0.02 && fabs(told[0] - came[0]) < 0.02);
  ck_assert(wins >= LAYOUTS - 2 && turns >= 6 && corners > 700);
}

/* A run-out by a match, whose plans are those of carom_match_plan(). */
static bool runs_by_match(uint64_t number) {
  static carom_match match;
  carom_plan_stroke choice;
  int found;
  expect_ok(carom_match_begin_with(&match, &(carom_match_setup){.rules = CAROM_RULES_EIGHTBALL,
                                                                .of = &rules,
                                                                .table = &table,
                                                                .balls = balls,
                                                                .count = BALLS}));
  for (uint64_t n = 0; match.phase != CAROM_MATCH_OVER; n++) {
    options.seed = 7000 + 100 * number + n;
    expect_ok(carom_match_plan(&match, &job, &choice, 1, &found));
    expect_ok(carom_match_prepare(&match, 0, &choice));
    carom_cue struck = choice.cue;
    carom_player_strike(&player, options.seed, 1, &struck);
    expect_ok(carom_match_stroke(&match, 0, &struck, NULL, NULL));
    if (match.phase != CAROM_MATCH_OVER && match.ruling.turn.outcome != CAROM_TURN_KEEP)
      return false;
  }
  return match.winner == 1;
}

/* The chance of the whole is what matches make of the layout; parts of the plays add up. */
TEST(chance_of_the_whole) {
  const int plays = draws_of_test(45, 150), first = plays * 2 / 3;
  const double deviation = sqrt(0.5 * plays); /* of a difference of two counts */
  carom_sequence_counts whole = {0}, parts = {0};
  find_sequence(4, 7);
  options.shots = 100;
  expect_ok(carom_sequence_play(&job, 0, 0, plays, &whole));
  expect_ok(carom_sequence_play(&job, 0, 0, first, &parts));
  expect_ok(carom_sequence_play(&job, 0, first, plays - first, &parts));
  ck_assert(whole.plays == plays && memcmp(&whole, &parts, sizeof whole) == 0);
  int runs = 0;
  options.chance_opponent = 1.0;
  for (uint64_t k = 0; k < (uint64_t)plays; k++)
    runs += runs_by_match(k);
  printf("run-outs: %d told, %d by matches, of %d\n", (int)whole.runs, runs, plays);
  ck_assert_int_gt(whole.runs, plays / 3);
  ck_assert_double_le((double)llabs(whole.runs - runs), 3.0 * deviation);
  edge_free(&memory);
}

TEST(run_outs_refused) {
  int found;
  carom_sequence_counts counts = {0};
  find_sequence(4, 4);
  ck_assert_int_eq(carom_sequence(&job, 0, 0.0, strokes, 1, &found), CAROM_ERROR_OPTIONS);
  ck_assert_int_eq(carom_sequence_play(&job, 0, -1, 1, &counts), CAROM_ERROR_OPTIONS);
  options.safeties = 1;
  ck_assert_int_eq(carom_sequence(&job, 0, within, strokes, 1, &found), CAROM_ERROR_OPTIONS);
  options.safeties = 0;
  job.goal = &(carom_plan_goal){.kind = CAROM_GOAL_HIDDEN};
  ck_assert_int_eq(carom_sequence_play(&job, 0, 0, 1, &counts), CAROM_ERROR_OPTIONS);
  job.memory_size--;
  ck_assert_int_eq(carom_sequence(&job, 0, within, strokes, 1, &found), CAROM_ERROR_NULL);
  edge_free(&memory);
}
