/* --stop of `carom shoot`: the speed with which a ball comes to rest at a position, or after a
 * distance. */
#ifndef CAROM_CLI_STOP_H
#define CAROM_CLI_STOP_H

#include "shots/shoot_flags.h"

/* Where a ball should stop. */
typedef struct stop_target {
  bool is_set;
  bool is_distance;      /* x is the length of its path, m or diamonds */
  char ball[PLACE_NAME]; /* its name; "": the cue ball */
  value x, y, radius;
} stop_target;

#define STOP_ARGUMENT "[BALL=]X,Y[,R]|PLACE[,R]|DISTANCE"
OPTION_SET(set_stop);

/* Gives the flags the speed with which the ball of the target stops nearest to it, and writes what
 * to report of it. False after a complaint. */
enum { STOP_TEXT = 300 };
bool stop_choose(const stop_target *target, shoot_flags *f, const carom_shot_options *options,
                 char report[STOP_TEXT]);

#endif
