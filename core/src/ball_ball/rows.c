/* Rows of memory to reduced collisions and back, LANES at once, in the caller's precision.
 *
 * A row is a carom_impact (26 numbers) or a carom_result (12), or their single precision twins.
 * The line of centres is y, and x = (y_y, -y_x); reduced.h has the reduction, the equations and
 * the way back. With g = |v_n0| / (M_a + M_b), impulses in units of |v_n0| / kappa and the signs
 * of the second case worked in (F_a is F if ball a is the pressed one, else 0; F_b likewise; Q_2
 * has the sign of u_z), the velocities change by
 *
 *     ball a:  v  g M_b (F_a - (Q_1, p))     w  5/(2R) g M_b (F_ay - Q_2, -F_ax, Q_1)
 *     ball b:  v  g M_a ((Q_1, p) - F_b)     w  5/(2R) g M_a (-F_by - Q_2, F_bx, Q_1)
 *
 * Products that are summed are not fused: a table turned by 90 degrees, mirrored, or with the
 * balls exchanged gives the same bits.
 */
#include "ball_ball/rows.h"
#include "ball_ball/kernels.h"

/* The data for the way back. */
typedef struct row_lanes {
  vreal a_v[2], a_w[3], b_v[2], b_w[3]; /* motion before */
  vreal M_a, M_b, R, mu, mu_b, e;       /* mu of the pressed ball; both frictions as collocation
                                           takes them */
  vreal y_x, y_y;                       /* line of centres */
  vreal approach, per_total;            /* |v_n0|; 1 / (M_a + M_b) */
  vreal per_kappa, u_x, u_z;            /* u in units of |v_n0| / kappa, u_z >= 0 */
  vmask b_pressed;
} row_lanes;

/* The limits of collocation: beyond them the fallback is needed anyway, or
 * nothing is known of it. */
static const real LEAST_E = (real)0.05;
static const real MOST_MU_B = (real)0.5;
static const real MOST_MU_MU_B = (real)0.25;
static const real LEAST_RATIO = (real)0.05;
static const real MOST_RATIO = 20;
static const real LEAST_MARGIN = (real)0.5;
static const real LEAST_DRIFT = (real)0.25;
static const real MOST_SLIP = (real)1e6;
static const real LEAST_APPROACH = (real)1e-30;
static const real MOST_APPROACH = (real)1e30;

/* Reads rows into *r and lane k of the columns of `out`. Returns the lanes whose row passes
 * every check and approaches, within those limits; the others hold junk. Motion that is not
 * finite leaves a result that is not finite. */
