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
#ifndef CAROM_SRC_IMPACT_TANGENT_H
#define CAROM_SRC_IMPACT_TANGENT_H

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
