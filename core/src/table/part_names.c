/* Where rails and pockets are, in the names of a player at the head of the table, and which of them
 * are next to each other. */
#include "table/table.h"

#include <math.h>
#include <stddef.h>

/* rails shorter than this fraction of the longest one are cuts of pockets */
static const double cut_most = 0.2;
/* A rail whose end is so near to the centre of a pocket is next to it: radii of the pocket. A
 * corner pocket of a pool table has its rails' ends at 1.2 to 1.6 radii; 6 radii would be 0.4 m. */
static const double beside_most = 3.0;

static double square_of_length(const carom_rail *rail) {
  const double x = rail->q[0] - rail->p[0], y = rail->q[1] - rail->p[1];
  return x * x + y * y;
}

bool carom_is_cut(const carom_table *table, int rail) {
  double longest = 0.0;
  for (int index = 0; index < table->rails; index++)
    longest = fmax(longest, square_of_length(&table->rail[index]));
  return square_of_length(&table->rail[rail]) <= cut_most * cut_most * longest;
}

bool carom_is_near_pocket(const carom_table *table, int pocket, const double place[2]) {
  const carom_pocket *hole = &table->pocket[pocket];
  const double x = place[0] - hole->centre[0], y = place[1] - hole->centre[1];
  const double reach = beside_most * hole->radius;
  return x * x + y * y < reach * reach;
}

int carom_is_beside(const carom_table *table, int rail, int pocket) {
  if (table == NULL || rail < 0 || rail >= table->rails || rail >= CAROM_RAILS_MOST || pocket < 0 ||
      pocket >= table->pockets || pocket >= CAROM_POCKETS_MOST)
    return 0;
  return carom_is_near_pocket(table, pocket, table->rail[rail].p) ||
         carom_is_near_pocket(table, pocket, table->rail[rail].q);
}

/* The name of the side of the rectangle, from 0 to width and length, on which a rail is, or
 * NULL. */
static const char *side_of(const carom_table *table, int rail) {
  static const char *const names[2][2] = {{"left", "right"}, {"head", "foot"}};
  const carom_rail *line = &table->rail[rail];
  const double same = 1e-6 * (table->width + table->length), far[2] = {table->width, table->length};
  for (int axis = 0; axis < 2; axis++)
    for (int side = 0; side < 2; side++)
      if (fabs(line->p[axis] - side * far[axis]) < same &&
          fabs(line->q[axis] - side * far[axis]) < same)
        return names[axis][side];
  return NULL;
}

/* A table of too many parts, which every call rejects, is none. */
static bool is_rectangle(const carom_table *table) {
  if (table->rails > CAROM_RAILS_MOST || table->pockets > CAROM_POCKETS_MOST)
    return false;
  for (int index = 0; index < table->rails; index++)
    if (!carom_is_cut(table, index) && side_of(table, index) == NULL)
      return false;
  return true;
}

const char *carom_rail_name(const carom_table *table, int rail) {
  if (table == NULL || rail < 0 || rail >= table->rails || !is_rectangle(table) ||
      carom_is_cut(table, rail))
    return NULL;
  return side_of(table, rail);
}

const char *carom_pocket_name(const carom_table *table, int pocket) {
  static const char *const names[2][3] = {{"head-left", "side-left", "foot-left"},
                                          {"head-right", "side-right", "foot-right"}};
  if (table == NULL || pocket < 0 || pocket >= table->pockets || !is_rectangle(table))
    return NULL;
  const double *centre = table->pocket[pocket].centre, along = centre[1] / table->length;
  const int side = centre[0] > 0.5 * table->width, third = (along >= 0.3) + (along >= 0.7);
  return names[side][third];
}
