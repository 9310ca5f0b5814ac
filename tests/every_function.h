/* Every public function, called with fixed arguments: what it computes, as one number, which is
 * the same whenever, wherever and beside whatever it is called. unit/threads.c calls all of them
 * at once, unit/stack.c on small stacks. */
#ifndef CAROM_TESTS_EVERY_FUNCTION_H
#define CAROM_TESTS_EVERY_FUNCTION_H

#ifndef CAROM_WITHOUT_PLAN
#include "carom_coach.h"
#include "carom_match.h"
#endif
#include "carom_record.h"
#include "carom_tangent.h"
#include "support.h"

#include <stdio.h>
#include <string.h>

enum {
  EVERY_ROWS = 256,
  EVERY_FEW = 8,
  EVERY_POINTS = 5,
  EVERY_BALLS = 16,
  EVERY_SHOTS = 8,
  EVERY_EVENTS = 600
};

/* What the calls are about; nothing writes to it. */
typedef struct every_input {
  carom_impact impact[EVERY_ROWS];
  carom_impact_f32 impact_f32[EVERY_ROWS];
  carom_cushion_impact cushion[EVERY_ROWS];
  carom_table table;
  carom_shot_ball balls[EVERY_BALLS];
  carom_cue cue[EVERY_SHOTS];
  double seeds[26 * CAROM_DIRECTIONS_MOST]; /* of any derivatives: all numbers change in all
                                               directions */
  int threads;                              /* of batches */
} every_input;

/* Where a caller has its results, so that its stack has only what the library puts there. */
typedef struct every_room {
  carom_result result[EVERY_ROWS];
  carom_result_f32 result_f32[EVERY_ROWS];
  carom_motion motion[EVERY_ROWS];
  int8_t status[EVERY_ROWS];
  carom_trace_point point[EVERY_POINTS];
  carom_cushion_point cushion_point[EVERY_POINTS];
  carom_detail detail;
  carom_cluster_contact cluster[EVERY_FEW];
  carom_event event[EVERY_EVENTS];
  carom_brief_event brief[EVERY_SHOTS][EVERY_EVENTS];
  carom_shot shot[EVERY_SHOTS];
  carom_shot_state state;
  carom_frames frames;
  carom_ball_state final[EVERY_BALLS], later[3 * EVERY_BALLS];
  double turned[EVERY_BALLS][4];
  carom_table table;
  carom_shot_ball balls[EVERY_BALLS];
  double contact[12 * CAROM_DIRECTIONS_MOST],
      ends[EVERY_SHOTS][EVERY_BALLS * CAROM_STATE_NUMBERS * CAROM_DIRECTIONS_MOST],
      times[EVERY_EVENTS * CAROM_DIRECTIONS_MOST],
      before[EVERY_EVENTS * 2 * CAROM_STATE_NUMBERS * CAROM_DIRECTIONS_MOST],
      reach[CAROM_DIRECTIONS_MOST];
  carom_tangent tangent[EVERY_SHOTS];
  double plan[65536], choice[27 * EVERY_FEW], coach[400000]; /* of every_plan.h */
  carom_record record;
  char line[CAROM_RECORD_TEXT];
#ifndef CAROM_WITHOUT_PLAN
  carom_match match, reader;
  carom_break_counts counts;
  carom_shot_way ways[EVERY_FEW];
  carom_why why;
#endif
} every_room;

/* number: whose input it is; others have other numbers. */
static inline void every_input_make(every_input *in, int number, int threads) {
  random_source r = {test_seed() + (uint64_t)number};
  memset(in, 0, sizeof *in);
  in->threads = threads;
  for (int k = 0; k < 26 * CAROM_DIRECTIONS_MOST; k++)
    in->seeds[k] = random_between(&r, -1.0, 1.0);
  for (int k = 0; k < EVERY_ROWS; k++) {
    in->impact[k] = random_impact(&r);
    in->impact_f32[k] = narrowed(&in->impact[k]);
    in->cushion[k] = random_cushion(&r);
  }
  carom_table_make(CAROM_TABLE_POOL_9FT, &in->table);
  carom_rack(CAROM_RACK_EIGHTBALL, &in->table, 1e-4, (uint64_t)number, in->balls, EVERY_BALLS);
  for (int k = 0; k < EVERY_SHOTS; k++) {
    in->cue[k] = carom_cue_of(CAROM_GAME_POOL);
    in->cue[k].speed = 5.0 + 0.1 * number;
    in->cue[k].phi = 89.0 + 0.3 * k;
    in->cue[k].a = 0.1;
  }
}

