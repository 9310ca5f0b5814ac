/* Where the cue ball shall end: --leave of `carom ways` and of `carom shoot`. */
#ifndef CAROM_CLI_POSITION_H
#define CAROM_CLI_POSITION_H

#include "shots/shoot_flags.h"

struct ways_search;

/* Where the cue ball shall end: within a radius of a place. */
typedef struct leave {
  bool is_set;
  value x, y, radius;
} leave;

/* For a `leave`: X,Y or X,Y,R, or a place that has a name. */
/* The tips that are tried to bring the cue ball to a place, where none are given. */
#define TIPS_TO_LEAVE "0,-0.4:0.4:0.2"

#define LEAVE_ARGUMENT "X,Y[,R]|PLACE[,R]"
OPTION_SET(set_leave);

/* Puts the place and the radius, or none, into a search. */
void leave_into(const leave *target, struct ways_search *s);

/* Leaves the flags the one speed, tip, elevation and direction, of those given or of the usual
 * ones, with which most strokes of the player bring the cue ball there, and pot the ball of
 * --pocket; and what is to be told of it. False after a complaint. */
enum { LEFT_TEXT = 400 };
bool leave_choose(const leave *target, shoot_flags *f, const carom_shot_options *options,
                  char text[LEFT_TEXT]);

#endif
