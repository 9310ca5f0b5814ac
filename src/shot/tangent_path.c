/* Tangents of the motion between events.
 *
 * Let d be the tangent at a fixed time. With tau the time since the start, s = mu_s g, u the slip at the start, e = u/|u| and c
 * = s e (rolling: u -> v0, s -> mu_r g),
 *
 *     de = (du - e (e . du))/|u|      dc = ds e + s de      dr = dr0 + tau dv0 - tau^2/2 dc      dv = dv0 - tau dc
 *     sliding    du = dv0 + (-d(R w_y), d(R w_x)),  q = 5 s tau/(2R),  d(w_x, w_y) = d(w_x, w_y)0 + (-d(q e_y), d(q e_x))
 *     rolling    d(w_x, w_y) = d((-v_y, v_x)/R)
 *     w_z        dw_z0 - sign(w_z) tau d(5 mu_sp g/(2R)) while it turns; then 0
 *     airborne   dr = dr0 + tau dv0 - tau^2/2 dg z,  dv = dv0 - tau dg z; on the cloth dz = dR
 *
 * DRAG. A rolling ball with drag k slows by A + k v^2, A = mu_r g. Its speed v(tau) along e obeys
 *
 *     dv = (A + k v^2) [dv0/(A + k v0^2) - int (dA + dk v^2)/(A + k v^2) dtau],     ds = int dv dtau,
 *
 * by Gauss quadrature over the exact v, which the pieces of path.h follow to 1e-6 m; the direction turns by de, and with it
 * the way.
 *
 * The motion does not depend on when it starts, so tangents at a fixed time after an event are those of all later times: an
 * event at the time T with total tangents dx+ leaves d = dx+ - x' dT. */
#include "shot/tangent_path.h"

#include "platform/elementary.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Gauss's nodes and weights on [0, 1]. */
enum { NODES = 5 };
static const double NODE[NODES] = {0.046910077030668004, 0.23076534494715845, 0.5, 0.7692346550528415, 0.953089922969332};
static const double WEIGHT[NODES] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                     0.11846344252809454};

/* The exact speed of a rolling ball with drag after tau. */
static double speed_at(double v0, double A, double k, double tau) {
  const double x = sqrt(A * k);
  if (x * tau < 1e-9) /* no drag worth the name */
    return fmax(v0 - A * tau, 0.0);
  double sine, cosine;
  carom_sincos(x * tau, &sine, &cosine);
  const double t = sine / cosine, ratio = sqrt(k / A);
  return fmax((v0 - t / ratio) / (1.0 + v0 * ratio * t), 0.0);
}

/* dv and ds of the drag, in one direction: coefficients of dv0, dA and dk. */
typedef struct drag_row {
  double v[3], s[3];
} drag_row;

static drag_row drag_of(double v0, double A, double k, double tau) {
  drag_row d = {{0}, {0}};
  double I_A = 0, I_k = 0;
  /* for ds: dv at the nodes, each by quadrature up to there */
  for (int n = 0; n <= NODES; n++) {
    const double t = n < NODES ? tau * NODE[n] : tau, v = speed_at(v0, A, k, t), slows = A + k * v * v;
    I_A = I_k = 0;
    for (int i = 0; i < NODES; i++) {
      const double w = speed_at(v0, A, k, t * NODE[i]), per = t * WEIGHT[i] / (A + k * w * w);
      I_A += per;
      I_k += per * w * w;
    }
    const double dv[3] = {slows / (A + k * v0 * v0), -slows * I_A, -slows * I_k};
    for (int r = 0; r < 3; r++)
      if (n < NODES)
        d.s[r] += tau * WEIGHT[n] * dv[r];
      else
        d.v[r] = dv[r];
  }
  return d;
}