static inline vmask reduce_rows(const real *const row[LANES], real s, row_lanes *r,
                                vreal out[IN_COLUMNS]) {
  vreal x[IN_NUMBERS];
  load_rows(row, x);
  const vreal *a = x, *b = x + 12, zero = v_splat(0);
  const vreal R = a[9], M_a = a[10], M_b = b[10], mu_b = x[24], e = x[25];

  /* the frame, and in it u, d and the approach, times the distance of the centres */
  const vreal r_x = b[0] - a[0], r_y = b[1] - a[1], square = r_x * r_x + r_y * r_y,
              inverse = v_reciprocal_sqrt(square);
  r->y_x = r_x * inverse;
  r->y_y = r_y * inverse;

  /* relative velocity and the sum of spins, by which u and the approach follow */
  const vreal v_x = a[3] - b[3], v_y = a[4] - b[4], w_x = a[6] + b[6], w_y = a[7] + b[7],
              w_z = a[8] + b[8];
  const vreal approach = v_x * r_x + v_y * r_y, u_z = R * (w_x * r_y - w_y * r_x);
  const vreal u_x = (v_x * r_y - v_y * r_x) - (R * w_z) * (square * inverse);
  const vmask b_pressed = r->b_pressed = v_less(u_z, zero);
  r->approach = approach * inverse;

  /* the slip of the pressed ball on the cloth */
  const vreal sR = s * R,
              slip_x = v_select(b_pressed, b[3], a[3]) + sR * v_select(b_pressed, b[7], a[7]);
  const vreal slip_y = v_select(b_pressed, b[4], a[4]) - sR * v_select(b_pressed, b[6], a[6]);
  const vreal d_x = slip_x * r_y - slip_y * r_x, d_y = slip_x * r_x + slip_y * r_y;

  /* masses and units: |v_n0| / kappa */
  const vreal M_p = v_select(b_pressed, M_b, M_a), M_o = v_select(b_pressed, M_a, M_b),
              ratio = M_p * v_reciprocal(M_o);
  const vreal kappa = 1 + ratio, per_unit = kappa * v_reciprocal(approach);
  r->per_total = v_reciprocal(M_a + M_b);
  r->per_kappa = M_o * r->per_total;
  r->u_x = u_x * per_unit;
  r->u_z = v_abs(u_z) * per_unit;

  /* the columns of the kernel; the mirror image where ball b is pressed */
  const vreal side = v_select(b_pressed, -per_unit, per_unit),
              mu = v_select(b_pressed, b[11], a[11]);
  out[IN_U_X] = r->u_x;
  out[IN_U_Z] = r->u_z;
  out[IN_D_X] = d_x * side;
  out[IN_D_Y] = d_y * side;
  out[IN_KAPPA] = kappa;

  /* no ball is pressed to speak of */
  out[IN_MU] = v_select(v_less_equal(r->u_z, v_splat((real)LEAST_PRESS)), zero, mu);
  out[IN_MU_B] = v_max(mu_b, v_splat((real)LEAST_MU_B));
  out[IN_E] = e;

  const vreal fastest =
      v_max(v_max(v_abs(out[IN_U_X]), out[IN_U_Z]), v_max(v_abs(out[IN_D_X]), v_abs(out[IN_D_Y])));

  /* The rate at which the collision drives the slip on the cloth, less that at which its own
   * friction does. It must be well above 0, else friction would choose the direction of the
   * slip, and twice that friction: see is_sensitive(). */
  const vreal drift = s < 0 ? v_splat(1) : 1 - mu_b * ((real)2.5 + (real)1.5 * mu);
  /* all limits at once, without a branch */
  const vmask in_range =
      v_less(v_splat(LEAST_DRIFT), drift) & v_less(3 * mu * mu_b, drift) &
      v_less(v_splat(LEAST_APPROACH), r->approach) & v_less(r->approach, v_splat(MOST_APPROACH)) &
      v_less(fastest, v_splat(MOST_SLIP)) & v_less(v_splat(LEAST_E), e) &
      v_less(mu_b, v_splat(MOST_MU_B)) & v_less(mu * mu_b, v_splat(MOST_MU_MU_B)) &
      v_less(v_splat(LEAST_MARGIN), kappa - mu) & v_less(v_splat(LEAST_RATIO), ratio) &
      v_less(ratio, v_splat(MOST_RATIO));

  /* what the way back from the reduced collision needs */
  lanes_unrolled for (int k = 0; k < 2; k++) {
    r->a_v[k] = a[3 + k];
    r->b_v[k] = b[3 + k];
  }
  lanes_unrolled for (int k = 0; k < 3; k++) {
    r->a_w[k] = a[6 + k];
    r->b_w[k] = b[6 + k];
  }
  r->M_a = M_a;
  r->M_b = M_b;
  r->R = R;
  r->mu = out[IN_MU];
  r->mu_b = out[IN_MU_B];
  r->e = e;
  return are_sound(x) & in_range;
}

/* The integrals of the solution, in units of |v_n0| / kappa. */
typedef struct row_impulses {
  vreal p, Q_1, Q_2, F_x, F_y;
} row_impulses;

