/* Goals of a plan. A shot reaches its goal or not, so the mean worth of its strokes with errors is
 * the chance of the goal, and the search compares these chances as it compares chances to win.
 * sight.c determines whether balls hide others on straight lines. */
#include "goals.h"

#include "rules.h"
#include "view.h"

#include <math.h>

static bool is_in_play(const carom_plan_job *job, int ball) {
  return ball >= 0 && ball < job->count && job->balls[ball].state.label != CAROM_BALL_POCKETED &&
         job->balls[ball].state.label != CAROM_BALL_OFF;
}

/* Whether the opponent plays the cue ball 0 from where the player leaves it. */
static bool has_opponent(const carom_plan_job *job) {
  const carom_plan_rules *rules = job->rules;
  return rules->race != CAROM_RACE_ALONE && job->table->pockets > 0 && job->cue->ball == 0 &&
         !rules->any_cue_ball && !rules->own_cue_balls;
}

bool carom_goal_is_good(const carom_plan_job *job) {
  const carom_plan_goal *goal = job->goal;
  if (goal == NULL)
    return true;
  if (goal->reserved != 0 || job->count > CAROM_BALLS_MOST)
    return false;
  const bool has_distance = goal->distance > 0.0 && goal->distance < (double)INFINITY;
  uint32_t in_play = 0;
  for (int k = 0; k < job->count; k++)
    in_play |= (uint32_t)(k != job->cue->ball && is_in_play(job, k)) << k;
  switch (goal->kind) {
  case CAROM_GOAL_WIN:
    return true;
  case CAROM_GOAL_HIDDEN:
    return has_opponent(job);
  case CAROM_GOAL_SNOOKER:
    return has_opponent(job) && (in_play & carom_only(goal->ball)) != 0;
  case CAROM_GOAL_NEAR:
    return has_distance && goal->place[0] >= 0.0 && goal->place[0] <= job->table->width &&
           goal->place[1] >= 0.0 && goal->place[1] <= job->table->length;
  case CAROM_GOAL_APART:
    return has_distance && goal->balls != 0 && (goal->balls & ~in_play) == 0;
  default:
    return false;
  }
}

bool carom_goal_has_safeties(const carom_plan_job *job, const carom_plan_options *options) {
  const bool hides = job->goal != NULL && (job->goal->kind == CAROM_GOAL_HIDDEN ||
                                           job->goal->kind == CAROM_GOAL_SNOOKER);
  return hides || options->safeties;
}

/* Whether no ball of `targets` can be hit, or only `ball` is behind others. Apart, as its balls
 * would take 10 KiB of the stack below a shot. */
__attribute__((noinline)) static bool is_barred(const carom_search *search, uint32_t in_play,
                                                uint32_t targets, const carom_ball_state *layout) {
  carom_shot_ball balls[CAROM_BALLS_MOST];
  const double *r = layout[0].r;
  for (int k = 0; k < search->view.count; k++) {
    balls[k] = search->job.balls[k];
    balls[k].state = layout[k];
  }
  if (search->job.goal->kind == CAROM_GOAL_SNOOKER)
    return carom_is_hidden(balls, in_play, r, search->job.goal->ball);
  for (int k = 1; targets >> k != 0; k++)
    if ((targets >> k & 1) && carom_is_seen(balls, in_play & ~carom_only(k), r, k))
      return false;
  return true;
}

/* Whether a ball is so far from all object balls, between surfaces. */
static bool is_apart(const carom_search *search, uint32_t in_play, int ball,
                     const carom_ball_state *layout) {
  for (int k = 0; k < search->view.count; k++) {
    const double least =
        search->view.radius[k] + search->view.radius[ball] + search->job.goal->distance;
    if ((in_play >> k & 1) && k != ball &&
        carom_square(layout[k].r, layout[ball].r) < least * least)
      return false;
  }
  return true;
}

bool carom_search_reaches(const carom_search *search, const carom_rules_state *game,
                          const carom_ball_state *layout, const carom_turn *turn, float *near) {
  const carom_plan_goal *goal = search->job.goal;
  const bool passes = turn->outcome == CAROM_TURN_PASS, loses = turn->outcome == CAROM_TURN_LOSE;
  if (turn->foul != CAROM_FOUL_NONE || loses || passes != search->only_safeties)
    return false;

  /* the object balls, and where the cue ball rests */
  const int cue_ball = search->view.cue_ball;
  const uint32_t in_play = carom_in_play(layout, search->view.count) & ~carom_only(cue_ball);
  const carom_ball_state *cue = &layout[cue_ball];
  if (goal->kind == CAROM_GOAL_NEAR) {
    const double away = sqrt(carom_square(cue->r, goal->place));
    if (cue->label != CAROM_BALL_STATIONARY || turn->leave >= CAROM_LEAVE_ANYWHERE)
      return false;
    *near = (float)fmax(1.0 - away, 0.0);
    return away <= goal->distance;
  }
  if (goal->kind != CAROM_GOAL_APART) {
    const uint32_t targets = search->job.rules->on(game, in_play) & in_play;
    const bool alive = goal->kind != CAROM_GOAL_SNOOKER || (in_play & carom_only(goal->ball)) != 0;
    return turn->leave < CAROM_LEAVE_ANYWHERE && alive &&
           is_barred(search, in_play, targets, layout);
  }
  for (int k = 0; goal->balls >> k != 0; k++)
    if ((goal->balls & in_play & carom_only(k)) != 0 && !is_apart(search, in_play, k, layout))
      return false;
  return true;
}
