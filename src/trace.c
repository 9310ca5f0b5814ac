/* carom_trace(): a collision on its way, sampled at equal steps of normal impulse.
 *
 * The exact limit. exact.c jumps to the end; here the model is followed from sample to sample in the ten velocities themselves,
 * with the normal impulse P as the variable. Contact A is ball on ball, D and B are balls i and j on the cloth, C = 5/(2 M R):
 *
 *     at A:  u_x = v_ix - v_jx - R (w_iz + w_jz)      u_z = R (w_ix + w_jx)
 *     at D:  d_x = v_ix + s R w_iy                    d_y = v_iy - s R w_ix
 *     at B:  b_x = v_jx + s R w_jy                    b_y = v_jy - s R w_jx          v_n = v_jy - v_iy
 *
 *     F_x = -μ_b u_x/|u|     F_z = -μ_b u_z/|u|       between the balls, per unit P; 0 once they stick to each other
 *     F_z > 0 presses j into the cloth:  (J_x, J_y) = -μ_j F_z (b_x, b_y)/|b|
 *     F_z < 0 presses i into the cloth:  (I_x, I_y) =  μ_i F_z (d_x, d_y)/|d|
 *
 *     M_i v_ix' =  F_x + I_x     M_i v_iy' = -1 + I_y     w_ix' = C_i (F_z + I_y)     w_iy' = -C_i I_x     w_iz' = -C_i F_x
 *     M_j v_jx' = -F_x + J_x     M_j v_jy' =  1 + J_y     w_jx' = C_j (F_z + J_y)     w_jy' = -C_j J_x     w_jz' = -C_j F_x
 *
 * The sign of u_z never changes, so one ball is pressed throughout. A slip over the cloth that is 0 has the direction in which
 * it is about to begin.
 *
 * Method. Classical Runge-Kutta of order 4. The right side is smooth but where |u| or the pressed ball's slip comes near 0: a
 * step is at most a small share of the impulse that either would need to get there, so that steps shrink geometrically towards
 * stick and towards a turn, and grow again behind it. Where the collision ends, and where the balls stick,
 * carom_collide_detail() says, from another method; that the state at the end agrees with its result is a test of both. The
 * number of steps is bounded: once the budget is spent, they are all long.
 *
 * Work. S = ∫ v_n dP is integrated along; the work of the normal force is -S in compression, and after it, with the W_c of the
 * minimum, 2 W_c + S.
 *
 * Euler's method is simply stopped on its way, once for each sample.
 */
#include "euler.h"
#include "frame.h"
#include "result.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

static const double SHARE = 0.04;    /* of the way to where a slip would be 0 */
static const double LONGEST = 1e-3;  /* step, over the impulse of the collision */
static const double SHORTEST = 1e-7; /* the same at a turn of the slip over the cloth */
static const double STUCK = 1e-12;   /* slip between the balls that is none, over the approach */
static const double UPRIGHT = 1e-10; /* the same for u_z alone, below which no ball is pressed into the cloth */
static const double TURNED = 1e-12;  /* of the approach: v_n above its negative is the end of compression */
enum { BUDGET = 2000000 };           /* steps at most; a hard collision takes a few thousand */

#define VELOCITIES(X) X(v_ix) X(v_iy) X(w_ix) X(w_iy) X(w_iz) X(v_jx) X(v_jy) X(w_jx) X(w_jy) X(w_jz)

typedef struct slips {
  double u_x, u_z, d_x, d_y, b_x, b_y, v_n;
} slips;

static slips slips_of(const carom_local *c) {
  const double sR = c->s * c->R;
  return (slips){.u_x = c->v_ix - c->v_jx - c->R * (c->w_iz + c->w_jz),
                 .u_z = c->R * (c->w_ix + c->w_jx),
                 .d_x = c->v_ix + sR * c->w_iy,
                 .d_y = c->v_iy - sR * c->w_ix,
                 .b_x = c->v_jx + sR * c->w_jy,
                 .b_y = c->v_jy - sR * c->w_jx,
                 .v_n = c->v_jy - c->v_iy};
}

/* What is known of the whole collision. */
typedef struct course {
  int pressed;    /* +1: ball i, -1: ball j, 0: neither */
  double P;       /* normal impulse at the end */
  double P_stick; /* and where the balls stick; infinite if they never do */
  double W_c;
  double approach; /* |v_n| at the start */
} course;

/* A point on the way. */
typedef struct place {
  carom_local c;
  double P, S;
  bool stuck;
  int steps;
} place;

/* Rates by normal impulse. `c` has those of the velocities in their places; slips are linear, so slips_of() gives theirs. */
typedef struct rate {
  carom_local c;
  double S;
} rate;