static inline row_impulses impulses_of(const row_lanes *r, const vreal in[OUT_COLUMNS]) {
  const vreal mu_b = r->mu_b, mu_mu_b = r->mu * mu_b;
  row_impulses q = {.p = (1 + r->e) + in[OUT_OVERSHOOT],
                    .F_x = -mu_mu_b * in[OUT_I_X],
                    .F_y = -mu_mu_b * in[OUT_I_Y]};
  /* if the balls slip to the end, from the direction of u at the start; if they stick, from u =
   * 0 */
  const vmask sticks = v_less_equal(v_splat(0), in[OUT_STICK]);
  const vreal i_u = v_reciprocal_sqrt(r->u_x * r->u_x + r->u_z * r->u_z + (real)1e-36),
              per_kappa = r->per_kappa;
  q.Q_1 = v_select(sticks, (r->u_x + q.F_x) * (per_kappa * (real)(1 / 3.5)),
                   mu_b * (r->u_x * i_u * q.p + in[OUT_J_C]));
  q.Q_2 = v_select(sticks, (r->u_z + (real)2.5 * q.F_y) * (per_kappa * (real)0.4),
                   mu_b * (r->u_z * i_u * q.p + in[OUT_J_Z]));
  return q;
}

/* Writes the velocities behind the collision. Returns the lanes in which every number is finite. */
static inline vmask restore_rows(const row_lanes *r, const row_impulses *q,
                                 real *const row[LANES]) {
  const vreal zero = v_splat(0), y_x = r->y_x, y_y = r->y_y;
  const vmask b_pressed = r->b_pressed;
  const vreal g = r->approach * r->per_total, on_a = g * r->M_b, on_b = g * r->M_a,
              C = (real)2.5 * v_reciprocal(r->R);

  /* impulses with the signs of the two cases, and what they change */
  const vreal Q_2 = v_select(b_pressed, -q->Q_2, q->Q_2);
  const vreal F_ax = v_select(b_pressed, zero, q->F_x), F_ay = v_select(b_pressed, zero, q->F_y);
  const vreal F_bx = v_select(b_pressed, q->F_x, zero), F_by = v_select(b_pressed, q->F_y, zero);
  const vreal a_x = on_a * (F_ax - q->Q_1), a_y = on_a * (F_ay - q->p),
              b_x = on_b * (q->Q_1 - F_bx), b_y = on_b * (q->p - F_by);
  const vreal C_a = C * on_a, C_b = C * on_b;
  const vreal aw_x = C_a * (F_ay - Q_2), aw_y = -(C_a * F_ax), bw_x = -(C_b * (F_by + Q_2)),
              bw_y = C_b * F_bx;

  /* back in the axes of the table */
  const vreal *a_v = r->a_v, *a_w = r->a_w, *b_v = r->b_v, *b_w = r->b_w;
  const vreal x[OUT_NUMBERS] = {a_v[0] + (a_x * y_y + a_y * y_x),
                                a_v[1] + (a_y * y_y - a_x * y_x),
                                zero,
                                a_w[0] + (aw_x * y_y + aw_y * y_x),
                                a_w[1] + (aw_y * y_y - aw_x * y_x),
                                a_w[2] + C_a * q->Q_1,
                                b_v[0] + (b_x * y_y + b_y * y_x),
                                b_v[1] + (b_y * y_y - b_x * y_x),
                                zero,
                                b_w[0] + (bw_x * y_y + bw_y * y_x),
                                b_w[1] + (bw_y * y_y - bw_x * y_x),
                                b_w[2] + C_b * q->Q_1};

  /* not finite if a term is not, or if two are almost too large: then, too, the row is looked at
   * again */
  const vreal sum =
      ((x[0] + x[1]) + (x[3] + x[4])) + ((x[5] + x[6]) + (x[7] + x[9])) + (x[10] + x[11]);
  lanes_unrolled for (int offset = 0; offset < OUT_NUMBERS; offset += CHUNK)
      v_store_columns(row, offset, x + offset);
  return v_equal(sum * zero, zero);
}

