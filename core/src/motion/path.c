/* The motion of a ball between events, in closed form; path.h has the equations. */
#include "motion/path.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Constants of this file are macros: in its copy with derivatives (tangent/text.h) a constant of
 * type double would carry derivatives too, which cost work.
 *
 * Of pairs, with J = v'' and T the duration: the position differs from the exact one by J T^3 / 324
 * at most (DRAG in path.h). */
#define JERK_PER_ERROR 324.0
/* m: this difference on a level cloth, */
#define PAIR_ERROR 1e-5
/* and the estimate of it on a slope. Both estimates there are a fifth too small on steep slopes. */
#define PAIR_ERROR_ON_SLOPE 8e-6
/* Of the cube of the speed that a pair with drag takes. T is longer than the estimate by the
 * slowing at the start of the pair, so the speed has to be smaller. */
#define CUBE_WITH_DRAG 0.6
/* Drag counts if it slows a ball by more than this fraction of its rolling friction. */
#define NEGLIGIBLE_DRAG 1e-16

/* Of pairs on a slope. core/tests/physics/slope.c measures the errors of positions that they leave.
 *
 * The last pair slows as if friction A were A (1 + 0.35 y), with y the drag over A: its exact time
 * and way are then those without drag, times two series in y. */
#define DRAG_IN_FRICTION 0.35
/* The error of a last pair by turning, over c A / (A - c) (q / A)^2. */
#define LAST_PAIR_TURN 0.035
/* Other pairs take the part h of the speed, by J T^3 / 324 as with drag, with this margin. The
 * component of J that turns grows like 1 / (1 - h), so h becomes h / (1 + 0.4 h), and is at most
 * one half. */
#define CUBE_ON_SLOPE 0.9
#define TURN_IN_PART 0.4
#define LONGEST_PART 0.5
/* The least slope by which the length of pieces is chosen, over gravity. A smaller slope has the
 * pieces of this one, so that derivatives by the slope are as good. */
#define LEAST_SLOPE 1e-3
/* Steps of Runge's and Kutta's method in one pair. */
enum { RUNGE_STEPS = 4 };

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
  double root = 0.0;
  memcpy(&root, &bits, sizeof bits);
  for (int step = 0; step < 2; step++)
    root = (2.0 * root + x / (root * root)) / 3.0;
  return root;
}

/* atan(x) / x by x^2, which is below 0.06 where k <= 1/m. */
static inline __attribute__((always_inline)) double atan_series(double square) {
  return 1.0 -
         square *
             (1.0 / 3.0 -
              square * (1.0 / 5.0 -
                        square * (1.0 / 7.0 -
                                  square * (1.0 / 9.0 -
                                            square * (1.0 / 11.0 -
                                                      square * (1.0 / 13.0 - square / 15.0))))));
}

/* atanh(y) / y by y^2, where y is below 0.12. */
static inline __attribute__((always_inline)) double atanh_series(double square) {
  return 1.0 + square * (1.0 / 3.0 +
                         square * (1.0 / 5.0 +
                                   square * (1.0 / 7.0 + square * (1.0 / 9.0 + square / 11.0))));
}

/* A pair of a ball that rolls against drag. DRAG in path.h has the equations. Separate and cold, so
 * that balls without drag are not slower: inlined, it slows their shots by 1 to 2 % (carom-lab
 * bench --shots). */
__attribute__((noinline, cold)) static void
begin_pair(carom_path *path, const carom_ball_rates *rates, double speed) {
  /* the speed that the pair takes: J T^3 / 324 is the error that it may have, where T is about
   * fall / slowing and J = 2 k v slowing */
  static const double most = JERK_PER_ERROR * PAIR_ERROR / 2.0 * CUBE_WITH_DRAG;
  const double friction = rates->roll, drag = rates->drag;
  const double slowing = friction + drag * speed * speed;
  const double allowed = rough_cube_root(most * slowing * slowing / (drag * speed));
  path->last_pair = !(allowed < speed);
  const double end_speed = path->last_pair ? 0.0 : speed - allowed;
  const double fall = speed - end_speed;

  /* the exact time T, where x = sqrt(A k) time_scale, and the exact way S, where y = k way_scale */
  const double time_scale = fall / (friction + drag * speed * end_speed);
  const double x_square = friction * drag * time_scale * time_scale;
  const double duration = time_scale * atan_series(x_square);
  const double way_scale = fall * (speed + end_speed) /
                           (2.0 * friction + drag * (speed * speed + end_speed * end_speed));
  const double y_square = drag * drag * way_scale * way_scale;
  const double way = way_scale * atanh_series(y_square);

  /* the decelerations a1 and a2 of the two pieces, against the direction of motion */
  const double mean = fall / duration;
  const double first = 4.0 * (speed * duration - way) / (duration * duration) - mean;
  for (int axis = 0; axis < 2; axis++) {
    path->a[axis] = -0.5 * first * path->e[axis];
    path->e[axis] *= -0.5 * (2.0 * mean - first);
  }
  path->second = 0.5 * duration;
  path->end = path->start + path->second;
  path->goes_on = true;
}

