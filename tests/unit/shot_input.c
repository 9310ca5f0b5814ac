/* Bad input of every field of a shot: each its own status and place, and nothing else written.
 * Bounds and the built-in tables, too. */
#include "carom_shot.h"
#include "carom_tangent.h"
#include "support.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

static carom_table table;
static carom_shot_ball balls[10];
static carom_cue cue;
static carom_shot_options options;

/* A good nine-ball break. */
static void set_up(void) {
  ck_assert_int_eq(carom_table_make(CAROM_TABLE_POOL_9FT, &table), CAROM_OK);
  ck_assert_int_eq(carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, 10), CAROM_OK);
  cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 5.0;
  options = (carom_shot_options){0};
}

/* The shot is refused for this reason, at this ball or part. */
static void expect(carom_status status, int where) {
  int at = -2;
  carom_shot shot = {0};
  ck_assert_int_eq(carom_shot_check(&table, balls, 10, &cue, &options, &at), status);
  ck_assert_int_eq(at, where);
  shot.count = 77;
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, &options, &shot), status);
  if (status != CAROM_OK)
    ck_assert_int_eq(shot.count, 0);
  /* in a batch it costs itself only */
  carom_shot_ball two[20];
  carom_cue cues[2] = {carom_cue_of(CAROM_GAME_POOL), cue};
  carom_shot shots[2] = {{0}, {0}};
  int8_t statuses[2] = {99, 99};
  memcpy(two + 10, balls, sizeof balls);
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, two, 10);
  const carom_shot_job job = {.table = &table,
                              .balls = two,
                              .cues = cues,
                              .count = 10,
                              .ball_stride = 10,
                              .cue_stride = 1,
                              .n = 2,
                              .options = &options,
                              .shots = shots,
                              .status = statuses};
  const carom_status first = carom_shoot_batch(&job);
  ck_assert_int_eq(first, status);
  if (statuses[0] != 99) { /* what is wrong does not belong to all, but that both layouts have
                              balls too low for a nose, or too large for the tops of rails */
    const bool both = status == CAROM_ERROR_NOSE_HEIGHT || table.rail_width > 0.0;
    ck_assert_int_eq(statuses[0], both ? status : CAROM_OK);
    ck_assert_int_eq(statuses[1], status);
    ck_assert_int_eq(shots[0].count > 0, !both);
  }
}

/* Changes a number, expects the status, and changes it back. */
#define REFUSED(field, value, status, where) \
  do {                                       \
    set_up();                                \
    (field) = (value);                       \
    expect((status), (where));               \
  } while (0)

/* The same of a field that has a status of its own, whose name and text say the field: `text` is
 * "cue.mass must". */
static void named(const char *field, carom_status status) {
  char text[64];
  snprintf(text, sizeof text, "%s must", field);
  ck_assert_ptr_nonnull(strstr(carom_status_name(status), strchr(field, '.') + 1));
  ck_assert_ptr_eq(strstr(carom_status_string(status), text), carom_status_string(status));
}
#define NAMED(field, value, status)    \
  do {                                 \
    REFUSED(field, value, status, -1); \
    named(#field, status);             \
  } while (0)

/* Each number of a struct of the set-up, beyond its range, is refused by its status, and told. */
static void expect_ranges(carom_part_kind part, int index, void *object, const char *name) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(part, k)) != NULL; k++)
    for (int way = 0; set_up(), set_bad(object, n, way); way++) {
      char text[100], field[64];
      carom_fault fault;
      const bool counted = part >= CAROM_PART_RAIL && part <= CAROM_PART_BALL;
      expect(n->error, counted || part == CAROM_PART_STATE ? index : -1);
      ck_assert_int_eq(
          carom_shot_fault(&table, balls, 10, &cue, &options, &fault, text, sizeof text), n->error);
      ck_assert_ptr_eq(fault.row, n);
      ck_assert_int_eq(fault.part.kind, part);
      ck_assert_int_eq(fault.part.index, index);
      ck_assert_uint_eq(carom_number_range(n, text, sizeof text), strlen(text));
      snprintf(field, sizeof field, "%s.%s", name, n->name);
      if (name[0] != '\0' && n->error != CAROM_ERROR_MISCUE)
        named(field, n->error);
    }
}

TEST(kinds) {
  expect_ranges(CAROM_PART_BALL, 9, &balls[9].kind, "");
  /* balls of two radii: in space only, and both on the cloth */
  set_up();
  balls[3].kind.radius = balls[3].state.r[2] = 0.028;
  expect(CAROM_OK, -1);
  options.space = CAROM_SPACE_FLAT;
  expect(CAROM_ERROR_RADII_DIFFER, 3);
  carom_fault fault;
  carom_shot_fault(&table, balls, 10, &cue, &options, &fault, NULL, 0);
  ck_assert(fault.part.kind == CAROM_PART_BALL && fault.part.index == 3);
  REFUSED(balls[3].kind.radius, 0.03, CAROM_ERROR_OFF_TABLE, 3);
  set_up();
  balls[9].kind.restitution_table = -1.0;
  expect(CAROM_OK, -1);
  set_up();
  balls[3].kind.mass *= 1.1;
  expect(CAROM_OK, -1);
  options.world = CAROM_WORLD_POOLTOOL;
  expect(CAROM_ERROR_MASSES_DIFFER, 3);
}

