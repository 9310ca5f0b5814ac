/* The rows of a search: a candidate that is played once, with or without errors, and what that is
 * worth to the player. A row's errors are a function of seed, round and number. Rows are computed
 * by threads and added up in their order, so no bit of a sum depends on threads. */
#include "rows.h"
#include "player.h"
#include "random_draws.h"

#include "drawn_tables.h"
#include "eye.h"
#include "goals.h"
#include "rules.h"
#include "table/marks.h"

#include <math.h>
#include <string.h>

typedef carom_candidate candidate;
typedef carom_outcome outcome;

/* The positions of the balls of a shot, and its result. */
typedef struct shot_result {
  carom_facts facts;
  carom_ball_state final[CAROM_BALLS_MOST]; /* before the shot where its balls are drawn */
} shot_result;

carom_cue carom_search_stroke(const carom_search *search, const candidate *c, uint32_t draws,
                              int64_t row) {
  carom_cue cue = *search->job.cue;
  double z[6] = {0};
  if (draws != 0)
    carom_normals(search->options.seed, draws, (uint64_t)row, z);
  cue.speed = c->speed;
  cue.phi = c->phi;
  cue.theta = c->theta;
  cue.a = c->a;
  cue.b = c->b;
  carom_player_errs(&search->player, z, &cue);
  return cue;
}

carom_prepared carom_search_layout(const carom_search *search, const candidate *c, uint32_t draws,
                                   int64_t row, carom_ball_state drawn[CAROM_BALLS_MOST]) {
  carom_prepared layout = carom_search_drawn(search, draws, row);
  carom_ball_state struck = search->played[search->cue_ball].state;
  struck.r[0] = c->r[0];
  struck.r[1] = c->r[1];
  layout.state[search->cue_ball] = &struck;
  double eye = 0.0;
  if (draws != 0)
    eye = search->player.eye;
  carom_eye_draw(&layout, search->cue_ball, eye, search->options.seed, draws, (uint64_t)row, drawn);
  for (int k = 0; k < layout.count; k++)
    layout.state[k] = &drawn[k];
  return layout;
}

/* A ball of the layout before the stroke of a candidate. */
static carom_ball_state state_at_stroke(const carom_search *search, const candidate *c, int k) {
  carom_ball_state state = search->job.balls[k].state;
  if (k == search->view.cue_ball) {
    state.r[0] = c->r[0];
    state.r[1] = c->r[1];
  }
  return state;
}

/* The pot that a shot made: the first ball that fell into a pocket that counts. Where shots are
 * called, the candidate calls it; where only balls that are on may be called, it is one of them.
 * Without pockets it is the ball that was met first. */
static carom_call call_of(const carom_search *search, const carom_facts *facts) {
  if (search->view.pockets == 0)
    return (carom_call){facts->first[0], -1};
  const int cue_ball = search->view.cue_ball;
  carom_call call = {-1, -1};
  uint32_t down = facts->down & ~(UINT32_C(1) << cue_ball);
  if (search->job.rules->calls == 1)
    down &= search->targets;
  for (int k = 0; down >> k != 0; k++)
    if ((down >> k & 1) && (search->pockets >> facts->pocket[k] & 1) &&
        (call.ball < 0 || facts->pocket_time[k] < facts->pocket_time[call.ball]))
      call = (carom_call){k, facts->pocket[k]};
  if (call.ball < 0 && (facts->down >> cue_ball & 1) != 0) /* off a ball: cowboy's last point */
    call = (carom_call){facts->first[0], facts->pocket[cue_ball]};
  if (call.ball < 0 && carom_has_cannons(search->job.rules) && facts->first[1] >= 0)
    call.ball = facts->first[0];
  return call;
}

/* Of the balls left before the shot; rules that then have more left, or more points than balls,
 * give at most all. Points that a foul costs, as in four-ball, are below 0. */
double carom_search_share(const carom_search *search, double points) {
  return carom_within(points / search->left, -1.0, 1.0);
}

/* The layout of the next stroke, for rules that depend on positions. Apart, as its balls would take
 * 10 KiB of the stack below a shot. */
__attribute__((noinline)) static void settle(const carom_search *search, carom_rules_state *game,
                                             const candidate *c, carom_ball_state *final,
                                             bool taken_back, carom_turn *turn) {
  carom_shot_ball balls[CAROM_BALLS_MOST];
  for (int k = 0; k < search->view.count; k++) {
    balls[k] = search->job.balls[k];
    balls[k].state = final[k];
    if (taken_back)
      balls[k].state = state_at_stroke(search, c, k);
  }
  carom_turn_settle(search->job.rules, game, search->job.table, balls, search->view.count, turn);
  for (int k = 0; k < search->view.count; k++)
    final[k] = balls[k].state;
}