/* ---- SLOPE in path.h */

/* What u obeys, the slip of a ball that slides or the velocity of one that rolls:
 * u' = -(A + k u^2) u/|u| + c. */
typedef struct motion_law {
  double friction;    /* A, m/s^2 */
  double drag;        /* k, 1/m; 0 of a slip */
  double downhill[2]; /* c, m/s^2 */
} motion_law;

/* u' at u. */
static void turn_down(const motion_law *law, const double u[2], double rate[2]) {
  const double speed = carom_plane_size(u);
  const double slowing = (law->friction + law->drag * speed * speed) / speed;
  for (int axis = 0; axis < 2; axis++)
    rate[axis] = law->downhill[axis] - slowing * u[axis];
}

/* From u of this size to 0: the time, and the way W of SLOPE. */
static double run_out(const motion_law *law, const double u[2], double speed, double way[2]) {
  /* with drag: its exact time and path length, relative to the larger friction on a level cloth, as
   * series in y, which is below 0.04. What they leave out is below 1e-10 of the sums */
  const double y = law->drag * speed * speed / law->friction;
  const double friction = law->friction * (1.0 + DRAG_IN_FRICTION * y);
  double power = 1.0 + DRAG_IN_FRICTION * y, longer = 0.0, farther = 0.0;
  for (int term = 1; term <= 7; term++) {
    longer += power / (2 * term - 1);
    farther += power / term;
    power *= -y;
  }

  /* the numbers of T and W: h = c . e0, A^2 - c^2, 4 A^2 - c^2 and (2 A + h) / (4 A^2 - c^2) */
  const double downhill_square = carom_plane_dot(law->downhill, law->downhill);
  const double along = carom_plane_dot(law->downhill, u) / speed;
  const double narrow = friction * friction - downhill_square;
  const double wide = 4.0 * friction * friction - downhill_square;
  const double part = (2.0 * friction + along) / wide;
  for (int axis = 0; axis < 2; axis++)
    way[axis] = farther * speed *
                (u[axis] * part +
                 speed * law->downhill[axis] * (1.0 + 3.0 * along * part) / (4.0 * narrow));
  return longer * speed * (friction + along) / narrow;
}

/* From u on for a time, by steps of order 4: u there, and the way. */
static void run_on(const motion_law *law, double duration, double u[2], double way[2]) {
  const double step = duration / (double)RUNGE_STEPS;
  way[0] = way[1] = 0.0;
  for (int done = 0; done < RUNGE_STEPS; done++) {
    /* u' at the start, twice in the middle, and at the end of the step */
    double rate[4][2], ahead[2];
    turn_down(law, u, rate[0]);
    for (int stage = 1; stage < 4; stage++) {
      const double part = stage < 3 ? 0.5 * step : step;
      for (int axis = 0; axis < 2; axis++)
        ahead[axis] = u[axis] + part * rate[stage - 1][axis];
      turn_down(law, ahead, rate[stage]);
    }

    /* the path is the integral of u, so it is computed before u changes */
    for (int axis = 0; axis < 2; axis++) {
      const double middle = rate[1][axis] + rate[2][axis];
      way[axis] += step * (u[axis] + step / 6.0 * (rate[0][axis] + middle));
      u[axis] += step / 6.0 * (rate[0][axis] + 2.0 * middle + rate[3][axis]);
    }
  }
}

