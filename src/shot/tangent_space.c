/* Tangents of contacts in space: of a ball in flight with a nose, and of two balls of which one flies or whose radii differ. */
#include "cushion/tangent.h"
#include "shot/tangent_free.h"

#include <math.h>
#include <string.h>

/* ---- Noses in flight ---- */

/* The vector from a nose to the centre, in the plane across it: N = -(across out, up)/|.|, with its tangents at the places dr,
 * which are those of the ball in w->d. */
typedef struct arm {
  double out[2], across, up, q; /* q: distance from the axis of a jaw, infinite of a rail */
} arm;

static arm arm_of(const carom_tangent_work *w, const carom_event *event, const carom_tangent_nose *nose) {
  const double *r = event->before[0].r;
  arm a = {.up = r[2] - nose->height, .q = INFINITY};
  if (event->type == CAROM_EVENT_RAIL) {
    double line[3];
    carom_rail_line(&w->table->rail[event->b], line);
    a.out[0] = line[0];
    a.out[1] = line[1];
    a.across = line[0] * r[0] + line[1] * r[1] + line[2] - nose->shift;
    return a;
  }
  const carom_jaw *jaw = &w->table->jaw[event->b];
  const double x = r[0] - jaw->centre[0], y = r[1] - jaw->centre[1];
  a.q = sqrt(x * x + y * y);
  a.out[0] = a.q > 0.0 ? x / a.q : 0.0;
  a.out[1] = a.q > 0.0 ? y / a.q : 0.0;
  a.across = a.q - jaw->radius - nose->shift;
  a.q = a.q > 0.0 ? a.q : INFINITY; /* above the axis N is upright */
  return a;
}

/* The tangents of `across` and `up` in column j, from those of the place. */
static void d_arm(const arm *a, const carom_tangent_nose *nose, carom_row d[CAROM_STATE_NUMBERS], int j, double to[2]) {
  to[0] = a->out[0] * d[S_X][j] + a->out[1] * d[S_Y][j] - nose->d_shift[j];
  to[1] = d[S_Z][j] - nose->d_height[j];
}

/* The motion by the flat model, which has a part in that near the cloth (resolve.c), with tangents of v_x, v_y, w, v_z. */
typedef struct flat_motion {
  double v[3], w[3];
  carom_row d[6];
} flat_motion;

/* The result without the cloth, in v, spin and w->d. */
__attribute__((noinline)) static carom_status free_part(carom_tangent_work *w, const carom_event *event,
                                                        const carom_normal *into, const double *in, carom_row *din, double v[3],
                                                        double spin[3]) {
  const carom_shot_cushion asked = w->opt->cushion_model;
  const carom_cushion_model model = asked == CAROM_SHOT_CUSHION_STRONGE  ? CAROM_CUSHION_STRONGE
                                    : asked == CAROM_SHOT_CUSHION_MIRROR ? CAROM_CUSHION_MIRROR
                                                                         : CAROM_CUSHION_HAN;
  const carom_tangent_ball *ball = &w->ball[event->a];
  carom_free_touch t = {.mu = in[NOSE_MU_W], .e = in[NOSE_E], .ratio = in[NOSE_RATIO]};
  t.at = *into;
  memcpy(t.d_mu, din[NOSE_MU_W], sizeof t.d_mu);
  memcpy(t.d_e, din[NOSE_E], sizeof t.d_e);
  memcpy(t.d_ratio, din[NOSE_RATIO], sizeof t.d_ratio);
  carom_touch_alone(w, ball, &event->before[0], &t);
  const carom_status status = carom_free_impulse(&t, model, w->m, &w->note);
  carom_take_free(w, ball, &t);
  double turn[3], unused[3];
  carom_free_torque(&t, 0, turn, unused);
  for (int k = 0; k < 3; k++) {
    v[k] += t.f[k] - t.P * t.at.N[k];
    spin[k] += 2.5 / ball->kind->radius * turn[k];
  }
  return status;
}

/* (1 - chi) of the flat result and chi of the free one, which is in v, spin and w->d. */
static void blend(carom_tangent_work *w, const carom_tangent_ball *ball, double height, const flat_motion *flat, double v[3],
                  double spin[3]) {
  static const int at[3] = {0, 1, 5};
  const double near = 1e-3, chi = (height - ball->kind->radius) / near; /* m, as in models.c */
  for (int k = 0; k < 3; k++) {
    carom_row *of_v = &w->d[0][CAROM_S_V[k]], *of_w = &w->d[0][CAROM_S_W[k]];
    for (int j = 0; j < w->m; j++) {
      const double d_chi = (w->d[0][S_Z][j] - carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j)) / near;
      (*of_v)[j] = (1.0 - chi) * flat->d[at[k]][j] + chi * (*of_v)[j] + d_chi * (v[k] - flat->v[k]);
      (*of_w)[j] = (1.0 - chi) * flat->d[2 + k][j] + chi * (*of_w)[j] + d_chi * (spin[k] - flat->w[k]);
    }
    v[k] = (1.0 - chi) * flat->v[k] + chi * v[k];
    spin[k] = (1.0 - chi) * flat->w[k] + chi * spin[k];
  }
}