/* Whether the player plays on, wins or draws, or has made the last point before an equalizing
 * inning; or in killer a ball, behind which the next seat plays. */
static bool is_good(const carom_search *search, const carom_facts *facts,
                    const carom_rules_state *state, const carom_turn *turn) {
  const bool seats = search->job.rules->race == CAROM_RACE_SEATS;
  if (turn->outcome == CAROM_TURN_PASS && seats)
    return turn->foul == CAROM_FOUL_NONE && (facts->down & search->targets) != 0;
  if (turn->outcome == CAROM_TURN_PASS)
    return state->innings == CAROM_LAST_INNING;
  return turn->outcome != CAROM_TURN_LOSE;
}

/* The call of a shot: with errors, the candidate's call; without, what the shot makes. */
static carom_call call_for(const carom_search *search, const carom_facts *facts, const candidate *c,
                           bool errors) {
  if (c->kind == CAROM_PLAN_PUSH)
    return (carom_call){CAROM_CALL_PUSH, -1};
  if (errors && search->job.rules->calls)
    return (carom_call){c->ball, c->pocket};
  return call_of(search, facts);
}

/* What an outcome contains of a turn and its call, without the value. */
static outcome outcome_of(const carom_facts *facts, carom_call call, const carom_turn *turn,
                          bool good) {
  outcome o = {.turn = (int8_t)(good ? CAROM_TURN_KEEP : turn->outcome),
               .foul = turn->foul != 0,
               .ball = -1,
               .pocket = -1,
               .first = (int8_t)facts->first[0]};
  if (call.ball == CAROM_CALL_PUSH)
    o.ball = CAROM_CALL_PUSH;
  if (call.ball >= 0 && good) {
    o.ball = (int8_t)call.ball;
    o.pocket = (int8_t)call.pocket;
    o.cushions = (int16_t)facts->cushions[call.ball];
  }
  return o;
}

/* Whether a turn has its own worth, whatever the layout: it ends the game or the visit, or a
 * shot that was stopped at a wrong ball or is in error has left no layout. */
static bool has_worth(const carom_search *search, const carom_turn *turn, carom_status status,
                      double *worth) {
  const bool alone = search->job.rules->race == CAROM_RACE_ALONE;
  const bool passes = turn->outcome == CAROM_TURN_PASS, draws = turn->outcome == CAROM_TURN_DRAW;
  if (turn->outcome == CAROM_TURN_WIN || turn->outcome == CAROM_TURN_LOSE)
    *worth = turn->outcome == CAROM_TURN_WIN;
  else if (draws && !alone)
    *worth = 0.5;
  else if (alone && (passes || draws))
    *worth = carom_search_share(search, turn->points);
  else if (status != CAROM_OK && passes)
    *worth = search->foul_value;
  else
    return false;
  return true;
}

/* The layout of the next stroke, from that which the shot left. */
static void leave_layout(const carom_search *search, carom_rules_state *game, const candidate *c,
                         carom_ball_state *final, bool taken_back, carom_turn *turn) {
  if (search->job.rules->settle != NULL) {
    if (taken_back || turn->spot != 0 || turn->outcome == CAROM_TURN_PASS)
      settle(search, game, c, final, taken_back, turn);
    return;
  }
  const carom_marks marks = carom_marks_of(search->view.width, search->view.length);
  for (int k = 0; k < search->view.count; k++) {
    if (taken_back)
      final[k] = state_at_stroke(search, c, k);
    if (turn->spot >> k & 1)
      final[k] =
          (carom_ball_state){.r = {marks.foot_spot[0], marks.foot_spot[1], search->view.radius[k]},
                             .label = CAROM_BALL_STATIONARY};
  }
}

double carom_search_leave(const carom_search *search, const carom_rules_state *game,
                          const carom_ball_state *layout, const carom_turn *turn) {
  const carom_plan_rules *rules = search->job.rules;
  /* any ball may be struck: about as good as the cue ball in hand */
  const bool in_hand = turn->leave >= CAROM_LEAVE_ANYWHERE || rules->any_cue_ball != 0;
  const bool passes = turn->outcome == CAROM_TURN_PASS;
  double worth = carom_value_of(&search->view, game, layout, passes, in_hand);
  if (passes)
    worth = 1.0 - worth;
  if (passes && turn->foul != 0) {
    /* values of layouts are right to some hundredths, and a legal stroke that is as good is to be
     * chosen */
    const double less = 0.018;
    worth = carom_within(worth - less, 0.0, 1.0);
  }
  if (rules->race == CAROM_RACE_ALONE && !passes)
    worth = carom_search_share(search, turn->points + worth);
  return worth;
}

