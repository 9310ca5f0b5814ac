/* A match: acts, rulings and lines of a recording.
 *
 * An act is checked against the phase, the player and the choices, and rejected with nothing
 * changed; else it is applied to the record, and its line is written to match->text. A stroke that
 * ends, a choice that is played instead of one, and a clock that ran out are ruled by
 * carom_referee(); the ruling makes further lines: "balls" if balls are not where the shot left
 * them, "place" if the cue ball is taken in hand, and "game" with the score. match_read.c reads
 * them back. */
#include "match.h"
#include "games.h"
#include "record/lines.h"
#include "rules.h"
#include "seats.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Refusals */

carom_status carom_match_refuse(carom_match *match, carom_refusal why, const char *act,
                                const char *right) {
  match->refusal = (int32_t)why;
  snprintf(match->fault, sizeof match->fault, "%.40s: %.200s", act, right);
  return CAROM_ERROR_ACT;
}

/* A set of balls as text, such as "1, 2, 9". */
static const char *list_balls(uint32_t set, char text[128]) {
  size_t size = 0;
  const char *comma = "";
  text[0] = '\0';
  for (int k = 0; k < CAROM_BALLS_MOST && size + 5 < 128; k++)
    if (set >> k & 1) {
      size += (size_t)snprintf(text + size, 128 - size, "%s%d", comma, k);
      comma = ", ";
    }
  return text;
}

/* The choices as text. */
static const char *list_choices(int32_t choices, char text[128]) {
  size_t size = 0;
  const char *comma = "";
  snprintf(text, 128, "none");
  for (int32_t choice = 1; choice <= CAROM_CHOICE_SPOT; choice *= 2)
    if ((choices & choice) != 0) {
      const char *word = carom_word(CAROM_WORDS_CHOICE, choice);
      size += (size_t)snprintf(text + size, 128 - size, "%s%s", comma, word);
      comma = ", ";
    }
  return text;
}

/* Whether a match continues, and this seat may act. */
static carom_status check_seat(carom_match *match, int seat, const char *act) {
  if (match->phase == CAROM_MATCH_NONE)
    return carom_match_refuse(match, CAROM_REFUSED_NOT_BEGUN, act, "the match has not begun");
  if (match->phase == CAROM_MATCH_OVER)
    return carom_match_refuse(match, CAROM_REFUSED_OVER, act, "the match is over");
  if (seat == match->seat)
    return CAROM_OK;
  char right[64];
  snprintf(right, sizeof right, "seat %d is at the table", (int)match->seat);
  return carom_match_refuse(match, CAROM_REFUSED_TURN, act, right);
}

/* The same, and no ball may move. */
static carom_status check_turn(carom_match *match, int seat, const char *act) {
  const carom_status status = check_seat(match, seat, act);
  if (status != CAROM_OK || match->phase != CAROM_MATCH_MOVING)
    return status;
  return carom_match_refuse(match, CAROM_REFUSED_MOVING, act,
                            "balls move: continue the shot first");
}

/* ---- Lines */

static void begin_act(carom_match *match) {
  match->refusal = CAROM_REFUSED_NOT;
  match->fault[0] = '\0';
  match->size = match->known = match->due = 0;
}

static void put_line(carom_match *match, carom_record_kind kind) {
  const size_t size = (size_t)match->size;
  match->size += (int64_t)carom_record_write(&match->record, kind, match->text + size,
                                             sizeof match->text - size);
}

static void put_act(carom_match *match, carom_act act, int seat, int32_t choice, carom_call call) {
  carom_record *record = &match->record;
  record->act = (int64_t)act;
  record->actor = seat;
  record->choice = choice;
  record->call[0] = call.ball;
  record->call[1] = call.pocket;
  put_line(match, CAROM_RECORD_ACT);
}

/* When the next shot stops: of the options only those that divide a shot without changing it. A
 * shot that reaches events_most ends in an error, which would be ruled as if no ball had moved. */
static void set_stops(carom_shot_options *options, const carom_shot_options *stop) {
  static const carom_shot_options none = {0};
  if (stop == NULL)
    stop = &none;
  options->time_most = stop->time_most;
  options->stop_at = stop->stop_at;
  options->first_of = stop->first_of;
  options->events_most = 0;
}

/* ---- How a match stands */

static uint32_t in_play(const carom_record *record) {
  return carom_on_table(record->balls, (int)record->count);
}

int carom_match_cue_ball(const carom_match *match) {
  const uint32_t balls = in_play(&match->record);
  int ball = carom_cue_ball_of(&match->rules);

  /* the cue ball of an opening is in hand, as if it had fallen */
  const bool any = match->rules.any_cue_ball != 0 && match->rules.state.opening == 0;
  while (any && balls >> ball > 1 && !(balls >> ball & 1))
    ball++;
  return ball;
}

/* Whether the next stroke may be one of this ball. */
static bool may_strike(const carom_match *match, int64_t ball) {
  const bool any = match->rules.any_cue_ball != 0 && match->rules.state.opening == 0;
  if (!any || ball < 0 || ball >= match->record.count)
    return ball == match->cue_ball;
  return in_play(&match->record) >> ball & 1;
}

