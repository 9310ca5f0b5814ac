/* Where the nose of a cushion is, for balls that touch it at any height.
 *
 * A rail stands for a wall at L: a ball on the cloth touches it when its centre is its radius from L, though it touches the
 * nose at its height h. So the true nose is the line at height h,
 *
 *   delta = R_ref - sqrt(h (2 R_ref - h))
 *
 * inside L (1.143 mm for pool balls), R_ref being the radius of the balls that the table is meant for. With s the distance of
 * the centre from L, the centre is at d = (s - delta, z - h) from the nose, across it and up; |d| = R at the contact. At z = R
 * that is s = R for R = R_ref, so flat and flying balls agree. Smaller and larger balls on the cloth touch at delta + sqrt(h (2
 * R - h)). A jaw of radius rho is the circle of radius rho + delta at height h, s - delta being the distance from that circle.
 */
#include "shot/sim.h"

#include <math.h>

double carom_nose_height(const carom_ball_kind *kind, double height) {
  return kind->nose_height > 0.0 ? kind->nose_height : height;
}

double carom_nose_shift(double height, double reference) {
  return reference - sqrt(height * (2.0 * reference - height));
}

double carom_reach_on_cloth(const carom_ball_kind *kind, double height, double reference) {
  const double R = kind->radius, h = carom_nose_height(kind, height);
  return R == reference ? R : carom_nose_shift(h, reference) + sqrt(h * (2.0 * R - h));
}

/* The unit vector of -(across * out, up), of which out points from the nose to the ball in the plane. */
static void turn_back(double across, double up, const double out[2], double N[3]) {
  const double size = sqrt(across * across + up * up);
  N[0] = -across / size * out[0];
  N[1] = -across / size * out[1];
  N[2] = -up / size;
}

void carom_into_nose(const carom_sim *sim, const carom_ball_kind *kind, int type, int what, const double r[3], double N[3]) {
  const double reference = sim->features->reference;
  if (type == CAROM_EVENT_RAIL) {
    const double *line = sim->features->line[what], h = carom_nose_height(kind, sim->table->rail[what].height);
    turn_back(line[0] * r[0] + line[1] * r[1] + line[2] - carom_nose_shift(h, reference), r[2] - h, line, N);
  } else {
    const carom_jaw *jaw = &sim->table->jaw[what];
    const double h = carom_nose_height(kind, jaw->height), x = r[0] - jaw->centre[0], y = r[1] - jaw->centre[1];
    const double q = sqrt(x * x + y * y), out[2] = {q > 0.0 ? x / q : 0.0, q > 0.0 ? y / q : 0.0};
    turn_back(q - jaw->radius - carom_nose_shift(h, reference), r[2] - h, out, N);
  }
}

double carom_height_on_top(const carom_sim *sim, int i, int what) {
  const carom_ball_kind *kind = &sim->ball[i].kind;
  const int jaw = what - sim->features->rails;
  return carom_nose_height(kind, jaw < 0 ? sim->table->rail[what].height : sim->table->jaw[jaw].height) + kind->radius;
}