/* ---- One number for what was computed */

static inline uint64_t every_text(uint64_t h, const char *text) {
  return text == NULL ? h * 3 : hash_of(h, text, strlen(text));
}

#define EVERY_BODY(name)                                                         \
  static inline uint64_t every_##name(CK_ATTRIBUTE_UNUSED const every_input *in, \
                                      CK_ATTRIBUTE_UNUSED every_room *room, uint64_t h)
/* A function that gives a number, or an object. */
#define EVERY_VALUE(name, call)  \
  EVERY_BODY(name) {             \
    return h + (uint64_t)(call); \
  }
#define EVERY_OBJECT(name, type, call) \
  EVERY_BODY(name) {                   \
    const type object = (call);        \
    return HASH(object);               \
  }
#define HASH(object) h = hash_of(h, &(object), sizeof(object))
#define STATUS(call)              \
  do {                            \
    const int code = (int)(call); \
    HASH(code);                   \
  } while (0)

/* ---- Names and numbers */

#define EVERY_NAMES(name, type)                 \
  EVERY_BODY(name) {                            \
    for (int k = -70; k < 40; k++)              \
      h = every_text(h, carom_##name((type)k)); \
    return h;                                   \
  }
EVERY_NAMES(status_name, carom_status)
EVERY_NAMES(status_string, carom_status)
EVERY_NAMES(solver_name, carom_solver)
EVERY_NAMES(slip_name, carom_slip)
EVERY_NAMES(isa_name, carom_isa)
EVERY_NAMES(field_name, int)
EVERY_NAMES(cushion_field_name, int)
EVERY_NAMES(cushion_model_name, carom_cushion_model)
EVERY_NAMES(label_name, carom_label)
EVERY_NAMES(table_name, carom_table_kind)
EVERY_NAMES(rack_name, carom_rack_kind)
EVERY_NAMES(event_name, carom_event_type)

EVERY_BODY(isa_available) {
  for (int k = -2; k < 9; k++)
    STATUS(carom_isa_available((carom_isa)k));
  return h;
}
EVERY_VALUE(isa_in_force, carom_isa_in_force())
/* It may not change while a batch runs; lifting a limit that there is not changes nothing. */
EVERY_VALUE(isa_limit, carom_isa_limit(CAROM_ISA_ANY))
EVERY_BODY(version) {
  return every_text(h, carom_version());
}
EVERY_BODY(cite) {
  char text[4000];
  const size_t length = carom_cite(NULL, text, sizeof text);
  HASH(length);
  return every_text(h, text);
}
EVERY_BODY(shot_fault) {
  carom_fault fault;
  char text[100];
  const carom_cue cue = {.speed = -1};
  STATUS(carom_shot_fault(&in->table, in->balls, 2, &cue, NULL, &fault, text, sizeof text));
  return every_text(h, text);
}
EVERY_BODY(number_of) {
  for (int part = CAROM_PART_BALL; part <= CAROM_PART_PLAN_OPTIONS; part++)
    for (int k = 0; carom_number_of((carom_part_kind)part, k) != NULL; k++)
      h = every_text(h, carom_number_of((carom_part_kind)part, k)->name);
  return h;
}
EVERY_BODY(number_range) {
  char text[80];
  for (int k = 0; carom_number_of(CAROM_PART_BALL, k) != NULL; k++) {
    const size_t length =
        carom_number_range(carom_number_of(CAROM_PART_BALL, k), text, sizeof text);
    HASH(length);
  }
  return every_text(h, text);
}
EVERY_BODY(ball_fault) {
  char text[80] = "";
  const carom_ball_kind none = {.mass = 0};
  return every_text(h, carom_ball_fault(&none, text, sizeof text)->name);
}
EVERY_BODY(ball_kind_for) {
  carom_ball_kind kind;
  for (int game = CAROM_GAME_POOL; game <= CAROM_GAME_POOLTOOL_BILLIARD; game++)
    for (int model = CAROM_SHOT_CUSHION_DEFAULT; model <= CAROM_SHOT_CUSHION_SMOOTH; model++) {
      const int own = carom_ball_kind_for((carom_game)game, (carom_shot_cushion)model, &kind);
      HASH(own);
      HASH(kind);
    }
  return h;
}
EVERY_BODY(bank_of) {
  carom_bank bank = {0};
  for (int k = -1; k <= CAROM_BANKS; k++) {
    const carom_status status = carom_bank_of(k, &bank);
    HASH(status);
    HASH(bank);
  }
  return h;
}

EVERY_BODY(calibrate) {
  static const double reading[CAROM_BANKS] = {4.8, 5.1, 6.8};
  const carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  carom_calibration found;
  const carom_status status = carom_calibrate(&in->table, &kind, reading, &found);
  HASH(status);
  HASH(found);
  return h;
}

EVERY_BODY(condition_give) {
  carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  for (int k = -1; k <= CAROM_CONDITION_HUMID_CUSHION + 1; k++) {
    const int is = carom_condition_give((carom_condition)k, &kind);
    HASH(is);
    HASH(kind);
  }
  return h;
}
EVERY_BODY(cushion_start) {
  carom_ball_kind kind = {.mass = carom_cushion_start(CAROM_CUSHION_EULER, NULL)};
  for (int model = 0; carom_cushion_model_name((carom_cushion_model)model) != NULL; model++) {
    const int is = carom_cushion_start((carom_cushion_model)model, &kind);
    HASH(is);
    HASH(kind);
  }
  return h;
}
EVERY_BODY(word) {
  for (int of = 0; of <= CAROM_WORDS_CONDITION; of++)
    h = every_text(h, carom_word((carom_words)of, 1));
  return h;
}
EVERY_BODY(word_text) {
  for (int of = 0; of <= CAROM_WORDS_CONDITION; of++)
    h = every_text(h, carom_word_text((carom_words)of, 1));
  return h;
}
EVERY_VALUE(number_is_read,
            carom_number_is_read(carom_number_of(CAROM_PART_BALL, 5), &in->balls[0].kind, NULL))
EVERY_VALUE(version_number, carom_version_number())
EVERY_VALUE(physics_revision, carom_physics_revision())
EVERY_VALUE(serves, carom_serves(CAROM_VERSION_NUMBER))
EVERY_VALUE(rack_size, carom_rack_size(CAROM_RACK_SNOOKER))
EVERY_OBJECT(ball_kind_of, carom_ball_kind, carom_ball_kind_of(CAROM_GAME_BILLIARD))
EVERY_OBJECT(cue_of, carom_cue, carom_cue_of(CAROM_GAME_SNOOKER))

/* ---- Collisions and cushions */

EVERY_OBJECT(alciatore, carom_speed_law, carom_alciatore())
EVERY_BODY(mu_ball) {
  for (int k = 0; k < EVERY_FEW; k++) {
    const double mu = carom_mu_ball(&in->impact[k], carom_alciatore());
    HASH(mu);
  }
  return h;
}
EVERY_BODY(rolling_velocity) {
  double v[3];
  carom_rolling_velocity(in->impact[0].a.v, in->impact[0].a.w, 0.028575, v);
  return HASH(v);
}
EVERY_BODY(check) {
  int field;
  STATUS(carom_check(&in->impact[0], NULL, &field));
  return HASH(field);
}
EVERY_BODY(collide) {
  for (int k = 0; k < EVERY_FEW; k++)
    STATUS(carom_collide(&in->impact[k], NULL, &room->result[k]));
  return hash_of(h, room->result, EVERY_FEW * sizeof room->result[0]);
}
EVERY_BODY(collide_detail) {
  for (int k = 0; k < EVERY_FEW; k++) {
    STATUS(carom_collide_detail(&in->impact[k], NULL, &room->result[k], &room->detail));
    HASH(room->detail.normal);
    HASH(room->detail.friction);
    HASH(room->detail.work);
  }
  return h;
}
/* The exact solver, and Euler's steps, which few rows are worth threads for. */
EVERY_BODY(collide_batch) {
  for (int solver = 0; solver < 2; solver++) {
    const carom_options options = {
        .solver = (carom_solver)solver, .steps = 300, .threads = in->threads};
    STATUS(carom_collide_batch(in->impact, EVERY_ROWS, &options, room->result, room->status));
    HASH(room->result);
    HASH(room->status);
  }
  return h;
}
EVERY_BODY(collide_batch_f32) {
  for (int solver = 0; solver < 2; solver++) {
    const carom_options options = {
        .solver = (carom_solver)solver, .steps = 300, .threads = in->threads};
    STATUS(carom_collide_batch_f32(in->impact_f32, EVERY_ROWS, &options, room->result_f32,
                                   room->status));
    HASH(room->result_f32);
  }
  return h;
}
EVERY_BODY(trace) {
  for (int solver = 0; solver < 2; solver++) {
    const carom_options options = {.solver = (carom_solver)solver, .steps = 100};
    STATUS(carom_trace(&in->impact[1], &options, EVERY_POINTS, room->point));
    HASH(room->point);
  }
  return h;
}
EVERY_BODY(cushion) {
  for (int k = 0; k < 5 * EVERY_FEW; k++) {
    const carom_cushion_options options = {.model = (carom_cushion_model)(k % 5), .steps = 100};
    STATUS(carom_cushion(&in->cushion[k], &options, &room->motion[k]));
  }
  return hash_of(h, room->motion, (size_t)5 * EVERY_FEW * sizeof room->motion[0]);
}
EVERY_BODY(cushion_batch) {
  const carom_cushion_options options = {.threads = in->threads};
  STATUS(carom_cushion_batch(in->cushion, EVERY_ROWS, &options, room->motion, room->status));
  return HASH(room->motion);
}
EVERY_BODY(cushion_check) {
  int field;
  STATUS(carom_cushion_check(&in->cushion[0], NULL, &field));
  return HASH(field);
}
EVERY_BODY(cushion_trace) {
  for (int k = 0; k < 2; k++) {
    const carom_cushion_options options = {
        .model = k == 0 ? CAROM_CUSHION_MATHAVAN : CAROM_CUSHION_EULER, .steps = 100};
    STATUS(carom_cushion_trace(&in->cushion[1], &options, EVERY_POINTS, room->cushion_point));
    HASH(room->cushion_point);
  }
  return h;
}

/* ---- Tables, balls and shots */

EVERY_BODY(table_make) {
  for (int kind = 0; kind < 7; kind++) {
    STATUS(carom_table_make((carom_table_kind)kind, &room->table));
    HASH(room->table);
  }
  return h;
}
EVERY_BODY(table_measures) {
  carom_measures measures;
  STATUS(carom_table_measures(CAROM_TABLE_SNOOKER, &measures));
  return HASH(measures);
}
EVERY_BODY(table_measured) {
  const carom_measures measures = {.width = 2.0, .length = 4.0, .nose_height = 0.037};
  STATUS(carom_table_measured(&measures, 0.028575, &room->table, NULL));
  return HASH(room->table);
}
EVERY_BODY(table_check) {
  carom_table_fault fault;
  memset(&room->table, 0, sizeof room->table);
  room->table = in->table;
  room->table.rail[3].side = 1 - room->table.rail[3].side;
  STATUS(carom_table_check(&in->table, in->balls[0].kind.radius, &fault));
  HASH(fault);
  STATUS(carom_table_check(&room->table, in->balls[0].kind.radius, &fault));
  return HASH(fault);
}
EVERY_BODY(table_polygon) {
  static const carom_corner corner[4] = {{0, 0, 0.12}, {1, 0.1, 0.12}, {1, 1.6, 0}, {0, 1.5, 0.12}};
  STATUS(carom_table_polygon(corner, 4, 0.0366, 0.01, 0.028575, &room->table, NULL));
  return HASH(room->table);
}
EVERY_BODY(rack) {
  STATUS(carom_rack(CAROM_RACK_NINEBALL, &in->table, 1e-4, 3, room->balls, EVERY_BALLS));
  return hash_of(h, room->balls, 10 * sizeof room->balls[0]);
}
EVERY_BODY(place_ball) {
  carom_part part;
  memcpy(room->balls, in->balls, sizeof room->balls);
  STATUS(carom_place_ball(&in->table, room->balls, EVERY_BALLS, 0, 0.3, 0.4, &part));
  STATUS(carom_place_ball(&in->table, room->balls, EVERY_BALLS, 0, in->balls[3].state.r[0],
                          in->balls[3].state.r[1], &part));
  HASH(part);
  return HASH(room->balls);
}
EVERY_BODY(strike) {
  STATUS(carom_strike(&in->cue[0], &in->balls[0].kind, &room->motion[0]));
  return HASH(room->motion[0]);
}
EVERY_BODY(shot_check) {
  int where;
  STATUS(carom_shot_check(&in->table, in->balls, EVERY_BALLS, &in->cue[0], NULL, &where));
  return HASH(where);
}

/* A break, up to a time or to its end. */
static inline carom_status every_break(const every_input *in, every_room *room, int world,
                                       double time_most) {
  const carom_shot_options options = {.world = (carom_world)world, .time_most = time_most};
  room->shot[0] = (carom_shot){
      .events = room->event, .room = EVERY_EVENTS, .final = room->final, .state = &room->state};
  return carom_shoot(&in->table, in->balls, EVERY_BALLS, &in->cue[0], &options, &room->shot[0]);
}
static inline uint64_t every_shot(uint64_t h, const every_room *room) {
  HASH(room->shot[0].count);
  HASH(room->final);
  return hash_of(h, room->event, (size_t)room->shot[0].count * sizeof room->event[0]);
}
EVERY_BODY(shoot) {
  for (int world = 0; world < 2; world++) {
    STATUS(every_break(in, room, world, 0.0));
    h = every_shot(h, room);
  }
  return h;
}
EVERY_BODY(shot_continue) {
  STATUS(every_break(in, room, 0, 0.5));
  STATUS(carom_shot_continue(&in->table, in->balls, EVERY_BALLS, NULL, &room->shot[0]));
  return every_shot(h, room);
}
EVERY_BODY(shot_at) {
  every_break(in, room, 0, 0.5);
  for (int k = 0; k < 5; k++) {
    STATUS(carom_shot_at(in->balls, EVERY_BALLS, &room->shot[0], 0.1 * k, room->final));
    HASH(room->final);
  }
  return h;
}
EVERY_BODY(shot_at_times) {
  static const double times[] = {0.4, 0.1, 0.2};
  every_break(in, room, 0, 0.5);
  STATUS(carom_shot_at_times(in->balls, EVERY_BALLS, &room->shot[0], times, 3, room->later));
  return HASH(room->later);
}
EVERY_BODY(shot_drawn) {
  static const double times[] = {0.4, 0.1, 3.0};
  every_break(in, room, 0, 0.0);
  STATUS(
      carom_shot_drawn(&in->table, in->balls, EVERY_BALLS, &room->shot[0], times, 3, room->later));
  return HASH(room->later);
}
EVERY_BODY(shot_falls) {
  static const double late = 3.0;
  every_break(in, room, 0, 0.0);
  STATUS(
      carom_shot_falls(&in->table, in->balls, EVERY_BALLS, &room->shot[0], &late, 1, room->final));
  return HASH(room->final);
}
EVERY_BODY(event_slip) {
  double slip[20];
  every_break(in, room, 0, 0.0);
  for (int k = 0; k < 20; k++)
    slip[k] = carom_event_slip(&in->table, in->balls, EVERY_BALLS, &room->shot[0].events[k]);
  return HASH(slip);
}
EVERY_BODY(rail_name) {
  for (int k = -1; k < 20; k++)
    h = every_text(h, carom_rail_name(&in->table, k));
  return h;
}
EVERY_BODY(pocket_name) {
  for (int k = -1; k < 8; k++)
    h = every_text(h, carom_pocket_name(&in->table, k));
  return h;
}
EVERY_BODY(spot_of) {
  for (int ball = 0; ball < 22; ball++) {
    double place[2] = {0.0, 0.0};
    STATUS(carom_spot_of(CAROM_RACK_SNOOKER, &in->table, ball, place));
    HASH(place);
  }
  return h;
}
EVERY_BODY(table_marks) {
  carom_marks marks;
  STATUS(carom_table_marks(&in->table, &marks));
  HASH(marks);
  return h;
}
EVERY_BODY(impact3) {
  for (int k = 0; k < EVERY_FEW; k++)
    STATUS(carom_impact3(&in->impact[k], &room->result[k]));
  return hash_of(h, room->result, EVERY_FEW * sizeof room->result[0]);
}
EVERY_BODY(cluster) {
  carom_shot_ball balls[EVERY_BALLS];
  memcpy(balls, in->balls, sizeof balls);
  balls[1].state.v[1] = 5.0; /* into the rack */
  STATUS(carom_cluster(balls, EVERY_BALLS, NULL, room->motion, room->cluster, EVERY_FEW, NULL));
  HASH(room->cluster);
  return hash_of(h, room->motion, EVERY_BALLS * sizeof room->motion[0]);
}
EVERY_BODY(shot_orientation) {
  every_break(in, room, 0, 0.5);
  STATUS(carom_shot_orientation(in->balls, EVERY_BALLS, &room->shot[0], 0.4, room->turned));
  return HASH(room->turned);
}
EVERY_BODY(shot_frames) {
  every_break(in, room, 0, 0.5);
  memset(&room->frames, 0, sizeof room->frames);
  for (double time = 0.0; time < 0.5; time += 0.1)
    STATUS(carom_shot_frames(in->balls, EVERY_BALLS, &room->shot[0], &time, 1, &room->frames,
                             room->final, room->turned));
  return HASH(room->turned);
}
EVERY_BODY(shoot_batch) {
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN,
                                      .threads = in->threads};
  for (int k = 0; k < EVERY_SHOTS; k++)
    room->shot[k] = (carom_shot){.brief = room->brief[k], .room = EVERY_EVENTS};
  const carom_shot_job job = {.table = &in->table,
                              .balls = in->balls,
                              .count = EVERY_BALLS,
                              .cues = in->cue,
                              .cue_stride = 1,
                              .n = EVERY_SHOTS,
                              .options = &options,
                              .shots = room->shot,
                              .status = room->status};
  STATUS(carom_shoot_batch(&job));
  for (int k = 0; k < EVERY_SHOTS; k++)
    h = hash_of(h, room->brief[k], (size_t)room->shot[k].count * sizeof room->brief[k][0]);
  return h;
}

