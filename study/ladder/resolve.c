/* Around a rung: what is common to all, so that the rungs hold their ideas only. Checks, table
 * frame to collision frame, the rung, and back. A rung across collisions gets as many pairs at
 * once as it has lanes; a pair that is refused takes no lane.
 *
 * The rungs are the paper's: no bound on the steps, no check of anything. So nothing is handed
 * to them that they could not end or could not represent. This file is compiled without
 * fast-math, so its comparisons see NaN.
 *
 * Every loop ends. Let dv = (1 + e)|v_n|/(2N) be the normal velocity that a step gives each
 * ball, eps the spacing of numbers near 1, V a bound on |v_iy| and |v_jy|. A step adds dv to the
 * ball that is not pressed into the cloth, and something of the same sign to the one that is,
 * the whole in at most three roundings of eps V/2 each: v_n rises by dv - 3/2 eps V or more. Ask
 * for dv >= 2 eps V, and that is dv/4: compression ends within 4 |v_n|/dv steps and adds at most
 * 8 v_n²/dv to the work (without the factor DP/2). From then on v_n >= k dv/4 after k steps, so
 * the work it gives back is k² dv/4 or more, and reaches W_f within 6 |v_n|/dv steps; rounding
 * of the work delays this by less than |v_n|/dv steps more. A step changes a |v_y| by
 * 5/2 dv at the most, so V = max(|v_iy|, |v_jy|) + 32 |v_n| is a bound indeed. (All this is the
 * worst that rounding could do; in exact arithmetic the steps are about N.) Across collisions
 * this holds in each lane, because a lane's steps depend on no other lane.
 *
 * All is representable, in single precision too. Slips enter rsqrt as squares in single
 * precision, between 1e-38 and 3e38. A slip below 1e-16 counts as none; the velocity step must
 * not be below it either. Speeds up to 1e9 m/s and sizes within 1e-9 ... 1e9 m and kg leave
 * every product that occurs inside single precision's range.
 */
#include "ladder.h"

#include "ball_ball/arguments.h"
#include "ball_ball/frame.h"

#include <float.h>
#include <math.h>

static const double greatest = 1e9, least = 1e-9, least_step = 1e-16;

static bool representable(const carom_local *c) {
  const double velocity[] = {c->v_ix, c->v_iy, c->v_jx, c->v_jy};
  const double spin[] = {c->w_ix, c->w_iy, c->w_iz, c->w_jx, c->w_jy, c->w_jz};
  bool good = c->M_i >= least && c->M_i <= greatest && c->R >= least && c->R <= greatest;
  for (size_t k = 0; k < sizeof velocity / sizeof velocity[0]; k++)
    good &= fabs(velocity[k]) <= greatest;
  for (size_t k = 0; k < sizeof spin / sizeof spin[0]; k++)
    good &= fabs(spin[k]) * c->R <= greatest;
  return good;
}

static bool resolved(const carom_local *c, int N, ladder_precision precision) {
  const double eps = precision == LADDER_SINGLE ? (double)FLT_EPSILON : DBL_EPSILON;
  const double v_n = fabs(c->v_jy - c->v_iy), dv = 0.5 * (1.0 + c->e) * v_n / N;
  return dv >= 2.0 * eps * (fmax(fabs(c->v_iy), fabs(c->v_jy)) + 32.0 * v_n) && dv >= least_step;
}

