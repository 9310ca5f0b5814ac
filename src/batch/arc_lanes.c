/* The arcs of a block of collisions, in lanes: sorted into classes, each class done in full vectors, what a class does not fit
 * handed on to the next.
 *
 * A lane's result is its own: the sort changes who is beside whom and nothing else. Compiled once per instruction set, always
 * in single precision (arcs.h says why that is enough).
 */
#include "arc_block.h"
#include "course.h"

#define PASTE2(a, b) a##b
#define PASTE(a, b) PASTE2(a, b)

enum { ROW = 8, GOOD = 5, HINT = 6 }; /* places in a row of `out`, behind the columns of arc_block.h */

typedef struct agenda {
  uint16_t pair[CLASSES][ARC_PAIRS];
  size_t count[CLASSES];
} agenda;

/* Rows of the pairs: what a problem is, and what came out. */
typedef struct rows {
  float in[ARC_PAIRS + LANES][ROW], out[ARC_PAIRS + LANES][ROW];
} rows;

always void columns_to_rows(float (*to)[ROW], const vreal column[ROW]) {
  real *row[LANES];
  lanes_unrolled for (int k = 0; k < LANES; k++) row[k] = to[k];
  lanes_unrolled for (int at = 0; at < ROW; at += CHUNK) v_store_columns(row, at, column + at);
}

/* The problem whose columns are x. */
always problem problem_of(const vreal x[ROW], real s, real slack) {
  return (problem){.u_x = x[0],
                   .u_z = x[1],
                   .d_x = x[2],
                   .d_y = x[3],
                   .kappa = x[4],
                   .mu = x[5],
                   .mu_b = x[6],
                   .e = x[7],
                   .v_n = -x[4],
                   .K = v_splat(0),
                   .K_c = v_splat(0),
                   .seen = v_from_bits(0),
                   .s = s,
                   .slack = slack};
}

/* No slip between the balls to speak of: the impulse of friction is what takes it away, and the cloth's is less still. */
static void stick_at_once(const float in[ROW], float out[ROW]) {
  out[0] = in[0] / (3.5f * in[4]);
  out[1] = 0.4f * in[1] / in[4];
  out[2] = out[3] = out[4] = 0;
  out[GOOD] = 1;
}

static void sort(const carom_arc_block *b, size_t n, real s, real slack, agenda *a, rows *r) {
  for (int k = 0; k < CLASSES; k++)
    a->count[k] = 0;
  for (size_t first = 0; first < n; first += LANES) {
    vreal x[ROW];
    lanes_unrolled for (int k = 0; k < ROW; k++) x[k] = v_load(b->in[k] + first);
    columns_to_rows(r->in + first, x);
    const problem c = problem_of(x, s, slack);
    const forecast f = foresee(&c, 1 + c.e);
    const vmask usable = v_less(v_splat(0), v_load(b->good + first)) & within_reach(&c);
    const unsigned at_once = v_bits(usable & sticks_at_once(&c, &f));
    const vint class = __builtin_convertvector(v_select(usable, class_of(&c, &f), v_splat(CLASSES)), vint);
    for (size_t k = 0; k < LANES && first + k < n; k++) {
      float *out = r->out[first + k];
      out[GOOD] = out[HINT] = 0;
      if (at_once >> k & 1)
        stick_at_once(r->in[first + k], out);
      else if (class[k] < CLASSES)
        a->pair[class[k]][a->count[class[k]]++] = (uint16_t)(first + k);
    }
  }
}

/* The next few cache lines, for one vector solved here. */
static inline void fetch_ahead(carom_fetcher *f) {
  enum { LINE = 64, IN_LINES = 4 * LANES, OUT_LINES = 2 * LANES };
  for (int k = 0; k < IN_LINES && f->in_at < f->in_bytes; k++, f->in_at += LINE)
    __builtin_prefetch(f->in + f->in_at, 0, 2);
  for (int k = 0; k < OUT_LINES && f->out_at < f->out_bytes; k++, f->out_at += LINE)
    __builtin_prefetch(f->out + f->out_at, 1, 2);
}

/* A vector of a class: where its pairs are, and which lanes have one. */
typedef struct party {
  const uint16_t *pair;
  real *to[LANES];
  vmask mask;
  unsigned there;
} party;

/* The next vector of the class from place `first` on. Lanes without a pair repeat the first one and write to `spare`. */
always problem gather(party *p, int class, size_t first, real s, real slack, const agenda *a, rows *r, float *spare,
                      vreal *hint) {
  const size_t left = first < a->count[class] ? a->count[class] - first : 0;
  const real *from[LANES];
  vreal x[ROW];
  p->pair = a->pair[class] + (left > 0 ? first : 0);
  for (size_t k = 0; k < LANES; k++) {
    from[k] = r->in[k < left ? p->pair[k] : a->pair[class][0]];
    p->to[k] = k < left ? r->out[p->pair[k]] : spare;
  }
  p->there = left >= LANES ? (unsigned)ALL_LANES : (1u << left) - 1;
  p->mask = v_from_bits(p->there);
  real h[LANES] = {0};
  if (class == FINE)
    for (size_t k = 0; k < LANES; k++)
      h[k] = p->to[k][HINT];
  *hint = v_load(h);
  lanes_unrolled for (int at = 0; at < ROW; at += CHUNK) v_load_columns(from, at, x + at);
  return problem_of(x, s, slack);
}

