/* Every public function with arguments that are right. A test can make each wrong in turn:
 * garbage.c all of them, and cases.c those that a line of a file names. at_once.c calls
 * all functions at once, stack.c on small stacks. All arguments are objects of this file, and
 * set_up() fills them. Where a test defines OWN as _Thread_local, each thread has its own. */
#ifndef CAROM_TESTS_FUNCTIONS_H
#define CAROM_TESTS_FUNCTIONS_H

#ifndef CAROM_WITHOUT_PLAN
#include "carom_coach.h"
#include "carom_match.h"
#endif
#include "carom_record.h"
#include "carom_tangent.h"
#include "shot_support.h"

#include <limits.h>

#ifndef OWN
#define OWN
#endif

/* ---- Arguments that are wrong in turn */

enum { ACCEPTED = 1000000 }; /* of a function without a status */

static OWN int argument, wrong_argument = -1, value_index, value_count;
static OWN bool must_be_refused, has_null;

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

/* What set_up() fills: 0 for few balls, and one row of each batch; others for more, at random. */
static OWN int variant, threads;

enum {
  BALLS = 10,
  MEMORY = 1 << 22,
  BATCH = 256,
  SHOTS = 8,
  BRIEF = 600,
  SLOPES = 16 * CAROM_STATE_NUMBERS * CAROM_DIRECTIONS_MOST
};

/* What a thread has on its heap. */
static struct heap {
  carom_brief_event brief[SHOTS][BRIEF];
  double ends[SHOTS][SLOPES], before[BRIEF * 2 * CAROM_STATE_NUMBERS * CAROM_DIRECTIONS_MOST],
      times[BRIEF * CAROM_DIRECTIONS_MOST];
  _Alignas(64) char memory[MEMORY];
} heap_of_main;
static OWN struct heap *heap = &heap_of_main;
static OWN carom_event *own_events = events;
static OWN carom_ball_state *own_final = final;

static OWN carom_table table;
static OWN carom_measures measures;
static OWN carom_shot_ball balls[CAROM_BALLS_MOST];
static OWN carom_cue cue, cues[SHOTS];
static OWN carom_shot_options options, whole_options;
static OWN carom_ball_state states[2 * CAROM_BALLS_MOST]; /* at two times */
static OWN carom_facts facts;
static OWN carom_shot_state state;
static OWN carom_shot shot, second_shot, shots[SHOTS];
static OWN carom_impact impacts[BATCH];
static OWN carom_impact_f32 impacts_f32[BATCH];
static OWN carom_options impact_options;
static OWN carom_result results[BATCH];
static OWN carom_result_f32 results_f32[BATCH];
static OWN carom_cushion_impact rails[BATCH];
static OWN carom_cushion_options cushion_options;
static OWN carom_motion motion[BATCH];
static OWN carom_tangent_seeds seeds;
static OWN carom_tangent tangents[SHOTS];
static OWN carom_record record;
static OWN carom_shot_job job;
static OWN carom_tangent_job tangent_job;
static OWN carom_bank bank;
static OWN carom_calibration calibration;
static OWN double readings[CAROM_BANKS], times[2], reach[CAROM_DIRECTIONS_MOST], slopes[SLOPES],
    numbers[12 * CAROM_DIRECTIONS_MOST], turned[CAROM_BALLS_MOST][4];
static OWN char text[CAROM_RECORD_TEXT];
static const double zeros[64];
static OWN carom_corner corners[CAROM_RAILS_MOST];

/* Arguments that are one number. */
static OWN int count, place, corners_count, table_kind, points_count, room, found, where,
    bank_index;
static OWN double place_x, place_y, radius, height, jaw_radius, gap;
static OWN carom_rack_kind rack_kind;
static OWN size_t rows;

