/* Tangents of the motion between events: path.h, differentiated. tangent_path.c has the equations. */
#ifndef CAROM_SRC_SHOT_TANGENT_PATH_H
#define CAROM_SRC_SHOT_TANGENT_PATH_H

#include "ball_ball/tangent.h"
#include "motion/path.h"

/* In the order of the numbers of a state. */
enum { S_X, S_Y, S_V_X, S_V_Y, S_W_X, S_W_Y, S_W_Z, S_Z, S_V_Z };
_Static_assert(S_V_Z + 1 == CAROM_STATE_NUMBERS, "the numbers of a state");

/* A ball since its last event. Tangents stand at a fixed time, that of the start: d[number][direction], rows of m. d_kind:
 * rows of m of its constants, or NULL. */
typedef struct carom_tangent_ball {
  carom_path path;
  const carom_ball_kind *kind;
  const double *d_kind;
  double *d;
  double last_contact; /* s */
} carom_tangent_ball;

/* The tangent of a constant of the ball. */
#define CAROM_KIND_ROW(field) ((int)(offsetof(carom_ball_kind, field) / sizeof(double)))
static inline double carom_d_kind(const carom_tangent_ball *ball, int row, int m, int j) {
  return ball->d_kind != NULL ? ball->d_kind[row * m + j] : 0.0;
}

/* The motion at a time within the path: the state, its rate (r', v', w' in the order of the numbers), and tangents at that
 * fixed time. */
void carom_tangent_flow(const carom_tangent_ball *ball, double time, int m, double rate[CAROM_STATE_NUMBERS],
                        carom_row d[CAROM_STATE_NUMBERS]);

/* The tangent of the time at which the phase ends, from tangents and rates at that time. */
void carom_tangent_end(const carom_tangent_ball *ball, int m, carom_row d[CAROM_STATE_NUMBERS], double *d_time);

/* Tangents that the label of a new state leaves: those of a ball that rolls keep it rolling, one at rest stays there. v, w: the
 * state. */
void carom_tangent_settle(const carom_ball_state *state, const carom_tangent_ball *ball, int m,
                          carom_row d[CAROM_STATE_NUMBERS]);

#endif
