/* Every public function with arguments that are right, of which a test can make each wrong in turn:
 * unit/garbage.c all of them, and cases.c those that a line of a file names. All arguments are
 * objects of this file, which set_up() fills. */
#ifndef CAROM_TESTS_FUNCTIONS_H
#define CAROM_TESTS_FUNCTIONS_H

#ifndef CAROM_WITHOUT_PLAN
#include "carom_coach.h"
#include "carom_match.h"
#include "carom_plan.h"
#endif
#include "carom_record.h"
#include "carom_tangent.h"
#include "shot_support.h"

#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* ---- Arguments that are wrong in turn */

enum { ACCEPTED = 1000000 }; /* of a function without a status */

static int argument, wrong_argument, value_index, value_count;
static bool must_be_refused, has_null;

/* Whether this argument is the one that is wrong in this call. */
static bool is_wrong(bool must, int values) {
  if (argument++ != wrong_argument)
    return false;
  must_be_refused = must;
  value_count = values;
  return true;
}

/* Whether this argument, a pointer that must be there, is the wrong one. */
static bool is_null(void) {
  const bool is = is_wrong(true, 1);
  has_null |= is;
  return is;
}

static const double wrong_numbers[] = {NAN, INFINITY, -INFINITY};
static const int wrong_integers[] = {INT_MIN, -1, 1000000, INT_MAX};

#define PTR(x) (is_null() ? NULL : (x))
#define MAYBE(x) (is_wrong(false, 1) ? NULL : (x))
#define NUM(x) (is_wrong(true, 3) ? wrong_numbers[value_index] : (x))
#define ANY(x) (is_wrong(false, 3) ? wrong_numbers[value_index] : (x))
#define TIME(x) (is_wrong(true, 1) ? NAN : (x)) /* an infinite one may be there */
#define INT(x) (is_wrong(true, 4) ? wrong_integers[value_index] : (x))
#define LENGTH(x) (is_wrong(true, 2) ? wrong_integers[value_index] : (x)) /* any may be there */
#define ANYINT(x) (is_wrong(false, 4) ? wrong_integers[value_index] : (x))
#define ENUM(type, x) ((type)INT((int)(x)))
#define ANYENUM(type, x) ((type)ANYINT((int)(x)))

/* ---- Arguments that are right */

enum { BALLS = 10, MEMORY = 1 << 22 };
static carom_table table;
static carom_measures measures;
static carom_shot_ball balls[CAROM_BALLS_MOST];
static carom_cue cue;
static carom_shot_options options;
static carom_ball_state states[2 * CAROM_BALLS_MOST]; /* at two times */
static carom_facts facts;
static carom_shot_state state;
static carom_shot shot, second_shot;
static carom_impact impact;
static carom_impact_f32 impact_f32;
static carom_options impact_options;
static carom_result result;
static carom_result_f32 result_f32;
static carom_cushion_impact rail;
static carom_cushion_options cushion_options;
static carom_motion motion[CAROM_BALLS_MOST];
static carom_tangent_seeds seeds;
static carom_tangent tangent;
static carom_record record;
static carom_shot_job job;
static carom_tangent_job tangent_job;
static carom_bank bank;
static carom_calibration calibration;
static double readings[CAROM_BANKS], times[2], ends[2][CAROM_BALLS_MOST * CAROM_STATE_NUMBERS],
    numbers[32], turned[CAROM_BALLS_MOST][4];
static const double zeros[64];
static char text[70000];
static carom_corner corners[CAROM_RAILS_MOST];

/* Arguments that are one number. */
static int count, place, corners_count, table_kind, points_count, room, found, where, bank_index;
static double place_x, place_y, radius, height, jaw_radius, gap;

static carom_detail detail;
static carom_trace_point points[3];
static carom_cushion_point cushion_points[3];
static carom_cluster_contact contacts[4];
static carom_ball_kind kind;
static carom_frames frames;
static carom_fault fault;
static carom_table_fault table_fault;
static carom_part part;
static int32_t flags;
static int8_t status;

static void set_up_games(void);

/* A nine-ball break that was stopped after half a second, two balls of which one rolls, and all
 * else. */
