/* Euler's method in lanes: LANES collisions at once, each with the bits of src/ball_ball/euler.c in double precision.
 *
 * Every lane does src/ball_ball/euler.c's step, its branches turned into selections, until the last lane has ended; a lane's
 * state is put aside at the step where it ends, so what it goes on to compute is junk that nobody reads. The bound on the steps
 * is each lane's own: a lane that needs more is left to a single call, which says so.
 *
 * Single precision takes the same steps in float; what float cannot resolve is left to a single call in double.
 *
 * The time goes into square roots and quotients that wait for each other, so several vectors are stepped together. Replacing
 * the quotients by products with corrected reciprocals was slower (docs/study/tried.md).
 */
#include "ball_ball/arguments.h"
#include "ball_ball/euler.h"
#include "ball_ball/kernels.h"
#include "ball_ball/rows.h"

/* carom_local of frame.h, in lanes, with the line of centres and the lanes that are `good`: their rows pass every check of
 * arguments.c and approach. Others hold junk, and the caller solves them by single calls. Motion that is not finite leaves
 * numbers in the result that are not finite. */
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

#ifdef CAROM_LANES_F32
static const real no_slip = 1e-16f;
#else
static const real no_slip = 1e-16;
#endif

enum { GROUPS = 2 }; /* taken together, so that one's long divisions hide behind the other's */

typedef struct euler_lanes {
  vreal DP, k, C_i, C_j, sR; /* k = -mu_b DP */
  vreal u_x, u_z, d_x, d_y, b_x, b_y, v_n;
  vreal W, W_f;
  vmask compressing, running;
  euler_rows now, end; /* the state, and that of the lanes that have ended */
  vreal bound;
} euler_lanes;

static inline void update_slips(euler_lanes *l) {
  const euler_rows *c = &l->now;
  l->u_x = c->v_ix - c->v_jx - c->R * (c->w_iz + c->w_jz);
  l->u_z = c->R * (c->w_ix + c->w_jx);
  l->d_x = c->v_ix + l->sR * c->w_iy;
  l->d_y = c->v_iy - l->sR * c->w_ix;
  l->b_x = c->v_jx + l->sR * c->w_jy;
  l->b_y = c->v_jy - l->sR * c->w_jx;
}

static inline void start(euler_lanes *l, const carom_options *opt) {
  euler_rows *c = &l->now;
  const real s = opt->slip == CAROM_SLIP_POOLTOOL ? 1 : -1, N = (real)carom_steps(opt);
  const vreal one = v_splat(1), two = v_splat(2), half = v_splat((real)0.5), zero = v_splat(0);
  const vreal M = v_select(v_equal(c->M_i, c->M_j), c->M_i, two / (one / c->M_i + one / c->M_j));
  l->sR = s * c->R;
  l->C_i = (real)5 / (two * c->M_i * c->R);
  l->C_j = (real)5 / (two * c->M_j * c->R);
  l->v_n = c->v_jy - c->v_iy;
  update_slips(l);
  l->DP = half * (one + c->e) * M * v_abs(l->v_n) / N;
  l->k = -c->mu_b * l->DP;
  l->W = zero;
  l->W_f = v_splat((real)INFINITY);
  const vreal loss = v_max(c->mu_i * c->mu_b * M / c->M_i, c->mu_j * c->mu_b * M / c->M_j);
  l->bound = two * (two * N / (two - loss) + two);
  c->good &= v_less_equal(two, (real)CAROM_EULER_MOST * (two - loss));
  l->running = l->compressing = c->good;
  l->end = *c;
}

