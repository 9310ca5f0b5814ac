/* Where balls have a place on a table: the geometry of rails, jaws and pockets for the centre of
 * a ball.
 *
 * The parts of a table are a closed ring to the centre of a ball: none gets out but across a
 * part. So a place that is seen from the eye of the table, to which balls can be rolled, is on
 * the table too. Other places are looked at more closely (ring.c), which takes longer. */
#include "table/table.h"

#include <math.h>

static double distance_to(const carom_features *f, int rail, const double r[2]) {
  return carom_plane_dot(f->line[rail], r) + f->line[rail][2];
}
/* Along a rail, 0 at one of its ends and 1 at the other. */
static double place_along(const carom_features *f, int rail, const double r[2]) {
  return carom_plane_dot(f->along[rail], r) + f->along[rail][2];
}
static bool is_beside(const carom_features *f, int rail, const double r[2]) {
  const double place = place_along(f, rail, r);
  return place >= 0.0 && place <= 1.0;
}
static bool is_in_hull(const carom_features *f, const double r[2]) {
  return r[0] >= f->hull[0] && r[0] <= f->hull[1] && r[1] >= f->hull[2] && r[1] <= f->hull[3];
}

/* Whether a ball on the cloth is in a rail; in a jaw; with its centre in a pocket. */
static bool in_rail(const carom_features *f, int k, const double r[2], double reach) {
  const double distance = distance_to(f, k, r);
  return is_beside(f, k, r) && distance < reach - CAROM_MOST_OVERLAP && distance > -reach;
}
static bool in_circle(const double centre[2], double reach, const double r[2]) {
  const double d_x = r[0] - centre[0], d_y = r[1] - centre[1];
  return d_x * d_x + d_y * d_y < reach * reach;
}
static bool in_jaw(const carom_jaw *jaw, const double r[2], double reach) {
  return in_circle(jaw->centre, jaw->radius + reach - CAROM_MOST_OVERLAP, r);
}

/* Whether the way from the eye to r leads across a rail, as the centre of a ball does that touches
 * it at the distance `reach`. It crosses that line where the place along the rail is the mean of
 * those of both ends, weighted by the distance of the other. */
static bool crosses_rail(const carom_features *f, int k, const double r[2], double reach) {
  const double gap_at_eye = distance_to(f, k, f->eye) - reach,
               gap_at_place = distance_to(f, k, r) - reach;
  if ((gap_at_eye < 0.0) == (gap_at_place < 0.0))
    return false;
  const double place =
      (gap_at_eye * place_along(f, k, r) - gap_at_place * place_along(f, k, f->eye)) /
      (gap_at_eye - gap_at_place);
  return place >= 0.0 && place <= 1.0;
}
/* The same for a circle: whether the place of the way that is nearest to its centre is in it. */
static bool crosses_circle(const carom_features *f, const double centre[2], double radius,
                           const double r[2]) {
  const double way[2] = {r[0] - f->eye[0], r[1] - f->eye[1]},
               c[2] = {centre[0] - f->eye[0], centre[1] - f->eye[1]};
  const double size2 = carom_plane_dot(way, way),
               along = carom_lesser(carom_greater(carom_plane_dot(way, c), 0.0), size2),
               share = size2 > 0.0 ? along / size2 : 0.0;
  const double place[2] = {f->eye[0] + share * way[0], f->eye[1] + share * way[1]};
  return in_circle(centre, radius, place);
}

void carom_ground_of(const carom_table *table, const carom_features *f, const carom_ball_kind *kind,
                     carom_ground *ground) {
  ground->table = table;
  ground->features = f;
  ground->kind = kind;
  for (int k = 0; k < f->rails; k++)
    ground->rail[k] = carom_reach_on_cloth(kind, table->rail[k].height, f->reference);
  for (int k = 0; k < f->jaws; k++)
    ground->jaw[k] = carom_reach_on_cloth(kind, table->jaw[k].height, f->reference);
}

bool carom_is_in_sight(const carom_ground *ground, const double r[2]) {
  const carom_features *f = ground->features;
  const carom_table *table = ground->table;
  if (carom_is_clear(f, r))
    return true;

  for (int k = 0; k < f->rails; k++)
    if (crosses_rail(f, k, r, ground->rail[k] - CAROM_RING_OVERLAP))
      return false;
  for (int k = 0; k < f->jaws; k++)
    if (crosses_circle(f, table->jaw[k].centre,
                       table->jaw[k].radius + ground->jaw[k] - CAROM_RING_OVERLAP, r))
      return false;
  for (int k = 0; k < f->pockets; k++)
    if (crosses_circle(f, table->pocket[k].centre, table->pocket[k].radius, r))
      return false;
  return true;
}