TEST(states) {
  expect_ranges(CAROM_PART_STATE, 2, &balls[2].state, "");
  set_up();
  options.space = CAROM_SPACE_FLAT;
  balls[2].state.v[2] = 0.1;
  expect(CAROM_ERROR_VERTICAL, 2);
  balls[2].state.v[2] = 0.0;
  balls[2].state.r[2] = 0.05;
  expect(CAROM_ERROR_OFF_TABLE, 2);
  balls[2].state.r[2] = balls[2].kind.radius;
  for (int label = CAROM_BALL_AIRBORNE; label <= CAROM_BALL_OFF; label++) {
    balls[2].state.label = label;
    expect(CAROM_ERROR_LABEL, 2);
  }
  /* in space a ball may be above the cloth, and move up and down; in no cushion, nor on top of
   * another ball by less than 2 R */
  set_up();
  balls[2].state.v[2] = -0.1;
  balls[2].state.r[2] = 0.05;
  balls[3].state.label = CAROM_BALL_OFF;
  expect(CAROM_OK, -1);
  REFUSED(balls[2].state.r[2], 0.0285, CAROM_ERROR_OFF_TABLE, 2);
  set_up();
  balls[2].state.r[0] = 0.02; /* over the nose, which is 1.1 mm inside, by less than a radius */
  balls[2].state.r[2] = 0.05;
  expect(CAROM_ERROR_OFF_TABLE, 2);
  balls[2].state.r[2] = 0.066;
  expect(CAROM_OK, -1);
  balls[2].state.r[0] = -0.05; /* over the rail */
  expect(CAROM_OK, -1);
  balls[2].state.r[2] = 0.062; /* in its top */
  expect(CAROM_ERROR_OFF_TABLE, 2);
  balls[2].state.r[0] = -0.5; /* beyond it */
  expect(CAROM_ERROR_OFF_TABLE, 2);
  set_up();
  balls[4].state = balls[1].state;
  balls[4].state.r[2] += 1.99 * balls[1].kind.radius;
  expect(CAROM_ERROR_OVERLAP, 4);
  balls[4].state.r[2] += 0.02 * balls[1].kind.radius;
  ck_assert_int_eq(carom_shot_check(&table, balls, 10, &cue, &options, NULL), CAROM_OK);
  REFUSED(balls[2].state.r[0], -0.5, CAROM_ERROR_OFF_TABLE, 2);
  REFUSED(balls[2].state.r[0], 0.01, CAROM_ERROR_OFF_TABLE, 2); /* in the rail */
  set_up();
  balls[4].state = balls[1].state;
  expect(CAROM_ERROR_OVERLAP, 4);
  balls[4].state.label = CAROM_BALL_POCKETED; /* which is not there */
  expect(CAROM_OK, -1);
}

TEST(cues) {
  expect_ranges(CAROM_PART_CUE, 0, &cue, "cue");
  NAMED(cue.ball, 10, CAROM_ERROR_CUE_BALL);
  for (int label = CAROM_BALL_POCKETED; label <= CAROM_BALL_OFF;
       label += CAROM_BALL_OFF - CAROM_BALL_POCKETED) {
    set_up();
    cue.ball = 3;
    balls[3].state.label = label;
    expect(CAROM_ERROR_CUE_BALL_OUT, -1);
    named("cue.ball", CAROM_ERROR_CUE_BALL_OUT);
  }
  REFUSED(cue.a, 1.0, CAROM_ERROR_MISCUE, -1);
  set_up();
  cue.a = 0.3;
  cue.b = 0.4; /* at 0.5 */
  cue.miscue = 0.50001;
  expect(CAROM_OK, -1);
  cue.miscue = 0.5;
  expect(CAROM_ERROR_MISCUE, -1);
}

