/* The search for jumps: one number of a recipe moves, and the shots on both sides of a step are
 * compared. */
#ifndef CAROM_REFERENCE_SWEEP_H
#define CAROM_REFERENCE_SWEEP_H

#include "jumps.h"

/* m/s and m: smaller changes are no jumps. Above the step of a square root between neighbours. */
#define SWEEP_LEAST 1e-6

/* Plays the recipe with a number at x, which it keeps. False as for recipe_play(). */
bool sweep_play(recipe *r, const recipe_number *number, double x, played *p);

/* Halves the interval between the shots `low` and `high` towards the greater change. Of a smooth
 * result the change halves too. Of a square root, as at a graze, it falls by 0.7. The search ends
 * where three halvings leave less than a fifth of the change, or where the change is below
 * SWEEP_LEAST. Returns whether a jump is left, between two neighbouring doubles. */
bool sweep_halve(recipe *r, const recipe_number *number, played *low, played *high);

/* What a jump between two recipes changes until 5 ms after the time at which the shots part: longer
 * than tip, slate and balls touch. */
#define SWEEP_SHORTLY 5e-3
difference sweep_size(const recipe *low, const recipe *high, double time);

#endif
