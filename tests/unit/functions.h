/* Every public function with arguments that are right. A test can make each wrong in turn:
 * unit/garbage.c all of them, and cases.c those that a line of a file names. unit/at_once.c calls
 * all functions at once, unit/stack.c on small stacks. All arguments are objects of this file, and
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

/* ---- The functions of physics. F(name, call): the call gives a status, or ACCEPTED. */

#define PHYSICS_FUNCTIONS(F)                                                                       \
  F(alciatore, (law = carom_alciatore(), ACCEPTED))                                                \
  F(bank_of, carom_bank_of(INT(bank_index), PTR(&bank)))                                           \
  F(calibrate,                                                                                     \
    carom_calibrate(PTR(&table), PTR(&balls[0].kind), MAYBE(readings), PTR(&calibration)))         \
  F(ball_fault, GIVES(carom_ball_fault(MAYBE(&kind), MAYBE(text), 99)))                            \
  F(ball_kind_for, GIVES(carom_ball_kind_for(ANYENUM(carom_game, 0),                               \
                                             ANYENUM(carom_shot_cushion, 0), MAYBE(&kind))))       \
  F(ball_kind_of, (kind = carom_ball_kind_of(ANYENUM(carom_game, 0)), ACCEPTED))                   \
  F(ball_kind_resolve, carom_ball_kind_resolve(MAYBE(&table), MAYBE(&options), PTR(&kind)))        \
  F(check, carom_check(PTR(impacts), MAYBE(&impact_options), MAYBE(&where)))                       \
  F(cite, GIVES(carom_cite(NULL, MAYBE(text), 10)))                                                \
  F(collide, carom_collide(PTR(impacts), MAYBE(&impact_options), PTR(results)))                    \
  F(cluster, carom_cluster(PTR(balls), INT(count), MAYBE(&options), PTR(motion), PTR(contacts),    \
                           LENGTH(room), MAYBE(&found)))                                           \
  F(collide_batch, carom_collide_batch(PTR(impacts), rows, MAYBE(&impact_options), PTR(results),   \
                                       MAYBE(statuses)))                                           \
  F(collide_batch_f32, carom_collide_batch_f32(PTR(impacts_f32), rows, MAYBE(&impact_options),     \
                                               PTR(results_f32), MAYBE(statuses)))                 \
  F(collide_detail,                                                                                \
    carom_collide_detail(PTR(impacts), MAYBE(&impact_options), PTR(results), MAYBE(&detail)))      \
  F(collide_tangent, carom_collide_tangent(PTR(impacts), NULL, INT(seeds.directions), PTR(slopes), \
                                           PTR(numbers), MAYBE(&flags)))                           \
  F(cue_of, (cue = carom_cue_of(ANYENUM(carom_game, 0)), ACCEPTED))                                \
  F(cushion, carom_cushion(PTR(rails), MAYBE(&cushion_options), PTR(motion)))                      \
  F(cushion_batch,                                                                                 \
    carom_cushion_batch(PTR(rails), rows, MAYBE(&cushion_options), PTR(motion), MAYBE(statuses)))  \
  F(cushion_check, carom_cushion_check(PTR(rails), MAYBE(&cushion_options), MAYBE(&where)))        \
  F(cushion_field_name, is_text(carom_cushion_field_name(ANYINT(0))))                              \
  F(cushion_model_name, is_text(carom_cushion_model_name(ANYENUM(carom_cushion_model, 0))))        \
  F(condition_give, GIVES(carom_condition_give(ANYENUM(carom_condition, 0), MAYBE(&kind))))        \
  F(cushion_start, GIVES(carom_cushion_start(ANYENUM(carom_cushion_model, 0), MAYBE(&kind))))      \
  F(cushion_tangent, carom_cushion_tangent(PTR(rails), NULL, INT(seeds.directions), PTR(slopes),   \
                                           PTR(numbers), MAYBE(&flags)))                           \
  F(cushion_trace, carom_cushion_trace(PTR(rails), MAYBE(&cushion_options), (size_t)points_count,  \
                                       PTR(cushion_points)))                                       \
  F(event_name, is_text(carom_event_name(ANYENUM(carom_event_type, CAROM_EVENT_RAIL))))            \
  F(field_name, is_text(carom_field_name(ANYINT(0))))                                              \
  F(impact3, carom_impact3(PTR(impacts), PTR(results)))                                            \
  F(game_of_table, GIVES(carom_game_of_table(ANYENUM(carom_table_kind, 0))))                       \
  F(isa_available, GIVES(carom_isa_available(ANYENUM(carom_isa, 0))))                              \
  F(isa_in_force, GIVES(carom_isa_in_force()))                                                     \
  F(isa_limit, GIVES(carom_isa_limit(ANYENUM(carom_isa, CAROM_ISA_ANY))))                          \
  F(isa_name, is_text(carom_isa_name(ANYENUM(carom_isa, 0))))                                      \
  F(label_name, is_text(carom_label_name(ANYENUM(carom_label, 0))))                                \
  F(mu_ball, is_number(carom_mu_ball(PTR(impacts), carom_alciatore())))                            \
  F(number_is_read, GIVES(carom_number_is_read(MAYBE(carom_number_of(CAROM_PART_BALL, 0)),         \
                                               MAYBE(&balls[0].kind), NULL)))                      \
  F(number_of, GIVES(carom_number_of(ANYENUM(carom_part_kind, 4), ANYINT(0))))                     \
  F(number_range,                                                                                  \
    GIVES(carom_number_range(MAYBE(carom_number_of(CAROM_PART_BALL, 0)), MAYBE(text), 99)))        \
  F(physics_revision, GIVES(carom_physics_revision()))                                             \
  F(place_ball, carom_place_ball(PTR(&table), PTR(balls), INT(count), INT(place), NUM(place_x),    \
                                 NUM(place_y), MAYBE(&part)))                                      \
  F(pocket_name, is_text(carom_pocket_name(MAYBE(&table), ANYINT(0))))                             \
  F(rack, carom_rack(ENUM(carom_rack_kind, rack_kind), PTR(&table), NUM(gap), 1, PTR(balls),       \
                     LENGTH(count)))                                                               \
  F(rack_name, is_text(carom_rack_name(ANYENUM(carom_rack_kind, 0))))                              \
  F(rack_size, GIVES(carom_rack_size(ANYENUM(carom_rack_kind, 0))))                                \
  F(rail_name, is_text(carom_rail_name(MAYBE(&table), ANYINT(0))))                                 \
  F(record_hand, carom_record_hand(PTR(&record), INT(place)))                                      \
  F(record_place,                                                                                  \
    carom_record_place(PTR(&record), INT(place), NUM(place_x), NUM(place_y), MAYBE(&part)))        \
  F(record_play,                                                                                   \
    carom_record_play(PTR(&record), ENUM(carom_record_kind, CAROM_RECORD_SHOT), NULL))             \
  F(record_read, read_line(PTR(&record), PTR(line_of_record())))                                   \
  F(record_settle, carom_record_settle(PTR(&record)))                                              \
  F(record_write, GIVES(carom_record_write(MAYBE(&record), ANYENUM(carom_record_kind, 1),          \
                                           MAYBE(text), sizeof text)))                             \
  F(rolling_velocity,                                                                              \
    (carom_rolling_velocity(MAYBE(zeros), MAYBE(zeros), ANY(0.03), MAYBE(numbers)), ACCEPTED))     \
  F(serves, GIVES(carom_serves(ANYINT(1))))                                                        \
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
    is_number(carom_event_slip(PTR(&table), PTR(balls), INT(count), PTR(&own_events[1]))))         \
  F(shot_orientation,                                                                              \
    carom_shot_orientation(PTR(balls), INT(count), PTR(&shot), TIME(times[0]), PTR(turned)))       \
  F(shot_tangent,                                                                                  \
    carom_shot_tangent(PTR(&table), PTR(balls), INT(count), is_wrong(true, 1) ? NULL : &cue,       \
                       MAYBE(&whole_options), PTR(whole()), PTR(&seeds), PTR(tangents)))           \
  F(shot_tangent_batch, carom_shot_tangent_batch(PTR(played_job())))                               \
  F(slip_name, is_text(carom_slip_name(ANYENUM(carom_slip, 0))))                                   \
  F(solver_name, is_text(carom_solver_name(ANYENUM(carom_solver, 0))))                             \
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
  F(table_name, is_text(carom_table_name(ANYENUM(carom_table_kind, 0))))                           \
  F(table_polygon,                                                                                 \
    carom_table_polygon(PTR(corners), INT(corners_count), NUM(height), NUM(jaw_radius),            \
                        NUM(radius), PTR(&table), MAYBE(&table_fault)))                            \
  F(trace, carom_trace(PTR(impacts), MAYBE(&impact_options), (size_t)points_count, PTR(points)))   \
  F(version, is_text(carom_version()))                                                             \
  F(version_number, GIVES(carom_version_number()))                                                 \
  F(word, is_text(carom_word(ANYENUM(carom_words, 0), ANYINT(0))))                                 \
  F(word_text, is_text(carom_word_text(ANYENUM(carom_words, 0), ANYINT(0))))

