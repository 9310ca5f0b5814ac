/* Random impacts with coincidences that no draw from a continuum has, the same for the same
 * seed. */
#ifndef CAROM_LAB_COINCIDENCES_H
#define CAROM_LAB_COINCIDENCES_H

#include "carom_shot.h"

#include <stdbool.h>
#include <stdint.h>

/* An impact of two balls, or of a ball and a cushion. */
typedef struct coincidence {
  bool cushion, of_play; /* of_play: for which carom.h promises 1e-6; for cushions nose 1.2 to
                            1.45 R, mu to 0.4, e from 0.5 */
  carom_slip slip;
  carom_impact balls;
  carom_cushion_impact rail;
} coincidence;

int coincidence_kinds(void);
const char *coincidence_name(int kind);
bool coincidence_of_cushion(int kind);

/* Draw number `k` of a kind. Nearly all approach. */
coincidence coincidence_draw(int kind, uint64_t seed, uint64_t k);

#endif
