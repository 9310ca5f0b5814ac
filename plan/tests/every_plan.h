/* The functions of carom_plan.h, called as tests/every_function.h calls all others, which includes
 * this. */
#ifndef CAROM_TESTS_EVERY_PLAN_H
#define CAROM_TESTS_EVERY_PLAN_H

#include "carom_coach.h"

_Static_assert(sizeof(carom_plan_stroke) == 27 * sizeof(double), "the room for choices");

/* A plan for the rack, with few shots. */
static inline carom_plan_job plan_of(const every_input *in, every_room *room,
                                     const carom_player *player, const carom_plan_rules *rules,
                                     const carom_plan_options *options) {
  return (carom_plan_job){.table = &in->table,
                          .balls = in->balls,
                          .count = EVERY_BALLS,
                          .cue = &in->cue[0],
                          .player = player,
                          .rules = rules,
                          .options = options,
                          .memory = room->plan,
                          .memory_size = sizeof room->plan};
}
static inline carom_status every_why(const carom_plan_job *job, every_room *room) {
  carom_plan_stroke choice = {.cue = *job->cue, .ball = -1, .pocket = -1};
  memset(&room->why, 0, sizeof room->why);
  choice.place[0] = job->balls[job->cue->ball].state.r[0];
  choice.place[1] = job->balls[job->cue->ball].state.r[1];
  const carom_status status = carom_why_of(job, &choice, &room->why);
  room->choice[0] = room->why.speed + room->why.misses;
  return status;
}
#define EVERY_PLAN(name, call)                                                 \
  EVERY_BODY(name) {                                                           \
    const carom_player player = carom_player_of(1.0);                          \
    const carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_POTTING);   \
    const carom_plan_options options = {.shots = 100, .threads = in->threads}; \
    const carom_plan_job job = plan_of(in, room, &player, &rules, &options);   \
    int found = 0;                                                             \
    memset(room->choice, 0, sizeof room->choice);                              \
    STATUS(call);                                                              \
    HASH(found);                                                               \
    return HASH(room->choice);                                                 \
  }
EVERY_PLAN(plan, carom_plan(&job, (carom_plan_stroke *)room->choice, EVERY_FEW, &found))
EVERY_PLAN(plan_continue,
           carom_plan(&job, (carom_plan_stroke *)room->choice, EVERY_FEW, &found) < 0
               ? CAROM_ERROR_NULL
               : carom_plan_continue(&job, (carom_plan_stroke *)room->choice, EVERY_FEW, &found))
EVERY_PLAN(plan_hand,
           carom_plan_hand(&job, NULL, NULL, (carom_plan_stroke *)room->choice, EVERY_FEW, &found))
EVERY_PLAN(plan_try, carom_plan_try(&job, in->cue, 2, (carom_plan_stroke *)room->choice))
EVERY_PLAN(plan_value, carom_plan_value(&job, 1, &room->choice[0]))
EVERY_PLAN(plan_replay, carom_plan(&job, (carom_plan_stroke *)room->choice, EVERY_FEW, &found) < 0
                            ? CAROM_ERROR_NULL
                            : carom_plan_replay(&job, (carom_plan_stroke *)room->choice, 1))
EVERY_PLAN(why_of, every_why(&job, room))
EVERY_BODY(aim) {
  for (int pocket = 0; pocket < 6; pocket++) {
    carom_cue cue = in->cue[0];
    carom_pot pot = {.ball = 1, .pocket = pocket, .vias = pocket % 3};
    pot.via[0] = pocket == 1 ? (carom_part){CAROM_PART_RAIL, 0} : (carom_part){CAROM_PART_BALL, 2};
    pot.via[1] = (carom_part){CAROM_PART_RAIL, 2};
    STATUS(carom_aim(&in->table, in->balls, EVERY_BALLS, NULL, &pot, &cue));
    HASH(cue);
    HASH(pot);
  }
  return h;
}
/* The ways of two strokes in few directions. */
static inline carom_ways_job ways_of(const every_input *in, every_room *room,
                                     const carom_player *player,
                                     const carom_shot_options *options) {
  return (carom_ways_job){.table = &in->table,
                          .balls = in->balls,
                          .count = EVERY_BALLS,
                          .cues = in->cue,
                          .strokes = 1,
                          .player = player,
                          .shot = options,
                          .scan = 180,
                          .ball = -1,
                          .pocket = -1,
                          .rails = 2,
                          .memory = room->coach,
                          .memory_size = sizeof room->coach};
}
#define EVERY_WAYS(name, call)                                       \
  EVERY_BODY(name) {                                                 \
    const carom_player player = carom_player_of(1.0);                \
    const carom_shot_options options = {.threads = in->threads};     \
    const carom_ways_job job = ways_of(in, room, &player, &options); \
    carom_ways_result result = {0};                                  \
    memset(room->ways, 0, sizeof room->ways);                        \
    room->ways[0] = (carom_shot_way){.cue = in->cue[0], .ball = 1};  \
    STATUS(call);                                                    \
    HASH(result);                                                    \
    return HASH(room->ways[0].chance);                               \
  }
