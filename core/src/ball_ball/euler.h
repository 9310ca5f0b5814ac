/* Euler's method with N steps of equal normal impulse. See euler.c. */
#ifndef CAROM_SRC_EULER_H
#define CAROM_SRC_EULER_H

#include "ball_ball/frame.h"
#include "platform/arithmetic.h"

#include <stdint.h>

enum { CAROM_EULER_MOST = 16 }; /* times N: more steps are not begun */

/* The progress of a run. */
typedef struct carom_euler_run {
  int64_t steps;           /* taken */
  double step;             /* normal impulse of each, N s */
  double work;             /* of the normal force so far, J */
  double work_compression; /* of that, in compression; NaN if it has not ended */
} carom_euler_run;

/* Advances `c` from the instant of contact to the end of the collision, or through `most` steps if
 * that is earlier; needs v_jy < v_iy. CAROM_OK, or CAROM_ERROR_TOO_SLOW with `c` as it was. */
carom_status carom_euler(carom_local *c, int N, int64_t most, carom_euler_run *run);

#endif
