/* Checks of a table: its parts, each by itself, by the conditions of the comments in
 * carom_shot.h; and the table of a caller, with its ring (ring.c). */
#include "table/table.h"

#include <math.h>

/* 0 where all are finite, else NaN. The parts of a table are checked for each shot that is
 * played alone, so without a branch for each number. */
static inline double zero_if_finite(const double *x, int n) {
  double sum = 0.0;
  for (int k = 0; k < n; k++)
    sum += 0.0 * x[k];
  return sum;
}

static inline bool good_rail(const carom_rail *r) {
  const double x = r->q[0] - r->p[0], y = r->q[1] - r->p[1];
  return zero_if_finite(r->p, 2) + zero_if_finite(r->line, 3) == 0.0 &&
         carom_is_positive(x * x + y * y) && (uint64_t)r->side <= 1 &&
         carom_in_unit_interval(r->mu_cushion) && carom_in_unit_interval(r->restitution);
}
static inline bool good_circle(const double centre[2], double radius, double least) {
  return zero_if_finite(centre, 2) == 0.0 && radius >= least && radius < INFINITY;
}

static inline bool good_jaw(const carom_jaw *j) {
  return good_circle(j->centre, j->radius, 0.0) && carom_in_unit_interval(j->mu_cushion) &&
         carom_in_unit_interval(j->restitution);
}
/* Every nose is above the cloth and below the top of a ball. */
static bool good_height(double height, double R) {
  return height > 0.0 && height < 2.0 * R;
}

/* Sets the place of an error. */
static carom_status place_fault(int *where, int index, carom_status status) {
  *where = index;
  return status;
}

static bool has_good_numbers(const carom_table *t) {
  return isfinite(t->width) && isfinite(t->length) && carom_is_not_negative(t->ball_radius) &&
         carom_is_not_negative(t->rail_width) && carom_is_not_negative(t->pocket_back);
}
static bool has_good_slope(const carom_table *t) {
  return fabs(t->slope_x) <= 1.0 && fabs(t->slope_y) <= 1.0;
}

carom_status carom_check_table(const carom_table *t, int *where) {
  *where = -1;
  if (t->rails > CAROM_RAILS_MOST)
    return place_fault(where, CAROM_RAILS_MOST, CAROM_ERROR_RAILS);
  if (t->jaws > CAROM_JAWS_MOST)
    return place_fault(where, CAROM_JAWS_MOST, CAROM_ERROR_JAWS);
  if (t->pockets > CAROM_POCKETS_MOST)
    return place_fault(where, CAROM_POCKETS_MOST, CAROM_ERROR_POCKETS);
  if (t->rails < 0 || t->jaws < 0 || t->pockets < 0 || t->rails + t->jaws < 1)
    return CAROM_ERROR_TABLE;
  if (!has_good_numbers(t))
    return CAROM_ERROR_TABLE;
  if (!has_good_slope(t))
    return CAROM_ERROR_SLOPE;
  for (int k = 0; k < t->rails; k++)
    if (!good_rail(&t->rail[k]))
      return place_fault(where, k, CAROM_ERROR_TABLE);
  for (int k = 0; k < t->jaws; k++)
    if (!good_jaw(&t->jaw[k]))
      return place_fault(where, k, CAROM_ERROR_TABLE);
  for (int k = 0; k < t->pockets; k++)
    if (!good_circle(t->pocket[k].centre, t->pocket[k].radius, 1e-9) ||
        !isfinite(t->pocket[k].depth))
      return place_fault(where, k, CAROM_ERROR_TABLE);
  return CAROM_OK;
}

carom_status carom_prepare_table(const carom_table *t, double least, double greatest,
                                 double reference, carom_features *features, int *where) {
  if (features->radius == greatest && features->least == least && features->reference == reference)
    return CAROM_OK;
  /* a ball that is behind a narrower top could be below it and clear of the nose, and so come
   * over the nose from behind */
  if (t->rail_width > 0.0 && t->rail_width < greatest)
    return place_fault(where, -1, CAROM_ERROR_TABLE);
  const double lowest = carom_lesser(least, reference);
  for (int k = 0; k < t->rails; k++)
    if (!good_height(t->rail[k].height, lowest))
      return place_fault(where, k, CAROM_ERROR_NOSE_HEIGHT);
  for (int k = 0; k < t->jaws; k++)
    if (!good_height(t->jaw[k].height, lowest))
      return place_fault(where, k, CAROM_ERROR_NOSE_HEIGHT);
  carom_features_of(t, greatest, reference, features);
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
  /* the checks tell an index alone: they go through rails, jaws and pockets in this order */
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

static double off_line(const double line[3], const double r[2]) {
  return fabs(carom_plane_dot(line, r) + line[2]);
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
  for (int k = 0; k < table->rails; k++) {
    const carom_rail *rail = &table->rail[k];
    const double off =
        carom_greater(off_line(features.line[k], rail->p), off_line(features.line[k], rail->q));
    if (!(off <= 1e-6)) {
      fault->part = (carom_part){CAROM_PART_RAIL, k};
      for (int c = 0; c < 2; c++)
        fault->place[c] = 0.5 * (rail->p[c] + rail->q[c]);
      return CAROM_ERROR_RAIL_LINE;
    }
  }
  const carom_ball_kind ball = {.radius = radius};
  carom_ground ground;
  carom_ground_of(table, &features, &ball, &ground);
  return carom_check_ring(&ground, fault);
}
