/* Derivatives of a whole shot in several directions at once: tangents that follow the events of a shot that has been played.
 *
 * At each event, at the time T where g = 0, with d the tangents at a fixed time (tangent_path.c):
 *
 *     dT = -(d_x g d + d_k g dk)/g'        dx- = d + x'- dT        dx+ = J dx-        d+ = dx+ - x'+ dT
 *
 *     two balls       closing . dT = n . (d_b - d_a) - 2 dR         rail, jaw   closing . dT = -n . d - dR, n into the cushion
 *     pocket          (p . v) dT = -p . d, p from its centre        end of a phase: tangent_path.c
 *
 * J is that of the contact, in its frame, which turns by dturn (tangent.h). Tangents live in tangent->final, so nothing is kept
 * but the paths. docs/understanding/gradients.md derives this. */
#include "cushion/tangent.h"
#include "platform/elementary.h"
#include "platform/threads.h"
#include "shot/reach.h"
#include "shot/sim.h"
#include "shot/tangent_path.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double GRAZING = 0.01;      /* closing over relative speed */
static const double SIMULTANEOUS = 1e-9; /* s */

/* What an event is worked on with. */
typedef struct work {
  const carom_table *table;
  const carom_cue *cue;
  const carom_shot_options *opt;
  const carom_tangent_seeds *seeds;
  int count, m;
  carom_tangent_ball ball[CAROM_BALLS_MOST];
  int64_t slow_instants; /* as in carom_sim */
  double slow_last;
  carom_tangent_note note;
  /* of the event: tangents of its balls, rates, the tangent of its time */
  carom_row d[2][CAROM_STATE_NUMBERS], d_time;
  double rate[2][CAROM_STATE_NUMBERS];
} work;

static const double *row_of(const double *rows, int row, int m) {
  return rows != NULL ? rows + row * m : NULL;
}

static double at(const double *row, int j) {
  return row != NULL ? row[j] : 0.0;
}

/* ---- The strike: strike.c, differentiated ---- */

static void strike(work *w, int i) {
  const int m = w->m;
  const carom_cue *cue = w->cue;
  const carom_tangent_ball *ball = &w->ball[i];
  const double *q = w->seeds->cue, R = ball->kind->radius, mass = ball->kind->mass, a = cue->a, b = cue->b,
               inside = 1.0 - a * a;
  double sin_phi, cos_phi, sin_theta, cos_theta;
  carom_sincos_degrees(cue->phi, &sin_phi, &cos_phi);
  carom_sincos_degrees(cue->theta, &sin_theta, &cos_theta);
  const double degree = 0.017453292519943295, heavy = 1.0 + mass / cue->mass + 2.5 * (a * a + b * b),
               V = 2.0 * cue->speed / heavy;
  const double root = sqrt(inside), aside = -2.5 * a * root, ahead = 1.0 + mass / cue->end_mass + 2.5 * inside;
  const double size = sqrt(aside * aside + ahead * ahead), s = aside / size, c = ahead / size, turn = 2.5 * V / R;
  const double x = turn * b, y = turn * a * sin_theta, v_x = cos_phi * c - sin_phi * s, v_y = sin_phi * c + cos_phi * s;
  for (int j = 0; j < m; j++) {
    const double d_mass = carom_d_kind(ball, CAROM_KIND_ROW(mass), m, j), dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
    const double d_speed = at(q, j), d_phi = degree * at(row_of(q, 1, m), j), d_theta = degree * at(row_of(q, 2, m), j);
    const double da = at(row_of(q, 3, m), j), db = at(row_of(q, 4, m), j), dM = at(row_of(q, 5, m), j),
                 d_end = at(row_of(q, 6, m), j);
    /* the speed along the cue, and squirt */
    const double d_heavy = d_mass / cue->mass - mass / (cue->mass * cue->mass) * dM + 5.0 * (a * da + b * db);
    const double dV = (2.0 * d_speed - V * d_heavy) / heavy;
    const double d_aside = -2.5 * da * (root - a * a / root);
    const double d_ahead = d_mass / cue->end_mass - mass / (cue->end_mass * cue->end_mass) * d_end - 5.0 * a * da;
    const double d_squirt = (d_aside * c - d_ahead * s) / size; /* of the angle */
    const double d_sin = cos_theta * d_theta, d_cos = -sin_theta * d_theta, turns = d_phi + d_squirt;
    w->d[0][S_V_X][j] = dV * cos_theta * v_x + V * d_cos * v_x - V * cos_theta * v_y * turns;
    w->d[0][S_V_Y][j] = dV * cos_theta * v_y + V * d_cos * v_y + V * cos_theta * v_x * turns;
    const double d_turn = 2.5 * dV / R - turn / R * dR, dx = d_turn * b + turn * db;
    const double dy = (d_turn * a + turn * da) * sin_theta + turn * a * d_sin;
    w->d[0][S_W_X][j] = -dx * sin_phi - dy * cos_phi + (-x * cos_phi + y * sin_phi) * d_phi;
    w->d[0][S_W_Y][j] = dx * cos_phi - dy * sin_phi + (-x * sin_phi - y * cos_phi) * d_phi;
    w->d[0][S_W_Z][j] = -(d_turn * a + turn * da) * cos_theta - turn * a * d_cos;
    w->d_time[j] = 0.0;
  }
}