static void set_up(void) {
  static const carom_corner triangle[] = {{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {0.0, 1.0, 0.0}};
  const carom_ball ball = {.r = {0.0, 0.0, 0.03}, .radius = 0.03, .mass = 0.17, .mu_slide = 0.2};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_table_measures(CAROM_TABLE_POOL_9FT, &measures);
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, BALLS);
  count = BALLS;
  cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 5.0;
  shot = (carom_shot){
      .events = events, .room = ROOM, .final = final, .facts = &facts, .state = &state};
  options = (carom_shot_options){.time_most = 0.5};
  carom_shoot(&table, balls, BALLS, &cue, &options, &shot);
  options.time_most = 0.0;
  impact = (carom_impact){.a = ball, .b = ball, .mu_ball = 0.05, .restitution = 0.95};
  impact.b.r[1] = 0.06;
  impact.a.v[0] = 0.3;
  impact.a.v[1] = 1.0;
  impact.a.w[0] = -33.0;
  impact.a.w[1] = 10.0;
  impact_f32 = narrowed(&impact);
  impact_options = (carom_options){0};
  cushion_options = (carom_cushion_options){0};
  rail = (carom_cushion_impact){
      {0.5, 1.2, 0.0}, {0.0}, {0.0, 1.0}, 0.0365, 0.028575, 0.17, 0.2, 0.2, 0.85, 0.0};
  seeds = (carom_tangent_seeds){.directions = 1, .cue = zeros};
  tangent = (carom_tangent){.final = ends[0], .times = times, .times_count = 1, .at = ends[1]};
  record.table = table;
  record.count = BALLS;
  record.cue = cue;
  memcpy(record.balls, balls, sizeof record.balls);
  second_shot = (carom_shot){.final = states};
  job = (carom_shot_job){.table = &table,
                         .balls = balls,
                         .count = BALLS,
                         .cues = &cue,
                         .n = 1,
                         .shots = &shot,
                         .status = &status};
  tangent_job = (carom_tangent_job){.played = &job, .seeds = &seeds, .tangents = &tangent};
  for (int k = 0; k < CAROM_BANKS; k++)
    readings[k] = 2.0 + 0.5 * k;
  memcpy(corners, triangle, sizeof triangle);
  status = 77;
  where = -2;
  result = (carom_result){0};
  memset(motion, 0, sizeof motion);
  times[0] = 0.1;
  times[1] = 0.2;
  place_x = 0.3;
  place_y = 0.4;
  radius = 0.028575;
  height = 0.0366;
  jaw_radius = 0.01;
  gap = 1e-4;
  place = bank_index = 0;
  corners_count = points_count = 3;
  table_kind = CAROM_TABLE_POOL_9FT;
  room = 4;
  set_up_games();
}

/* A shot that was played to its end. */
static carom_shot *whole(void) {
  shot.count = 0;
  shot.state = NULL;
  carom_shoot(&table, balls, count, &cue, NULL, &shot);
  return &shot;
}
/* The job of a batch that was played. */
static const carom_tangent_job *played_job(void) {
  job.shots = whole();
  return &tangent_job;
}
/* The status of this shot in a batch behind a good one, which has a result, unless what is wrong
 * belongs to both: the table, the options, or a height of noses or tops for balls of both. */
static inline int64_t shoot_pair(void) {
  static carom_shot_ball layouts[2 * CAROM_BALLS_MOST];
  const carom_cue cues[] = {carom_cue_of(CAROM_GAME_POOL), cue};
  carom_shot shots[2] = {{0}, {0}};
  int8_t statuses[2] = {99, 99};
  memcpy(layouts + count, balls, (size_t)count * sizeof *balls);
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, layouts, count);
  const carom_shot_job pair = {.table = &table,
                               .balls = layouts,
                               .cues = cues,
                               .count = count,
                               .ball_stride = (uint64_t)count,
                               .cue_stride = 1,
                               .n = 2,
                               .options = &options,
                               .shots = shots,
                               .status = statuses};
  const carom_status returned = carom_shoot_batch(&pair);
  if (statuses[0] != 99) {
    const bool both = returned == CAROM_ERROR_NOSE_HEIGHT || table.rail_width > 0.0;
    ck_assert_int_eq(statuses[0], both ? returned : CAROM_OK);
    ck_assert_int_eq(statuses[1], returned);
    ck_assert_int_eq(shots[0].count > 0, !both);
  }
  return returned;
}
static const char *line_of_record(void) {
  carom_record_write(&record, CAROM_RECORD_HEAD, text, sizeof text);
  return text;
}
static int64_t is_text(const char *word) {
  return word != NULL ? ACCEPTED : -1;
}

