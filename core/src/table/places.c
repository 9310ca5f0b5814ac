/* Where balls have a position on a table: the geometry of rails, jaws and pockets for the centre of
 * a ball.
 *
 * For the centre of a ball, the parts of a table are a closed ring: it can only leave across a
 * part. So a position that is seen from the eye of the table, to which balls can be rolled, is on
 * the table too. Other positions are examined more closely (ring.c), which takes longer. */
#include "table/table.h"

#include <math.h>

/* Across a rail, above 0 on its played side. */
static double distance_to(const carom_features *features, int rail, const double centre[2]) {
  return carom_plane_dot(features->line[rail], centre) + features->line[rail][2];
}
/* Along a rail, 0 at one of its ends and 1 at the other. */
static double place_along(const carom_features *features, int rail, const double centre[2]) {
  return carom_plane_dot(features->along[rail], centre) + features->along[rail][2];
}
static bool is_beside(const carom_features *features, int rail, const double centre[2]) {
  const double place = place_along(features, rail, centre);
  return place >= 0.0 && place <= 1.0;
}
static bool is_in_hull(const carom_features *features, const double centre[2]) {
  return centre[0] >= features->hull[0] && centre[0] <= features->hull[1] &&
         centre[1] >= features->hull[2] && centre[1] <= features->hull[3];
}

/* Whether a ball on the cloth is in a rail; in a jaw; with its centre in a pocket. */
static bool in_rail(const carom_features *features, int rail, const double centre[2],
                    double reach) {
  const double distance = distance_to(features, rail, centre);
  return is_beside(features, rail, centre) && distance < reach - CAROM_MOST_OVERLAP &&
         distance > -reach;
}
static bool in_circle(const double centre[2], double reach, const double point[2]) {
  const double d_x = point[0] - centre[0], d_y = point[1] - centre[1];
  return d_x * d_x + d_y * d_y < reach * reach;
}
static bool in_jaw(const carom_jaw *jaw, const double centre[2], double reach) {
  return in_circle(jaw->centre, jaw->radius + reach - CAROM_MOST_OVERLAP, centre);
}

/* Whether the way from the eye to a position leads across a rail, as the centre of a ball does that
 * touches it at the distance `reach`. It crosses that line where the position along the rail is the
 * mean of the positions of both ends, each weighted by the distance of the other. */
static bool crosses_rail(const carom_features *features, int rail, const double centre[2],
                         double reach) {
  const double gap_at_eye = distance_to(features, rail, features->eye) - reach,
               gap_at_place = distance_to(features, rail, centre) - reach;
  if ((gap_at_eye < 0.0) == (gap_at_place < 0.0))
    return false;
  const double place = (gap_at_eye * place_along(features, rail, centre) -
                        gap_at_place * place_along(features, rail, features->eye)) /
                       (gap_at_eye - gap_at_place);
  return place >= 0.0 && place <= 1.0;
}
/* The same for a circle: whether the position of the way that is nearest to its centre is in it. */
static bool crosses_circle(const carom_features *features, const double centre[2], double radius,
                           const double point[2]) {
  const double way[2] = {point[0] - features->eye[0], point[1] - features->eye[1]},
               to_centre[2] = {centre[0] - features->eye[0], centre[1] - features->eye[1]};

  /* the position of the way that is nearest to the centre of the circle, between both ends */
  const double size2 = carom_plane_dot(way, way),
               along = carom_lesser(carom_greater(carom_plane_dot(way, to_centre), 0.0), size2),
               share = size2 > 0.0 ? along / size2 : 0.0;
  const double place[2] = {features->eye[0] + share * way[0], features->eye[1] + share * way[1]};
  return in_circle(centre, radius, place);
}

void carom_ground_of(const carom_table *table, const carom_features *features,
                     const carom_ball_kind *kind, carom_ground *ground) {
  ground->table = table;
  ground->features = features;
  ground->kind = kind;
  for (int index = 0; index < features->rails; index++)
    ground->rail[index] =
        carom_reach_on_cloth(kind, table->rail[index].height, features->reference);
  for (int index = 0; index < features->jaws; index++)
    ground->jaw[index] = carom_reach_on_cloth(kind, table->jaw[index].height, features->reference);
}

bool carom_is_in_sight(const carom_ground *ground, const double centre[2]) {
  const carom_features *features = ground->features;
  const carom_table *table = ground->table;
  if (carom_is_clear(features, centre))
    return true;

  for (int index = 0; index < features->rails; index++)
    if (crosses_rail(features, index, centre, ground->rail[index] - CAROM_RING_OVERLAP))
      return false;
  for (int index = 0; index < features->jaws; index++)
    if (crosses_circle(features, table->jaw[index].centre,
                       table->jaw[index].radius + ground->jaw[index] - CAROM_RING_OVERLAP, centre))
      return false;
  for (int index = 0; index < features->pockets; index++)
    if (crosses_circle(features, table->pocket[index].centre, table->pocket[index].radius, centre))
      return false;
  return true;
}