static rate rate_of(const place *at, const course *way) {
  const carom_local *c = &at->c;
  const slips slip = slips_of(c);
  const double u = sqrt(slip.u_x * slip.u_x + slip.u_z * slip.u_z);
  const bool rubs = !at->stuck && u > 0.0;
  const double F_x = rubs ? -c->mu_b * slip.u_x / u : 0.0, F_z = rubs ? -c->mu_b * slip.u_z / u : 0.0;
  const double C_i = 5.0 / (2.0 * c->M_i * c->R), C_j = 5.0 / (2.0 * c->M_j * c->R), sR = c->s * c->R;
  double I_x = 0.0, I_y = 0.0, J_x = 0.0, J_y = 0.0;
  if (rubs && way->pressed != 0) {
    const bool on_i = way->pressed > 0;
    double t_x = on_i ? slip.d_x : slip.b_x, t_y = on_i ? slip.d_y : slip.b_y;
    if (t_x == 0.0 && t_y == 0.0) {
      t_x = on_i ? F_x / c->M_i : -F_x / c->M_j;
      t_y = on_i ? -1.0 / c->M_i - sR * C_i * F_z : 1.0 / c->M_j - sR * C_j * F_z;
    }
    const double t = hypot(t_x, t_y), load = t > 0.0 ? fabs(F_z) / t : 0.0;
    *(on_i ? &I_x : &J_x) = -(on_i ? c->mu_i : c->mu_j) * load * t_x;
    *(on_i ? &I_y : &J_y) = -(on_i ? c->mu_i : c->mu_j) * load * t_y;
  }
  return (rate){.c = {.v_ix = (F_x + I_x) / c->M_i,
                      .v_iy = (-1.0 + I_y) / c->M_i,
                      .w_ix = C_i * (F_z + I_y),
                      .w_iy = -C_i * I_x,
                      .w_iz = -C_i * F_x,
                      .v_jx = (-F_x + J_x) / c->M_j,
                      .v_jy = (1.0 + J_y) / c->M_j,
                      .w_jx = C_j * (F_z + J_y),
                      .w_jy = -C_j * J_x,
                      .w_jz = -C_j * F_x,
                      .R = c->R,
                      .s = c->s},
                .S = slip.v_n};
}

static void add(place *to, double h, const rate *r) {
#define ADD(name) to->c.name += h * r->c.name;
  VELOCITIES(ADD)
#undef ADD
  to->S += h * r->S;
}

static void step(place *at, const course *way, double h, const rate *first) {
  place mid = *at;
  add(&mid, 0.5 * h, first);
  const rate second = rate_of(&mid, way);
  mid = *at;
  add(&mid, 0.5 * h, &second);
  const rate third = rate_of(&mid, way);
  mid = *at;
  add(&mid, h, &third);
  const rate fourth = rate_of(&mid, way);
  add(at, h / 6.0, first);
  add(at, h / 3.0, &second);
  add(at, h / 3.0, &third);
  add(at, h / 6.0, &fourth);
  at->steps++;
}

/* The longest step that the nearness of stick and of a turn allows. */
static double longest_step(const place *at, const course *way, const slips *slip, const rate *r) {
  const carom_local *c = &at->c;
  const double fall = 4.0 * c->mu_b * (1.0 / c->M_i + 1.0 / c->M_j); /* |u|' is less */
  double h = fmin(LONGEST * way->P, SHARE * hypot(slip->u_x, slip->u_z) / fall);
  if (way->pressed != 0) {
    const slips change = slips_of(&r->c);
    const bool on_i = way->pressed > 0;
    const double d = on_i ? hypot(slip->d_x, slip->d_y) : hypot(slip->b_x, slip->b_y);
    const double d_rate = on_i ? hypot(change.d_x, change.d_y) : hypot(change.b_x, change.b_y);
    h = fmin(h, fmax(SHARE * d / d_rate, SHORTEST * way->P));
  }
  return at->steps < BUDGET ? h : LONGEST * way->P;
}

/* On to normal impulse P. */
static void go_to(place *at, const course *way, double P) {
  while (at->P < P) {
    const slips slip = slips_of(&at->c);
    at->stuck |= hypot(slip.u_x, slip.u_z) <= STUCK * way->approach;
    const rate first = rate_of(at, way);
    const double left = P - at->P;
    const double h = at->stuck ? left : longest_step(at, way, &slip, &first); /* once stuck, v_n is linear: a step is exact */
    step(at, way, fmin(h, left), &first);
    at->P = h < left ? at->P + h : P;
  }
}

