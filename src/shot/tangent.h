/* Derivatives of contacts in the frame of the contact, for the tangents of single contacts and of whole shots.
 *
 * Frame: y from the first ball to the second, or into the cushion; z up; x = y x z. The numbers of a ball are speeds, m/s, with
 * W = R w:
 *
 *     before     v_x   v_y   c_x = v_x - W_y   c_y = v_y + W_x   W_z          (c: the slip on the cloth)
 *     after      v_x   v_y   W_x               W_y               W_z
 *
 * The slip takes the place of W_x and W_y since exact models have no derivative by the slip of a ball that rolls and is
 * pressed; but a ball that rolls stays one, so its slip does not change and the derivative is not asked for.
 *
 * Tangents stand in rows of directions: din[number][direction]. */
#ifndef CAROM_SRC_SHOT_TANGENT_H
#define CAROM_SRC_SHOT_TANGENT_H

#include "carom_tangent.h"
#include "platform/arithmetic.h"

#include <stdbool.h>

typedef double carom_row[CAROM_DIRECTIONS_MOST];

enum { OF_V_X, OF_V_Y, OF_C_X, OF_C_Y, OF_W_Z, CAROM_BALL_INS, OF_W_X = 2, OF_W_Y = 3 };

/* What is said of a Jacobian. */
typedef struct carom_tangent_note {
  int32_t flags; /* of carom_tangent_flag */
  double error;  /* of differences, relative */
} carom_tangent_note;

/* ---- Two balls: numbers of a, of b, then these. After: the five of a, the five of b. ---- */
enum { BALLS_MU = 2 * CAROM_BALL_INS, BALLS_E, BALLS_MU_A, BALLS_MU_B, BALLS_M_A, BALLS_M_B, CAROM_BALLS_INS };
enum { CAROM_BALLS_OUTS = 10 };

/* dout = J din in m directions. Exact: the limit of impact/; status of the solver. See tangent_balls.c. */
carom_status carom_exact_balls_tangent(const double in[CAROM_BALLS_INS], int plain, int m, carom_row din[CAROM_BALLS_INS],
                                       carom_row dout[CAROM_BALLS_OUTS], carom_tangent_note *note);
void carom_inelastic_balls_tangent(const double in[CAROM_BALLS_INS], int m, carom_row din[CAROM_BALLS_INS],
                                   carom_row dout[CAROM_BALLS_OUTS], carom_tangent_note *note);
void carom_mirror_balls_tangent(const double in[CAROM_BALLS_INS], int m, carom_row din[CAROM_BALLS_INS],
                                carom_row dout[CAROM_BALLS_OUTS]);
/* A slow contact, which parts at `slow` or less. */
void carom_slow_balls_tangent(const double in[CAROM_BALLS_INS], double slow, int m, carom_row din[CAROM_BALLS_INS],
                              carom_row dout[CAROM_BALLS_OUTS]);

/* ---- A ball and a cushion: numbers of the ball, then these. After: the five of the ball. ---- */
enum { NOSE_MU_S = CAROM_BALL_INS, NOSE_MU_W, NOSE_E, NOSE_SINE, NOSE_RATIO, CAROM_NOSE_INS };

/* By a model of carom_cushion() without convention of pooltool; opt->model and, for Euler's, its steps. mass: for Euler's least
 * step only. out: the motion after, as the model has it. */
carom_status carom_nose_tangent(const double in[CAROM_NOSE_INS], const carom_cushion_options *opt, int m,
                                carom_row din[CAROM_NOSE_INS], carom_row dout[CAROM_BALL_INS], double out[CAROM_BALL_INS],
                                carom_tangent_note *note);
/* A slow contact of a ball whose motion is in the order of `after`; changes it and its tangents. */
void carom_slow_nose_tangent(double motion[CAROM_BALL_INS], double slow, int m, carom_row d[CAROM_BALL_INS]);

/* ---- Between the table and the frame ---- */

/* One ball with its tangents: from (v_x, v_y, w) along the axes of the table, turned by the angle whose sine and cosine x = (c,
 * s) has, where the frame itself turns by dturn. rolls: the slip stays 0. dR: of the radius, or NULL. */
void carom_tangent_to_frame(const double v[3], const double w[3], double R, double c, double s, bool rolls, int m,
                            const double *dturn, const double *dR, carom_row dv[5], double number[CAROM_BALL_INS],
                            carom_row d[CAROM_BALL_INS]);
/* And back, from the numbers after to dv_x, dv_y, dw; v and w: after. */
void carom_tangent_from_frame(const double v[3], const double w[3], double R, double c, double s, int m, const double *dturn,
                              const double *dR, carom_row d[CAROM_BALL_INS], carom_row dv[5]);

#endif
