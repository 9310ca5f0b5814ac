/* Checks of a table: its parts, each by itself, by the conditions of the comments in
 * carom_shot.h; and the table of a caller, with its ring (ring.c). */
#include "table/table.h"

#include <math.h>

static const double least_pocket = 1e-9;  /* m: of a radius */
static const double off_line_most = 1e-6; /* m: of an end of a rail from its line */

/* 0 where all are finite, else NaN. The parts of a table are checked for each single shot, so there
 * is no branch for each number. */
static inline double zero_if_finite(const double *values, int count) {
  double sum = 0.0;
  for (int index = 0; index < count; index++)
    sum += 0.0 * values[index];
  return sum;
}

static inline bool good_rail(const carom_rail *rail) {
  const double x = rail->q[0] - rail->p[0], y = rail->q[1] - rail->p[1];
  return zero_if_finite(rail->p, 2) + zero_if_finite(rail->line, 3) == 0.0 &&
         carom_is_positive(x * x + y * y) && (uint64_t)rail->side <= 1 &&
         carom_in_unit_interval(rail->mu_cushion) && carom_in_unit_interval(rail->restitution);
}
static inline bool good_circle(const double centre[2], double radius, double least) {
  return zero_if_finite(centre, 2) == 0.0 && radius >= least && radius < INFINITY;
}

static inline bool good_jaw(const carom_jaw *jaw) {
  return good_circle(jaw->centre, jaw->radius, 0.0) && carom_in_unit_interval(jaw->mu_cushion) &&
         carom_in_unit_interval(jaw->restitution);
}
/* Every nose is above the cloth and below the top of a ball. */
static bool good_height(double height, double radius) {
  return height > 0.0 && height < 2.0 * radius;
}

/* Sets the position of an error. */
static carom_status place_fault(int *where, int index, carom_status status) {
  *where = index;
  return status;
}

static bool has_good_numbers(const carom_table *table) {
  return isfinite(table->width) && isfinite(table->length) &&
         carom_is_not_negative(table->ball_radius) && carom_is_not_negative(table->rail_width) &&
         carom_is_not_negative(table->pocket_back);
}
static bool has_good_slope(const carom_table *table) {
  return fabs(table->slope_x) <= 1.0 && fabs(table->slope_y) <= 1.0;
}

carom_status carom_check_table(const carom_table *table, int *where) {
  *where = -1;
  if (table->rails > CAROM_RAILS_MOST)
    return place_fault(where, CAROM_RAILS_MOST, CAROM_ERROR_RAILS);
  if (table->jaws > CAROM_JAWS_MOST)
    return place_fault(where, CAROM_JAWS_MOST, CAROM_ERROR_JAWS);
  if (table->pockets > CAROM_POCKETS_MOST)
    return place_fault(where, CAROM_POCKETS_MOST, CAROM_ERROR_POCKETS);
  if (table->rails < 0 || table->jaws < 0 || table->pockets < 0 || table->rails + table->jaws < 1)
    return CAROM_ERROR_TABLE;
  if (!has_good_numbers(table))
    return CAROM_ERROR_TABLE;
  if (!has_good_slope(table))
    return CAROM_ERROR_SLOPE;
  for (int index = 0; index < table->rails; index++)
    if (!good_rail(&table->rail[index]))
      return place_fault(where, index, CAROM_ERROR_TABLE);
  for (int index = 0; index < table->jaws; index++)
    if (!good_jaw(&table->jaw[index]))
      return place_fault(where, index, CAROM_ERROR_TABLE);
  for (int index = 0; index < table->pockets; index++)
    if (!good_circle(table->pocket[index].centre, table->pocket[index].radius, least_pocket) ||
        !isfinite(table->pocket[index].depth))
      return place_fault(where, index, CAROM_ERROR_TABLE);
  return CAROM_OK;
}