/* Of a position that is not clear. */
static bool is_outside(const carom_ground *ground, const double centre[2]) {
  const carom_features *features = ground->features;
  return !is_in_hull(features, centre) ||
         (!(features->has_eye && carom_is_in_sight(ground, centre)) &&
          carom_is_cut_off(ground, centre));
}

bool carom_place_is_outside(const carom_table *table, const carom_features *features,
                            const carom_ball_kind *kind, const double centre[2]) {
  if (carom_is_clear(features, centre))
    return false;
  carom_ground ground;
  carom_ground_of(table, features, kind, &ground);
  return is_outside(&ground, centre);
}

carom_part carom_part_there(const carom_ground *ground, const double centre[3]) {
  const carom_features *features = ground->features;
  const carom_table *table = ground->table;
  for (int index = 0; index < features->pockets; index++)
    if (in_circle(table->pocket[index].centre, table->pocket[index].radius, centre))
      return (carom_part){CAROM_PART_POCKET, index};
  for (int index = 0; index < features->rails; index++)
    if (in_rail(features, index, centre, ground->rail[index]))
      return (carom_part){CAROM_PART_RAIL, index};
  for (int index = 0; index < features->jaws; index++)
    if (in_jaw(&table->jaw[index], centre, ground->jaw[index]))
      return (carom_part){CAROM_PART_JAW, index};
  return (carom_part){CAROM_PART_NONE, 0};
}

bool carom_stands_on_table(const carom_table *table, const carom_features *features,
                           const carom_ball_kind *kind, const double centre[3]) {
  if (carom_is_clear(features, centre))
    return true;
  carom_ground ground;
  carom_ground_of(table, features, kind, &ground);
  return carom_part_there(&ground, centre).kind == CAROM_PART_NONE && !is_outside(&ground, centre);
}

/* Where an airborne ball in front of noses would be, if it was moved off them until it could touch
 * them while it lay on the cloth: above it, the centre can be nearer to a nose. */
static void off_noses(const carom_ground *ground, const double centre[3], double place[2]) {
  const carom_features *features = ground->features;
  const double radius = ground->kind->radius;
  place[0] = centre[0];
  place[1] = centre[1];
  for (int index = 0; index < features->rails; index++) {
    const double more = ground->rail[index] - distance_to(features, index, place);
    if (!is_beside(features, index, place) || more < 0.0 || more > radius)
      continue;
    for (int axis = 0; axis < 2; axis++)
      place[axis] += more * features->line[index][axis];
  }
  for (int index = 0; index < features->jaws; index++) {
    const carom_jaw *jaw = &ground->table->jaw[index];
    const double from_jaw[2] = {place[0] - jaw->centre[0], place[1] - jaw->centre[1]};
    const double distance = carom_plane_size(from_jaw);
    const double more = jaw->radius + ground->jaw[index] - distance;
    if (more < 0.0 || more > radius)
      continue;
    for (int axis = 0; axis < 2; axis++)
      place[axis] += more * from_jaw[axis] / distance;
  }
}

/* Whether an airborne ball is clear of a nose that is `across` in front of it and `down` below
 * its centre, or on its top. */
static bool clear_of_nose(double across, double down, double radius) {
  const double reach = radius - CAROM_MOST_OVERLAP;
  return across >= 0.0 ? across * across + down * down >= reach * reach : down >= reach;
}

__attribute__((noinline, cold)) bool carom_is_above_table(const carom_table *table,
                                                          const carom_features *features,
                                                          const carom_ball_kind *kind,
                                                          const double centre[3]) {
  carom_ground ground;
  carom_ground_of(table, features, kind, &ground);
  double place[2];
  off_noses(&ground, centre, place);
  bool good = centre[2] >=
                  carom_nose_height(kind, features->nose_low) + kind->radius - CAROM_MOST_OVERLAP ||
              carom_is_clear(features, place) || !is_outside(&ground, place);
  for (int axis = 0; axis < 2; axis++)
    good &= centre[axis] >= features->hull[2 * axis] - features->width &&
            centre[axis] <= features->hull[2 * axis + 1] + features->width;
  for (int index = 0; index < features->rails; index++) {
    const double height = carom_nose_height(kind, table->rail[index].height),
                 across = distance_to(features, index, centre);
    if (is_beside(features, index, centre) && across >= -features->width)
      good &= clear_of_nose(across - carom_nose_shift(height, features->reference),
                            centre[2] - height, kind->radius);
  }
  for (int index = 0; index < features->jaws; index++) {
    const carom_jaw *jaw = &table->jaw[index];
    const double height = carom_nose_height(kind, jaw->height), d_x = centre[0] - jaw->centre[0],
                 d_y = centre[1] - jaw->centre[1];
    const double across =
        sqrt(d_x * d_x + d_y * d_y) - jaw->radius - carom_nose_shift(height, features->reference);
    good &= clear_of_nose(across, centre[2] - height, kind->radius);
  }
  return good;
}
