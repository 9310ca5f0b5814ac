/* One row from end to end: reduction, collocation, restoration, with the bits that a lane of a batch has. */
#include "ball_ball/kernels.h"
#include "ball_ball/rows.h"

int PRECISE_KERNEL(carom_single)(const void *in, double s, void *out, float report[OUT_COLUMNS]) {
  const real *const from[1] = {in};
  real *const to[1] = {out};
  row_lanes r;
  real reduced[IN_COLUMNS], solution[OUT_COLUMNS];
  float columns[IN_COLUMNS], own[OUT_COLUMNS];
  float *const answer = report == NULL ? own : report;
  if (!reduce_rows(from, (real)s, &r, reduced))
    return 0;
  for (int c = 0; c < IN_COLUMNS; c++)
    columns[c] = (float)reduced[c];
  const int evaluations = KERNEL(carom_collocate)(columns, (float)(2.5 * s), carom_tolerances[KERNEL_PRECISION], answer);
  if (evaluations == 0)
    return 0;
  for (int c = 0; c < OUT_COLUMNS; c++)
    solution[c] = (real)answer[c];
  const row_impulses q = impulses_of(&r, solution);
  return restore_rows(&r, &q, to) ? evaluations : 0;
}
