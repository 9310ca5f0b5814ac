/* Friction and restitution of a jaw along its nose.
 *
 * At a seam a jaw continues a rail: the rail ends on the circle of the jaw and is tangent to it
 * there. At the seam the jaw has the friction and the restitution of the rail, so that the rebound
 * of a ball does not jump. With the chord s from the seam to the position that the ball touches,
 *
 *     x = min(1, s / 8 mm),      w = x^2 (3 - 2 x),      mu = w mu_jaw + (1 - w) mu_rail,
 *
 * and likewise e; w has a continuous derivative. Between two seams, at the ends of the arc,
 *
 *     mu = (w1 w2 mu_jaw + (1 - w1) w2 mu_1 + (1 - w2) w1 mu_2) / (w1 + w2 - w1 w2).
 *
 * This is the rule of one seam where the other one is 8 mm away or more. In shorter arcs both
 * passages overlap, and each seam still has the numbers of its rail. 8 mm is a convention: the arcs
 * of pool's jaws are 10 to 14 mm long.
 *
 * Seams depend only on the numbers of the table. They are looked for when a ball meets a jaw:
 * preparing the seams of all jaws for each shot would take half as long as a short shot. */
#include "table/table.h"

#include <math.h>

static const double passage = 8e-3;   /* m, of chord */
static const double tolerance = 1e-4; /* m: of a seam, across the circle and along the rail; tables
                                         may be drawn to tenths of a millimetre */

static double square_of_distance(const double a[2], const double b[2]) {
  const double x = a[0] - b[0], y = a[1] - b[1];
  return x * x + y * y;
}

/* Whether a jaw continues a rail at this end of it. */
static bool continues(const carom_jaw *jaw, const carom_rail *rail, const double end[2]) {
  const double rho = jaw->radius, off = square_of_distance(end, jaw->centre) - rho * rho;
  if (fabs(off) > tolerance * (2.0 * rho + tolerance))
    return false;
  const double along = (end[0] - jaw->centre[0]) * (rail->q[0] - rail->p[0]) +
                       (end[1] - jaw->centre[1]) * (rail->q[1] - rail->p[1]);
  return along * along <= tolerance * tolerance * square_of_distance(rail->p, rail->q);
}

int carom_seams_of(const carom_table *table, int index, carom_seam seam[CAROM_SEAMS_MOST]) {
  const carom_jaw *jaw = &table->jaw[index];
  int count = 0;
  if (jaw->radius == 0.0) /* a corner, which has no arc */
    return 0;
  for (int rail_index = 0; rail_index < table->rails && count < CAROM_SEAMS_MOST; rail_index++) {
    const carom_rail *rail = &table->rail[rail_index];
    const double *end = rail->p;
    if (!continues(jaw, rail, end)) {
      end = rail->q;
      if (!continues(jaw, rail, end))
        continue;
    }
    /* rails that meet at one position share a seam */
    if (count > 0 && square_of_distance(end, seam[0].end) <= tolerance * tolerance)
      continue;
    seam[count].rail = rail_index;
    for (int axis = 0; axis < 2; axis++)
      seam[count].end[axis] = end[axis];
    count++;
  }
  return count;
}

/* w, from a seam. */
static double own_share(const double place[2], const carom_seam *seam) {
  const double x = sqrt(square_of_distance(place, seam->end)) / passage;
  if (x >= 1.0)
    return 1.0;
  return x * x * (3.0 - 2.0 * x);
}

__attribute__((noinline)) void carom_blend_jaw(const carom_table *table, int index,
                                               const carom_ball_kind *kind, const double centre[3],
                                               double *mu, double *restitution) {
  const carom_jaw *jaw = &table->jaw[index];
  carom_seam seam[CAROM_SEAMS_MOST];
  const int count = carom_seams_of(table, index, seam);
  const double distance = sqrt(square_of_distance(centre, jaw->centre));
  if (count == 0 || distance == 0.0)
    return;

  /* the position that the ball touches, and w there */
  double place[2], w[CAROM_SEAMS_MOST] = {1.0, 1.0};
  for (int axis = 0; axis < 2; axis++)
    place[axis] = jaw->centre[axis] + jaw->radius / distance * (centre[axis] - jaw->centre[axis]);
  for (int side = 0; side < count; side++)
    w[side] = own_share(place, &seam[side]);

  /* how far each rail takes the numbers of the jaw to its own */
  const double all = w[0] + w[1] - w[0] * w[1], mu_jaw = *mu, e_jaw = *restitution;
  for (int side = 0; side < count; side++) {
    const carom_rail *rail = &table->rail[seam[side].rail];
    const double share = (1.0 - w[side]) * w[1 - side] / all;
    *mu += share * (carom_or_usual(rail->mu_cushion, kind->mu_cushion) - mu_jaw);
    *restitution += share * (carom_or_usual(rail->restitution, kind->restitution_cushion) - e_jaw);
  }
}