void carom_tangent_flow(const carom_tangent_ball *ball, double time, int m, double rate[CAROM_STATE_NUMBERS],
                        carom_row d[CAROM_STATE_NUMBERS]) {
  const carom_ball_state *from = &ball->path.from;
  const carom_ball_kind *kind = ball->kind;
  const double R = kind->radius, g = kind->gravity, tau = fmax(time - ball->path.start, 0.0);
  memset(rate, 0, CAROM_STATE_NUMBERS * sizeof *rate);
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    memcpy(d[k], ball->d + k * m, sizeof(double) * (size_t)m);
  if (from->label == CAROM_BALL_STATIONARY || carom_is_out(from->label))
    return;
  if (carom_flies(from)) {
    rate[S_X] = from->v[0];
    rate[S_Y] = from->v[1];
    rate[S_Z] = from->v[2] - tau * g;
    rate[S_V_Z] = -g;
    for (int j = 0; j < m; j++) {
      const double dg = carom_d_kind(ball, CAROM_KIND_ROW(gravity), m, j);
      d[S_X][j] += tau * d[S_V_X][j];
      d[S_Y][j] += tau * d[S_V_Y][j];
      d[S_Z][j] += tau * (d[S_V_Z][j] - 0.5 * tau * dg);
      d[S_V_Z][j] -= tau * dg;
    }
    return;
  }
  /* the spin about the vertical, which may have come to an end on the way; the end of a phase is not yet one */
  const double fall = 2.5 * kind->mu_spin * g / R, sign = from->w[2] > 0.0 ? 1.0 : -1.0;
  if (fabs(from->w[2]) <= fall * tau && from->label != CAROM_BALL_SPINNING) {
    memset(d[S_W_Z], 0, sizeof(double) * (size_t)m);
  } else {
    rate[S_W_Z] = -sign * fall;
    for (int j = 0; j < m && ball->d_kind != NULL; j++)
      d[S_W_Z][j] -= sign * tau * 2.5 / R *
                     (carom_d_kind(ball, CAROM_KIND_ROW(mu_spin), m, j) * g +
                      kind->mu_spin * (carom_d_kind(ball, CAROM_KIND_ROW(gravity), m, j) -
                                       g / R * carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j)));
  }
  if (from->label == CAROM_BALL_SPINNING)
    return;
  /* the direction of the friction, and the deceleration */
  const bool slides = from->label == CAROM_BALL_SLIDING;
  double x = from->v[0], y = from->v[1];
  if (slides) {
    x -= R * from->w[1];
    y += R * from->w[0];
  }
  const double U = sqrt(x * x + y * y), mu = slides ? kind->mu_slide : kind->mu_roll, s = mu * g;
  if (!(U > 0.0))
    return;
  const double e_x = x / U, e_y = y / U, k = kind->drag;
  const bool drags = !slides && k * U * U > 1e-16 * s;
  double v_end = U - s * tau, way = tau * (U - 0.5 * s * tau), slows = s;
  drag_row drag = {{0}, {0}};
  if (drags) {
    drag = drag_of(U, s, k, tau);
    v_end = speed_at(U, s, k, tau);
    slows = s + k * v_end * v_end;
    way = 0.0;
    for (int n = 0; n < NODES; n++)
      way += tau * WEIGHT[n] * speed_at(U, s, k, tau * NODE[n]);
  }
  const double v_x = slides ? from->v[0] - tau * s * e_x : v_end * e_x, v_y = slides ? from->v[1] - tau * s * e_y : v_end * e_y;
  rate[S_X] = v_x;
  rate[S_Y] = v_y;
  rate[S_V_X] = -slows * e_x;
  rate[S_V_Y] = -slows * e_y;
  const double q = 2.5 * s * tau / R;
  for (int j = 0; j < m; j++) {
    const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j), dg = carom_d_kind(ball, CAROM_KIND_ROW(gravity), m, j);
    const double dmu = carom_d_kind(ball, slides ? CAROM_KIND_ROW(mu_slide) : CAROM_KIND_ROW(mu_roll), m, j);
    const double dv_x = d[S_V_X][j], dv_y = d[S_V_Y][j];
    double du_x = dv_x, du_y = dv_y;
    if (slides) {
      du_x -= dR * from->w[1] + R * d[S_W_Y][j];
      du_y += dR * from->w[0] + R * d[S_W_X][j];
    }
    const double along = e_x * du_x + e_y * du_y, de_x = (du_x - e_x * along) / U, de_y = (du_y - e_y * along) / U;
    const double ds = dmu * g + mu * dg;
    if (drags) {
      const double dk = carom_d_kind(ball, CAROM_KIND_ROW(drag), m, j);
      const double dv = drag.v[0] * along + drag.v[1] * ds + drag.v[2] * dk;
      const double d_way = drag.s[0] * along + drag.s[1] * ds + drag.s[2] * dk;
      d[S_X][j] += d_way * e_x + way * de_x;
      d[S_Y][j] += d_way * e_y + way * de_y;
      d[S_V_X][j] = dv * e_x + v_end * de_x;
      d[S_V_Y][j] = dv * e_y + v_end * de_y;
    } else {
      const double dc_x = ds * e_x + s * de_x, dc_y = ds * e_y + s * de_y;
      d[S_X][j] += tau * dv_x - 0.5 * tau * tau * dc_x;
      d[S_Y][j] += tau * dv_y - 0.5 * tau * tau * dc_y;
      d[S_V_X][j] -= tau * dc_x;
      d[S_V_Y][j] -= tau * dc_y;
    }
    if (slides) {
      const double dq = 2.5 * tau * (ds / R - s * dR / (R * R));
      d[S_W_X][j] -= dq * e_y + q * de_y;
      d[S_W_Y][j] += dq * e_x + q * de_x;
    } else {
      d[S_W_X][j] = -d[S_V_Y][j] / R + v_y * dR / (R * R);
      d[S_W_Y][j] = d[S_V_X][j] / R - v_x * dR / (R * R);
    }
  }
  if (slides) {
    rate[S_W_X] = -2.5 * s / R * e_y;
    rate[S_W_Y] = 2.5 * s / R * e_x;
  } else {
    rate[S_W_X] = -rate[S_V_Y] / R;
    rate[S_W_Y] = rate[S_V_X] / R;
  }
}

