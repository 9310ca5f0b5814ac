/* Tangents of how a flight ends but on a ball or a nose: on the slate or the top of a rail, in a pocket, off the table. */
#include "shot/fixed.h"
#include "shot/tangent_free.h"

#include <math.h>
#include <string.h>

/* ---- Slate and tops of rails ---- */

/* The impact on the slate of fixed.c. *s: the motion before. */
static carom_status hit_slate(carom_tangent_work *w, const carom_tangent_ball *ball, const carom_ball_state *s) {
  const carom_ball_kind *kind = ball->kind;
  const int m = w->m;
  const double given = kind->restitution_table, e = given == 0.0 ? 0.5 : given > 0.0 ? given : 0.0;
  carom_free_touch t = {.at = {.N = {0.0, 0.0, -1.0}}, .mu = kind->mu_slide, .ratio = 1.8};
  memset(t.at.dN, 0, sizeof t.at.dN);
  memset(t.d_ratio, 0, sizeof t.d_ratio);
  carom_touch_alone(w, ball, s, &t);
  const double v_n = t.closing, up = carom_rebound(fmax(v_n, 0.0), e);
  /* the end of hops, where the derivative of v' grows without bound */
  if (up < CAROM_GRAZING * e * v_n && carom_rebound((1.0 + CAROM_GRAZING) * v_n, e) > 0.0)
    w->note.flags |= CAROM_TANGENT_GRAZING;
  t.e = v_n > 0.0 ? up / v_n : 0.0;
  for (int j = 0; j < m; j++) {
    const double de = given > 0.0 ? carom_d_kind(ball, CAROM_KIND_ROW(restitution_table), m, j) : 0.0;
    const double d_up = up > 0.0 ? e * v_n * (e * t.d_closing[j] + de * v_n) / up : 0.0;
    t.d_e[j] = v_n > 0.0 ? (d_up - t.e * t.d_closing[j]) / v_n : 0.0;
    t.d_mu[j] = carom_d_kind(ball, CAROM_KIND_ROW(mu_slide), m, j);
  }
  const carom_status status = carom_free_impulse(&t, CAROM_CUSHION_HAN, m, &w->note);
  carom_take_free(w, ball, &t);
  /* the friction of turning on the spot, for the same impulse */
  const double per = 2.5 / kind->radius, fall = per * kind->mu_spin * t.P, sign = s->w[2] > 0.0 ? 1.0 : -1.0;
  const bool stops = fabs(s->w[2]) <= fall;
  if (fabs(fabs(s->w[2]) - fall) < 1e-9 * fall)
    w->note.flags |= CAROM_TANGENT_KINK;
  for (int j = 0; j < m; j++) {
    const double d_fall = per * (carom_d_kind(ball, CAROM_KIND_ROW(mu_spin), m, j) * t.P + kind->mu_spin * t.dP[j]) -
                          fall / kind->radius * carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
    w->d[0][S_W_Z][j] = stops ? 0.0 : w->d[0][S_W_Z][j] - sign * d_fall;
  }
  return status;
}

/* A landing on the slate, or on the top of a rail, which has a height of its own. */
carom_status carom_tangent_fall(carom_tangent_work *w, const carom_event *event) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_state *before = &event->before[0];
  carom_row d_plane;
  for (int j = 0; j < w->m; j++)
    d_plane[j] = carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j);
  if (event->type == CAROM_EVENT_RAIL_TOP) {
    const bool own = ball->kind->nose_height > 0.0;
    for (int j = 0; j < w->m; j++)
      d_plane[j] += own ? carom_d_kind(ball, CAROM_KIND_ROW(nose_height), w->m, j) : carom_seed(w->seeds->table, j);
  }
  /* a ball of a layout that lies on the cloth though it is said to fly does not fall */
  const double v_z = before->v[2];
  for (int j = 0; j < w->m; j++)
    w->d_time[j] = v_z < 0.0 ? (d_plane[j] - w->d[0][S_Z][j]) / v_z : 0.0;
  if (!(v_z < 0.0))
    w->note.flags |= CAROM_TANGENT_KINK;
  carom_tangent_total(w, 0);
  memcpy(w->d[0][S_Z], d_plane, sizeof d_plane);
  return hit_slate(w, ball, before);
}

/* After a strike by a level cue, whose tangents raise it: the ball falls at a speed that is 0. An elevation below 0 there is
 * not, so this is the derivative to one side. */
carom_status carom_tangent_level_strike(carom_tangent_work *w, const carom_event *event) {
  w->note.flags |= CAROM_TANGENT_KINK;
  return hit_slate(w, &w->ball[event->a], &event->after[0]);
}

/* ---- Pockets, leaving ---- */

/* The landing of a ball that does not land by an event of its own. */
static void at_landing(carom_tangent_work *w, const carom_tangent_ball *ball) {
  const double v_z = w->rate[0][S_Z];
  for (int j = 0; j < w->m; j++)
    w->d_time[j] = v_z < 0.0 ? (carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j) - w->d[0][S_Z][j]) / v_z : 0.0;
}

void carom_tangent_pocket(carom_tangent_work *w, const carom_event *event) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_pocket *p = &w->table->pocket[event->b];
  const carom_ball_state *s = &event->before[0];
  const double x = s->r[0] - p->centre[0], y = s->r[1] - p->centre[1], *v = s->v, rate = x * v[0] + y * v[1];
  const double place = sqrt(x * x + y * y);
  /* over the circle a ball falls where it lands, or at the far side */
  if (carom_flies(s) && place < p->radius - 1e-9) {
    at_landing(w, ball);
  } else {
    if (fabs(rate) < CAROM_GRAZING * place * sqrt(v[0] * v[0] + v[1] * v[1]))
      w->note.flags |= CAROM_TANGENT_GRAZING;
    for (int j = 0; j < w->m; j++)
      w->d_time[j] = -(x * w->d[0][S_X][j] + y * w->d[0][S_Y][j]) / rate;
  }
  carom_tangent_total(w, 0);
}

/* A ball that lies on a rail, lands beyond the cushions, or comes to the edge of the rails: flight.c. */
void carom_tangent_leave(carom_tangent_work *w, const carom_event *event) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_state *s = &event->before[0];
  const double now = event->time;
  if (s->v[2] == 0.0 && now <= ball->path.start) {
    for (int j = 0; j < w->m; j++) /* v_z = 0 */
      w->d_time[j] = w->d[0][S_V_Z][j] / ball->kind->gravity;
  } else if (now >= ball->path.end - 1e-12) {
    at_landing(w, ball);
  } else {
    carom_features features;
    carom_features_of(w->table, ball->kind->radius, w->reference, &features);
    /* the side that is nearest */
    int k = 0;
    double least = INFINITY;
    for (int side = 0; side < 4; side++) {
      const double edge = features.hull[side] + (side % 2 == 0 ? -features.width : features.width);
      const double off = fabs(s->r[side / 2] - edge);
      k = off < least ? side / 2 : k;
      least = fmin(off, least);
    }
    for (int j = 0; j < w->m; j++)
      w->d_time[j] = s->v[k] != 0.0 ? -w->d[0][k == 0 ? S_X : S_Y][j] / s->v[k] : 0.0;
    if (least > 1e-9) /* it was beyond at the start of its flight */
      w->note.flags |= CAROM_TANGENT_KINK;
  }
  carom_tangent_total(w, 0);
}