/* When a ball in flight touches a nose, |(across, up)| = R, and how N turns. Returns what closes. */
static double reach_nose(carom_tangent_work *w, const carom_event *event, const carom_tangent_nose *nose, carom_normal *into) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_state *s = &event->before[0];
  const arm a = arm_of(w, event, nose);
  const double size = sqrt(a.across * a.across + a.up * a.up), part = a.across / size, rise = a.up / size;
  const double N[3] = {-part * a.out[0], -part * a.out[1], -rise}, closing = carom_dot(s->v, N);
  double d[2];
  for (int j = 0; j < w->m; j++) {
    d_arm(&a, nose, w->d[0], j, d);
    w->d_time[j] = (part * d[0] + rise * d[1] - carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j)) / closing;
  }
  carom_tangent_total(w, 0);
  memcpy(into->N, N, sizeof N);
  for (int j = 0; j < w->m; j++) {
    d_arm(&a, nose, w->d[0], j, d);
    const double longer = part * d[0] + rise * d[1], d_part = (d[0] - part * longer) / size,
                 d_rise = (d[1] - rise * longer) / size;
    const double dx = w->d[0][S_X][j], dy = w->d[0][S_Y][j], dq = a.out[0] * dx + a.out[1] * dy;
    into->dN[0][j] = -d_part * a.out[0] - part * (dx - a.out[0] * dq) / a.q;
    into->dN[1][j] = -d_part * a.out[1] - part * (dy - a.out[1] * dq) / a.q;
    into->dN[2][j] = -d_rise;
  }
  return closing;
}

/* As carom_resolve_cushion() and carom_model_nose() decide it. */
carom_status carom_tangent_nose_in_flight(carom_tangent_work *w, const carom_event *event) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_state *s = &event->before[0];
  carom_tangent_nose nose;
  carom_normal into;
  double in[CAROM_NOSE_INS], v[3], spin[3];
  carom_row din[CAROM_NOSE_INS];
  carom_tangent_nose_of(w, event, &nose, in, din);
  const double closing = reach_nose(w, event, &nose, &into), slow = carom_slow_speed(w->slow_instants);
  if (closing < CAROM_GRAZING * sqrt(carom_dot(s->v, s->v)))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  memcpy(v, s->v, sizeof v);
  memcpy(spin, s->w, sizeof spin);
  carom_status status = CAROM_OK;
  if (closing >= slow) {
    const bool is_near = s->r[2] - ball->kind->radius < 1e-3;
    flat_motion flat;
    if (is_near) {
      status = carom_tangent_flat_nose(w, event, &into, false, nose.height, in, din, flat.v, flat.w, flat.d);
      flat.v[2] = fmin(s->v[2], 0.0);
      for (int j = 0; j < w->m; j++)
        flat.d[5][j] = s->v[2] < 0.0 ? w->d[0][S_V_Z][j] : 0.0;
    }
    if (status == CAROM_OK)
      status = free_part(w, event, &into, in, din, v, spin);
    if (status == CAROM_OK && is_near)
      blend(w, ball, s->r[2], &flat, v, spin);
  }
  if (closing < slow || carom_dot(v, into.N) > 0.0)
    carom_tangent_part(w, event, 1, &into, true, (const double(*)[3]) & v, (const double(*)[3]) & spin);
  return status;
}

/* ---- Two balls ---- */

