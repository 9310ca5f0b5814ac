/* Where balls have a place on a table: the geometry of rails, jaws and pockets for the centre of
 * a ball. */
#include "table/table.h"

static double distance_to(const carom_features *f, int rail, const double r[2]) {
  return f->line[rail][0] * r[0] + f->line[rail][1] * r[1] + f->line[rail][2];
}
/* Along a rail, 0 at one of its ends and 1 at the other. */
static double place_along(const carom_features *f, int rail, const double r[2]) {
  return f->along[rail][0] * r[0] + f->along[rail][1] * r[1] + f->along[rail][2];
}
static bool is_beside(const carom_features *f, int rail, const double r[2]) {
  const double place = place_along(f, rail, r);
  return place >= 0.0 && place <= 1.0;
}
/* Whether a place is behind a rail, or up to the rail's length farther: a place beyond a corner
 * is beside neither of its rails.
 */
static bool is_behind(double place, double distance) {
  return place >= -1.0 && place <= 2.0 && distance < 0.0;
}

static bool is_in_hull(const carom_features *f, const double r[2]) {
  return r[0] >= f->hull[0] && r[0] <= f->hull[1] && r[1] >= f->hull[2] && r[1] <= f->hull[3];
}
static bool beyond_ends(const carom_features *f, const double r[2]) {
  return f->rails > 0 &&
         (r[0] < f->ends[0] || r[0] > f->ends[1] || r[1] < f->ends[2] || r[1] > f->ends[3]);
}

bool carom_place_is_outside(const carom_table *table, const carom_features *f,
                            const carom_ball_kind *kind, const double r[2]) {
  if (!is_in_hull(f, r))
    return true;
  /* only behind a rail, or beyond the ends of all rails, can it be outside */
  bool behind = beyond_ends(f, r);
  for (int k = 0; k < f->rails; k++)
    behind |= is_behind(place_along(f, k, r), distance_to(f, k, r));
  return behind && carom_is_cut_off(table, f, kind, r);
}

/* How far from the wall of a cushion the centre is when a ball on the cloth touches its nose. */
static inline double reach_of(const carom_features *f, const carom_ball_kind *kind, double height,
                              bool usual) {
  return usual ? kind->radius : carom_reach_on_cloth(kind, height, f->reference);
}
/* Whether a ball on the cloth is in a rail; in a jaw; with its centre in a pocket. */
static inline bool in_rail(const carom_features *f, int k, const double r[3], double reach,
                           bool *behind) {
  const double distance = distance_to(f, k, r), place = place_along(f, k, r);
  const bool beside = place >= 0.0 && place <= 1.0;
  *behind |= is_behind(place, distance);
  return beside && distance < reach - CAROM_MOST_OVERLAP && distance > -reach;
}
static inline bool in_circle(const double centre[2], double reach, const double r[3]) {
  const double d_x = r[0] - centre[0], d_y = r[1] - centre[1];
  return d_x * d_x + d_y * d_y < reach * reach;
}
static inline bool in_jaw(const carom_jaw *jaw, const double r[3], double reach) {
  return in_circle(jaw->centre, jaw->radius + reach - CAROM_MOST_OVERLAP, r);
}

/* Whether the ball, on the cloth, stands within the cushions, in no pocket. Inlined twice, so
 * that the loops for balls of the usual radius, `usual`, have no calls in them. */
static inline bool stands_among(const carom_table *table, const carom_features *f,
                                const carom_ball_kind *kind, const double r[3], bool usual) {
  bool good = is_in_hull(f, r), behind = beyond_ends(f, r);
  for (int k = 0; k < f->rails; k++)
    good &= !in_rail(f, k, r, reach_of(f, kind, table->rail[k].height, usual), &behind);
  for (int k = 0; k < f->jaws; k++)
    good &= !in_jaw(&table->jaw[k], r, reach_of(f, kind, table->jaw[k].height, usual));
  for (int k = 0; k < f->pockets; k++)
    good &= !in_circle(table->pocket[k].centre, table->pocket[k].radius, r);
  return good && !(behind && carom_is_cut_off(table, f, kind, r));
}
bool carom_stands_on_table(const carom_table *table, const carom_features *f,
                           const carom_ball_kind *kind, const double r[3]) {
  return kind->radius == f->reference ? stands_among(table, f, kind, r, true)
                                      : stands_among(table, f, kind, r, false);
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
  bool good = r[2] >= carom_nose_height(kind, f->nose_low) + kind->radius - CAROM_MOST_OVERLAP ||
              !carom_place_is_outside(table, f, kind, r);
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

carom_part carom_part_there(const carom_table *table, const carom_features *f,
                            const carom_ball_kind *kind, const double r[3]) {
  bool behind = false;
  for (int k = 0; k < f->pockets; k++)
    if (in_circle(table->pocket[k].centre, table->pocket[k].radius, r))
      return (carom_part){CAROM_PART_POCKET, k};
  for (int k = 0; k < f->rails; k++)
    if (in_rail(f, k, r, reach_of(f, kind, table->rail[k].height, false), &behind))
      return (carom_part){CAROM_PART_RAIL, k};
  for (int k = 0; k < f->jaws; k++)
    if (in_jaw(&table->jaw[k], r, reach_of(f, kind, table->jaw[k].height, false)))
      return (carom_part){CAROM_PART_JAW, k};
  return (carom_part){CAROM_PART_NONE, 0};
}
