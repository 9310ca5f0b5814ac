/* The exact limit by an adaptive integrator: slower than collocation, and as good as double precision allows. See fallback.c.
 */
#ifndef CAROM_SRC_BALL_BALL_FALLBACK_H
#define CAROM_SRC_BALL_BALL_FALLBACK_H

#include "ball_ball/reduced.h"
#include "carom.h"
#include "platform/integrate.h"

#include <stdbool.h>

/* A collision on its way. */
typedef struct carom_way {
  carom_integrals at; /* so far, m/s */
  double compression; /* int v_n dp up to v_n = 0, negative; so far, if that has not come */
  double restitution; /* int v_n dp since then */
  double p_stick;     /* where the balls ceased to slip on each other; NaN if they have not */
  bool in_restitution, ended;
  int evaluations; /* right-hand sides so far */
  /* of the integrator, in units of the approach */
  double approach; /* m/s */
  carom_reduced c;
  carom_ode_point point;
  double work_c; /* int v_n dp up to v_n = 0 */
  double unit;   /* p that stops a ball without friction: 1 / kappa */
} carom_way;

/* Puts a collision at its start. */
void carom_way_begin(const carom_reduced *c, carom_way *way);

/* On to p = `to`, or to the end if that comes first. CAROM_OK; or, if more than `budget` evaluations have been spent since the
 * start or the result hangs on rounding errors, CAROM_ERROR_UNRESOLVED; or CAROM_ERROR_OVERFLOW. */
carom_status carom_way_on(carom_way *way, double to, int budget);

/* To the end, at the cost that a call of carom_collide() may have. */
carom_status carom_fallback(const carom_reduced *c, carom_way *way);

#endif
