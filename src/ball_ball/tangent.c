/* Derivatives of the collision of two balls: of carom_collide(), and in the frame of the contact by each model of a shot.
 *
 * EXACT. The collision depends on nine numbers (reduced.h): slips u and d, v_n, kappa, mu, mu_b, e. Its integrals are |v_n|
 * times functions of the slips over |v_n|, whose derivatives src/impact has. All else is linear.
 *
 * INELASTIC and MIRROR are closed forms (shot/models.c), differentiated line by line. */
#include "ball_ball/tangent.h"
#include "ball_ball/frame.h"
#include "ball_ball/reduced.h"
#include "impact/variation.h"

#include <math.h>
#include <string.h>

/* A motion that counts as none beside the approach, for kinks at which a sign changes. */
static const double NOTHING = 1e-9;

carom_status carom_exact_balls_tangent(const double in[CAROM_BALLS_INS], int plain, int m, carom_row din[CAROM_BALLS_INS],
                                       carom_row dout[CAROM_BALLS_OUTS], carom_tangent_note *note) {
  const double *a = in, *b = in + CAROM_BALL_INS;
  /* the reduced collision; `p`: of the pressed ball */
  const double up = (a[OF_C_Y] - a[OF_V_Y]) + (b[OF_C_Y] - b[OF_V_Y]);
  const bool on_j = up < 0;
  const double sign = on_j ? -1 : 1, *p = on_j ? b : a;
  const int pressed = on_j ? CAROM_BALL_INS : 0, other = on_j ? 0 : CAROM_BALL_INS;
  const int m_p = on_j ? BALLS_M_B : BALLS_M_A, m_o = on_j ? BALLS_M_A : BALLS_M_B, mu_p = on_j ? BALLS_MU_B : BALLS_MU_A;
  const double ratio = in[m_p] / in[m_o];
  const carom_reduced r = {.u_x = a[OF_V_X] - b[OF_V_X] - (a[OF_W_Z] + b[OF_W_Z]),
                           .u_z = fabs(up),
                           .d_x = sign * p[OF_C_X],
                           .d_y = sign * p[OF_C_Y],
                           .v_n = b[OF_V_Y] - a[OF_V_Y],
                           .kappa = 1 + ratio,
                           .mu = in[mu_p],
                           .mu_b = in[BALLS_MU],
                           .e = in[BALLS_E],
                           .s = -1,
                           .j_pressed = on_j};
  /* which variables have a seed: of the slips, frictions, restitution and kappa. V = -v_n */
  const double V = -r.v_n, slips[4] = {r.u_x / V, r.u_z / V, r.d_x / V, r.d_y / V};
  unsigned asked = 0;
  carom_row d_V;
  carom_row by[CAROM_VARIABLES];
  for (int j = 0; j < m; j++) {
    d_V[j] = din[OF_V_Y][j] - din[CAROM_BALL_INS + OF_V_Y][j];
    const double d_up = (din[OF_C_Y][j] - din[OF_V_Y][j]) + (din[CAROM_BALL_INS + OF_C_Y][j] - din[CAROM_BALL_INS + OF_V_Y][j]);
    const double d_slips[4] = {din[OF_V_X][j] - din[CAROM_BALL_INS + OF_V_X][j] - din[OF_W_Z][j] -
                                   din[CAROM_BALL_INS + OF_W_Z][j],
                               sign * d_up, sign * din[pressed + OF_C_X][j], sign * din[pressed + OF_C_Y][j]};
    for (int k = 0; k < 4; k++) /* a slip of exactly 0 stays 0 where nothing changes it */
      by[k][j] = (d_slips[k] - slips[k] * d_V[j]) / V;
    by[BY_MU][j] = din[BALLS_MU][j];
    by[BY_MU_C][j] = din[mu_p][j];
    by[BY_E][j] = din[BALLS_E][j];
    by[BY_LAMBDA][j] = ratio * (din[m_p][j] / in[m_p] - din[m_o][j] / in[m_o]);
    for (int k = 0; k < CAROM_VARIABLES; k++)
      asked |= (unsigned)(by[k][j] != 0) << k;
    /* the pressed ball changes with the sign of u_z */
    if (fabs(up) < NOTHING * V && d_slips[1] != 0)
      note->flags |= CAROM_TANGENT_KINK;
  }
  /* the law, and its derivative by kappa */
  const carom_law law = {.K_x = 3.5 * r.kappa,
                         .K_y = 2.5 * r.kappa,
                         .C_x = 1,
                         .C_y = 2.5,
                         .B_0 = -1,
                         .L_x = 1,
                         .L_y = 2.5,
                         .H = 3.5,
                         .g_1 = -1,
                         .V_0 = -r.kappa,
                         .V_F = 1,
                         .mu = r.mu_b,
                         .mu_c = r.u_z > 0 ? r.mu : 0,
                         .e = r.e};
  const carom_law d_law = {.K_x = 3.5, .K_y = 2.5, .V_0 = -1};
  carom_impact_tangent t;
  const carom_status status = carom_impact_differentiate(&law, &d_law, slips, plain, asked, &t);
  if (status != CAROM_OK)
    return status;
  note->flags |= (t.kink ? CAROM_TANGENT_KINK : 0) | (t.differences ? CAROM_TANGENT_DIFFERENCES : 0);
  note->error = fmax(note->error, t.error);
  /* p, Q_1, Q_2, F_x, F_y: impulses times V, with the signs of reduced.h */
  const double q[5] = {t.q.p, -t.q.f_x, -t.q.f_y, t.q.F_x, t.q.F_y};
  static const double of_impulse[5] = {1, -1, -1, 1, 1};
  for (int j = 0; j < m; j++) {
    double g[5];
    for (int i = 0; i < 5; i++) {
      double sum = 0;
      for (int k = 0; k < CAROM_VARIABLES; k++)
        if (by[k][j] != 0)
          sum += t.d[i][k] * by[k][j];
      g[i] = V * of_impulse[i] * sum + q[i] * d_V[j];
    }
    /* W before, from slip and velocity; then what the integrals change, as carom_restore() does */
    for (int ball = 0; ball < 2; ball++) {
      carom_row *d = din + ball * CAROM_BALL_INS, *o = dout + ball * CAROM_BALL_INS;
      o[OF_V_X][j] = d[OF_V_X][j];
      o[OF_V_Y][j] = d[OF_V_Y][j];
      o[OF_W_X][j] = d[OF_C_Y][j] - d[OF_V_Y][j];
      o[OF_W_Y][j] = d[OF_V_X][j] - d[OF_C_X][j];
      o[OF_W_Z][j] = d[OF_W_Z][j];
    }
    const double dp = g[0], dQ_1 = g[1], dQ_2 = g[2], dF_x = g[3], dF_y = g[4], d_ratio = by[BY_LAMBDA][j];
    dout[pressed + OF_V_X][j] += sign * (dF_x - dQ_1);
    dout[pressed + OF_V_Y][j] += sign * (dF_y - dp);
    dout[pressed + OF_W_X][j] += sign * 2.5 * (dF_y - dQ_2);
    dout[pressed + OF_W_Y][j] -= sign * 2.5 * dF_x;
    dout[pressed + OF_W_Z][j] += 2.5 * dQ_1;
    dout[other + OF_V_X][j] += sign * (ratio * dQ_1 + d_ratio * V * q[1]);
    dout[other + OF_V_Y][j] += sign * (ratio * dp + d_ratio * V * q[0]);
    dout[other + OF_W_X][j] -= sign * 2.5 * (ratio * dQ_2 + d_ratio * V * q[2]);
    dout[other + OF_W_Z][j] += 2.5 * (ratio * dQ_1 + d_ratio * V * q[1]);
  }
  return CAROM_OK;
}

