/* The least elevation of the cue with which its stick is over cushions and balls.
 *
 * In the vertical plane of the stick, with the origin in the cue ball's centre, the axis of a stick
 * that is raised by theta is where x sin(theta) + z cos(theta) = b R, x forward. A point that is D
 * behind and h above the slate is below the axis by
 *
 *     b R + D sin(theta) - (h - R) cos(theta) >= q,
 *
 * where q is the radius of the stick there; of a ball, whose centre is L beside the axis,
 * q^2 = (its radius + that of the stick)^2 - L^2. With A^2 = D^2 + (R - h)^2 that is
 *
 *     theta >= asin((q - b R) / A) - atan2(R - h, D).
 */
#include "plan/view.h"
#include "platform/elementary.h"

#include <math.h>

/* m: a cue of usual make; its radius grows evenly from the tip on */
static const double stick_length = 1.47, tip_radius = 0.0065, radius_growth = 0.0055;

static double raised(double R, double b, double D, double h, double q) {
  const double A = sqrt(D * D + (R - h) * (R - h)), sine = (q - b * R) / A;
  return sine >= 1.0 ? 0.5 * pi : sine <= -1.0 ? 0.0 : carom_asin(sine) - carom_angle_of(D, R - h);
}

/* A nose that the stick crosses at an angle alpha is as near as q sin(alpha) / sqrt(sin(theta)^2 +
 * cos(theta)^2 sin(alpha)^2), so q and theta are found in turn. */
static double over_rail(double R, double b, double D, const carom_rail *rail, const double u[2]) {
  enum { STEPS = 4 };
  const double e[2] = {rail->q[0] - rail->p[0], rail->q[1] - rail->p[1]};
  const double cross = u[0] * e[1] - u[1] * e[0];
  const double square = cross * cross / (e[0] * e[0] + e[1] * e[1]);
  const double radius = tip_radius + radius_growth * D;
  double theta = raised(R, b, D, rail->height, radius);
  for (int step = 0; step < STEPS && theta > 0.0; step++) {
    double sine, cosine;
    carom_sincos(theta, &sine, &cosine);
    theta = raised(R, b, D, rail->height,
                   radius * sqrt((sine * sine + cosine * cosine * square) / square));
  }
  return theta;
}

double carom_least_elevation(const carom_table *table, const carom_shot_ball *balls, int count,
                             const carom_cue *cue) {
  const carom_shot_ball *own = &balls[cue->ball];
  const double R = own->kind.radius, *r = own->state.r;
  double u[2], most = 0.0;
  carom_sincos(cue->phi * degree, &u[1], &u[0]);
  /* a point of the axis in the plane of the table */
  const double at[2] = {r[0] - cue->a * R * u[1], r[1] + cue->a * R * u[0]};

  for (int k = 0; k < table->rails; k++) {
    /* on which side of the axis both ends are, and how far behind the ball it crosses the rail */
    const carom_rail *rail = &table->rail[k];
    const double p[2] = {rail->p[0] - at[0], rail->p[1] - at[1]},
                 q[2] = {rail->q[0] - at[0], rail->q[1] - at[1]};
    const double side_p = u[0] * p[1] - u[1] * p[0], side_q = u[0] * q[1] - u[1] * q[0];
    if ((side_p > 0.0) == (side_q > 0.0))
      continue;
    const double part = side_p / (side_p - side_q);
    const double D = -((p[0] + part * (q[0] - p[0])) * u[0] + (p[1] + part * (q[1] - p[1])) * u[1]);
    if (D > 0.0 && D < stick_length) {
      const double least = over_rail(R, cue->b, D, rail, u);
      most = least > most ? least : most;
    }
  }
  for (int k = 0; k < count; k++) {
    const carom_shot_ball *ball = &balls[k];
    const double x = ball->state.r[0] - at[0], y = ball->state.r[1] - at[1];
    const double D = -(x * u[0] + y * u[1]), L = u[0] * y - u[1] * x;
    const double both = ball->kind.radius + tip_radius + radius_growth * D;
    const bool gone =
        ball->state.label == CAROM_BALL_POCKETED || ball->state.label == CAROM_BALL_OFF;
    if (k == cue->ball || gone || !(D > 0.0 && D < stick_length && L * L < both * both))
      continue;
    const double least = raised(R, cue->b, D, ball->state.r[2], sqrt(both * both - L * L));
    most = least > most ? least : most;
  }
  return most / degree;
}