/* The impact of spheres.c. */
static carom_status collide(carom_tangent_work *w, const carom_event *event, carom_free_touch *t) {
  const int m = w->m;
  const carom_tangent_ball *ball[2] = {&w->ball[event->a], &w->ball[event->b]};
  const carom_ball_state *s = event->before;
  const carom_ball_kind *a = ball[0]->kind, *b = ball[1]->kind;
  double v[3], spin[3];
  for (int k = 0; k < 3; k++) {
    v[k] = s[0].v[k] - s[1].v[k];
    spin[k] = a->radius * s[0].w[k] + b->radius * s[1].w[k];
  }
  carom_touch_slip(t, v, spin);
  const double slip = sqrt(carom_dot(t->u, t->u));
  carom_row d_slip;
  for (int j = 0; j < m; j++) {
    double dv[3], d_spin[3];
    for (int k = 0; k < 3; k++) {
      dv[k] = w->d[0][CAROM_S_V[k]][j] - w->d[1][CAROM_S_V[k]][j];
      d_spin[k] = 0.0;
      for (int side = 0; side < 2; side++)
        d_spin[k] += ball[side]->kind->radius * w->d[side][CAROM_S_W[k]][j] +
                     carom_d_kind(ball[side], CAROM_KIND_ROW(radius), m, j) * s[side].w[k];
    }
    carom_touch_slip_tangent(t, j, v, spin, dv, d_spin);
    d_slip[j] = slip > 0.0 ? (t->u[0] * t->du[0][j] + t->u[1] * t->du[1][j] + t->u[2] * t->du[2][j]) / slip : 0.0;
    t->d_e[j] = 0.5 * (carom_d_kind(ball[0], CAROM_KIND_ROW(restitution), m, j) +
                       carom_d_kind(ball[1], CAROM_KIND_ROW(restitution), m, j));
    t->d_ratio[j] = 0.0;
  }
  t->e = 0.5 * (a->restitution + b->restitution);
  t->ratio = 1.8;
  const bool mirror = w->opt->ball_model == CAROM_BALL_MODEL_MIRROR;
  t->mu = mirror ? 0.0 : carom_tangent_friction(w, event, slip, d_slip, t->d_mu);
  const carom_status status = carom_free_impulse(t, mirror ? CAROM_CUSHION_MIRROR : CAROM_CUSHION_HAN, m, &w->note);
  /* the impulses over each mass: 1/(B m_a) = m_b/(m_a + m_b) */
  const double total = a->mass + b->mass;
  for (int side = 0; side < 2; side++) {
    const double R = ball[side]->kind->radius, part = ball[1 - side]->kind->mass / total, sign = side == 0 ? -1.0 : 1.0;
    for (int j = 0; j < m; j++) {
      const double own = carom_d_kind(ball[side], CAROM_KIND_ROW(mass), m, j),
                   other = carom_d_kind(ball[1 - side], CAROM_KIND_ROW(mass), m, j);
      const double d_part = ((1.0 - part) * other - part * own) / total;
      const double d_per = d_part - part / R * carom_d_kind(ball[side], CAROM_KIND_ROW(radius), m, j);
      double turn[3], d_turn[3];
      carom_free_torque(t, j, turn, d_turn);
      for (int k = 0; k < 3; k++) {
        const double impulse = t->P * t->at.N[k] - t->f[k], d = t->dP[j] * t->at.N[k] + t->P * t->at.dN[k][j] - t->df[k][j];
        w->d[side][CAROM_S_V[k]][j] += sign * (part * d + d_part * impulse);
        w->d[side][CAROM_S_W[k]][j] += 2.5 / R * (part * d_turn[k] + d_per * turn[k]);
      }
    }
  }
  return status;
}

carom_status carom_tangent_spheres(carom_tangent_work *w, const carom_event *event) {
  const int m = w->m;
  const carom_tangent_ball *ball[2] = {&w->ball[event->a], &w->ball[event->b]};
  const carom_ball_state *s = event->before;
  const double distance = ball[0]->kind->radius + ball[1]->kind->radius;
  carom_free_touch t;
  carom_line_of_centres(ball[0]->kind, &s[0], ball[1]->kind, &s[1], t.at.N);
  const double v[3] = {s[0].v[0] - s[1].v[0], s[0].v[1] - s[1].v[1], s[0].v[2] - s[1].v[2]}, closing = carom_dot(v, t.at.N);
  if (closing < CAROM_GRAZING * sqrt(carom_dot(v, v)))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  /* when they touch, and how the line of centres turns */
  for (int j = 0; j < m; j++) {
    double apart = 0.0;
    for (int k = 0; k < 3; k++)
      apart += t.at.N[k] * (w->d[1][CAROM_S_R[k]][j] - w->d[0][CAROM_S_R[k]][j]);
    for (int side = 0; side < 2; side++)
      apart -= carom_d_kind(ball[side], CAROM_KIND_ROW(radius), m, j);
    w->d_time[j] = apart / closing;
  }
  carom_tangent_total(w, 0);
  carom_tangent_total(w, 1);
  for (int j = 0; j < m; j++) {
    double d[3];
    for (int k = 0; k < 3; k++)
      d[k] = (w->d[1][CAROM_S_R[k]][j] - w->d[0][CAROM_S_R[k]][j]) / distance;
    const double along = carom_dot(d, t.at.N);
    for (int k = 0; k < 3; k++)
      t.at.dN[k][j] = d[k] - along * t.at.N[k];
  }
  carom_status status = CAROM_OK;
  if (closing < carom_slow_speed(w->slow_instants)) {
    carom_tangent_part_balls(w, event, &t.at, true);
  } else {
    status = collide(w, event, &t);
  }
  /* what has no vertical speed but for rounding stays on the cloth, though a change would lift it */
  for (int side = 0; side < 2; side++)
    for (int j = 0; j < m && !carom_flies(&event->after[side]); j++)
      if (w->d[side][S_V_Z][j] != 0.0)
        w->note.flags |= CAROM_TANGENT_KINK;
  return status;
}
