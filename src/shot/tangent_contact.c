/* Tangents of contacts on the cloth: of two balls, and of a ball with a rail or a jaw, in the frame of the contact (tangent.h).
 */
#include "cushion/tangent.h"
#include "platform/elementary.h"
#include "shot/tangent_free.h"

#include <math.h>
#include <string.h>

/* ---- Two balls ---- */

double carom_tangent_friction(const carom_tangent_work *w, const carom_event *event, double slip, const double *d_slip,
                              double *d_mu) {
  const carom_tangent_ball *a = &w->ball[event->a], *b = &w->ball[event->b];
  const carom_ball_kind *kind_a = a->kind, *kind_b = b->kind;
  const int m = w->m;
  if (w->opt->friction == CAROM_FRICTION_CONSTANT) {
    for (int k = 0; k < m; k++)
      d_mu[k] = 0.5 * (carom_d_kind(a, CAROM_KIND_ROW(mu_ball), m, k) + carom_d_kind(b, CAROM_KIND_ROW(mu_ball), m, k));
    return 0.5 * (kind_a->mu_ball + kind_b->mu_ball);
  }
  /* the law of each ball, or the usual one, whose numbers do not change */
  const carom_speed_law usual = carom_alciatore();
  const bool own_a = kind_a->law_a + kind_a->law_b + kind_a->law_c > 0.0,
             own_b = kind_b->law_a + kind_b->law_b + kind_b->law_c > 0.0;
  const double l[3] = {0.5 * ((own_a ? kind_a->law_a : usual.a) + (own_b ? kind_b->law_a : usual.a)),
                       0.5 * ((own_a ? kind_a->law_b : usual.b) + (own_b ? kind_b->law_b : usual.b)),
                       0.5 * ((own_a ? kind_a->law_c : usual.c) + (own_b ? kind_b->law_c : usual.c))};
  const double fades = carom_exp(-l[2] * slip);
  for (int k = 0; k < m; k++) {
    double d[3];
    for (int r = 0; r < 3; r++)
      d[r] = 0.5 * ((own_a ? carom_d_kind(a, CAROM_KIND_ROW(law_a) + r, m, k) : 0.0) +
                    (own_b ? carom_d_kind(b, CAROM_KIND_ROW(law_a) + r, m, k) : 0.0));
    d_mu[k] = d[0] + fades * (d[1] - l[1] * (d[2] * slip + l[2] * d_slip[k]));
  }
  return l[0] + l[1] * fades;
}

/* The same in the frame, where x is the t = n x z of models.c. */
static void friction(const carom_tangent_work *w, const carom_event *event, double in[CAROM_BALLS_INS],
                     carom_row din[CAROM_BALLS_INS]) {
  const int B = CAROM_BALL_INS;
  const double along = in[OF_V_X] - in[B + OF_V_X] - (in[OF_W_Z] + in[B + OF_W_Z]);
  const double up = (in[OF_C_Y] - in[OF_V_Y]) + (in[B + OF_C_Y] - in[B + OF_V_Y]), slip = sqrt(along * along + up * up);
  carom_row d_slip;
  for (int k = 0; k < w->m; k++) {
    const double d_along = din[OF_V_X][k] - din[B + OF_V_X][k] - (din[OF_W_Z][k] + din[B + OF_W_Z][k]);
    const double d_up = (din[OF_C_Y][k] - din[OF_V_Y][k]) + (din[B + OF_C_Y][k] - din[B + OF_V_Y][k]);
    d_slip[k] = slip > 0.0 ? (along * d_along + up * d_up) / slip : 0.0;
  }
  in[BALLS_MU] = carom_tangent_friction(w, event, slip, d_slip, din[BALLS_MU]);
}