double carom_search_ruled(const carom_search *search, const carom_ruling *ruling) {
  double worth;
  if (has_worth(search, &ruling->turn, CAROM_OK, &worth))
    return worth;
  carom_ball_state layout[CAROM_BALLS_MOST];
  for (int k = 0; k < search->view.count; k++)
    layout[k] = ruling->balls[k].state;
  return carom_search_leave(search, &ruling->state, layout, &ruling->turn);
}

/* The worth of a shot for the player: its turn, and the value of the layout that it leaves.
 * `final` is changed. */
static outcome judge(const carom_search *search, const carom_facts *facts, carom_ball_state *final,
                     carom_status status, const candidate *c, bool errors) {
  const carom_plan_rules *rules = search->job.rules;
  if (status < 0) /* an error has no result: a foul */
    facts = &carom_no_facts;
  const carom_call call = call_for(search, facts, c, errors);
  carom_rules_state game = rules->state; /* rules change it as they judge */
  carom_turn turn = carom_turn_seen(
      rules, &game, rules->judge(&game, search->in_play, search->view.cue_ball, facts, call));
  outcome o = outcome_of(facts, call, &turn, is_good(search, facts, &game, &turn));
  const bool ends = has_worth(search, &turn, status, &o.worth);
  const bool taken_back = status != CAROM_OK || turn.leave == CAROM_LEAVE_BEFORE;
  if (!ends)
    leave_layout(search, &game, c, final, taken_back, &turn);
  if (c->kind == CAROM_PLAN_PUSH && c->leave[0] > 0.0f && turn.foul == CAROM_FOUL_NONE)
    o.worth = (double)c->leave_worth;
  else if (carom_has_goal(&search->job))
    o.worth = !taken_back && carom_search_reaches(search, &game, final, &turn, &o.near);
  else if (!ends)
    o.worth = carom_search_leave(search, &game, final, &turn);
  return o;
}

/* Whether a stroke of the scan met a ball first that is on. */
bool carom_search_begins_well(const carom_search *search, int first) {
  return first >= 0 && (search->targets >> first & 1);
}

bool carom_search_may_join(const carom_search *search, const outcome *o) {
  const bool passes = o->turn == CAROM_TURN_PASS && !o->foul;
  return carom_search_begins_well(search, o->first) && (passes || !search->only_safeties);
}

/* The balls in play of a layout become the balls of shots. */
void carom_search_lay_out(carom_search *search, const carom_shot_ball *balls) {
  search->plays = 0;
  search->shot.first_of = 0;
  for (int k = 0; k < search->view.count; k++) {
    search->state[k] = balls[k].state;
    if (search->in_play >> k & 1) {
      if (search->first_decides && (search->targets >> k & 1))
        search->shot.first_of |= UINT32_C(1) << search->plays;
      if (k == search->view.cue_ball)
        search->cue_ball = search->plays;
      search->played[search->plays] = balls[k];
      search->layout_ball[search->plays++] = k;
    }
  }
}

/* The ball of the layout that is a ball of a shot; -1 stays. */
static int32_t in_layout(const carom_search *search, int32_t ball) {
  if (ball < 0)
    return ball;
  return search->layout_ball[ball];
}

/* From the balls of a shot to the balls of the layout. */
static void spread(const carom_search *search, shot_result *with) {
  carom_facts *f = &with->facts;
  const carom_facts of_shot = *f;
  uint32_t *const set[] = {&f->down,    &f->off,           &f->moved,     &f->frozen,
                           &f->pushed,  &f->banked,        &f->first_set, &f->past_middle,
                           &f->at_head, &f->beyond_middle, &f->jumped};
  for (int s = 0; s < (int)(sizeof set / sizeof set[0]); s++) {
    uint32_t layout_set = 0;
    for (int n = 0; n < search->plays; n++)
      layout_set |= (*set[s] >> n & 1) << search->layout_ball[n];
    *set[s] = layout_set;
  }
  for (int n = 0; n < 2; n++)
    f->first[n] = in_layout(search, f->first[n]);
  for (int m = 0; m < search->plays; m++)
    f->order[m] = in_layout(search, f->order[m]);
  int n = search->plays - 1;
  for (int k = search->view.count - 1; k >= 0; k--) {
    if (n >= 0 && search->layout_ball[n] == k) {
      with->final[k] = with->final[n];
      f->pocket[k] = of_shot.pocket[n];
      f->pocket_time[k] = of_shot.pocket_time[n];
      f->cushions[k] = of_shot.cushions[n];
      f->rails[k] = of_shot.rails[n];
      n--;
    } else {
      with->final[k] = search->job.balls[k].state;
      f->pocket[k] = -1;
      f->pocket_time[k] = INFINITY;
      f->cushions[k] = 0;
      f->rails[k] = 0;
    }
  }
}

