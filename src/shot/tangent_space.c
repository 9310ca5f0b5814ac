/* Tangents of what happens in space: slate, noses and tops of rails in flight, balls along any line of centres; pockets in
 * flight; balls that leave the table.
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
#include "cushion/tangent.h"
#include "shot/fixed.h"
#include "shot/tangent_work.h"

#include <math.h>
#include <string.h>

static const double GRAZING = 0.01; /* closing over relative speed, and speeds of a hop */

/* The rows of a place, a velocity and a spin. */
static const int X[3] = {S_X, S_Y, S_Z}, V[3] = {S_V_X, S_V_Y, S_V_Z}, W[3] = {S_W_X, S_W_Y, S_W_Z};

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}
static void column(carom_row d[CAROM_STATE_NUMBERS], const int rows[3], int j, double to[3]) {
  for (int k = 0; k < 3; k++)
    to[k] = d[rows[k]][j];
}
static bool flies(const carom_ball_state *s) {
  return s->label == CAROM_BALL_AIRBORNE;
}

/* ---- Free impacts ---- */

typedef struct touch {
  double N[3], closing, u[3]; /* u: the slip, across N */
  double mu, e, ratio;        /* ratio: of Stronge's nose */
  carom_row dN[3], d_closing, du[3], d_mu, d_e, d_ratio;
  double P, f[3];
  carom_row dP, df[3];
} touch;

/* The slip of surfaces with the relative velocity v, whose spins times radii add up to spin, and what closes; with tangents in
 * column j, for which dN[.][j] is there. */
static void touch_at(touch *t, const double v[3], const double spin[3]) {
  double turn[3];
  t->closing = dot(v, t->N);
  cross(spin, t->N, turn);
  for (int k = 0; k < 3; k++)
    t->u[k] = v[k] - t->closing * t->N[k] + turn[k];
}
static void d_touch_at(touch *t, int j, const double v[3], const double spin[3], const double dv[3], const double d_spin[3]) {
  const double dN[3] = {t->dN[0][j], t->dN[1][j], t->dN[2][j]};
  double turn[3], more[3];
  t->d_closing[j] = dot(dv, t->N) + dot(v, dN);
  cross(d_spin, t->N, turn);
  cross(spin, dN, more);
  for (int k = 0; k < 3; k++)
    t->du[k][j] = dv[k] - t->d_closing[j] * t->N[k] - t->closing * dN[k] + turn[k] + more[k];
}

/* P and f, with their tangents, by a model of a nose. */
static carom_status free_impulse(touch *t, carom_cushion_model model, int m, carom_tangent_note *note) {
  /* across N: level, and the third */
  const double size = sqrt(t->N[0] * t->N[0] + t->N[1] * t->N[1]);
  const double across[3] = {size > 0.0 ? t->N[1] / size : 1.0, size > 0.0 ? -t->N[0] / size : 0.0, 0.0};
  double third[3];
  cross(across, t->N, third);
  /* v_x and W_x stand for the slip */
  const double u_1 = dot(t->u, across), u_2 = dot(t->u, third);
  const double in[CAROM_NOSE_INS] = {
      [OF_V_X] = u_1,      [OF_V_Y] = t->closing, [OF_C_X] = u_1,         [OF_C_Y] = t->closing + u_2,
      [NOSE_MU_W] = t->mu, [NOSE_E] = t->e,       [NOSE_RATIO] = t->ratio};
  double out[CAROM_BALL_INS];
  carom_row din[CAROM_NOSE_INS], dout[CAROM_BALL_INS];
  memset(din, 0, sizeof din);
  for (int j = 0; j < m; j++) {
    const double du[3] = {t->du[0][j], t->du[1][j], t->du[2][j]};
    din[OF_V_X][j] = din[OF_C_X][j] = dot(du, across);
    din[OF_V_Y][j] = t->d_closing[j];
    din[OF_C_Y][j] = t->d_closing[j] + dot(du, third);
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
    const double dN[3] = {t->dN[0][j], t->dN[1][j], t->dN[2][j]}, back = dot(t->f, dN);
    t->dP[j] = t->d_closing[j] - dout[OF_V_Y][j];
    for (int k = 0; k < 3; k++)
      t->df[k][j] = df_1 * across[k] + df_2 * third[k] - back * t->N[k];
  }
  return status;
}