carom_status carom_tangent_balls(carom_tangent_work *w, const carom_event *event) {
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
  carom_tangent_total(w, 0);
  carom_tangent_total(w, 1);
  for (int j = 0; j < m; j++)
    turn[j] = -(c * (w->d[1][S_X][j] - w->d[0][S_X][j]) + s * (w->d[1][S_Y][j] - w->d[0][S_Y][j])) / distance;
  if (closing < CAROM_GRAZING * sqrt(v_x * v_x + v_y * v_y))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  if (closing < carom_slow_speed(w->slow_instants)) {
    carom_normal at = {.N = {y_x, y_y}};
    for (int j = 0; j < m; j++) {
      at.dN[0][j] = -turn[j] * c;
      at.dN[1][j] = -turn[j] * s;
    }
    carom_tangent_part_balls(w, event, &at, false);
    return CAROM_OK;
  }
  /* in the frame */
  double in[CAROM_BALLS_INS];
  carom_row din[CAROM_BALLS_INS], dout[CAROM_BALLS_OUTS];
  for (int k = 0; k < 2; k++)
    carom_tangent_to_frame(before[k].v, before[k].w, R, c, s, ball[k]->path.from.label != CAROM_BALL_SLIDING, m, turn,
                           carom_seeds_row(ball[k]->d_kind, CAROM_KIND_ROW(radius), m), w->d[k] + S_V_X,
                           in + k * CAROM_BALL_INS, din + k * CAROM_BALL_INS);
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
  if (w->opt->ball_model == CAROM_BALL_MODEL_MIRROR) {
    carom_mirror_balls_tangent(in, m, din, dout);
  } else {
    friction(w, event, in, din);
    if (w->opt->ball_model == CAROM_BALL_MODEL_INELASTIC)
      carom_inelastic_balls_tangent(in, m, din, dout, &w->note);
    else
      status = carom_exact_balls_tangent(in, w->opt->plain, m, din, dout, &w->note);
  }
  for (int k = 0; k < 2; k++)
    carom_tangent_from_frame(event->after[k].v, event->after[k].w, R, c, s, m, turn,
                             carom_seeds_row(ball[k]->d_kind, CAROM_KIND_ROW(radius), m), dout + k * CAROM_BALL_INS,
                             w->d[k] + S_V_X);
  return status;
}

/* ---- Cushions ---- */