void carom_match_look(carom_match *match) {
  carom_record *record = &match->record;
  match->cue_ball = carom_match_cue_ball(match);
  match->call = (carom_call){-1, -1};
  match->may = match->rules.state.may;
  match->winner = (int32_t)record->winner;
  const carom_seat *seat = &match->seating.seat[match->seat];
  match->cue = seat->cue;
  match->cue.ball = match->cue_ball;
  const carom_cue usual = carom_cue_of(CAROM_GAME_POOL);
  match->cue.speed = usual.speed;
  match->cue.phi = usual.phi;
  match->cue.b = usual.b;
  memset(&match->player, 0, sizeof match->player);
  if (seat->rating != 0.0)
    match->player = carom_player_rated(seat->rating, (carom_rules_kind)match->record.rules);
  match->on =
      match->rules.on(&match->rules.state, in_play(record)) & ~(UINT32_C(1) << match->cue_ball);
  match->touching = 0;
  match->phase = CAROM_MATCH_PLACE;
  if (record->hand == 0) {
    match->touching = carom_touching(record->balls, (int)record->count, match->cue_ball);
    match->phase = CAROM_MATCH_STROKE;
  }
  if (record->winner != 0) {
    match->phase = CAROM_MATCH_OVER;
    match->may = 0;
  }
}

/* Takes the cue ball in hand. */
static void give_hand(carom_match *match, int32_t leave) {
  carom_record *record = &match->record;
  const int cue_ball = carom_match_cue_ball(match);
  match->leave = leave;
  if (leave < CAROM_LEAVE_ANYWHERE || record->winner != 0)
    return;
  carom_record_hand(record, cue_ball);
  record->bounds = leave;
  carom_hand_bounds((carom_leave)leave, &record->table, record->balls[cue_ball].kind.radius,
                    &match->bounds);
  put_line(match, CAROM_RECORD_PLACE);
}

/* ---- Beginning */

/* Rejects the beginning, with the match all zero except for the fault. */
static carom_status refuse_beginning(carom_match *match, const char *right) {
  memset(match, 0, sizeof *match);
  return carom_match_refuse(match, CAROM_REFUSED_BEGIN, "begin", right);
}

/* What each seat has at the beginning, in a game that each plays for itself. */
static carom_status begin_state(carom_match *match, const carom_match_setup *setup,
                                carom_rules_state *state) {
  int seats = carom_usual_seats(setup->rules);
  if (setup->seating != NULL)
    seats = (int)setup->seating->count;
  const bool of_seats = carom_plan_rules_of(setup->rules).race == CAROM_RACE_SEATS;
  if (!of_seats || carom_begin_seats(setup->rules, seats, state) == CAROM_OK)
    return CAROM_OK;
  return refuse_beginning(match, "this game cannot have so many seats");
}

/* The rules, which may be the caller's, and their state. */
static carom_status begin_rules(carom_match *match, const carom_match_setup *setup) {
  match->rules = carom_plan_rules_of(setup->rules);
  if (setup->of != NULL)
    match->rules = *setup->of;
  if (match->rules.on == NULL || match->rules.judge == NULL)
    return CAROM_ERROR_NULL;
  if (setup->of == NULL && begin_state(match, setup, &match->rules.state) != CAROM_OK)
    return CAROM_ERROR_ACT;
  const char *range = "", *wrong = carom_rules_fault(setup->rules, &match->rules.state, &range);
  if (wrong == NULL)
    return CAROM_OK;
  char right[128];
  snprintf(right, sizeof right, "%s must be %s", wrong, range);
  return refuse_beginning(match, right);
}

/* Those who sit there: the caller's, which the record then has too, or the usual two. */
static carom_status begin_seats(carom_match *match, const carom_match_setup *setup) {
  carom_seating_make(setup->rules, 0, &match->seating);
  if (setup->seating != NULL)
    match->seating = match->record.seating = *setup->seating;
  const char *key = "", *fault = carom_seating_fault(&match->seating, &key);
  if (fault != NULL) {
    char right[160];
    snprintf(right, sizeof right, "seats: %s %s", key, fault);
    return refuse_beginning(match, right);
  }
  fault = carom_seats_fault(&match->rules, setup->rules, &match->seating);
  if (fault != NULL)
    return refuse_beginning(match, fault);
  if (setup->side < 0 || setup->side >= carom_sides_of(&match->seating))
    return refuse_beginning(match, "the side must be 0 or 1 in games of two");
  match->record.side = setup->side;
  return CAROM_OK;
}

/* The set, of which this is a match. */
static carom_status begin_set(carom_match *match, const carom_match_setup *setup) {
  carom_set *set = &match->record.set;
  if (setup->set == NULL)
    return CAROM_OK;
  *set = *setup->set;
  if (set->number == 0) { /* the first match of it */
    set->number = 1;
    set->first = setup->side;
    set->seed = (int64_t)setup->seed;
    set->target = setup->target;
    set->equal_innings = setup->equal_innings;
  }
  const char *key = "", *fault = carom_set_fault(set, &key);
  if (fault == NULL && setup->balls == NULL)
    return CAROM_OK;
  if (fault == NULL)
    return refuse_beginning(match, "the matches of a set begin with a rack");
  char right[160];
  snprintf(right, sizeof right, "set.%s %s", key, fault);
  return refuse_beginning(match, right);
}