EVERY_WAYS(ways, carom_ways(&job, room->ways, EVERY_FEW, &result))
EVERY_WAYS(way_chance, carom_way_chance(&job, room->ways))
EVERY_WAYS(way_succeeds, (carom_status)carom_way_succeeds(&job, NULL, room->ways))
EVERY_VALUE(ways_memory, carom_ways_memory(EVERY_FEW))
EVERY_VALUE(break_memory, carom_break_memory())
EVERY_VALUE(break_has_rules, carom_break_has_rules(CAROM_RACK_EIGHTBALL))
EVERY_VALUE(names_ball, carom_names_ball(&(carom_plan_stroke){.ball = 1}))
static inline carom_break_job break_of(const every_input *in, every_room *room,
                                       const carom_player *player,
                                       const carom_shot_options *options) {
  return (carom_break_job){.table = &in->table,
                           .balls = in->balls,
                           .count = EVERY_BALLS,
                           .cue = &in->cue[0],
                           .player = player,
                           .shot = options,
                           .rack = CAROM_RACK_EIGHTBALL,
                           .gap = 1e-4,
                           .seed = 1,
                           .memory = room->coach,
                           .memory_size = sizeof room->coach};
}
#define EVERY_BREAK(name, call)                                        \
  EVERY_BODY(name) {                                                   \
    const carom_player player = carom_player_of(1.0);                  \
    const carom_shot_options options = {.threads = in->threads};       \
    const carom_break_job job = break_of(in, room, &player, &options); \
    carom_cue cue;                                                     \
    memset(&room->counts, 0, sizeof room->counts);                     \
    memset(room->balls, 0, sizeof room->balls);                        \
    memset(&cue, 0, sizeof cue);                                       \
    STATUS(call);                                                      \
    HASH(room->counts);                                                \
    HASH(room->balls);                                                 \
    return HASH(cue);                                                  \
  }