static OWN carom_speed_law law;
static OWN carom_detail detail;
static OWN carom_trace_point points[3];
static OWN carom_cushion_point cushion_points[3];
static OWN carom_cluster_contact contacts[4];
static OWN carom_ball_kind kind;
static OWN carom_frames frames;
static OWN carom_fault fault;
static OWN carom_table_fault table_fault;
static OWN carom_part part;
static OWN carom_marks marks;
static OWN int32_t flags;
static OWN int8_t statuses[BATCH];

/* What a function without a status gives: a number, or a text. */
static OWN uint64_t given;
#define GIVES(call) (given = (uint64_t)(call), ACCEPTED)
static int64_t is_number(double value) {
  memcpy(&given, &value, sizeof value);
  return isnan(value) ? -1 : ACCEPTED;
}
static int64_t is_text(const char *word) {
  given = word != NULL ? hash_of(1, word, strlen(word)) : 0;
  return word != NULL ? ACCEPTED : -1;
}

static void set_up_games(void);

/* Rows of batches at random, and derivatives by all directions. */
static void draw_rows(void) {
  random_source random = {test_seed() + (uint64_t)variant};
  random_vector(&random, COUNT_OF(slopes), -1.0, 1.0, slopes);
  for (int k = 0; k < BATCH; k++) {
    impacts[k] = random_impact(&random);
    impacts_f32[k] = narrowed(&impacts[k]);
    rails[k] = random_cushion(&random);
  }
  for (int k = 0; k < SHOTS; k++) {
    cues[k] = cue;
    cues[k].phi += 0.3 * k;
    shots[k] = (carom_shot){.brief = heap->brief[k], .room = BRIEF};
    tangents[k] = (carom_tangent){.final = heap->ends[k]};
  }
  tangents[0].time = heap->times;
  tangents[0].before = heap->before;
  tangents[0].reach = reach;
  seeds.directions = CAROM_DIRECTIONS_MOST;
  seeds.cue = seeds.state = slopes;
  rows = BATCH;
  job.cues = cues;
  job.cue_stride = 1;
  job.n = SHOTS;
  job.shots = shots;
  impact_options =
      (carom_options){.solver = (carom_solver)(variant % 2), .steps = 300, .threads = threads};
  cushion_options = (carom_cushion_options){
      .model = (carom_cushion_model)((variant - 1) % 5), .steps = 100, .threads = threads};
}

/* A nine-ball break that was stopped after half a second, two balls of which one rolls, and all
 * else. */