/* W_x and W_y of a ball from its slip; the rest stays. */
static void to_spins(int m, carom_row d[CAROM_BALL_INS], carom_row o[CAROM_BALL_INS]) {
  for (int j = 0; j < m; j++) {
    o[OF_V_X][j] = d[OF_V_X][j];
    o[OF_V_Y][j] = d[OF_V_Y][j];
    o[OF_W_X][j] = d[OF_C_Y][j] - d[OF_V_Y][j];
    o[OF_W_Y][j] = d[OF_V_X][j] - d[OF_C_X][j];
    o[OF_W_Z][j] = d[OF_W_Z][j];
  }
}

/* P = (1 + e) closing m_a m_b / (m_a + m_b), and what it changes. */
static void exchange(double e, double m_a, double m_b, double closing, double de, double dm_a, double dm_b, double d_closing,
                     double *dv_a, double *dv_b) {
  const double total = m_a + m_b, part_a = m_b / total, part_b = m_a / total;
  const double d_part = (m_a * dm_b - m_b * dm_a) / (total * total);
  *dv_a -= (de * closing + (1 + e) * d_closing) * part_a + (1 + e) * closing * d_part;
  *dv_b += (de * closing + (1 + e) * d_closing) * part_b - (1 + e) * closing * d_part;
}

