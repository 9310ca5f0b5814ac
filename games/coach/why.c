/* Why a choice of a plan is good: its stroke without errors is played and ruled, and rows of the
 * plan play it with errors, so that chances and values come from the plan's own estimator.
 *
 * Let V(S) be the value with the errors of a set S. All errors together cost V({}) - V(all). An
 * error that is added to others costs V(others) - V(others with it); the cost of each error is the
 * mean over adding the errors in the order of carom_why_error and in the reverse one, so the sum of
 * the costs is the cost of all. */
#include "carom_coach.h"
#include "coach.h"
#include "goals.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "random_draws.h"
#include "ranking.h"
#include "rows.h"
#include "rules.h"
#include "shot/shot.h"

#include <math.h>
#include <string.h>

enum { EVENTS = 64, ALL_ERRORS = (1 << CAROM_WHY_ERRORS) - 1 };

/* What the job's memory has behind the rows of a plan, for a stroke that is ruled. */
typedef struct workspace {
  carom_event events[EVENTS];
  carom_stroke_room room;
  carom_shot_ball balls[CAROM_BALLS_MOST];
} workspace;

/* Plays a stroke and rules it: what it leaves, to whom, and where a cue ball in hand may be put. */
static void play(const carom_plan_job *job, const carom_cue *cue, carom_call call, carom_shot *shot,
                 carom_ruling *ruling) {
  carom_play_stroke(job, cue, call, &((workspace *)job->memory)->room, shot, ruling);
}

/* The best stroke from what is left, for whoever plays next. */
static carom_status plan_next(const carom_plan_job *job, const carom_ruling *ruling,
                              carom_plan_stroke *choice) {
  carom_plan_rules rules;
  const carom_plan_job next = carom_job_after(job, ruling, &rules);
  int found;
  if (!ruling->hand)
    return carom_plan(&next, choice, 1, &found);
  return carom_plan_hand(&next, NULL, NULL, choice, 1, &found);
}

/* ---- Rows of a choice */

/* The layout of a choice: the layout of the job, with the cue ball at the choice's position. */
static carom_status place_choice(const carom_plan_job *job, const carom_plan_stroke *choice,
                                 carom_shot_ball balls[CAROM_BALLS_MOST], carom_plan_job *placed) {
  *placed = *job;
  memcpy(balls, job->balls, (size_t)job->count * sizeof *balls);
  placed->balls = balls;
  return carom_place_ball(job->table, balls, (int)job->count, (int)job->cue->ball, choice->place[0],
                          choice->place[1], NULL);
}

/* Makes a plan whose one candidate is a choice. */
static carom_status prepare_choice(const carom_plan_job *job, const carom_plan_stroke *choice,
                                   carom_search **prepared) {
  carom_plan_job placed;
  carom_search *search = job->memory;
  carom_status status = place_choice(job, choice, search->hand, &placed);
  if (status != CAROM_OK)
    return status;
  status = carom_search_prepare(&placed, false, 1, &search);
  if (status != CAROM_OK)
    return status;

  /* it is played to its end, however the plan would be stopped */
  search->options.stop = NULL;
  search->seconds = 0.0;
  search->count = 1;
  search->found[0] = (carom_candidate){.r = {choice->place[0], choice->place[1]},
                                       .speed = choice->cue.speed,
                                       .phi = choice->cue.phi,
                                       .theta = choice->cue.theta,
                                       .a = choice->cue.a,
                                       .b = choice->cue.b,
                                       .kind = CAROM_PLAN_GIVEN,
                                       .ball = (int16_t)choice->ball,
                                       .pocket = (int16_t)choice->pocket};
  if (choice->kind == CAROM_PLAN_PUSH)
    search->found[0].kind = CAROM_PLAN_PUSH;
  search->found[0].leave[0] = (float)choice->leave[0];
  search->found[0].leave_worth = (float)choice->value;
  *prepared = search;
  return CAROM_OK;
}

static void play_choice(void *context, carom_crew *crew) {
  carom_search *search = context;
  search->crew = crew;
  carom_search_play(search);
}

/* Plays the choice with some errors of the player, a set of carom_why_error. All sets have the same
 * luck. Without errors one stroke is enough if the table is known. */