static void set_up(void) {
  static const carom_corner triangle[] = {{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {0.0, 1.0, 0.0}};
  const carom_ball ball = {.r = {0.0, 0.0, 0.03}, .radius = 0.03, .mass = 0.17, .mu_slide = 0.2};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_table_measures(CAROM_TABLE_POOL_9FT, &measures);
  rack_kind = variant > 0 ? CAROM_RACK_EIGHTBALL : CAROM_RACK_NINEBALL;
  count = carom_rack_size(rack_kind);
  carom_rack(rack_kind, &table, 1e-4, (uint64_t)variant + 1, balls, count);
  cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 5.0 + 0.1 * variant;
  cue.a = 0.05 * (variant % 3);
  shot = (carom_shot){
      .events = own_events, .room = ROOM, .final = own_final, .facts = &facts, .state = &state};
  options = (carom_shot_options){.time_most = variant % 2 == 0 ? 0.5 : 0.0,
                                 .world = (carom_world)(variant % 4 == 3),
                                 .threads = threads};
  carom_shoot(&table, balls, count, &cue, &options, &shot);
  options.time_most = 0.0;
  whole_options = (carom_shot_options){.threads = threads};
  impacts[0] = (carom_impact){.a = ball, .b = ball, .mu_ball = 0.05, .restitution = 0.95};
  impacts[0].b.r[1] = 0.06;
  impacts[0].a.v[0] = 0.3;
  impacts[0].a.v[1] = 1.0;
  impacts[0].a.w[0] = -33.0;
  impacts[0].a.w[1] = 10.0;
  impacts_f32[0] = narrowed(impacts);
  impact_options = (carom_options){0};
  cushion_options = (carom_cushion_options){0};
  rails[0] = (carom_cushion_impact){
      {0.5, 1.2, 0.0}, {0.0}, {0.0, 1.0}, 0.0365, 0.028575, 0.17, 0.2, 0.2, 0.85, 0.0};
  seeds = (carom_tangent_seeds){.directions = 1, .cue = slopes};
  tangents[0] = (carom_tangent){
      .final = heap->ends[0], .times = times, .times_count = 1, .at = heap->ends[1]};
  record.table = table;
  record.count = count;
  record.cue = cue;
  memcpy(record.balls, balls, sizeof record.balls);
  second_shot = (carom_shot){.final = states};
  job = (carom_shot_job){.table = &table,
                         .balls = balls,
                         .count = count,
                         .cues = &cue,
                         .n = 1,
                         .options = &options,
                         .shots = &shot,
                         .status = statuses};
  tangent_job = (carom_tangent_job){.played = &job, .seeds = &seeds, .tangents = tangents};
  for (int k = 0; k < CAROM_BANKS; k++)
    readings[k] = 2.0 + 0.5 * k;
  memcpy(corners, triangle, sizeof triangle);
  statuses[0] = 77;
  where = -2;
  kind = (carom_ball_kind){0};
  results[0] = (carom_result){0};
  memset(motion, 0, sizeof motion);
  times[0] = 0.1;
  times[1] = variant % 2 == 0 ? 0.2 : 3.0;
  place_x = 0.3;
  place_y = 0.4;
  radius = 0.028575;
  height = 0.0366;
  jaw_radius = 0.01;
  gap = 1e-4;
  place = bank_index = 0;
  corners_count = points_count = 3;
  table_kind = (CAROM_TABLE_POOL_9FT + variant) % 7;
  room = 4;
  rows = 1;
  set_up_games();
  if (variant > 0)
    draw_rows();
}

/* A shot that was played to its end; of some variants with a ball that flies at a rail right above
 * the cloth, where both the flat and the free model have a part. */
static carom_shot *whole(void) {
  if (variant % 4 == 2) {
    const double R = balls[1].kind.radius;
    whole_options.cushion_model = CAROM_SHOT_CUSHION_MATHAVAN;
    balls[1].state = (carom_ball_state){.r = {R + 0.01, 0.8, R + 5e-4},
                                        .v = {-2.0, 0.1, 0.05},
                                        .w = {20.0, -30.0, 40.0},
                                        .label = CAROM_BALL_AIRBORNE};
  }
  shot.count = 0;
  shot.state = NULL;
  carom_shoot(&table, balls, count, &cue, &whole_options, &shot);
  return &shot;
}
/* The job of a batch that was played. */
static const carom_tangent_job *played_job(void) {
  whole();
  for (int k = 0; k < SHOTS; k++)
    shots[k] = shot;
  job.shots = shots;
  job.cues = &cue;
  job.cue_stride = 0;
  job.options = &whole_options;
  return &tangent_job;
}
/* The status of this shot in a batch behind a good one, which has a result, unless what is wrong
 * belongs to both: the table, the options, or a slope or a height for balls of both. */
static inline int64_t shoot_pair(void) {
  static carom_shot_ball layouts[2 * CAROM_BALLS_MOST];
  const carom_cue strokes[] = {carom_cue_of(CAROM_GAME_POOL), cue};
  carom_shot played[2] = {{0}, {0}};
  int8_t said[2] = {99, 99};
  memcpy(layouts + count, balls, (size_t)count * sizeof *balls);
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, layouts, count);
  const carom_shot_job pair = {.table = &table,
                               .balls = layouts,
                               .cues = strokes,
                               .count = count,
                               .ball_stride = (uint64_t)count,
                               .cue_stride = 1,
                               .n = 2,
                               .options = &options,
                               .shots = played,
                               .status = said};
  const carom_status returned = carom_shoot_batch(&pair);
  if (said[0] != 99) {
    const bool both = returned == CAROM_ERROR_NOSE_HEIGHT || returned == CAROM_ERROR_SLOPE ||
                      table.rail_width > 0.0;
    ck_assert_int_eq(said[0], both ? returned : CAROM_OK);
    ck_assert_int_eq(said[1], returned);
    ck_assert_int_eq(played[0].count > 0, !both);
  }
  return returned;
}
static const char *line_of_record(void) {
  carom_record_write(&record, CAROM_RECORD_HEAD, text, sizeof text);
  memset(&record, 0, sizeof record);
  return text;
}
/* Reads a line; NULL is none. */
static int64_t read_line(carom_record *of, const char *line) {
  return carom_record_read(of, line, line == NULL ? 0 : strlen(line));
}

