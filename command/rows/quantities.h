/* What people ask of a collision beyond its twelve numbers: throw, deflection, motion once both
 * balls roll, spin, energy. */
#ifndef CAROM_CLI_QUANTITIES_H
#define CAROM_CLI_QUANTITIES_H

#include "carom.h"

#include <math.h>

/* One degree in radians. */
static const double degree = 3.14159265358979323846 / 180.0;

/* The size of a vector in the plane of the cloth, and how far apart two places on it are. */
static inline double plane_size(const double a[2]) {
  return hypot(a[0], a[1]);
}
static inline double plane_distance(const double a[2], const double b[2]) {
  return hypot(a[0] - b[0], a[1] - b[1]);
}

/* Its numbers stand in the order of DERIVED_COLUMNS. Angles in degrees, to the left as seen from
 * above. */
typedef struct derived {
  double throw_deg;                  /* of ball 2's change of velocity from the line of centres */
  double deflection_deg;             /* of ball 1's velocity from what it was; NaN where it had
                                        or has none */
  double deflection_rolls;           /* the same once ball 1 rolls */
  double rolling_1[2], rolling_2[2]; /* velocities once sliding has turned to rolling, m/s */
  double spin_transfer; /* ball 2's change of spin about the vertical over ball 1's spin before;
                           NaN where that is 0 */
  double energy_lost;   /* share of the kinetic energy, spins included */
} derived;

enum { DERIVED_NUMBERS = sizeof(derived) / sizeof(double) };
#define DERIVED_COLUMNS                                                                        \
  "throw_deg,deflection_deg,deflection_rolling_deg,roll1x,roll1y,roll2x,roll2y,spin_transfer," \
  "energy_lost"

derived derive(const carom_impact *in, const carom_result *out);

/* The angle from a to b, degrees, -180 to 180, to the left as seen from above. */
double angle_between(const double a[2], const double b[2]);

/* The same after a collision, of at least 1e-6 degrees where the balls have no friction: the solver
 * has one of 1e-9 then, which turns them by 6e-8. */
double turn(const carom_impact *in, const double a[2], const double b[2]);

/* Kinetic energy of a solid ball in motion, J. */
double energy_of(double mass, double radius, const double v[3], const double w[3]);

#endif