EVERY_BODY(collide_tangent) {
  for (int k = 0; k < EVERY_FEW; k++) {
    STATUS(carom_collide_tangent(&in->impact[k], NULL, CAROM_DIRECTIONS_MOST, in->seeds,
                                 room->contact, NULL));
    HASH(room->contact);
  }
  return h;
}
EVERY_BODY(cushion_tangent) {
  for (int k = 0; k < EVERY_FEW; k++) {
    STATUS(carom_cushion_tangent(&in->cushion[k], NULL, CAROM_DIRECTIONS_MOST, in->seeds,
                                 room->contact, NULL));
    h = hash_of(h, room->contact, sizeof room->contact / 2);
  }
  return h;
}
/* With all that can be asked for. */
EVERY_BODY(shot_tangent) {
  const carom_tangent_seeds seeds = {.directions = CAROM_DIRECTIONS_MOST, .cue = in->seeds};
  every_break(in, room, 0, 0.0);
  room->tangent[0] = (carom_tangent){
      .final = room->ends[0], .time = room->times, .before = room->before, .reach = room->reach};
  STATUS(carom_shot_tangent(&in->table, in->balls, EVERY_BALLS, &in->cue[0], NULL, &room->shot[0],
                            &seeds, &room->tangent[0]));
  HASH(room->ends[0]);
  HASH(room->reach);
  /* a ball that flies at a rail right above the cloth, where both the flat and the free model
   * have a part */
  const carom_shot_options exact = {.cushion_model = CAROM_SHOT_CUSHION_MATHAVAN};
  carom_shot_ball ball = in->balls[0];
  ball.state = (carom_ball_state){.r = {ball.kind.radius + 0.01, 0.8, ball.kind.radius + 5e-4},
                                  .v = {-2.0, 0.1, 0.05},
                                  .w = {20.0, -30.0, 40.0},
                                  .label = CAROM_BALL_AIRBORNE};
  room->shot[0].count = 0;
  STATUS(carom_shoot(&in->table, &ball, 1, NULL, &exact, &room->shot[0]));
  const carom_tangent_seeds of_state = {.directions = CAROM_DIRECTIONS_MOST, .state = in->seeds};
  STATUS(carom_shot_tangent(&in->table, &ball, 1, NULL, &exact, &room->shot[0], &of_state,
                            &room->tangent[0]));
  h = hash_of(h, room->ends[0], sizeof(double) * CAROM_STATE_NUMBERS * CAROM_DIRECTIONS_MOST);
  return h;
}
EVERY_BODY(shot_tangent_batch) {
  const carom_tangent_seeds seeds = {.directions = 3, .cue = in->seeds};
  const carom_shot_options options = {.threads = in->threads};
  every_break(in, room, 0, 0.0);
  for (int k = 0; k < EVERY_SHOTS; k++) {
    room->shot[k] = room->shot[0];
    room->tangent[k] = (carom_tangent){.final = room->ends[k]};
  }
  const carom_shot_job job = {.table = &in->table,
                              .balls = in->balls,
                              .count = EVERY_BALLS,
                              .cues = in->cue,
                              .n = EVERY_SHOTS,
                              .options = &options,
                              .shots = room->shot};
  const carom_tangent_job own = {.played = &job, .seeds = &seeds, .tangents = room->tangent};
  STATUS(carom_shot_tangent_batch(&own));
  for (int k = 0; k < EVERY_SHOTS; k++)
    h = hash_of(h, room->ends[k], sizeof(double) * EVERY_BALLS * CAROM_STATE_NUMBERS * 3);
  return h;
}

