/* The exact solver in lanes: LANES collisions at once, each marched to its end (march.h).
 *
 * Collisions need one to a dozen steps. Lanes that march together wait for the slowest, so the pairs of a block are first
 * sorted by the effort foreseen for them. The sort changes who marches beside whom and nothing else: a lane's result is its
 * own.
 */
#include "arcs.h"
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

enum { PAIRS = 1024, BINS = 32 }; /* a block fits into the second cache several times */

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
  const real most = 1e8f, spread = 1e3f, fastest = 1e6f;
#else
  const real most = 1e60, spread = 1e4, fastest = 1e9;
#endif
  const vreal speed = v_max(v_max(v_abs(c->u_x), c->u_z), v_max(v_abs(c->d_x), v_abs(c->d_y))), approach = -c->v_n;
  return v_less(speed, fastest * approach) & v_less(approach, v_splat(most)) & v_less(v_splat(1 / most), approach) &
         v_less(c->kappa, v_splat(spread)) & v_less(v_splat(1 + 1 / spread), c->kappa);
}

/* A number from 0 to BINS - 1 that rises with the steps a marched collision will need. */
static inline vreal effort(const problem *c, const forecast *f) {
  const vreal first = first_step(c, f);
  const vreal slips = v_min((real)1.1 * f->x / first, v_splat(4)) * 3;
  const vreal sticks =
      12 + 4 * v_min(c->mu * c->mu_b * 16, v_splat(1)) + v_select(v_less(f->q, v_splat((real)1.3)), v_splat(4), v_splat(0));
  const vreal moves = v_select(v_less(f->q, v_splat((real)0.97)), slips, sticks);
  const vreal turns = v_select(f->at_rest, v_splat(0), v_max(v_splat((real)1.7) - f->room, v_splat(0)) * 20);
  return v_min(v_max(moves + turns, v_splat(0)), v_splat(BINS - 1));
}

/* The pairs of a block, class by class, those to be marched in an order in which their effort rises. Behind them is room for
 * the pairs that turn out not to belong to their class. */
typedef struct agenda {
  uint16_t pair[2 * PAIRS];
  size_t begin[CLASSES + 1];
} agenda;

static void plan_block(const real *in, size_t n, real s, agenda *a) {
  uint8_t bin[PAIRS + LANES];
  uint16_t begin[MARCHED + BINS + 1] = {0};
  for (size_t first = 0; first < n; first += LANES) {
    const real *row[LANES];
    for (size_t k = 0; k < LANES; k++)
      row[k] = in + IN_NUMBERS * (first + k < n ? first + k : first);
    const block b = block_load(row);
    const reduction r = reduce(&b, s);
    const forecast f = foresee(&r.c, s);
    const vmask good = b.good & tame(&r.c);
    const vreal class = v_select(good, class_of(&r.c, &f), v_splat(MARCHED));
    const vreal march_bin = v_select(good, effort(&r.c, &f), v_splat(0));
    const vreal key = v_select(v_less(class, v_splat(MARCHED)), class, MARCHED + march_bin);
    for (size_t k = 0; k < LANES; k++)
      bin[first + k] = (uint8_t)key[k];
  }
  for (size_t k = 0; k < n; k++)
    begin[bin[k] + 1]++;
  for (int k = 0; k < MARCHED + BINS; k++)
    begin[k + 1] = (uint16_t)(begin[k + 1] + begin[k]);
  for (int k = 0; k <= MARCHED; k++)
    a->begin[k] = begin[k];
  a->begin[CLASSES] = n;
  for (size_t k = 0; k < n; k++)
    a->pair[begin[bin[k]]++] = (uint16_t)k;
}

/* A vector of a block's pairs. */
typedef struct party {
  const real *from[LANES];
  real *to[LANES];
  block b;
  reduction r;
} party;

/* The pairs at [at, end) of the agenda. Lanes beyond the last are not good, read the block's first pair and write to `spare`.
 */
static inline void gather(party *p, const real *in, real *out, real *spare, const agenda *a, size_t at, size_t end, real s) {
  const unsigned there = at + LANES <= end ? (unsigned)ALL_LANES : at < end ? (1u << (end - at)) - 1 : 0;
  for (size_t k = 0; k < LANES; k++, at++) {
    p->from[k] = in + IN_NUMBERS * (at < end ? a->pair[at] : 0);
    p->to[k] = at < end ? out + OUT_NUMBERS * a->pair[at] : spare;
  }
  p->b = block_load(p->from);
  p->r = reduce(&p->b, s);
  p->b.good &= tame(&p->r.c) & v_from_bits(there);
}

static inline unsigned scatter(party *p, const outcome *o) {
  restore(&p->b, &p->r, o);
  return v_bits(p->b.good & o->good & block_store(&p->b, p->to));
}

