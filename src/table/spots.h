/* The D of a snooker table, from which a cue ball in hand is played: a half circle behind the baulk
 * line, towards y = 0. racks.c has it, and the spots. */
#ifndef CAROM_SRC_TABLE_SPOTS_H
#define CAROM_SRC_TABLE_SPOTS_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

#include <stdbool.h>

typedef struct carom_d {
  double x, y, radius; /* of the middle of the baulk line, m */
} carom_d;

carom_d carom_d_of(double width, double length);
bool carom_is_in_d(const carom_table *table, double x, double y);

#endif
