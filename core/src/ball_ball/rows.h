/* Rows of memory as columns in lanes, and their checks: the checks of arguments.c that depend on a
 * row's own numbers, except for motion that is not finite, which makes the result not finite. */
#ifndef CAROM_SRC_BALL_BALL_ROWS_H
#define CAROM_SRC_BALL_BALL_ROWS_H

#include "ball_ball/lanes.h"

/* Of a carom_impact and a carom_result, or their single precision twins. */
enum { IN_NUMBERS = 26, OUT_NUMBERS = 12 };

/* The columns of the rows; the last ones overlap those before where CHUNK does not divide 26. */
static inline void load_rows(const real *const row[LANES], vreal x[IN_NUMBERS]) {
  lanes_unrolled for (int offset = 0; offset + CHUNK <= IN_NUMBERS; offset += CHUNK)
      v_load_columns(row, offset, x + offset);
  if (IN_NUMBERS % CHUNK != 0) {
    vreal last[CHUNK];
    v_load_columns(row, IN_NUMBERS - CHUNK, last);
    lanes_unrolled for (int k = CHUNK - IN_NUMBERS % CHUNK; k < CHUNK; k++)
        x[IN_NUMBERS - CHUNK + k] = last[k];
  }
}

static inline vmask in_unit_interval(vreal x) {
  return v_less_equal(v_splat(0), x) & v_less_equal(x, v_splat(1));
}
static inline vmask is_positive(vreal x) {
  return v_less(v_splat(0), x) & v_less(x, v_splat((real)INFINITY));
}
/* The tolerances of arguments.c for radii, heights and vertical velocities. */
static inline vmask are_one_radius(vreal a, vreal b) {
  return v_less_equal(v_abs(b - a), (real)1e-9 * a);
}
static inline vmask is_level(vreal z, vreal x, vreal y) {
  return v_less_equal(v_abs(z), (real)1e-9 * (v_abs(x) + v_abs(y)));
}

static inline vmask are_sound(const vreal x[IN_NUMBERS]) {
  const vreal *a = x, *b = x + 12;
  return is_positive(a[9]) & are_one_radius(a[9], b[9]) & is_positive(a[10]) & is_positive(b[10]) &
         in_unit_interval(a[11]) & in_unit_interval(b[11]) & in_unit_interval(x[24]) &
         in_unit_interval(x[25]) & is_level(b[2] - a[2], b[0] - a[0], b[1] - a[1]) &
         is_level(a[5], a[3], a[4]) & is_level(b[5], b[3], b[4]);
}

#endif
