/* Derivatives of the impact on a cushion: of carom_cushion(), and in the frame of the contact by each model of a shot.
 *
 * MATHAVAN. The impulses are v_y times functions of the slips over v_y, of the frictions, e and sin(theta), whose derivatives
 * src/impact has; carom_push() is linear in them, with coefficients of theta.
 *
 * HAN and MIRROR are closed forms (closed.c), differentiated line by line. STRONGE changes the
 * slip at the nose to v_n S(rho, mu, e, ratio), rho = |slip|/v_n: the four derivatives of S are central differences of order 4
 * of the closed form, whose error is about 1e-11. EULER's steps are differentiated by central differences of the whole impact.
 */
#include "cushion/tangent.h"
#include "cushion/models.h"
#include "impact/variation.h"
#include "platform/elementary.h"

#include <math.h>
#include <string.h>

static const double NOTHING = 1e-9; /* relative distance from a kink that counts as on it */

/* The contact of contact.h from the numbers before. */
static carom_contact contact_of(const double in[CAROM_NOSE_INS]) {
  const double sine = in[NOSE_SINE];
  return (carom_contact){.v_x = in[OF_V_X],
                         .v_y = in[OF_V_Y],
                         .W_x = in[OF_C_Y] - in[OF_V_Y],
                         .W_y = in[OF_V_X] - in[OF_C_X],
                         .W_z = in[OF_W_Z],
                         .sine = sine,
                         .cosine = sqrt((1 - sine) * (1 + sine)),
                         .mu_s = in[NOSE_MU_S],
                         .mu_w = in[NOSE_MU_W],
                         .e = in[NOSE_E]};
}

/* Tangents of a contact, and of what follows from it, in one direction. */
typedef struct d_contact {
  double v_x, v_y, W_x, W_y, W_z, sine, cosine, mu_s, mu_w, e, s_x, s_t;
} d_contact;

static d_contact d_contact_of(const carom_contact *c, carom_row din[CAROM_NOSE_INS], int j) {
  d_contact d = {.v_x = din[OF_V_X][j],
                 .v_y = din[OF_V_Y][j],
                 .W_x = din[OF_C_Y][j] - din[OF_V_Y][j],
                 .W_y = din[OF_V_X][j] - din[OF_C_X][j],
                 .W_z = din[OF_W_Z][j],
                 .sine = din[NOSE_SINE][j],
                 .mu_s = din[NOSE_MU_S][j],
                 .mu_w = din[NOSE_MU_W][j],
                 .e = din[NOSE_E][j]};
  d.cosine = -c->sine / c->cosine * d.sine;
  d.s_x = d.v_x + d.W_y * c->sine + c->W_y * d.sine - d.W_z * c->cosine - c->W_z * d.cosine;
  d.s_t = d.W_x - d.v_y * c->sine - c->v_y * d.sine;
  return d;
}

/* carom_push(), with the motion before it: *c is the contact before. */
static void push(const carom_contact *c, const d_contact *d, const carom_impulse *q, const carom_impulse *dq, int j,
                 carom_row dout[CAROM_BALL_INS]) {
  dout[OF_V_X][j] = d->v_x + dq->f_x + dq->F_x;
  dout[OF_V_Y][j] = d->v_y + dq->F_y - dq->P * c->cosine - q->P * d->cosine - dq->f_t * c->sine - q->f_t * d->sine;
  dout[OF_W_X][j] = d->W_x + 2.5 * (dq->f_t + dq->F_y);
  dout[OF_W_Y][j] = d->W_y + 2.5 * (dq->f_x * c->sine + q->f_x * d->sine - dq->F_x);
  dout[OF_W_Z][j] = d->W_z - 2.5 * (dq->f_x * c->cosine + q->f_x * d->cosine);
}

static void motion_of(const carom_contact *c, double out[CAROM_BALL_INS]) {
  out[OF_V_X] = c->v_x;
  out[OF_V_Y] = c->v_y;
  out[OF_W_X] = c->W_x;
  out[OF_W_Y] = c->W_y;
  out[OF_W_Z] = c->W_z;
}