/* Whether the rules can have this layout. */
static carom_status begin_layout(carom_match *match, const carom_match_setup *setup,
                                 const carom_shot_ball *balls, int count) {
  carom_record *record = &match->record;
  if (count < 2 || count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  record->match = 1;
  record->actor = -1;
  record->table = *setup->table;
  if (setup->options != NULL)
    record->options = *setup->options;
  record->count = count;
  memcpy(record->balls, balls, (size_t)count * sizeof *balls);

  /* a shot can be played from it, but for a cue ball in hand */
  carom_shot_ball lies[CAROM_BALLS_MOST];
  memcpy(lies, balls, (size_t)count * sizeof *balls);
  if (setup->leave >= CAROM_LEAVE_ANYWHERE)
    lies[carom_match_cue_ball(match)].state.label = CAROM_BALL_POCKETED;
  const carom_status error =
      carom_shot_check(setup->table, lies, count, NULL, setup->options, NULL);
  if (error != CAROM_OK)
    return error;

  /* the balls without which the game is none are there, and one is on */
  const uint32_t own_ball = UINT32_C(1) << carom_match_cue_ball(match);
  const uint32_t there = in_play(record) | own_ball;
  uint32_t needed = 0;
  if (setup->of == NULL || carom_rules_about_of(setup->rules) != NULL)
    needed = carom_needed_balls(setup->rules);
  char right[256], text[128];
  if ((needed & ~there) != 0) {
    snprintf(right, sizeof right,
             "the game needs ball %s on the table; the drill of potting plays any layout",
             list_balls(needed & ~there, text));
    return refuse_beginning(match, right);
  }
  for (int k = 0; k < CAROM_SEATS_MOST && setup->rules == CAROM_RULES_CUTTHROAT; k++)
    if (match->rules.state.user[k] != 0 && (match->rules.state.user[k] & there) == 0)
      return refuse_beginning(match, "each seat of cut-throat needs a ball on the table");
  if ((match->rules.on(&match->rules.state, there) & ~own_ball) == 0)
    return refuse_beginning(match, "no ball of the layout is on");
  return CAROM_OK;
}

/* Everything but the balls; then the first lines. */
static carom_status begin_with(carom_match *match, const carom_match_setup *setup,
                               const carom_shot_ball *balls, int count) {
  carom_record *record = &match->record;
  const bool known = setup->of != NULL || carom_rules_about_of(setup->rules) != NULL;
  if (!known || (uint32_t)setup->leave > CAROM_LEAVE_BAULK)
    return refuse_beginning(match, "the rules must be a carom_rules_kind, leave a carom_leave");
  carom_status status = begin_rules(match, setup);
  if (status == CAROM_OK)
    status = begin_seats(match, setup);
  if (status == CAROM_OK)
    status = begin_set(match, setup);
  if (status == CAROM_OK)
    carom_seats_begin(&match->seating, setup->rules, setup->side, &match->rules);
  if (status == CAROM_OK)
    status = begin_layout(match, setup, balls, count);
  if (status != CAROM_OK)
    return status;
  record->rules = (int64_t)setup->rules;
  record->standing = match->rules.state;
  carom_take_seat(match);
  put_line(match, CAROM_RECORD_HEAD);
  put_line(match, CAROM_RECORD_TABLE);
  put_line(match, CAROM_RECORD_OPTIONS);
  if (record->seating.count > 0)
    put_line(match, CAROM_RECORD_SEATS);
  if (record->set.race > 0)
    put_line(match, CAROM_RECORD_SET);
  put_line(match, CAROM_RECORD_BALLS);
  give_hand(match, (int32_t)setup->leave);
  put_line(match, CAROM_RECORD_GAME);
  carom_match_look(match);
  return CAROM_OK;
}

/* The rack of the game and the state before its break. */
static carom_status begin_rack(carom_match *match, const carom_match_setup *setup) {
  const carom_rules_about *about = carom_rules_about_of(setup->rules);
  if (about == NULL || (setup->equal_innings >> 1) != 0)
    return refuse_beginning(match, "the rules must be a carom_rules_kind, equal_innings 0 or 1");
  const bool is_carom = about->balls == CAROM_GAME_BILLIARD || about->balls == CAROM_GAME_FOURBALL;
  if (is_carom != (setup->table->pockets == 0)) {
    const char *right = "the table must have pockets for this game";
    if (is_carom)
      right = "the table must have no pockets for this game";
    return refuse_beginning(match, right);
  }
  carom_shot_ball balls[CAROM_BALLS_MOST];
  const carom_rack_kind rack = (carom_rack_kind)about->rack;
  const carom_status error =
      carom_rack(rack, setup->table, 1e-4, setup->seed, balls, CAROM_BALLS_MOST);
  if (error != CAROM_OK)
    return error;
  carom_plan_rules rules = carom_plan_rules_of(setup->rules);
  rules.state.opening = carom_has_opening(setup->rules);
  rules.state.innings = setup->equal_innings;
  if (setup->target != 0)
    rules.state.target = setup->target;
  if (begin_state(match, setup, &rules.state) != CAROM_OK)
    return CAROM_ERROR_ACT;
  if (setup->table->pockets == 0)
    rules.state.group = 1 + (int32_t)setup->side;
  if (carom_cue_ball_of(&rules) == 1) { /* the player who opens plays from the white spot */
    const carom_ball_state white = balls[0].state;
    balls[0].state = balls[1].state;
    balls[1].state = white;
  }
  carom_match_setup racked = *setup;
  racked.of = &rules;
  racked.leave = (carom_leave)about->opening;
  return begin_with(match, &racked, balls, carom_rack_size(rack));
}

carom_status carom_match_begin_with(carom_match *match, const carom_match_setup *setup) {
  if (match == NULL || setup == NULL || setup->table == NULL)
    return CAROM_ERROR_NULL;
  memset(match, 0, sizeof *match);
  carom_status status;
  if (setup->balls == NULL)
    status = begin_rack(match, setup);
  else
    status = begin_with(match, setup, setup->balls, (int)setup->count);
  if (status != CAROM_OK && status != CAROM_ERROR_ACT)
    memset(match, 0, sizeof *match);
  return status;
}

carom_status carom_match_begin(carom_match *match, carom_rules_kind kind, const carom_table *table,
                               uint64_t seed, int side) {
  return carom_match_begin_with(
      match, &(carom_match_setup){.rules = kind, .table = table, .seed = seed, .side = side});
}

/* ---- Sets */

/* The side that breaks the next match. */
static int64_t next_side(const carom_match *match) {
  const carom_set *set = &match->record.set;
  const int64_t sides = carom_sides_of(&match->seating);
  if (set->order == CAROM_BREAKS_ALTERNATE || match->winner == CAROM_DRAWN)
    return (set->first + set->number) % sides;
  if (set->order == CAROM_BREAKS_WINNER)
    return match->winner - 1;
  return match->winner % sides;
}

carom_status carom_match_next(carom_match *match) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  const bool is_ended = match->record.kind == CAROM_RECORD_END;
  carom_standing standing;
  begin_act(match);
  carom_match_standing(match, &standing);
  if (match->phase != CAROM_MATCH_OVER || match->winner == 0)
    return carom_match_refuse(match, CAROM_REFUSED_NOT_BEGUN, "next", "no match has been won");
  if (match->record.set.race == 0 || standing.set_winner != 0)
    return carom_match_refuse(match, CAROM_REFUSED_OVER, "next",
                              "the match belongs to no set, or the set has been won");

  /* everything that stays, and what the next match has */
  if (!is_ended)
    put_line(match, CAROM_RECORD_END);
  int32_t timeouts[CAROM_SEATS_MOST];
  int64_t weighed[CAROM_SEATS_MOST];
  double likely[CAROM_SEATS_MOST][CAROM_MATCH_ERRORS];
  char end[128];
  const size_t end_size = (size_t)carom_min(match->size, (int64_t)sizeof end);
  memcpy(end, match->text, end_size);
  memcpy(timeouts, match->timeouts, sizeof timeouts);
  memcpy(weighed, match->weighed, sizeof weighed);
  memcpy(likely, match->log_likelihood, sizeof likely);
  set_stops(&match->record.options, NULL);
  const carom_table table = match->record.table;
  const carom_shot_options options = match->record.options;
  const carom_seating seating = match->record.seating;
  carom_set set = match->record.set;
  carom_match_setup setup = {.rules = (carom_rules_kind)match->record.rules,
                             .table = &table,
                             .options = &options,
                             .target = (int32_t)set.target,
                             .equal_innings = (int32_t)set.equal_innings,
                             .side = next_side(match),
                             .seed = (uint64_t)(set.seed + set.number),
                             .set = &set};
  if (seating.count > 0)
    setup.seating = &seating;
  set.number++;
  memcpy(set.won, standing.won, sizeof set.won);
  const carom_status status = carom_match_begin_with(match, &setup);
  if (status != CAROM_OK)
    return status;
  memcpy(match->timeouts, timeouts, sizeof timeouts);
  memcpy(match->weighed, weighed, sizeof weighed);
  memcpy(match->log_likelihood, likely, sizeof likely);
  memmove(match->text + end_size, match->text, (size_t)match->size);
  memcpy(match->text, end, end_size);
  match->size += (int64_t)end_size;
  return CAROM_OK;
}