/* The collisions of the widest rung's call. */
enum { WIDEST = 32 };
#define RUNG(name, ...) \
  _Static_assert((int)CAROM_WIDTH_##name <= (int)WIDEST, "WIDEST is below the width of " #name);
#include "kernels.def"
#undef RUNG

/* A batch under way: the caller's arguments, and the pairs that wait until the lanes of the rung
 * are full. */
typedef struct batch {
  const ladder_module *module;
  const ladder_rung *rung;
  const carom_impact *in;
  const carom_options *options;
  carom_result *out;
  int8_t *status;
  size_t first_bad; /* the first pair in error, or SIZE_MAX */
  carom_status first_error;
  size_t waiting;
  size_t pair[WIDEST];
  carom_frame frame[WIDEST];
  carom_local local[WIDEST];
} batch;

static size_t number_of(const ladder_rung *rung) {
  return (size_t)(rung - ladder_rung_at(0));
}

static void note_status(batch *b, size_t pair, carom_status status) {
  if (b->status != NULL)
    b->status[pair] = (int8_t)status;
  if (status >= 0)
    return;
  carom_fill_nan(&b->out[pair]);
  if (pair < b->first_bad) {
    b->first_bad = pair;
    b->first_error = status;
  }
}

/* Writes a collision in its frame for the rung to solve, and returns CAROM_OK; or returns the
 * status of a pair that is not handed to it. */
static carom_status prepare(const batch *b, const carom_impact *in, carom_frame *frame,
                            carom_local *local) {
  const carom_status status = carom_check(in, b->options, NULL);
  if (status != CAROM_OK)
    return status;
  if (in->a.mass != in->b.mass)
    return CAROM_ERROR_MASSES_DIFFER;
  *frame = carom_frame_of(in);
  if (frame->distance == 0.0)
    return CAROM_ERROR_COINCIDENT;
  if (isinf(frame->distance))
    return CAROM_ERROR_OVERFLOW;
  *local = carom_to_frame(frame, in, b->options->slip);
  if (local->v_jy - local->v_iy >= 0.0)
    return CAROM_SEPARATING;
  if (!representable(local))
    return CAROM_ERROR_OVERFLOW;
  if (!resolved(local, carom_steps(b->options), b->rung->precision))
    return CAROM_ERROR_TOO_SLOW;
  return CAROM_OK;
}

/* Solves the pairs that wait. Lanes that are left over solve the first of them once more. */
static void solve_waiting(batch *b) {
  if (b->waiting == 0)
    return;
  for (size_t lane = b->waiting; lane < b->rung->width; lane++)
    b->local[lane] = b->local[0];
  b->module->run[number_of(b->rung)](b->local, carom_steps(b->options));
  for (size_t lane = 0; lane < b->waiting; lane++) {
    carom_result *out = &b->out[b->pair[lane]];
    carom_from_frame(&b->frame[lane], &b->local[lane], out);
    carom_status status = CAROM_OK;
    if (!carom_result_is_finite(out))
      status = CAROM_ERROR_OVERFLOW;
    note_status(b, b->pair[lane], status);
  }
  b->waiting = 0;
}

static void add_pair(batch *b, size_t pair) {
  const size_t lane = b->waiting;
  const carom_status status = prepare(b, &b->in[pair], &b->frame[lane], &b->local[lane]);
  if (status == CAROM_OK) {
    b->pair[lane] = pair;
    b->waiting++;
  } else {
    if (status == CAROM_SEPARATING)
      carom_copy_state(&b->in[pair], &b->out[pair]);
    note_status(b, pair, status);
  }
  if (b->waiting == b->rung->width)
    solve_waiting(b);
}

carom_status ladder_resolve_batch(const ladder_module *module, const ladder_rung *rung,
                                  const carom_impact *in, size_t n, const carom_options *opt,
                                  carom_result *out, int8_t *status) {
  const carom_options defaults = {0};
  if (n > 0 && (in == NULL || out == NULL))
    return CAROM_ERROR_NULL;
  if (opt == NULL)
    opt = &defaults;
  /* Not an initialiser, which would clear all the lanes in each single call. */
  batch b;
  b.module = module;
  b.rung = rung;
  b.in = in;
  b.options = opt;
  b.out = out;
  b.status = status;
  b.first_bad = SIZE_MAX;
  b.first_error = CAROM_OK;
  b.waiting = 0;
  for (size_t pair = 0; pair < n; pair++)
    add_pair(&b, pair);
  solve_waiting(&b);
  return b.first_error;
}

carom_status ladder_resolve(const ladder_module *module, const ladder_rung *rung,
                            const carom_impact *in, const carom_options *opt, carom_result *out) {
  int8_t status;
  if (in == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  ladder_resolve_batch(module, rung, in, 1, opt, out, &status);
  return (carom_status)status;
}
