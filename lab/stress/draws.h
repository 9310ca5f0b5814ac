/* Random collisions to test the exact solver on, the same for the same seed. */
#ifndef CAROM_LAB_DRAWS_H
#define CAROM_LAB_DRAWS_H

#include "carom_shot.h"

#include <stdbool.h>
#include <stdint.h>

/* Kinds of collisions: those of play, with any speed, spin and cut that it has, mu_b <= 0.2, mu
 * <= 0.5, e >= 0.5, masses within 1 : 2; those of regimes.h, in turn; and everything that is
 * accepted at all. */
typedef enum draw_kind { DRAW_REALISTIC, DRAW_REGIMES, DRAW_EXTREME, DRAW_KINDS } draw_kind;
#define DRAW_KIND_NAMES "realistic|regimes|extreme"

/* Collision number `k` of a kind, for a slip. Nearly all approach. */
carom_impact draw_collision(draw_kind kind, carom_slip slip, uint64_t seed, uint64_t k);

/* Kinds of random impacts: those of play (nose 1.2 to 1.45 R, friction 0.1 to 0.4, e 0.6 to 1,
 * spins to 100 rad/s), and any (nose 0.9 to 1.6 R, friction and e 0 to 1, spins to 300 rad/s),
 * with every angle, rolling and perpendicular ones among them.
 */
typedef enum cushion_draw { CUSHION_PLAY, CUSHION_ANY, CUSHION_DRAWS } cushion_draw;

/* Impact number `k` of a kind, the same for the same seed. All approach. */
carom_cushion_impact draw_cushion(cushion_draw kind, uint64_t seed, uint64_t k);

/* Largest difference of v and R w, over the largest of them before the impact. */
double cushion_distance(const carom_cushion_impact *in, const carom_motion *a,
                        const carom_motion *b);

#endif
