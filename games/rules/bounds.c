/* The bounds of a ball in hand: one rectangle for each leave, and the D of snooker within its box.
 * The planner, the match and their callers read them here. */
#include "carom_match.h"
#include "rules.h"
#include "table/marks.h"

#include <math.h>
#include <string.h>

carom_status carom_hand_bounds(carom_leave leave, const carom_table *table, double radius,
                               carom_bounds *bounds) {
  if (table == NULL || bounds == NULL)
    return CAROM_ERROR_NULL;
  if ((uint32_t)leave > CAROM_LEAVE_BAULK)
    return CAROM_ERROR_ACT;
  if (!(radius >= 0.0) || isinf(radius))
    return CAROM_ERROR_RADIUS;

  /* the table, up to where balls touch its cushions */
  memset(bounds, 0, sizeof *bounds);
  bounds->low[0] = bounds->low[1] = radius;
  bounds->high[0] = table->width - radius;
  bounds->high[1] = table->length - radius;
  const carom_marks marks = carom_marks_of(table->width, table->length);
  if (leave == CAROM_LEAVE_KITCHEN)
    bounds->high[1] = marks.head_spot[1];
  if (leave == CAROM_LEAVE_BAULK)
    bounds->high[1] = marks.baulk_line;

  /* the box around the D */
  if (leave == CAROM_LEAVE_D) {
    memcpy(bounds->centre, marks.d_centre, sizeof bounds->centre);
    bounds->radius = marks.d_radius;
    bounds->low[0] = marks.d_centre[0] - marks.d_radius;
    bounds->low[1] = marks.d_centre[1] - marks.d_radius;
    bounds->high[0] = marks.d_centre[0] + marks.d_radius;
    bounds->high[1] = marks.d_centre[1];
  }
  return CAROM_OK;
}

int carom_is_within(const carom_bounds *bounds, double x, double y) {
  if (bounds == NULL)
    return 0;
  const double place[2] = {x, y};
  for (int axis = 0; axis < 2; axis++)
    if (!(place[axis] >= bounds->low[axis] && place[axis] <= bounds->high[axis]))
      return 0;
  /* an arc that is touched is within, to the width of its line */
  const double reach = bounds->radius + 1e-9;
  return bounds->radius <= 0.0 || carom_square(place, bounds->centre) <= reach * reach;
}
