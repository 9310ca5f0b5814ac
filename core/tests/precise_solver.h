/* The precise solver instead of the fast one, whose rounding in single precision spoils
 * differences: while `precisely` is set, in programs that are linked with --wrap=carom_collide
 * and --wrap=carom_cushion_solve. */
#ifndef CAROM_TESTS_PRECISE_SOLVER_H
#define CAROM_TESTS_PRECISE_SOLVER_H

#include "carom_shot.h"

#include <stdbool.h>

carom_status __real_carom_collide(const carom_impact *in, const carom_options *opt,
                                  carom_result *out);
carom_status __wrap_carom_collide(const carom_impact *in, const carom_options *opt,
                                  carom_result *out);
static bool precisely;

carom_status __wrap_carom_collide(const carom_impact *in, const carom_options *opt,
                                  carom_result *out) {
  if (!precisely)
    return __real_carom_collide(in, opt, out);
  carom_trace_point points[2];
  const carom_status status = carom_trace(in, opt, 2, points);
  *out = points[1].state;
  return status;
}

carom_status __real_carom_cushion_solve(const carom_cushion_impact *in,
                                        const carom_cushion_options *opt, carom_motion *out);
carom_status __wrap_carom_cushion_solve(const carom_cushion_impact *in,
                                        const carom_cushion_options *opt, carom_motion *out);

carom_status __wrap_carom_cushion_solve(const carom_cushion_impact *in,
                                        const carom_cushion_options *opt, carom_motion *out) {
  if (!precisely || opt == NULL || opt->model != CAROM_CUSHION_MATHAVAN)
    return __real_carom_cushion_solve(in, opt, out);
  carom_cushion_point points[2];
  precisely = false; /* carom_cushion_trace() calls this, too */
  const carom_status status = carom_cushion_trace(in, opt, 2, points);
  precisely = true;
  *out = points[1].state;
  return status;
}

#endif
