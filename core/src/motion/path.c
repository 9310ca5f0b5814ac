/* The motion of a ball between events, in closed form; path.h has the equations. */
#include "motion/path.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { RUNGE_STEPS = 4 }; /* of a pair on a slope */

carom_ball_rates carom_rates_of(const carom_ball_kind *kind) {
  return (carom_ball_rates){.radius = kind->radius,
                            .slide = kind->mu_slide * kind->gravity,
                            .roll = kind->mu_roll * kind->gravity,
                            .gravity = kind->gravity,
                            .drag = kind->drag,
                            .spin = 5.0 * kind->mu_spin * kind->gravity / (2.0 * kind->radius)};
}

carom_ball_rates carom_rates_on_slope(const carom_ball_kind *kind, double slope_x, double slope_y) {
  carom_ball_rates rates = carom_rates_of(kind);
  rates.downhill[0] = -kind->gravity * slope_x;
  rates.downhill[1] = -kind->gravity * slope_y;
  return rates;
}

/* The cube root of x > 0, to 1e-3 of it, by the same operations everywhere: a third of the
 * exponent, and two steps of Newton's method. Infinite or very large x give something very
 * large. */
static double rough_cube_root(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  bits = bits / 3 + 0x2a9f7893782da1ceu; /* 2/3 of the bits of 1 */
  double y = 0.0;
  memcpy(&y, &bits, sizeof bits);
  for (int k = 0; k < 2; k++)
    y = (2.0 * y + x / (y * y)) / 3.0;
  return y;
}

/* A pair of a ball that rolls at v against drag. DRAG in path.h has the equations. Apart and cold,
 * so that balls without drag do not pay for it: inlined, it costs their shots 1 to 2 % (carom-lab
 * bench --shots). */
__attribute__((noinline, cold)) static void begin_pair(carom_path *path,
                                                       const carom_ball_rates *rates, double v) {
  /* J0 T^3 / 324 = 1e-5 m with T = fall / (A + k v^2), and 0.6 of it, since T is longer than
   * that */
  static const double most = 324.0 * 1e-5 / 2.0 * 0.6;
  const double A = rates->roll, k = rates->drag, slows = A + k * v * v;
  const double fall = rough_cube_root(most * slows * slows / (k * v));
  path->last_pair = !(fall < v);
  const double least = path->last_pair ? 0.0 : v - fall, fall_of_pair = v - least;
  /* series of atan(x)/x and atanh(y)/y; x^2 and y are below 0.06 and 0.12 where k <= 1/m */
  const double x = fall_of_pair / (A + k * v * least), x2 = A * k * x * x;
  const double T =
      x *
      (1.0 -
       x2 * (1.0 / 3.0 -
             x2 * (1.0 / 5.0 -
                   x2 * (1.0 / 7.0 -
                         x2 * (1.0 / 9.0 - x2 * (1.0 / 11.0 - x2 * (1.0 / 13.0 - x2 / 15.0)))))));
  const double y = fall_of_pair * (v + least) / (2.0 * A + k * (v * v + least * least)),
               y2 = k * k * y * y;
  const double S =
      y *
      (1.0 + y2 * (1.0 / 3.0 + y2 * (1.0 / 5.0 + y2 * (1.0 / 7.0 + y2 * (1.0 / 9.0 + y2 / 11.0)))));
  const double mean = fall_of_pair / T, first = 4.0 * (v * T - S) / (T * T) - mean;
  for (int axis = 0; axis < 2; axis++) {
    path->a[axis] = -0.5 * first * path->e[axis];
    path->e[axis] *= -0.5 * (2.0 * mean - first);
  }
  path->second = 0.5 * T;
  path->end = path->start + path->second;
  path->goes_on = true;
}

/* ---- SLOPE in path.h */

/* What a velocity u obeys, u' = -(A + k u^2) u/|u| + c. */
typedef struct curve {
  double A, k, c[2];
} curve;

static void turn_down(const curve *f, const double u[2], double rate[2]) {
  const double q = carom_plane_size(u), slowing = (f->A + f->k * q * q) / q;
  for (int k = 0; k < 2; k++)
    rate[k] = f->c[k] - slowing * u[k];
}

