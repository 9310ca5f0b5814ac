/* What people ask of a collision beyond its twelve numbers. */
#include "rows/quantities.h"

double angle_between(const double a[2], const double b[2]) {
  return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]) / degree;
}

double turn(const carom_impact *in, const double a[2], const double b[2]) {
  const double degrees = angle_between(a, b);
  return in->mu_ball > 1e-9 ? degrees : round(1e6 * degrees) / 1e6 + 0.0;
}

double energy_of(double mass, double radius, const double v[3], const double w[3]) {
  double speeds = 0.0, spins = 0.0;
  for (int k = 0; k < 3; k++) {
    speeds += v[k] * v[k];
    spins += w[k] * w[k];
  }
  return 0.5 * mass * (speeds + 0.4 * radius * radius * spins);
}

derived derive(const carom_impact *in, const carom_result *out) {
  derived d;
  double rolling[3];
  const double along[2] = {in->b.r[0] - in->a.r[0], in->b.r[1] - in->a.r[1]};
  const double change[2] = {out->b.v[0] - in->b.v[0], out->b.v[1] - in->b.v[1]};
  d.throw_deg = turn(in, along, change);
  carom_rolling_velocity(out->a.v, out->a.w, in->a.radius, rolling);
  d.rolling_1[0] = rolling[0];
  d.rolling_1[1] = rolling[1];
  carom_rolling_velocity(out->b.v, out->b.w, in->b.radius, rolling);
  d.rolling_2[0] = rolling[0];
  d.rolling_2[1] = rolling[1];
  /* A ball that stops to within rounding has no direction. */
  const double least = 1e-9 * plane_size(in->a.v);
  d.deflection_deg = plane_size(out->a.v) > least ? turn(in, in->a.v, out->a.v) : (double)NAN;
  d.deflection_rolls =
      plane_size(d.rolling_1) > least ? turn(in, in->a.v, d.rolling_1) : (double)NAN;
  d.spin_transfer = in->a.w[2] != 0.0 ? (out->b.w[2] - in->b.w[2]) / in->a.w[2] : (double)NAN;
  const carom_ball *a = &in->a, *b = &in->b;
  const double energy_in =
      energy_of(a->mass, a->radius, a->v, a->w) + energy_of(b->mass, b->radius, b->v, b->w);
  const double energy_out = energy_of(a->mass, a->radius, out->a.v, out->a.w) +
                            energy_of(b->mass, b->radius, out->b.v, out->b.w);
  d.energy_lost = 1.0 - energy_out / energy_in;
  return d;
}
