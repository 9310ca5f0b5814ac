/* How a ball turns along its path: from the last whole part of an interval to any time. */
#ifndef CAROM_SRC_MOTION_ORIENTATION_H
#define CAROM_SRC_MOTION_ORIENTATION_H

#include "motion/path.h"

typedef struct carom_turning {
  double q[4];          /* w, x, y, z: the turn from the start of the shot to the last whole part */
  double start, end;    /* the interval, on the clock */
  double w[3], bend[3]; /* rad/s at its start, and their change, rad/s^2 */
  double fastest;       /* |w| at most, rad/s */
  double parts, part;   /* how many it has, 0 where it has no end; the length of one, s */
  double done;          /* parts that are in q */
} carom_turning;

/* Begins the path's first interval. q stays. */
void carom_turning_begin(carom_turning *turning, const carom_path *path,
                         const carom_ball_rates *rates);

/* Continues along the path, of one phase or several pieces of one, to the last whole part before a
 * time; false if that takes more than *left steps. *left is reduced by the steps taken. */
bool carom_turning_go_to(carom_turning *turning, carom_path *path, const carom_ball_rates *rates,
                         double time, double *left);

/* The turn at a time in the part that has begun. */
void carom_turning_at(const carom_turning *turning, double time, double q[4]);

#endif
