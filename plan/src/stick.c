/* The least elevation of the cue with which its stick is over cushions and balls.
 *
 * In the vertical plane of the stick, with the origin in the cue ball's centre, the axis of a stick
 * that is raised by theta is where x sin(theta) + z cos(theta) = b R, x forward. A point that is D
 * behind, L beside the axis and h above the slate is below the axis by
 *
 *     b R + D sin(theta) - (h - R) cos(theta) >= q,   q^2 = r^2 - L^2,
 *
 * where r is the radius of the stick there; for the centre of a ball, r is the sum of both radii.
 * With A^2 = D^2 + (R - h)^2 that is
 *
 *     theta >= asin((q - b R) / A) - atan2(R - h, D).
 *
 * A line at the height h that crosses below the axis at D has points at D + k x, x beside the
 * axis. All of them are far enough away, if
 *
 *     (f + k x sin(theta))^2 + x^2 - (r + g k x)^2 >= 0,
 *
 * with f = b R + D sin(theta) - (h - R) cos(theta), r the radius of the stick at D, and g how it
 * grows; that is
 *
 *     f >= r (sqrt(1 + k^2 sin(theta)^2 - g^2 k^2) - g k^2 sin(theta)) / (1 - g^2 k^2). */
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "view.h"

#include <math.h>

/* m: a cue of usual make; its radius grows evenly from the tip on */
static const double stick_end = 1.47, tip_radius = 0.0065, radius_growth = 0.0055;

/* A stick, before it is raised: the cue ball's radius, the tip's place above its centre in radii,
 * and the direction in the plane of the table of the axis, with a point of it. */
typedef struct stick {
  double R, b, u[2], at[2];
} stick;

/* How far a place is beside the axis, and behind the cue ball. */
static void seen_from(const stick *s, const double place[2], double *L, double *D) {
  const double x = place[0] - s->at[0], y = place[1] - s->at[1];
  *L = s->u[0] * y - s->u[1] * x;
  *D = -(s->u[0] * x + s->u[1] * y);
}

/* The elevation that a point below the axis of an endless stick needs, of which the axis must be r
 * away, rad; below 0 none. */
static double raised(const stick *s, double L, double D, double h, double r) {
  const double up = s->R - h, sine = (sqrt(r * r - L * L) - s->b * s->R) / sqrt(D * D + up * up);
  if (sine >= 1.0)
    return 0.5 * pi;
  return (sine <= -1.0 ? -0.5 * pi : carom_asin(sine)) - carom_angle_of(D, up);
}

/* The same of any point. One that is not below the stick gets less than any other, and the less,
 * the farther it is from there. */
static double needed(const stick *s, double L, double D, double h, double r) {
  const double off = carom_greater(carom_greater(-D, D - stick_end - 1e-12), fabs(L) - r);
  return off >= 0.0 ? -pi - off : raised(s, L, D, h, r);
}

static double radius_at(double D) {
  return tip_radius + radius_growth * D;
}

/* The same for a line that crosses below the axis at D, by Newton's method from the elevation that
 * the point there needs. Where f does not grow as fast as what it must be, the stick is along the
 * line, and theta is a right angle. *nearest becomes the x that is the last to be far enough. */
