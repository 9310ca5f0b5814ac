/* How far the butt of a cue must be raised. */
#ifndef CAROM_PLAN_STICK_H
#define CAROM_PLAN_STICK_H

#include "carom_plan.h"

/* degrees; nobody plays with a steeper stick */
static const double STICK_MOST = 60.0;
/* The least elevation, degrees, with which the stick of a cue is over the cushions and the balls
 * behind the ball that it strikes. It may be above STICK_MOST. */
double carom_least_elevation(const carom_table *table, const carom_shot_ball *balls, int count,
                             const carom_cue *cue);

#endif
