/* Rows of memory in and out for collocation: one row from end to end (CAROM_LANES_ONE), or in lanes as many as a vector has
 * floats, in one register of rows or two. */
#include "ball_ball/rows.h"
#include "ball_ball/kernels.h"

#ifdef CAROM_LANES_ONE

/* One row, with the bits that a lane of a batch has. */
int PRECISE_KERNEL(carom_call)(const void *in, double s, void *out, float report[OUT_COLUMNS]) {
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

#else

enum { REGISTERS = sizeof(real) / sizeof(float) };
_Static_assert(REGISTERS * sizeof(row_lanes) <= sizeof(row_context), "a context has room for the rows");

typedef float float_lanes __attribute__((vector_size(LANES * sizeof(float))));
typedef float float_lanes_unaligned __attribute__((vector_size(LANES * sizeof(float)), aligned(4), may_alias));

uint32_t PRECISE_KERNEL(carom_rows_in)(const void *in, const uint32_t row[MOST_LANES], double s, row_context *context,
                                       step_inputs to) {
  uint32_t good = 0;
  lanes_unrolled for (int k = 0; k < REGISTERS; k++) {
    const real *rows[LANES];
    lanes_unrolled for (int lane = 0; lane < LANES; lane++) rows[lane] =
        (const real *)in + (size_t)row[k * LANES + lane] * IN_NUMBERS;
    vreal columns[IN_COLUMNS];
    row_lanes *r = (row_lanes *)context + k;
    good |= (uint32_t)v_bits(reduce_rows(rows, (real)s, r, columns)) << (k * LANES);
    lanes_unrolled for (int c = 0; c < IN_COLUMNS; c++) * (float_lanes_unaligned *)(to[c] + k * LANES) =
        __builtin_convertvector(columns[c], float_lanes);
  }
  return good;
}

uint32_t PRECISE_KERNEL(carom_rows_out)(const row_context *context, const step_outputs solution, void *out,
                                        const uint32_t row[MOST_LANES]) {
  uint32_t finite = 0;
  lanes_unrolled for (int k = 0; k < REGISTERS; k++) {
    real *rows[LANES];
    lanes_unrolled for (int lane = 0; lane < LANES; lane++) rows[lane] =
        (real *)out + (size_t)row[k * LANES + lane] * OUT_NUMBERS;
    vreal columns[OUT_COLUMNS];
    lanes_unrolled for (int c = 0; c < OUT_COLUMNS; c++) columns[c] =
        __builtin_convertvector((float_lanes) * (const float_lanes_unaligned *)(solution[c] + k * LANES), vreal);
    const row_lanes *r = (const row_lanes *)context + k;
    const row_impulses q = impulses_of(r, columns);
    finite |= (uint32_t)v_bits(restore_rows(r, &q, rows)) << (k * LANES);
  }
  return finite;
}

#endif
