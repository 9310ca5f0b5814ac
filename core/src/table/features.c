/* The parts of a table that balls up to a radius can meet, prepared once for all shots that
 * share both: lines with unit normals, boxes for rejection, the hull outside of which no
 * centre has a place, and a box in which every centre has one.
 *
 * That box is around the eye, a place to which a ball can be rolled. As a rule this is the middle
 * of the table: it is on the table if it can be seen from a place beside the longest rail, on its
 * played side. The box is free of the boxes of all parts, so a centre in it can be rolled to the
 * eye. Each part limits its half width or its half length: that of which it leaves the larger
 * share. */
#include "platform/promise.h"
#include "table/marks.h"
#include "table/table.h"

#include <math.h>
#include <string.h>

static inline float lesser(float a, float b) {
  return a < b ? a : b;
}
static inline float greater(float a, float b) {
  return a > b ? a : b;
}

/* The box of feature k: around two points, with a margin. The hull grows to hold it. */
static inline void enclose(carom_features *f, int k, const double p[2], const double q[2],
                           double margin, double reach, double hull[4]) {
  const double low_x = carom_lesser(p[0], q[0]) - margin,
               high_x = carom_greater(p[0], q[0]) + margin;
  const double low_y = carom_lesser(p[1], q[1]) - margin,
               high_y = carom_greater(p[1], q[1]) + margin;
  /* a trace more, so that rounding to single precision cannot lose anything */
  const double room = reach + 1e-5;
  f->low_x[k] = (float)(low_x - room);
  f->high_x[k] = (float)(high_x + room);
  f->low_y[k] = (float)(low_y - room);
  f->high_y[k] = (float)(high_y + room);
  hull[0] = carom_lesser(hull[0], low_x);
  hull[1] = carom_greater(hull[1], high_x);
  hull[2] = carom_lesser(hull[2], low_y);
  hull[3] = carom_greater(hull[3], high_y);
}

void carom_rail_line(const carom_rail *rail, double line[3]) {
  const double *p = rail->p, *q = rail->q, e_x = q[0] - p[0], e_y = q[1] - p[1];
  double l_x = rail->line[0], l_y = rail->line[1], l_0 = rail->line[2];
  if (l_x == 0.0 && l_y == 0.0) { /* the left of p -> q is positive */
    l_x = -e_y;
    l_y = e_x;
    l_0 = e_y * p[0] - e_x * p[1];
  }
  const double size = sqrt(l_x * l_x + l_y * l_y), turn = (rail->side == 0 ? -1.0 : 1.0) / size;
  line[0] = l_x * turn;
  line[1] = l_y * turn;
  line[2] = l_0 * turn;
}

static void prepare_rail(const carom_rail *rail, int k, carom_features *f) {
  const double *p = rail->p, *q = rail->q, e_x = q[0] - p[0], e_y = q[1] - p[1],
               size2 = e_x * e_x + e_y * e_y;
  carom_rail_line(rail, f->line[k]);
  f->along[k][0] = e_x / size2;
  f->along[k][1] = e_y / size2;
  f->along[k][2] = -(e_x * p[0] + e_y * p[1]) / size2;
}

/* Finds the box around the eye, in the hull, that meets no box of a part. */
static void clear_around_eye(carom_features *f) {
  const float x = (float)f->eye[0], y = (float)f->eye[1];
  const float low_x = (float)f->hull[0], high_x = (float)f->hull[1], low_y = (float)f->hull[2],
              high_y = (float)f->hull[3], width = high_x - low_x, length = high_y - low_y;
  float room_x = lesser(x - low_x, high_x - x), room_y = lesser(y - low_y, high_y - y);

  /* how far a part is to a side and along the table; it limits the one that is the larger share */
  for (int k = 0; k < f->count; k++) {
    const float across = greater(x - f->high_x[k], f->low_x[k] - x),
                along = greater(y - f->high_y[k], f->low_y[k] - y);
    const bool is_across = across * length > along * width;
    room_x = lesser(room_x, is_across ? across : INFINITY);
    room_y = lesser(room_y, is_across ? INFINITY : along);
  }

  /* a trace less, for rounding: 1e-6 of the places of a table, which may be far from 0 */
  f->clear[0] = (double)room_x - 1e-6 * (fabs(f->hull[0]) + fabs(f->hull[1]));
  f->clear[1] = (double)room_y - 1e-6 * (fabs(f->hull[2]) + fabs(f->hull[3]));
}

/* Finds the eye: the middle of the table if it is seen from the place beside the longest rail;
 * else that place, if it is on the table. */
static void find_eye(const carom_table *table, carom_features *f) {
  const carom_ball_kind ball = {.radius = f->radius};
  double place[2];
  const carom_marks marks = carom_marks_of(table->width, table->length);
  memcpy(f->eye, marks.centre_spot, sizeof f->eye);
  clear_around_eye(f);
  const bool is_found = carom_beside_longest(table, f, f->radius, place);
  carom_ground ground;
  f->has_eye = is_found && carom_is_clear(f, place);
  if (!f->has_eye) {
    carom_ground_of(table, f, &ball, &ground);
    f->has_eye = is_found && carom_is_in_sight(&ground, place);
  }
  if (f->has_eye)
    return;

  if (is_found && !carom_is_cut_off(&ground, place)) {
    f->has_eye = true;
    f->eye[0] = place[0];
    f->eye[1] = place[1];
    clear_around_eye(f);
  } else {
    f->clear[0] = f->clear[1] = -1.0;
  }
}

void carom_features_of(const carom_table *table, double radius, double reference,
                       carom_features *f) {
  /* how many parts of each kind, and an empty hull */
  f->radius = radius;
  f->reference = reference;
  f->rails = (int)table->rails;
  f->jaws = (int)table->jaws;
  f->pockets = (int)table->pockets;
  f->count = f->rails + f->jaws + f->pockets;
  double hull[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  double low = INFINITY, high = 0.0; /* of the noses */

  /* a part that the ball's surface meets reaches as far as its radius, for a ball larger than
   * those of the table farther (nose.c) */
  if (radius != reference)
    radius += reference;

  /* rails, then jaws, then pockets */
  int index = 0;
  for (int k = 0; k < f->rails; k++, index++) {
    prepare_rail(&table->rail[k], k, f);
    low = carom_lesser(low, table->rail[k].height);
    high = carom_greater(high, table->rail[k].height);
    enclose(f, index, table->rail[k].p, table->rail[k].q, 0.0, radius, hull);
  }
  for (int k = 0; k < f->jaws; k++, index++) {
    enclose(f, index, table->jaw[k].centre, table->jaw[k].centre, table->jaw[k].radius, radius,
            hull);
    low = carom_lesser(low, table->jaw[k].height);
    high = carom_greater(high, table->jaw[k].height);
  }
  for (int k = 0; k < f->pockets; k++, index++)
    enclose(f, index, table->pocket[k].centre, table->pocket[k].centre, table->pocket[k].radius,
            0.0, hull);
  CAROM_PROMISE(index == f->count && index <= MOST_FEATURES);
  memcpy(f->hull, hull, sizeof hull);

  /* defaults of the table */
  f->nose_low = low;
  f->width = 0.12;
  if (table->rail_width > 0.0)
    f->width = table->rail_width;
  f->pocket_back = high;
  if (table->pocket_back > 0.0)
    f->pocket_back = table->pocket_back;

  find_eye(table, f);
}