/* ---- The functions of games */

#ifdef CAROM_WITHOUT_PLAN
static void set_up_games(void) {
}
#else
static OWN carom_cue aimed;
static OWN carom_plan_rules rules;
static OWN carom_player player, other_player;
static OWN carom_plan_options plan_options;
static OWN carom_plan_job plan;
static OWN carom_ruling ruling;
static OWN carom_plan_stroke choices[4];
static OWN carom_match_setup setup;
static OWN carom_seating seating;
static OWN carom_standing standing;
static OWN carom_match match, reader, match_room;
static OWN carom_bounds bounds;
static OWN carom_turn settled;
static OWN carom_rules_state rules_state;
static OWN const char *range;
static OWN carom_rating rating;
static OWN carom_pot pot;
static const carom_score score = {500.0, 3.0, 2.0};
static const carom_plan_stroke safety = {.ball = -1};
/* The jobs of a coach, of the same layout. */
static OWN carom_shot_way ways[4];
static OWN carom_ways_result ways_result;
static OWN carom_break_counts break_counts;
static OWN carom_sequence_stroke sequence_strokes[1];
static OWN carom_sequence_counts sequence_counts;
static OWN carom_break_choice break_choices[CAROM_BREAK_CHOICES];
static OWN carom_review review;
static OWN carom_drill drill;
static OWN carom_series series;
static OWN carom_odds odds;
static OWN carom_why why;
/* How many balls searches have: all at no variant and before a release, else few. In a pack few
 * strokes pot, and where none does a search of ways tries 18,000 directions. */
static int balls_of_searches(void) {
  enum { FEW = 4 };
  const bool is_whole = variant == 0 || draws_of_test(0, 1) > 0;
  return is_whole || count < FEW ? count : FEW;
}
static const carom_ways_job *ways_job(void) {
  static OWN carom_ways_job searched;
  searched = (carom_ways_job){.table = &table,
                              .balls = balls,
                              .count = balls_of_searches(),
                              .cues = &cue,
                              .strokes = 1,
                              .player = &player,
                              .shot = &options,
                              .scan = 1800,
                              .ball = -1,
                              .pocket = -1,
                              .rails = 2,
                              .memory = heap->memory,
                              .memory_size = MEMORY};
  return &searched;
}
static carom_shot_way *stroke_way(void) {
  ways[0] = (carom_shot_way){.cue = cue, .ball = 1};
  return ways;
}
static const carom_break_job *break_job(void) {
  static OWN carom_break_job breaks;
  breaks = (carom_break_job){.table = &table,
                             .balls = balls,
                             .count = count,
                             .cue = &cue,
                             .player = &player,
                             .shot = &options,
                             .rack = (int32_t)rack_kind,
                             .gap = 1e-4,
                             .memory = heap->memory,
                             .memory_size = MEMORY};
  return &breaks;
}
static const carom_review *reviewed(void) {
  review = (carom_review){.aim = cue, .ball = 1};
  return &review;
}
static const carom_plan_stroke *stroke_choice(void) {
  choices[0] = (carom_plan_stroke){.cue = cue, .ball = -1, .pocket = -1};
  memcpy(choices[0].place, balls[0].state.r, sizeof choices[0].place);
  return choices;
}