/* ---- Contacts ---- */

/* Total tangents before the event. */
static void total(work *w, int side) {
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    for (int j = 0; j < w->m; j++)
      w->d[side][k][j] += w->rate[side][k] * w->d_time[j];
}

static bool is_slow(work *w, double time) {
  w->slow_instants += time > w->slow_last;
  w->slow_last = time;
  w->note.flags |= CAROM_TANGENT_SLOW;
  return true;
}

/* Friction between the balls, mu and its tangents: models.c. In the frame x is t = n x z of models.c. */
static void friction(const work *w, int i, int j, double in[CAROM_BALLS_INS], carom_row din[CAROM_BALLS_INS]) {
  const carom_tangent_ball *a = &w->ball[i], *b = &w->ball[j];
  const carom_ball_kind *kind_a = a->kind, *kind_b = b->kind;
  const int m = w->m, B = CAROM_BALL_INS;
  if (w->opt->friction == CAROM_FRICTION_CONSTANT) {
    in[BALLS_MU] = 0.5 * (kind_a->mu_ball + kind_b->mu_ball);
    for (int k = 0; k < m; k++)
      din[BALLS_MU][k] =
          0.5 * (carom_d_kind(a, CAROM_KIND_ROW(mu_ball), m, k) + carom_d_kind(b, CAROM_KIND_ROW(mu_ball), m, k));
    return;
  }
  /* the law of each ball, or the usual one, whose numbers do not change */
  const carom_speed_law usual = carom_alciatore();
  const bool own_a = kind_a->law_a + kind_a->law_b + kind_a->law_c > 0.0,
             own_b = kind_b->law_a + kind_b->law_b + kind_b->law_c > 0.0;
  const double l[3] = {0.5 * ((own_a ? kind_a->law_a : usual.a) + (own_b ? kind_b->law_a : usual.a)),
                       0.5 * ((own_a ? kind_a->law_b : usual.b) + (own_b ? kind_b->law_b : usual.b)),
                       0.5 * ((own_a ? kind_a->law_c : usual.c) + (own_b ? kind_b->law_c : usual.c))};
  const double along = in[OF_V_X] - in[B + OF_V_X] - (in[OF_W_Z] + in[B + OF_W_Z]);
  const double up = (in[OF_C_Y] - in[OF_V_Y]) + (in[B + OF_C_Y] - in[B + OF_V_Y]), u = sqrt(along * along + up * up);
  const double fades = carom_exp(-l[2] * u);
  in[BALLS_MU] = l[0] + l[1] * fades;
  for (int k = 0; k < m; k++) {
    const double d_along = din[OF_V_X][k] - din[B + OF_V_X][k] - (din[OF_W_Z][k] + din[B + OF_W_Z][k]);
    const double d_up = (din[OF_C_Y][k] - din[OF_V_Y][k]) + (din[B + OF_C_Y][k] - din[B + OF_V_Y][k]);
    const double du = u > 0.0 ? (along * d_along + up * d_up) / u : 0.0;
    double d[3];
    for (int r = 0; r < 3; r++)
      d[r] = 0.5 * ((own_a ? carom_d_kind(a, CAROM_KIND_ROW(law_a) + r, m, k) : 0.0) +
                    (own_b ? carom_d_kind(b, CAROM_KIND_ROW(law_a) + r, m, k) : 0.0));
    din[BALLS_MU][k] = d[0] + fades * (d[1] - l[1] * (d[2] * u + l[2] * du));
  }
}