/* Brings the next block nearer while this one is being solved: memory is slower than the solver. */
typedef struct fetcher {
  const char *in, *in_end;
  char *out, *out_end;
} fetcher;

static inline void fetch_ahead(fetcher *f) {
  enum { LINE = 64, TIMES = 5 }; /* per pair, a little more than 1, so that all is there in time */
  for (int k = 0; k < ABREAST * LANES * IN_NUMBERS * (int)sizeof(real) * TIMES / (4 * LINE) && f->in < f->in_end;
       k++, f->in += LINE)
    __builtin_prefetch(f->in, 0, 2);
  for (int k = 0; k < ABREAST * LANES * OUT_NUMBERS * (int)sizeof(real) * TIMES / (4 * LINE) && f->out < f->out_end;
       k++, f->out += LINE)
    __builtin_prefetch(f->out, 1, 2);
}

/* The pairs of one class; those that do not belong to it go to the end of the agenda. */
static inline __attribute__((always_inline)) void solve_by_arc(int class, const real *in, real *out, uint8_t *status, agenda *a,
                                                               fetcher *ahead, real s) {
  real spare[OUT_NUMBERS];
  for (size_t first = a->begin[class]; first < a->begin[class + 1]; first += ABREAST * LANES) {
    party p[ABREAST];
    const problem *c[ABREAST];
    vmask mask[ABREAST];
    outcome o[ABREAST];
    fetch_ahead(ahead);
    EACH(p, b) {
      const size_t at = first + (size_t)b * LANES;
      gather(&p[b], in, out, spare, a, at, a->begin[class + 1], s);
      c[b] = &p[b].r.c;
      mask[b] = p[b].b.good;
    }
    solve_class(class, c, mask, s, o);
    for (size_t b = 0; b < ABREAST; b++) {
      const unsigned good = scatter(&p[b], &o[b]);
      for (size_t k = 0, at = first + b * LANES; k < LANES && at < a->begin[class + 1]; k++, at++)
        if ((good >> k & 1) == 0)
          a->pair[a->begin[CLASSES]++] = a->pair[at];
        else if (status != NULL)
          status[a->pair[at]] = (uint8_t)CAROM_OK;
    }
  }
}

/* `next` pairs follow behind the n of this block. */
static size_t solve_block(const real *in, size_t n, size_t next, const carom_options *opt, real *out, uint8_t *status) {
  const real s = opt->slip == CAROM_SLIP_POOLTOOL ? 1 : -1;
  agenda a;
  real spare[OUT_NUMBERS]; /* takes what the lanes beyond the last pair compute */
  size_t first_bad = n;
  fetcher ahead = {(const char *)(in + IN_NUMBERS * n), (const char *)(in + IN_NUMBERS * (n + next)),
                   (char *)(out + OUT_NUMBERS * n), (char *)(out + OUT_NUMBERS * (n + next))};
  plan_block(in, n, s, &a);
  solve_by_arc(COARSE, in, out, status, &a, &ahead, s);
  solve_by_arc(MIDDLE, in, out, status, &a, &ahead, s);
  solve_by_arc(FINE, in, out, status, &a, &ahead, s);
  solve_by_arc(EARLY_STICK, in, out, status, &a, &ahead, s);
  solve_by_arc(LATE_STICK, in, out, status, &a, &ahead, s);
  for (size_t first = a.begin[MARCHED]; first < a.begin[CLASSES]; first += ABREAST * LANES) {
    party p[ABREAST];
    walk w[ABREAST];
    for (size_t b = 0; b < ABREAST; b++) {
      gather(&p[b], in, out, spare, &a, first + b * LANES, a.begin[CLASSES], s);
      set_out(&w[b], &p[b].r.c, p[b].b.good, s);
    }
    march(w, s);
    for (size_t b = 0; b < ABREAST; b++) {
      const unsigned good = scatter(&p[b], &w[b].o);
      for (size_t k = 0; k < LANES && first + b * LANES + k < a.begin[CLASSES]; k++) {
        const size_t pair = a.pair[first + b * LANES + k];
        carom_status one = CAROM_OK;
        if ((good >> k & 1) == 0)
          one = carom_collide_one(precision, p[b].from[k], opt, p[b].to[k]);
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
    const size_t left = n - first, part = left < PAIRS ? left : PAIRS, next = left - part < PAIRS ? left - part : PAIRS;
    const size_t bad = solve_block((const real *)in + IN_NUMBERS * first, part, next, opt, (real *)out + OUT_NUMBERS * first,
                                   status != NULL ? status + first : NULL);
    if (bad < part && first_bad == n)
      first_bad = first + bad;
  }
  return first_bad;
}