static carom_tally repeat(carom_search *search, uint32_t errors) {
  const carom_player player = search->player;
  int64_t strokes = CAROM_WHY_STROKES;
  if (!(errors >> CAROM_WHY_AIM & 1))
    search->player.phi = search->player.theta = 0.0;
  if (!(errors >> CAROM_WHY_SPEED & 1))
    search->player.speed = search->player.speed_share = 0.0;
  if (!(errors >> CAROM_WHY_TIP & 1))
    search->player.a = search->player.b = 0.0;
  if (!(errors >> CAROM_WHY_EYE & 1))
    search->player.eye = 0.0;
  if (errors == 0 && search->drawn == NULL)
    strokes = 1;
  carom_search_stage(search, 0, 1, strokes, DRAW_REASONS);
  search->found[0].fresh = (carom_tally){0};
  carom_search_with_crew(search, play_choice);
  carom_search_replayed(search);
  search->player = player;
  return search->found[0].fresh;
}

static double mean_of(const carom_tally *tally) {
  return tally->sum / (double)tally->seen;
}

int carom_names_ball(const carom_plan_stroke *choice) {
  if (choice == NULL || choice->ball < 0)
    return 0;
  const bool is_meant = choice->kind == CAROM_PLAN_POT || choice->kind == CAROM_PLAN_GIVEN;
  return is_meant || choice->keep >= carom_luck;
}

/* Whether event k of a shot is a cushion that the ball meets, and no hop along the one before. */
static bool is_rail(const carom_table *table, const carom_shot *shot, int64_t k, int64_t ball) {
  const carom_event *e = &shot->events[k];
  if (e->type != CAROM_EVENT_RAIL || e->a != ball || carom_is_cut(table, e->b))
    return false;
  for (int64_t n = k - 1; n >= 0 && e->time - shot->events[n].time < carom_same_contact; n--)
    if (shot->events[n].type == e->type && shot->events[n].a == ball && shot->events[n].b == e->b)
      return false;
  return true;
}

/* How the stroke is aimed: the cushions before the first ball, the cut and how much of the ball is
 * hit; and the speed of the cue ball. */
static void find_aim(const carom_plan_job *job, const carom_cue *cue, const carom_shot *shot,
                     carom_why *why) {
  why->rails = 0;
  why->first = -1;
  why->cut = why->part = (double)NAN;
  for (int64_t k = 0; k < shot->count && k < shot->room && why->first < 0; k++) {
    const carom_event *e = &shot->events[k];
    if (e->type == CAROM_EVENT_BALL_BALL && (e->a == cue->ball || e->b == cue->ball)) {
      double sine, cosine;
      why->first = e->a == cue->ball ? e->b : e->a;
      why->cut = carom_cut_at(e, (int)cue->ball);
      carom_sincos_degrees(why->cut, &sine, &cosine);
      why->part = 1.0 - fabs(sine);
    } else if (is_rail(job->table, shot, k, cue->ball) && why->rails < CAROM_WHY_RAILS) {
      why->rail[why->rails] = e->b;
      memcpy(why->contact[why->rails], e->after[0].r, sizeof why->contact[0]);
      why->rails++;
    }
  }

  carom_motion struck = {{0.0}, {0.0}};
  carom_strike(cue, &job->balls[cue->ball].kind, &struck);
  why->speed = sqrt(struck.v[0] * struck.v[0] + struck.v[1] * struck.v[1]);
}

/* Results of strokes with errors. Returns the row of the one that passes the turn and leaves what
 * those that do leave on average; -1: none does. */
static int64_t find_chances(carom_search *search, carom_why *why) {
  const carom_tally all = repeat(search, ALL_ERRORS);
  const double n = (double)all.seen;
  why->strokes = all.seen;
  why->value = mean_of(&all);
  why->loses = all.lose / n;
  int64_t passes = 0, typical = -1;
  double sum = 0.0;
  for (int64_t k = 0; k < all.seen; k++) {
    if (search->outcome[k].turn != CAROM_TURN_PASS)
      continue;
    sum += search->outcome[k].worth;
    passes++;
  }
  why->misses = (double)passes / n;
  why->opponent = (double)NAN;
  if (passes > 0 && search->job.rules->race != CAROM_RACE_ALONE && !carom_has_goal(&search->job))
    why->opponent = 1.0 - sum / (double)passes;

  const double mean = sum / (double)carom_max(passes, 1);
  for (int64_t k = 0; k < all.seen; k++) {
    const double off = fabs(search->outcome[k].worth - mean);
    const bool passed = search->outcome[k].turn == CAROM_TURN_PASS;
    if (passed && (typical < 0 || off < fabs(search->outcome[typical].worth - mean)))
      typical = k;
  }
  return typical;
}