TEST(tables) {
  REFUSED(table.rails, 33, CAROM_ERROR_RAILS, 32);
  REFUSED(table.jaws, 33, CAROM_ERROR_JAWS, 32);
  expect_ranges(CAROM_PART_TABLE, 0, &table, "");
  expect_ranges(CAROM_PART_RAIL, 4, &table.rail[4], "");
  expect_ranges(CAROM_PART_JAW, 5, &table.jaw[5], "");
  expect_ranges(CAROM_PART_POCKET, 1, &table.pocket[1], "");
  /* below the radius of a ball */
  REFUSED(table.rail_width, 0.0285, CAROM_ERROR_TABLE, -1);
  REFUSED(table.jaws, -1, CAROM_ERROR_TABLE, -1);
  REFUSED(table.pockets, 9, CAROM_ERROR_POCKETS, 8);
  REFUSED(table.width, NAN, CAROM_ERROR_TABLE, -1);
  REFUSED(cue.tip_radius, NAN, CAROM_ERROR_CUE_TIP_RADIUS, -1);
  REFUSED(table.rail[4].height, 0.1, CAROM_ERROR_NOSE_HEIGHT, 4);
  /* exactly as many parts as there is room for */
  set_up();
  while (table.rails < CAROM_RAILS_MOST)
    table.rail[table.rails++] = table.rail[0];
  while (table.jaws < CAROM_JAWS_MOST)
    table.jaw[table.jaws++] = table.jaw[0];
  while (table.pockets < CAROM_POCKETS_MOST)
    table.pocket[table.pockets++] = table.pocket[0];
  expect(CAROM_OK, -1);
  /* posts alone, and a pocket between them */
  table = (carom_table){
      .jaws = 2, .pockets = 1, .jaw = {{.centre = {-5.0, -5.0}, .radius = 0.1, .height = 0.036}}};
  table.jaw[1] = (carom_jaw){.centre = {5.0, 5.0}, .radius = 0.1, .height = 0.036};
  table.pocket[0] = (carom_pocket){{3.0, -2.0}, 1.0, 0.08};
  ck_assert_int_eq(carom_shot_check(&table, balls, 10, NULL, NULL, NULL), CAROM_OK);
  ck_assert_int_eq(carom_table_make((carom_table_kind)99, &table), CAROM_ERROR_TABLE_KIND);
  ck_assert_int_eq(carom_table_make(CAROM_TABLE_POOL_7FT, NULL), CAROM_ERROR_NULL);
}

TEST(options_and_calls) {
  expect_ranges(CAROM_PART_OPTIONS, 0, &options, "options");
  REFUSED(options.unused, 1, CAROM_ERROR_SHOT_OPTIONS, -1);
  REFUSED(options.reserved[0], 1, CAROM_ERROR_SHOT_OPTIONS, -1);
  set_up();
  carom_shot shot = {0};
  ck_assert_int_eq(carom_shoot(NULL, balls, 10, &cue, NULL, &shot), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_shoot(&table, NULL, 10, &cue, NULL, &shot), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, NULL, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_shoot(&table, balls, 0, &cue, NULL, &shot), CAROM_ERROR_BALLS);
  ck_assert_int_eq(carom_shoot(&table, balls, 33, &cue, NULL, &shot), CAROM_ERROR_BALLS);
  /* room for events that are nowhere, and less than none */
  static carom_shot_state state;
  carom_ball_state then[10];
  const int64_t rooms[] = {5, -1};
  for (int k = 0; k < 2; k++) {
    carom_shot bad = {.room = rooms[k], .count = 77, .state = &state};
    int8_t said = 99;
    const carom_shot_job one = {
        .table = &table, .balls = balls, .count = 10, .n = 1, .shots = &bad, .status = &said};
    ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, NULL, &bad), CAROM_ERROR_ROOM);
    ck_assert_int_eq(carom_shoot_batch(&one), CAROM_ERROR_ROOM);
    ck_assert_int_eq(said, CAROM_ERROR_ROOM);
    ck_assert_int_eq(carom_shot_continue(&table, balls, 10, NULL, &bad), CAROM_ERROR_ROOM);
    ck_assert_int_eq(carom_shot_at(balls, 10, &bad, 0.0, then), CAROM_ERROR_ROOM);
    ck_assert_int_eq(bad.count, 77);
  }
  named("shot.room", CAROM_ERROR_ROOM);
  /* a job that cannot be served is refused whole, without a word to any shot */
  int8_t told = 99;
  const carom_shot_job good = {.table = &table,
                               .balls = balls,
                               .cues = &cue,
                               .count = 10,
                               .n = 1,
                               .shots = &shot,
                               .status = &told};
  carom_shot_job job = good;
  shot = (carom_shot){.count = 77};
