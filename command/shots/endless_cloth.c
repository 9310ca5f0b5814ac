#include "shots/endless_cloth.h"

#include <string.h>

/* the cushions: in radii */
static const double far_away = 1e5;

carom_table endless_cloth(double radius) {
  const double far = far_away * radius;
  const double corner[4][2] = {{-far, -far}, {far, -far}, {far, far}, {-far, far}};
  carom_table table = {.width = 2.0 * far, .length = 2.0 * far, .rails = 4};
  for (int k = 0; k < 4; k++) {
    table.rail[k] = (carom_rail){.height = 1.25 * radius, .side = 1};
    memcpy(table.rail[k].p, corner[k], sizeof corner[k]);
    memcpy(table.rail[k].q, corner[(k + 1) % 4], sizeof corner[k]);
  }
  return table;
}