static carom_status mathavan(const double in[CAROM_NOSE_INS], int plain, int m, carom_row din[CAROM_NOSE_INS],
                             carom_row dout[CAROM_BALL_INS], double out[CAROM_BALL_INS], carom_tangent_note *note) {
  carom_contact c = contact_of(in);
  const double sine = c.sine, cosine = c.cosine, V = c.v_y;
  /* the law of mathavan.c, and its derivative by the sine */
  const carom_law law = {.A_0 = sine * cosine,
                         .K_x = 3.5,
                         .K_y = 2.5 + sine * sine,
                         .C_x = 1 - 2.5 * sine,
                         .C_y = 2.5 - sine,
                         .B_0 = -cosine,
                         .L_x = 1 - 2.5 * sine,
                         .L_y = 2.5 - sine,
                         .H = 3.5,
                         .g_0 = sine,
                         .g_1 = -cosine,
                         .V_0 = -cosine,
                         .V_f = -sine,
                         .V_F = 1,
                         .mu = c.mu_w,
                         .mu_c = c.mu_s,
                         .e = c.e};
  const double d_cosine = -sine / cosine;
  const carom_law d_law = {.A_0 = cosine + sine * d_cosine,
                           .K_y = 2 * sine,
                           .C_x = -2.5,
                           .C_y = -1,
                           .B_0 = -d_cosine,
                           .L_x = -2.5,
                           .L_y = -1,
                           .g_0 = 1,
                           .g_1 = -d_cosine,
                           .V_0 = -d_cosine,
                           .V_f = -1};
  const double slips[4] = {carom_slip_x(&c) / V, carom_slip_t(&c) / V, in[OF_C_X] / V, in[OF_C_Y] / V};
  /* the variables in each direction */
  carom_row by[CAROM_VARIABLES];
  unsigned asked = 0;
  for (int j = 0; j < m; j++) {
    const d_contact d = d_contact_of(&c, din, j);
    const double d_slips[4] = {d.s_x, d.s_t, din[OF_C_X][j], din[OF_C_Y][j]};
    for (int k = 0; k < 4; k++)
      by[k][j] = (d_slips[k] - slips[k] * d.v_y) / V;
    by[BY_MU][j] = d.mu_w;
    by[BY_MU_C][j] = d.mu_s;
    by[BY_E][j] = d.e;
    by[BY_LAMBDA][j] = d.sine;
    for (int k = 0; k < CAROM_VARIABLES; k++)
      asked |= (unsigned)(by[k][j] != 0) << k;
  }
  carom_impact_tangent t;
  const carom_status status = carom_impact_differentiate(&law, &d_law, slips, plain, asked, &t);
  if (status != CAROM_OK)
    return status;
  note->flags |= (t.kink ? CAROM_TANGENT_KINK : 0) | (t.differences ? CAROM_TANGENT_DIFFERENCES : 0);
  note->error = fmax(note->error, t.error);
  const carom_impulse q = {.P = V * t.q.p, .f_x = V * t.q.f_x, .f_t = V * t.q.f_y, .F_x = V * t.q.F_x, .F_y = V * t.q.F_y};
  for (int j = 0; j < m; j++) {
    const d_contact d = d_contact_of(&c, din, j);
    double g[5];
    for (int i = 0; i < 5; i++) {
      double sum = 0;
      for (int k = 0; k < CAROM_VARIABLES; k++)
        if (by[k][j] != 0)
          sum += t.d[i][k] * by[k][j];
      g[i] = V * sum;
    }
    const double per = d.v_y / V;
    const carom_impulse dq = {.P = g[0] + per * q.P,
                              .f_x = g[1] + per * q.f_x,
                              .f_t = g[2] + per * q.f_t,
                              .F_x = g[3] + per * q.F_x,
                              .F_y = g[4] + per * q.F_y};
    push(&c, &d, &q, &dq, j, dout);
  }
  carom_push(&c, &q);
  motion_of(&c, out);
  return CAROM_OK;
}

static void han(const double in[CAROM_NOSE_INS], int m, carom_row din[CAROM_NOSE_INS], carom_row dout[CAROM_BALL_INS],
                double out[CAROM_BALL_INS], carom_tangent_note *note) {
  carom_contact c = contact_of(in);
  const double s_x = carom_slip_x(&c), s_t = carom_slip_t(&c), slip = sqrt(s_x * s_x + s_t * s_t);
  const double P = (1 + c.e) * (c.v_y * c.cosine), most = c.mu_w * P;
  const bool sticks = slip <= 3.5 * most;
  const double share = sticks ? 2.0 / 7.0 : most / slip;
  const carom_impulse q = {.P = P, .f_x = -share * s_x, .f_t = -share * s_t};
  if (fabs(slip - 3.5 * most) < NOTHING * slip)
    note->flags |= CAROM_TANGENT_KINK;
  for (int j = 0; j < m; j++) {
    const d_contact d = d_contact_of(&c, din, j);
    const double d_P = d.e * c.v_y * c.cosine + (1 + c.e) * (d.v_y * c.cosine + c.v_y * d.cosine);
    const double d_most = d.mu_w * P + c.mu_w * d_P;
    const double d_share = sticks ? 0 : (d_most - share * (s_x * d.s_x + s_t * d.s_t) / slip) / slip;
    const carom_impulse dq = {.P = d_P, .f_x = -d_share * s_x - share * d.s_x, .f_t = -d_share * s_t - share * d.s_t};
    push(&c, &d, &q, &dq, j, dout);
  }
  carom_push(&c, &q);
  motion_of(&c, out);
}