/* From u of size q to 0: the time, and the way. */
static double run_out(const curve *f, const double u[2], double q, double way[2]) {
  /* with drag: its exact time and way over those of A on a level cloth, as series in y < 0.04 */
  const double y = f->k * q * q / f->A, A = f->A * (1.0 + 0.35 * y);
  double power = 1.0 + 0.35 * y, longer = 0.0, farther = 0.0;
  for (int n = 1; n <= 7; n++) {
    longer += power / (2 * n - 1);
    farther += power / n;
    power *= -y;
  }

  const double c2 = carom_plane_dot(f->c, f->c), along = carom_plane_dot(f->c, u) / q;
  const double D = A * A - c2, B = 4.0 * A * A - c2, part = (2.0 * A + along) / B;
  for (int k = 0; k < 2; k++)
    way[k] = farther * q * (u[k] * part + q * f->c[k] * (1.0 + 3.0 * along * part) / (4.0 * D));
  return longer * q * (A + along) / D;
}

/* From u on for a time, by steps of order 4: u there, and the way. */
static void run_on(const curve *f, double T, double u[2], double way[2]) {
  const double h = T / (double)RUNGE_STEPS;
  way[0] = way[1] = 0.0;
  for (int n = 0; n < RUNGE_STEPS; n++) {
    double rate[4][2], v[2];
    turn_down(f, u, rate[0]);
    for (int stage = 1; stage < 4; stage++) {
      const double part = stage < 3 ? 0.5 * h : h;
      for (int k = 0; k < 2; k++)
        v[k] = u[k] + part * rate[stage - 1][k];
      turn_down(f, v, rate[stage]);
    }
    for (int k = 0; k < 2; k++) {
      const double middle = rate[1][k] + rate[2][k];
      way[k] += h * (u[k] + h / 6.0 * (rate[0][k] + middle));
      u[k] += h / 6.0 * (rate[0][k] + 2.0 * middle + rate[3][k]);
    }
  }
}

/* A pair of a ball that slides with the slip (x, y), or rolls at that velocity. */
__attribute__((noinline, cold)) static void
begin_on_slope(carom_path *path, const carom_ball_rates *rates, double x, double y) {
  static const double most = 8e-6; /* m, as both bounds below err by a fifth on steep slopes */
  const double u0[2] = {x, y}, q = carom_plane_size(u0);
  const bool slides = path->from.label == CAROM_BALL_SLIDING;
  const double share = slides ? 2.0 / 7.0 : (double)1.0; /* of u' in v' */
  curve f = {rates->roll, rates->drag, {0.0, 0.0}};
  if (slides) {
    f.A = 3.5 * rates->slide;
    f.k = 0.0;
  }
  for (int k = 0; k < 2; k++)
    f.c[k] = (slides ? 1.0 : 5.0 / 7.0) * rates->downhill[k];
  const double c2 = carom_plane_dot(f.c, f.c), A = f.A, slows = A + f.k * q * q;
  /* less slope has the pieces of 1e-3, so that derivatives by it are as good */
  const double least = carom_lesser(1e-3 * rates->gravity, 0.5 * A),
               c = c2 > least * least ? sqrt(c2) : least;

  /* to the end, if the place is good enough there; otherwise h, by J T^3 / 324 as with drag, where
   * the part of J that turns grows like 1/(1 - h) */
  const double turns = share * c, drags = 2.0 * f.k * q * q, square = q * q / (A * A);
  double u[2] = {u0[0], u0[1]}, way[2], T;
  path->last_pair = square * (0.035 * turns * A / (A - c) + drags / 324.0) < most &&
                    c * f.k * square * q * q < most * A;
  if (path->last_pair) {
    T = run_out(&f, u0, q, way);
    u[0] = u[1] = 0.0;
  } else {
    const double h =
        rough_cube_root(0.9 * 324.0 * most * slows * slows / (q * q * (turns + drags)));
    T = carom_lesser(h / (1.0 + 0.4 * h), 0.5) * q / slows;
    run_on(&f, T, u, way);
  }

  /* the accelerations of both pieces */
  for (int k = 0; k < 2; k++) {
    const double mean = (u[k] - u0[k]) / T, first = 4.0 * (way[k] - u0[k] * T) / (T * T) - mean;
    const double slope = (1.0 - share) * f.c[k];
    path->a[k] = 0.5 * (share * first + slope);
    path->e[k] = 0.5 * (share * (2.0 * mean - first) + slope);
  }
  path->second = 0.5 * T;
  path->end = path->start + path->second;
  path->goes_on = true;
}

