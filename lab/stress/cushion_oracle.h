/* The judge of the cushion's exact limit: the model's impulses integrated in long double, with no reduction. See
 * cushion_oracle.c. */
#ifndef CAROM_LAB_CUSHION_ORACLE_H
#define CAROM_LAB_CUSHION_ORACLE_H

#include "carom_shot.h"

#include <stdint.h>

/* Solves one impact that is known to be good. CAROM_OK, CAROM_SEPARATING, or CAROM_ERROR_UNRESOLVED where it gives up. */
carom_status cushion_oracle(const carom_cushion_impact *in, carom_motion *out);

/* Kinds of random impacts: those of play (nose 1.2 to 1.45 R, friction 0.1 to 0.4, e 0.6 to 1, spins to 100 rad/s), and any
 * (nose 0.9 to 1.6 R, friction and e 0 to 1, spins to 300 rad/s), with every angle, rolling and perpendicular ones among them.
 */
typedef enum cushion_draw { CUSHION_PLAY, CUSHION_ANY, CUSHION_DRAWS } cushion_draw;

/* Impact number `k` of a kind, the same for the same seed. All approach. */
carom_cushion_impact draw_cushion(cushion_draw kind, uint64_t seed, uint64_t k);

/* Largest difference of v and R w, over the largest of them before the impact. */
double cushion_distance(const carom_cushion_impact *in, const carom_motion *a, const carom_motion *b);

#endif
