/* Derivatives of the impact on a cushion in its frame: impact/tangent.h has the numbers of a ball. */
#ifndef CAROM_SRC_CUSHION_TANGENT_H
#define CAROM_SRC_CUSHION_TANGENT_H

#include "impact/tangent.h"

/* Numbers of the ball, then these. After: the five of the ball. */
enum { NOSE_MU_S = CAROM_BALL_INS, NOSE_MU_W, NOSE_E, NOSE_SINE, NOSE_RATIO, CAROM_NOSE_INS };

/* By a model of carom_cushion() without convention of pooltool; opt->model and, for Euler's, its steps. mass: for Euler's least
 * step only. out: the motion after, as the model has it. */
carom_status carom_nose_tangent(const double in[CAROM_NOSE_INS], const carom_cushion_options *opt, int m,
                                carom_row din[CAROM_NOSE_INS], carom_row dout[CAROM_BALL_INS], double out[CAROM_BALL_INS],
                                carom_tangent_note *note);

#endif