void carom_tangent_end(const carom_tangent_ball *ball, int m, carom_row d[CAROM_STATE_NUMBERS], double *d_time) {
  const carom_ball_state *from = &ball->path.from;
  const carom_ball_kind *kind = ball->kind;
  const double R = kind->radius, g = kind->gravity;
  if (from->label == CAROM_BALL_SPINNING) {
    const double fall = 2.5 * kind->mu_spin * g / R, sign = from->w[2] > 0.0 ? 1.0 : -1.0;
    for (int j = 0; j < m; j++)
      d_time[j] = sign * d[S_W_Z][j] / fall;
    return;
  }
  /* where the slip, or the speed, along e becomes 0; w: at the end, as the radius changes what a spin is worth */
  const bool slides = from->label == CAROM_BALL_SLIDING;
  double x = from->v[0], y = from->v[1];
  if (slides) {
    x -= R * from->w[1];
    y += R * from->w[0];
  }
  const double U = sqrt(x * x + y * y), e_x = x / U, e_y = y / U, s = (slides ? kind->mu_slide : kind->mu_roll) * g;
  const double tau = 2.0 * U / (7.0 * s), turn = 2.5 * s * tau / R;
  for (int j = 0; j < m; j++) {
    double along = e_x * d[S_V_X][j] + e_y * d[S_V_Y][j];
    if (slides) {
      const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
      const double w_x = from->w[0] - turn * e_y, w_y = from->w[1] + turn * e_x;
      along += e_y * (R * d[S_W_X][j] + dR * w_x) - e_x * (R * d[S_W_Y][j] + dR * w_y);
    }
    d_time[j] = along / (slides ? 3.5 * s : s);
  }
}

void carom_tangent_settle(const carom_ball_state *state, const carom_tangent_ball *ball, int m,
                          carom_row d[CAROM_STATE_NUMBERS]) {
  const double R = ball->kind->radius;
  const int64_t label = state->label;
  if (label == CAROM_BALL_AIRBORNE)
    return;
  memset(d[S_V_Z], 0, sizeof(double) * (size_t)m);
  for (int j = 0; j < m && !carom_is_out(label); j++)
    d[S_Z][j] = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
  if (label == CAROM_BALL_SLIDING)
    return;
  if (label != CAROM_BALL_ROLLING) {
    for (int k = S_V_X; k <= (label == CAROM_BALL_SPINNING ? S_W_Y : S_W_Z); k++)
      memset(d[k], 0, sizeof(double) * (size_t)m);
    return;
  }
  /* a slip that a change brings about lasts for an infinitely short time, after which it has become speed */
  for (int j = 0; j < m; j++) {
    const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
    d[S_V_X][j] -= 2.0 / 7.0 * (d[S_V_X][j] - dR * state->w[1] - R * d[S_W_Y][j]);
    d[S_V_Y][j] -= 2.0 / 7.0 * (d[S_V_Y][j] + dR * state->w[0] + R * d[S_W_X][j]);
    d[S_W_X][j] = -d[S_V_Y][j] / R + state->v[1] * dR / (R * R);
    d[S_W_Y][j] = d[S_V_X][j] / R - state->v[0] * dR / (R * R);
  }
}
