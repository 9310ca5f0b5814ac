/* Random impacts to test the exact solver on, the same for the same seed. */
#ifndef CAROM_REFERENCE_RANDOM_IMPACTS_H
#define CAROM_REFERENCE_RANDOM_IMPACTS_H

#include "carom_shot.h"
#include "random.h"

#include "ball_ball/frame.h"

#include <stdbool.h>
#include <stdint.h>

/* Kinds of draws: collisions of play, with any speed, spin and cut that it has, mu_b <= 0.2, mu
 * <= 0.5, e >= 0.5, masses within 1 : 2; those of regimes.c, in turn; everything that is accepted
 * at all; impacts on a cushion; and impacts of both sorts with coincidences that no draw from a
 * continuum has (coincidences.c). Groups are the slips, kinds of cushions and of coincidences. */
typedef enum draw_kind {
  DRAW_REALISTIC,
  DRAW_REGIMES,
  DRAW_EXTREME,
  DRAW_CUSHION,
  DRAW_COINCIDENCES
} draw_kind;
#define DRAW_KIND_NAMES "realistic|regimes|extreme"

/* An impact of two balls, or of a ball and a cushion. */
typedef struct drawn {
  bool cushion, of_play; /* of_play: for which carom.h promises 1e-6 */
  carom_slip slip;
  carom_impact balls;
  carom_cushion_impact rail;
} drawn;

int draw_groups(draw_kind kind);
const char *draw_name(draw_kind kind, int group);

/* Draw number `k` of a group, the same for the same seed. Nearly all approach. */
drawn draw(draw_kind kind, int group, uint64_t seed, uint64_t k);

/* What carom.h calls a collision of play. */
bool is_of_play(const carom_impact *in);

/* Collision number `k` of one of the first three kinds, for a slip. */
carom_impact draw_collision(draw_kind kind, carom_slip slip, uint64_t seed, uint64_t k);

/* Kinds of random impacts: those of play (nose 1.2 to 1.45 R, friction 0.1 to 0.4, e 0.6 to 1,
 * spins to 100 rad/s), and any (nose 0.05 to 1.95 R, friction and e 0 to 1, spins to 300 rad/s),
 * with every angle, rolling and perpendicular ones among them. All approach. */
typedef enum cushion_draw { CUSHION_PLAY, CUSHION_ANY, CUSHION_DRAWS } cushion_draw;
carom_cushion_impact draw_cushion(cushion_draw kind, uint64_t seed, uint64_t k);

/* Those of coincidences.c. */
int coincidence_kinds(void);
const char *coincidence_name(int kind);
drawn coincidence_draw(int kind, uint64_t seed, uint64_t k);

/* Collisions by named regime (regimes.c). */
int regimes_count(void);
const char *regimes_name(int regime);

/* One random collision of the regime that suits the slip sign s. */
carom_impact regimes_draw(int regime, double s, lab_random *rng);

/* A collision of the frame of ball_ball/frame.h, its line of centres turned from the y axis by
 * an angle, rad. */
carom_impact draw_turned(const carom_local *c, double angle);

/* The same collision seen from the other side, the second ball named first. */
carom_local draw_exchanged(const carom_local *c);

/* Gives a ball the velocity (v_x, v_y), the share `roll` of the spin of rolling (1 rolls, 0
 * slides, -1 spins backward) and the surface speed `side` of side spin. */
void draw_ball(carom_local *c, bool second, double v_x, double v_y, double roll, double side);

/* Largest difference of v and R w, over the largest of them before the impact. */
double cushion_distance(const carom_cushion_impact *in, const carom_motion *a,
                        const carom_motion *b);

#endif