static carom_status two_balls(work *w, const carom_event *event) {
  const int m = w->m;
  const carom_tangent_ball *ball[2] = {&w->ball[event->a], &w->ball[event->b]};
  const carom_ball_state *before = event->before;
  const double R = ball[0]->kind->radius, n_x = before[1].r[0] - before[0].r[0], n_y = before[1].r[1] - before[0].r[1];
  const double distance = sqrt(n_x * n_x + n_y * n_y), y_x = n_x / distance, y_y = n_y / distance, c = y_y, s = -y_x;
  const double v_x = before[0].v[0] - before[1].v[0], v_y = before[0].v[1] - before[1].v[1];
  const double closing = v_x * y_x + v_y * y_y;
  /* when they touch, and how the line of centres turns */
  carom_row turn;
  for (int j = 0; j < m; j++)
    w->d_time[j] = (y_x * (w->d[1][S_X][j] - w->d[0][S_X][j]) + y_y * (w->d[1][S_Y][j] - w->d[0][S_Y][j]) -
                    2.0 * carom_d_kind(ball[0], CAROM_KIND_ROW(radius), m, j)) /
                   closing;
  total(w, 0);
  total(w, 1);
  for (int j = 0; j < m; j++)
    turn[j] = -(c * (w->d[1][S_X][j] - w->d[0][S_X][j]) + s * (w->d[1][S_Y][j] - w->d[0][S_Y][j])) / distance;
  if (closing < GRAZING * sqrt(v_x * v_x + v_y * v_y))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  /* in the frame */
  double in[CAROM_BALLS_INS];
  carom_row din[CAROM_BALLS_INS], dout[CAROM_BALLS_OUTS];
  for (int k = 0; k < 2; k++)
    carom_tangent_to_frame(before[k].v, before[k].w, R, c, s, ball[k]->path.from.label != CAROM_BALL_SLIDING, m, turn,
                           row_of(ball[k]->d_kind, CAROM_KIND_ROW(radius), m), w->d[k] + S_V_X, in + k * CAROM_BALL_INS,
                           din + k * CAROM_BALL_INS);
  const carom_ball_kind *a = ball[0]->kind, *b = ball[1]->kind;
  const double constants[5] = {0.5 * (a->restitution + b->restitution), a->mu_slide, b->mu_slide, a->mass, b->mass};
  memcpy(in + BALLS_E, constants, sizeof constants);
  for (int j = 0; j < m; j++) {
    din[BALLS_E][j] = 0.5 * (carom_d_kind(ball[0], CAROM_KIND_ROW(restitution), m, j) +
                             carom_d_kind(ball[1], CAROM_KIND_ROW(restitution), m, j));
    for (int k = 0; k < 2; k++) {
      din[BALLS_MU_A + k][j] = carom_d_kind(ball[k], CAROM_KIND_ROW(mu_slide), m, j);
      din[BALLS_M_A + k][j] = carom_d_kind(ball[k], CAROM_KIND_ROW(mass), m, j);
    }
  }
  /* the contact */
  carom_status status = CAROM_OK;
  const double slow = carom_slow_speed(w->slow_instants);
  if (closing < slow && is_slow(w, event->time)) {
    carom_slow_balls_tangent(in, slow, m, din, dout);
  } else if (w->opt->ball_model == CAROM_BALL_MODEL_MIRROR) {
    carom_mirror_balls_tangent(in, m, din, dout);
  } else {
    friction(w, event->a, event->b, in, din);
    if (w->opt->ball_model == CAROM_BALL_MODEL_INELASTIC)
      carom_inelastic_balls_tangent(in, m, din, dout, &w->note);
    else
      status = carom_exact_balls_tangent(in, w->opt->plain, m, din, dout, &w->note);
  }
  for (int k = 0; k < 2; k++)
    carom_tangent_from_frame(event->after[k].v, event->after[k].w, R, c, s, m, turn,
                             row_of(ball[k]->d_kind, CAROM_KIND_ROW(radius), m), dout + k * CAROM_BALL_INS, w->d[k] + S_V_X);
  return status;
}

/* What the ball loses of its roll along the cushion: lose_roll() of models.c, in the frame. v_x: before. */
static void lose_roll(const carom_tangent_ball *ball, double v_x, const double *d_v_x, int m, double out[CAROM_BALL_INS],
                      carom_row dout[CAROM_BALL_INS]) {
  const double part = ball->kind->roll_loss, roll = out[OF_W_Y], sign = v_x < 0.0 ? -1.0 : 1.0;
  if (!(part > 0.0) || !(v_x * roll > 0.0))
    return;
  const bool all = part * fabs(v_x) >= fabs(roll);
  for (int j = 0; j < m; j++) {
    const double d_loss = sign * carom_d_kind(ball, CAROM_KIND_ROW(roll_loss), m, j) * fabs(v_x) + part * d_v_x[j];
    dout[OF_W_Y][j] = all ? 0.0 : dout[OF_W_Y][j] - d_loss;
  }
  out[OF_W_Y] = all ? 0.0 : roll - part * v_x;
}

