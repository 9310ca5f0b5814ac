/* The least elevation of the cue with which its stick is over cushions and balls.
 *
 * In the vertical plane of the stick, with the origin in the cue ball's centre, the axis of a stick
 * that is raised by theta is where x sin(theta) + z cos(theta) = b R, x forward. A point that is D
 * behind, L off the axis and h above the slate is below the axis by
 *
 *     b R + D sin(theta) - (h - R) cos(theta) >= q,   q^2 = r^2 - L^2,
 *
 * where r is the radius of the stick there; for the centre of a ball, r is the sum of both radii.
 * With A^2 = D^2 + (R - h)^2 that is
 *
 *     theta >= asin((q - b R) / A) - atan2(R - h, D).
 *
 * Of a rail and of a jaw the position that needs most is found by the golden section. The stick
 * grows, so that is a little behind the position below its axis, or far behind where the stick
 * grows by more than it rises. */
#include "stick.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "random_draws.h"
#include "small_math.h"

#include <math.h>

/* m: a cue of usual make; its radius grows evenly from the tip on */
static const double stick_end = 1.47, tip_radius = 0.0065, radius_growth = 0.0055;

/* A stick, before it is raised: the cue ball's radius, the tip's height above its centre in radii,
 * and the direction in the plane of the table of the axis, with a point of it. */
typedef struct stick {
  double R, b, u[2], origin[2];
} stick;

/* How far a position is off the axis, and behind the cue ball. */
static void seen_from(const stick *s, const double place[2], double *L, double *D) {
  const double x = place[0] - s->origin[0], y = place[1] - s->origin[1];
  *L = s->u[0] * y - s->u[1] * x;
  *D = -(s->u[0] * x + s->u[1] * y);
}

/* The elevation that a point below the axis of an endless stick needs, of which the axis must be r
 * away, rad; below 0 none. */
static double raised(const stick *s, double L, double D, double h, double r) {
  const double up = s->R - h, sine = (sqrt(r * r - L * L) - s->b * s->R) / sqrt(D * D + up * up);
  if (sine >= 1.0)
    return 0.5 * pi;
  return carom_asin(carom_greater(sine, -1.0)) - carom_angle_of(D, up);
}

/* The same of any point. One that is not below the stick gets less than any other, and the less,
 * the farther it is from there. */
static double needed(const stick *s, double L, double D, double h, double r) {
  const double off = carom_greater(carom_greater(-D, D - stick_end - 1e-12), fabs(L) - r);
  if (off >= 0.0)
    return -pi - off;
  return raised(s, L, D, h, r);
}

static double radius_at(double D) {
  return tip_radius + radius_growth * D;
}

/* A nose: a line from a position on, or a circle of radius rho around that. */
typedef struct nose {
  double L, D, across, along, rho, h;
} nose;

/* What a position of it needs: a fraction of the line, or a direction from the centre, 0 the
 * front. */
static double needed_at(const stick *axis, const nose *n, double place) {
  double sine = 0.0, cosine = 0.0;
  if (n->rho > 0.0)
    carom_sincos(place, &sine, &cosine);
  const double L = n->L + place * n->across + n->rho * sine,
               D = n->D + place * n->along - n->rho * cosine;
  return needed(axis, L, D, n->h, radius_at(D));
}

/* The most that positions from low to high need, by the golden section. */
static double most_between(const stick *axis, const nose *n, double low, double high) {
  enum { STEPS = 30 };
  const double golden = 0.6180339887498949;
  double place[2], theta[2];
  for (int step = -2; step < STEPS; step++) {
    /* two positions; then the worse one is an end, and a position is added on the other side */
    int next = step + 2;
    if (step >= 0) {
      next = theta[0] < theta[1];
      if (next == 1)
        low = place[0];
      else
        high = place[1];
      place[1 - next] = place[next];
      theta[1 - next] = theta[next];
    }
    if (next == 1)
      place[1] = low + golden * (high - low);
    else
      place[0] = high - golden * (high - low);
    theta[next] = needed_at(axis, n, place[next]);
  }
  return carom_greater(theta[0], theta[1]);
}

/* Leaves of a range of x where value + slope x > 0. */
static void keep_positive(double range[2], double value, double slope) {
  const double root = -value / slope;
  if (slope == 0.0 && value <= 0.0)
    range[1] = range[0];
  else if (slope > 0.0)
    range[0] = carom_greater(range[0], root);
  else if (slope < 0.0)
    range[1] = carom_lesser(range[1], root);
}

/* What the section of a rail below the stick needs. */
static double over_rail(const stick *axis, const carom_rail *rail) {
  nose n = {.h = rail->height};
  double part[2] = {0.0, 1.0}, q[2];
  seen_from(axis, rail->p, &n.L, &n.D);
  seen_from(axis, rail->q, &q[0], &q[1]);
  n.across = q[0] - n.L;
  n.along = q[1] - n.D;
  const double grows = radius_growth * n.along;
  keep_positive(part, n.D, n.along);
  keep_positive(part, stick_end - n.D, -n.along);
  keep_positive(part, radius_at(n.D) - n.L, grows - n.across);
  keep_positive(part, radius_at(n.D) + n.L, grows + n.across);
  if (!(part[0] < part[1]))
    return 0.0;
  return most_between(axis, &n, part[0], part[1]);
}

/* What a jaw needs, or `least` if that is more. Its back needs more than its front where the stick
 * grows by more than it rises, far below 0.05 rad. */
static double over_jaw(const stick *axis, const carom_jaw *jaw, double least) {
  const double rho = jaw->radius, wide = 0.5 * pi + radius_growth;
  nose n = {.rho = rho, .h = jaw->height};
  seen_from(axis, jaw->centre, &n.L, &n.D);
  /* no point of it needs more than one at its front that is as near to the axis as any */
  const double distance = carom_greater(fabs(n.L) - rho, 0.0),
               front = carom_greater(n.D - rho, 1e-9);
  if (n.D + rho <= 0.0 || needed(axis, distance, front, n.h, radius_at(n.D + rho)) <= least)
    return least;
  least = carom_greater(most_between(axis, &n, -wide, wide), least);
  if (least > 0.05)
    return least;
  return carom_greater(most_between(axis, &n, pi - wide, pi + wide), least);
}

double carom_least_elevation(const carom_table *table, const carom_shot_ball *balls, int count,
                             const carom_cue *cue) {
  const carom_shot_ball *striker = &balls[cue->ball];
  stick axis = {.R = striker->kind.radius, .b = cue->b};
  double most = 0.0;
  carom_sincos(cue->phi * degree, &axis.u[1], &axis.u[0]);
  axis.origin[0] = striker->state.r[0] - cue->a * axis.R * axis.u[1];
  axis.origin[1] = striker->state.r[1] + cue->a * axis.R * axis.u[0];

  for (int k = 0; k < table->rails; k++)
    most = carom_greater(most, over_rail(&axis, &table->rail[k]));
  for (int k = 0; k < count; k++) {
    const carom_shot_ball *ball = &balls[k];
    double L, D;
    seen_from(&axis, ball->state.r, &L, &D);
    if (k != cue->ball && ball->state.label != CAROM_BALL_POCKETED &&
        ball->state.label != CAROM_BALL_OFF)
      most = carom_greater(most,
                           needed(&axis, L, D, ball->state.r[2], ball->kind.radius + radius_at(D)));
  }
  for (int k = 0; k < table->jaws; k++)
    most = over_jaw(&axis, &table->jaw[k], most);
  return most / degree;
}
