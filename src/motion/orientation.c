/* How balls have turned: the rotation that follows from their spin.
 *
 * With w the angular velocity in the axes of the table, the rotation Q of a ball from its start
 * obeys Q' = [w] Q. In a phase, or a piece of one, w is linear in time, w = a + s b with s from
 * the middle of an interval of length h; where the side spin ends before the phase does, the
 * phase is cut there. In flight w is constant. Where a and b are parallel the axis keeps its
 * direction, and Q is exactly the turn by h a. Elsewhere the interval is cut into parts in which
 * a ball turns by half a radian at most, each of which has the turn by the Magnus expansion of
 * order 6,
 *
 *   Omega = A + (1/240) (-20 A + C) x (B + D),   A = h a, B = h^2 b, C = A x B, D = -(1/60) A x C.
 *
 * Source: S. Blanes, F. Casas, J. A. Oteo, J. Ros, "The Magnus expansion and some of its
 * applications", Physics Reports 470 (2009) 151-238, section 5. Only correctly rounded
 * operations and the library's own sines: the bits are equal on all machines.
 */
#include "motion/path.h"
#include "platform/elementary.h"

#include <math.h>

/* rad, of a part: its turn, and h^2 |b|. Found with tests/unit/games.c, which prints the largest
 * error. */
static const double most_turn = 0.5, most_bend = 0.02;

/* Of a call: about a second. All balls of a break turn by some 1,000 parts. */
static const double most_parts = 1e7;

static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

static double size_of(const double a[3]) {
  return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/* Turns q further, about the axes of the table, by the vector `by`. */
static void turn(double q[4], const double by[3]) {
  const double angle = size_of(by);
  if (!(angle > 0.0))
    return;
  double sine, cosine, p[4];
  carom_sincos(0.5 * angle, &sine, &cosine);
  const double s = sine / angle, x = s * by[0], y = s * by[1], z = s * by[2];
  p[0] = cosine * q[0] - x * q[1] - y * q[2] - z * q[3];
  p[1] = cosine * q[1] + x * q[0] + y * q[3] - z * q[2];
  p[2] = cosine * q[2] + y * q[0] + z * q[1] - x * q[3];
  p[3] = cosine * q[3] + z * q[0] + x * q[2] - y * q[1];
  const double size = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]);
  for (int k = 0; k < 4; k++)
    q[k] = p[k] / size;
}

/* The turn of a part of length h: see above. */
static void turn_part(double q[4], const double a[3], const double b[3], double h) {
  double A[3], B[3], C[3], D[3], left[3], right[3], both[3], omega[3];
  for (int k = 0; k < 3; k++) {
    A[k] = h * a[k];
    B[k] = h * h * b[k];
  }
  cross(A, B, C);
  cross(A, C, D);
  for (int k = 0; k < 3; k++) {
    left[k] = C[k] - 20.0 * A[k];
    right[k] = B[k] - D[k] / 60.0;
  }
  cross(left, right, both);
  for (int k = 0; k < 3; k++)
    omega[k] = A[k] + both[k] / 240.0;
  turn(q, omega);
}

/* The turn of an interval in which w goes linearly from w0 to w1, in at most *left parts, which the
 * caller has fewer of then; else false. */
static bool turn_interval(double q[4], const double w0[3], const double w1[3], double T,
                          double *left) {
  double b[3], bent[3];
  for (int k = 0; k < 3; k++)
    b[k] = (w1[k] - w0[k]) / T;
  cross(w0, w1, bent);
  const double fastest = carom_greater(size_of(w0), size_of(w1));
  /* one turn about one axis, or parts */
  const bool one_axis = size_of(bent) <= 1e-12 * fastest * fastest;
  const double wanted = carom_greater(fastest * T / most_turn, T * sqrt(size_of(b) / most_bend));
  const double parts = one_axis ? 1.0 : ceil(wanted);
  if (!(parts <= *left))
    return false;
  *left -= parts;
  const double h = T / parts;
  for (double k = 0.0; k < parts; k += 1.0) {
    double a[3];
    for (int c = 0; c < 3; c++)
      a[c] = w0[c] + (k + 0.5) * h * b[c];
    turn_part(q, a, b, h);
  }
  return true;
}

/* The turn along a path, of one phase or several pieces of one, until a time; false where it takes
 * more than *left parts. */
static bool turn_until(double q[4], carom_path *path, const carom_ball_rates *rates, double until,
                       double *left) {
  for (bool more = true; more;) {
    if (!((*left -= 1.0) > 0.0))
      return false;
    more = path->goes_on && path->end < until;
    const double end = more ? path->end : until;
    /* the side spin ends at the kink; in flight it is constant, as all spin is */
    const double kink = path->start + fabs(path->from.w[2]) / rates->spin;
    double from = path->start;
    carom_ball_state a = path->from, b;
    if (kink > from && kink < end && !carom_flies(&path->from)) {
      carom_path_at(path, rates, kink, &b);
      if (!turn_interval(q, a.w, b.w, kink - from, left))
        return false;
      a = b;
      a.w[2] = 0.0;
      from = kink;
    }
    if (end > from) {
      carom_path_at(path, rates, end, &b);
      if (!turn_interval(q, a.w, b.w, end - from, left))
        return false;
    }
    if (more)
      carom_path_go_on(path, rates);
  }
  return true;
}

carom_status carom_shot_orientation(const carom_shot_ball *balls, int count, const carom_shot *shot,
                                    double time, double (*turned)[4]) {
  if (turned == NULL)
    return CAROM_ERROR_NULL;
  carom_ball_state then[CAROM_BALLS_MOST];
  const carom_status status = carom_shot_at(balls, count, shot, time, then);
  if (status < 0)
    return status;

  const double at = carom_greater(carom_lesser(time, shot->time), 0.0);
  double left = most_parts;
  for (int i = 0; i < count; i++) {
    const carom_ball_rates rates = carom_rates_of(&balls[i].kind);
    double *q = turned[i];
    q[0] = 1.0;
    q[1] = q[2] = q[3] = 0.0;

    /* as it begins: not turned, on the first path */
    carom_path path;
    path.from = balls[i].state;
    carom_label_of_layout(&path.from, rates.radius);
    carom_path_begin(&path, &rates, 0.0);
    /* from event to event of this ball; the state at the time says whether it moves at all */
    for (int64_t k = 0; k < shot->count && k < shot->room && shot->events[k].time <= at; k++) {
      const carom_event *event = &shot->events[k];
      const int side = event->a == i                                           ? 0
                       : event->type == CAROM_EVENT_BALL_BALL && event->b == i ? 1
                                                                               : -1;
      if (side < 0)
        continue;
      if (!turn_until(q, &path, &rates, event->time, &left))
        return CAROM_ERROR_UNRESOLVED;
      path.from = event->after[side];
      carom_path_begin(&path, &rates, event->time);
    }
    if (!turn_until(q, &path, &rates, at, &left))
      return CAROM_ERROR_UNRESOLVED;
  }
  return CAROM_OK;
}