static void mirror(const double in[CAROM_NOSE_INS], int m, carom_row din[CAROM_NOSE_INS], carom_row dout[CAROM_BALL_INS],
                   double out[CAROM_BALL_INS]) {
  carom_contact c = contact_of(in);
  for (int j = 0; j < m; j++) {
    const d_contact d = d_contact_of(&c, din, j);
    dout[OF_V_X][j] = d.v_x;
    dout[OF_V_Y][j] = -c.e * d.v_y - d.e * c.v_y;
    dout[OF_W_X][j] = d.W_x;
    dout[OF_W_Y][j] = d.W_y;
    dout[OF_W_Z][j] = d.W_z;
  }
  carom_mirror(&c);
  motion_of(&c, out);
}

/* ---- Stronge */

/* S of the head of this file: of an impact at v_n = 1 with the slip rho along x alone. */
static double slip_after(const double x[4]) {
  carom_contact c = {.v_x = x[0], .v_y = 1, .cosine = 1, .mu_w = x[1], .e = x[2]};
  carom_stronge(&c, x[3], 0);
  return carom_slip_x(&c);
}

/* The derivative of S by variable k, by central differences of order 4; *error: what orders 2 and 4 differ by. */
static double d_slip_after(const double x[4], int k, double *error) {
  static const double steps[4] = {-2, -1, 1, 2};
  double best = INFINITY, found = 0;
  for (double h = 1e-3 * fmax(fabs(x[k]), 1e-6); best > 1e-6 && h > 1e-6 * fabs(x[k]); h /= 8) {
    double f[4];
    for (int s = 0; s < 4; s++) {
      double there[4] = {x[0], x[1], x[2], x[3]};
      there[k] += steps[s] * h;
      f[s] = slip_after(there);
    }
    const double near = (f[2] - f[1]) / (2 * h), far = (f[3] - f[0]) / (4 * h),
                 apart = fabs(near - far) / (3 * fmax(1, fabs(near)));
    if (apart < best) {
      best = apart;
      found = (4 * near - far) / 3;
    }
  }
  *error = fmax(*error, best);
  return found;
}

static void stronge(const double in[CAROM_NOSE_INS], int m, carom_row din[CAROM_NOSE_INS], carom_row dout[CAROM_BALL_INS],
                    double out[CAROM_BALL_INS], carom_tangent_note *note) {
  carom_contact c = contact_of(in);
  const double s_x = carom_slip_x(&c), s_t = carom_slip_t(&c), slip = sqrt(s_x * s_x + s_t * s_t), v_n = c.v_y * c.cosine;
  const double rho = slip / v_n, x[4] = {rho, c.mu_w, c.e, in[NOSE_RATIO]};
  /* share = (1 - S / rho) (2/7); without slip there is no direction, and S is proportional to rho */
  double by[4] = {0}, error = 0;
  const double S = slip > 0 ? slip_after(x) : 0, share = slip > 0 ? (1 - S / rho) / 3.5 : 0;
  for (int k = 0; k < 4 && slip > 0; k++)
    by[k] = d_slip_after(x, k, &error);
  note->flags |= CAROM_TANGENT_DIFFERENCES | (slip > 0 && error < 1e-4 ? 0 : CAROM_TANGENT_KINK);
  note->error = fmax(note->error, error);
  const carom_impulse q = {.P = (1 + c.e) * v_n, .f_x = -share * s_x, .f_t = -share * s_t};
  for (int j = 0; j < m; j++) {
    const d_contact d = d_contact_of(&c, din, j);
    const double d_v_n = d.v_y * c.cosine + c.v_y * d.cosine;
    double d_share = 0;
    if (slip > 0) {
      const double d_rho = ((s_x * d.s_x + s_t * d.s_t) / slip - rho * d_v_n) / v_n;
      const double d_S = by[0] * d_rho + by[1] * d.mu_w + by[2] * d.e + by[3] * din[NOSE_RATIO][j];
      d_share = -(d_S - S / rho * d_rho) / (rho * 3.5);
    }
    const carom_impulse dq = {
        .P = d.e * v_n + (1 + c.e) * d_v_n, .f_x = -d_share * s_x - share * d.s_x, .f_t = -d_share * s_t - share * d.s_t};
    push(&c, &d, &q, &dq, j, dout);
  }
  carom_push(&c, &q);
  motion_of(&c, out);
}