/* Of a place that is not clear. */
static bool is_outside(const carom_ground *ground, const double r[2]) {
  const carom_features *f = ground->features;
  return !is_in_hull(f, r) ||
         (!(f->has_eye && carom_is_in_sight(ground, r)) && carom_is_cut_off(ground, r));
}

bool carom_place_is_outside(const carom_table *table, const carom_features *f,
                            const carom_ball_kind *kind, const double r[2]) {
  if (carom_is_clear(f, r))
    return false;
  carom_ground ground;
  carom_ground_of(table, f, kind, &ground);
  return is_outside(&ground, r);
}

carom_part carom_part_there(const carom_ground *ground, const double r[3]) {
  const carom_features *f = ground->features;
  const carom_table *table = ground->table;
  for (int k = 0; k < f->pockets; k++)
    if (in_circle(table->pocket[k].centre, table->pocket[k].radius, r))
      return (carom_part){CAROM_PART_POCKET, k};
  for (int k = 0; k < f->rails; k++)
    if (in_rail(f, k, r, ground->rail[k]))
      return (carom_part){CAROM_PART_RAIL, k};
  for (int k = 0; k < f->jaws; k++)
    if (in_jaw(&table->jaw[k], r, ground->jaw[k]))
      return (carom_part){CAROM_PART_JAW, k};
  return (carom_part){CAROM_PART_NONE, 0};
}

bool carom_stands_on_table(const carom_table *table, const carom_features *f,
                           const carom_ball_kind *kind, const double r[3]) {
  if (carom_is_clear(f, r))
    return true;
  carom_ground ground;
  carom_ground_of(table, f, kind, &ground);
  return carom_part_there(&ground, r).kind == CAROM_PART_NONE && !is_outside(&ground, r);
}

/* Where an airborne ball in front of noses would be, if it was moved off them until it could touch
 * them while it lay on the cloth: above it, the centre can be nearer to a nose. */
static void off_noses(const carom_ground *ground, const double r[3], double place[2]) {
  const carom_features *f = ground->features;
  const double R = ground->kind->radius;
  place[0] = r[0];
  place[1] = r[1];
  for (int k = 0; k < f->rails; k++) {
    const double more = ground->rail[k] - distance_to(f, k, place);
    if (!is_beside(f, k, place) || more < 0.0 || more > R)
      continue;
    for (int c = 0; c < 2; c++)
      place[c] += more * f->line[k][c];
  }
  for (int k = 0; k < f->jaws; k++) {
    const carom_jaw *jaw = &ground->table->jaw[k];
    const double d[2] = {place[0] - jaw->centre[0], place[1] - jaw->centre[1]};
    const double distance = carom_plane_size(d);
    const double more = jaw->radius + ground->jaw[k] - distance;
    if (more < 0.0 || more > R)
      continue;
    for (int c = 0; c < 2; c++)
      place[c] += more * d[c] / distance;
  }
}

/* Whether an airborne ball is clear of a nose that is `across` in front of it and `down` below
 * its centre, or on its top. */
static bool clear_of_nose(double across, double down, double R) {
  const double reach = R - CAROM_MOST_OVERLAP;
  return across >= 0.0 ? across * across + down * down >= reach * reach : down >= reach;
}

__attribute__((noinline, cold)) bool carom_is_above_table(const carom_table *table,
                                                          const carom_features *f,
                                                          const carom_ball_kind *kind,
                                                          const double r[3]) {
  carom_ground ground;
  carom_ground_of(table, f, kind, &ground);
  double place[2];
  off_noses(&ground, r, place);
  bool good = r[2] >= carom_nose_height(kind, f->nose_low) + kind->radius - CAROM_MOST_OVERLAP ||
              carom_is_clear(f, place) || !is_outside(&ground, place);
  for (int axis = 0; axis < 2; axis++)
    good &= r[axis] >= f->hull[2 * axis] - f->width && r[axis] <= f->hull[2 * axis + 1] + f->width;
  for (int k = 0; k < f->rails; k++) {
    const double h = carom_nose_height(kind, table->rail[k].height), across = distance_to(f, k, r);
    if (is_beside(f, k, r) && across >= -f->width)
      good &= clear_of_nose(across - carom_nose_shift(h, f->reference), r[2] - h, kind->radius);
  }
  for (int k = 0; k < f->jaws; k++) {
    const carom_jaw *jaw = &table->jaw[k];
    const double h = carom_nose_height(kind, jaw->height), d_x = r[0] - jaw->centre[0],
                 d_y = r[1] - jaw->centre[1];
    const double across =
        sqrt(d_x * d_x + d_y * d_y) - jaw->radius - carom_nose_shift(h, f->reference);
    good &= clear_of_nose(across, r[2] - h, kind->radius);
  }
  return good;
}
