/* The exact solver in lanes: from the rows of the caller to the arcs of arc_lanes.c and back, block by block.
 *
 * What is compiled here, once per instruction set and precision, is all that needs the caller's precision: checks, frame,
 * reduction to the collision of arcs.h in its units, and the way back by the balance of momentum. What lies between is in
 * single precision for both.
 */
#include "arc_block.h"
#include "batch.h"
#include "block.h"

#define PASTE3(a, b, c) a##b##_##c
#define PASTE(a, b, c) PASTE3(a, b, c)
#ifdef CAROM_LANES_SINGLE
#define PRECISION_SUFFIX single
static const carom_precision precision = CAROM_SINGLE;
#else
#define PRECISION_SUFFIX double
static const carom_precision precision = CAROM_DOUBLE;
#endif
#define SOLVER PASTE(carom_exact_lanes_, CAROM_LANES_SUFFIX, PRECISION_SUFFIX)
#define PASTE2(a, b) a##b
#define PASTE_SUFFIX(a, b) PASTE2(a, b)
#define ARCS PASTE_SUFFIX(carom_arcs_, CAROM_LANES_SUFFIX)

/* LANES numbers in single precision, unaligned. */
typedef float floats __attribute__((vector_size(4 * LANES)));
typedef float floats_unaligned __attribute__((vector_size(4 * LANES), aligned(4), may_alias));
static inline void store_floats(float *to, vreal x) {
  *(floats_unaligned *)to = __builtin_convertvector(x, floats);
}
static inline vreal load_floats(const float *from) {
  return __builtin_convertvector((floats) * (const floats_unaligned *)from, vreal);
}

/* What the way back needs of LANES pairs: the motion in the frame, and the signs and masses of the reduction. */
typedef struct pending {
  vreal v_ix, v_iy, w_ix, w_iy, w_iz, v_jx, v_jy, w_jx, w_jy, w_jz; /* as in block */
  vreal y_x, y_y, y_z, R, e;
  vreal unit, ratio; /* |v_n|/κ; mass of the pressed ball over that of the other */
  vreal sign;        /* -1 if ball j is the pressed one */
} pending;

/* Beyond these, a single call. */
#ifdef CAROM_LANES_SINGLE
static const real most = 1e8f;
static const float slack = 4;
#else
static const real most = 1e60;
static const float slack = 1;
#endif
static const real spread = 10;    /* of masses */
static const real fastest = 1e8f; /* of slips, over the approach */

/* Turned so that ball i is the pressed one, with u_z >= 0; into column `at` of *a. */
static inline void reduce(const block *b, real s, pending *p, carom_arc_block *a, size_t at) {
  const vreal one = v_splat(1), sR = s * b->R, zero = v_splat(0);
  const vreal u_x = b->v_ix - b->v_jx - b->R * (b->w_iz + b->w_jz), u_z = b->R * (b->w_ix + b->w_jx);
  const vmask on_j = v_less(u_z, zero);
  const vreal M_p = v_select(on_j, b->M_j, b->M_i), M_o = v_select(on_j, b->M_i, b->M_j);
  const vreal ratio = M_p * v_reciprocal(M_o), kappa = 1 + ratio, approach = b->v_iy - b->v_jy;
  const vreal per_unit = kappa * v_reciprocal(approach);
  const vreal d_x = v_select(on_j, -(b->v_jx + sR * b->w_jy), b->v_ix + sR * b->w_iy);
  const vreal d_y = v_select(on_j, -(b->v_jy - sR * b->w_jx), b->v_iy - sR * b->w_ix);
  const vreal speed = v_max(v_max(v_abs(u_x), v_abs(u_z)), v_max(v_abs(d_x), v_abs(d_y)));
  const vmask tame = v_less(speed, fastest * approach) & v_less(approach, v_splat(most)) & v_less(v_splat(1 / most), approach) &
                     v_less(ratio, v_splat(spread)) & v_less(v_splat(1 / spread), ratio);
  const vreal level = v_select(v_less_equal(v_abs(u_z), (real)1e-10 * approach), zero, one); /* no ball pressed to speak of */
  *p = (pending){b->v_ix, b->v_iy,
                 b->w_ix, b->w_iy,
                 b->w_iz, b->v_jx,
                 b->v_jy, b->w_jx,
                 b->w_jy, b->w_jz,
                 b->y_x,  b->y_y,
                 b->y_z,  b->R,
                 b->e,    approach * v_reciprocal(kappa),
                 ratio,   v_select(on_j, -one, one)};
  store_floats(a->in[0] + at, u_x * per_unit);
  store_floats(a->in[1] + at, v_abs(u_z) * per_unit);
  store_floats(a->in[2] + at, d_x * per_unit);
  store_floats(a->in[3] + at, d_y * per_unit);
  store_floats(a->in[4] + at, kappa);
  store_floats(a->in[5] + at, level * v_select(on_j, b->mu_j, b->mu_i));
  store_floats(a->in[6] + at, v_max(b->mu_b, v_splat((real)1e-9)));
  store_floats(a->in[7] + at, b->e);
  store_floats(a->good + at, v_select(b->good & tame, one, zero));
}

