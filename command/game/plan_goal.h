/* --leave of `carom plan`: what the stroke is to leave. */
#ifndef CAROM_CLI_PLAN_GOAL_H
#define CAROM_CLI_PLAN_GOAL_H

#include "game/position.h"
#include "shots/shot_file.h"

#include "carom_plan.h"

/* A goal as it was given. */
typedef struct given_goal {
  int kind;           /* a carom_goal_kind */
  const char *target; /* behind the colon, or NULL */
  leave place;        /* of CAROM_GOAL_NEAR */
} given_goal;

#define GOAL_ARGUMENT "hidden|snooker:BALL|near:" LEAVE_ARGUMENT "|apart:BALL,..."
OPTION_SET(set_goal); /* for a given_goal */

/* The goal on a layout, by the names of its balls; false after a complaint. */
bool plan_goal_of(const given_goal *given, const shot_line *line, const carom_plan_rules *rules,
                  carom_plan_goal *goal);

#endif