static void set_up_games(void) {
  rules = carom_plan_rules_of(variant > 0 ? CAROM_RULES_POTTING : CAROM_RULES_NINEBALL);
  player = carom_player_of(1.0);
  plan_options = (carom_plan_options){.shots = 100, .threads = threads};
  setup = (carom_match_setup){.rules = CAROM_RULES_NINEBALL, .table = &table};
  settled = (carom_turn){.spot = 2};
  aimed = cue;
  break_counts = (carom_break_counts){.stays = 2, .x = 1.0, .y = 2.0, .squares = 3.0};
  series = (carom_series){.rating = {500.0, 600.0}, .games = {5, 3}};
  pot = (carom_pot){.ball = 1, .pocket = variant % 6, .vias = variant % 3};
  pot.via[0] = variant == 1 ? (carom_part){CAROM_PART_RAIL, 0} : (carom_part){CAROM_PART_BALL, 2};
  pot.via[1] = (carom_part){CAROM_PART_RAIL, 2};
  plan = (carom_plan_job){.table = &table,
                          .balls = balls,
                          .count = balls_of_searches(),
                          .cue = &cue,
                          .player = &player,
                          .rules = &rules,
                          .options = &plan_options,
                          .memory = heap->memory,
                          .memory_size = MEMORY};
}
/* A plan that has begun. */
static const carom_plan_job *sliced_plan(void) {
  int begun;
  plan_options.slice = 10;
  carom_plan(&plan, choices, 4, &begun);
  return &plan;
}
/* A run-out that has begun. */
static const carom_plan_job *sliced_run_out(void) {
  int begun;
  plan_options.slice = 10;
  carom_sequence(&plan, 0, 0.1, sequence_strokes, 1, &begun);
  return &plan;
}
/* A match that has begun: the cue ball is in hand. */
static carom_match *begun(void) {
  carom_match_begin(&match, CAROM_RULES_NINEBALL, &table, 1, 0);
  return &match;
}
static int64_t read_match(carom_match *to, carom_record *of, const char *line) {
  return carom_match_read(to, of, line, line == NULL ? 2 : strcspn(line, "\n"));
}
static int64_t receive_line(carom_match *to, carom_match *spare, const char *line, int seat) {
  return carom_match_receive(to, spare, line, line == NULL ? 2 : strcspn(line, "\n"), seat);
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

#endif

/* ---- The functions. calls.h has a row for each, with the arguments of carom_NAME(): once they
 * are its call, and once its position in a table. The call gives a STATUS; or ACCEPTED, with any
 * VALUE, a NUMBER, NAN where there is none, a WORD, NULL where there is none, or by OTHER steps. */

#define LAYOUT PTR(balls), INT(count)
#define STATUS(name, ...) OTHER(name, carom_##name(__VA_ARGS__))
#define VALUE(name, ...) OTHER(name, GIVES(carom_##name(__VA_ARGS__)))
#define NUMBER(name, ...) OTHER(name, is_number(carom_##name(__VA_ARGS__)))
#define WORD(name, ...) OTHER(name, is_text(carom_##name(__VA_ARGS__)))
#define OTHER(name, call)            \
  static int64_t call_##name(void) { \
    return (int64_t)(call);          \
  }
#include "calls.h"
#undef OTHER

#define OTHER(name, call) {"carom_" #name, call_##name},
static const struct {
  const char *name;
  int64_t (*call)(void);
} functions[] = {
#include "calls.h"
};
#undef OTHER
#undef WORD
#undef NUMBER
#undef VALUE
#undef STATUS
#undef LAYOUT
enum { COUNT = COUNT_OF(functions) };

#endif