/* The twelve changes, by the balance of momentum, from the impulses; the lanes that were solved are good. */
static inline block restore(const pending *p, const carom_arc_block *a, size_t at) {
  const vreal zero = v_splat(0), scale = p->sign * p->unit;
  const vmask on_j = v_less(p->sign, zero);
  const vreal Q_1 = load_floats(a->out[0] + at), Q_2 = load_floats(a->out[1] + at);
  const vreal F_x = load_floats(a->out[2] + at), F_y = load_floats(a->out[3] + at), excess = load_floats(a->out[4] + at);
  const vreal impulse = 1 + v_sqrt(v_max(zero, p->e * p->e + excess)) + F_y * v_reciprocal(1 + p->ratio);
  const vreal spin = (real)2.5 * v_reciprocal(p->R), turn = scale * spin, other = scale * p->ratio;
  const vreal p_x = scale * (F_x - Q_1), p_y = scale * (F_y - impulse), o_x = other * Q_1, o_y = other * impulse;
  const vreal p_wx = turn * (F_y - Q_2), p_wy = -turn * F_x, o_wx = -turn * p->ratio * Q_2;
  const vreal p_wz = p->unit * spin * Q_1, o_wz = p_wz * p->ratio;
  return (block){.v_ix = p->v_ix + v_select(on_j, o_x, p_x),
                 .v_jx = p->v_jx + v_select(on_j, p_x, o_x),
                 .v_iy = p->v_iy + v_select(on_j, o_y, p_y),
                 .v_jy = p->v_jy + v_select(on_j, p_y, o_y),
                 .w_ix = p->w_ix + v_select(on_j, o_wx, p_wx),
                 .w_jx = p->w_jx + v_select(on_j, p_wx, o_wx),
                 .w_iy = p->w_iy + v_select(on_j, zero, p_wy),
                 .w_jy = p->w_jy + v_select(on_j, p_wy, zero),
                 .w_iz = p->w_iz + v_select(on_j, o_wz, p_wz),
                 .w_jz = p->w_jz + v_select(on_j, p_wz, o_wz),
                 .y_x = p->y_x,
                 .y_y = p->y_y,
                 .y_z = p->y_z,
                 .good = v_less(zero, load_floats(a->good + at))};
}

/* `next` pairs follow behind the n of this block. */
static size_t solve_block(const real *in, size_t n, size_t next, const carom_options *opt, real *out, uint8_t *status) {
  const real s = opt->slip == CAROM_SLIP_POOLTOOL ? 1 : -1;
  pending p[ARC_PAIRS / LANES];
  carom_arc_block a;
  real spare[OUT_NUMBERS]; /* takes what the lanes beyond the last pair compute */
  size_t first_bad = n;
  for (size_t first = 0; first < n; first += LANES) {
    const real *from[LANES];
    for (size_t k = 0; k < LANES; k++)
      from[k] = in + IN_NUMBERS * (first + k < n ? first + k : first);
    const block b = block_load(from);
    reduce(&b, s, &p[first / LANES], &a, first);
  }
  for (size_t k = n; k < n + ARC_WIDEST; k++) /* what the arcs' wider vectors read beyond the last pair */
    a.good[k] = 0;
  a.ahead = (carom_fetcher){
      (const char *)(in + IN_NUMBERS * n), (char *)(out + OUT_NUMBERS * n), 0, next * IN_NUMBERS * sizeof(real), 0,
      next * OUT_NUMBERS * sizeof(real)};
  ARCS(&a, n, (float)s, slack);
  for (size_t first = 0; first < n; first += LANES) {
    real *to[LANES];
    const block b = restore(&p[first / LANES], &a, first);
    for (size_t k = 0; k < LANES; k++)
      to[k] = first + k < n ? out + OUT_NUMBERS * (first + k) : spare;
    const unsigned good = v_bits(b.good & block_store(&b, to));
    for (size_t k = 0; k < LANES && first + k < n; k++) {
      const size_t pair = first + k;
      carom_status one = CAROM_OK;
      if ((good >> k & 1) == 0)
        one = carom_collide_one(precision, in + IN_NUMBERS * pair, opt, out + OUT_NUMBERS * pair);
      if (status != NULL)
        status[pair] = (uint8_t)one;
      if (one < 0 && pair < first_bad)
        first_bad = pair;
    }
  }
  return first_bad;
}

size_t SOLVER(const void *in, size_t n, const carom_options *opt, void *out, uint8_t *status) {
  size_t first_bad = n;
  for (size_t first = 0; first < n; first += ARC_PAIRS) {
    const size_t left = n - first, part = left < ARC_PAIRS ? left : ARC_PAIRS,
                 next = left - part < ARC_PAIRS ? left - part : ARC_PAIRS;
    const size_t bad = solve_block((const real *)in + IN_NUMBERS * first, part, next, opt, (real *)out + OUT_NUMBERS * first,
                                   status != NULL ? status + first : NULL);
    if (bad < part && first_bad == n)
      first_bad = first + bad;
  }
  return first_bad;
}
