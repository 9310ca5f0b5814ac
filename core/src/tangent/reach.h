/* How far tangents reach: see reach.c. */
#ifndef CAROM_SRC_TANGENT_REACH_H
#define CAROM_SRC_TANGENT_REACH_H

#include "tangent/work.h"

typedef struct carom_reach {
  carom_tangent_work *work;
  double *reach;                        /* of the directions of the pass */
  int64_t last_event[CAROM_BALLS_MOST]; /* of each ball, or -1; */
  double last_time[CAROM_BALLS_MOST];   /* when */
} carom_reach;

/* The balls of `work` are at their start. */
void carom_reach_begin(carom_reach *reach, carom_tangent_work *work);
/* Ball i begins its path, on which it misses things. */
void carom_reach_go_on(carom_tangent_work *work, int i);
/* The next event, while the paths are still those before it: the bodies that its balls missed on
 * them. */
void carom_reach_misses(carom_reach *reach, const carom_event *event);
/* Event k, with its tangents in `work`: whether it would be a miss, or precede the last one of its
 * balls. */
void carom_reach_event(carom_reach *reach, int64_t k, const carom_event *event);

#endif
