/* How far tangents reach: see reach.c. */
#ifndef CAROM_SRC_SHOT_REACH_H
#define CAROM_SRC_SHOT_REACH_H

#include "shot/tangent_work.h"

typedef struct carom_reach {
  const carom_tangent_work *work;
  double *reach;                        /* [m] */
  const double *time;                   /* [events][m] */
  int64_t last_event[CAROM_BALLS_MOST]; /* of each ball, or -1; */
  double last_time[CAROM_BALLS_MOST];   /* when */
} carom_reach;

/* The balls of `work` are at their start. */
void carom_reach_begin(carom_reach *reach, const carom_tangent_work *work, const double *time, double *to);
/* Event k, while the paths are still those before it: what its balls missed on them. */
void carom_reach_misses(carom_reach *reach, const carom_event *event);
/* The same event, with total tangents before it: whether it would be a miss, or come before the last one of its balls. */
void carom_reach_event(carom_reach *reach, int64_t k, const carom_event *event, carom_row (*d)[CAROM_STATE_NUMBERS]);

#endif
