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

void carom_into_nose(const carom_sim *sim, int i, const carom_due *due, const carom_ball_state *s, double N[3]) {
  const carom_ball_kind *kind = &sim->ball[i].kind;
  const double *r = s->r;
  double out[2], across, height; /* the horizontal direction from the nose to the centre; the distance from the wall */
  if (due->type == CAROM_EVENT_RAIL) {
    const double *line = sim->features->line[due->b];
    out[0] = line[0];
    out[1] = line[1];
    across = line[0] * r[0] + line[1] * r[1] + line[2];
    height = sim->table->rail[due->b].height;
  } else {
    const carom_jaw *jaw = &sim->table->jaw[due->b];
    const double x = r[0] - jaw->centre[0], y = r[1] - jaw->centre[1], q = sqrt(x * x + y * y);
    out[0] = q > 0.0 ? x / q : 0.0;
    out[1] = q > 0.0 ? y / q : 0.0;
    across = q - jaw->radius;
    height = jaw->height;
  }

  /* a ball on the cloth meets the wall, one that flies the nose itself */
  N[0] = -out[0];
  N[1] = -out[1];
  N[2] = 0.0;
  if (!carom_flies(s))
    return;
  const double h = carom_nose_height(kind, height), up = r[2] - h;
  across -= carom_nose_shift(h, sim->features->reference);
  const double size = sqrt(across * across + up * up);
  N[0] = -across / size * out[0];
  N[1] = -across / size * out[1];
  N[2] = -up / size;
}

double carom_height_on_top(const carom_sim *sim, int i, int what) {
  const carom_ball_kind *kind = &sim->ball[i].kind;
  const int jaw = what - sim->features->rails;
  return carom_nose_height(kind, jaw < 0 ? sim->table->rail[what].height : sim->table->jaw[jaw].height) + kind->radius;
}