EVERY_BREAK(break_stroke, carom_break_stroke(&job, 1, room->balls, &cue))
EVERY_BREAK(break_play, carom_break_play(&job, 0, 2, &room->counts))
EVERY_BODY(break_spread) {
  const carom_break_counts counts = {.stays = 2, .x = 1.0, .y = 2.0, .squares = 3.0};
  double place[2];
  const double spread = carom_break_spread(&counts, place);
  HASH(place);
  return HASH(spread);
}
EVERY_VALUE(plan_memory, carom_plan_memory(NULL))
EVERY_VALUE(rules_about_of, carom_rules_about_of(CAROM_RULES_SNOOKER)->last)
EVERY_BODY(rules_fault) {
  const carom_rules_state state = {.group = 3};
  const char *range = "";
  return HASH(*carom_rules_fault(CAROM_RULES_EIGHTBALL, &state, &range));
}
EVERY_NAMES(foul_string, int)
EVERY_BODY(game_word) {
  return every_text(h, carom_game_word(CAROM_GAME_WORDS_FOUL, CAROM_FOUL_JUMP));
}
EVERY_BODY(game_word_text) {
  return every_text(h, carom_game_word_text(CAROM_GAME_WORDS_FOUL, CAROM_FOUL_JUMP));
}
EVERY_NAMES(plan_kind_name, carom_plan_kind)
EVERY_BODY(pot_kind) {
  static const carom_shot none;
  STATUS(carom_pot_kind(&in->table, &none, 0, 1, 2));
  return h;
}
EVERY_VALUE(is_beside, carom_is_beside(&in->table, 0, 0))
EVERY_BODY(stroke_marks) {
  for (uint32_t down = 0; down < 4; down++) {
    const carom_facts facts = {.first = {2, -1}, .down = down};
    STATUS(carom_stroke_marks(&facts, 0));
  }
  return h;
}
EVERY_BODY(foul_of) {
  for (uint32_t down = 0; down < 4; down++) {
    const carom_facts facts = {.first = {2, -1}, .down = down};
    STATUS(carom_foul_of(&facts, 4, 0));
  }
  return h;
}
EVERY_BODY(spot_ball) {
  carom_shot_ball balls[EVERY_BALLS];
  memcpy(balls, in->balls, sizeof balls);
  STATUS(carom_spot_ball(&in->table, balls, EVERY_BALLS, 0));
  return HASH(balls);
}
EVERY_BODY(spot_ball_of) {
  carom_shot_ball balls[EVERY_BALLS];
  memcpy(balls, in->balls, sizeof balls);
  STATUS(carom_spot_ball_of(CAROM_RACK_SNOOKER, &in->table, balls, EVERY_BALLS, 1));
  return HASH(balls);
}
EVERY_BODY(turn_settle) {
  carom_shot_ball balls[EVERY_BALLS];
  memcpy(balls, in->balls, sizeof balls);
  carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  carom_turn turn = {.spot = 2};
  STATUS(carom_turn_settle(&rules, &rules.state, &in->table, balls, EVERY_BALLS, &turn));
  return HASH(balls);
}
EVERY_BODY(referee) {
  const carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  const carom_call call = {-1, -1};
  static const carom_ruling none;
  carom_ruling ruling = none;
  STATUS(carom_referee(&rules, &in->table, in->balls, EVERY_BALLS, 0, NULL, call, &ruling));
  HASH(ruling.turn);
  return HASH(ruling.state);
}
EVERY_VALUE(ruling_string, carom_ruling_string(NULL, NULL, 0))
EVERY_OBJECT(player_of, carom_player, carom_player_of(2.0))
EVERY_OBJECT(player_fargo, carom_player, carom_player_fargo(512.0))
EVERY_BODY(player_strike) {
  const carom_player player = carom_player_of(2.0);
  carom_cue cue = in->cue[0];
  carom_player_strike(&player, 7, 3, &cue);
  return HASH(cue);
}
EVERY_BODY(rating_of) {
  const carom_score scores[] = {{500.0, 7.0, 3.0}, {620.0, 2.0, 4.5}};
  carom_rating rating;
  STATUS(carom_rating_of(scores, 2, &rating));
  return HASH(rating);
}
EVERY_BODY(cue_ball_of) {
  carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_FOURBALL);
  for (rules.state.group = 0; rules.state.group < 3; rules.state.group++) {
    const int ball = carom_cue_ball_of(&rules);
    HASH(ball);
  }
  return h;
}
EVERY_OBJECT(plan_rules_of, carom_plan_rules, carom_plan_rules_of(CAROM_RULES_NINEBALL))

/* ---- carom_match.h */

/* A match of eight-ball whose cue ball is placed. */
static inline void every_match(const every_input *in, every_room *room) {
  carom_match_begin(&room->match, CAROM_RULES_EIGHTBALL, &in->table, 3, 0);
  carom_match_place(&room->match, 0, 0.6, 0.6);
}
/* The same, and an act of it by a call. */
#define EVERY_ACT(name, call)             \
  EVERY_BODY(name) {                      \
    every_match(in, room);                \
    STATUS(call);                         \
    h = every_text(h, room->match.fault); \
    return HASH(room->match.record.hash); \
  }
