/* A block: LANES pairs of balls, brought from rows in memory into the lanes of the collision frame, and back.
 *
 * The frame is that of src/frame.h, with the same operations in the same order, so in double precision every lane holds the
 * bits of a single call. Rows of memory are those of carom_impact (26 numbers) and carom_result (12 numbers), or their single
 * precision twins.
 *
 * A lane is `good` if its row passes every check of src/arguments.c and approaches. Other lanes hold junk; what becomes of them
 * is the caller's to decide by a single call. Motion that is not finite is not looked for here: it leaves numbers in the result
 * that are not finite, or an approach that is not negative.
 */
#ifndef CAROM_SRC_BALL_BALL_BLOCK_H
#define CAROM_SRC_BALL_BALL_BLOCK_H

#include "ball_ball/columns.h"

/* carom_local of src/frame.h, in lanes, with what the way back needs. */
typedef struct euler_rows {
  vreal v_ix, v_iy, w_ix, w_iy, w_iz;
  vreal v_jx, v_jy, w_jx, w_jy, w_jz;
  vreal M_i, M_j, R;
  vreal mu_i, mu_j, mu_b, e;
  vreal y_x, y_y, y_z; /* line of centres */
  vmask good;
} euler_rows;

static inline euler_rows load_frame(const real *const row[LANES]) {
  vreal x[IN_NUMBERS];
  load_rows(row, x);
  const vreal *r_a = x, *v_a = x + 3, *w_a = x + 6, *r_b = x + 12, *v_b = x + 15, *w_b = x + 18;
  euler_rows b;
  b.R = x[9];
  b.M_i = x[10];
  b.mu_i = x[11];
  b.M_j = x[22];
  b.mu_j = x[23];
  b.mu_b = x[24];
  b.e = x[25];

  const vreal r_x = r_b[0] - r_a[0], r_y = r_b[1] - r_a[1], r_z = r_b[2] - r_a[2];
  const vreal distance = v_sqrt(r_x * r_x + r_y * r_y + r_z * r_z);
  b.y_x = r_x / distance;
  b.y_y = r_y / distance;
  b.y_z = r_z / distance;
  /* x = (y_y, -y_x, 0) and z = (0, 0, 1): the products with 0 are kept, for the sign of zeros. */
  const vreal zero = v_splat(0);
  b.v_ix = v_a[0] * b.y_y + v_a[1] * -b.y_x + v_a[2] * zero;
  b.v_iy = v_a[0] * b.y_x + v_a[1] * b.y_y + v_a[2] * b.y_z;
  b.w_ix = w_a[0] * b.y_y + w_a[1] * -b.y_x + w_a[2] * zero;
  b.w_iy = w_a[0] * b.y_x + w_a[1] * b.y_y + w_a[2] * b.y_z;
  b.w_iz = w_a[0] * zero + w_a[1] * zero + w_a[2];
  b.v_jx = v_b[0] * b.y_y + v_b[1] * -b.y_x + v_b[2] * zero;
  b.v_jy = v_b[0] * b.y_x + v_b[1] * b.y_y + v_b[2] * b.y_z;
  b.w_jx = w_b[0] * b.y_y + w_b[1] * -b.y_x + w_b[2] * zero;
  b.w_jy = w_b[0] * b.y_x + w_b[1] * b.y_y + w_b[2] * b.y_z;
  b.w_jz = w_b[0] * zero + w_b[1] * zero + w_b[2];

  b.good = v_less(b.v_jy - b.v_iy, zero) & are_sound(x);
  return b;
}

/* Writes the results and returns the lanes in which every number is finite. */
static inline vmask store_frame(const euler_rows *b, real *const row[LANES]) {
  const vreal zero = v_splat(0), x_x = b->y_y, x_y = -b->y_x;
  const vreal x[OUT_NUMBERS] = {
      x_x * b->v_ix + b->y_x * b->v_iy,
      x_y * b->v_ix + b->y_y * b->v_iy,
      zero * b->v_ix + b->y_z * b->v_iy,
      x_x * b->w_ix + b->y_x * b->w_iy + zero * b->w_iz,
      x_y * b->w_ix + b->y_y * b->w_iy + zero * b->w_iz,
      zero * b->w_ix + b->y_z * b->w_iy + b->w_iz,
      x_x * b->v_jx + b->y_x * b->v_jy,
      x_y * b->v_jx + b->y_y * b->v_jy,
      zero * b->v_jx + b->y_z * b->v_jy,
      x_x * b->w_jx + b->y_x * b->w_jy + zero * b->w_jz,
      x_y * b->w_jx + b->y_y * b->w_jy + zero * b->w_jz,
      zero * b->w_jx + b->y_z * b->w_jy + b->w_jz,
  };
  vreal sum = zero; /* stays 0 unless a term is infinite or NaN */
  lanes_unrolled for (int k = 0; k < OUT_NUMBERS; k++) sum = v_fma(x[k], zero, sum);
  lanes_unrolled for (int at = 0; at < OUT_NUMBERS; at += CHUNK) v_store_columns(row, at, x + at);
  return v_equal(sum, zero);
}

#endif
