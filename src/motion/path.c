/* The motion of a ball between events, in closed form; path.h has the equations. */
#include "motion/path.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

carom_ball_rates carom_rates_of(const carom_ball_kind *kind) {
  return (carom_ball_rates){.radius = kind->radius,
                            .slide = kind->mu_slide * kind->gravity,
                            .roll = kind->mu_roll * kind->gravity,
                            .gravity = kind->gravity,
                            .drag = kind->drag,
                            .spin = 5.0 * kind->mu_spin * kind->gravity / (2.0 * kind->radius)};
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

/* The first piece of a pair, of a ball that rolls at v against drag: its deceleration. DRAG in
 * path.h has the equations. Apart and cold, so that balls without drag do not pay for it:
 * inlined, it costs their shots 1 to 2 % (carom-lab bench --shots). */
__attribute__((noinline, cold)) static double begin_pair(carom_path *path,
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
  path->second[0] = 2.0 * mean - first;
  path->second[1] = 0.5 * T;
  path->goes_on = true;
  return first;
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
  path->end = start + path->second[1];
  for (int k = 0; k < 2; k++)
    path->a[k] = -0.5 * path->second[0] * path->e[k];
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
    double friction = slides ? rates->slide : rates->roll;
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
    /* with drag the path begins with the first piece of a pair */
    if (!slides && (rates->drag * size * size > 1e-16 * rates->roll || carom_varies(rates->drag)))
      friction = begin_pair(path, rates, size);
    path->a[0] = -0.5 * friction * path->e[0];
    path->a[1] = -0.5 * friction * path->e[1];
    if (slides)
      path->end = start + 2.0 * size / (7.0 * friction);
    else
      path->end = start + (path->goes_on ? path->second[1] : size / friction);
    break;
  }
  case CAROM_BALL_AIRBORNE:
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