/* A pair of a ball that slides with the slip u, or rolls at that velocity. */
__attribute__((noinline, cold)) static void
begin_on_slope(carom_path *path, const carom_ball_rates *rates, double u_x, double u_y) {
  static const double most = PAIR_ERROR_ON_SLOPE;
  /* the law of u. v' = share u' + (1 - share) c: a ball that slides has v' = 2/7 u' + 5/7 G, and
   * of one that rolls u is v */
  const double start[2] = {u_x, u_y}, speed = carom_plane_size(start);
  const bool slides = path->from.label == CAROM_BALL_SLIDING;
  const double share = slides ? 2.0 / 7.0 : 1.0;
  motion_law law = {rates->roll, rates->drag, {0.0, 0.0}};
  if (slides) {
    law.friction = 3.5 * rates->slide;
    law.drag = 0.0;
  }
  for (int axis = 0; axis < 2; axis++)
    law.downhill[axis] = (slides ? 1.0 : 5.0 / 7.0) * rates->downhill[axis];

  /* the size of c for the choice of the pair */
  const double downhill_square = carom_plane_dot(law.downhill, law.downhill);
  const double friction = law.friction, slowing = friction + law.drag * speed * speed;
  const double least = carom_lesser(LEAST_SLOPE * rates->gravity, 0.5 * friction);
  const double downhill = downhill_square > least * least ? sqrt(downhill_square) : least;

  /* the errors of a pair to the end: by turning and drag, each in J T^3 / 324; and by both */
  const double turns = share * downhill, drags = 2.0 * law.drag * speed * speed;
  const double time_square = speed * speed / (friction * friction);
  double u[2] = {start[0], start[1]}, way[2], duration;
  path->last_pair = time_square * (LAST_PAIR_TURN * turns * friction / (friction - downhill) +
                                   drags / JERK_PER_ERROR) <
                        most &&
                    downhill * law.drag * time_square * speed * speed < most * friction;

  /* to the end, if the position is good enough; otherwise for a part h of the speed */
  if (path->last_pair) {
    duration = run_out(&law, start, speed, way);
    u[0] = u[1] = 0.0;
  } else {
    const double part = rough_cube_root(CUBE_ON_SLOPE * JERK_PER_ERROR * most * slowing * slowing /
                                        (speed * speed * (turns + drags)));
    duration = carom_lesser(part / (1.0 + TURN_IN_PART * part), LONGEST_PART) * speed / slowing;
    run_on(&law, duration, u, way);
  }

  /* the accelerations of both pieces: of u by a1 and a2 of DRAG, as vectors, then of v */
  for (int axis = 0; axis < 2; axis++) {
    const double mean = (u[axis] - start[axis]) / duration;
    const double first = 4.0 * (way[axis] - start[axis] * duration) / (duration * duration) - mean;
    const double slope = (1.0 - share) * law.downhill[axis];
    path->a[axis] = 0.5 * (share * first + slope);
    path->e[axis] = 0.5 * (share * (2.0 * mean - first) + slope);
  }
  path->second = 0.5 * duration;
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
  for (int axis = 0; axis < 2; axis++)
    path->a[axis] = path->e[axis];
}

bool carom_path_go_to(carom_path *path, const carom_ball_rates *rates, double time) {
  enum { MOST_PIECES = 100000 };
  int pieces = 0;
  for (; path->goes_on && path->end < time && pieces < MOST_PIECES; pieces++)
    carom_path_go_on(path, rates);
  return pieces < MOST_PIECES;
}