/* Whether the exact model refuses an impact, so that the shot has resolved it in steps: carom_model_cushion(). Its derivative
 * may be known all the same, but is that of another motion. */
static bool was_in_steps(const carom_ball_state *before, const carom_ball_kind *kind, double height, const double normal[2],
                         const double in[CAROM_NOSE_INS], int plain) {
  const carom_cushion_impact impact = {.v = {before->v[0], before->v[1], 0.0},
                                       .w = {before->w[0], before->w[1], before->w[2]},
                                       .normal = {normal[0], normal[1]},
                                       .height = height,
                                       .radius = kind->radius,
                                       .mass = kind->mass,
                                       .mu_cloth = in[NOSE_MU_S],
                                       .mu_cushion = in[NOSE_MU_W],
                                       .restitution = in[NOSE_E]};
  const carom_cushion_options options = {.plain = plain};
  carom_motion unused;
  return carom_cushion(&impact, &options, &unused) == CAROM_ERROR_UNRESOLVED;
}

static carom_status cushion(work *w, const carom_event *event) {
  const int m = w->m;
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_kind *kind = ball->kind;
  const carom_ball_state *before = &event->before[0];
  const double R = kind->radius;
  const carom_due due = {event->time, event->type, event->a, event->b};
  const carom_nose nose = carom_nose_of(w->table, &due);
  /* the direction into the cushion */
  double line[3], y_x, y_y, distance = INFINITY;
  if (event->type == CAROM_EVENT_RAIL) {
    carom_rail_line(&w->table->rail[event->b], line);
    y_x = -line[0];
    y_y = -line[1];
  } else {
    const carom_jaw *jaw = &w->table->jaw[event->b];
    const double x = jaw->centre[0] - before->r[0], y = jaw->centre[1] - before->r[1];
    distance = sqrt(x * x + y * y);
    y_x = x / distance;
    y_y = y / distance;
  }
  const double c = y_y, s = -y_x, closing = before->v[0] * y_x + before->v[1] * y_y;
  carom_row turn;
  for (int j = 0; j < m; j++)
    w->d_time[j] =
        -(y_x * w->d[0][S_X][j] + y_y * w->d[0][S_Y][j] + carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j)) / closing;
  total(w, 0);
  for (int j = 0; j < m; j++)
    turn[j] = (c * w->d[0][S_X][j] + s * w->d[0][S_Y][j]) / distance;
  if (closing < GRAZING * sqrt(before->v[0] * before->v[0] + before->v[1] * before->v[1]))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  /* in the frame */
  double in[CAROM_NOSE_INS], out[CAROM_BALL_INS];
  carom_row din[CAROM_NOSE_INS], dout[CAROM_BALL_INS];
  const double *dR = row_of(ball->d_kind, CAROM_KIND_ROW(radius), m);
  carom_tangent_to_frame(before->v, before->w, R, c, s, ball->path.from.label != CAROM_BALL_SLIDING, m, turn, dR,
                         w->d[0] + S_V_X, in, din);
  const bool own_height = kind->nose_height > 0.0;
  const double height = own_height ? kind->nose_height : nose.height;
  in[NOSE_MU_S] = kind->mu_slide;
  in[NOSE_MU_W] = nose.mu_cushion > 0.0 ? nose.mu_cushion : kind->mu_cushion;
  in[NOSE_E] = nose.restitution > 0.0 ? nose.restitution : kind->restitution_cushion;
  in[NOSE_SINE] = (height - R) / R;
  in[NOSE_RATIO] = kind->omega_ratio > 0.0 ? kind->omega_ratio : 1.8;
  const double *of_table = w->seeds->table;
  for (int j = 0; j < m; j++) {
    const double d_height = own_height ? carom_d_kind(ball, CAROM_KIND_ROW(nose_height), m, j) : at(of_table, j);
    din[NOSE_MU_S][j] = carom_d_kind(ball, CAROM_KIND_ROW(mu_slide), m, j);
    din[NOSE_MU_W][j] =
        nose.mu_cushion > 0.0 ? at(row_of(of_table, 1, m), j) : carom_d_kind(ball, CAROM_KIND_ROW(mu_cushion), m, j);
    din[NOSE_E][j] =
        nose.restitution > 0.0 ? at(row_of(of_table, 2, m), j) : carom_d_kind(ball, CAROM_KIND_ROW(restitution_cushion), m, j);
    din[NOSE_SINE][j] = d_height / R - height / (R * R) * at(dR, j);
    din[NOSE_RATIO][j] = kind->omega_ratio > 0.0 ? carom_d_kind(ball, CAROM_KIND_ROW(omega_ratio), m, j) : 0.0;
  }
  /* the contact, as carom_resolve_cushion() decides it */
  const double slow = carom_slow_speed(w->slow_instants);
  carom_status status = CAROM_OK;
  if (closing >= slow) {
    carom_cushion_options options = {.steps = w->opt->steps, .plain = w->opt->plain, .omega_ratio = in[NOSE_RATIO]};
    const carom_shot_cushion asked = w->opt->cushion_model;
    options.model = asked != CAROM_SHOT_CUSHION_DEFAULT ? (carom_cushion_model)((int)asked - 1) : CAROM_CUSHION_HAN;
    if (options.model == CAROM_CUSHION_MATHAVAN && was_in_steps(before, kind, height, (double[]){y_x, y_y}, in, w->opt->plain))
      options.model = CAROM_CUSHION_EULER;
    status = carom_nose_tangent(in, &options, m, din, dout, out, &w->note);
    lose_roll(ball, in[OF_V_X], din[OF_V_X], m, out, dout);
  } else {
    out[OF_V_X] = in[OF_V_X];
    out[OF_V_Y] = in[OF_V_Y];
    out[OF_W_X] = in[OF_C_Y] - in[OF_V_Y];
    out[OF_W_Y] = in[OF_V_X] - in[OF_C_X];
    out[OF_W_Z] = in[OF_W_Z];
    for (int j = 0; j < m; j++) {
      dout[OF_V_X][j] = din[OF_V_X][j];
      dout[OF_V_Y][j] = din[OF_V_Y][j];
      dout[OF_W_X][j] = din[OF_C_Y][j] - din[OF_V_Y][j];
      dout[OF_W_Y][j] = din[OF_V_X][j] - din[OF_C_X][j];
      dout[OF_W_Z][j] = din[OF_W_Z][j];
    }
  }
  if ((closing < slow || out[OF_V_Y] > 0.0) && is_slow(w, event->time))
    carom_slow_nose_tangent(out, slow, m, dout);
  carom_tangent_from_frame(event->after[0].v, event->after[0].w, R, c, s, m, turn, dR, dout, w->d[0] + S_V_X);
  return status;
}