/* ---- Rulings */

/* A cue ball that was in hand and was not placed, as when the clock ran out, stays in hand within
 * the same bounds, and no player may leave it where it is. */
static void keep_in_hand(carom_match *match) {
  carom_ruling *ruling = &match->ruling;
  const int64_t label = match->record.balls[carom_match_cue_ball(match)].state.label;
  const bool down = label == CAROM_BALL_POCKETED || label == CAROM_BALL_OFF;
  if (!down)
    return;
  ruling->state.may &= ~CAROM_CHOICE_STAY;
  match->rules.state.may = match->record.standing.may = ruling->state.may;
  if (ruling->turn.leave >= CAROM_LEAVE_ANYWHERE || match->record.winner != 0)
    return;
  ruling->turn.leave = CAROM_LEAVE_ANYWHERE;
  if (match->leave >= CAROM_LEAVE_ANYWHERE)
    ruling->turn.leave = (carom_leave)match->leave;
  ruling->hand = 1;
}

/* Adopts the ruling: the layout, the next player and the score. `struck`: of a stroke, or of one
 * for which the time was over. */
static void apply(carom_match *match, bool struck) {
  carom_record *record = &match->record;
  carom_ruling *ruling = &match->ruling;

  /* where any ball may be struck, one that was in hand and was not placed returns */
  if (record->hand != 0 && match->rules.any_cue_ball != 0)
    carom_spot_ball_of((carom_rack_kind)match->rules.rack, &record->table, ruling->balls,
                       (int)record->count, match->cue_ball);

  /* balls that lie elsewhere than the record has them */
  carom_record_settle(record);
  bool moved = false;
  for (int k = 0; k < record->count; k++) {
    const carom_ball_state *lies = &ruling->balls[k].state;
    moved |= memcmp(&record->balls[k].state, lies, sizeof *lies) != 0;
    record->balls[k].state = *lies;
  }
  if (moved)
    put_line(match, CAROM_RECORD_BALLS);

  /* who plays, and who has won */
  const int64_t side = record->side;
  match->rulings++;
  match->rules.state = record->standing = ruling->state;
  record->foul = ruling->turn.foul;
  carom_end_visit(match, struck, ruling->turn.outcome == CAROM_TURN_PASS);
  switch (ruling->turn.outcome) {
  case CAROM_TURN_KEEP:
    break;
  case CAROM_TURN_PASS:
    record->side = 1 - side; /* for seats that play each for itself, the state has it */
    break;
  case CAROM_TURN_WIN:
    record->winner = 1 + side;
    break;
  case CAROM_TURN_LOSE:
    record->winner = 1 + (1 - side);
    if (match->rules.race == CAROM_RACE_SEATS)
      record->winner = 1 + (int64_t)ruling->state.seat;
    break;
  case CAROM_TURN_DRAW:
    record->winner = CAROM_DRAWN;
    break;
  }
  carom_take_seat(match);
  record->hand = 0;
  keep_in_hand(match);
  give_hand(match, (int32_t)ruling->turn.leave);
  put_line(match, CAROM_RECORD_GAME);
  carom_match_look(match);
}