static double over_line(const stick *axis, double D, double h, double k, double *nearest) {
  enum { STEPS = 8 };
  const double b = axis->b * axis->R, up = h - axis->R, r = radius_at(D), g = radius_growth,
               grown = 1.0 - g * g * k * k;
  double theta = D > 0.0 ? raised(axis, 0.0, D, h, r) : 0.0, more = INFINITY, s = 0.0, c = 1.0;
  for (int step = 0; step < STEPS && theta > 0.0 && theta < 0.5 * pi && fabs(more) > 1e-9; step++) {
    carom_sincos(theta, &s, &c);
    const double root = sqrt(grown + k * k * s * s);
    const double f = b + D * s - up * c - r * (root - g * k * k * s) / grown,
                 slope = D * c + up * s - r * k * k * c * (s / root - g) / grown;
    more = slope > 0.0 ? -f / slope : INFINITY;
    theta = more < 0.5 * pi - theta ? theta + more : 0.5 * pi;
  }
  *nearest = k * (r * g - (b + D * s - up * c) * s) / (grown + k * k * s * s);
  return theta;
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

/* What a rail needs: its line, if the point of that which is nearest to the axis is on the rail and
 * below the stick; else the end of that part which is next to the point. */
static double over_rail(const stick *axis, const carom_rail *rail) {
  double L[2], D[2], part[2] = {0.0, 1.0}, share = 0.0, nearest;
  seen_from(axis, rail->p, &L[0], &D[0]);
  seen_from(axis, rail->q, &L[1], &D[1]);
  const double across = L[1] - L[0], along = D[1] - D[0], widest = radius_at(stick_end);
  keep_positive(part, D[0], along);
  keep_positive(part, stick_end - D[0], -along);
  const double first = L[0] + part[0] * across, last = L[0] + part[1] * across;
  if (part[0] >= part[1] || carom_greater(first, last) <= -widest ||
      carom_lesser(first, last) >= widest)
    return 0.0;

  if (fabs(across) > radius_growth * fabs(along)) {
    const double crosses = D[0] - L[0] * along / across;
    const double theta = over_line(axis, crosses, rail->height, along / across, &nearest);
    share = (nearest - L[0]) / across;
    if (share >= part[0] && share <= part[1])
      return theta;
  }
  share = share < part[0] ? part[0] : part[1];
  const double end = D[0] + share * along;
  return needed(axis, L[0] + share * across, end, rail->height, radius_at(end));
}

/* What the front of a jaw needs, or `least` if that is more: by the golden section over directions
 * from its centre. A stick that grows touches it a little behind its widest place. */
static double over_jaw(const stick *axis, const carom_jaw *jaw, double least) {
  enum { STEPS = 30 };
  const double golden = 0.6180339887498949, rho = jaw->radius;
  double L, D, at[2], theta[2], high = 0.5 * pi + radius_growth, low = -high;
  seen_from(axis, jaw->centre, &L, &D);
  /* no point of it needs more than one at its front that is as near to the axis as any */
  const double beside = carom_greater(fabs(L) - rho, 0.0), front = carom_greater(D - rho, 1e-9);
  if (D + rho <= 0.0 || needed(axis, beside, front, jaw->height, radius_at(D + rho)) <= least)
    return least;

  for (int step = -2; step < STEPS; step++) {
    /* two places; then the worse one is an end, and a place comes on the other side */
    const int next = step < 0 ? step + 2 : theta[0] < theta[1] ? 1 : 0;
    if (step >= 0) {
      *(next == 1 ? &low : &high) = at[1 - next];
      at[1 - next] = at[next];
      theta[1 - next] = theta[next];
    }
    double sine, cosine;
    at[next] = next == 1 ? low + golden * (high - low) : high - golden * (high - low);
    carom_sincos(at[next], &sine, &cosine);
    const double behind = D - rho * cosine;
    theta[next] = needed(axis, L + rho * sine, behind, jaw->height, radius_at(behind));
  }
  return carom_greater(carom_greater(theta[0], theta[1]), least);
}

double carom_least_elevation(const carom_table *table, const carom_shot_ball *balls, int count,
                             const carom_cue *cue) {
  const carom_shot_ball *own = &balls[cue->ball];
  stick axis = {.R = own->kind.radius, .b = cue->b};
  double most = 0.0;
  carom_sincos(cue->phi * degree, &axis.u[1], &axis.u[0]);
  axis.at[0] = own->state.r[0] - cue->a * axis.R * axis.u[1];
  axis.at[1] = own->state.r[1] + cue->a * axis.R * axis.u[0];

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