/* ---- The functions of physics. F(name, call): the call gives a status, or ACCEPTED. */

#define PHYSICS_FUNCTIONS(F)                                                                       \
  F(alciatore, (carom_alciatore(), ACCEPTED))                                                      \
  F(bank_of, carom_bank_of(INT(bank_index), PTR(&bank)))                                           \
  F(calibrate,                                                                                     \
    carom_calibrate(PTR(&table), PTR(&balls[0].kind), MAYBE(readings), PTR(&calibration)))         \
  F(ball_fault, (carom_ball_fault(MAYBE(&balls[0].kind), MAYBE(text), 99), ACCEPTED))              \
  F(ball_kind_for,                                                                                 \
    (carom_ball_kind_for(ANYENUM(carom_game, 0), ANYENUM(carom_shot_cushion, 0), MAYBE(&kind)),    \
     ACCEPTED))                                                                                    \
  F(ball_kind_of, (carom_ball_kind_of(ANYENUM(carom_game, 0)), ACCEPTED))                          \
  F(check, carom_check(PTR(&impact), MAYBE(&impact_options), MAYBE(&where)))                       \
  F(cite, (carom_cite(NULL, MAYBE(text), 10), ACCEPTED))                                           \
  F(collide, carom_collide(PTR(&impact), MAYBE(&impact_options), PTR(&result)))                    \
  F(cluster, carom_cluster(PTR(balls), INT(count), MAYBE(&options), PTR(motion), PTR(contacts),    \
                           LENGTH(room), MAYBE(&found)))                                           \
  F(collide_batch,                                                                                 \
    carom_collide_batch(PTR(&impact), 1, MAYBE(&impact_options), PTR(&result), MAYBE(&status)))    \
  F(collide_batch_f32,                                                                             \
    carom_collide_batch_f32(PTR(&impact_f32), 1, NULL, PTR(&result_f32), MAYBE(&status)))          \
  F(collide_detail,                                                                                \
    carom_collide_detail(PTR(&impact), MAYBE(&impact_options), PTR(&result), MAYBE(&detail)))      \
  F(collide_tangent,                                                                               \
    carom_collide_tangent(PTR(&impact), NULL, INT(1), PTR(zeros), PTR(numbers), MAYBE(&flags)))    \
  F(cue_of, (carom_cue_of(ANYENUM(carom_game, 0)), ACCEPTED))                                      \
  F(cushion, carom_cushion(PTR(&rail), MAYBE(&cushion_options), PTR(motion)))                      \
  F(cushion_batch,                                                                                 \
    carom_cushion_batch(PTR(&rail), 1, MAYBE(&cushion_options), PTR(motion), MAYBE(&status)))      \
  F(cushion_check, carom_cushion_check(PTR(&rail), MAYBE(&cushion_options), MAYBE(&where)))        \
  F(cushion_field_name, (carom_cushion_field_name(ANYINT(0)), ACCEPTED))                           \
  F(cushion_model_name, (carom_cushion_model_name(ANYENUM(carom_cushion_model, 0)), ACCEPTED))     \
  F(condition_give, (carom_condition_give(ANYENUM(carom_condition, 0), MAYBE(&kind)), ACCEPTED))   \
  F(cushion_start, (carom_cushion_start(ANYENUM(carom_cushion_model, 0), MAYBE(&kind)), ACCEPTED)) \
  F(cushion_tangent,                                                                               \
    carom_cushion_tangent(PTR(&rail), NULL, INT(1), PTR(zeros), PTR(numbers), MAYBE(&flags)))      \
  F(cushion_trace, carom_cushion_trace(PTR(&rail), MAYBE(&cushion_options), (size_t)points_count,  \
                                       PTR(cushion_points)))                                       \
  F(event_name, (carom_event_name(ANYENUM(carom_event_type, 0)), ACCEPTED))                        \
  F(field_name, (carom_field_name(ANYINT(0)), ACCEPTED))                                           \
  F(impact3, carom_impact3(PTR(&impact), PTR(&result)))                                            \
  F(isa_available, (carom_isa_available(ANYENUM(carom_isa, 0)), ACCEPTED))                         \
  F(isa_in_force, (carom_isa_in_force(), ACCEPTED))                                                \
  F(isa_limit, (carom_isa_limit(ANYENUM(carom_isa, 0)), ACCEPTED))                                 \
  F(isa_name, (carom_isa_name(ANYENUM(carom_isa, 0)), ACCEPTED))                                   \
  F(label_name, (carom_label_name(ANYENUM(carom_label, 0)), ACCEPTED))                             \
  F(mu_ball, isnan(carom_mu_ball(PTR(&impact), carom_alciatore())) ? -1 : ACCEPTED)                \
  F(number_is_read, (carom_number_is_read(MAYBE(carom_number_of(CAROM_PART_BALL, 0)),              \
                                          MAYBE(&balls[0].kind), NULL),                            \
                     ACCEPTED))                                                                    \
  F(number_of, (carom_number_of(ANYENUM(carom_part_kind, 4), ANYINT(0)), ACCEPTED))                \
  F(number_range,                                                                                  \
    (carom_number_range(MAYBE(carom_number_of(CAROM_PART_BALL, 0)), MAYBE(text), 99), ACCEPTED))   \
  F(physics_revision, (carom_physics_revision(), ACCEPTED))                                        \
  F(place_ball, carom_place_ball(PTR(&table), PTR(balls), INT(count), INT(place), NUM(place_x),    \
                                 NUM(place_y), MAYBE(&part)))                                      \
  F(pocket_name, (carom_pocket_name(MAYBE(&table), ANYINT(0)), ACCEPTED))                          \
  F(rack,                                                                                          \
    carom_rack(ENUM(carom_rack_kind, 0), PTR(&table), NUM(gap), 1, PTR(balls), LENGTH(count)))     \
  F(rack_name, (carom_rack_name(ANYENUM(carom_rack_kind, 0)), ACCEPTED))                           \
  F(rack_size, (carom_rack_size(ANYENUM(carom_rack_kind, 0)), ACCEPTED))                           \
  F(rail_name, (carom_rail_name(MAYBE(&table), ANYINT(0)), ACCEPTED))                              \
  F(record_hand, carom_record_hand(PTR(&record), INT(place)))                                      \
  F(record_place,                                                                                  \
    carom_record_place(PTR(&record), INT(place), NUM(place_x), NUM(place_y), MAYBE(&part)))        \
  F(record_play,                                                                                   \
    carom_record_play(PTR(&record), ENUM(carom_record_kind, CAROM_RECORD_SHOT), NULL))             \
  F(record_read, carom_record_read(PTR(&record), PTR(line_of_record()), strlen(text)))             \
  F(record_settle, carom_record_settle(PTR(&record)))                                              \
  F(record_write,                                                                                  \
    (carom_record_write(MAYBE(&record), ANYENUM(carom_record_kind, 1), MAYBE(text), sizeof text),  \
     ACCEPTED))                                                                                    \
  F(rolling_velocity,                                                                              \
    (carom_rolling_velocity(MAYBE(zeros), MAYBE(zeros), ANY(0.03), MAYBE(numbers)), ACCEPTED))     \
  F(serves, (carom_serves(ANYINT(1)), ACCEPTED))                                                   \
  F(shoot,                                                                                         \
    carom_shoot(PTR(&table), PTR(balls), INT(count), MAYBE(&cue), MAYBE(&options), PTR(&shot)))    \
  F(shoot_batch, carom_shoot_batch(PTR(&job)))                                                     \
  F(shot_at, carom_shot_at(PTR(balls), INT(count), PTR(&shot), TIME(times[0]), PTR(states)))       \
  F(shot_at_times,                                                                                 \
    carom_shot_at_times(PTR(balls), INT(count), PTR(&shot), PTR(times), 2, PTR(states)))           \
  F(shot_check, carom_shot_check(PTR(&table), PTR(balls), INT(count), MAYBE(&cue),                 \
                                 MAYBE(&options), MAYBE(&where)))                                  \
  F(shot_continue,                                                                                 \
    carom_shot_continue(PTR(&table), PTR(balls), INT(count), MAYBE(&options), PTR(&shot)))         \
  F(shot_drawn,                                                                                    \
    carom_shot_drawn(PTR(&table), PTR(balls), INT(count), PTR(&shot), PTR(times), 1, PTR(states))) \
  F(shot_falls,                                                                                    \
    carom_shot_falls(PTR(&table), PTR(balls), INT(count), PTR(&shot), PTR(times), 1, PTR(states))) \
  F(shot_fault, carom_shot_fault(PTR(&table), PTR(balls), INT(count), MAYBE(&cue),                 \
                                 MAYBE(&options), PTR(&fault), MAYBE(text), 99))                   \
  F(shot_frames, carom_shot_frames(PTR(balls), INT(count), PTR(&shot), PTR(times), 1,              \
                                   MAYBE(&frames), MAYBE(states), MAYBE(turned)))                  \
  F(event_slip,                                                                                    \
    isnan(carom_event_slip(PTR(&table), PTR(balls), INT(count), PTR(&events[1]))) ? -1 : ACCEPTED) \
  F(shot_orientation,                                                                              \
    carom_shot_orientation(PTR(balls), INT(count), PTR(&shot), TIME(times[0]), PTR(turned)))       \
  F(shot_tangent,                                                                                  \
    carom_shot_tangent(PTR(&table), PTR(balls), INT(count), is_wrong(true, 1) ? NULL : &cue, NULL, \
                       PTR(whole()), PTR(&seeds), PTR(&tangent)))                                  \
  F(shot_tangent_batch, carom_shot_tangent_batch(PTR(played_job())))                               \
  F(slip_name, (carom_slip_name(ANYENUM(carom_slip, 0)), ACCEPTED))                                \
  F(solver_name, (carom_solver_name(ANYENUM(carom_solver, 0)), ACCEPTED))                          \
  F(spot_of, carom_spot_of(ENUM(carom_rack_kind, 0), PTR(&table), INT(1), PTR(numbers)))           \
  F(status_name, is_text(carom_status_name(ANYENUM(carom_status, 0))))                             \
  F(status_string, is_text(carom_status_string(ANYENUM(carom_status, 0))))                         \
  F(strike, carom_strike(PTR(&cue), PTR(&balls[0].kind), PTR(motion)))                             \
  F(table_check, carom_table_check(PTR(&table), NUM(radius), MAYBE(&table_fault)))                 \
  F(table_make, carom_table_make(ENUM(carom_table_kind, table_kind), PTR(&table)))                 \
  F(table_marks, carom_table_marks(PTR(&table), PTR(&marks)))                                      \
  F(table_measured,                                                                                \
    carom_table_measured(PTR(&measures), NUM(radius), PTR(&table), MAYBE(&table_fault)))           \
  F(table_measures, carom_table_measures(ENUM(carom_table_kind, table_kind), PTR(&measures)))      \
  F(table_name, (carom_table_name(ANYENUM(carom_table_kind, 0)), ACCEPTED))                        \
  F(table_polygon,                                                                                 \
    carom_table_polygon(PTR(corners), INT(corners_count), NUM(height), NUM(jaw_radius),            \
                        NUM(radius), PTR(&table), MAYBE(&table_fault)))                            \
  F(trace, carom_trace(PTR(&impact), MAYBE(&impact_options), (size_t)points_count, PTR(points)))   \
  F(version, is_text(carom_version()))                                                             \
  F(version_number, (carom_version_number(), ACCEPTED))                                            \
  F(word, (carom_word(ANYENUM(carom_words, 0), ANYINT(0)), ACCEPTED))                              \
  F(word_text, (carom_word_text(ANYENUM(carom_words, 0), ANYINT(0)), ACCEPTED))

