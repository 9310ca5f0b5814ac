/* Around a rung: what is common to all, so that the rungs hold their ideas only. Checks, table
 * frame to collision frame, the rung, and back.
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
 * worst that rounding could do; in exact arithmetic the steps are about N.)
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

static size_t number_of(const ladder_rung *rung) {
  return (size_t)(rung - ladder_rung_at(0));
}

static carom_status solve(const ladder_module *module, const ladder_rung *rung,
                          const carom_impact *in, const carom_options *opt, carom_result *out) {
  const carom_status bad = carom_check(in, opt, NULL);
  if (bad != CAROM_OK)
    return bad;
  if (in->a.mass != in->b.mass)
    return CAROM_ERROR_MASSES_DIFFER;
  const carom_frame frame = carom_frame_of(in);
  if (frame.distance == 0.0)
    return CAROM_ERROR_COINCIDENT;
  if (isinf(frame.distance))
    return CAROM_ERROR_OVERFLOW;
  carom_local local = carom_to_frame(&frame, in, opt->slip);
  if (local.v_jy - local.v_iy >= 0.0) {
    carom_copy_state(in, out);
    return CAROM_SEPARATING;
  }
  if (!representable(&local))
    return CAROM_ERROR_OVERFLOW;
  if (!resolved(&local, carom_steps(opt), rung->precision))
    return CAROM_ERROR_TOO_SLOW;
  module->run[number_of(rung)](&local, carom_steps(opt));
  carom_from_frame(&frame, &local, out);
  return carom_result_is_finite(out) ? CAROM_OK : CAROM_ERROR_OVERFLOW;
}

carom_status ladder_resolve(const ladder_module *module, const ladder_rung *rung,
                            const carom_impact *in, const carom_options *opt, carom_result *out) {
  const carom_options defaults = {0};
  if (in == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = solve(module, rung, in, opt != NULL ? opt : &defaults, out);
  if (status < 0)
    carom_fill_nan(out);
  return status;
}
