/* Why a choice of a plan is good: its stroke without errors is played and ruled; then some with
 * errors, and the same without those of speed and without those of aim, which shows what these
 * cost. */
#include "carom_coach.h"
#include "coach.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "rules.h"
#include "search_state.h"
#include "shot/shot.h"

#include <math.h>
#include <string.h>

enum { EVENTS = 64 };
static const double luck = 0.1; /* a chance to play on below which balls fall by luck */

/* What the job's memory has while no plan is in it. */
typedef struct workspace {
  union {
    carom_event events[EVENTS]; /* of the stroke without errors, */
    carom_search search;        /* then of the values of what strokes leave */
  };
  carom_ruling ruling;
  carom_stroke_room room;
  carom_shot_ball balls[CAROM_BALLS_MOST];
} workspace;

/* Plays a stroke and rules it: what it leaves, to whom, and where a cue ball in hand may be put. */
static void play(const carom_plan_job *job, const carom_cue *cue, carom_call call, carom_shot *shot,
                 carom_ruling *ruling) {
  carom_play_stroke(job, cue, call, &((workspace *)job->memory)->room, shot, ruling);
}

/* The stroke of a choice with the errors of number n. */
static carom_cue stroke_of(const carom_plan_job *job, const carom_player *player,
                           const carom_plan_stroke *choice, int n) {
  carom_cue stroke = choice->cue;
  const uint64_t seed = job->options != NULL ? job->options->seed : 0;
  carom_player_strike(player, seed, (uint64_t)n, &stroke);
  return stroke;
}

/* The best stroke from what is left. */
static carom_status plan_next(const carom_plan_job *job, const carom_ruling *ruling,
                              carom_plan_stroke *choice) {
  carom_plan_rules rules;
  const carom_plan_job next = carom_job_after(job, ruling, &rules);
  int found;
  if (!ruling->hand)
    return carom_plan(&next, choice, 1, &found);
  return carom_plan_hand(&next, NULL, NULL, choice, 1, &found);
}

/* Results of strokes with errors: how many, and sums. */
typedef struct stroke_sums {
  int keeps, misses, fouls, loses;
  double worth, squares, opponent; /* to the player, and of their squares; of the misses to the
                                      opponent */
} stroke_sums;

static int left_of(const carom_plan_job *job, const carom_shot_ball *balls) {
  uint32_t in_play = 0;
  int32_t left[2];
  for (int k = 0; k < job->count; k++)
    in_play |= (uint32_t)(balls[k].state.label != CAROM_BALL_POCKETED) << k;
  job->rules->left(&job->rules->state, in_play, left);
  return (int)carom_max(left[0], 1);
}

/* What a stroke is worth to the player, by the value of what it leaves: the chance to win, or the
 * share of the balls before it. */
static double worth_of(const carom_plan_job *job, const carom_ruling *ruling, double *opponent) {
  const bool alone = job->rules->race == CAROM_RACE_ALONE,
             passes = ruling->turn.outcome == CAROM_TURN_PASS;
  if (ruling->turn.outcome >= CAROM_TURN_WIN)
    return ruling->turn.outcome != CAROM_TURN_LOSE;
  carom_plan_rules rules;
  carom_plan_job next = carom_job_after(job, ruling, &rules);
  const bool seats = job->rules->race == CAROM_RACE_SEATS;
  if (seats)
    next.rules = job->rules; /* the seat that has played asks */
  double chance = 0.0;
  if (!(alone && passes))
    carom_search_value(&((workspace *)job->memory)->search, &next, &ruling->state, seats && passes,
                       ruling->hand, &chance);
  if (alone)
    return fmin(1.0, (ruling->turn.points + chance * left_of(&next, ruling->balls)) /
                         left_of(job, job->balls));
  if (!passes)
    return chance;
  *opponent = chance;
  return 1.0 - chance;
}

/* Plays the stroke with the errors of a player. All players have the same luck. */
static stroke_sums play_with(const carom_plan_job *job, const carom_player *player,
                             const carom_plan_stroke *choice) {
  const carom_call call = {choice->ball, choice->pocket};
  carom_ruling *ruling = &((workspace *)job->memory)->ruling;
  stroke_sums s = {0};
  for (int n = 0; n < CAROM_WHY_STROKES; n++) {
    const carom_cue stroke = stroke_of(job, player, choice, n);
    carom_shot shot = {.events = NULL};
    double opponent = 0.0;
    play(job, &stroke, call, &shot, ruling);
    const double worth = worth_of(job, ruling, &opponent);
    s.worth += worth;
    s.squares += worth * worth;
    s.opponent += opponent;
    s.keeps += ruling->turn.outcome != CAROM_TURN_PASS && ruling->turn.outcome != CAROM_TURN_LOSE;
    s.misses += ruling->turn.outcome == CAROM_TURN_PASS;
    s.fouls += ruling->turn.foul != CAROM_FOUL_NONE;
    s.loses += ruling->turn.outcome == CAROM_TURN_LOSE;
  }
  return s;
}