#define JOB_REFUSED(field, value, code)                \
  do {                                                 \
    job = good;                                        \
    job.field = (value);                               \
    ck_assert_int_eq(carom_shoot_batch(&job), (code)); \
    ck_assert(told == 99 && shot.count == 77);         \
  } while (0)
  ck_assert_int_eq(carom_shoot_batch(NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_shoot_batch(&(carom_shot_job){0}), CAROM_OK);
  JOB_REFUSED(table, NULL, CAROM_ERROR_NULL);
  JOB_REFUSED(balls, NULL, CAROM_ERROR_NULL);
  JOB_REFUSED(shots, NULL, CAROM_ERROR_NULL);
  JOB_REFUSED(count, 0, CAROM_ERROR_BALLS);
  JOB_REFUSED(count, INT64_C(1) << 32 | 10, CAROM_ERROR_BALLS);
  ck_assert_ptr_nonnull(strstr(carom_status_string(CAROM_ERROR_BALLS), "count"));
  JOB_REFUSED(reserved[1], 1, CAROM_ERROR_SHOT_OPTIONS);
  ck_assert_ptr_nonnull(strstr(carom_status_string(CAROM_ERROR_SHOT_OPTIONS), "reserved"));
  ck_assert_int_eq(carom_shoot_batch(&good), CAROM_OK);
  ck_assert(told == CAROM_OK && shot.count != 77);
  ck_assert_int_eq(carom_rack(CAROM_RACK_NINEBALL, &table, -1.0, 1, balls, 10), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_rack(CAROM_RACK_NINEBALL, &table, 0.0, 1, balls, 9), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_rack((carom_rack_kind)-1, &table, 0.0, 1, balls, 9), CAROM_ERROR_RACK);
}

/* What a shot ended with is known up to its end, and nothing after it where balls still move:
 * states are not touched. */
static void ends_there(const carom_shot *shot, int count) {
  carom_ball_state at[10], untouched[10];
  memset(untouched, 77, sizeof untouched);
  ck_assert_int_eq(carom_shot_at(balls, count, shot, shot->time, at), CAROM_OK);
  for (int k = 0; k < count; k++)
    for (int axis = 0; axis < 3; axis++)
      ck_assert_double_eq_tol(shot->final[k].r[axis], at[k].r[axis], 1e-15);
  const double later[] = {nextafter(shot->time, INFINITY), shot->time + 1.0, INFINITY, NAN};
  for (int n = 0; n < 4; n++) {
    memset(at, 77, sizeof at);
    ck_assert_int_eq(carom_shot_at(balls, count, shot, later[n], at), CAROM_ERROR_TIME);
    ck_assert_int_eq(memcmp(at, untouched, sizeof at), 0);
  }
}

/* A strike of a ball that cannot be, or whose spin overflows. */
TEST(strikes_of_bad_balls) {
  const carom_cue usual = carom_cue_of(CAROM_GAME_POOL);
  carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  carom_motion out = {.v = {7}};
  kind.radius = 0;
  ck_assert_int_eq(carom_strike(&usual, &kind, &out), CAROM_ERROR_RADIUS);
  kind.radius = 1e-309;
  ck_assert_int_eq(carom_strike(&usual, &kind, &out), CAROM_ERROR_OVERFLOW);
  kind.radius = 0.03;
  kind.mass = NAN;
  ck_assert_int_eq(carom_strike(&usual, &kind, &out), CAROM_ERROR_MASS);
  kind.mass = 1.7e308;
  ck_assert_int_eq(carom_strike(&usual, &kind, &out), CAROM_ERROR_OVERFLOW);
  ck_assert(out.v[0] == 7);
}

/* A bound ends a shot with its status and a valid state; a shot without a strike is none. */
TEST(bounds) {
  set_up();
  carom_event events[40];
  static carom_event rested[1000];
  carom_ball_state final[10], at[10];
  carom_shot shot = {.events = events, .room = 40, .final = final};
  options.events_most = 30;
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, &options, &shot),
                   CAROM_ERROR_TOO_MANY_EVENTS);
  ck_assert_int_eq(shot.count, 30);
  ck_assert_double_eq(shot.time, events[29].time);
  ends_there(&shot, 10);
  options = (carom_shot_options){.time_most = 0.15};
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, &options, &shot), CAROM_STOPPED_AT_TIME);
  ck_assert_double_eq(shot.time, 0.15);
  ends_there(&shot, 10);
  /* a shot that came to rest is known for ever, but not at no time */
  carom_shot rest = {.events = rested, .room = 1000, .final = final};
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, NULL, &rest), CAROM_OK);
  ck_assert_int_eq(carom_shot_at(balls, 10, &rest, INFINITY, at), CAROM_OK);
  ck_assert_int_eq(memcmp(at, final, sizeof at), 0);
  ck_assert_int_eq(carom_shot_at(balls, 10, &rest, NAN, at), CAROM_ERROR_TIME);
  /* more events than there is room for: the state is known up to the last one kept */
  shot.room = 10;
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, NULL, &shot), CAROM_OK);
  ck_assert_int_gt(shot.count, 10);
  ck_assert_int_eq(carom_shot_at(balls, 10, &shot, events[9].time, at), CAROM_OK);
  ck_assert_int_eq(carom_shot_at(balls, 10, &shot, shot.time, at), CAROM_ERROR_EVENTS_LOST);
  cue.speed = 0.0;
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, NULL, &shot), CAROM_OK);
  ck_assert_int_eq(shot.count, 0);
  ck_assert_int_eq(carom_shoot(&table, balls, 10, NULL, NULL, &shot), CAROM_OK);
  ck_assert_int_eq(shot.count, 0);
}