/* What the errors cost, added in one order and in the reverse one. */
static void find_costs(carom_search *search, carom_why *why) {
  const carom_tally none = repeat(search, 0);
  why->flawless_value = mean_of(&none);
  memset(why->cost, 0, sizeof why->cost);
  for (int order = 0; order < 2; order++) {
    uint32_t errors = 0;
    double before = why->flawless_value;
    for (int k = 0; k < CAROM_WHY_ERRORS; k++) {
      const int added = order == 0 ? k : CAROM_WHY_ERRORS - 1 - k;
      errors |= UINT32_C(1) << added;
      double worth = why->value;
      if (errors != ALL_ERRORS) {
        const carom_tally some = repeat(search, errors);
        worth = mean_of(&some);
      }
      why->cost[added] += 0.5 * (before - worth);
      before = worth;
    }
  }
}

static bool is_whole(const carom_plan_job *job) {
  return job != NULL && job->table != NULL && job->balls != NULL && job->cue != NULL &&
         job->player != NULL && job->rules != NULL && job->memory != NULL &&
         job->memory_size >= carom_plan_memory(job->options) &&
         job->memory_size >= sizeof(workspace);
}

carom_status carom_why_of(const carom_plan_job *job, const carom_plan_stroke *choice,
                          carom_why *why) {
  if (!is_whole(job) || choice == NULL || why == NULL)
    return CAROM_ERROR_NULL;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  if (choice->kind == CAROM_PLAN_PASS)
    return CAROM_ERROR_OPTIONS;
  carom_search *search;
  carom_status status = prepare_choice(job, choice, &search);
  if (status != CAROM_OK)
    return status;

  /* a stroke that is not meant to pot leaves what it mostly does, even if it pots without errors */
  const int64_t typical = find_chances(search, why);
  carom_cue stroke = choice->cue;
  why->leave = (double)NAN;
  if (typical >= 0 && !carom_names_ball(choice)) {
    stroke = carom_search_stroke(search, &search->found[0], DRAW_REASONS, typical);
    why->leave = search->outcome[typical].worth;
  }
  find_costs(search, why);
  if (isnan(why->leave))
    why->leave = why->flawless_value;
  if (carom_has_goal(job))
    why->leave = (double)NAN;

  /* the aim, and what is left, in the memory of the plan; last the best stroke from there */
  carom_plan_job placed;
  status = place_choice(job, choice, ((workspace *)job->memory)->balls, &placed);
  const carom_call call = {choice->ball, choice->pocket};
  carom_ruling *ruling = &why->ruling;
  carom_shot shot = {.events = ((workspace *)job->memory)->events, .room = EVENTS};
  play(&placed, &choice->cue, call, &shot, ruling);
  find_aim(&placed, &choice->cue, &shot, why);
  if (typical >= 0 && !carom_names_ball(choice)) {
    stroke.ball = choice->cue.ball;
    play(&placed, &stroke, call, &(carom_shot){.events = NULL}, ruling);
  }
  const bool ends =
      ruling->turn.outcome >= CAROM_TURN_WIN ||
      (ruling->turn.outcome == CAROM_TURN_PASS && job->rules->race == CAROM_RACE_ALONE);
  why->has_next = !ends && plan_next(&placed, ruling, &why->next) == CAROM_OK;
  return status;
}

/* Gives a choice the chances of strokes that are played anew. */
static carom_status replay(const carom_plan_job *job, carom_plan_stroke *choice) {
  carom_search *search;
  const carom_status status = prepare_choice(job, choice, &search);
  if (status != CAROM_OK)
    return status;
  const carom_tally all = repeat(search, ALL_ERRORS);
  const double n = (double)all.seen, mean = mean_of(&all);
  choice->value = mean;
  choice->error = sqrt(fmax(all.squares / n - mean * mean, 0.0) / (n - 1.0));
  choice->keep = all.keep / n;
  choice->foul = all.foul / n;
  choice->lose = all.lose / n;
  choice->seen = all.seen;
  return CAROM_OK;
}

carom_status carom_plan_replay(const carom_plan_job *job, carom_plan_stroke *choices, int n) {
  if (!is_whole(job) || choices == NULL)
    return CAROM_ERROR_NULL;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  if (n < 0)
    return CAROM_ERROR_OPTIONS;
  for (int k = 0; k < n; k++) {
    carom_plan_stroke choice = choices[k];
    carom_status status = CAROM_OK;
    if (choice.kind != CAROM_PLAN_PASS)
      status = replay(job, &choice);
    if (status != CAROM_OK)
      return status;
    int index = k;
    for (; index > 0 && choices[index - 1].value < choice.value; index--)
      choices[index] = choices[index - 1];
    choices[index] = choice;
  }
  return CAROM_OK;
}