/* Rules the shot that the record has just played, or that none was played: `none`, as after an
 * error, a choice, or a clock that ran out. */
static void rule(carom_match *match, bool none, carom_call call) {
  carom_record *record = &match->record;
  carom_facts facts = record->facts;
  facts.barred = carom_barred_from(&match->rules, (carom_leave)match->leave, &facts, &record->table,
                                   record->balls, (int)record->count);
  const carom_shot shot = {.facts = &facts, .final = record->final}, *played = &shot;
  if (none)
    played = NULL;
  carom_referee(&match->rules, &record->table, record->balls, (int)record->count, match->cue_ball,
                played, call, &match->ruling);
}

/* ---- Strokes */

/* Plays a shot of this cue, or a section of one, and judges it if it has ended. */
static carom_status play(carom_match *match, carom_record_kind kind, const carom_cue *cue,
                         const carom_shot_options *stop, carom_shot *shot, const char *act) {
  carom_record *record = &match->record;
  const carom_facts facts = record->facts;
  const carom_shot_options options = record->options;
  const carom_cue last = record->cue;
  const int64_t pending = record->pending;
  record->cue = *cue;
  set_stops(&record->options, stop);
  record->pending = CAROM_PENDING_NONE;
  const carom_status status = carom_record_play(record, kind, shot);
  if (record->pending != CAROM_PENDING_LINE) {
    record->facts = facts;
    record->options = options;
    record->cue = last;
    record->pending = pending;
    return carom_match_refuse(match, CAROM_REFUSED_STROKE, act, carom_status_string(status));
  }
  if (kind == CAROM_RECORD_SHOT) {
    memcpy(match->before, record->balls, sizeof match->before);
    match->stroke = *cue;
    record->actor = match->seat;
  }
  match->cue_ball = (int32_t)cue->ball;
  put_line(match, kind);
  match->phase = CAROM_MATCH_MOVING;
  if (status > 0)
    return status;
  rule(match, status < 0, match->call);
  carom_match_weigh(match);
  apply(match, true);
  return CAROM_OK;
}

carom_status carom_match_stroke(carom_match *match, int seat, const carom_cue *cue,
                                const carom_shot_options *stop, carom_shot *shot) {
  if (match == NULL || cue == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  const carom_status error = check_turn(match, seat, "stroke");
  if (error != CAROM_OK)
    return error;
  if (match->phase == CAROM_MATCH_PLACE)
    return carom_match_refuse(match, CAROM_REFUSED_IN_HAND, "stroke",
                              "the cue ball is in hand: place it within match.bounds first");
  if (!may_strike(match, cue->ball))
    return carom_match_refuse(match, CAROM_REFUSED_CUE_BALL, "stroke",
                              "cue.ball must be match.cue_ball, or a ball in play where any may be "
                              "struck");
  if (!(cue->speed > 0.0))
    return carom_match_refuse(match, CAROM_REFUSED_STROKE, "stroke",
                              "cue.speed must be above 0 m/s");
  char right[128];
  if (carom_is_beyond(match, cue, right, sizeof right))
    return carom_match_refuse(match, CAROM_REFUSED_LIMIT, "stroke", right);
  return play(match, CAROM_RECORD_SHOT, cue, stop, shot, "stroke");
}

carom_status carom_match_continue(carom_match *match, const carom_shot_options *stop,
                                  carom_shot *shot) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  if (match->phase != CAROM_MATCH_MOVING)
    return carom_match_refuse(match, CAROM_REFUSED_AT_REST, "continue",
                              "no ball moves: play a stroke");
  const carom_cue cue = match->record.cue;
  return play(match, CAROM_RECORD_CONTINUE, &cue, stop, shot, "continue");
}

carom_status carom_match_replay(carom_match *match, carom_shot *shot) {
  if (match == NULL || shot == NULL)
    return CAROM_ERROR_NULL;
  carom_record *record = &match->record;
  if (!(match->stroke.mass > 0.0))
    return CAROM_ERROR_STATE;
  carom_shot_options options = record->options;
  set_stops(&options, NULL);
  options.fast = 0;
  options.threads = 0;
  if (match->phase == CAROM_MATCH_MOVING) {
    options.time_most = record->played.time;
    options.events_most = (int32_t)record->played.events;
    shot->state = &record->state; /* which knows the events of the caller */
  }
  return carom_shoot(&record->table, match->before, (int)record->count, &match->stroke, &options,
                     shot);
}

/* ---- Placing, calls and choices */

