/* Goals of a plan: what its stroke is to leave. */
#ifndef CAROM_PLAN_GOALS_H
#define CAROM_PLAN_GOALS_H

#include "search_state.h"

static inline bool carom_has_goal(const carom_plan_job *job) {
  return job->goal != NULL && job->goal->kind != CAROM_GOAL_WIN;
}
/* Whether the layout and the rules of a job have its goal. */
bool carom_goal_is_good(const carom_plan_job *job);
/* Whether a plan tries only safeties, as the options or the goal say. */
bool carom_goal_has_safeties(const carom_plan_job *job, const carom_plan_options *options);
/* Whether a shot reaches the goal: its turn, and the state and the layout that it leaves. *near is
 * 1 on a position that is the goal, and 0 a metre from it, or of another goal. */
bool carom_search_reaches(const carom_search *search, const carom_rules_state *game,
                          const carom_ball_state *layout, const carom_turn *turn, float *near);

#endif