/* The work of a shot, in events. A further touch of the tip takes about as long as 80 of them: in
 * straight rail 40 us, where an event takes 0.5 us. */
uint16_t carom_search_work(const carom_shot *shot) {
  enum { TOUCH = 80 };
  const int64_t further = carom_max(shot->facts->touches - 1, 0);
  return (uint16_t)carom_min(shot->count + TOUCH * further, UINT16_MAX);
}

/* Plays a row, and returns the number of events of its shot. Apart, so that the shots that measure
 * its miss have the stack. */
__attribute__((noinline)) static int64_t play_row(const carom_search *search, int64_t row) {
  const carom_stage *s = &search->stage;
  shot_result result;
  carom_shot shot = {.final = result.final, .facts = &result.facts};
  if (s->measure != NULL) {
    shot.events = search->path[row].event;
    shot.room = PATH_EVENTS;
  }
  const candidate *c = &search->found[s->first + row / s->each];
  carom_cue cue = carom_search_stroke(search, c, s->draws, row % s->each);
  cue.ball = search->cue_ball;
  const carom_prepared layout =
      carom_search_layout(search, c, s->draws, row % s->each, result.final);
  const carom_status status = carom_shoot_prepared(&layout, &cue, &shot); /* in error a foul */
  if (search->plays < search->view.count)
    spread(search, &result);
  result.facts.barred =
      carom_barred_from(search->job.rules, (carom_leave)search->job.leave, &result.facts,
                        search->job.table, search->job.balls, search->view.count);
  int first_hit = -1;
  if (status >= 0)
    first_hit = result.facts.first[0];

  /* a stroke of the scan that begins with a foul is dropped: its layout is not judged */
  outcome *o = &search->outcome[row];
  if (s->draws == 0 && c->kind == CAROM_PLAN_SCAN && !carom_search_begins_well(search, first_hit))
    *o = (outcome){.worth = search->foul_value,
                   .turn = CAROM_TURN_PASS,
                   .foul = 1,
                   .ball = -1,
                   .pocket = -1,
                   .first = (int8_t)first_hit};
  else
    *o = judge(search, shot.facts, shot.final, status, c, s->draws != 0);
  o->events = carom_search_work(&shot);
  return shot.count;
}

static size_t play_rows(const void *context, size_t first, size_t end) {
  const carom_search *search = context;
  const carom_stage *s = &search->stage;
  for (size_t k = first; k < end; k++) {
    const int64_t row = s->done + (int64_t)k;
    if (row > 0 && (carom_is_stopped(search) || carom_is_late(search)))
      return k;
    const int64_t events = play_row(search, row);
    const candidate *c = &search->found[s->first + row / s->each];
    if (s->measure != NULL) {
      search->path[row].work = search->outcome[row].events;
      search->outcome[row].miss = s->measure(search, c, &search->path[row], events);
      search->outcome[row].events = (uint16_t)carom_min(search->path[row].work, UINT16_MAX);
    }
  }
  return end;
}

void carom_search_stage(carom_search *search, int64_t first, int64_t candidates, int64_t each,
                        uint32_t draws) {
  search->stage = (carom_stage){
      .work = play_rows, .first = first, .each = each, .rows = candidates * each, .draws = draws};
}

/* An event among many balls takes longer. */
void carom_search_spend(carom_search *search, int64_t events) {
  const int64_t cost = 1 + events * (8 + search->plays) / 16;
  search->slice -= carom_min(cost, search->slice);
}

bool carom_search_play(carom_search *search) {
  carom_stage *s = &search->stage;
  /* of all but few rows; where misses are measured, of several shots each */
  const bool measures = s->measure != NULL || s->work != play_rows;
  const int64_t cost = measures ? 1024 : 256;
  do {
    /* in a slice a block of rows that cost hardly more than what is left of it */
    const int64_t left = s->rows - s->done, block = search->slice / cost + (search->slice > 0);
    const size_t rows = (size_t)(left > block && !carom_is_stopped(search) ? block : left);
    const int64_t played =
        (int64_t)carom_crew_work(search->crew, s->work, search, rows, ROWS_LEAST);
    for (int64_t k = s->done; k < s->done + played; k++)
      carom_search_spend(search, search->outcome[k].events);
    s->done += played;
    search->late |= carom_is_late(search);
  } while (s->done < s->rows && search->slice > 0 && !carom_is_stopped(search));
  return s->done == s->rows || (s->done > 0 && carom_is_stopped(search));
}