void carom_path_begin(carom_path *path, const carom_ball_rates *rates, double start) {
  const carom_ball_state *ball = &path->from;
  path->start = start;
  path->end = INFINITY;
  path->goes_on = path->ends_pair = false;
  path->a[0] = path->a[1] = path->a[2] = path->e[0] = path->e[1] = 0.0;

  /* each phase has its acceleration and its end; a ball at rest has neither */
  switch (ball->label) {
  case CAROM_BALL_SPINNING:
    path->end = start + fabs(ball->w[2]) / rates->spin;
    break;
  case CAROM_BALL_ROLLING:
  case CAROM_BALL_SLIDING: {
    const bool slides = ball->label == CAROM_BALL_SLIDING;
    const double friction = slides ? rates->slide : rates->roll;
    /* friction acts against u: the slip, or the velocity */
    double u_x = ball->v[0], u_y = ball->v[1];
    if (slides) {
      u_x -= rates->radius * ball->w[1];
      u_y += rates->radius * ball->w[0];
    }
    const double size = sqrt(u_x * u_x + u_y * u_y);
    if (size > 0.0) {
      path->e[0] = u_x / size;
      path->e[1] = u_y / size;
    }
    /* in pieces where the cloth slopes or drag counts; else at one acceleration to the end */
    if (carom_is_sloped(rates) && size > 0.0) {
      begin_on_slope(path, rates, u_x, u_y);
    } else if (!slides && (rates->drag * size * size > NEGLIGIBLE_DRAG * rates->roll ||
                           carom_varies(rates->drag))) {
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
    path->end = start + carom_fall_time(carom_greater(ball->r[2] - rates->radius, 0.0), ball->v[2],
                                        rates->gravity);
    break;
  default:
    break;
  }
}

/* Of the two times at which it is at the height of the plane the later one, in the form that
 * does not cancel. */
double carom_fall_time(double height, double v_z, double gravity) {
  const double square = v_z * v_z + 2.0 * gravity * height;
  const double landing_speed = square > 0.0 ? sqrt(square) : 0.0;
  if (square < 0.0 || (height < 0.0 && v_z <= 0.0))
    return INFINITY;
  return v_z >= 0.0 ? (v_z + landing_speed) / gravity : 2.0 * height / (landing_speed - v_z);
}

/* w_z after its friction has taken `fall` of its size. */
static double spun_down(double side_spin, double fall) {
  if (fabs(side_spin) <= fall)
    return 0.0;
  return side_spin > 0.0 ? side_spin - fall : side_spin + fall;
}

void carom_path_at(const carom_path *path, const carom_ball_rates *rates, double time,
                   carom_ball_state *state) {
  const carom_ball_state *start = &path->from;
  const double tau = time - path->start;
  *state = *start;
  if (start->label == CAROM_BALL_STATIONARY || carom_is_out(start->label) || !(tau > 0.0))
    return;

  /* in flight the spin is constant */
  if (carom_flies(start)) {
    for (int axis = 0; axis < 3; axis++) {
      state->r[axis] = start->r[axis] + tau * (start->v[axis] + tau * path->a[axis]);
      state->v[axis] = start->v[axis] + 2.0 * tau * path->a[axis];
    }
    state->r[2] = carom_greater(state->r[2], rates->radius); /* not into the cloth by rounding */
    return;
  }

  /* on the cloth: the side spin by its own friction, then position and velocity */
  state->w[2] = spun_down(start->w[2], rates->spin * tau);
  if (start->label == CAROM_BALL_SPINNING)
    return;
  for (int axis = 0; axis < 2; axis++) {
    state->r[axis] = start->r[axis] + tau * (start->v[axis] + tau * path->a[axis]);
    state->v[axis] = start->v[axis] + 2.0 * tau * path->a[axis];
  }

  /* w along the cloth: of rolling; or turned by friction, whose acceleration is what the slope
   * leaves */
  if (start->label == CAROM_BALL_ROLLING) {
    state->w[0] = -state->v[1] / rates->radius;
    state->w[1] = state->v[0] / rates->radius;
  } else if (carom_is_sloped(rates)) {
    const double turn = 2.5 * tau / rates->radius;
    state->w[0] = start->w[0] - turn * (rates->downhill[1] - 2.0 * path->a[1]);
    state->w[1] = start->w[1] + turn * (rates->downhill[0] - 2.0 * path->a[0]);
  } else {
    const double turn = 2.5 * rates->slide * tau / rates->radius;
    state->w[0] = start->w[0] - turn * path->e[1];
    state->w[1] = start->w[1] + turn * path->e[0];
  }
}

/* Stops, or turns on the spot. */
static void stop(carom_ball_state *state) {
  state->v[0] = state->v[1] = state->v[2] = state->w[0] = state->w[1] = 0.0;
  state->label = state->w[2] != 0.0 ? CAROM_BALL_SPINNING : CAROM_BALL_STATIONARY;
}

int64_t carom_label_of(carom_ball_state *state, double radius) {
  static const double nothing = 1e-12; /* m/s: a thousandth of the rounding errors of a shot
                                          would be less */
  const double u_x = state->v[0] - radius * state->w[1], u_y = state->v[1] + radius * state->w[0];
  const double speed = carom_greater(fabs(state->v[0]), fabs(state->v[1]));
  const double slip = carom_greater(fabs(u_x), fabs(u_y));
  if (slip > nothing)
    state->label = CAROM_BALL_SLIDING;
  else if (speed > nothing)
    state->label = CAROM_BALL_ROLLING;
  else
    stop(state);
  return state->label;
}

int64_t carom_label_in_space(carom_ball_state *state, double radius) {
  static const double nothing = 1e-9; /* m/s */
  if (state->r[2] <= radius && fabs(state->v[2]) < nothing)
    state->v[2] = 0.0;
  return state->r[2] > radius || state->v[2] != 0.0 ? (state->label = CAROM_BALL_AIRBORNE)
                                                    : carom_label_of(state, radius);
}

int64_t carom_label_of_layout(carom_ball_state *state, double radius) {
  if (carom_is_out(state->label))
    return state->label;
  return carom_flies_in_layout(state, radius) ? (state->label = CAROM_BALL_AIRBORNE)
                                              : carom_label_of(state, radius);
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