static void pocket(work *w, const carom_event *event) {
  const carom_pocket *p = &w->table->pocket[event->b];
  const carom_ball_state *before = &event->before[0];
  const double x = before->r[0] - p->centre[0], y = before->r[1] - p->centre[1], *v = before->v, rate = x * v[0] + y * v[1];
  if (-rate < GRAZING * sqrt((x * x + y * y) * (v[0] * v[0] + v[1] * v[1])))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  for (int j = 0; j < w->m; j++)
    w->d_time[j] = -(x * w->d[0][S_X][j] + y * w->d[0][S_Y][j]) / rate;
  total(w, 0);
}

/* ---- From event to event ---- */

/* Tangents into rows of m of the caller's. */
static void put(double *to, carom_row d[CAROM_STATE_NUMBERS], int m) {
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    memcpy(to + k * m, d[k], sizeof(double) * (size_t)m);
}

/* Puts a ball behind its event, where its path begins anew. */
static void go_on(work *w, int i, int side, const carom_event *event) {
  carom_tangent_ball *ball = &w->ball[i];
  const carom_ball_state *after = &event->after[side];
  const carom_ball_rates rates = carom_rates_of(ball->kind);
  const int m = w->m;
  if (event->type == CAROM_EVENT_POCKET)
    for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
      memset(w->d[side][k], 0, sizeof(double) * (size_t)m);
  carom_tangent_settle(after, ball, m, w->d[side]);
  ball->path.from = *after;
  carom_path_begin(&ball->path, &rates, event->time);
}

/* From total tangents to those at a fixed time. */
static void fix_time(work *w, int i, int side) {
  carom_tangent_ball *ball = &w->ball[i];
  double rate[CAROM_STATE_NUMBERS];
  carom_row unused[CAROM_STATE_NUMBERS];
  put(ball->d, w->d[side], w->m);
  carom_tangent_flow(ball, ball->path.start, 0, rate, unused);
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    for (int j = 0; j < w->m; j++)
      ball->d[k * w->m + j] -= rate[k] * w->d_time[j];
}