static inline carom_seating every_seating(void) {
  carom_seating seating;
  carom_seating_make(CAROM_RULES_SNOOKER, 4, &seating);
  return seating;
}
static inline carom_status every_replay(carom_match *match) {
  carom_cue cue = match->cue;
  cue.phi = 80.0;
  carom_match_stroke(match, 0, &cue, NULL, NULL);
  carom_shot shot = {.room = 0};
  return carom_match_replay(match, &shot);
}
EVERY_BODY(hand_bounds) {
  carom_bounds bounds;
  STATUS(carom_hand_bounds(CAROM_LEAVE_D, &in->table, 0.028, &bounds));
  return HASH(bounds);
}
EVERY_BODY(is_within) {
  const carom_bounds bounds = {{0.0, 0.0}, {1.0, 2.0}, {0.5, 0.5}, 0.4};
  return h + (uint64_t)carom_is_within(&bounds, 0.5, 0.3);
}
EVERY_BODY(refusal_name) {
  return every_text(h, carom_refusal_name(CAROM_REFUSED_BOUNDS));
}
EVERY_ACT(match_begin, 0)
EVERY_BODY(match_begin_at) {
  STATUS(carom_match_begin_at(&room->match, CAROM_RULES_NINEBALL, NULL, &in->table, in->balls, 10,
                              NULL, CAROM_LEAVE_AFTER, 1));
  return HASH(room->match.record.hash);
}
EVERY_BODY(match_begin_to) {
  STATUS(carom_match_begin_to(&room->match, CAROM_RULES_STRAIGHT, 30, 0, &in->table, 3, 1));
  return HASH(room->match.record.hash);
}
EVERY_BODY(match_begin_with) {
  const carom_match_setup setup = {.rules = CAROM_RULES_SNOOKER, .table = &in->table, .seed = 3};
  STATUS(carom_match_begin_with(&room->match, &setup));
  return HASH(room->match.record.hash);
}
EVERY_OBJECT(seating_make, carom_seating, every_seating())
EVERY_ACT(match_extend, carom_match_extend(&room->match, 0))
EVERY_ACT(match_timeout, carom_match_timeout(&room->match, 0))
EVERY_ACT(match_next, carom_match_next(&room->match))
EVERY_ACT(match_replay, every_replay(&room->match))
EVERY_BODY(match_standing) {
  every_match(in, room);
  carom_standing standing;
  STATUS(carom_match_standing(&room->match, &standing));
  return HASH(standing);
}
EVERY_BODY(match_string) {
  every_match(in, room);
  char text[200] = "";
  carom_match_string(&room->match, text, sizeof text);
  return every_text(h, text);
}
EVERY_BODY(match_undone) {
  every_match(in, room);
  return h + carom_match_undone(room->match.text, (size_t)room->match.size);
}
EVERY_BODY(match_read_from) {
  every_match(in, room);
  memset(&room->reader, 0, sizeof room->reader);
  const char *line = room->match.text;
  STATUS(carom_match_read_from(&room->reader, &room->record, line, strcspn(line, "\n"), 1));
  return HASH(room->reader.record.hash);
}
EVERY_ACT(match_place, carom_match_place(&room->match, 0, 0.7, 0.5))
EVERY_ACT(match_call, carom_match_call(&room->match, 0, (carom_call){3, 1}))
EVERY_ACT(match_choose, carom_match_choose(&room->match, 0, CAROM_CHOICE_PASS))
EVERY_ACT(match_prepare,
          carom_match_prepare(&room->match, 0, &(carom_plan_stroke){.ball = 3, .pocket = 1}))
EVERY_ACT(match_stroke, carom_match_stroke(&room->match, 0, &in->cue[0], NULL, NULL))
EVERY_ACT(match_continue, carom_match_continue(&room->match, NULL, NULL))
EVERY_ACT(match_concede, carom_match_concede(&room->match, 1))
EVERY_ACT(match_clock, carom_match_clock(&room->match, 0))
EVERY_ACT(match_end, carom_match_end(&room->match))
EVERY_BODY(match_read) {
  every_match(in, room);
  memset(&room->reader, 0, sizeof room->reader);
  const char *line = room->match.text;
  STATUS(carom_match_read(&room->reader, &room->record, line, strcspn(line, "\n")));
  return HASH(room->reader.record.hash);
}
EVERY_BODY(match_plan) {
  every_match(in, room);
  const carom_player player = carom_player_of(1.0);
  const carom_plan_options options = {.shots = 100};
  carom_plan_job job = {.player = &player,
                        .cue = &in->cue[0],
                        .options = &options,
                        .memory = room->plan,
                        .memory_size = carom_plan_memory(&options)};
  carom_plan_stroke choice;
  int found = 0;
  STATUS(carom_match_plan(&room->match, &job, &choice, 1, &found));
  return HASH(choice);
}

/* clang-format off */
#define EVERY_OF_PLANS(F) \
  F(hand_bounds) F(is_within) F(match_begin) F(match_begin_at) F(match_begin_to) F(match_call) \
  F(match_choose) F(match_clock) F(match_concede) F(match_continue) F(match_end) F(match_place) \
  F(match_plan) F(match_prepare) F(match_read) F(match_stroke) F(refusal_name) \
  F(aim) F(foul_of) F(foul_string) F(game_word) F(game_word_text) F(is_beside) \
  F(plan) F(plan_continue) F(plan_hand) \
  F(cue_ball_of) F(plan_kind_name) F(plan_memory) F(plan_rules_of) F(plan_try) F(plan_value) \
  F(player_fargo) F(player_of) F(player_strike) F(pot_kind) \
  F(rating_of) F(referee) F(rules_about_of) F(rules_fault) F(ruling_string) F(spot_ball) \
  F(spot_ball_of) F(stroke_marks) F(turn_settle) \
  F(break_has_rules) F(break_memory) F(break_play) F(break_spread) F(break_stroke) F(names_ball) \
  F(plan_replay) F(way_chance) F(way_succeeds) F(ways) F(ways_memory) F(why_of)
/* clang-format on */

#endif