/* Many times have the bits of one after another, in any order, with drag too; an error leaves
 * the times before it written. */
TEST(many_times) {
  enum { TIMES = 400 };
  static carom_event events[2000];
  static carom_ball_state together[TIMES][10], alone[10];
  double times[TIMES];
  for (int drag = 0; drag < 2; drag++) {
    set_up();
    for (int i = 0; i < 10; i++)
      balls[i].kind.drag = 0.02 * drag;
    carom_shot shot = {.events = events, .room = 2000};
    ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, NULL, &shot), CAROM_OK);
    ck_assert(shot.count > 20 && shot.count < 2000);
    for (int order = 0; order < 3; order++) { /* forwards with every event among them, backwards,
                                                 to and fro */
      for (int k = 0; k < TIMES; k++) {
        const double even = k / (TIMES - 1.0) * 1.1 * shot.time;
        times[order == 1 ? TIMES - 1 - k : k] =
            order == 2 && k % 3 == 0 ? fabs(shot.time - even) : even;
      }
      for (int k = 0; order == 0 && k < 20; k++)
        times[10 * k] = events[k].time;
      ck_assert_int_eq(carom_shot_at_times(balls, 10, &shot, times, TIMES, together[0]), CAROM_OK);
      for (int k = 0; k < TIMES; k++) {
        ck_assert_int_eq(carom_shot_at(balls, 10, &shot, times[k], alone), CAROM_OK);
        ck_assert_mem_eq(alone, together[k], sizeof alone);
      }
    }
    times[0] = 0.5;
    times[1] = NAN;
    memset(together, 0, sizeof together);
    ck_assert_int_eq(carom_shot_at_times(balls, 10, &shot, times, 2, together[0]),
                     CAROM_ERROR_TIME);
    ck_assert_int_eq(carom_shot_at(balls, 10, &shot, 0.5, alone), CAROM_OK);
    ck_assert_mem_eq(alone, together[0], sizeof alone);
    ck_assert_double_eq(together[1][0].r[2], 0.0);
    ck_assert_int_eq(carom_shot_at_times(balls, 10, &shot, NULL, 0, NULL), CAROM_OK);
    ck_assert_int_eq(carom_shot_at_times(balls, 10, &shot, NULL, 1, alone), CAROM_ERROR_NULL);
  }
}

/* Each call that takes times refuses those below 0, also the smallest. */
TEST(times_before_the_start) {
  static carom_event events[2000];
  static carom_ball_state at[10];
  static double turned[10][4], row[10 * CAROM_STATE_NUMBERS], seed[CAROM_CUE_NUMBERS] = {1.0};
  const double early[] = {-1e-300, -5.0, -INFINITY, NAN};
  set_up();
  carom_shot s = {.events = events, .room = 2000};
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, NULL, &s), CAROM_OK);
  for (int k = 0; k < 4; k++) {
    const double *t = &early[k];
    carom_tangent tangent = {.final = row, .times = t, .times_count = 1, .at = row};
    const carom_tangent_seeds seeds = {.directions = 1, .cue = seed};
    const carom_status said[] = {
        carom_shot_at(balls, 10, &s, *t, at),
        carom_shot_at_times(balls, 10, &s, t, 1, at),
        carom_shot_drawn(&table, balls, 10, &s, t, 1, at),
        carom_shot_falls(&table, balls, 10, &s, t, 1, at),
        carom_shot_frames(balls, 10, &s, t, 1, NULL, at, turned),
        carom_shot_orientation(balls, 10, &s, *t, turned),
        carom_shot_tangent(&table, balls, 10, &cue, NULL, &s, &seeds, &tangent)};
    for (size_t n = 0; n < sizeof said / sizeof *said; n++)
      ck_assert_msg(said[n] == CAROM_ERROR_TIME, "call %d at %g: %d", (int)n, *t, said[n]);
  }
  const carom_shot_options beyond = {.first_of = 1 << 10}, last = {.first_of = 1 << 9};
  ck_assert_int_eq(carom_shoot(&table, balls, 10, &cue, &beyond, &s), CAROM_ERROR_SHOT_OPTIONS);
  ck_assert_int_ge(carom_shoot(&table, balls, 10, &cue, &last, &s), CAROM_OK);
}

