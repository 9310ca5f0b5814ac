/* The parts of a table, each by itself, by the conditions of the comments in carom_shot.h. */
#include "table/table.h"

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
static carom_status at(int *where, int index, carom_status status) {
  *where = index;
  return status;
}

carom_status carom_check_table(const carom_table *t, int *where) {
  *where = -1;
  if (t->rails < 0 || t->rails > CAROM_RAILS_MOST || t->jaws < 0 || t->jaws > CAROM_JAWS_MOST ||
      t->pockets < 0 || t->pockets > CAROM_POCKETS_MOST || t->rails + t->jaws < 1)
    return CAROM_ERROR_TABLE;
  if (!carom_is_not_negative(t->ball_radius) || !carom_is_not_negative(t->rail_width) ||
      !carom_is_not_negative(t->pocket_back))
    return CAROM_ERROR_TABLE;
  for (int k = 0; k < t->rails; k++)
    if (!good_rail(&t->rail[k]))
      return at(where, k, CAROM_ERROR_TABLE);
  for (int k = 0; k < t->jaws; k++)
    if (!good_jaw(&t->jaw[k]))
      return at(where, k, CAROM_ERROR_TABLE);
  for (int k = 0; k < t->pockets; k++)
    if (!good_circle(t->pocket[k].centre, t->pocket[k].radius, 1e-9) ||
        !isfinite(t->pocket[k].depth))
      return at(where, k, CAROM_ERROR_TABLE);
  return CAROM_OK;
}

carom_status carom_prepare_table(const carom_table *t, double least, double greatest,
                                 double reference, carom_features *features, int *where) {
  if (features->radius == greatest && features->least == least && features->reference == reference)
    return CAROM_OK;
  /* a ball that is behind a narrower top could be below it and clear of the nose, and so come
   * over the nose from behind */
  if (t->rail_width > 0.0 && t->rail_width < greatest)
    return at(where, -1, CAROM_ERROR_TABLE);
  const double lowest = carom_lesser(least, reference);
  for (int k = 0; k < t->rails; k++)
    if (!good_height(t->rail[k].height, lowest))
      return at(where, k, CAROM_ERROR_NOSE_HEIGHT);
  for (int k = 0; k < t->jaws; k++)
    if (!good_height(t->jaw[k].height, lowest))
      return at(where, k, CAROM_ERROR_NOSE_HEIGHT);
  carom_features_of(t, greatest, reference, features);
  features->least = least;
  return CAROM_OK;
}

carom_status carom_check_parts(const carom_table *table, double radius, double usual,
                               carom_features *features, carom_part *part) {
  int where;
  carom_status bad = carom_check_table(table, &where);
  if (bad == CAROM_OK && !(carom_is_positive(radius) && carom_is_positive(usual)))
    bad = CAROM_ERROR_RADIUS;
  if (bad == CAROM_OK) {
    features->radius = NAN; /* of nothing yet */
    bad = carom_prepare_table(table, radius, radius, carom_reference_of(table, usual), features,
                              &where);
  }
  *part = (carom_part){CAROM_PART_NONE, 0};
  /* the checks tell an index alone: they go through rails, jaws and pockets in this order */
  if ((bad == CAROM_ERROR_TABLE || bad == CAROM_ERROR_NOSE_HEIGHT) && where >= 0) {
    const carom_rail *rail = &table->rail[where];
    const double lowest = carom_lesser(radius, carom_reference_of(table, usual));
    const bool of_rail =
        where < table->rails &&
        (bad == CAROM_ERROR_TABLE ? !good_rail(rail) : !good_height(rail->height, lowest));
    const bool of_jaw = where < table->jaws &&
                        (bad == CAROM_ERROR_TABLE ? !good_jaw(&table->jaw[where])
                                                  : !good_height(table->jaw[where].height, lowest));
    *part = (carom_part){of_rail  ? CAROM_PART_RAIL
                         : of_jaw ? CAROM_PART_JAW
                                  : CAROM_PART_POCKET,
                         where};
  }
  return bad;
}
