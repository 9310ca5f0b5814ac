/* Tangents of a ball's motion from the axes of the table to the frame of a contact, and back: tangent.h.
 *
 * x = (c, s) and y = (-s, c), which turn by dturn: d(v . x) = x . dv + dturn v_y, d(v . y) = y . dv - dturn v_x. */
#include "impact/tangent.h"

void carom_tangent_to_frame(const double v[3], const double w[3], double R, double c, double s, bool rolls, int m,
                            const double *dturn, const double *dR, carom_row dv[5], double number[CAROM_BALL_INS],
                            carom_row d[CAROM_BALL_INS]) {
  const double v_x = c * v[0] + s * v[1], v_y = c * v[1] - s * v[0];
  const double W_x = R * (c * w[0] + s * w[1]), W_y = R * (c * w[1] - s * w[0]), W_z = R * w[2];
  number[OF_V_X] = v_x;
  number[OF_V_Y] = v_y;
  number[OF_C_X] = rolls ? 0.0 : v_x - W_y;
  number[OF_C_Y] = rolls ? 0.0 : v_y + W_x;
  number[OF_W_Z] = W_z;
  for (int j = 0; j < m; j++) {
    const double grows = dR != NULL ? dR[j] / R : 0.0, turn = dturn[j];
    const double dv_x = c * dv[0][j] + s * dv[1][j] + turn * v_y, dv_y = c * dv[1][j] - s * dv[0][j] - turn * v_x;
    const double dW_x = R * (c * dv[2][j] + s * dv[3][j]) + turn * W_y + grows * W_x;
    const double dW_y = R * (c * dv[3][j] - s * dv[2][j]) - turn * W_x + grows * W_y;
    d[OF_V_X][j] = dv_x;
    d[OF_V_Y][j] = dv_y;
    d[OF_C_X][j] = rolls ? 0.0 : dv_x - dW_y;
    d[OF_C_Y][j] = rolls ? 0.0 : dv_y + dW_x;
    d[OF_W_Z][j] = R * dv[4][j] + grows * W_z;
  }
}

void carom_tangent_from_frame(const double v[3], const double w[3], double R, double c, double s, int m, const double *dturn,
                              const double *dR, carom_row d[CAROM_BALL_INS], carom_row dv[5]) {
  const double v_x = c * v[0] + s * v[1], v_y = c * v[1] - s * v[0];
  const double W_x = R * (c * w[0] + s * w[1]), W_y = R * (c * w[1] - s * w[0]), W_z = R * w[2];
  for (int j = 0; j < m; j++) {
    const double grows = dR != NULL ? dR[j] / R : 0.0, turn = dturn[j];
    const double dv_x = d[OF_V_X][j] - turn * v_y, dv_y = d[OF_V_Y][j] + turn * v_x;
    const double dW_x = d[OF_W_X][j] - turn * W_y - grows * W_x, dW_y = d[OF_W_Y][j] + turn * W_x - grows * W_y;
    dv[0][j] = c * dv_x - s * dv_y;
    dv[1][j] = s * dv_x + c * dv_y;
    dv[2][j] = (c * dW_x - s * dW_y) / R;
    dv[3][j] = (s * dW_x + c * dW_y) / R;
    dv[4][j] = (d[OF_W_Z][j] - grows * W_z) / R;
  }
}
