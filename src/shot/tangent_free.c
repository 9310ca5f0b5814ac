/* Tangents of impacts in space.
 *
 * FREE IMPACTS. All impacts here have a unit vector N, a speed v_n along it, a slip u across it, and impulses P along N and f
 * against u that depend on v_n, |u|, mu and e as those of a nose at the height of the centre do: sin(theta) = 0 in
 * cushion/tangent.h. Two balls are such an impact times B = 1/m_a + 1/m_b, for their relative motion; the slate is one whose e
 * is v'/v_n. So f, in two fixed directions across N, comes from there, and as f . N = 0
 *
 *     df = df_1 t_1 + df_2 t_2 - (f . dN) N
 *
 *     ball and nose   dv+ = dv - d(P N) + df                   dw+ = dw + d(5/(2R) N x f)
 *     two balls       dv_a+ = dv_a - d((P n - f)/(B m_a))      dw_a+ = dw_a + d(5/(2 B m_a R_a) n x f),  b with + in v */
#include "shot/tangent_free.h"
#include "cushion/tangent.h"

#include <math.h>
#include <string.h>

static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}
static void column(carom_row d[CAROM_STATE_NUMBERS], const int rows[3], int j, double to[3]) {
  for (int k = 0; k < 3; k++)
    to[k] = d[rows[k]][j];
}

void carom_touch_slip(carom_free_touch *t, const double v[3], const double spin[3]) {
  double turn[3];
  t->closing = carom_dot(v, t->at.N);
  cross(spin, t->at.N, turn);
  for (int k = 0; k < 3; k++)
    t->u[k] = v[k] - t->closing * t->at.N[k] + turn[k];
}
void carom_touch_slip_tangent(carom_free_touch *t, int j, const double v[3], const double spin[3], const double dv[3],
                              const double d_spin[3]) {
  const double dN[3] = {t->at.dN[0][j], t->at.dN[1][j], t->at.dN[2][j]};
  double turn[3], more[3];
  t->d_closing[j] = carom_dot(dv, t->at.N) + carom_dot(v, dN);
  cross(d_spin, t->at.N, turn);
  cross(spin, dN, more);
  for (int k = 0; k < 3; k++)
    t->du[k][j] = dv[k] - t->d_closing[j] * t->at.N[k] - t->closing * dN[k] + turn[k] + more[k];
}

carom_status carom_free_impulse(carom_free_touch *t, carom_cushion_model model, int m, carom_tangent_note *note) {
  /* across N: level, and the third */
  const double size = sqrt(t->at.N[0] * t->at.N[0] + t->at.N[1] * t->at.N[1]);
  const double across[3] = {size > 0.0 ? t->at.N[1] / size : 1.0, size > 0.0 ? -t->at.N[0] / size : 0.0, 0.0};
  double third[3];
  cross(across, t->at.N, third);
  /* v_x and W_x stand for the slip */
  const double u_1 = carom_dot(t->u, across), u_2 = carom_dot(t->u, third);
  const double in[CAROM_NOSE_INS] = {
      [OF_V_X] = u_1,      [OF_V_Y] = t->closing, [OF_C_X] = u_1,         [OF_C_Y] = t->closing + u_2,
      [NOSE_MU_W] = t->mu, [NOSE_E] = t->e,       [NOSE_RATIO] = t->ratio};
  double out[CAROM_BALL_INS];
  carom_row din[CAROM_NOSE_INS], dout[CAROM_BALL_INS];
  memset(din, 0, sizeof din);
  for (int j = 0; j < m; j++) {
    const double du[3] = {t->du[0][j], t->du[1][j], t->du[2][j]};
    din[OF_V_X][j] = din[OF_C_X][j] = carom_dot(du, across);
    din[OF_V_Y][j] = t->d_closing[j];
    din[OF_C_Y][j] = t->d_closing[j] + carom_dot(du, third);
    din[NOSE_MU_W][j] = t->d_mu[j];
    din[NOSE_E][j] = t->d_e[j];
    din[NOSE_RATIO][j] = t->d_ratio[j];
  }
  const carom_cushion_options options = {.model = model};
  const carom_status status = carom_nose_tangent(in, &options, m, din, dout, out, note);
  const double f_1 = out[OF_V_X] - u_1, f_2 = (out[OF_W_X] - u_2) / 2.5;
  t->P = t->closing - out[OF_V_Y];
  for (int k = 0; k < 3; k++)
    t->f[k] = f_1 * across[k] + f_2 * third[k];
  for (int j = 0; j < m; j++) {
    const double df_1 = dout[OF_V_X][j] - din[OF_V_X][j];
    const double df_2 = (dout[OF_W_X][j] - (din[OF_C_Y][j] - din[OF_V_Y][j])) / 2.5;
    const double dN[3] = {t->at.dN[0][j], t->at.dN[1][j], t->at.dN[2][j]}, back = carom_dot(t->f, dN);
    t->dP[j] = t->d_closing[j] - dout[OF_V_Y][j];
    for (int k = 0; k < 3; k++)
      t->df[k][j] = df_1 * across[k] + df_2 * third[k] - back * t->at.N[k];
  }
  return status;
}

void carom_free_torque(const carom_free_touch *t, int j, double there[3], double d[3]) {
  const double dN[3] = {t->at.dN[0][j], t->at.dN[1][j], t->at.dN[2][j]}, df[3] = {t->df[0][j], t->df[1][j], t->df[2][j]};
  double more[3];
  cross(t->at.N, t->f, there);
  cross(dN, t->f, d);
  cross(t->at.N, df, more);
  for (int k = 0; k < 3; k++)
    d[k] += more[k];
}

void carom_take_free(carom_tangent_work *w, const carom_tangent_ball *ball, const carom_free_touch *t) {
  const double R = ball->kind->radius;
  for (int j = 0; j < w->m; j++) {
    const double shrinks = -carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j) / R;
    double turn[3], d_turn[3];
    carom_free_torque(t, j, turn, d_turn);
    for (int k = 0; k < 3; k++) {
      w->d[0][CAROM_S_V[k]][j] += t->df[k][j] - t->dP[j] * t->at.N[k] - t->P * t->at.dN[k][j];
      w->d[0][CAROM_S_W[k]][j] += 2.5 / R * (d_turn[k] + shrinks * turn[k]);
    }
  }
}

void carom_touch_alone(carom_tangent_work *w, const carom_tangent_ball *ball, const carom_ball_state *s, carom_free_touch *t) {
  const double R = ball->kind->radius, spin[3] = {R * s->w[0], R * s->w[1], R * s->w[2]};
  carom_touch_slip(t, s->v, spin);
  for (int j = 0; j < w->m; j++) {
    const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j);
    double dv[3], d_spin[3];
    column(w->d[0], CAROM_S_V, j, dv);
    column(w->d[0], CAROM_S_W, j, d_spin);
    for (int k = 0; k < 3; k++)
      d_spin[k] = R * d_spin[k] + dR * s->w[k];
    carom_touch_slip_tangent(t, j, s->v, spin, dv, d_spin);
  }
}