/* N x f and its tangent. */
static void torque(const touch *t, int j, double there[3], double d[3]) {
  const double dN[3] = {t->dN[0][j], t->dN[1][j], t->dN[2][j]}, df[3] = {t->df[0][j], t->df[1][j], t->df[2][j]};
  double more[3];
  cross(t->N, t->f, there);
  cross(dN, t->f, d);
  cross(t->N, df, more);
  for (int k = 0; k < 3; k++)
    d[k] += more[k];
}

/* Takes the impulses from ball `side`, which is alone. */
static void take(carom_tangent_work *w, const carom_tangent_ball *ball, int side, const touch *t) {
  const double R = ball->kind->radius;
  for (int j = 0; j < w->m; j++) {
    const double shrinks = -carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j) / R;
    double turn[3], d_turn[3];
    torque(t, j, turn, d_turn);
    for (int k = 0; k < 3; k++) {
      w->d[side][V[k]][j] += t->df[k][j] - t->dP[j] * t->N[k] - t->P * t->dN[k][j];
      w->d[side][W[k]][j] += 2.5 / R * (d_turn[k] + shrinks * turn[k]);
    }
  }
}

/* Motions of a ball alone, with tangents, at its touch. */
static void touch_alone(carom_tangent_work *w, const carom_tangent_ball *ball, const carom_ball_state *s, touch *t) {
  const double R = ball->kind->radius, spin[3] = {R * s->w[0], R * s->w[1], R * s->w[2]};
  touch_at(t, s->v, spin);
  for (int j = 0; j < w->m; j++) {
    const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j);
    double dv[3], d_spin[3];
    column(w->d[0], V, j, dv);
    column(w->d[0], W, j, d_spin);
    for (int k = 0; k < 3; k++)
      d_spin[k] = R * d_spin[k] + dR * s->w[k];
    d_touch_at(t, j, s->v, spin, dv, d_spin);
  }
}

/* ---- Slate and tops of rails ---- */

