/* What tests of plans share: a layout of eight-ball, and a job for it. */
#ifndef CAROM_TESTS_PLAN_SUPPORT_H
#define CAROM_TESTS_PLAN_SUPPORT_H

#include "carom_plan.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BALLS = 16, ROOM_OF_BALLS = 22, SOLIDS = 1, STRIPES = 2 };
CK_ATTRIBUTE_UNUSED static const double per_degree = 3.14159265358979323846 / 180.0;

CK_ATTRIBUTE_UNUSED static carom_table table;
CK_ATTRIBUTE_UNUSED static carom_shot_ball balls[ROOM_OF_BALLS];
CK_ATTRIBUTE_UNUSED static carom_cue cue;
CK_ATTRIBUTE_UNUSED static carom_player player;
CK_ATTRIBUTE_UNUSED static carom_plan_rules rules;
CK_ATTRIBUTE_UNUSED static carom_plan_options options;
CK_ATTRIBUTE_UNUSED static carom_shot_options shot_options;
CK_ATTRIBUTE_UNUSED static carom_plan_job job;
CK_ATTRIBUTE_UNUSED static edge memory;

static inline carom_status place_ball(int ball, double x, double y) {
  return carom_place_ball(&table, balls, BALLS, ball, x, y, NULL);
}

/* Balls of eight-ball at random positions of which some are down; the seed is the layout's. */
static inline void make_layout(uint64_t seed, int in_play) {
  random_source r = {seed};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_rack(CAROM_RACK_EIGHTBALL, &table, 1e-4, 1, balls, BALLS);
  for (int k = 0; k < BALLS; k++)
    balls[k].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
  for (int n = 0; n < in_play; n++) {
    const int k = n == 1 ? 8 : n; /* the cue ball, the eight, then 2, 3, ... */
    double x, y;
    do { /* one draw after the other: the order of arguments is the compiler's */
      y = random_between(&r, 0.05, 2.49);
      x = random_between(&r, 0.05, 1.22);
    } while (place_ball(k, x, y) != CAROM_OK);
  }
  cue = carom_cue_of(CAROM_GAME_POOL);
  player = carom_player_of(1.0);
  rules = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
  rules.state.group = SOLIDS;
  options = (carom_plan_options){.shots = 300};
  shot_options = (carom_shot_options){0};
  job = (carom_plan_job){.table = &table,
                         .balls = balls,
                         .count = BALLS,
                         .cue = &cue,
                         .player = &player,
                         .rules = &rules,
                         .shot = &shot_options,
                         .options = &options};
}

static inline void make_memory(void) {
  job.memory_size = carom_plan_memory(&options);
  memory = edge_make(job.memory_size, true);
  job.memory = memory.memory;
}

/* Plans, of a cue ball in hand or not, in memory of its own. Returns how many choices there are. */
static inline int plan(bool in_hand, carom_plan_stroke *choices, int most) {
  int found = 0;
  make_memory();
  expect_ok(in_hand ? carom_plan_hand(&job, NULL, NULL, choices, most, &found)
                    : carom_plan(&job, choices, most, &found));
  edge_free(&memory);
  return found;
}

/* What strokes with errors of another seed make of a cue. */
static inline carom_plan_stroke repeat(const carom_cue *tried) {
  carom_plan_stroke repeated;
  options.seed = 77;
  make_memory();
  expect_ok(carom_plan_try(&job, tried, 1, &repeated));
  edge_free(&memory);
  return repeated;
}

/* The table, the rack, the cue and the rules of a game. */
static inline void lay_out_game(carom_rules_kind kind, uint64_t seed) {
  const carom_rules_about *about = carom_rules_about_of(kind);
  make_layout(1, 2);
  carom_table_make((carom_table_kind)about->table, &table);
  job.count = carom_rack_size((carom_rack_kind)about->rack);
  expect_ok(carom_rack((carom_rack_kind)about->rack, &table, 1e-4, seed, balls, ROOM_OF_BALLS));
  cue = carom_cue_of((carom_game)about->balls);
  rules = carom_plan_rules_of(kind);
}

static inline void make_stroke(random_source *r, uint64_t seed) {
  make_layout(seed, 3);
  cue.tip_restitution = 1.0;
  cue.speed = random_between(r, 1.5, 5.0);
  cue.a = random_between(r, -0.3, 0.3);
  cue.b = random_between(r, -0.3, 0.3);
  cue.theta = fmax(0.0, random_between(r, -20.0, 10.0));
}

static inline void put_ring(int most) {
  static const double ring[6][2] = {{2, 0},  {1, 1.7320508},   {-1, 1.7320508},
                                    {-2, 0}, {-1, -1.7320508}, {1, -1.7320508}};
  place_ball(0, 0.3, 0.3);
  place_ball(1, 0.6, 1.0);
  for (int k = 0; k < most; k++)
    place_ball(k + 2, 0.6 + 0.0287 * ring[k][0], 1.0 + 0.0287 * ring[k][1]);
}

#endif
