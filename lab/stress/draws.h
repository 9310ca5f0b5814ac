/* Random collisions to test the exact solver on, the same for the same seed. */
#ifndef CAROM_LAB_DRAWS_H
#define CAROM_LAB_DRAWS_H

#include "regimes.h"

#include <stdbool.h>

/* Kinds of collisions: those of play, with any speed, spin and cut that it has, mu_b <= 0.2, mu <= 0.5, e >= 0.5, masses within
 * 1 : 2; those of regimes.h, in turn; and everything that is accepted at all. */
typedef enum draw_kind { DRAW_REALISTIC, DRAW_REGIMES, DRAW_EXTREME, DRAW_KINDS } draw_kind;
#define DRAW_KIND_NAMES "realistic|regimes|extreme"

/* Collision number `k` of a kind, for a slip. Nearly all approach. */
carom_impact draw_collision(draw_kind kind, carom_slip slip, uint64_t seed, uint64_t k);

#endif
