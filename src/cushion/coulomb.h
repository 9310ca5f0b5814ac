/* Coulomb's law at the two contacts of a ball with cushion and cloth. See coulomb.c. */
#ifndef CAROM_SRC_CUSHION_COULOMB_H
#define CAROM_SRC_CUSHION_COULOMB_H

#include "platform/arithmetic.h"

#include <stdbool.h>

typedef struct carom_vector {
  double x, y; /* at the nose y stands for t */
} carom_vector;

/* What does not change during the impact. */
typedef struct carom_coulomb {
  double sine, cosine, mu_s, mu_w;
  double k_x, k_t, k_y; /* 1 - 5/2 sin, 5/2 + sin^2, 5/2 - sin: see coulomb.c */
} carom_coulomb;

/* What each contact does. The cloth is loaded where g > 0; without load its slip means nothing. */
typedef struct carom_regime {
  bool nose_sticks, cloth_sticks, loaded;
  carom_vector nose, cloth; /* directions in which a slip of 0 is about to begin, length 1 */
} carom_regime;

/* Slips, or their rates. */
typedef struct carom_slips {
  carom_vector s, c;
} carom_slips;

/* Frictions per unit of normal impulse, on the ball. */
typedef struct carom_friction {
  carom_vector f, F;
  double g; /* what the cloth bears */
} carom_friction;

/* The frictions of a regime; the slips give the directions at contacts that do not stick. */
carom_friction carom_friction_of(const carom_coulomb *law, const carom_regime *regime, const carom_slips *slips);

/* What they make of the slips. */
carom_slips carom_slip_rates(const carom_coulomb *law, const carom_friction *friction);

/* The direction of a slip of the size `slip` whose rate is small against what friction does: see coulomb.c. It is that at the
 * cloth or else at the nose, where `slips` must be zero; found from and put into *regime. `turning` is its rate by p, and
 * `falls` says that the slip becomes smaller. False if none is found. */
bool carom_slow_direction(const carom_coulomb *law, const carom_slips *slips, bool at_cloth, bool falls, double slip,
                          carom_vector turning, carom_regime *regime);

/* The regime that follows where the slips stand: which contacts stick, and where the others go. Slips no larger than `rest` are
 * set to zero. False if there is none. */
bool carom_decide(const carom_coulomb *law, carom_slips *slips, double rest, carom_regime *regime);

#endif
