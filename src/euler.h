/* Euler's method with N steps of equal normal impulse. See euler.c. */
#ifndef CAROM_SRC_EULER_H
#define CAROM_SRC_EULER_H

#include "frame.h"

#include <stdint.h>

/* Advances `c` from the instant of contact to the end of the collision; needs v_jy < v_iy. `*steps` becomes the number of
 * steps taken. CAROM_OK, or CAROM_ERROR_TOO_SLOW with `c` in an undefined state. */
carom_status carom_euler(carom_local *c, int N, int64_t *steps);

#endif
