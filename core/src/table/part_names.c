/* Where rails and pockets are, in the words of a player at the head of the table, and which of them
 * are beside each other. */
#include "table/table.h"

#include <math.h>
#include <stddef.h>

/* rails shorter than this part of the longest one are cuts of pockets */
static const double cut_most = 0.2;
/* A rail whose end is so near to the centre of a pocket is beside it: radii of the pocket. A corner
 * pocket of a pool table has its rails' ends at 1.2 to 1.6 radii; 6 radii would be 0.4 m. */
static const double beside_most = 3.0;

static double square_of_length(const carom_rail *r) {
  const double x = r->q[0] - r->p[0], y = r->q[1] - r->p[1];
  return x * x + y * y;
}

bool carom_is_cut(const carom_table *t, int rail) {
  double longest = 0.0;
  for (int k = 0; k < t->rails; k++)
    longest = fmax(longest, square_of_length(&t->rail[k]));
  return square_of_length(&t->rail[rail]) <= cut_most * cut_most * longest;
}

bool carom_is_near_pocket(const carom_table *t, int pocket, const double place[2]) {
  const carom_pocket *hole = &t->pocket[pocket];
  const double x = place[0] - hole->centre[0], y = place[1] - hole->centre[1];
  const double reach = beside_most * hole->radius;
  return x * x + y * y < reach * reach;
}

int carom_is_beside(const carom_table *t, int rail, int pocket) {
  if (t == NULL || rail < 0 || rail >= t->rails || rail >= CAROM_RAILS_MOST || pocket < 0 ||
      pocket >= t->pockets || pocket >= CAROM_POCKETS_MOST)
    return 0;
  return carom_is_near_pocket(t, pocket, t->rail[rail].p) ||
         carom_is_near_pocket(t, pocket, t->rail[rail].q);
}

/* The name of the side of the rectangle, from 0 to width and length, on which a rail lies, or
 * NULL. */
static const char *side_of(const carom_table *t, int rail) {
  static const char *const names[2][2] = {{"left", "right"}, {"head", "foot"}};
  const carom_rail *r = &t->rail[rail];
  const double same = 1e-6 * (t->width + t->length), far[2] = {t->width, t->length};
  for (int c = 0; c < 2; c++)
    for (int side = 0; side < 2; side++)
      if (fabs(r->p[c] - side * far[c]) < same && fabs(r->q[c] - side * far[c]) < same)
        return names[c][side];
  return NULL;
}

/* A table of too many parts, which every call refuses, is none. */
static bool is_rectangle(const carom_table *t) {
  if (t->rails > CAROM_RAILS_MOST || t->pockets > CAROM_POCKETS_MOST)
    return false;
  for (int k = 0; k < t->rails; k++)
    if (!carom_is_cut(t, k) && side_of(t, k) == NULL)
      return false;
  return true;
}

const char *carom_rail_name(const carom_table *t, int rail) {
  if (t == NULL || rail < 0 || rail >= t->rails || !is_rectangle(t) || carom_is_cut(t, rail))
    return NULL;
  return side_of(t, rail);
}

const char *carom_pocket_name(const carom_table *t, int pocket) {
  static const char *const names[2][3] = {{"head-left", "side-left", "foot-left"},
                                          {"head-right", "side-right", "foot-right"}};
  if (t == NULL || pocket < 0 || pocket >= t->pockets || !is_rectangle(t))
    return NULL;
  const double *centre = t->pocket[pocket].centre, along = centre[1] / t->length;
  const int side = centre[0] > 0.5 * t->width, third = (along >= 0.3) + (along >= 0.7);
  return names[side][third];
}
