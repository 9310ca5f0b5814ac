/* The direction of a cue that makes its ball meet another one at a cut, whatever spin, elevation
 * and speed do to the path. */
#ifndef CAROM_PLAN_BALL_AIM_H
#define CAROM_PLAN_BALL_AIM_H

#include "carom_shot.h"

typedef enum aim_result {
  AIM_FOUND,
  AIM_BARRED,      /* in every direction that would do, the ball of the cue meets something else
                      first */
  AIM_NOT_REACHED, /* it comes to rest before */
  AIM_NONE         /* its path leads past or over the ball, or meets it at other cuts only */
} aim_result;

/* Sets cue->phi, so that the first contact of the ball of the cue is that with ball `index`, at
 * `cut` degrees from its direction there to the line of centres, above 0 to the left: angles as
 * seen from above. The arguments are such that carom_shot_check() accepts them; the other balls
 * are at rest. AIM_BARRED: *first is that contact in the first of those directions. */
aim_result carom_aim_at_ball(const carom_table *table, const carom_shot_ball *balls, int count,
                             const carom_shot_options *options, int index, double cut,
                             carom_cue *cue, carom_event *first);

#endif