/* A cue of speed 0 is not read, so it may name any ball; a stopped shot goes on. */
/* Events and balls that were damaged end in an error, or in some state, after bounded work. */
TEST(damaged_events) {
  static const double bad[] = {-1.0,  1e3, 1e9,    1e12, 1e15, 1e18,     1e45,     1e100,
                               1e300, NAN, -1e300, 1e-8, 0.0,  INFINITY, -INFINITY};
  static carom_event good[64], events[64];
  carom_table t;
  carom_table_make(CAROM_TABLE_THREECUSHION, &t);
  carom_shot_ball two[2] = {{.kind = carom_ball_kind_of(CAROM_GAME_BILLIARD)}};
  two[1].kind = two[0].kind;
  ck_assert_int_eq(carom_place_ball(&t, two, 2, 0, 0.7, 0.5, NULL), CAROM_OK);
  ck_assert_int_eq(carom_place_ball(&t, two, 2, 1, 0.72, 1.5, NULL), CAROM_OK);
  carom_cue stroke = carom_cue_of(CAROM_GAME_BILLIARD);
  stroke.a = 0.2;
  carom_shot shot = {.events = good, .room = 64};
  ck_assert_int_eq(carom_shoot(&t, two, 2, &stroke, NULL, &shot), CAROM_OK);
  ck_assert_int_gt(shot.count, 6);
  carom_ball_state then[2];
  double turned[2][4], end[2 * CAROM_STATE_NUMBERS], seeds[CAROM_CUE_NUMBERS] = {1.0};
  const carom_tangent_seeds by_speed = {.directions = 1, .cue = seeds};
  shot.events = events;
  const double time = 0.5 * (good[3].time + good[4].time);
  int refused = 0, unresolved = 0;
  for (size_t word = 0; word < 4 * sizeof *good / sizeof(double); word++)
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
      memcpy(events, good, sizeof good);
      memcpy((char *)events + word * sizeof(double), &bad[k], sizeof(double));
      unresolved += carom_shot_at(two, 2, &shot, time, then) == CAROM_ERROR_UNRESOLVED;
      refused += carom_shot_orientation(two, 2, &shot, time, turned) < 0;
      carom_shot_drawn(&t, two, 2, &shot, &time, 1, then);
      carom_tangent tangent = {.final = end};
      carom_shot_tangent(&t, two, 2, &stroke, NULL, &shot, &by_speed, &tangent);
    }
  printf("%d states and %d turns are refused\n", unresolved, refused);
  ck_assert(unresolved > 50 && refused > unresolved);
  /* a number of contacts that cannot be */
  memcpy(events, good, sizeof good);
  carom_tangent tangent = {.final = end};
  events[0].cluster = -1;
  ck_assert_int_eq(carom_shot_tangent(&t, two, 2, &stroke, NULL, &shot, &by_speed, &tangent),
                   CAROM_ERROR_STATE);
  /* constants of a ball */
  memcpy(events, good, sizeof good);
  for (size_t word = 0; word < sizeof(carom_ball_kind) / sizeof(double); word++)
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
      carom_shot_ball other[2] = {two[0], two[1]};
      memcpy((char *)&other[0].kind + word * sizeof(double), &bad[k], sizeof(double));
      carom_shot_at(other, 2, &shot, 2.0, then);
      carom_shot_orientation(other, 2, &shot, 2.0, turned);
    }
}

TEST(cue_that_is_not_read) {
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL),
                          .state = {.r = {0.6, 0.6, 0.028575}, .v = {1.0, 2.0, 0.0}}};
  carom_cue unread = carom_cue_of(CAROM_GAME_POOL);
  unread.speed = 0.0;
  const carom_shot_options stop = {.stop_at = CAROM_STOP_AT(CAROM_EVENT_RAIL)};
  static carom_event events[64];
  carom_shot_state state;
  carom_facts facts;
  for (unread.ball = -1; unread.ball < 7; unread.ball += 2) {
    carom_shot shot = {.events = events, .room = 64, .state = &state, .facts = &facts};
    ck_assert_int_eq(carom_shoot(&table, &ball, 1, &unread, &stop, &shot), CAROM_STOPPED_AT_EVENT);
    ck_assert_int_eq(carom_shot_continue(&table, &ball, 1, NULL, &shot), CAROM_OK);
  }
}

/* A table with a hole in its rails loses a ball: that is told. */
TEST(lost_ball) {
  carom_table_make(CAROM_TABLE_THREECUSHION, &table);
  table.rail[1] = table.rail[2];
  table.rail[2] = table.rail[3];
  table.rails = 3; /* without the rail at x = width */
  balls[0] = (carom_shot_ball){.kind = carom_ball_kind_of(CAROM_GAME_BILLIARD),
                               .state = {.r = {0.7, 1.0, 0.03075}}};
  cue = carom_cue_of(CAROM_GAME_BILLIARD);
  cue.phi = 0.0;
  carom_event events[10];
  carom_ball_state final;
  carom_shot shot = {.events = events, .room = 10, .final = &final};
  ck_assert_int_eq(carom_shoot(&table, balls, 1, &cue, NULL, &shot), CAROM_ERROR_LEFT_TABLE);
  ck_assert_double_eq_tol(final.r[0], table.width, 1e-9);
  ends_there(&shot, 1);
}