static void put_point(const carom_frame *frame, const carom_local *c, double P, double work, carom_phase phase, bool stuck,
                      carom_trace_point *point) {
  const slips slip = slips_of(c);
  *point = (carom_trace_point){.normal = P,
                               .work = work,
                               .phase = phase,
                               .sticks = stuck,
                               .v_n = slip.v_n,
                               .u_x = stuck ? 0.0 : slip.u_x,
                               .u_z = stuck ? 0.0 : slip.u_z,
                               .d_x = slip.d_x,
                               .d_y = slip.d_y,
                               .b_x = slip.b_x,
                               .b_y = slip.b_y};
  carom_from_frame(frame, c, &point->state);
}

static void trace_exact(const carom_frame *frame, const carom_local *start, const carom_detail *detail, size_t n,
                        carom_trace_point *points) {
  const slips slip = slips_of(start);
  const course way = {.pressed = fabs(slip.u_z) <= UPRIGHT * -slip.v_n ? 0
                                 : slip.u_z > 0.0                      ? 1
                                                                       : -1,
                      .P = detail->normal,
                      .P_stick = detail->stick != CAROM_STICK_NEVER ? detail->stick_normal : INFINITY,
                      .W_c = detail->work_compression,
                      .approach = -slip.v_n};
  place at = {.c = *start};
  for (size_t k = 0; k < n; k++) {
    go_to(&at, &way, k + 1 < n ? way.P * ((double)k / (double)(n - 1)) : way.P);
    const bool compression = k + 1 < n && at.c.v_jy - at.c.v_iy < -TURNED * way.approach;
    put_point(frame, &at.c, at.P, compression ? 0.0 - at.S : 2.0 * way.W_c + at.S,
              compression ? CAROM_PHASE_COMPRESSION : CAROM_PHASE_RESTITUTION, at.P >= way.P_stick, &points[k]);
  }
}

/* `total` is the number of steps that the whole collision takes. */
static carom_status trace_euler(const carom_frame *frame, const carom_local *start, int N, int64_t total, size_t n,
                                carom_trace_point *points) {
  for (size_t k = 0; k < n; k++) {
    carom_local c = *start;
    carom_euler_run run;
    const int64_t most = k + 1 < n ? (int64_t)round((double)k * ((double)total / (double)(n - 1))) : INT64_MAX;
    const carom_status status = carom_euler(&c, N, most, &run);
    if (status != CAROM_OK)
      return status;
    put_point(frame, &c, (double)run.steps * run.step, run.work,
              isnan(run.work_compression) ? CAROM_PHASE_COMPRESSION : CAROM_PHASE_RESTITUTION, false, &points[k]);
  }
  return CAROM_OK;
}

/* Balls that do not collide stay as they are. */
static void trace_nothing(const carom_impact *in, const carom_frame *frame, const carom_local *start, size_t n,
                          carom_trace_point *points) {
  for (size_t k = 0; k < n; k++) {
    put_point(frame, start, 0.0, 0.0, CAROM_PHASE_RESTITUTION, false, &points[k]);
    carom_copy_state(in, &points[k].state);
  }
}

static void fill_nan(size_t n, carom_trace_point *points) {
  for (size_t k = 0; k < n; k++) {
    points[k] = (carom_trace_point){.normal = NAN,
                                    .work = NAN,
                                    .phase = CAROM_PHASE_RESTITUTION,
                                    .v_n = NAN,
                                    .u_x = NAN,
                                    .u_z = NAN,
                                    .d_x = NAN,
                                    .d_y = NAN,
                                    .b_x = NAN,
                                    .b_y = NAN};
    carom_fill_nan(&points[k].state);
  }
}

carom_status carom_trace(const carom_impact *in, const carom_options *opt, size_t n, carom_trace_point *points) {
  if (in == NULL || points == NULL)
    return CAROM_ERROR_NULL;
  if (n < 2)
    return CAROM_ERROR_POINTS;
  const carom_options defaults = carom_default_options();
  if (opt == NULL)
    opt = &defaults;
  carom_result end;
  carom_detail detail;
  carom_status status = carom_collide_detail(in, opt, &end, &detail);
  if (status >= 0) {
    const carom_frame frame = carom_frame_of(in);
    const carom_local start = carom_to_frame(&frame, in, opt->slip);
    if (status == CAROM_SEPARATING)
      trace_nothing(in, &frame, &start, n, points);
    else if (opt->solver == CAROM_SOLVER_EULER)
      status = trace_euler(&frame, &start, opt->steps, detail.steps, n, points);
    else
      trace_exact(&frame, &start, &detail, n, points);
  }
  if (status < 0)
    fill_nan(n, points);
  return status;
}