void carom_mirror_balls_tangent(const double in[CAROM_BALLS_INS], int m, carom_row din[CAROM_BALLS_INS],
                                carom_row dout[CAROM_BALLS_OUTS]) {
  const double closing = in[OF_V_Y] - in[CAROM_BALL_INS + OF_V_Y];
  to_spins(m, din, dout);
  to_spins(m, din + CAROM_BALL_INS, dout + CAROM_BALL_INS);
  for (int j = 0; j < m; j++)
    exchange(in[BALLS_E], in[BALLS_M_A], in[BALLS_M_B], closing, din[BALLS_E][j], din[BALLS_M_A][j], din[BALLS_M_B][j],
             din[OF_V_Y][j] - din[CAROM_BALL_INS + OF_V_Y][j], &dout[OF_V_Y][j], &dout[CAROM_BALL_INS + OF_V_Y][j]);
}

void carom_inelastic_balls_tangent(const double in[CAROM_BALLS_INS], int m, carom_row din[CAROM_BALLS_INS],
                                   carom_row dout[CAROM_BALLS_OUTS], carom_tangent_note *note) {
  const double *a = in, *b = in + CAROM_BALL_INS, e = in[BALLS_E], mu = in[BALLS_MU];
  carom_row *da = din, *db = din + CAROM_BALL_INS, *oa = dout, *ob = dout + CAROM_BALL_INS;
  /* x is the t = n x z of models.c */
  const double closing = a[OF_V_Y] - b[OF_V_Y], along = (a[OF_V_X] - b[OF_V_X]) - (a[OF_W_Z] + b[OF_W_Z]);
  const double up = (a[OF_C_Y] - a[OF_V_Y]) + (b[OF_C_Y] - b[OF_V_Y]), slip = sqrt(along * along + up * up);
  const double most = mu * e * closing;
  const bool sticks = 7.0 * most >= slip;
  const double share = sticks ? 1.0 / 7.0 : most / slip;
  if (fabs(7.0 * most - slip) < NOTHING * slip)
    note->flags |= CAROM_TANGENT_KINK;
  to_spins(m, da, oa);
  to_spins(m, db, ob);
  for (int j = 0; j < m; j++) {
    const double d_closing = da[OF_V_Y][j] - db[OF_V_Y][j];
    const double d_along = (da[OF_V_X][j] - db[OF_V_X][j]) - (da[OF_W_Z][j] + db[OF_W_Z][j]),
                 d_up = oa[OF_W_X][j] + ob[OF_W_X][j];
    double d_share = 0;
    if (!sticks) {
      const double d_most = din[BALLS_MU][j] * e * closing + mu * (din[BALLS_E][j] * closing + e * d_closing);
      d_share = (d_most - share * (along * d_along + up * d_up) / slip) / slip;
    }
    const double of_along = -d_share * along - share * d_along, of_up = -d_share * up - share * d_up;
    exchange(e, 1, 1, closing, din[BALLS_E][j], 0, 0, d_closing, &oa[OF_V_Y][j], &ob[OF_V_Y][j]);
    oa[OF_V_X][j] += of_along;
    ob[OF_V_X][j] -= of_along;
    oa[OF_W_X][j] += 2.5 * of_up;
    ob[OF_W_X][j] += 2.5 * of_up;
    oa[OF_W_Z][j] -= 2.5 * of_along;
    ob[OF_W_Z][j] -= 2.5 * of_along;
  }
}

/* ---- The public call ---- */

/* dv_x, dv_y, dw of a ball from the rows of a carom_ball's seeds. */
static void take_rows(const double *seeds, int64_t m, int64_t first, int width, carom_row dv[5]) {
  static const int row[5] = {3, 4, 6, 7, 8};
  for (int k = 0; k < 5; k++)
    memcpy(dv[k], seeds + row[k] * m + first, sizeof(double) * (size_t)width);
}

