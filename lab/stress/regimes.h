/* Random collisions by named regime, the same for the same seed. */
#ifndef CAROM_LAB_REGIMES_H
#define CAROM_LAB_REGIMES_H

#include "carom.h"
#include "random.h"

int regimes_count(void);
const char *regimes_name(int regime);

/* One random collision of the regime that suits the slip sign s. */
carom_impact regimes_draw(int regime, double s, lab_random *rng);

#endif
