/* regimes.h - random collisions by named regime, the same for the same seed. */
#ifndef CAROM_TESTS_REGIMES_H
#define CAROM_TESTS_REGIMES_H
#include "carom.h"
#include <stdint.h>

typedef struct regimes_rng {
  uint64_t state;
} regimes_rng;
double regimes_uniform(regimes_rng *rng, double low, double high);

int regimes_count(void);
const char *regimes_name(int regime);
/* One random collision of the regime that suits the slip sign s. */
carom_impact regimes_draw(int regime, double s, regimes_rng *rng);
#endif