void carom_path_go_on(carom_path *path, const carom_ball_rates *rates) {
  carom_ball_state end_state;
  const double time = path->end;
  carom_path_at(path, rates, time, &end_state);
  path->from = end_state;
  if (path->ends_pair) {
    carom_path_begin(path, rates, time);
    return;
  }
  carom_path_second(path, time);
}

void carom_path_second(carom_path *path, double start) {
  path->ends_pair = true;
  path->goes_on = !path->last_pair;
  path->start = start;
  path->end = start + path->second;
  for (int k = 0; k < 2; k++)
    path->a[k] = path->e[k];
}

bool carom_path_go_to(carom_path *path, const carom_ball_rates *rates, double time) {
  enum { MOST_PIECES = 100000 };
  int pieces = 0;
  for (; path->goes_on && path->end < time && pieces < MOST_PIECES; pieces++)
    carom_path_go_on(path, rates);
  return pieces < MOST_PIECES;
}

void carom_path_begin(carom_path *path, const carom_ball_rates *rates, double start) {
  const carom_ball_state *s = &path->from;
  path->start = start;
  path->end = INFINITY;
  path->goes_on = path->ends_pair = false;
  path->a[0] = path->a[1] = path->a[2] = path->e[0] = path->e[1] = 0.0;

  /* each phase has its acceleration and its end; a ball at rest has neither */
  switch (s->label) {
  case CAROM_BALL_SPINNING:
    path->end = start + fabs(s->w[2]) / rates->spin;
    break;
  case CAROM_BALL_ROLLING:
  case CAROM_BALL_SLIDING: {
    const bool slides = s->label == CAROM_BALL_SLIDING;
    const double friction = slides ? rates->slide : rates->roll;
    /* friction acts against the slip, or against the velocity */
    double x = s->v[0], y = s->v[1];
    if (slides) {
      x -= rates->radius * s->w[1];
      y += rates->radius * s->w[0];
    }
    const double size = sqrt(x * x + y * y);
    if (size > 0.0) {
      path->e[0] = x / size;
      path->e[1] = y / size;
    }
    if (carom_is_sloped(rates) && size > 0.0) {
      begin_on_slope(path, rates, x, y);
    } else if (!slides &&
               (rates->drag * size * size > 1e-16 * rates->roll || carom_varies(rates->drag))) {
      begin_pair(path, rates, size);
    } else {
      path->a[0] = -0.5 * friction * path->e[0];
      path->a[1] = -0.5 * friction * path->e[1];
      path->end = start + (slides ? 2.0 * size / (7.0 * friction) : size / friction);
    }
    break;
  }
  case CAROM_BALL_AIRBORNE:
    if (carom_is_sloped(rates)) {
      path->a[0] = 0.5 * rates->downhill[0];
      path->a[1] = 0.5 * rates->downhill[1];
    }
    path->a[2] = -0.5 * rates->gravity;
    path->end = start + carom_fall_time(carom_greater(s->r[2] - rates->radius, 0.0), s->v[2],
                                        rates->gravity);
    break;
  default:
    break;
  }
}

/* Of the two times at which it is at the height of the plane the later one, in the form that
 * does not cancel. */
double carom_fall_time(double height, double v_z, double gravity) {
  const double square = v_z * v_z + 2.0 * gravity * height, q = square > 0.0 ? sqrt(square) : 0.0;
  if (square < 0.0 || (height < 0.0 && v_z <= 0.0))
    return INFINITY;
  return v_z >= 0.0 ? (v_z + q) / gravity : 2.0 * height / (q - v_z);
}

/* |w_z| after its friction has acted for a while. */
static double spun_down(double w, double fall) {
  if (fabs(w) <= fall)
    return 0.0;
  return w > 0.0 ? w - fall : w + fall;
}

