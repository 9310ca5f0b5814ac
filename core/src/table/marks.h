/* The marks of a table, from which all parts read their positions: spots and lines by the rules of
 * the sports. The D is scaled from a snooker table of 3.569 by 1.778 m. */
#ifndef CAROM_SRC_TABLE_MARKS_H
#define CAROM_SRC_TABLE_MARKS_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

#include <stdbool.h>

static inline carom_marks carom_marks_of(double width, double length) {
  const double middle = 0.5 * width;
  return (carom_marks){.head_spot = {middle, 0.25 * length},
                       .centre_spot = {middle, 0.5 * length},
                       .foot_spot = {middle, 0.75 * length},
                       .d_centre = {middle, 0.737 / 3.569 * length},
                       .d_radius = 0.292 / 1.778 * width,
                       .baulk_line = 0.2 * length};
}

bool carom_is_in_d(const carom_marks *marks, double x, double y);

#endif