static carom_status place_cue_ball(carom_match *match, int seat, double x, double y) {
  const carom_status error = check_turn(match, seat, "place");
  if (error != CAROM_OK)
    return error;
  if (match->leave < CAROM_LEAVE_ANYWHERE)
    return carom_match_refuse(match, CAROM_REFUSED_NO_HAND, "place", "the cue ball is not in hand");
  if (!carom_is_within(&match->bounds, x, y)) {
    const carom_bounds *b = &match->bounds;
    char right[160];
    const char *in_d = "";
    if (b->radius > 0.0)
      in_d = " and in the D";
    snprintf(right, sizeof right, "the cue ball must be within %g <= x <= %g, %g <= y <= %g m%s",
             b->low[0], b->high[0], b->low[1], b->high[1], in_d);
    return carom_match_refuse(match, CAROM_REFUSED_BOUNDS, "place", right);
  }

  /* the ball is taken from where it was put before */
  carom_record *record = &match->record;
  carom_part obstacle;
  const carom_status status = carom_record_place(record, match->cue_ball, x, y, &obstacle);
  if (status != CAROM_OK) {
    char right[128];
    const char *part = "part";
    if (obstacle.kind == CAROM_PART_BALL)
      part = "ball";
    snprintf(right, sizeof right, "%s: %s %d", carom_status_string(status), part, obstacle.index);
    return carom_match_refuse(match, CAROM_REFUSED_OCCUPIED, "place", right);
  }
  put_line(match, CAROM_RECORD_PLACE);
  record->actor = seat;
  match->phase = CAROM_MATCH_STROKE;
  match->may &= ~CAROM_CHOICE_STAY; /* it has moved */
  match->touching = carom_touching(record->balls, (int)record->count, match->cue_ball);
  return CAROM_OK;
}

carom_status carom_match_place(carom_match *match, int seat, double x, double y) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  return place_cue_ball(match, seat, x, y);
}

static carom_status call_pocket(carom_match *match, int seat, carom_call call) {
  const carom_status error = check_turn(match, seat, "call");
  if (error != CAROM_OK)
    return error;
  const bool calls = match->rules.calls != 0;
  if (!calls && (match->may & CAROM_CHOICE_SPOT) == 0) /* a call names the ball that is spotted */
    return carom_match_refuse(match, CAROM_REFUSED_CALL, "call", "nothing is called in this game");
  uint32_t may_call = in_play(&match->record) & ~(UINT32_C(1) << match->cue_ball);
  if (match->rules.calls == 1)
    may_call = match->on;
  const bool is_ball = call.ball >= 0 && call.ball < CAROM_BALLS_MOST;
  if (call.ball != -1 && !(is_ball && may_call >> call.ball & 1)) {
    char text[128], right[200];
    snprintf(right, sizeof right, "ball %d may not be called; these may: %s, and -1 is a safety",
             (int)call.ball, list_balls(may_call, text));
    return carom_match_refuse(match, CAROM_REFUSED_CALL, "call", right);
  }
  const bool names_pocket = calls && call.ball >= 0 && match->rules.rack != CAROM_RACK_SNOOKER;
  if (!names_pocket)
    call.pocket = -1;
  if (names_pocket && (call.pocket < 0 || call.pocket >= match->record.table.pockets)) {
    char right[128];
    snprintf(right, sizeof right, "the pocket must be 0 to %d",
             (int)match->record.table.pockets - 1);
    return carom_match_refuse(match, CAROM_REFUSED_CALL, "call", right);
  }
  match->call = call;
  put_act(match, CAROM_ACT_CALL, seat, 0, call);
  return CAROM_OK;
}

carom_status carom_match_call(carom_match *match, int seat, carom_call call) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  return call_pocket(match, seat, call);
}

/* The call of a choice: of a push-out, or of one that is taken instead of a stroke; 0 of another
 * one. */
static int32_t call_of(carom_choice choice) {
  switch (choice) {
  case CAROM_CHOICE_PUSH:
    return CAROM_CALL_PUSH;
  case CAROM_CHOICE_PASS:
    return CAROM_CALL_PASS;
  case CAROM_CHOICE_RACK:
    return CAROM_CALL_RACK;
  case CAROM_CHOICE_OTHER_RACK:
    return CAROM_CALL_OTHER_RACK;
  case CAROM_CHOICE_STAY:
    return CAROM_CALL_STAY;
  case CAROM_CHOICE_SPOT:
    return CAROM_CALL_SPOT;
  default:
    return 0;
  }
}

static carom_status take_choice(carom_match *match, int seat, carom_choice choice) {
  const carom_status error = check_turn(match, seat, "choose");
  if (error != CAROM_OK)
    return error;
  const int32_t bits = (int32_t)choice;
  const bool is_one = bits > 0 && (bits & (bits - 1)) == 0 && (match->may & bits) != 0;
  if (!is_one || call_of(choice) == 0) {
    char text[128], right[200];
    const char *named = "";
    if ((match->may & CAROM_CHOICE_FREE_BALL) != 0)
      named = "; a free ball is named by a call";
    const int32_t others = match->may & ~(CAROM_CHOICE_FREE_BALL | CAROM_CHOICE_PLACE);
    snprintf(right, sizeof right, "the choices are: %s%s", list_choices(others, text), named);
    return carom_match_refuse(match, CAROM_REFUSED_CHOICE, "choose", right);
  }
  const carom_call none = {-1, -1};
  carom_call call = {call_of(choice), -1};
  if (choice == CAROM_CHOICE_SPOT)
    call.pocket = match->call.ball;
  put_act(match, CAROM_ACT_CHOOSE, seat, (int32_t)choice, none);
  if (choice == CAROM_CHOICE_PUSH) {
    match->call = call;
    return CAROM_OK;
  }
  rule(match, true, call);
  if (choice == CAROM_CHOICE_STAY)
    match->ruling.balls[match->cue_ball].state.label = CAROM_BALL_STATIONARY;
  apply(match, false);
  return CAROM_OK;
}

