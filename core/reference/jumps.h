/* What two shots of neighbouring recipes differ in, and the kind of a jump between them. */
#ifndef CAROM_REFERENCE_JUMPS_H
#define CAROM_REFERENCE_JUMPS_H

#include "recipes.h"

#include <stdbool.h>

enum { JUMP_ROOM = 400, JUMP_NAME = 60 };

/* A shot that was played, with a number of its recipe at x. */
typedef struct played {
  double x;
  int count;
  carom_event event[JUMP_ROOM];
  carom_ball_state final[RECIPE_BALLS];
} played;

/* False for balls that overlap, a shot in error, or one with too many events. */
bool recipe_play(const recipe *r, played *p);

typedef struct difference {
  double place, speed; /* m, and m/s with R w */
} difference;

/* Of balls that are in play in both shots. */
difference final_difference(const recipe *r, const played *p, const played *q);

/* The greater of the two; infinite where a ball is in play in one shot alone. */
double change_of(const recipe *r, const played *p, const played *q);

/* EXPLAINED: the jump is what an event makes. STOPPED: that event is the stop of the shot. AGREED
 * is of single events alone. */
typedef enum verdict { EXPLAINED, STOPPED, NAMED, AGREED } verdict;

/* Names the kind of a jump between the recipes `low` and `high`, with the shots a and b. *time
 * becomes when they part. */
verdict name_jump(const recipe *low, const recipe *high, const played *a, const played *b,
                  char name[JUMP_NAME], double *time);

#endif