/* ---- The functions of games */

#ifdef CAROM_WITHOUT_PLAN
static void set_up_games(void) {
}
#define FUNCTIONS(F) PHYSICS_FUNCTIONS(F)
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
static OWN carom_match match, reader;
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
static const carom_ways_job *ways_job(void) {
  static OWN carom_ways_job searched;
  searched = (carom_ways_job){.table = &table,
                              .balls = balls,
                              .count = count,
                              .cues = &cue,
                              .strokes = 1,
                              .player = &player,
                              .shot = &options,
                              .scan = 90,
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
                             .rack = rack_kind,
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
                          .count = count,
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
static int64_t read_match_from(carom_match *to, carom_record *of, const char *line, int seat) {
  return carom_match_read_from(to, of, line, line == NULL ? 2 : strcspn(line, "\n"), seat);
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
  F(is_within, GIVES(carom_is_within(MAYBE(&bounds), ANY(0.5), ANY(0.5))))                         \
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
    GIVES(carom_match_call(MAYBE(ready()), ANYINT(0), ((carom_call){ANYINT(1), ANYINT(1)}))))      \
  F(match_choose, GIVES(carom_match_choose(MAYBE(ready()), ANYINT(0),                              \
                                           ANYENUM(carom_choice, CAROM_CHOICE_PUSH))))             \
  F(match_clock, carom_match_clock(PTR(ready()), INT(0)))                                          \
  F(match_concede, carom_match_concede(PTR(ready()), INT(0)))                                      \
  F(match_continue, carom_match_continue(PTR(moving()), NULL, MAYBE(&second_shot)))                \
  F(match_end, carom_match_end(PTR(ready())))                                                      \
  F(match_extend, GIVES(carom_match_extend(MAYBE(ready()), ANYINT(0))))                            \
  F(match_next, GIVES(carom_match_next(MAYBE(ready()))))                                           \
  F(match_opponent, carom_match_opponent(PTR(begun()), PTR(&player), PTR(&other_player)))          \
  F(match_place, carom_match_place(PTR(begun()), INT(0), NUM(0.6), NUM(0.5)))                      \
  F(match_plan, carom_match_plan(PTR(ready()), PTR(&plan), PTR(choices), LENGTH(4), PTR(&found)))  \
  F(match_prepare, carom_match_prepare(PTR(ready()), INT(0), PTR(&safety)))                        \
  F(match_read, GIVES(read_match(MAYBE(&reader), MAYBE(&record), MAYBE(begun()->text))))           \
  F(match_read_from,                                                                               \
    GIVES(read_match_from(MAYBE(&reader), MAYBE(&record), MAYBE(begun()->text), ANYINT(1))))       \
  F(match_replay, carom_match_replay(PTR(moving()), PTR(&second_shot)))                            \
  F(match_standing, carom_match_standing(PTR(begun()), PTR(&standing)))                            \
  F(match_string, GIVES(carom_match_string(MAYBE(begun()), MAYBE(text), 99)))                      \
  F(match_timeout, GIVES(carom_match_timeout(MAYBE(ready()), ANYINT(0))))                          \
  F(match_undone, GIVES(carom_match_undone(MAYBE("{}"), 2)))                                       \
  F(seating_make,                                                                                  \
    carom_seating_make(ANYENUM(carom_rules_kind, CAROM_RULES_NINEBALL), INT(2), PTR(&seating)))    \
  F(match_stroke, carom_match_stroke(PTR(ready()), INT(0), PTR(&cue), NULL, MAYBE(&second_shot)))  \
  F(refusal_name, is_text(carom_refusal_name(ANYINT(1))))                                          \
  F(cue_ball_of, GIVES(carom_cue_ball_of(MAYBE(&rules))))                                          \
  F(aim, carom_aim(PTR(&table), PTR(balls), INT(count), NULL, PTR(&pot), PTR(&aimed)))             \
  F(foul_of, GIVES(carom_foul_of(MAYBE(&facts), 2, ANYINT(0))))                                    \
  F(foul_string, is_text(carom_foul_string(ANYINT(0))))                                            \
  F(game_word, is_text(carom_game_word(ANYENUM(carom_game_words, 0), ANYINT(0))))                  \
  F(game_word_text, is_text(carom_game_word_text(ANYENUM(carom_game_words, 0), ANYINT(0))))        \
  F(is_beside, GIVES(carom_is_beside(MAYBE(&table), ANYINT(0), ANYINT(0))))                        \
  F(plan, carom_plan(PTR(&plan), PTR(choices), LENGTH(4), PTR(&found)))                            \
  F(plan_continue, carom_plan_continue(PTR(sliced_plan()), PTR(choices), LENGTH(4), PTR(&found)))  \
  F(plan_hand,                                                                                     \
    carom_plan_hand(PTR(&plan), MAYBE(zeros), NULL, PTR(choices), LENGTH(4), PTR(&found)))         \
  F(sequence, carom_sequence(PTR(&plan), ANYINT(0), NUM(0.1), PTR(sequence_strokes), LENGTH(1),    \
                             PTR(&found)))                                                         \
  F(sequence_continue, carom_sequence_continue(PTR(sliced_run_out()), PTR(&found)))                \
  F(sequence_memory, GIVES(carom_sequence_memory(MAYBE(&plan_options))))                           \
  F(sequence_play,                                                                                 \
    carom_sequence_play(PTR(&plan), ANYINT(0), ANYINT(0), LENGTH(1), PTR(&sequence_counts)))       \
  F(break_best, carom_break_best(PTR(break_job()), LENGTH(16), PTR(break_choices), INT(1)))        \
  F(break_has_rules, GIVES(carom_break_has_rules(ANYENUM(carom_rack_kind, 0))))                    \
  F(break_memory, GIVES(carom_break_memory()))                                                     \
  F(break_play, carom_break_play(PTR(break_job()), ANYINT(0), LENGTH(1), PTR(&break_counts)))      \
  F(break_spread, is_number(carom_break_spread(MAYBE(&break_counts), MAYBE(numbers))))             \
  F(break_stroke, carom_break_stroke(PTR(break_job()), ANYINT(0), PTR(balls), PTR(&aimed)))        \
  F(drill_of, carom_drill_of(PTR(&plan), PTR(reviewed()), PTR(&drill)))                            \
  F(fair_series, carom_fair_series(PTR(&series), PTR(&series)))                                    \
  F(names_ball, GIVES(carom_names_ball(MAYBE(choices))))                                           \
  F(odds_of, carom_odds_of(PTR(&series), PTR(&odds)))                                              \
  F(practice_name, is_text(carom_practice_name(ANYENUM(carom_practice, 0))))                       \
  F(review_of, carom_review_of(PTR(&plan), PTR(&cue), ((carom_call){-1, -1}), PTR(&review)))       \
  F(plan_replay,                                                                                   \
    carom_plan_replay(PTR(&plan), PTR((carom_plan_stroke *)stroke_choice()), LENGTH(1)))           \
  F(way_chance, carom_way_chance(PTR(ways_job()), PTR(stroke_way())))                              \
  F(way_succeeds, GIVES(carom_way_succeeds(MAYBE(ways_job()), MAYBE(whole()), MAYBE(ways))))       \
  F(ways, carom_ways(PTR(ways_job()), PTR(ways), LENGTH(4), PTR(&ways_result)))                    \
  F(ways_memory, GIVES(carom_ways_memory(ANYINT(4))))                                              \
  F(why_of, carom_why_of(PTR(&plan), PTR(stroke_choice()), PTR(&why)))                             \
  F(plan_kind_name, is_text(carom_plan_kind_name(ANYENUM(carom_plan_kind, 0))))                    \
  F(plan_memory, GIVES(carom_plan_memory(MAYBE(&plan_options))))                                   \
  F(plan_rules_of, (rules = carom_plan_rules_of(ANYENUM(carom_rules_kind, 0)), ACCEPTED))          \
  F(plan_try, carom_plan_try(PTR(&plan), PTR(&cue), INT(1), PTR(choices)))                         \
  F(plan_value, carom_plan_value(PTR(&plan), ANYINT(0), PTR(numbers)))                             \
  F(player_fargo, (player = carom_player_fargo(ANY(500.0)), ACCEPTED))                             \
  F(player_rated,                                                                                  \
    (player = carom_player_rated(ANY(500.0), ANYENUM(carom_rules_kind, 0)), ACCEPTED))             \
  F(player_of, (player = carom_player_of(ANY(1.0)), ACCEPTED))                                     \
  F(player_strike, (carom_player_strike(MAYBE(&player), 1, 1, MAYBE(&aimed)), ACCEPTED))           \
  F(pot_kind, GIVES(carom_pot_kind(MAYBE(&shot), ANYINT(0), ANYINT(1), ANYINT(0))))                \
  F(rating_of, carom_rating_of(PTR(&score), LENGTH(1), PTR(&rating)))                              \
  F(referee, carom_referee(PTR(&rules), PTR(&table), PTR(balls), INT(count), INT(0),               \
                           MAYBE(whole()), ((carom_call){ANYINT(1), ANYINT(1)}), PTR(&ruling)))    \
  F(rules_about_of, GIVES(carom_rules_about_of(ANYENUM(carom_rules_kind, 0))))                     \
  F(rules_fault,                                                                                   \
    GIVES(carom_rules_fault(ANYENUM(carom_rules_kind, 0), MAYBE(&rules_state), MAYBE(&range))))    \
  F(ruling_string, GIVES(carom_ruling_string(MAYBE(&ruling), MAYBE(text), 99)))                    \
  F(spot_ball, carom_spot_ball(PTR(&table), PTR(balls), INT(count), INT(1)))                       \
  F(spot_ball_of,                                                                                  \
    carom_spot_ball_of(ENUM(carom_rack_kind, 0), PTR(&table), PTR(balls), INT(count), INT(1)))     \
  F(stroke_marks, GIVES(carom_stroke_marks(MAYBE(&facts), ANYINT(0))))                             \
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
