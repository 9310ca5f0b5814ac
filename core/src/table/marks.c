/* The marks of a table for callers, and what is in the D. */
#include "table/marks.h"

#include <stddef.h>

carom_status carom_table_marks(const carom_table *table, carom_marks *marks) {
  if (table == NULL || marks == NULL)
    return CAROM_ERROR_NULL;
  *marks = carom_marks_of(table->width, table->length);
  return CAROM_OK;
}

bool carom_is_in_d(const carom_marks *marks, double x, double y) {
  x -= marks->d_centre[0];
  y -= marks->d_centre[1];
  return y <= 0.0 && x * x + y * y <= marks->d_radius * marks->d_radius;
}