/* A break, recorded. */
static inline uint64_t every_record_line(const every_input *in, every_room *room,
                                         carom_record_kind kind) {
  memset(&room->record, 0, sizeof room->record);
  room->record.table = in->table;
  room->record.count = EVERY_BALLS;
  memcpy(room->record.balls, in->balls, sizeof in->balls);
  room->record.cue = in->cue[0];
  const size_t first =
      carom_record_write(&room->record, CAROM_RECORD_HEAD, room->line, sizeof room->line);
  return first +
         carom_record_write(&room->record, kind, room->line + first, sizeof room->line - first);
}
EVERY_BODY(record_write) {
  every_record_line(in, room, CAROM_RECORD_BALLS);
  return every_text(h, room->line);
}
EVERY_BODY(record_read) {
  const size_t size = every_record_line(in, room, CAROM_RECORD_TABLE);
  const char *second = strchr(room->line, '\n') + 1;
  memset(&room->record, 0, sizeof room->record);
  STATUS(carom_record_read(&room->record, room->line, (size_t)(second - room->line)));
  STATUS(carom_record_read(&room->record, second, size - (size_t)(second - room->line)));
  return HASH(room->record.table);
}
EVERY_BODY(record_play) {
  every_record_line(in, room, CAROM_RECORD_TABLE);
  STATUS(carom_record_play(&room->record, CAROM_RECORD_SHOT, NULL));
  return HASH(room->record.played);
}
EVERY_BODY(record_place) {
  every_record_line(in, room, CAROM_RECORD_TABLE);
  STATUS(carom_record_place(&room->record, 0, 0.3, 0.4, NULL));
  return HASH(room->record.balls);
}
EVERY_BODY(record_hand) {
  every_record_line(in, room, CAROM_RECORD_TABLE);
  STATUS(carom_record_hand(&room->record, 0));
  return HASH(room->record.balls);
}
EVERY_BODY(record_settle) {
  every_record_line(in, room, CAROM_RECORD_TABLE);
  STATUS(carom_record_settle(&room->record));
  return HASH(room->record.balls);
}

