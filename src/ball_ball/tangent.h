/* Derivatives of the collision of two balls in its frame: impact/tangent.h has the numbers of a ball. */
#ifndef CAROM_SRC_BALL_BALL_TANGENT_H
#define CAROM_SRC_BALL_BALL_TANGENT_H

#include "impact/tangent.h"

/* Numbers of a, of b, then these. After: the five of a, the five of b. */
enum { BALLS_MU = 2 * CAROM_BALL_INS, BALLS_E, BALLS_MU_A, BALLS_MU_B, BALLS_M_A, BALLS_M_B, CAROM_BALLS_INS };
enum { CAROM_BALLS_OUTS = 10 };

/* dout = J din in m directions. Exact: the limit of impact/; status of the solver. See tangent.c. */
carom_status carom_exact_balls_tangent(const double in[CAROM_BALLS_INS], int plain, int m, carom_row din[CAROM_BALLS_INS],
                                       carom_row dout[CAROM_BALLS_OUTS], carom_tangent_note *note);
void carom_inelastic_balls_tangent(const double in[CAROM_BALLS_INS], int m, carom_row din[CAROM_BALLS_INS],
                                   carom_row dout[CAROM_BALLS_OUTS], carom_tangent_note *note);
void carom_mirror_balls_tangent(const double in[CAROM_BALLS_INS], int m, carom_row din[CAROM_BALLS_INS],
                                carom_row dout[CAROM_BALLS_OUTS]);

#endif