/* ---- The built-in tables */

/* Whether a jaw touches the end of a rail or of a facing: the end is on the jaw's circle, and
 * the rail is tangent to it. */
static bool touches(const carom_jaw *jaw, const carom_rail *rail, const double end[2]) {
  const double d_x = end[0] - jaw->centre[0], d_y = end[1] - jaw->centre[1];
  const double e_x = rail->q[0] - rail->p[0], e_y = rail->q[1] - rail->p[1];
  return fabs(hypot(d_x, d_y) - jaw->radius) < 1e-9 &&
         fabs(d_x * e_x + d_y * e_y) < 1e-5 * hypot(e_x, e_y);
}

/* How far x is outside [0, length]; negative inside. */
static double outside(double x, double length) {
  return fmax(-x, x - length);
}

#define AT(member) ((int)(offsetof(carom_measures, member) / sizeof(double)))

/* The measures that a player would take, from the parts of the table. The mouth of a pocket lies
 * between the points where its rails would meet its facings. */
static void measure(const carom_measures *m, double tolerance) {
  const double w = m->width, l = m->length;
  ck_assert(table.width == w && table.length == l && table.rails == 18 && table.jaws == 12 &&
            table.pockets == 6);
  for (int k = 0; k < 18; k++)
    ck_assert_double_eq_tol(table.rail[k].height, m->nose_height, 1e-12);
  /* each jaw leads from one of the six cushions to one of the twelve facings */
  int corners = 0;
  for (int k = 0; k < 12; k++) {
    const carom_jaw *jaw = &table.jaw[k];
    const carom_rail *rail = NULL, *facing = NULL;
    for (int n = 0; n < 6; n++)
      if (touches(jaw, &table.rail[n], table.rail[n].p) ||
          touches(jaw, &table.rail[n], table.rail[n].q))
        rail = &table.rail[n];
    for (int n = 6; n < 18; n++)
      if (touches(jaw, &table.rail[n], table.rail[n].q))
        facing = &table.rail[n];
    ck_assert_msg(rail != NULL && facing != NULL, "jaw %d: no rail, or no facing", k);
    /* where their lines meet, by Cramer's rule */
    const double *a = rail->line, *b = facing->line, D = a[0] * b[1] - a[1] * b[0];
    const double x = (a[1] * b[2] - a[2] * b[1]) / D, y = (a[2] * b[0] - a[0] * b[2]) / D;
    const bool corner = fabs(y - l / 2.0) > l / 4.0;
    const double half = corner ? (fmin(x, w - x) + fmin(y, l - y)) * sqrt(0.5) : fabs(y - l / 2.0);
    corners += corner;
    ck_assert_double_eq_tol(2.0 * half, corner ? m->corner_mouth : m->side_mouth, 2e-5);
    ck_assert_double_eq_tol(jaw->radius, corner ? m->corner_jaw : m->side_jaw, 1e-12);
    ck_assert_double_eq_tol(jaw->height, m->nose_height, 1e-12);
    const double angle =
        acos(-fabs(a[0] * b[0] + a[1] * b[1]) / (hypot(a[0], a[1]) * hypot(b[0], b[1])));
    ck_assert_double_eq_tol(angle * 180.0 / 3.14159265358979323846,
                            corner ? m->corner_cut : m->side_cut, corner ? 1e-9 : tolerance);
    /* the facing goes back to the depth of the cushion */
    ck_assert_double_eq_tol(fmax(outside(facing->p[0], w), outside(facing->p[1], l)),
                            m->cushion_depth, 1e-12);
  }
  ck_assert_int_eq(corners, 8);
  /* pockets at the corners lie on the bisectors; the shelf goes to their edges */
  for (int k = 0; k < 6; k++) {
    const carom_pocket *p = &table.pocket[k];
    const double x = outside(p->centre[0], w), y = outside(p->centre[1], l);
    const bool corner = y > -l / 4.0;
    ck_assert_double_eq_tol(corner ? y : y + l, corner ? x : l / 2.0, 1e-12);
    ck_assert_double_eq_tol(p->radius, corner ? m->corner_hole : m->side_hole, 1e-12);
    ck_assert_double_eq_tol(corner ? hypot(x, y) + 0.5 * m->corner_mouth - m->corner_shelf
                                   : x - m->side_shelf,
                            p->radius, 1e-12);
    corners += corner;
  }
  ck_assert_int_eq(corners, 12);
}

/* Of the built-in tables, and of tables made from their measures, some of which are changed. The
 * facings of pooltool's side pockets are 0.064 degrees off the given angle. */