/* ---- The functions of games */

#ifdef CAROM_WITHOUT_PLAN
static void set_up_games(void) {
}
#define FUNCTIONS(F) PHYSICS_FUNCTIONS(F)
#else
static _Alignas(64) char memory[MEMORY];
static carom_cue aimed;
static carom_plan_rules rules;
static carom_player player;
static carom_plan_options plan_options;
static carom_plan_job plan;
static carom_ruling ruling;
static carom_plan_stroke choices[4];
static carom_match_setup setup;
static carom_seating seating;
static carom_standing standing;
static carom_match match;
static carom_bounds bounds;
static carom_marks marks;
static carom_turn settled;
static carom_rules_state rules_state;
static const char *range;
static carom_rating rating;
static carom_pot pot;
static const carom_score score = {500.0, 3.0, 2.0};
static const carom_plan_stroke safety = {.ball = -1};
/* The jobs of a coach, of the same layout. */
static carom_shot_way ways[4];
static carom_ways_result ways_result;
static carom_break_counts break_counts;
static carom_why why;
static const carom_ways_job *ways_job(void) {
  static carom_ways_job searched;
  searched = (carom_ways_job){.table = &table,
                              .balls = balls,
                              .count = BALLS,
                              .cues = &cue,
                              .strokes = 1,
                              .player = &player,
                              .scan = 90,
                              .ball = -1,
                              .pocket = -1,
                              .memory = memory,
                              .memory_size = MEMORY};
  return &searched;
}
static carom_shot_way *stroke_way(void) {
  ways[0] = (carom_shot_way){.cue = cue, .ball = 1};
  return ways;
}
static const carom_break_job *break_job(void) {
  static carom_break_job breaks;
  breaks = (carom_break_job){.table = &table,
                             .balls = balls,
                             .count = BALLS,
                             .cue = &cue,
                             .player = &player,
                             .rack = CAROM_RACK_NINEBALL,
                             .gap = 1e-4,
                             .memory = memory,
                             .memory_size = MEMORY};
  return &breaks;
}
static const carom_plan_stroke *stroke_choice(void) {
  choices[0] = (carom_plan_stroke){.cue = cue, .ball = -1, .pocket = -1};
  memcpy(choices[0].place, balls[0].state.r, sizeof choices[0].place);
  return choices;
}