/* The impact on the slate of fixed.c. *s: the motion before. */
static carom_status hit_slate(carom_tangent_work *w, const carom_tangent_ball *ball, const carom_ball_state *s) {
  const carom_ball_kind *kind = ball->kind;
  const int m = w->m;
  const double given = kind->restitution_table, e = given == 0.0 ? 0.5 : given > 0.0 ? given : 0.0;
  touch t = {.N = {0.0, 0.0, -1.0}, .mu = kind->mu_slide, .ratio = 1.8};
  memset(t.dN, 0, sizeof t.dN);
  memset(t.d_ratio, 0, sizeof t.d_ratio);
  touch_alone(w, ball, s, &t);
  const double v_n = t.closing, up = carom_rebound(fmax(v_n, 0.0), e);
  /* the end of hops, where the derivative of v' grows without bound */
  if (up < GRAZING * e * v_n && carom_rebound((1.0 + GRAZING) * v_n, e) > 0.0)
    w->note.flags |= CAROM_TANGENT_GRAZING;
  t.e = v_n > 0.0 ? up / v_n : 0.0;
  for (int j = 0; j < m; j++) {
    const double de = given > 0.0 ? carom_d_kind(ball, CAROM_KIND_ROW(restitution_table), m, j) : 0.0;
    const double d_up = up > 0.0 ? e * v_n * (e * t.d_closing[j] + de * v_n) / up : 0.0;
    t.d_e[j] = v_n > 0.0 ? (d_up - t.e * t.d_closing[j]) / v_n : 0.0;
    t.d_mu[j] = carom_d_kind(ball, CAROM_KIND_ROW(mu_slide), m, j);
  }
  const carom_status status = free_impulse(&t, CAROM_CUSHION_HAN, m, &w->note);
  take(w, ball, 0, &t);
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

/* How the unit vector into a nose lies and turns. */
typedef struct into_nose {
  double N[3];
  carom_row dN[3];
} into_nose;

/* The motion after an impact, with tangents: of v_x, v_y, w, v_z, the first five as those of a state. */
typedef struct flat_motion {
  double v[3], w[3];
  carom_row d[6];
} flat_motion;

/* The result of the flat model, which has a part in that near the cloth: resolve.c. w->d: before. */
__attribute__((noinline)) static carom_status flat_part(carom_tangent_work *w, const carom_event *event, const into_nose *into,
                                                        double height, double *in, carom_row *din, flat_motion *flat) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_state *s = &event->before[0];
  const int m = w->m;
  const double *N = into->N, R = ball->kind->radius, size = sqrt(N[0] * N[0] + N[1] * N[1]);
  const double normal[2] = {N[0] / size, N[1] / size}, c = normal[1], x = -normal[0];
  const double *dR = carom_seeds_row(ball->d_kind, CAROM_KIND_ROW(radius), m);
  carom_row turn, dout[CAROM_BALL_INS];
  for (int j = 0; j < m; j++) {
    turn[j] = -(c * into->dN[0][j] + x * into->dN[1][j]) / size;
    flat->d[5][j] = s->v[2] < 0.0 ? w->d[0][S_V_Z][j] : 0.0;
  }
  carom_tangent_to_frame(s->v, s->w, R, c, x, false, m, turn, dR, w->d[0] + S_V_X, in, din);
  double out[CAROM_BALL_INS];
  const carom_status status = carom_tangent_flat_nose(w, event, normal, height, in, din, out, dout);
  /* back in the axes of the table */
  const double v[3] = {c * out[OF_V_X] - x * out[OF_V_Y], x * out[OF_V_X] + c * out[OF_V_Y], fmin(s->v[2], 0.0)};
  const double turns[3] = {(c * out[OF_W_X] - x * out[OF_W_Y]) / R, (x * out[OF_W_X] + c * out[OF_W_Y]) / R, out[OF_W_Z] / R};
  memcpy(flat->v, v, sizeof v);
  memcpy(flat->w, turns, sizeof turns);
  carom_tangent_from_frame(v, turns, R, c, x, m, turn, dR, dout, flat->d);
  return status;
}

/* The result without the cloth, in v, spin and w->d. */
__attribute__((noinline)) static carom_status free_part(carom_tangent_work *w, const carom_event *event, const into_nose *into,
                                                        const double *in, carom_row *din, double v[3], double spin[3]) {
  const carom_shot_cushion asked = w->opt->cushion_model;
  const carom_cushion_model model = asked == CAROM_SHOT_CUSHION_STRONGE  ? CAROM_CUSHION_STRONGE
                                    : asked == CAROM_SHOT_CUSHION_MIRROR ? CAROM_CUSHION_MIRROR
                                                                         : CAROM_CUSHION_HAN;
  const carom_tangent_ball *ball = &w->ball[event->a];
  touch t = {.mu = in[NOSE_MU_W], .e = in[NOSE_E], .ratio = in[NOSE_RATIO]};
  memcpy(t.N, into->N, sizeof t.N);
  memcpy(t.dN, into->dN, sizeof t.dN);
  memcpy(t.d_mu, din[NOSE_MU_W], sizeof t.d_mu);
  memcpy(t.d_e, din[NOSE_E], sizeof t.d_e);
  memcpy(t.d_ratio, din[NOSE_RATIO], sizeof t.d_ratio);
  touch_alone(w, ball, &event->before[0], &t);
  const carom_status status = free_impulse(&t, model, w->m, &w->note);
  take(w, ball, 0, &t);
  double turn[3];
  cross(t.N, t.f, turn);
  for (int k = 0; k < 3; k++) {
    v[k] += t.f[k] - t.P * t.N[k];
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
    carom_row *of_v = &w->d[0][V[k]], *of_w = &w->d[0][W[k]];
    for (int j = 0; j < w->m; j++) {
      const double d_chi = (w->d[0][S_Z][j] - carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j)) / near;
      (*of_v)[j] = (1.0 - chi) * flat->d[at[k]][j] + chi * (*of_v)[j] + d_chi * (v[k] - flat->v[k]);
      (*of_w)[j] = (1.0 - chi) * flat->d[2 + k][j] + chi * (*of_w)[j] + d_chi * (spin[k] - flat->w[k]);
    }
    v[k] = (1.0 - chi) * flat->v[k] + chi * v[k];
    spin[k] = (1.0 - chi) * flat->w[k] + chi * spin[k];
  }
}

