/* What tests of rules share: words of rulings, a shot by its facts, balls that are put, a plan. */
#ifndef CAROM_TESTS_GAME_SUPPORT_H
#define CAROM_TESTS_GAME_SUPPORT_H

#include "carom_match.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  LEGAL = CAROM_FOUL_NONE,
  FIRST = CAROM_FOUL_FIRST,
  CUSHION = CAROM_FOUL_CUSHION,
  DOUBLE_HIT = CAROM_FOUL_DOUBLE_HIT,
  JUMP = CAROM_FOUL_JUMP
};
enum { BALLS_MOST = 22, NONE = -1 };

enum { R1 = 1 << 1, R2 = 1 << 2, Y = 1 << 16, G = 1 << 17, BR = 1 << 18, BL = 1 << 19 };
enum { PI = 1 << 20, BK = 1 << 21, COLOURS = Y | G | BR | BL | PI | BK, ALL = 0x3fffff };
enum { YELLOW = 16, GREEN, BROWN, BLUE, PINK, BLACK };
enum { MAY = CAROM_CHOICE_PASS, FREE = CAROM_CHOICE_FREE_BALL, HAND = CAROM_CHOICE_PLACE };

/* The pockets of the player and of the other. */
enum { MINE = 5, HIS = 2 };

/* A shot whose cue ball met `first`; all that fell is in pocket 2. */
static inline carom_facts facts_of(int first, int cushions, uint32_t down, uint32_t off) {
  carom_facts f = {.first = {first, -1}, .cushions_after = cushions, .down = down, .off = off};
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    f.pocket[k] = down >> k & 1 ? 2 : -1;
  return f;
}

CK_ATTRIBUTE_UNUSED static carom_table table;
CK_ATTRIBUTE_UNUSED static carom_shot_ball balls[CAROM_BALLS_MOST];
CK_ATTRIBUTE_UNUSED static int balls_laid;
CK_ATTRIBUTE_UNUSED static carom_game game_laid;

/* All balls of a rack, of which those that are not in play are down. */
static inline int lay_out(carom_rack_kind kind, carom_table_kind table_kind, uint32_t in_play) {
  const int count = carom_rack_size(kind);
  balls_laid = count;
  game_laid = carom_game_of_table(table_kind);
  carom_table_make(table_kind, &table);
  expect_ok(carom_rack(kind, &table, 1e-4, 1, balls, CAROM_BALLS_MOST));
  for (int k = 0; k < count; k++)
    if (!(in_play >> k & 1))
      balls[k].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
  return count;
}
static inline void put(int ball, double x, double y) {
  balls[ball].state =
      (carom_ball_state){.r = {x, y, balls[ball].kind.radius}, .label = CAROM_BALL_STATIONARY};
}
static inline bool is_at(int ball, double x, double y) {
  return balls[ball].state.label == CAROM_BALL_STATIONARY &&
         hypot(balls[ball].state.r[0] - x, balls[ball].state.r[1] - y) < 1e-9;
}

/* Begins a match of a game that knows equal innings with them, to so many points. */
static inline void begin_equal(carom_match *match, carom_rules_kind kind, uint64_t seed, int side,
                               int target) {
  carom_table_make((carom_table_kind)carom_rules_about_of(kind)->table, &table);
  expect_ok(carom_match_begin_with(match, &(carom_match_setup){.rules = kind,
                                                               .target = target,
                                                               .equal_innings = 1,
                                                               .table = &table,
                                                               .seed = seed,
                                                               .side = side}));
}
static inline bool knows_equal_innings(carom_rules_kind kind) {
  const char *range;
  carom_rules_state state = carom_plan_rules_of(kind).state;
  state.innings = 1;
  return carom_rules_fault(kind, &state, &range) == NULL;
}

/* A plan of so many shots for the balls that lie here, by a player whose errors are `scale`. All
 * plans have one memory. */
static inline carom_plan_job job_of(const carom_plan_rules *game_rules, double scale, int shots) {
  static carom_cue cue;
  static carom_player player;
  static carom_plan_options options;
  static void *memory;
  cue = carom_cue_of(game_laid);
  player = carom_player_of(scale);
  options = (carom_plan_options){.shots = shots};
  const size_t size = carom_plan_memory(&options);
  memory = realloc(memory, size);
  return (carom_plan_job){.table = &table,
                          .balls = balls,
                          .count = balls_laid,
                          .cue = &cue,
                          .player = &player,
                          .rules = game_rules,
                          .options = &options,
                          .memory = memory,
                          .memory_size = size};
}

/* The best strokes of such a plan by the rules of a game; returns how many. */
static inline int best_of(carom_rules_kind kind, int shots, carom_plan_stroke *best, int most) {
  const carom_plan_rules game_rules = carom_plan_rules_of(kind);
  const carom_plan_job job = job_of(&game_rules, 0.2, shots);
  int found;
  expect_ok(carom_plan(&job, best, most, &found));
  return found;
}

#endif
