/* How balls have turned: the rotation that follows from their spin.
 *
 * With w the angular velocity in the axes of the table, the rotation Q of a ball from its start
 * obeys Q' = [w] Q. In a phase, or a piece of one, w is linear in time, w = a + s b with s from
 * the middle of an interval of length h; where the side spin ends before the phase does, the
 * phase is cut there. In flight w is constant. Where a and b are parallel the axis keeps its
 * direction, and Q is exactly the turn by h a. Elsewhere the interval is cut into equal parts in
 * which a ball turns by half a radian at most, each of which has the turn by the Magnus expansion
 * of order 6,
 *
 *   Omega = A + (1/240) (-20 A + C) x (B + D),   A = h a, B = h^2 b, C = A x B, D = -(1/60) A x C.
 *
 * Source: S. Blanes, F. Casas, J. A. Oteo, J. Ros, "The Magnus expansion and some of its
 * applications", Physics Reports 470 (2009) 151-238, section 5. Only correctly rounded
 * operations and the library's own sines: the bits are equal on all machines.
 *
 * The parts are those of the whole interval, wherever a time is asked for, and the turn until then
 * is that of the parts before and of the begun one. So its bits do not depend on times that were
 * asked for before, and the next time goes on from the last whole part.
 */
#include "motion/orientation.h"
#include "platform/elementary.h"

#include <math.h>
#include <string.h>

/* rad, of a part: its turn, and h^2 |b|. Found with games/tests/games.c, which prints the largest
 * error. */
static const double most_turn = 0.5, most_bend = 0.02;

/* rad, of an interval: a damaged state may have any spin. */
static const double most_angle = 5e6;

/* Turns q further, about the axes of the table, by the vector `by`. */
static void turn(double q[4], const double rotation[3]) {
  const double angle = carom_space_size(rotation);
  if (!(angle > 0.0))
    return;
  double sine, cosine, p[4];
  carom_sincos(0.5 * angle, &sine, &cosine);
  const double s = sine / angle, x = s * rotation[0], y = s * rotation[1], z = s * rotation[2];
  p[0] = cosine * q[0] - x * q[1] - y * q[2] - z * q[3];
  p[1] = cosine * q[1] + x * q[0] + y * q[3] - z * q[2];
  p[2] = cosine * q[2] + y * q[0] + z * q[1] - x * q[3];
  p[3] = cosine * q[3] + z * q[0] + x * q[2] - y * q[1];
  const double size = sqrt(carom_space_dot(p, p) + p[3] * p[3]);
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
  carom_cross(A, B, C);
  carom_cross(A, C, D);
  for (int k = 0; k < 3; k++) {
    left[k] = C[k] - 20.0 * A[k];
    right[k] = B[k] - D[k] / 60.0;
  }
  carom_cross(left, right, both);
  for (int k = 0; k < 3; k++)
    omega[k] = A[k] + both[k] / 240.0;
  turn(q, omega);
}

/* The interval from a time on, at which the ball is at `from`: until the path ends, or until the
 * side spin does, where that is earlier. In flight it is constant, as all spin is. */
static void begin_interval(carom_turning *turning, const carom_path *path,
                           const carom_ball_rates *rates, double start) {
  carom_ball_state a, b;
  const double kink = path->start + fabs(path->from.w[2]) / rates->spin;
  turning->start = start;
  turning->done = 0.0;
  turning->end = !carom_flies(&path->from) && kink > start && kink < path->end ? kink : path->end;
  carom_path_at(path, rates, start, &a);
  if (start == kink)
    a.w[2] = 0.0;
  for (int k = 0; k < 3; k++) {
    turning->w[k] = a.w[k];
    turning->bend[k] = 0.0;
  }
  turning->part = turning->parts = 0.0;
  turning->fastest = carom_space_size(a.w);
  /* nothing changes on a path without an end */
  const double T = turning->end - start;
  if (!(T < INFINITY && T > 0.0))
    return;

  double bent[3];
  carom_path_at(path, rates, turning->end, &b);
  for (int k = 0; k < 3; k++)
    turning->bend[k] = (b.w[k] - a.w[k]) / T;
  carom_cross(a.w, b.w, bent);
  const double fastest = turning->fastest =
      carom_greater(carom_space_size(a.w), carom_space_size(b.w));
  /* one turn about one axis, or parts */
  const bool one_axis = carom_space_size(bent) <= 1e-12 * fastest * fastest;
  const double length =
      carom_greater(fastest * T / most_turn, T * sqrt(carom_space_size(turning->bend) / most_bend));
  turning->parts = one_axis ? 1.0 : ceil(length);
  turning->part = T / turning->parts;
}

/* The turn from the last whole part on, for a time h. */
static void turn_on(double q[4], const carom_turning *turning, double h) {
  double a[3];
  for (int k = 0; k < 3; k++)
    a[k] = turning->w[k] + (turning->done * turning->part + 0.5 * h) * turning->bend[k];
  turn_part(q, a, turning->bend, h);
}

void carom_turning_begin(carom_turning *turning, const carom_path *path,
                         const carom_ball_rates *rates) {
  begin_interval(turning, path, rates, path->start);
}

bool carom_turning_go_to(carom_turning *turning, carom_path *path, const carom_ball_rates *rates,
                         double time, double *left) {
  for (bool more = true; more;) {
    /* whole parts, and at the end of the interval the last one, whatever rounding says */
    const bool ends = turning->end < time;
    if (!(turning->fastest * (carom_lesser(time, turning->end) - turning->start) <= most_angle))
      return false;
    while (turning->done < turning->parts &&
           (ends || turning->start + (turning->done + 1.0) * turning->part <= time)) {
      if (!((*left -= 1.0) > 0.0))
        return false;
      turn_on(turning->q, turning, turning->part);
      turning->done += 1.0;
    }

    /* the next interval of the path, or its next piece */
    more = ends && (turning->end < path->end || path->goes_on);
    if (more && !((*left -= 1.0) > 0.0))
      return false;
    if (more && turning->end < path->end)
      begin_interval(turning, path, rates, turning->end);
    else if (more) {
      carom_path_go_on(path, rates);
      begin_interval(turning, path, rates, path->start);
    }
  }
  return true;
}

void carom_turning_at(const carom_turning *turning, double time, double q[4]) {
  memcpy(q, turning->q, sizeof turning->q);
  const double h =
      carom_lesser(time, turning->end) - (turning->start + turning->done * turning->part);
  if (h > 0.0)
    turn_on(q, turning, h);
}