carom_status carom_match_choose(carom_match *match, int seat, carom_choice choice) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  return take_choice(match, seat, choice);
}

/* The acts before the stroke, up to one that is rejected. */
static carom_status prepare(carom_match *match, int seat, const carom_plan_stroke *stroke) {
  if (stroke->kind == CAROM_PLAN_PASS)
    return take_choice(match, seat, CAROM_CHOICE_PASS);
  carom_status status = check_turn(match, seat, "prepare");
  if (status == CAROM_OK && match->phase == CAROM_MATCH_PLACE)
    status = place_cue_ball(match, seat, stroke->place[0], stroke->place[1]);
  if (status == CAROM_OK && stroke->kind == CAROM_PLAN_PUSH)
    status = take_choice(match, seat, CAROM_CHOICE_PUSH);
  const bool calls = match->rules.calls != 0 && stroke->ball >= 0 && stroke->pocket >= 0;
  if (status != CAROM_OK || !calls)
    return status;
  return call_pocket(match, seat, (carom_call){stroke->ball, stroke->pocket});
}

carom_status carom_match_prepare(carom_match *match, int seat, const carom_plan_stroke *stroke) {
  if (match == NULL || stroke == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  return prepare(match, seat, stroke);
}

/* ---- Concessions, clocks, the end */

/* A seat leaves a game that each plays for itself: the next one plays, or the last one has won. */
static void leave_game(carom_match *match, int seat) {
  carom_rules_state *state = &match->rules.state;
  const int count = (int)match->seating.count;
  int remain = 0;
  state->user[seat] = 0;
  for (int k = 0; k < count; k++)
    remain += state->user[k] != 0;
  while (remain > 0 && state->user[state->seat] == 0)
    state->seat = (state->seat + 1) % count;
  if (remain == 1)
    match->record.winner = 1 + state->seat;
}

carom_status carom_match_concede(carom_match *match, int seat) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  if (match->phase == CAROM_MATCH_NONE || match->phase == CAROM_MATCH_OVER)
    return check_seat(match, seat, "concede");
  const bool is_own = match->rules.race == CAROM_RACE_SEATS;
  uint64_t *left = match->rules.state.user;
  if (seat < 0 || seat >= match->seating.count || (is_own && left[seat] == 0))
    return carom_match_refuse(match, CAROM_REFUSED_TURN, "concede",
                              "the seat must be one that plays");
  if (is_own && match->phase == CAROM_MATCH_MOVING)
    return check_turn(match, (int)match->seat, "concede");
  put_act(match, CAROM_ACT_CONCEDE, seat, 0, (carom_call){-1, -1});
  carom_record *record = &match->record;
  if (is_own)
    leave_game(match, seat);
  else
    record->winner = 2 - match->seating.seat[seat].side;
  if (record->winner != 0)
    record->hand = 0;
  record->standing = match->rules.state;
  carom_take_seat(match);
  put_line(match, CAROM_RECORD_GAME);
  carom_match_look(match);
  return CAROM_OK;
}

/* What is counted of the time of a stroke. */
static carom_status take_time(carom_match *match, int seat, carom_act act) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  const bool extends = act == CAROM_ACT_EXTEND;
  const char *name = carom_word(CAROM_WORDS_ACT, (int)act);
  begin_act(match);
  const carom_status error = check_turn(match, seat, name);
  if (error != CAROM_OK)
    return error;
  const carom_set *set = &match->record.set;
  const int64_t side = match->record.side;
  int32_t *taken = &match->timeouts[side];
  int64_t most = set->timeouts;
  if (extends) {
    taken = &match->extensions[side];
    most = set->extensions;
  }
  if (*taken >= most)
    return carom_match_refuse(match, CAROM_REFUSED_TIME, name, "none is left");
  ++*taken;
  put_act(match, act, seat, 0, (carom_call){-1, -1});
  return CAROM_OK;
}

carom_status carom_match_extend(carom_match *match, int seat) {
  return take_time(match, seat, CAROM_ACT_EXTEND);
}

carom_status carom_match_timeout(carom_match *match, int seat) {
  return take_time(match, seat, CAROM_ACT_TIMEOUT);
}

carom_status carom_match_clock(carom_match *match, int seat) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  const carom_status error = check_turn(match, seat, "clock");
  if (error != CAROM_OK)
    return error;
  put_act(match, CAROM_ACT_CLOCK, seat, 0, (carom_call){-1, -1});
  rule(match, true, (carom_call){-1, -1});
  apply(match, true);
  return CAROM_OK;
}

/* ---- Notes */

static void reverse(char *text, size_t size) {
  for (size_t k = 0; k < size / 2; k++) {
    const char first = text[k];
    text[k] = text[size - 1 - k];
    text[size - 1 - k] = first;
  }
}

/* The lines of the last act become known ones: those behind the note that was written last. */
static void keep_act_known(carom_match *match) {
  static const char begins_note[] = "{\"note\"";
  const bool is_note =
      match->size > 0 && strncmp(match->text, begins_note, sizeof begins_note - 1) == 0;
  if (is_note)
    memmove(match->text, match->text + match->size, (size_t)match->known);
  else
    match->known += match->size;
  match->size = match->due = 0;
}

