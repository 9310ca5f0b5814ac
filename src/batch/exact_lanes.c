/* The exact solver in lanes: LANES collisions at once, each marched to its end (march.h).
 *
 * Collisions need one to a dozen steps. Lanes that march together wait for the slowest, so the pairs of a block are first
 * sorted by the effort foreseen for them. The sort changes who marches beside whom and nothing else: a lane's result is its
 * own.
 */
#include "batch.h"
#include "block.h"
#include "march.h"

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

enum { PAIRS = 256, BINS = 32 }; /* a block fits into the second cache several times */

/* Turned so that ball i is the pressed one, and u_z >= 0; the way back needs the signs and the mass ratio. */
typedef struct reduction {
  problem c;
  vmask on_j;
  vreal sign, ratio;
} reduction;

static inline reduction reduce(const block *b, real s) {
  reduction r;
  const vreal one = v_splat(1), sR = s * b->R;
  const vreal u_z = b->R * (b->w_ix + b->w_jx);
  r.on_j = v_less(u_z, v_splat(0));
  r.sign = v_select(r.on_j, -one, one);
  const vreal M_p = v_select(r.on_j, b->M_j, b->M_i), M_o = v_select(r.on_j, b->M_i, b->M_j);
  r.ratio = M_p / M_o;
  r.c.u_x = b->v_ix - b->v_jx - b->R * (b->w_iz + b->w_jz);
  r.c.u_z = v_abs(u_z);
  r.c.d_x = v_select(r.on_j, -(b->v_jx + sR * b->w_jy), b->v_ix + sR * b->w_iy);
  r.c.d_y = v_select(r.on_j, -(b->v_jy - sR * b->w_jx), b->v_iy - sR * b->w_ix);
  r.c.v_n = b->v_jy - b->v_iy;
  r.c.kappa = 1 + r.ratio;
  r.c.mu = v_select(r.on_j, b->mu_j, b->mu_i);
  r.c.mu_b = b->mu_b;
  r.c.e = b->e;
  return r;
}

/* The twelve changes, by the balance of momentum, from the impulses. */
static inline void restore(block *b, const reduction *r, const outcome *o) {
  const vreal per = v_splat(1) / r->c.kappa, spin = (real)2.5 / b->R;
  const vreal Q_1 = (r->c.u_x - o->u_x + o->F_x) * per * (real)(1 / 3.5);
  const vreal Q_2 = (r->c.u_z - o->u_z + (real)2.5 * o->F_y) * per * (real)0.4;
  const vreal on_other = r->sign * r->ratio;
  const vreal p_x = r->sign * (o->F_x - Q_1), p_y = r->sign * (o->F_y - o->p), o_x = on_other * Q_1, o_y = on_other * o->p;
  const vreal p_wx = r->sign * spin * (o->F_y - Q_2), p_wy = -r->sign * spin * o->F_x, o_wx = -on_other * spin * Q_2;
  const vreal p_wz = spin * Q_1, o_wz = spin * r->ratio * Q_1, zero = v_splat(0);
  b->v_ix += v_select(r->on_j, o_x, p_x);
  b->v_jx += v_select(r->on_j, p_x, o_x);
  b->v_iy += v_select(r->on_j, o_y, p_y);
  b->v_jy += v_select(r->on_j, p_y, o_y);
  b->w_ix += v_select(r->on_j, o_wx, p_wx);
  b->w_jx += v_select(r->on_j, p_wx, o_wx);
  b->w_iy += v_select(r->on_j, zero, p_wy);
  b->w_jy += v_select(r->on_j, p_wy, zero);
  b->w_iz += v_select(r->on_j, o_wz, p_wz);
  b->w_jz += v_select(r->on_j, p_wz, o_wz);
}

/* Lanes whose numbers are within what the march was made for; a single call takes care of others. */
static inline vmask tame(const problem *c) {
#ifdef CAROM_LANES_SINGLE
  const real most = 1e8f, spread = 1e3f, fastest = 1e3f;
#else
  const real most = 1e60, spread = 1e4, fastest = 1e9;
#endif
  const vreal speed = v_max(v_max(v_abs(c->u_x), c->u_z), v_max(v_abs(c->d_x), v_abs(c->d_y))), approach = -c->v_n;
  return v_less(speed, fastest * approach) & v_less(approach, v_splat(most)) & v_less(v_splat(1 / most), approach) &
         v_less(c->kappa, v_splat(spread)) & v_less(v_splat(1 + 1 / spread), c->kappa);
}

