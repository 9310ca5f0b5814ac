/* A shot, or an impact on a cushion, by the sources in dual numbers (number.h), as the test calls them from C. */
#ifndef CAROM_TESTS_DUAL_PLAY_H
#define CAROM_TESTS_DUAL_PLAY_H

#include <stdint.h>

/* A number and its derivative. Here and in number.h `double` has two meanings. */
#ifndef CAROM_TESTS_DUAL_NUMBER_H
typedef double real;
#endif
typedef struct dual_number {
  real x, d;
} dual_number;

enum { DUAL_BALLS = 9, DUAL_EVENTS = 2000, DUAL_CUE = 7, DUAL_KIND = 19, DUAL_STATE = 9, DUAL_IMPACT = 15, DUAL_MOTION = 6 };

typedef struct dual_event {
  dual_number time, before[2][DUAL_STATE], after[2][DUAL_STATE]; /* r, v, w */
  int type, a, b;
} dual_event;

typedef struct dual_shot {
  /* the table, the height of its noses (of which only d is read), friction and restitution of its cushions */
  int table;
  dual_number nose[3];
  /* numbers in the order of carom_shot.h; 0 of a cue is the ball that it strikes */
  int count, ball_model, cushion_model, friction, space;
  dual_number cue[DUAL_CUE], kind[DUAL_BALLS][DUAL_KIND], state[DUAL_BALLS][DUAL_STATE];
  /* written: the status, events, states at the end */
  int status, events;
  dual_event event[DUAL_EVENTS];
  dual_number final[DUAL_BALLS][DUAL_STATE];
} dual_shot;

#ifdef CAROM_TESTS_DUAL_NUMBER_H
#define EXPORT extern "C"
#else
#define EXPORT
#endif

EXPORT void dual_play(dual_shot *shot);

/* carom_cushion(); returns its status. */
EXPORT int dual_cushion(const dual_number in[DUAL_IMPACT], int model, int law, dual_number out[DUAL_MOTION]);

/* The three numbers of carom_alciatore(), which the program of C has. */
EXPORT void dual_usual_law(real law[3]);

#undef EXPORT

#endif