/* One step of src/ball_ball/euler.c in every lane; n steps have been taken with it. */
static inline void euler_step(euler_lanes *l, real n) {
  euler_rows *c = &l->now;
  const vreal zero = v_splat(0), half = v_splat((real)0.5);
  const vreal u = v_sqrt(l->u_x * l->u_x + l->u_z * l->u_z);
  const vmask slipping = v_less_equal(v_splat(no_slip), u);
  const vmask lifting = slipping & v_less_equal(v_splat(no_slip), v_abs(l->u_z));
  const vreal DP1 = v_select(slipping, l->k * l->u_x / u, zero);
  const vreal DP2 = v_select(lifting, l->k * l->u_z / u, zero);
  const vmask j_pressed = v_less(zero, DP2);

  const vreal t_x = v_select(j_pressed, l->b_x, l->d_x), t_y = v_select(j_pressed, l->b_y, l->d_y);
  const vreal t = v_sqrt(t_x * t_x + t_y * t_y);
  const vreal mu = v_select(j_pressed, -c->mu_j, c->mu_i);
  const vmask rubbing = lifting & v_not(v_equal(t, zero));
  const vreal f_x = mu * (t_x / t) * DP2, f_y = mu * (t_y / t) * DP2;
  const vmask rubs_i = rubbing & v_not(j_pressed), rubs_j = rubbing & j_pressed;
  const vreal DP_ix = v_select(rubs_i, f_x, zero), DP_iy = v_select(rubs_i, f_y, zero);
  const vreal DP_jx = v_select(rubs_j, f_x, zero), DP_jy = v_select(rubs_j, f_y, zero);

  c->v_ix += (DP1 + DP_ix) / c->M_i;
  c->v_iy += (-l->DP + DP_iy) / c->M_i;
  c->v_jx += (-DP1 + DP_jx) / c->M_j;
  c->v_jy += (l->DP + DP_jy) / c->M_j;
  c->w_ix += l->C_i * (DP2 + DP_iy);
  c->w_iy += l->C_i * -DP_ix;
  c->w_iz += l->C_i * -DP1;
  c->w_jx += l->C_j * (DP2 + DP_jy);
  c->w_jy += l->C_j * -DP_jx;
  c->w_jz += l->C_j * -DP1;
  update_slips(l);

  const vreal v_n_old = l->v_n;
  l->v_n = c->v_jy - c->v_iy;
  l->W += half * l->DP * v_abs(v_n_old + l->v_n);
  const vmask turning = l->compressing & v_less(zero, l->v_n);
  if (v_any(turning)) {
    l->compressing &= v_not(turning);
    l->W_f = v_select(turning, (v_splat(1) + c->e * c->e) * l->W, l->W_f);
  }
  const vmask going_on = v_less(l->v_n, zero) | v_less(l->W, l->W_f);
  const vmask ending = l->running & v_not(going_on);
  if (v_any(ending)) {
    l->end.v_ix = v_select(ending, c->v_ix, l->end.v_ix);
    l->end.v_iy = v_select(ending, c->v_iy, l->end.v_iy);
    l->end.v_jx = v_select(ending, c->v_jx, l->end.v_jx);
    l->end.v_jy = v_select(ending, c->v_jy, l->end.v_jy);
    l->end.w_ix = v_select(ending, c->w_ix, l->end.w_ix);
    l->end.w_iy = v_select(ending, c->w_iy, l->end.w_iy);
    l->end.w_iz = v_select(ending, c->w_iz, l->end.w_iz);
    l->end.w_jx = v_select(ending, c->w_jx, l->end.w_jx);
    l->end.w_jy = v_select(ending, c->w_jy, l->end.w_jy);
    l->end.w_jz = v_select(ending, c->w_jz, l->end.w_jz);
    l->end.good &= v_not(ending & v_less(l->bound, v_splat(n)));
    l->running &= v_not(ending);
  }
}

/* The greatest bound of a lane that takes part. */
static inline double greatest_bound(const euler_lanes *l) {
  const vreal taking_part = v_select(l->running, l->bound, v_splat(0));
  double greatest = 0.0;
  for (int k = 0; k < LANES; k++)
    greatest = fmax(greatest, (double)taking_part[k]);
  return greatest;
}

/* Steps all blocks until every lane has ended or is past its bound. */
static void run(euler_lanes l[GROUPS]) {
  double bound = 0.0;
  for (int b = 0; b < GROUPS; b++)
    bound = fmax(bound, greatest_bound(&l[b]));
  for (double n = 1.0; n <= bound; n += 1.0) {
    for (int b = 0; b < GROUPS; b++)
      euler_step(&l[b], (real)n);
    bool running = false;
    for (int b = 0; b < GROUPS; b++)
      running |= v_any(l[b].running);
    if (!running)
      break;
  }
}

size_t PRECISE_KERNEL(carom_euler_lanes)(const void *in, size_t n, const carom_options *opt, void *out, int8_t *status) {
  const real *from = in;
  real *to = out;
  real spare[OUT_NUMBERS]; /* takes what the lanes beyond the last pair compute */
  size_t first_bad = n;
  for (size_t first = 0; first < n; first += GROUPS * LANES) {
    euler_lanes l[GROUPS];
    for (int b = 0; b < GROUPS; b++) {
      const real *row[LANES];
      for (int k = 0; k < LANES; k++) {
        const size_t pair = first + (size_t)(b * LANES + k);
        row[k] = from + IN_NUMBERS * (pair < n ? pair : first);
      }
      l[b].now = load_frame(row);
      start(&l[b], opt);
    }
    run(l);
    for (int b = 0; b < GROUPS; b++) {
      real *row[LANES];
      for (int k = 0; k < LANES; k++) {
        const size_t pair = first + (size_t)(b * LANES + k);
        row[k] = pair < n ? to + OUT_NUMBERS * pair : spare;
      }
      const unsigned good = v_bits(l[b].end.good & v_not(l[b].running) & store_frame(&l[b].end, row));
      for (int k = 0; k < LANES; k++) {
        const size_t pair = first + (size_t)(b * LANES + k);
        if (pair >= n)
          break;
        carom_status one = CAROM_OK;
        if ((good >> k & 1) == 0)
          one = carom_collide_one(KERNEL_PRECISION, from + IN_NUMBERS * pair, opt, to + OUT_NUMBERS * pair);
        if (status != NULL)
          status[pair] = (int8_t)one;
        if (one < 0 && first_bad == n)
          first_bad = pair;
      }
    }
  }
  return first_bad;
}