carom_status carom_prepare_table(const carom_table *table, double least, double greatest,
                                 double reference, carom_features *features, int *where) {
  if (features->radius == greatest && features->least == least && features->reference == reference)
    return CAROM_OK;
  /* a ball behind a narrower top could be below it and clear of the nose, and so cross the nose
   * from behind */
  if (table->rail_width > 0.0 && table->rail_width < greatest)
    return place_fault(where, -1, CAROM_ERROR_TABLE);
  const double lowest = carom_lesser(least, reference);
  for (int index = 0; index < table->rails; index++)
    if (!good_height(table->rail[index].height, lowest))
      return place_fault(where, index, CAROM_ERROR_NOSE_HEIGHT);
  for (int index = 0; index < table->jaws; index++)
    if (!good_height(table->jaw[index].height, lowest))
      return place_fault(where, index, CAROM_ERROR_NOSE_HEIGHT);
  carom_features_of(table, greatest, reference, features);
  features->least = least;
  return CAROM_OK;
}

carom_status carom_check_parts(const carom_table *table, double radius, double usual,
                               carom_features *features, carom_part *part) {
  int where;
  carom_status status = carom_check_table(table, &where);
  if (status == CAROM_OK && !(carom_is_positive(radius) && carom_is_positive(usual)))
    status = CAROM_ERROR_RADIUS;
  if (status == CAROM_OK) {
    features->radius = NAN; /* of nothing yet */
    status = carom_prepare_table(table, radius, radius, carom_reference_of(table, usual), features,
                                 &where);
  }
  *part = (carom_part){CAROM_PART_NONE, 0};
  if (carom_surplus_of(status) != CAROM_PART_NONE)
    *part = (carom_part){carom_surplus_of(status), where};
  /* the checks report only an index: they go through rails, jaws and pockets in this order */
  if ((status == CAROM_ERROR_TABLE || status == CAROM_ERROR_NOSE_HEIGHT) && where >= 0) {
    const carom_rail *rail = &table->rail[where];
    const double lowest = carom_lesser(radius, carom_reference_of(table, usual));
    const bool of_rail =
        where < table->rails &&
        (status == CAROM_ERROR_TABLE ? !good_rail(rail) : !good_height(rail->height, lowest));
    const bool of_jaw =
        where < table->jaws &&
        (status == CAROM_ERROR_TABLE ? !good_jaw(&table->jaw[where])
                                     : !good_height(table->jaw[where].height, lowest));
    part->kind = CAROM_PART_POCKET;
    if (of_rail)
      part->kind = CAROM_PART_RAIL;
    else if (of_jaw)
      part->kind = CAROM_PART_JAW;
    part->index = where;
  }
  return status;
}

static double off_line(const double line[3], const double point[2]) {
  return fabs(carom_plane_dot(line, point) + line[2]);
}

carom_status carom_table_check(const carom_table *table, double radius, carom_table_fault *fault) {
  carom_table_fault unused;
  if (fault == NULL)
    fault = &unused;
  *fault = (carom_table_fault){.part = {CAROM_PART_NONE, 0}};
  if (table == NULL)
    return CAROM_ERROR_NULL;
  carom_features features;
  const carom_status status = carom_check_parts(table, radius, radius, &features, &fault->part);
  if (status != CAROM_OK)
    return status;

  /* lines of rails, as they were given */
  for (int index = 0; index < table->rails; index++) {
    const carom_rail *rail = &table->rail[index];
    const double off = carom_greater(off_line(features.line[index], rail->p),
                                     off_line(features.line[index], rail->q));
    if (!(off <= off_line_most)) {
      fault->part = (carom_part){CAROM_PART_RAIL, index};
      for (int axis = 0; axis < 2; axis++)
        fault->place[axis] = 0.5 * (rail->p[axis] + rail->q[axis]);
      return CAROM_ERROR_RAIL_LINE;
    }
  }
  const carom_ball_kind ball = {.radius = radius};
  carom_ground ground;
  carom_ground_of(table, &features, &ball, &ground);
  return carom_check_ring(&ground, fault);
}