/* ---- Euler's steps */

static carom_status euler_at(const double in[CAROM_NOSE_INS], const carom_cushion_options *opt, double out[CAROM_BALL_INS]) {
  carom_contact c = contact_of(in);
  carom_cushion_run run;
  const carom_status status = carom_cushion_euler(&c, carom_cushion_steps(opt), 0, 0, INT64_MAX, &run);
  motion_of(&c, out);
  return status;
}

/* Central differences of order 2 by each number with a seed; by a constant that is 0, forward ones. */
static carom_status euler(const double in[CAROM_NOSE_INS], const carom_cushion_options *opt, int m,
                          carom_row din[CAROM_NOSE_INS], carom_row dout[CAROM_BALL_INS], double out[CAROM_BALL_INS],
                          carom_tangent_note *note) {
  carom_status status = euler_at(in, opt, out);
  for (int r = 0; r < CAROM_BALL_INS; r++)
    memset(dout[r], 0, sizeof(double) * (size_t)m);
  for (int k = 0; k < NOSE_RATIO && status == CAROM_OK; k++) {
    bool any = false;
    for (int j = 0; j < m; j++)
      any |= din[k][j] != 0;
    if (!any)
      continue;
    double there[CAROM_NOSE_INS], more[CAROM_BALL_INS], less[CAROM_BALL_INS];
    const bool forward = k >= CAROM_BALL_INS && in[k] == 0;
    const double h = k < CAROM_BALL_INS ? 1e-3 * in[OF_V_Y] : forward ? 1e-4 : fmin(1e-4, 0.5 * fabs(in[k]));
    memcpy(there, in, sizeof there);
    there[k] = in[k] + h;
    status = euler_at(there, opt, more);
    there[k] = forward ? 0 : in[k] - h;
    if (status == CAROM_OK)
      status = euler_at(there, opt, less);
    for (int r = 0; r < CAROM_BALL_INS; r++)
      for (int j = 0; j < m; j++)
        dout[r][j] += (more[r] - less[r]) / (forward ? h : 2 * h) * din[k][j];
  }
  note->flags |= CAROM_TANGENT_EULER | CAROM_TANGENT_DIFFERENCES | CAROM_TANGENT_KINK; /* steps are counted in whole numbers */
  return status;
}

carom_status carom_nose_tangent(const double in[CAROM_NOSE_INS], const carom_cushion_options *opt, int m,
                                carom_row din[CAROM_NOSE_INS], carom_row dout[CAROM_BALL_INS], double out[CAROM_BALL_INS],
                                carom_tangent_note *note) {
  carom_status status = CAROM_OK;
  switch (opt->model) {
  case CAROM_CUSHION_MATHAVAN:
    return mathavan(in, opt->plain, m, din, dout, out, note);
  case CAROM_CUSHION_STRONGE:
    stronge(in, m, din, dout, out, note);
    break;
  case CAROM_CUSHION_HAN:
    han(in, m, din, dout, out, note);
    break;
  case CAROM_CUSHION_MIRROR:
    mirror(in, m, din, dout, out);
    break;
  case CAROM_CUSHION_EULER:
    status = euler(in, opt, m, din, dout, out, note);
    break;
  }
  return status;
}

/* ---- The public call ---- */

/* Han's fits in place of restitution and friction, with their tangents: carom_apply_han(). */
static void apply_han(double in[CAROM_NOSE_INS], int m, carom_row din[CAROM_NOSE_INS]) {
  carom_contact c = contact_of(in);
  const double v = c.v_y, size = c.v_x * c.v_x + v * v;
  carom_apply_han(&c);
  in[NOSE_E] = c.e;
  in[NOSE_MU_W] = c.mu_w;
  for (int j = 0; j < m; j++) {
    const double dv = din[OF_V_Y][j], d_aside = c.v_x < 0 ? -din[OF_V_X][j] : din[OF_V_X][j];
    const double turns = (v * d_aside - fabs(c.v_x) * dv) / size;
    din[NOSE_E][j] = c.e > 0 && c.e < 1 ? (0.257 - 0.088 * v) * dv : 0;
    din[NOSE_MU_W][j] = c.mu_w > 0 && c.mu_w < 1 ? -0.241 * turns : 0;
  }
}