void carom_path_at(const carom_path *path, const carom_ball_rates *rates, double time,
                   carom_ball_state *state) {
  const carom_ball_state *start = &path->from;
  const double tau = time - path->start;
  *state = *start;
  if (start->label == CAROM_BALL_STATIONARY || carom_is_out(start->label) || !(tau > 0.0))
    return;
  if (carom_flies(start)) {
    for (int k = 0; k < 3; k++) {
      state->r[k] = start->r[k] + tau * (start->v[k] + tau * path->a[k]);
      state->v[k] = start->v[k] + 2.0 * tau * path->a[k];
    }
    state->r[2] = carom_greater(state->r[2], rates->radius); /* not into the cloth by rounding */
    return;
  }
  state->w[2] = spun_down(start->w[2], rates->spin * tau);
  if (start->label == CAROM_BALL_SPINNING)
    return;
  for (int k = 0; k < 2; k++) {
    state->r[k] = start->r[k] + tau * (start->v[k] + tau * path->a[k]);
    state->v[k] = start->v[k] + 2.0 * tau * path->a[k];
  }
  if (start->label == CAROM_BALL_ROLLING) {
    state->w[0] = -state->v[1] / rates->radius;
    state->w[1] = state->v[0] / rates->radius;
  } else if (carom_is_sloped(rates)) { /* friction is what the slope leaves */
    const double turn = 2.5 * tau / rates->radius;
    state->w[0] = start->w[0] - turn * (rates->downhill[1] - 2.0 * path->a[1]);
    state->w[1] = start->w[1] + turn * (rates->downhill[0] - 2.0 * path->a[0]);
  } else {
    const double turn = 2.5 * rates->slide * tau / rates->radius;
    state->w[0] = start->w[0] - turn * path->e[1];
    state->w[1] = start->w[1] + turn * path->e[0];
  }
}

/* Comes to rest, or turns on the spot. */
static void stop(carom_ball_state *s) {
  s->v[0] = s->v[1] = s->v[2] = s->w[0] = s->w[1] = 0.0;
  s->label = s->w[2] != 0.0 ? CAROM_BALL_SPINNING : CAROM_BALL_STATIONARY;
}

int64_t carom_label_of(carom_ball_state *s, double radius) {
  static const double nothing = 1e-12; /* m/s: a thousandth of the rounding errors of a shot
                                          would be less */
  const double u_x = s->v[0] - radius * s->w[1], u_y = s->v[1] + radius * s->w[0];
  const double v = carom_greater(fabs(s->v[0]), fabs(s->v[1])),
               u = carom_greater(fabs(u_x), fabs(u_y));
  if (u > nothing)
    s->label = CAROM_BALL_SLIDING;
  else if (v > nothing)
    s->label = CAROM_BALL_ROLLING;
  else
    stop(s);
  return s->label;
}

int64_t carom_label_in_space(carom_ball_state *s, double radius) {
  static const double nothing = 1e-9; /* m/s */
  if (s->r[2] <= radius && fabs(s->v[2]) < nothing)
    s->v[2] = 0.0;
  return s->r[2] > radius || s->v[2] != 0.0 ? (s->label = CAROM_BALL_AIRBORNE)
                                            : carom_label_of(s, radius);
}

int64_t carom_label_of_layout(carom_ball_state *s, double radius) {
  if (carom_is_out(s->label))
    return s->label;
  return carom_flies_in_layout(s, radius) ? (s->label = CAROM_BALL_AIRBORNE)
                                          : carom_label_of(s, radius);
}

void carom_path_land(const carom_path *path, const carom_ball_rates *rates, double time,
                     carom_ball_state *state) {
  const carom_ball_state *start = &path->from;
  const double height = carom_greater(start->r[2] - rates->radius, 0.0);
  carom_path_at(path, rates, time, state);
  state->r[2] = rates->radius;
  state->v[2] = -sqrt(start->v[2] * start->v[2] + 2.0 * rates->gravity * height);
}

void carom_path_end(const carom_path *path, const carom_ball_rates *rates,
                    carom_ball_state *state) {
  carom_path_at(path, rates, path->end, state);
  switch (path->from.label) {
  case CAROM_BALL_SLIDING:
    state->w[0] = -state->v[1] / rates->radius;
    state->w[1] = state->v[0] / rates->radius;
    state->label = CAROM_BALL_ROLLING;
    break;
  case CAROM_BALL_SPINNING:
    state->w[2] = 0.0;
    stop(state);
    break;
  default:
    stop(state);
  }
}