/* One part of the directions. */
static carom_status differentiate(const carom_impact *in, const carom_frame *frame, const carom_result *out, int plain,
                                  int64_t m, int64_t first, int width, const double *seeds, double *tangent,
                                  carom_tangent_note *note) {
  carom_row din[CAROM_BALLS_INS], dout[CAROM_BALLS_OUTS], dv[5], turn, dR;
  double number[CAROM_BALLS_INS];
  const double R = in->a.radius, c = frame->x[0], s = frame->x[1];
  const double *of_b = seeds + 12 * m;
  /* the line of centres turns counter-clockwise, along -x of the frame */
  for (int j = 0; j < width; j++) {
    const double dx = of_b[first + j] - seeds[first + j], dy = of_b[m + first + j] - seeds[m + first + j];
    turn[j] = -(c * dx + s * dy) / frame->distance;
    dR[j] = seeds[9 * m + first + j];
    din[BALLS_MU][j] = seeds[24 * m + first + j];
    din[BALLS_E][j] = seeds[25 * m + first + j];
    din[BALLS_MU_A][j] = seeds[11 * m + first + j];
    din[BALLS_MU_B][j] = of_b[11 * m + first + j];
    din[BALLS_M_A][j] = seeds[10 * m + first + j];
    din[BALLS_M_B][j] = of_b[10 * m + first + j];
  }
  const double constants[6] = {in->mu_ball, in->restitution, in->a.mu_cloth, in->b.mu_cloth, in->a.mass, in->b.mass};
  memcpy(number + BALLS_MU, constants, sizeof constants);
  for (int k = 0; k < 2; k++) {
    const carom_ball *ball = k == 0 ? &in->a : &in->b;
    const double u_x = ball->v[0] - R * ball->w[1], u_y = ball->v[1] + R * ball->w[0];
    const bool rolls = fmax(fabs(u_x), fabs(u_y)) <= 1e-12;
    take_rows(k == 0 ? seeds : of_b, m, first, width, dv);
    carom_tangent_to_frame(ball->v, ball->w, R, c, s, rolls, width, turn, dR, dv, number + k * CAROM_BALL_INS,
                           din + k * CAROM_BALL_INS);
  }
  const carom_status status = carom_exact_balls_tangent(number, plain, width, din, dout, note);
  for (int k = 0; k < 2 && status == CAROM_OK; k++) {
    const carom_motion *motion = k == 0 ? &out->a : &out->b;
    carom_tangent_from_frame(motion->v, motion->w, R, c, s, width, turn, dR, dout + k * CAROM_BALL_INS, dv);
    static const int row[5] = {0, 1, 3, 4, 5};
    for (int i = 0; i < 5; i++)
      memcpy(tangent + (6 * k + row[i]) * m + first, dv[i], sizeof(double) * (size_t)width);
  }
  return status;
}

carom_status carom_collide_tangent(const carom_impact *in, const carom_options *opt, int64_t directions, const double *seeds,
                                   double *tangent, int32_t *flags) {
  if (in == NULL || seeds == NULL || tangent == NULL)
    return CAROM_ERROR_NULL;
  if (directions < 1 || directions > CAROM_DIRECTIONS_MOST)
    return CAROM_ERROR_DIRECTIONS;
  const size_t m = (size_t)directions;
  carom_result out;
  carom_tangent_note note = {0, 0.0};
  carom_status status = carom_collide(in, opt, &out);
  memset(tangent, 0, 12 * m * sizeof *tangent);
  if (status >= 0 && opt != NULL && (opt->solver != CAROM_SOLVER_EXACT || opt->slip != CAROM_SLIP_PAPER))
    status = CAROM_ERROR_TANGENT;
  const carom_frame frame = carom_frame_of(in);
  if (status == CAROM_SEPARATING) {
    static const int from[12] = {3, 4, 5, 6, 7, 8, 15, 16, 17, 18, 19, 20};
    for (int k = 0; k < 12; k++)
      memcpy(tangent + (size_t)k * m, seeds + (size_t)from[k] * m, m * sizeof *tangent);
  } else if (status == CAROM_OK) {
    status =
        differentiate(in, &frame, &out, opt != NULL ? opt->plain : 0, directions, 0, (int)directions, seeds, tangent, &note);
  }
  if (flags != NULL)
    *flags = note.flags;
  for (size_t k = 0; status < 0 && k < 12 * m; k++)
    tangent[k] = NAN;
  return status;
}