/* Writes the line of record.note in front of the lines of the last act, which stay known. */
static void put_note(carom_match *match) {
  size_t known = (size_t)match->known;
  size_t size = carom_record_write(&match->record, CAROM_RECORD_NOTE, match->text + known,
                                   sizeof match->text - known);
  if (size == 0) { /* there is no room for both */
    known = 0;
    size = carom_record_write(&match->record, CAROM_RECORD_NOTE, match->text, sizeof match->text);
  }
  reverse(match->text, known);
  reverse(match->text + known, size);
  reverse(match->text, known + size);
  match->size = (int64_t)size;
  match->known = (int64_t)known;
}

carom_status carom_match_note(carom_match *match, int seat, const carom_note *note) {
  if (match == NULL || note == NULL)
    return CAROM_ERROR_NULL;
  keep_act_known(match);
  match->refusal = CAROM_REFUSED_NOT;
  match->fault[0] = '\0';
  if (match->phase == CAROM_MATCH_NONE)
    return carom_match_refuse(match, CAROM_REFUSED_NOT_BEGUN, "note", "the match has not begun");
  if (match->record.kind == CAROM_RECORD_END)
    return carom_match_refuse(match, CAROM_REFUSED_OVER, "note", "the recording has ended");
  if (match->record.kind == CAROM_RECORD_WRONG)
    return carom_match_refuse(match, CAROM_REFUSED_OVER, "note",
                              "nothing follows a line that was refused");
  char right[160];
  if (seat < -1 || seat >= match->seating.count) {
    snprintf(right, sizeof right, "seat %d is not one of the match; its seats are 0 to %d", seat,
             (int)match->seating.count - 1);
    return carom_match_refuse(match, CAROM_REFUSED_TURN, "note", right);
  }
  carom_note said = *note;
  said.by = 1 + seat;
  const char *key = NULL, *fault = carom_note_fault(&said, &key);
  if (fault != NULL) {
    snprintf(right, sizeof right, "%s%s%s", key == NULL ? "" : key, key == NULL ? "it " : " ",
             fault);
    return carom_match_refuse(match, CAROM_REFUSED_NOTE, "note", right);
  }
  match->record.note = said;
  put_note(match);
  return CAROM_OK;
}

carom_status carom_match_end(carom_match *match) {
  if (match == NULL)
    return CAROM_ERROR_NULL;
  begin_act(match);
  if (match->phase == CAROM_MATCH_NONE || match->record.kind == CAROM_RECORD_END)
    return carom_match_refuse(match, CAROM_REFUSED_NOT_BEGUN, "end", "there is no match to end");
  put_line(match, CAROM_RECORD_END);
  match->phase = CAROM_MATCH_OVER;
  return CAROM_OK;
}

/* ---- Plans */

/* Where any ball may be struck, the job's cue becomes one of the ball that promises most. */
static void choose_ball(carom_match *match, carom_plan_job *job) {
  carom_cue *cue = &match->record.cue;
  double best = -1.0;
  int64_t ball = job->cue->ball;
  *cue = *job->cue;
  job->cue = cue;
  for (int k = 0; k < match->record.count; k++) {
    double value;
    cue->ball = k;
    if (!may_strike(match, k) || carom_plan_value(job, 0, &value) != CAROM_OK || value <= best)
      continue;
    best = value;
    ball = k;
  }
  cue->ball = ball;
}

/* Whether a cue is one that a plan before took from the match. */
static bool is_of_match(const carom_match *match, const carom_cue *cue) {
  return cue == &match->cue || cue == &match->record.cue;
}

carom_status carom_match_plan(carom_match *match, carom_plan_job *job, carom_plan_stroke *choices,
                              int room, int *found) {
  if (match == NULL || job == NULL)
    return CAROM_ERROR_NULL;
  const carom_record *record = &match->record;
  begin_act(match);
  const carom_status error = check_turn(match, (int)match->seat, "plan");
  if (error != CAROM_OK)
    return error;
  if (job->cue == NULL || is_of_match(match, job->cue))
    job->cue = &match->cue;
  if (job->player == NULL || job->player == &match->player) {
    job->player = NULL;
    if (match->player.speed_most > 0.0 || match->player.phi > 0.0)
      job->player = &match->player;
  }
  if (job->opponent == NULL || job->opponent == &match->opponent) {
    const bool is_given = job->options != NULL && job->options->opponent != NULL;
    job->opponent = NULL;
    if (!is_given && carom_match_opponent(match, job->player, &match->opponent) == CAROM_OK)
      job->opponent = &match->opponent;
  }
  if (!may_strike(match, job->cue->ball)) {
    match->record.cue = *job->cue;
    match->record.cue.ball = match->cue_ball;
    job->cue = &match->record.cue;
  }
  set_stops(&match->record.options, NULL);
  job->table = &record->table;
  job->balls = record->balls;
  job->count = record->count;
  job->rules = &match->rules;
  job->shot = &record->options;
  job->leave = match->leave;
  if (match->rules.any_cue_ball != 0 && match->rules.state.opening == 0)
    choose_ball(match, job);
  if (match->phase == CAROM_MATCH_PLACE)
    return carom_plan_hand(job, match->bounds.low, match->bounds.high, choices, room, found);
  return carom_plan(job, choices, room, found);
}