void carom_tangent_nose_of(const carom_tangent_work *w, const carom_event *event, carom_tangent_nose *n, double *in,
                           carom_row *din) {
  const int m = w->m;
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_kind *kind = ball->kind;
  const double R = kind->radius, ref = w->reference, *of_table = w->seeds->table;
  const carom_due due = {event->time, event->type, event->a, event->b};
  const carom_nose nose = carom_nose_of(w->table, &due);
  const bool own_height = kind->nose_height > 0.0, own_radius = R != ref, flat = w->opt->space == CAROM_SPACE_FLAT;
  const double h = carom_nose_height(kind, nose.height), root = sqrt(h * (2.0 * ref - h)), own_root = sqrt(h * (2.0 * R - h));
  n->height = h;
  n->shift = carom_nose_shift(h, ref);
  n->reach = flat ? R : carom_reach_on_cloth(kind, h, ref);
  in[NOSE_MU_S] = kind->mu_slide;
  in[NOSE_MU_W] = nose.mu_cushion > 0.0 ? nose.mu_cushion : kind->mu_cushion;
  in[NOSE_E] = nose.restitution > 0.0 ? nose.restitution : kind->restitution_cushion;
  in[NOSE_SINE] = (h - R) / R;
  in[NOSE_RATIO] = kind->omega_ratio > 0.0 ? kind->omega_ratio : 1.8;
  const carom_tangent_ball *last = &w->ball[w->count - 1];
  for (int j = 0; j < m; j++) {
    const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
    const double d_ref = w->table->ball_radius > 0.0 ? 0.0 : carom_d_kind(last, CAROM_KIND_ROW(radius), m, j);
    const double dh = own_height ? carom_d_kind(ball, CAROM_KIND_ROW(nose_height), m, j) : carom_seed(of_table, j);
    n->d_height[j] = dh;
    n->d_shift[j] = d_ref - (dh * (ref - h) + h * d_ref) / root;
    n->d_reach[j] = flat || !own_radius ? dR : n->d_shift[j] + (dh * (R - h) + h * dR) / own_root;
    din[NOSE_MU_S][j] = carom_d_kind(ball, CAROM_KIND_ROW(mu_slide), m, j);
    din[NOSE_MU_W][j] = nose.mu_cushion > 0.0 ? carom_seed(carom_seeds_row(of_table, 1, m), j)
                                              : carom_d_kind(ball, CAROM_KIND_ROW(mu_cushion), m, j);
    din[NOSE_E][j] = nose.restitution > 0.0 ? carom_seed(carom_seeds_row(of_table, 2, m), j)
                                            : carom_d_kind(ball, CAROM_KIND_ROW(restitution_cushion), m, j);
    din[NOSE_SINE][j] = dh / R - h / (R * R) * dR;
    din[NOSE_RATIO][j] = kind->omega_ratio > 0.0 ? carom_d_kind(ball, CAROM_KIND_ROW(omega_ratio), m, j) : 0.0;
  }
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
 * may be known all the same, but is that of another motion. out: that motion, in the frame; where it is the one after the event
 * the shot has had it, and the model is not asked. */
static bool was_in_steps(const carom_event *event, const carom_ball_kind *kind, double height, const double normal[2],
                         const double in[CAROM_NOSE_INS], const double out[CAROM_BALL_INS], int plain) {
  const double *v = event->after[0].v, *w = event->after[0].w, c = normal[1], s = -normal[0], R = kind->radius;
  const double there[CAROM_BALL_INS] = {c * v[0] + s * v[1], c * v[1] - s * v[0], R * (c * w[0] + s * w[1]),
                                        R * (c * w[1] - s * w[0]), R * w[2]};
  double apart = 0.0, size = 0.0;
  for (int k = 0; k < CAROM_BALL_INS; k++) {
    apart = fmax(apart, fabs(out[k] - there[k]));
    size = fmax(size, fabs(out[k]));
  }
  if (apart < 1e-6 * size)
    return false;
  const carom_ball_state *before = &event->before[0];
  const carom_cushion_impact impact = {.v = {before->v[0], before->v[1], 0.0},
                                       .w = {before->w[0], before->w[1], before->w[2]},
                                       .normal = {normal[0], normal[1]},
                                       .height = height,
                                       .radius = R,
                                       .mass = kind->mass,
                                       .mu_cloth = in[NOSE_MU_S],
                                       .mu_cushion = in[NOSE_MU_W],
                                       .restitution = in[NOSE_E]};
  const carom_cushion_options options = {.plain = plain};
  carom_motion unused;
  return carom_cushion(&impact, &options, &unused) == CAROM_ERROR_UNRESOLVED;
}

/* The motion after is that before. */
static void stay(const double in[CAROM_NOSE_INS], int m, carom_row din[CAROM_NOSE_INS], double out[CAROM_BALL_INS],
                 carom_row dout[CAROM_BALL_INS]) {
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

carom_status carom_tangent_flat_nose(carom_tangent_work *w, const carom_event *event, const carom_normal *into, bool rolls,
                                     double height, double *in, carom_row *din, double v[3], double spin[3], carom_row d[5]) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_state *before = &event->before[0];
  const double *N = into->N, R = ball->kind->radius, size = sqrt(N[0] * N[0] + N[1] * N[1]);
  const double normal[2] = {N[0] / size, N[1] / size}, c = normal[1], s = -normal[0];
  const double *dR = carom_seeds_row(ball->d_kind, CAROM_KIND_ROW(radius), w->m);
  double out[CAROM_BALL_INS];
  carom_row turn, dout[CAROM_BALL_INS];
  for (int j = 0; j < w->m; j++)
    turn[j] = -(c * into->dN[0][j] + s * into->dN[1][j]) / size;
  carom_tangent_to_frame(before->v, before->w, R, c, s, rolls, w->m, turn, dR, w->d[0] + S_V_X, in, din);
  /* the model */
  carom_cushion_options options = {.steps = w->opt->steps, .plain = w->opt->plain, .omega_ratio = in[NOSE_RATIO]};
  const carom_shot_cushion asked = w->opt->cushion_model;
  options.model = asked != CAROM_SHOT_CUSHION_DEFAULT ? (carom_cushion_model)((int)asked - 1) : CAROM_CUSHION_HAN;
  carom_status status = CAROM_OK;
  if (!(in[OF_V_Y] > 0.0)) { /* it falls on the nose, but does not move into the cushion */
    stay(in, w->m, din, out, dout);
  } else {
    status = carom_nose_tangent(in, &options, w->m, din, dout, out, &w->note);
    if (options.model == CAROM_CUSHION_MATHAVAN &&
        (status == CAROM_ERROR_UNRESOLVED || was_in_steps(event, ball->kind, height, normal, in, out, w->opt->plain))) {
      options.model = CAROM_CUSHION_EULER;
      status = carom_nose_tangent(in, &options, w->m, din, dout, out, &w->note);
    }
  }
  lose_roll(ball, in[OF_V_X], din[OF_V_X], w->m, out, dout);
  /* back in the axes of the table */
  v[0] = c * out[OF_V_X] - s * out[OF_V_Y];
  v[1] = s * out[OF_V_X] + c * out[OF_V_Y];
  spin[0] = (c * out[OF_W_X] - s * out[OF_W_Y]) / R;
  spin[1] = (s * out[OF_W_X] + c * out[OF_W_Y]) / R;
  spin[2] = out[OF_W_Z] / R;
  carom_tangent_from_frame(v, spin, R, c, s, w->m, turn, dR, dout, d);
  return status;
}

carom_status carom_tangent_cushion(carom_tangent_work *w, const carom_event *event) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_state *before = &event->before[0];
  double in[CAROM_NOSE_INS];
  carom_row din[CAROM_NOSE_INS];
  carom_tangent_nose nose;
  carom_tangent_nose_of(w, event, &nose, in, din);
  /* the direction into the cushion */
  carom_normal into = {.N = {0.0}};
  double *N = into.N, distance = INFINITY;
  if (event->type == CAROM_EVENT_RAIL) {
    double line[3];
    carom_rail_line(&w->table->rail[event->b], line);
    N[0] = -line[0];
    N[1] = -line[1];
  } else {
    const carom_jaw *jaw = &w->table->jaw[event->b];
    const double x = jaw->centre[0] - before->r[0], y = jaw->centre[1] - before->r[1];
    distance = sqrt(x * x + y * y);
    N[0] = x / distance;
    N[1] = y / distance;
  }
  const double closing = carom_dot(before->v, N);
  for (int j = 0; j < w->m; j++)
    w->d_time[j] = -(N[0] * w->d[0][S_X][j] + N[1] * w->d[0][S_Y][j] + nose.d_reach[j]) / closing;
  carom_tangent_total(w, 0);
  for (int j = 0; j < w->m; j++) {
    const double turns = (N[1] * w->d[0][S_X][j] - N[0] * w->d[0][S_Y][j]) / distance;
    into.dN[0][j] = -turns * N[1];
    into.dN[1][j] = turns * N[0];
  }
  if (closing < CAROM_GRAZING * sqrt(carom_dot(before->v, before->v)))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  /* as carom_resolve_cushion() decides it */
  double v[1][3], spin[1][3];
  memcpy(v[0], before->v, sizeof v[0]);
  memcpy(spin[0], before->w, sizeof spin[0]);
  carom_status status = CAROM_OK;
  const bool slow = closing < carom_slow_speed(w->slow_instants);
  if (!slow)
    status = carom_tangent_flat_nose(w, event, &into, ball->path.from.label != CAROM_BALL_SLIDING, nose.height, in, din, v[0],
                                     spin[0], w->d[0] + S_V_X);
  if (slow || carom_dot(v[0], N) > 0.0)
    carom_tangent_part(w, event, 1, &into, false, (const double(*)[3])v, (const double(*)[3])spin);
  return status;
}