/* A ball with v and spin, w->d their tangents, that a nose along N leaves by the rule of slow contacts. */
__attribute__((noinline)) static void part_from_nose(carom_tangent_work *w, const carom_tangent_ball *ball, const into_nose *t,
                                                     double slow, const double v[3], const double spin[3]) {
  const double R = ball->kind->radius, closing = dot(v, t->N);
  double q[CAROM_BALL_INS] = {[OF_V_Y] = closing, [OF_W_X] = R * spin[0], [OF_W_Y] = R * spin[1], [OF_W_Z] = R * spin[2]};
  static const int turns[3] = {OF_W_X, OF_W_Y, OF_W_Z};
  carom_row d[CAROM_BALL_INS];
  memset(d, 0, sizeof d);
  for (int j = 0; j < w->m; j++) {
    const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j);
    for (int k = 0; k < 3; k++) {
      d[OF_V_Y][j] += w->d[0][V[k]][j] * t->N[k] + v[k] * t->dN[k][j];
      d[turns[k]][j] = R * w->d[0][W[k]][j] + dR * spin[k];
    }
  }
  carom_row d_closing;
  memcpy(d_closing, d[OF_V_Y], sizeof d_closing);
  carom_slow_nose_tangent(q, slow, w->m, d);
  /* v loses closing - q[OF_V_Y] along N */
  for (int j = 0; j < w->m; j++) {
    const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), w->m, j);
    for (int k = 0; k < 3; k++) {
      w->d[0][V[k]][j] -= (d_closing[j] - d[OF_V_Y][j]) * t->N[k] + (closing - q[OF_V_Y]) * t->dN[k][j];
      w->d[0][W[k]][j] = (d[turns[k]][j] - q[turns[k]] / R * dR) / R;
    }
  }
}

/* When a ball in flight touches a nose, |(across, up)| = R, and how N turns. Returns what closes. */
static double reach_nose(carom_tangent_work *w, const carom_event *event, const carom_tangent_nose *nose, into_nose *into) {
  const carom_tangent_ball *ball = &w->ball[event->a];
  const carom_ball_state *s = &event->before[0];
  const arm a = arm_of(w, event, nose);
  const double size = sqrt(a.across * a.across + a.up * a.up), part = a.across / size, rise = a.up / size;
  const double N[3] = {-part * a.out[0], -part * a.out[1], -rise}, closing = dot(s->v, N);
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
  into_nose into;
  double in[CAROM_NOSE_INS], v[3], spin[3];
  carom_row din[CAROM_NOSE_INS];
  carom_tangent_nose_of(w, event, &nose, in, din);
  const double closing = reach_nose(w, event, &nose, &into), slow = carom_slow_speed(w->slow_instants);
  if (closing < GRAZING * sqrt(dot(s->v, s->v)))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  memcpy(v, s->v, sizeof v);
  memcpy(spin, s->w, sizeof spin);
  carom_status status = CAROM_OK;
  if (closing >= slow) {
    const bool is_near = s->r[2] - ball->kind->radius < 1e-3;
    flat_motion flat;
    if (is_near)
      status = flat_part(w, event, &into, nose.height, in, din, &flat);
    if (status == CAROM_OK)
      status = free_part(w, event, &into, in, din, v, spin);
    if (status == CAROM_OK && is_near)
      blend(w, ball, s->r[2], &flat, v, spin);
  }
  if (closing < slow || dot(v, into.N) > 0.0) {
    carom_tangent_slow(w, event->time);
    part_from_nose(w, ball, &into, slow, v, spin);
  }
  return status;
}

