/* What a ball can meet on a table, prepared once for a shot: lines with unit normals, boxes for rejection, and the hull outside
 * of which no centre has a place. */
#include "shot/sim.h"

#include <math.h>
#include <string.h>

/* The box of feature k grows to hold a point with a margin around it. */
static void enclose(carom_features *f, int k, double x, double y, double margin) {
  /* a millionth more, so that rounding to single precision cannot lose anything */
  const double room = margin + 1e-5;
  f->low_x[k] = fminf(f->low_x[k], (float)(x - room));
  f->high_x[k] = fmaxf(f->high_x[k], (float)(x + room));
  f->low_y[k] = fminf(f->low_y[k], (float)(y - room));
  f->high_y[k] = fmaxf(f->high_y[k], (float)(y + room));
  f->hull[0] = fmin(f->hull[0], x - margin);
  f->hull[1] = fmax(f->hull[1], x + margin);
  f->hull[2] = fmin(f->hull[2], y - margin);
  f->hull[3] = fmax(f->hull[3], y + margin);
}

static void prepare_rail(const carom_rail *rail, int k, carom_features *f) {
  const double *p = rail->p, *q = rail->q, e_x = q[0] - p[0], e_y = q[1] - p[1], size2 = e_x * e_x + e_y * e_y;
  double l_x = rail->line[0], l_y = rail->line[1], l_0 = rail->line[2];
  if (l_x == 0.0 && l_y == 0.0) { /* the left of p -> q is positive */
    l_x = -e_y;
    l_y = e_x;
    l_0 = e_y * p[0] - e_x * p[1];
  }
  const double size = sqrt(l_x * l_x + l_y * l_y), turn = (rail->side == 0 ? -1.0 : 1.0) / size;
  f->line[k][0] = l_x * turn;
  f->line[k][1] = l_y * turn;
  f->line[k][2] = l_0 * turn;
  f->along[k][0] = e_x / size2;
  f->along[k][1] = e_y / size2;
  f->along[k][2] = -(e_x * p[0] + e_y * p[1]) / size2;
}

void carom_features_of(const carom_table *table, double radius, carom_features *f) {
  f->rails = (int)table->rails;
  f->jaws = (int)table->jaws;
  f->pockets = (int)table->pockets;
  f->count = f->rails + f->jaws + f->pockets;
  f->hull[0] = f->hull[2] = INFINITY;
  f->hull[1] = f->hull[3] = -INFINITY;
  for (int k = 0; k < MOST_FEATURES; k++) {
    f->low_x[k] = f->low_y[k] = INFINITY;
    f->high_x[k] = f->high_y[k] = -INFINITY;
  }
  int at = 0;
  for (int k = 0; k < f->rails; k++, at++) {
    prepare_rail(&table->rail[k], k, f);
    enclose(f, at, table->rail[k].p[0], table->rail[k].p[1], 0.0);
    enclose(f, at, table->rail[k].q[0], table->rail[k].q[1], 0.0);
  }
  for (int k = 0; k < f->jaws; k++, at++)
    enclose(f, at, table->jaw[k].centre[0], table->jaw[k].centre[1], table->jaw[k].radius);
  for (int k = 0; k < f->pockets; k++, at++)
    enclose(f, at, table->pocket[k].centre[0], table->pocket[k].centre[1], table->pocket[k].radius);
  /* what is met by a ball's surface reaches as far as its radius */
  for (int k = 0; k < f->rails + f->jaws; k++) {
    f->low_x[k] -= (float)radius;
    f->high_x[k] += (float)radius;
    f->low_y[k] -= (float)radius;
    f->high_y[k] += (float)radius;
  }
}
