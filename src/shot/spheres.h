/* Two spheres that collide in space: carom_impact3() and its parts. See spheres.c. */
#ifndef CAROM_SRC_SHOT_SPHERES_H
#define CAROM_SRC_SHOT_SPHERES_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

/* The speed at which the surface of ball a slips on that of b, m/s. n: unit vector from a to b;
 * positions are not read. */
double carom_spheres_slip(const carom_impact *in, const double n[3]);

/* The motion after the impact of balls that close along n. */
void carom_spheres_collide(const carom_impact *in, const double n[3], carom_result *out);

#endif