/* ---- Two balls ---- */

/* Where closing is slow: both part along n, and their spins lose the same share. */
static void part_balls(carom_tangent_work *w, const carom_event *event, const touch *t, double slow) {
  static const int turns[3] = {OF_W_X, OF_W_Y, OF_W_Z};
  const int m = w->m;
  double in[CAROM_BALLS_INS] = {0.0};
  carom_row din[CAROM_BALLS_INS], dout[CAROM_BALLS_OUTS];
  memset(din, 0, sizeof din);
  for (int side = 0; side < 2; side++) {
    const carom_tangent_ball *ball = &w->ball[side == 0 ? event->a : event->b];
    const carom_ball_state *s = &event->before[side];
    const double R = ball->kind->radius, v_n = dot(s->v, t->N);
    double *of = in + side * CAROM_BALL_INS;
    carom_row *d = din + side * CAROM_BALL_INS;
    of[OF_V_Y] = v_n;
    of[OF_C_Y] = v_n + R * s->w[0];
    of[OF_C_X] = -R * s->w[1];
    of[OF_W_Z] = R * s->w[2];
    in[BALLS_M_A + side] = ball->kind->mass;
    for (int j = 0; j < m; j++) {
      const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
      for (int k = 0; k < 3; k++)
        d[OF_V_Y][j] += w->d[side][V[k]][j] * t->N[k] + s->v[k] * t->dN[k][j];
      d[OF_C_Y][j] = d[OF_V_Y][j] + R * w->d[side][S_W_X][j] + dR * s->w[0];
      d[OF_C_X][j] = -R * w->d[side][S_W_Y][j] - dR * s->w[1];
      d[OF_W_Z][j] = R * w->d[side][S_W_Z][j] + dR * s->w[2];
      din[BALLS_M_A + side][j] = carom_d_kind(ball, CAROM_KIND_ROW(mass), m, j);
    }
  }
  carom_slow_balls_tangent(in, slow, m, din, dout);
  for (int side = 0; side < 2; side++) {
    const carom_tangent_ball *ball = &w->ball[side == 0 ? event->a : event->b];
    const carom_ball_state *s = &event->before[side], *after = &event->after[side];
    const double R = ball->kind->radius, gains = dot(after->v, t->N) - dot(s->v, t->N);
    for (int j = 0; j < m; j++) {
      const double dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
      const double d_gains = dout[side * CAROM_BALL_INS + OF_V_Y][j] - din[side * CAROM_BALL_INS + OF_V_Y][j];
      for (int k = 0; k < 3; k++) {
        w->d[side][V[k]][j] += d_gains * t->N[k] + gains * t->dN[k][j];
        w->d[side][W[k]][j] = (dout[side * CAROM_BALL_INS + turns[k]][j] - dR * after->w[k]) / R;
      }
    }
  }
}