static void set_up_games(void) {
  rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  player = carom_player_of(1.0);
  plan_options = (carom_plan_options){.shots = 100};
  pot = (carom_pot){.ball = 1};
  setup = (carom_match_setup){.rules = CAROM_RULES_NINEBALL, .table = &table};
  plan = (carom_plan_job){.table = &table,
                          .balls = balls,
                          .count = BALLS,
                          .cue = &cue,
                          .player = &player,
                          .rules = &rules,
                          .options = &plan_options,
                          .memory = memory,
                          .memory_size = MEMORY};
}
/* A plan that has begun. */
static const carom_plan_job *sliced_plan(void) {
  int begun;
  plan_options.slice = 10;
  carom_plan(&plan, choices, 4, &begun);
  return &plan;
}
/* A match that has begun: the cue ball is in hand. */
static carom_match *begun(void) {
  carom_match_begin(&match, CAROM_RULES_NINEBALL, &table, 1, 0);
  return &match;
}
/* A match whose cue ball is placed, and one whose balls move. */
static carom_match *ready(void) {
  carom_match_place(begun(), 0, 0.6, 0.5);
  return &match;
}
static carom_match *moving(void) {
  const carom_shot_options half = {.time_most = 0.5};
  carom_match_stroke(ready(), 0, &cue, &half, NULL);
  return &match;
}