int carom_names_ball(const carom_plan_stroke *choice) {
  if (choice == NULL || choice->ball < 0)
    return 0;
  const bool is_meant = choice->kind == CAROM_PLAN_POT || choice->kind == CAROM_PLAN_GIVEN;
  return is_meant || choice->keep >= luck;
}

/* Whether event k of a shot is a cushion that the ball meets, and no hop along the one before. */
static bool is_rail(const carom_table *table, const carom_shot *shot, int64_t k, int64_t ball) {
  const carom_event *e = &shot->events[k];
  if (e->type != CAROM_EVENT_RAIL || e->a != ball || !carom_is_cushion(table, (int)e->b))
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

/* What strokes with errors come to, and what the errors cost. */
static void find_costs(const carom_plan_job *job, const carom_plan_stroke *choice, carom_why *why) {
  const double n = CAROM_WHY_STROKES;
  const stroke_sums sums = play_with(job, job->player, choice);
  why->strokes = CAROM_WHY_STROKES;
  why->misses = sums.misses / n;
  why->loses = sums.loses / n;
  why->opponent = (double)NAN;
  if (sums.misses > 0 && job->rules->race != CAROM_RACE_ALONE)
    why->opponent = sums.opponent / sums.misses;

  carom_player aims = *job->player, times = *job->player;
  aims.speed = aims.speed_share = 0.0;
  times.phi = times.theta = times.a = times.b = 0.0;
  why->speed_cost = fmax(0.0, (play_with(job, &aims, choice).worth - sums.worth) / n);
  why->aim_cost = fmax(0.0, (play_with(job, &times, choice).worth - sums.worth) / n);
}

static bool is_whole(const carom_plan_job *job) {
  return job != NULL && job->table != NULL && job->balls != NULL && job->cue != NULL &&
         job->player != NULL && job->rules != NULL && job->memory != NULL &&
         job->memory_size >= carom_plan_memory(job->options) &&
         job->memory_size >= sizeof(workspace);
}

/* The layout of a choice: that of the job, with the cue ball on the choice's place. */
static carom_plan_job job_of(const carom_plan_job *job, const carom_plan_stroke *choice,
                             carom_shot_ball balls[CAROM_BALLS_MOST], carom_status *status) {
  carom_plan_job placed = *job;
  memcpy(balls, job->balls, (size_t)job->count * sizeof *balls);
  placed.balls = balls;
  *status = carom_place_ball(job->table, balls, (int)job->count, (int)job->cue->ball,
                             choice->place[0], choice->place[1], NULL);
  return placed;
}

carom_status carom_why_of(const carom_plan_job *job, const carom_plan_stroke *choice,
                          carom_why *why) {
  if (!is_whole(job) || choice == NULL || why == NULL)
    return CAROM_ERROR_NULL;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  if (choice->kind == CAROM_PLAN_PASS)
    return CAROM_ERROR_OPTIONS;
  carom_status status;
  const carom_plan_job placed = job_of(job, choice, ((workspace *)job->memory)->balls, &status);

  /* the stroke without errors */
  const carom_call call = {choice->ball, choice->pocket};
  carom_ruling *ruling = &why->ruling;
  carom_shot shot = {.events = ((workspace *)job->memory)->events, .room = EVENTS};
  play(&placed, &choice->cue, call, &shot, ruling);
  find_aim(&placed, &choice->cue, &shot, why);

  /* a stroke that is not meant to pot leaves what it mostly does, even if it pots without errors */
  for (int n = 0; !carom_names_ball(choice) && ruling->turn.outcome != CAROM_TURN_PASS &&
                  n < CAROM_WHY_STROKES;
       n++) {
    const carom_cue stroke = stroke_of(&placed, placed.player, choice, n);
    play(&placed, &stroke, call, &(carom_shot){.events = NULL}, ruling);
  }
  const bool ends =
      ruling->turn.outcome >= CAROM_TURN_WIN ||
      (ruling->turn.outcome == CAROM_TURN_PASS && job->rules->race == CAROM_RACE_ALONE);
  find_costs(&placed, choice, why);
  /* last, because the plan overwrites the workspace */
  why->has_next = !ends && plan_next(&placed, ruling, &why->next) == CAROM_OK;
  return status;
}

/* Gives a choice the chances of strokes that are played anew. */
static void replay(const carom_plan_job *job, carom_plan_stroke *choice) {
  const stroke_sums s = play_with(job, job->player, choice);
  const double n = CAROM_WHY_STROKES, mean = s.worth / n;
  choice->value = mean;
  choice->error = sqrt(fmax(s.squares / n - mean * mean, 0.0) / (n - 1.0));
  choice->keep = s.keeps / n;
  choice->foul = s.fouls / n;
  choice->lose = s.loses / n;
  choice->seen = CAROM_WHY_STROKES;
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
    carom_status status;
    const carom_plan_job placed = job_of(job, &choice, ((workspace *)job->memory)->balls, &status);
    if (choice.kind != CAROM_PLAN_PASS)
      replay(&placed, &choice);
    int index = k;
    for (; index > 0 && choices[index - 1].value < choice.value; index--)
      choices[index] = choices[index - 1];
    choices[index] = choice;
  }
  return CAROM_OK;
}