TEST(measures) {
  random_source r = {test_seed()};
  carom_measures m;
  for (int kind = CAROM_TABLE_POOL_7FT; kind <= CAROM_TABLE_POOLTOOL; kind++) {
    ck_assert_int_eq(carom_table_measures((carom_table_kind)kind, &m), CAROM_OK);
    ck_assert_int_eq(carom_table_make((carom_table_kind)kind, &table), CAROM_OK);
    if (kind == CAROM_TABLE_THREECUSHION)
      continue;
    measure(&m, kind == CAROM_TABLE_POOLTOOL ? 0.07 : 1e-9);
    /* pool by the rules of the WPA: inches, degrees, parts of a ball of 2.25 in */
    const double in = 0.0254;
    const struct {
      double value, low, high;
    } wpa[] = {{m.corner_mouth / in, 4.5, 4.625},
               {m.side_mouth / in, 5.0, 5.125},
               {m.corner_cut, 141.0, 143.0},
               {m.side_cut, 103.0, 105.0},
               {m.corner_shelf / in, 1.0, 2.25},
               {m.side_shelf / in, 0.0, 0.375},
               {m.nose_height / in / 2.25, 0.625, 0.645},
               {m.cushion_depth / in, 1.875, 2.0}};
    for (size_t k = 0; kind <= CAROM_TABLE_POOL_9FT && k < sizeof wpa / sizeof *wpa; k++)
      ck_assert_msg(wpa[k].value > wpa[k].low && wpa[k].value < wpa[k].high, "%zu: %g", k,
                    wpa[k].value);
    int closed = 0;
    for (int k = 0; k < 20; k++) {
      carom_measures own = m;
      double *x = &own.width;
      for (size_t n = 0; n < sizeof own / sizeof *x; n++)
        x[n] *= random_between(&r, n == AT(side_cut) ? 1.0 : 0.95, 1.05);
      const carom_status made = carom_table_measured(&own, 0.026, &table, NULL);
      ck_assert(made == CAROM_OK || made == CAROM_ERROR_TABLE_OPEN);
      if (made == CAROM_OK)
        measure(&own, 1e-9);
      closed += made == CAROM_OK;
    }
    ck_assert_int_gt(closed, 10);
  }
  carom_table_make(CAROM_TABLE_THREECUSHION, &table);
  ck_assert(table.width == 1.42 && table.length == 2.84 && table.rails == 4 && table.jaws == 0 &&
            table.pockets == 0);
  for (int k = 0; k < 4; k++)
    ck_assert_double_eq(table.rail[k].height, 0.037);
}

/* A measure that is out of its range, or that leaves no room for another, is named, with its bound;
 * just below that the table has room. */
TEST(measures_at_fault) {
  static const struct {
    int measure, other; /* -1: out of its range */
    double value, of_other;
  } wrong[] = {{AT(width), -1, 0.0, 0.0},
               {AT(nose_height), -1, NAN, 0.0},
               {AT(corner_mouth), -1, 0.0, 0.0},
               {AT(side_cut), -1, 14.0, 0.0},
               {AT(corner_mouth), AT(width), 0.9, 1.0},
               {AT(side_mouth), AT(length), 0.9, 1.0},
               {AT(corner_jaw), AT(cushion_depth), 0.3, 0.05},
               {AT(side_jaw), AT(cushion_depth), 0.3, 0.05},
               {AT(cushion_depth), AT(corner_cut), 0.45, 141.0},
               {AT(cushion_depth), AT(side_cut), 0.3, 104.0}};
  carom_measures m;
  carom_table_fault fault;
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
    double *const x = &m.width;
    carom_table_measures(CAROM_TABLE_POOLTOOL, &m);
    if (wrong[k].other >= 0)
      x[wrong[k].other] = wrong[k].of_other;
    x[wrong[k].measure] = wrong[k].value;
    ck_assert_int_eq(carom_table_measured(&m, 0.028575, &table, &fault), CAROM_ERROR_TABLE);
    ck_assert(fault.part.kind == CAROM_PART_MEASURES && fault.part.index == wrong[k].measure);
    ck_assert_int_eq(fault.other.kind == CAROM_PART_MEASURES ? fault.other.index : -1,
                     wrong[k].other);
    x[wrong[k].measure] = fault.gap * (1.0 - 1e-9);
    if (wrong[k].other >= 0)
      ck_assert(carom_table_measured(&m, 0.028575, &table, &fault) != CAROM_ERROR_TABLE ||
                fault.part.index != wrong[k].measure);
  }
  ck_assert_int_eq(carom_table_measured(NULL, 0.028575, &table, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_table_measures(CAROM_TABLE_POOL_7FT, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_table_measures((carom_table_kind)99, &m), CAROM_ERROR_TABLE_KIND);
}
