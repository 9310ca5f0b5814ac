/* Reference solutions of one impact, for the study and for tests: slow, plain, and independent of
 * core/src/ (reference.c); and those of the precise solver (precisely.c). */
#ifndef CAROM_LAB_REFERENCE_H
#define CAROM_LAB_REFERENCE_H

#include "carom_shot.h"

#include <stdbool.h>

/* How a reference solution ended. */
typedef enum reference_status {
  REFERENCE_OK,
  REFERENCE_SEPARATING, /* nothing approaches; the motion is that before */
  REFERENCE_ROUNDING,   /* the result depends on rounding errors of the input: it is given, but
                           not to be relied on */
  REFERENCE_FAILED,     /* the integration did not end, or its tolerances disagree */
} reference_status;

/* One impact that is known to be valid. normal, unless it is NULL: the normal impulse, and the work
 * of the normal force over compression. */
reference_status reference_collide(const carom_impact *in, carom_slip slip, carom_result *out,
                                   double normal[2]);
reference_status reference_cushion(const carom_cushion_impact *in, carom_motion *out);

/* The same impacts by the precise solver of core/src/contact_law alone, for comparison with calls.
 * They approach. tolerance: see contact_law/impact.h; calls leave collisions of two balls to
 * PRECISELY. An error: that of the solver. */
#define PRECISELY 1e-3
carom_status collide_precisely(const carom_impact *in, carom_slip slip, double tolerance,
                               carom_result *out);
carom_status cushion_precisely(const carom_cushion_impact *in, double tolerance, carom_motion *out);

#endif
