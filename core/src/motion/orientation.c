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
 * The parts always divide the whole interval, wherever a time is requested, and the turn until then
 * consists of the parts before it and of the one that has begun. So its bits do not depend on times
 * that were requested before, and the next time continues from the last whole part.
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

/* Two spins have one axis if their product is below this fraction of the square of the larger
 * one. */
static const double one_direction = 1e-12;

/* Turns the quaternion q (w, x, y, z) further, about the axes of the table, by a rotation vector:
 * its product with (cos(angle/2), sin(angle/2) axis), made a unit quaternion again. */
static void turn(double q[4], const double rotation[3]) {
  const double angle = carom_space_size(rotation);
  if (!(angle > 0.0))
    return;
  double sine, cosine, turned[4];
  carom_sincos(0.5 * angle, &sine, &cosine);
  const double per_angle = sine / angle;
  const double x = per_angle * rotation[0], y = per_angle * rotation[1],
               z = per_angle * rotation[2];
  turned[0] = cosine * q[0] - x * q[1] - y * q[2] - z * q[3];
  turned[1] = cosine * q[1] + x * q[0] + y * q[3] - z * q[2];
  turned[2] = cosine * q[2] + y * q[0] + z * q[1] - x * q[3];
  turned[3] = cosine * q[3] + z * q[0] + x * q[2] - y * q[1];
  const double size = sqrt(carom_space_dot(turned, turned) + turned[3] * turned[3]);
  for (int part = 0; part < 4; part++)
    q[part] = turned[part] / size;
}

/* The turn of a part of length h, by its Magnus expansion: A, B, C and D of the head. a: the spin
 * in the middle, b: its change. */
static void turn_part(double q[4], const double a[3], const double b[3], double h) {
  double A[3], B[3], C[3], D[3], factor_1[3], factor_2[3], product[3], omega[3];
  for (int axis = 0; axis < 3; axis++) {
    A[axis] = h * a[axis];
    B[axis] = h * h * b[axis];
  }
  carom_cross(A, B, C);
  carom_cross(A, C, D);
  for (int axis = 0; axis < 3; axis++) {
    factor_1[axis] = C[axis] - 20.0 * A[axis];
    factor_2[axis] = B[axis] - D[axis] / 60.0;
  }
  carom_cross(factor_1, factor_2, product);
  for (int axis = 0; axis < 3; axis++)
    omega[axis] = A[axis] + product[axis] / 240.0;
  turn(q, omega);
}

/* The interval from a time on, at which the ball is at `from`: until the path ends, or until the
 * side spin does, where that is earlier. In flight it is constant, as all spin is. */
static void begin_interval(carom_turning *turning, const carom_path *path,
                           const carom_ball_rates *rates, double start) {
  carom_ball_state first, last;
  const double kink = path->start + fabs(path->from.w[2]) / rates->spin;
  turning->start = start;
  turning->done = 0.0;
  turning->end = !carom_flies(&path->from) && kink > start && kink < path->end ? kink : path->end;

  /* the spin at its start; behind the kink, the side spin is 0 exactly */
  carom_path_at(path, rates, start, &first);
  if (start == kink)
    first.w[2] = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    turning->w[axis] = first.w[axis];
    turning->bend[axis] = 0.0;
  }
  turning->part = turning->parts = 0.0;
  turning->fastest = carom_space_size(first.w);

  /* nothing changes on a path without an end */
  const double duration = turning->end - start;
  if (!(duration < INFINITY && duration > 0.0))
    return;

  /* from the spin at its start to that at its end, linearly */
  double product[3];
  carom_path_at(path, rates, turning->end, &last);
  for (int axis = 0; axis < 3; axis++)
    turning->bend[axis] = (last.w[axis] - first.w[axis]) / duration;
  carom_cross(first.w, last.w, product);
  const double fastest = turning->fastest =
      carom_greater(carom_space_size(first.w), carom_space_size(last.w));

  /* one turn about one axis, or parts */
  const bool one_axis = carom_space_size(product) <= one_direction * fastest * fastest;
  const double least_parts = carom_greater(
      fastest * duration / most_turn, duration * sqrt(carom_space_size(turning->bend) / most_bend));
  turning->parts = one_axis ? 1.0 : ceil(least_parts);
  turning->part = duration / turning->parts;
}

/* The turn from the last whole part on, for a while. */
static void turn_on(double q[4], const carom_turning *turning, double duration) {
  double middle[3];
  for (int axis = 0; axis < 3; axis++)
    middle[axis] =
        turning->w[axis] + (turning->done * turning->part + 0.5 * duration) * turning->bend[axis];
  turn_part(q, middle, turning->bend, duration);
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
  const double begun =
      carom_lesser(time, turning->end) - (turning->start + turning->done * turning->part);
  if (begun > 0.0)
    turn_on(q, turning, begun);
}