#define GAME_FUNCTIONS(F)                                                                          \
  F(hand_bounds, carom_hand_bounds(ENUM(carom_leave, CAROM_LEAVE_KITCHEN), PTR(&table), NUM(0.03), \
                                   PTR(&bounds)))                                                  \
  F(is_within, (carom_is_within(MAYBE(&bounds), ANY(0.5), ANY(0.5)), ACCEPTED))                    \
  F(match_begin, carom_match_begin(PTR(&match), ENUM(carom_rules_kind, CAROM_RULES_NINEBALL),      \
                                   PTR(&table), 1, INT(0)))                                        \
  F(match_begin_to,                                                                                \
    carom_match_begin_to(PTR(&match), ENUM(carom_rules_kind, CAROM_RULES_STRAIGHT), ANYINT(10),    \
                         INT(0), PTR(&table), 1, INT(0)))                                          \
  F(match_begin_at,                                                                                \
    carom_match_begin_at(PTR(&match), ANYENUM(carom_rules_kind, CAROM_RULES_NINEBALL),             \
                         MAYBE(&rules), PTR(&table), PTR(balls), INT(count), NULL,                 \
                         ENUM(carom_leave, CAROM_LEAVE_ANYWHERE), INT(0)))                         \
  F(match_begin_with, carom_match_begin_with(PTR(&match), PTR(&setup)))                            \
  F(match_call,                                                                                    \
    (carom_match_call(MAYBE(ready()), ANYINT(0), ((carom_call){ANYINT(1), ANYINT(1)})), ACCEPTED)) \
  F(match_choose,                                                                                  \
    (carom_match_choose(MAYBE(ready()), ANYINT(0), ANYENUM(carom_choice, CAROM_CHOICE_PUSH)),      \
     ACCEPTED))                                                                                    \
  F(match_clock, carom_match_clock(PTR(ready()), INT(0)))                                          \
  F(match_concede, carom_match_concede(PTR(ready()), INT(0)))                                      \
  F(match_continue, carom_match_continue(PTR(moving()), NULL, MAYBE(&second_shot)))                \
  F(match_end, carom_match_end(PTR(ready())))                                                      \
  F(match_extend, (carom_match_extend(MAYBE(ready()), ANYINT(0)), ACCEPTED))                       \
  F(match_next, (carom_match_next(MAYBE(ready())), ACCEPTED))                                      \
  F(match_place, carom_match_place(PTR(begun()), INT(0), NUM(0.6), NUM(0.5)))                      \
  F(match_plan, carom_match_plan(PTR(ready()), PTR(&plan), PTR(choices), LENGTH(4), PTR(&found)))  \
  F(match_prepare, carom_match_prepare(PTR(ready()), INT(0), PTR(&safety)))                        \
  F(match_read, (carom_match_read(MAYBE(&match), MAYBE(&record), MAYBE("{}"), 2), ACCEPTED))       \
  F(match_read_from,                                                                               \
    (carom_match_read_from(MAYBE(&match), MAYBE(&record), MAYBE("{}"), 2, ANYINT(0)), ACCEPTED))   \
  F(match_replay, carom_match_replay(PTR(moving()), PTR(&second_shot)))                            \
  F(match_standing, carom_match_standing(PTR(&match), PTR(&standing)))                             \
  F(match_string, (carom_match_string(MAYBE(&match), NULL, 0), ACCEPTED))                          \
  F(match_timeout, (carom_match_timeout(MAYBE(ready()), ANYINT(0)), ACCEPTED))                     \
  F(match_undone, (carom_match_undone(MAYBE("{}"), 2), ACCEPTED))                                  \
  F(seating_make,                                                                                  \
    carom_seating_make(ANYENUM(carom_rules_kind, CAROM_RULES_NINEBALL), INT(2), PTR(&seating)))    \
  F(match_stroke, carom_match_stroke(PTR(ready()), INT(0), PTR(&cue), NULL, MAYBE(&second_shot)))  \
  F(refusal_name, (carom_refusal_name(ANYINT(1)), ACCEPTED))                                       \
  F(cue_ball_of, (carom_cue_ball_of(MAYBE(&rules)), ACCEPTED))                                     \
  F(aim, carom_aim(PTR(&table), PTR(balls), INT(count), NULL, PTR(&pot), PTR(&aimed)))             \
  F(foul_of, (carom_foul_of(MAYBE(&facts), 2, ANYINT(0)), ACCEPTED))                               \
  F(foul_string, is_text(carom_foul_string(ANYINT(0))))                                            \
  F(game_word, (carom_game_word(ANYENUM(carom_game_words, 0), ANYINT(0)), ACCEPTED))               \
  F(game_word_text, (carom_game_word_text(ANYENUM(carom_game_words, 0), ANYINT(0)), ACCEPTED))     \
  F(is_beside, (carom_is_beside(MAYBE(&table), ANYINT(0), ANYINT(0)), ACCEPTED))                   \
  F(plan, carom_plan(PTR(&plan), PTR(choices), LENGTH(4), PTR(&found)))                            \
  F(plan_continue, carom_plan_continue(PTR(sliced_plan()), PTR(choices), LENGTH(4), PTR(&found)))  \
  F(plan_hand,                                                                                     \
    carom_plan_hand(PTR(&plan), MAYBE(zeros), NULL, PTR(choices), LENGTH(4), PTR(&found)))         \
  F(break_has_rules, (carom_break_has_rules(ANYENUM(carom_rack_kind, 0)), ACCEPTED))               \
  F(break_memory, (carom_break_memory(), ACCEPTED))                                                \
  F(break_play, carom_break_play(PTR(break_job()), ANYINT(0), LENGTH(1), PTR(&break_counts)))      \
  F(break_spread, (carom_break_spread(MAYBE(&break_counts), MAYBE(numbers)), ACCEPTED))            \
  F(break_stroke, carom_break_stroke(PTR(break_job()), ANYINT(0), PTR(balls), PTR(&aimed)))        \
  F(names_ball, (carom_names_ball(MAYBE(choices)), ACCEPTED))                                      \
  F(plan_replay,                                                                                   \
    carom_plan_replay(PTR(&plan), PTR((carom_plan_stroke *)stroke_choice()), LENGTH(1)))           \
  F(way_chance, carom_way_chance(PTR(ways_job()), PTR(stroke_way())))                              \
  F(way_succeeds, (carom_way_succeeds(MAYBE(ways_job()), MAYBE(whole()), MAYBE(ways)), ACCEPTED))  \
  F(ways, carom_ways(PTR(ways_job()), PTR(ways), LENGTH(4), PTR(&ways_result)))                    \
  F(ways_memory, (carom_ways_memory(ANYINT(4)), ACCEPTED))                                         \
  F(why_of, carom_why_of(PTR(&plan), PTR(stroke_choice()), PTR(&why)))                             \
  F(plan_kind_name, is_text(carom_plan_kind_name(ANYENUM(carom_plan_kind, 0))))                    \
  F(plan_memory, (carom_plan_memory(MAYBE(&plan_options)), ACCEPTED))                              \
  F(plan_rules_of, (carom_plan_rules_of(ANYENUM(carom_rules_kind, 0)), ACCEPTED))                  \
  F(plan_try, carom_plan_try(PTR(&plan), PTR(&cue), INT(1), PTR(choices)))                         \
  F(plan_value, carom_plan_value(PTR(&plan), ANYINT(0), PTR(numbers)))                             \
  F(player_fargo, (carom_player_fargo(ANY(500.0)), ACCEPTED))                                      \
  F(player_of, (carom_player_of(ANY(1.0)), ACCEPTED))                                              \
  F(player_strike, (carom_player_strike(MAYBE(&player), 1, 1, MAYBE(&aimed)), ACCEPTED))           \
  F(pot_kind,                                                                                      \
    (carom_pot_kind(MAYBE(&table), MAYBE(&shot), ANYINT(0), ANYINT(1), ANYINT(0)), ACCEPTED))      \
  F(rating_of, carom_rating_of(PTR(&score), LENGTH(1), PTR(&rating)))                              \
  F(referee, carom_referee(PTR(&rules), PTR(&table), PTR(balls), INT(count), INT(0),               \
                           MAYBE(whole()), ((carom_call){ANYINT(1), ANYINT(1)}), PTR(&ruling)))    \
  F(rules_about_of, (carom_rules_about_of(ANYENUM(carom_rules_kind, 0)), ACCEPTED))                \
  F(rules_fault,                                                                                   \
    (carom_rules_fault(ANYENUM(carom_rules_kind, 0), MAYBE(&rules_state), MAYBE(&range)),          \
     ACCEPTED))                                                                                    \
  F(ruling_string, (carom_ruling_string(MAYBE(&ruling), MAYBE(text), 99), ACCEPTED))               \
  F(spot_ball, carom_spot_ball(PTR(&table), PTR(balls), INT(count), INT(1)))                       \
  F(spot_ball_of,                                                                                  \
    carom_spot_ball_of(ENUM(carom_rack_kind, 0), PTR(&table), PTR(balls), INT(count), INT(1)))     \
  F(stroke_marks, (carom_stroke_marks(MAYBE(&facts), ANYINT(0)), ACCEPTED))                        \
  F(turn_settle, carom_turn_settle(PTR(&rules), PTR(&rules_state), PTR(&table), PTR(balls),        \
                                   INT(count), PTR(&settled)))

#define FUNCTIONS(F) PHYSICS_FUNCTIONS(F) GAME_FUNCTIONS(F)
#endif

#define BODY(name, call)             \
  static int64_t call_##name(void) { \
    return (int64_t)(call);          \
  }
FUNCTIONS(BODY)
#undef BODY

#define ROW(name, call) {"carom_" #name, call_##name},
static const struct {
  const char *name;
  int64_t (*call)(void);
} functions[] = {FUNCTIONS(ROW)};
#undef ROW
enum { COUNT = COUNT_OF(functions) };

#endif