/* ---- All of them */

#ifdef CAROM_WITHOUT_PLAN
#define EVERY_OF_PLANS(F)
#else
#include "../plan/tests/every_plan.h"
#endif

/* clang-format off */
#define EVERY_ONE(F) \
  F(alciatore) F(ball_fault) F(ball_kind_for) F(ball_kind_of) F(bank_of) F(calibrate) \
  F(check) F(cite) F(collide) F(condition_give) \
  F(cluster) F(collide_batch) \
  F(collide_batch_f32) F(collide_detail) F(collide_tangent) F(cue_of) F(cushion) \
  F(cushion_batch) F(cushion_check) F(cushion_field_name) F(cushion_model_name) F(cushion_start) \
  F(cushion_tangent) F(cushion_trace) F(event_name) F(field_name) \
  F(impact3) \
  F(isa_available) F(isa_in_force) F(isa_limit) F(isa_name) F(label_name) F(mu_ball) \
  F(number_is_read) F(number_of) F(number_range) \
  F(physics_revision) F(place_ball) \
  F(pocket_name) F(rack) \
  F(rack_name) F(rack_size) F(rail_name) F(record_hand) F(record_place) F(record_play) \
  F(record_read) F(record_settle) F(record_write) F(rolling_velocity) F(serves) F(shoot) \
  F(shoot_batch) F(shot_at) F(shot_at_times) F(shot_check) F(shot_continue) F(shot_drawn) \
  F(shot_falls) F(shot_fault) F(shot_frames) F(event_slip) \
  F(shot_orientation) \
  F(shot_tangent) F(shot_tangent_batch) F(slip_name) F(solver_name) \
  F(spot_of) F(status_name) \
  F(status_string) F(strike) F(table_check) F(table_make) F(table_marks) F(table_measured) \
  F(table_measures) \
  F(table_name) F(table_polygon) F(trace) \
  F(version) F(version_number) F(word) F(word_text) EVERY_OF_PLANS(F)