/* A number from 0 to BINS - 1 that rises with the steps a collision will need. */
static inline vreal effort(const problem *c, real s) {
  const forecast f = foresee(c, s);
  const vreal first = first_step(c, &f);
  const vreal slips = v_min((real)1.1 * f.x / first, v_splat(4)) * 3;
  const vreal sticks =
      12 + 4 * v_min(c->mu * c->mu_b * 16, v_splat(1)) + v_select(v_less(f.q, v_splat((real)1.3)), v_splat(4), v_splat(0));
  const vreal moves = v_select(v_less(f.q, v_splat((real)0.97)), slips, sticks);
  const vreal turns = v_select(f.at_rest, v_splat(0), v_max(v_splat((real)1.7) - f.room, v_splat(0)) * 20);
  return v_min(v_max(moves + turns, v_splat(0)), v_splat(BINS - 1));
}

/* The pairs [0, n) in an order in which their effort rises. */
static void sort_by_effort(const real *in, size_t n, real s, uint16_t order[PAIRS]) {
  uint8_t bin[PAIRS + LANES];
  uint16_t begin[BINS + 1] = {0};
  for (size_t first = 0; first < n; first += LANES) {
    const real *row[LANES];
    for (size_t k = 0; k < LANES; k++)
      row[k] = in + IN_NUMBERS * (first + k < n ? first + k : first);
    const block b = block_load(row);
    const reduction r = reduce(&b, s);
    const vreal key = v_select(b.good, effort(&r.c, s), v_splat(0));
    for (size_t k = 0; k < LANES; k++)
      bin[first + k] = (uint8_t)key[k];
  }
  for (size_t k = 0; k < n; k++)
    begin[bin[k] + 1]++;
  for (int k = 0; k < BINS; k++)
    begin[k + 1] = (uint16_t)(begin[k + 1] + begin[k]);
  for (size_t k = 0; k < n; k++)
    order[begin[bin[k]]++] = (uint16_t)k;
}

static size_t solve_block(const real *in, size_t n, const carom_options *opt, real *out, uint8_t *status) {
  const real s = opt->slip == CAROM_SLIP_POOLTOOL ? 1 : -1;
  uint16_t order[PAIRS];
  real spare[OUT_NUMBERS]; /* takes what the lanes beyond the last pair compute */
  size_t first_bad = n;
  if (n > LANES)
    sort_by_effort(in, n, s, order);
  else
    for (size_t k = 0; k < n; k++)
      order[k] = (uint16_t)k;
  for (size_t first = 0; first < n; first += ABREAST * LANES) {
    const real *from[ABREAST][LANES];
    real *to[ABREAST][LANES];
    block block_of[ABREAST];
    reduction r[ABREAST];
    walk w[ABREAST];
    for (size_t b = 0; b < ABREAST; b++) {
      for (size_t k = 0; k < LANES; k++) {
        const size_t at = first + b * LANES + k;
        from[b][k] = in + IN_NUMBERS * order[at < n ? at : first];
        to[b][k] = at < n ? out + OUT_NUMBERS * order[at] : spare;
      }
      block_of[b] = block_load(from[b]);
      r[b] = reduce(&block_of[b], s);
      block_of[b].good &= tame(&r[b].c);
      set_out(&w[b], &r[b].c, block_of[b].good, s);
    }
    march(w, s);
    for (size_t b = 0; b < ABREAST; b++) {
      restore(&block_of[b], &r[b], &w[b].o);
      const unsigned good = v_bits(block_of[b].good & w[b].o.good & block_store(&block_of[b], to[b]));
      for (size_t k = 0; k < LANES && first + b * LANES + k < n; k++) {
        const size_t pair = order[first + b * LANES + k];
        carom_status one = CAROM_OK;
        if ((good >> k & 1) == 0)
          one = carom_collide_one(precision, from[b][k], opt, to[b][k]);
        if (status != NULL)
          status[pair] = (uint8_t)one;
        if (one < 0 && pair < first_bad)
          first_bad = pair;
      }
    }
  }
  return first_bad;
}

size_t SOLVER(const void *in, size_t n, const carom_options *opt, void *out, uint8_t *status) {
  size_t first_bad = n;
  for (size_t first = 0; first < n; first += PAIRS) {
    const size_t part = n - first < PAIRS ? n - first : PAIRS;
    const size_t bad = solve_block((const real *)in + IN_NUMBERS * first, part, opt, (real *)out + OUT_NUMBERS * first,
                                   status != NULL ? status + first : NULL);
    if (bad < part && first_bad == n)
      first_bad = first + bad;
  }
  return first_bad;
}