static carom_status follow(work *w, const carom_event *event) {
  const bool two = event->type == CAROM_EVENT_BALL_BALL;
  carom_tangent_ball *a = &w->ball[event->a], *b = two ? &w->ball[event->b] : NULL;
  carom_status status = CAROM_OK;
  w->note = (carom_tangent_note){0, 0.0};
  carom_tangent_flow(a, event->time, w->m, w->rate[0], w->d[0]);
  if (two)
    carom_tangent_flow(b, event->time, w->m, w->rate[1], w->d[1]);
  if ((a->path.from.label == CAROM_BALL_ROLLING && a->kind->drag > 0.0) ||
      (two && b->path.from.label == CAROM_BALL_ROLLING && b->kind->drag > 0.0))
    w->note.flags |= CAROM_TANGENT_DRAG;
  /* contacts so close that a small change reverses their order */
  if (event->type <= CAROM_EVENT_JAW) {
    if (event->time - (two ? fmax(a->last_contact, b->last_contact) : a->last_contact) < SIMULTANEOUS)
      w->note.flags |= CAROM_TANGENT_SIMULTANEOUS;
    a->last_contact = event->time;
    if (two)
      b->last_contact = event->time;
  }
  switch (event->type) {
  case CAROM_EVENT_STRIKE:
    strike(w, event->a);
    break;
  case CAROM_EVENT_BALL_BALL:
    status = two_balls(w, event);
    break;
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
    status = cushion(w, event);
    break;
  case CAROM_EVENT_POCKET:
    pocket(w, event);
    break;
  default:
    carom_tangent_end(a, w->m, w->d[0], w->d_time);
    total(w, 0);
  }
  return status;
}

/* ---- Arguments ---- */

static bool on_the_cloth(const carom_ball_state *s) {
  return s->label != CAROM_BALL_AIRBORNE && s->v[2] == 0.0;
}

/* Whether an event can be one of the shot, and one whose derivatives are known. */
static carom_status check_event(const carom_table *table, int count, const carom_cue *cue, const carom_event *event,
                                double since) {
  const int type = event->type;
  if (type < CAROM_EVENT_STRIKE || event->a < 0 || event->a >= count || !(event->time >= since && event->time < INFINITY))
    return CAROM_ERROR_STATE;
  if (type > CAROM_EVENT_SPINNING_STATIONARY)
    return CAROM_ERROR_TANGENT;
  const bool two = type == CAROM_EVENT_BALL_BALL;
  const int64_t parts = two                          ? count
                        : type == CAROM_EVENT_RAIL   ? table->rails
                        : type == CAROM_EVENT_JAW    ? table->jaws
                        : type == CAROM_EVENT_POCKET ? table->pockets
                                                     : INT64_MAX;
  if ((parts < INT64_MAX && (event->b < 0 || event->b >= parts)) || (two && event->a == event->b) ||
      (type == CAROM_EVENT_STRIKE && cue == NULL))
    return CAROM_ERROR_STATE;
  bool flat = on_the_cloth(&event->before[0]) && on_the_cloth(&event->after[0]);
  if (two)
    flat = flat && on_the_cloth(&event->before[1]) && on_the_cloth(&event->after[1]);
  return flat ? CAROM_OK : CAROM_ERROR_TANGENT;
}

static carom_status check(const carom_table *table, const carom_shot_ball *balls, int count, const carom_cue *cue,
                          const carom_shot_options *opt, const carom_shot *shot, const carom_tangent_seeds *seeds,
                          const carom_tangent *tangent) {
  if (count < 1 || count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  if (seeds->directions < 1 || seeds->directions > CAROM_DIRECTIONS_MOST)
    return CAROM_ERROR_DIRECTIONS;
  for (size_t k = 0; k < sizeof seeds->reserved / sizeof seeds->reserved[0]; k++)
    if (seeds->reserved[k] != 0)
      return CAROM_ERROR_SHOT_OPTIONS;
  int where;
  const carom_status bad = carom_check_common(table, count, opt, &where);
  if (bad != CAROM_OK)
    return bad;
  if (shot->count > 0 && (shot->events == NULL || shot->count > shot->room))
    return CAROM_ERROR_EVENTS_LOST;
  /* times, and whether the motion is known there */
  if (tangent->reach != NULL && tangent->time == NULL && shot->count > 0)
    return CAROM_ERROR_NULL;
  if (tangent->times_count > 0 && (tangent->times == NULL || tangent->at == NULL))
    return CAROM_ERROR_NULL;
  for (int64_t k = 0; k < tangent->times_count; k++)
    if (!(fabs(tangent->times[k]) < INFINITY) || (k > 0 && tangent->times[k] < tangent->times[k - 1]))
      return CAROM_ERROR_TIME;
  if (opt->world == CAROM_WORLD_POOLTOOL || opt->ball_model == CAROM_BALL_MODEL_EULER)
    return CAROM_ERROR_TANGENT;
  /* balls that fly; and radii that differ, as does the height at which those balls meet */
  const double R = balls[0].kind.radius;
  if (opt->space != CAROM_SPACE_FLAT && table->ball_radius != 0.0 && table->ball_radius != R)
    return CAROM_ERROR_TANGENT;
  for (int i = 0; i < count; i++)
    if (balls[i].kind.radius != R || (!carom_is_out(balls[i].state.label) && carom_flies_in_layout(&balls[i].state, R)))
      return CAROM_ERROR_TANGENT;
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_status status = check_event(table, count, cue, &shot->events[k], k > 0 ? shot->events[k - 1].time : 0.0);
    if (status != CAROM_OK)
      return status;
  }
  return CAROM_OK;
}