#ifdef CAROM_LANES_ONE

/* One row, with the bits that a lane of a batch has. */
int KERNEL(carom_call)(const void *in, double s, void *out, double report[OUT_COLUMNS]) {
  const real *const input_row[1] = {in};
  real *const output_row[1] = {out};
  row_lanes r;
  real reduced[IN_COLUMNS], solution[OUT_COLUMNS];
  collocated columns[IN_COLUMNS], answer[OUT_COLUMNS];
  if (!reduce_rows(input_row, (real)s, &r, reduced))
    return 0;
  for (int c = 0; c < IN_COLUMNS; c++)
    columns[c] = (collocated)reduced[c];
  const int evaluations = COLLOCATION_KERNEL(carom_collocate)(
      columns, 2.5 * s, carom_tolerances[KERNEL_PRECISION], answer);
  if (evaluations == 0)
    return 0;
  for (int c = 0; c < OUT_COLUMNS; c++)
    solution[c] = (real)answer[c];
  for (int c = 0; c < OUT_COLUMNS && report != NULL; c++)
    report[c] = (double)answer[c];
  const row_impulses q = impulses_of(&r, solution);
  return restore_rows(&r, &q, output_row) ? evaluations : 0;
}

#else

/* Registers of rows that fill one of collocation. */
enum { REGISTERS = sizeof(real) / sizeof(collocated) };
_Static_assert(REGISTERS * sizeof(row_lanes) <= sizeof(row_context),
               "a context has room for the rows");

typedef collocated collocated_lanes __attribute__((vector_size(LANES * sizeof(collocated))));
typedef collocated collocated_lanes_unaligned __attribute__((
    vector_size(LANES * sizeof(collocated)), aligned(sizeof(collocated)), may_alias));

uint32_t KERNEL(carom_rows_in)(const void *in, const uint32_t row[MOST_LANES], double s,
                               row_context *context, step_inputs inputs) {
  uint32_t good = 0;
  lanes_unrolled for (int k = 0; k < REGISTERS; k++) {
    const real *rows[LANES];
    lanes_unrolled for (int lane = 0; lane < LANES; lane++) rows[lane] =
        (const real *)in + (size_t)row[k * LANES + lane] * IN_NUMBERS;
    vreal columns[IN_COLUMNS];
    row_lanes *r = (row_lanes *)context + k;
    good |= (uint32_t)v_bits(reduce_rows(rows, (real)s, r, columns)) << (k * LANES);
    lanes_unrolled for (int c = 0; c < IN_COLUMNS; c++) *
        (collocated_lanes_unaligned *)(LANE_NUMBERS(inputs[c]) + k * LANES) =
        __builtin_convertvector(columns[c], collocated_lanes);
  }
  return good;
}

uint32_t KERNEL(carom_rows_out)(const row_context *context, const step_outputs solution, void *out,
                                const uint32_t row[MOST_LANES]) {
  uint32_t finite = 0;
  lanes_unrolled for (int k = 0; k < REGISTERS; k++) {
    real *rows[LANES];
    lanes_unrolled for (int lane = 0; lane < LANES; lane++) rows[lane] =
        (real *)out + (size_t)row[k * LANES + lane] * OUT_NUMBERS;
    vreal columns[OUT_COLUMNS];
    lanes_unrolled for (int c = 0; c < OUT_COLUMNS; c++) columns[c] = __builtin_convertvector(
        (collocated_lanes) *
            (const collocated_lanes_unaligned *)(LANE_NUMBERS(solution[c]) + k * LANES),
        vreal);
    const row_lanes *r = (const row_lanes *)context + k;
    const row_impulses q = impulses_of(r, columns);
    finite |= (uint32_t)v_bits(restore_rows(r, &q, rows)) << (k * LANES);
  }
  return finite;
}

#endif