/* The pairs of one class, `abreast` vectors at a time; those that do not belong to it go to class `next`. */
always void solve(int class, int abreast, int next, real s, real slack, agenda *a, rows *r, carom_fetcher *ahead) {
  float spare[ROW] = {0};
  for (size_t first = 0; first < a->count[class]; first += (size_t)abreast * LANES) {
    party p[MOST_ABREAST];
    problem c[MOST_ABREAST];
    vreal hint[MOST_ABREAST];
    vmask mask[MOST_ABREAST];
    outcome o[MOST_ABREAST];
    EACH_VECTOR(b) {
      fetch_ahead(ahead);
      c[b] = gather(&p[b], class, first + (size_t)b * LANES, s, slack, a, r, spare, &hint[b]);
      mask[b] = p[b].mask;
    }
    solve_class(class, abreast, c, hint, mask, o);
    EACH_VECTOR(b) {
      const vreal zero = v_splat(0), good = v_select(o[b].good, v_splat(1), zero);
      const vreal y[ROW] = {o[b].Q_1, o[b].Q_2, o[b].F_x, o[b].F_y, o[b].excess, good, class == LATE_STICK ? o[b].h : zero,
                            zero};
      lanes_unrolled for (int at = 0; at < ROW; at += CHUNK) v_store_columns(p[b].to, at, y + at);
      unsigned bad = p[b].there & ~v_bits(o[b].good);
      for (; bad != 0; bad &= bad - 1)
        a->pair[next][a->count[next]++] = p[b].pair[__builtin_ctz(bad)];
    }
  }
}

/* The pairs that no single arc fits. They need from one to dozens of arcs, so a lane that is done takes up the next pair. */
static void solve_followed(real s, real slack, agenda *a, rows *r, carom_fetcher *ahead) {
  const size_t n = a->count[FOLLOWED];
  party p;
  vreal hint;
  float spare[ROW];
  if (n == 0)
    return;
  const problem c = gather(&p, FOLLOWED, 0, s, slack, a, r, spare, &hint);
  walk w = set_out(&c, p.mask);
  size_t next = n < LANES ? n : LANES;
  for (unsigned there = p.there; there != 0;) {
    fetch_ahead(ahead);
    follow(&w);
    unsigned running = v_bits(w.running), good = v_bits(w.total.good), seen = v_bits(w.c.seen), failed = v_bits(w.failed);
    for (unsigned done = there & ~running; done != 0; done &= done - 1) {
      const int k = __builtin_ctz(done);
      real *to = p.to[k];
      to[0] = w.total.Q_1[k];
      to[1] = w.total.Q_2[k];
      to[2] = w.total.F_x[k];
      to[3] = w.total.F_y[k];
      to[4] = w.total.excess[k];
      to[GOOD] = (real)(good >> k & 1);
      if (next == n) {
        there &= ~(1u << k);
        continue;
      }
      const real *from = r->in[a->pair[FOLLOWED][next]];
      p.to[k] = r->out[a->pair[FOLLOWED][next++]];
      w.c.u_x[k] = from[0];
      w.c.u_z[k] = from[1];
      w.c.d_x[k] = from[2];
      w.c.d_y[k] = from[3];
      w.c.kappa[k] = from[4];
      w.c.mu[k] = from[5];
      w.c.mu_b[k] = from[6];
      w.c.e[k] = from[7];
      w.c.v_n[k] = -from[4];
      w.c.K[k] = w.total.Q_1[k] = w.total.Q_2[k] = w.total.F_x[k] = w.total.F_y[k] = w.arcs[k] = 0;
      w.longest[k] = longest_arc;
      seen &= ~(1u << k);
      failed &= ~(1u << k);
      good &= ~(1u << k);
      running |= 1u << k;
    }
    w.c.seen = v_from_bits(seen);
    w.failed = v_from_bits(failed);
    w.total.good = v_from_bits(good);
    w.running = v_from_bits(running);
  }
}

void PASTE(carom_arcs_, CAROM_LANES_SUFFIX)(carom_arc_block *b, size_t n, float s, float slack) {
  agenda a;
  rows r;
  sort(b, n, s, slack, &a, &r);
  solve(EARLY_STICK, 2, LATE_STICK, s, slack, &a, &r, &b->ahead);
  solve(LATE_STICK, 1, FINE, s, slack, &a, &r, &b->ahead);
  solve(COARSE, 2, MIDDLE, s, slack, &a, &r, &b->ahead);
  solve(MIDDLE, 2, FINE, s, slack, &a, &r, &b->ahead);
  solve(FINE, 1, FOLLOWED, s, slack, &a, &r, &b->ahead);
  solve_followed(s, slack, &a, &r, &b->ahead);
  for (size_t first = 0; first < n; first += LANES) {
    const real *from[LANES];
    vreal x[ROW];
    for (size_t k = 0; k < LANES; k++)
      from[k] = r.out[first + k];
    lanes_unrolled for (int at = 0; at < ROW; at += CHUNK) v_load_columns(from, at, x + at);
    lanes_unrolled for (int k = 0; k < ARC_OUT; k++) v_store(b->out[k] + first, x[k]);
    v_store(b->good + first, x[GOOD]);
  }
}