/* Where all balls begin. */
static void begin(work *w, const carom_shot_ball *balls, double *final) {
  const int m = w->m, numbers = CAROM_STATE_NUMBERS * m;
  for (int i = 0; i < w->count; i++) {
    carom_tangent_ball *ball = &w->ball[i];
    const carom_ball_rates rates = carom_rates_of(&balls[i].kind);
    *ball = (carom_tangent_ball){.kind = &balls[i].kind, .d = final + i * numbers, .last_contact = -INFINITY};
    if (w->seeds->kind != NULL)
      ball->d_kind = w->seeds->kind + i * CAROM_KIND_NUMBERS * m;
    ball->path.from = balls[i].state;
    carom_label_of_layout(&ball->path.from, rates.radius);
    carom_path_begin(&ball->path, &rates, 0.0);
    for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
      for (int j = 0; j < m; j++)
        w->d[0][k][j] = w->seeds->state != NULL ? w->seeds->state[i * numbers + k * m + j] : 0.0;
    if (carom_is_out(ball->path.from.label))
      memset(w->d[0], 0, sizeof w->d[0]);
    carom_tangent_settle(&ball->path.from, ball, m, w->d[0]);
    put(ball->d, w->d[0], m);
  }
}

/* Total tangents before event k, for those who ask. */
__attribute__((noinline)) static void before_again(const work *w, const carom_event *event, const int ball[2], int64_t k,
                                                   const carom_tangent *tangent, carom_reach *reach) {
  const int m = w->m, numbers = CAROM_STATE_NUMBERS * m;
  carom_row d[2][CAROM_STATE_NUMBERS];
  double rate[CAROM_STATE_NUMBERS];
  for (int side = 0; side < 2; side++) {
    double *before = tangent->before != NULL ? tangent->before + (2 * k + side) * numbers : NULL;
    for (int n = 0; n < numbers && before != NULL && ball[side] < 0; n++)
      before[n] = 0.0;
    if (ball[side] < 0)
      continue;
    carom_tangent_flow(&w->ball[ball[side]], event->time, m, rate, d[side]);
    for (int n = 0; n < CAROM_STATE_NUMBERS; n++)
      for (int j = 0; j < m; j++)
        d[side][n][j] += rate[n] * w->d_time[j];
    if (before != NULL)
      put(before, d[side], m);
  }
  if (tangent->reach != NULL)
    carom_reach_event(reach, k, event, d);
}

static carom_status differentiate(work *w, const carom_shot_ball *balls, const carom_shot *shot, carom_tangent *tangent) {
  const int m = w->m, numbers = CAROM_STATE_NUMBERS * m;
  int64_t next = 0;
  carom_reach reach;
  begin(w, balls, tangent->final);
  if (tangent->reach != NULL)
    carom_reach_begin(&reach, w->table, w->ball, w->count, m, tangent->time, tangent->reach);
  for (int64_t k = 0; k <= shot->count; k++) {
    const carom_event *event = k < shot->count ? &shot->events[k] : NULL;
    /* the times before it; after the end nothing moves */
    for (; next < tangent->times_count && (event == NULL || tangent->times[next] < event->time); next++)
      for (int i = 0; i < w->count; i++) {
        carom_tangent_flow(&w->ball[i], fmin(tangent->times[next], shot->time), m, w->rate[0], w->d[0]);
        put(tangent->at + (next * w->count + i) * numbers, w->d[0], m);
      }
    if (event == NULL)
      break;
    const int ball[2] = {event->a, event->type == CAROM_EVENT_BALL_BALL ? event->b : -1};
    if (tangent->reach != NULL)
      carom_reach_misses(&reach, event);
    const carom_status status = follow(w, event);
    if (status < 0)
      return status;
    if (tangent->time != NULL)
      memcpy(tangent->time + k * m, w->d_time, sizeof(double) * (size_t)m);
    /* total tangents before the event once more, since contacts change the rows in place */
    if (tangent->reach != NULL || tangent->before != NULL)
      before_again(w, event, ball, k, tangent, &reach);
    for (int side = 0; side < 2; side++) {
      double *after = tangent->after != NULL ? tangent->after + (2 * k + side) * numbers : NULL;
      if (ball[side] < 0) {
        for (int n = 0; n < numbers && after != NULL; n++)
          after[n] = 0.0;
        continue;
      }
      go_on(w, ball[side], side, event);
      if (after != NULL)
        put(after, w->d[side], m);
      fix_time(w, ball[side], side);
    }
    if (tangent->flags != NULL)
      tangent->flags[k] = w->note.flags;
    tangent->all_flags |= w->note.flags;
    tangent->error = fmax(tangent->error, w->note.error);
  }
  /* the end of the shot, where balls may still move, but nobody knows how they go on */
  for (int i = 0; i < w->count && tangent->times_count > 0; i++) {
    const int64_t label = w->ball[i].path.from.label;
    if (tangent->times[tangent->times_count - 1] > shot->time && label != CAROM_BALL_STATIONARY && !carom_is_out(label))
      return CAROM_ERROR_TIME;
  }
  for (int i = 0; i < w->count; i++) {
    carom_tangent_flow(&w->ball[i], shot->time, m, w->rate[0], w->d[0]);
    put(w->ball[i].d, w->d[0], m);
  }
  return CAROM_OK;
}