/* The impact of spheres.c. */
static carom_status collide(carom_tangent_work *w, const carom_event *event, touch *t) {
  const int m = w->m;
  const carom_tangent_ball *ball[2] = {&w->ball[event->a], &w->ball[event->b]};
  const carom_ball_state *s = event->before;
  const carom_ball_kind *a = ball[0]->kind, *b = ball[1]->kind;
  double v[3], spin[3];
  for (int k = 0; k < 3; k++) {
    v[k] = s[0].v[k] - s[1].v[k];
    spin[k] = a->radius * s[0].w[k] + b->radius * s[1].w[k];
  }
  touch_at(t, v, spin);
  const double slip = sqrt(dot(t->u, t->u));
  carom_row d_slip;
  for (int j = 0; j < m; j++) {
    double dv[3], d_spin[3];
    for (int k = 0; k < 3; k++) {
      dv[k] = w->d[0][V[k]][j] - w->d[1][V[k]][j];
      d_spin[k] = 0.0;
      for (int side = 0; side < 2; side++)
        d_spin[k] += ball[side]->kind->radius * w->d[side][W[k]][j] +
                     carom_d_kind(ball[side], CAROM_KIND_ROW(radius), m, j) * s[side].w[k];
    }
    d_touch_at(t, j, v, spin, dv, d_spin);
    d_slip[j] = slip > 0.0 ? (t->u[0] * t->du[0][j] + t->u[1] * t->du[1][j] + t->u[2] * t->du[2][j]) / slip : 0.0;
    t->d_e[j] = 0.5 * (carom_d_kind(ball[0], CAROM_KIND_ROW(restitution), m, j) +
                       carom_d_kind(ball[1], CAROM_KIND_ROW(restitution), m, j));
    t->d_ratio[j] = 0.0;
  }
  t->e = 0.5 * (a->restitution + b->restitution);
  t->ratio = 1.8;
  const bool mirror = w->opt->ball_model == CAROM_BALL_MODEL_MIRROR;
  t->mu = mirror ? 0.0 : carom_tangent_friction(w, event, slip, d_slip, t->d_mu);
  const carom_status status = free_impulse(t, mirror ? CAROM_CUSHION_MIRROR : CAROM_CUSHION_HAN, m, &w->note);
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
      torque(t, j, turn, d_turn);
      for (int k = 0; k < 3; k++) {
        const double impulse = t->P * t->N[k] - t->f[k], d = t->dP[j] * t->N[k] + t->P * t->dN[k][j] - t->df[k][j];
        w->d[side][V[k]][j] += sign * (part * d + d_part * impulse);
        w->d[side][W[k]][j] += 2.5 / R * (part * d_turn[k] + d_per * turn[k]);
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
  touch t;
  carom_line_of_centres(ball[0]->kind, &s[0], ball[1]->kind, &s[1], t.N);
  const double v[3] = {s[0].v[0] - s[1].v[0], s[0].v[1] - s[1].v[1], s[0].v[2] - s[1].v[2]}, closing = dot(v, t.N);
  if (closing < GRAZING * sqrt(dot(v, v)))
    w->note.flags |= CAROM_TANGENT_GRAZING;
  /* when they touch, and how the line of centres turns */
  for (int j = 0; j < m; j++) {
    double apart = 0.0;
    for (int k = 0; k < 3; k++)
      apart += t.N[k] * (w->d[1][X[k]][j] - w->d[0][X[k]][j]);
    for (int side = 0; side < 2; side++)
      apart -= carom_d_kind(ball[side], CAROM_KIND_ROW(radius), m, j);
    w->d_time[j] = apart / closing;
  }
  carom_tangent_total(w, 0);
  carom_tangent_total(w, 1);
  for (int j = 0; j < m; j++) {
    double d[3];
    for (int k = 0; k < 3; k++)
      d[k] = (w->d[1][X[k]][j] - w->d[0][X[k]][j]) / distance;
    const double along = dot(d, t.N);
    for (int k = 0; k < 3; k++)
      t.dN[k][j] = d[k] - along * t.N[k];
  }
  carom_status status = CAROM_OK;
  const double slow = carom_slow_speed(w->slow_instants);
  if (closing < slow) {
    carom_tangent_slow(w, event->time);
    part_balls(w, event, &t, slow);
  } else {
    status = collide(w, event, &t);
  }
  /* what has no vertical speed but for rounding stays on the cloth, though a change would lift it */
  for (int side = 0; side < 2; side++)
    for (int j = 0; j < m && !flies(&event->after[side]); j++)
      if (w->d[side][S_V_Z][j] != 0.0)
        w->note.flags |= CAROM_TANGENT_KINK;
  return status;
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
  if (flies(s) && place < p->radius - 1e-9) {
    at_landing(w, ball);
  } else {
    if (fabs(rate) < GRAZING * place * sqrt(v[0] * v[0] + v[1] * v[1]))
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
