/* Whole impacts by the precise solver of src/impact alone, for comparison with calls. */
#ifndef CAROM_LAB_PRECISELY_H
#define CAROM_LAB_PRECISELY_H

#include "carom_shot.h"

/* Solves one impact that is known to be valid and to approach; tolerance: see impact/impact.h,
 * PRECISELY being that which calls leave collisions of two balls to. An error: that of the
 * solver. */
#define PRECISELY 1e-3
carom_status collide_precisely(const carom_impact *in, carom_slip slip, double tolerance,
                               carom_result *out);
carom_status cushion_precisely(const carom_cushion_impact *in, double tolerance, carom_motion *out);

#endif
