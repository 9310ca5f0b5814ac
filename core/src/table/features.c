/* The parts of a table that balls up to a radius can meet, prepared once for all shots that
 * share both: lines with unit normals, boxes for rejection, the hull outside of which no
 * centre has a position, and a box in which every centre has one.
 *
 * That box is around the eye, a position to which a ball can be rolled. As a rule this is the
 * middle of the table: it is on the table if it can be seen from a position next to the longest
 * rail, on its played side. The box is free of the boxes of all parts, so a centre in it can be
 * rolled to the eye. Each part limits its half width or its half length, whichever keeps the larger
 * fraction. */
#include "platform/promise.h"
#include "table/marks.h"
#include "table/table.h"

#include <math.h>
#include <string.h>

static const double single_rounding = 1e-5; /* m: for positions up to 100 m in single precision */
static const double single_part = 1e-6;     /* the same, of a position */
static const double usual_width = 0.12;     /* m: of the top of a rail */

static inline float lesser(float a, float b) {
  return a < b ? a : b;
}
static inline float greater(float a, float b) {
  return a > b ? a : b;
}

/* The box of a feature: around two points, with a margin. The hull grows to hold it. */
static inline void enclose(carom_features *features, int index, const double p[2],
                           const double q[2], double margin, double reach, double hull[4]) {
  const double low_x = carom_lesser(p[0], q[0]) - margin,
               high_x = carom_greater(p[0], q[0]) + margin;
  const double low_y = carom_lesser(p[1], q[1]) - margin,
               high_y = carom_greater(p[1], q[1]) + margin;
  /* a trace more, so that rounding to single precision cannot lose anything */
  const double room = reach + single_rounding;
  features->low_x[index] = (float)(low_x - room);
  features->high_x[index] = (float)(high_x + room);
  features->low_y[index] = (float)(low_y - room);
  features->high_y[index] = (float)(high_y + room);
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

static void prepare_rail(const carom_rail *rail, int index, carom_features *features) {
  const double *p = rail->p, *q = rail->q, e_x = q[0] - p[0], e_y = q[1] - p[1],
               size2 = e_x * e_x + e_y * e_y;
  carom_rail_line(rail, features->line[index]);
  features->along[index][0] = e_x / size2;
  features->along[index][1] = e_y / size2;
  features->along[index][2] = -(e_x * p[0] + e_y * p[1]) / size2;
}

/* Finds the box around the eye, in the hull, that meets no box of a part. */
static void clear_around_eye(carom_features *features) {
  const float x = (float)features->eye[0], y = (float)features->eye[1];
  const float low_x = (float)features->hull[0], high_x = (float)features->hull[1],
              low_y = (float)features->hull[2], high_y = (float)features->hull[3],
              width = high_x - low_x, length = high_y - low_y;
  float room_x = lesser(x - low_x, high_x - x), room_y = lesser(y - low_y, high_y - y);

  /* how far a part is to a side and along the table; it limits the one that is the larger share */
  for (int index = 0; index < features->count; index++) {
    const float across = greater(x - features->high_x[index], features->low_x[index] - x),
                along = greater(y - features->high_y[index], features->low_y[index] - y);
    const bool is_across = across * length > along * width;
    room_x = lesser(room_x, is_across ? across : INFINITY);
    room_y = lesser(room_y, is_across ? INFINITY : along);
  }

  /* a trace less, for rounding of the positions of a table, which may be far from 0 */
  features->clear[0] =
      (double)room_x - single_part * (fabs(features->hull[0]) + fabs(features->hull[1]));
  features->clear[1] =
      (double)room_y - single_part * (fabs(features->hull[2]) + fabs(features->hull[3]));
}

/* Finds the eye: the middle of the table if it is seen from the position next to the longest rail;
 * else that position, if it is on the table. */
static void find_eye(const carom_table *table, carom_features *features) {
  const carom_ball_kind ball = {.radius = features->radius};
  double place[2];
  const carom_marks marks = carom_marks_of(table->width, table->length);
  memcpy(features->eye, marks.centre_spot, sizeof features->eye);
  clear_around_eye(features);
  const bool is_found = carom_beside_longest(table, features, features->radius, place);
  carom_ground ground;
  features->has_eye = is_found && carom_is_clear(features, place);
  if (!features->has_eye) {
    carom_ground_of(table, features, &ball, &ground);
    features->has_eye = is_found && carom_is_in_sight(&ground, place);
  }
  if (features->has_eye)
    return;

  if (is_found && !carom_is_cut_off(&ground, place)) {
    features->has_eye = true;
    features->eye[0] = place[0];
    features->eye[1] = place[1];
    clear_around_eye(features);
  } else {
    features->clear[0] = features->clear[1] = -1.0;
  }
}

void carom_features_of(const carom_table *table, double radius, double reference,
                       carom_features *features) {
  /* how many parts of each kind, and an empty hull */
  features->radius = radius;
  features->reference = reference;
  features->rails = (int)table->rails;
  features->jaws = (int)table->jaws;
  features->pockets = (int)table->pockets;
  features->count = features->rails + features->jaws + features->pockets;
  double hull[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  double low = INFINITY, high = 0.0; /* of the noses */

  /* a part that the ball's surface meets reaches as far as its radius, for a ball larger than
   * those of the table farther (nose.c) */
  if (radius != reference)
    radius += reference;

  /* rails, then jaws, then pockets */
  int index = 0;
  for (int part = 0; part < features->rails; part++, index++) {
    prepare_rail(&table->rail[part], part, features);
    low = carom_lesser(low, table->rail[part].height);
    high = carom_greater(high, table->rail[part].height);
    enclose(features, index, table->rail[part].p, table->rail[part].q, 0.0, radius, hull);
  }
  for (int part = 0; part < features->jaws; part++, index++) {
    enclose(features, index, table->jaw[part].centre, table->jaw[part].centre,
            table->jaw[part].radius, radius, hull);
    low = carom_lesser(low, table->jaw[part].height);
    high = carom_greater(high, table->jaw[part].height);
  }
  for (int part = 0; part < features->pockets; part++, index++)
    enclose(features, index, table->pocket[part].centre, table->pocket[part].centre,
            table->pocket[part].radius, 0.0, hull);
  CAROM_PROMISE(index == features->count && index <= MOST_FEATURES);
  memcpy(features->hull, hull, sizeof hull);

  /* defaults of the table */
  features->nose_low = low;
  features->width = usual_width;
  if (table->rail_width > 0.0)
    features->width = table->rail_width;
  features->pocket_back = high;
  if (table->pocket_back > 0.0)
    features->pocket_back = table->pocket_back;

  find_eye(table, features);
}