/* clang-format on */
#define EVERY_ROW(name) {"carom_" #name, every_##name},
static const struct every_function {
  const char *name;
  uint64_t (*body)(const every_input *in, every_room *room, uint64_t h);
} every_functions[] = {EVERY_ONE(EVERY_ROW)};
enum { EVERY_COUNT = sizeof every_functions / sizeof every_functions[0] };

/* What the library exports, by install/abi-MINOR.expected, is what is called here. */
static inline void every_function_is_there(void) {
  FILE *f = fopen(CAROM_ABI_FILE, "r");
  char line[200], name[200];
  int exported = 0;
  ck_assert_ptr_nonnull(f);
  while (fgets(line, sizeof line, f) != NULL)
    if (sscanf(line, "exported: %199s", name) == 1) {
      int k = 0;
      while (k < EVERY_COUNT && strcmp(every_functions[k].name, name) != 0)
        k++;
#ifndef CAROM_WITHOUT_PLAN
      ck_assert_msg(k < EVERY_COUNT, "tests/every_function.h does not call %s", name);
#endif
      exported += k < EVERY_COUNT;
    }
  fclose(f);
  ck_assert_int_eq(exported, EVERY_COUNT);
}

#undef EVERY_ONE
#undef EVERY_ROW
#undef EVERY_BODY
#undef EVERY_VALUE
#undef EVERY_OBJECT
#undef EVERY_NAMES
#undef HASH
#undef STATUS

#endif