static carom_status differentiate(const carom_cushion_impact *in, const carom_cushion_options *opt, const carom_motion *after,
                                  size_t m, const double *seeds, double *tangent, carom_tangent_note *note) {
  carom_row din[CAROM_NOSE_INS], dout[CAROM_BALL_INS], dv[5], turn, dR;
  double number[CAROM_NOSE_INS], out[CAROM_BALL_INS];
  const carom_cushion_frame frame = carom_cushion_frame_of(in);
  const double R = in->radius, c = frame.y_y, s = -frame.y_x;
  const double length = sqrt(in->normal[0] * in->normal[0] + in->normal[1] * in->normal[1]);
  for (size_t j = 0; j < m; j++) {
    turn[j] = -(c * seeds[6 * m + j] + s * seeds[7 * m + j]) / length;
    dR[j] = seeds[9 * m + j];
    din[NOSE_SINE][j] = seeds[8 * m + j] / R - in->height / (R * R) * dR[j];
    din[NOSE_MU_S][j] = seeds[11 * m + j];
    din[NOSE_MU_W][j] = seeds[12 * m + j];
    din[NOSE_E][j] = seeds[13 * m + j];
    din[NOSE_RATIO][j] = 0;
  }
  static const int from[5] = {0, 1, 3, 4, 5};
  for (int k = 0; k < 5; k++)
    memcpy(dv[k], seeds + (size_t)from[k] * m, m * sizeof(double));
  number[NOSE_MU_S] = in->mu_cloth;
  number[NOSE_MU_W] = in->mu_cushion;
  number[NOSE_E] = in->restitution;
  number[NOSE_SINE] = (in->height - R) / R;
  number[NOSE_RATIO] = opt->omega_ratio > 0 ? opt->omega_ratio : 1.8;
  const double u_x = in->v[0] - R * in->w[1], u_y = in->v[1] + R * in->w[0];
  const bool rolls = fmax(fabs(u_x), fabs(u_y)) <= 1e-12;
  carom_tangent_to_frame(in->v, in->w, R, c, s, rolls, (int)m, turn, dR, dv, number, din);
  if (opt->law == CAROM_CUSHION_LAW_HAN)
    apply_han(number, (int)m, din);
  const carom_status status = carom_nose_tangent(number, opt, (int)m, din, dout, out, note);
  if (status != CAROM_OK)
    return status;
  carom_tangent_from_frame(after->v, after->w, R, c, s, (int)m, turn, dR, dout, dv);
  for (int k = 0; k < 5; k++)
    memcpy(tangent + (size_t)from[k] * m, dv[k], m * sizeof(double));
  return status;
}

carom_status carom_cushion_tangent(const carom_cushion_impact *in, const carom_cushion_options *opt, int64_t directions,
                                   const double *seeds, double *tangent, int32_t *flags) {
  static const carom_cushion_options defaults = {0};
  if (in == NULL || seeds == NULL || tangent == NULL)
    return CAROM_ERROR_NULL;
  if (directions < 1 || directions > CAROM_DIRECTIONS_MOST)
    return CAROM_ERROR_DIRECTIONS;
  const size_t m = (size_t)directions;
  carom_motion out;
  carom_tangent_note note = {0, 0.0};
  carom_status status = carom_cushion(in, opt, &out);
  opt = opt != NULL ? opt : &defaults;
  memset(tangent, 0, 6 * m * sizeof *tangent);
  if (status >= 0 && opt->convention != CAROM_CONVENTION_PAPER)
    status = CAROM_ERROR_TANGENT;
  if (status == CAROM_SEPARATING)
    memcpy(tangent, seeds, 6 * m * sizeof *tangent);
  else if (status == CAROM_OK)
    status = differentiate(in, opt, &out, m, seeds, tangent, &note);
  if (flags != NULL)
    *flags = note.flags;
  for (size_t k = 0; status < 0 && k < 6 * m; k++)
    tangent[k] = NAN;
  return status;
}