static const carom_shot_options no_options = {0};

carom_status carom_shot_tangent(const carom_table *table, const carom_shot_ball *balls, int count, const carom_cue *cue,
                                const carom_shot_options *opt, const carom_shot *shot, const carom_tangent_seeds *seeds,
                                carom_tangent *tangent) {
  if (table == NULL || balls == NULL || shot == NULL || seeds == NULL || tangent == NULL || tangent->final == NULL)
    return CAROM_ERROR_NULL;
  opt = opt != NULL ? opt : &no_options;
  carom_status status = check(table, balls, count, cue, opt, shot, seeds, tangent);
  if (status != CAROM_OK && status != CAROM_ERROR_TANGENT)
    return status;
  tangent->error = 0.0;
  tangent->all_flags = 0;
  work w = {
      .table = table, .cue = cue, .opt = opt, .seeds = seeds, .count = count, .m = (int)seeds->directions, .slow_last = -1.0};
  if (status == CAROM_OK)
    status = differentiate(&w, balls, shot, tangent);
  for (int64_t k = 0; status != CAROM_OK && k < (int64_t)count * CAROM_STATE_NUMBERS * seeds->directions; k++)
    tangent->final[k] = NAN;
  return status;
}

/* ---- Many ---- */

static carom_status row(const carom_tangent_job *job, size_t k) {
  const carom_shot_job *played = job->played;
  const carom_status status = played->status != NULL ? (carom_status)played->status[k] : CAROM_OK;
  if (status < 0)
    return status;
  return carom_shot_tangent(played->table, played->balls + k * played->ball_stride, (int)played->count,
                            played->cues != NULL ? played->cues + k * played->cue_stride : NULL, played->options,
                            &played->shots[k], job->seeds + k * job->seeds_stride, &job->tangents[k]);
}

static size_t rows(const void *context, size_t first, size_t end) {
  const carom_tangent_job *job = context;
  size_t first_bad = end;
  for (size_t k = first; k < end; k++) {
    const carom_status status = row(job, k);
    if (job->status != NULL)
      job->status[k] = (int8_t)status;
    if (status < 0 && first_bad == end)
      first_bad = k;
  }
  return first_bad;
}

carom_status carom_shot_tangent_batch(const carom_tangent_job *job) {
  if (job == NULL || job->played == NULL)
    return CAROM_ERROR_NULL;
  const carom_shot_job *played = job->played;
  if (played->n == 0)
    return CAROM_OK;
  if (played->table == NULL || played->balls == NULL || played->shots == NULL || job->seeds == NULL || job->tangents == NULL)
    return CAROM_ERROR_NULL;
  for (size_t k = 0; k < sizeof job->reserved / sizeof job->reserved[0]; k++)
    if (job->reserved[k] != 0)
      return CAROM_ERROR_SHOT_OPTIONS;
  int where;
  const carom_shot_options *opt = played->options != NULL ? played->options : &no_options;
  const carom_status bad = carom_check_common(played->table, played->count, opt, &where);
  if (bad != CAROM_OK)
    return bad;
  const size_t first_bad = carom_in_threads(rows, job, (size_t)played->n, opt->threads, 4);
  return first_bad == played->n ? CAROM_OK : row(job, first_bad);
}
