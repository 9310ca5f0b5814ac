/* Positions of a cue ball in hand. */
#ifndef CAROM_PLAN_PLACES_H
#define CAROM_PLAN_PLACES_H

#include "search_state.h"

/* Finds the first position from which strokes are candidates, by the caller's bounds, or NULL.
 * False where there is none. */
bool carom_search_find_place(carom_search *search, const double low[2], const double high[2]);
/* Finds the others. These are the best of random positions by the value of the layout; for a break
 * they are on the upper edge. Returns whether it is done; it is not where the slice has ended. */
bool carom_search_find_places(carom_search *search);
/* Lays the balls out with the cue ball in hand at r, for what is made next; a cue ball that is not
 * in hand stays. False where rules or balls do not allow the position. */
bool carom_search_put(carom_search *search, const double r[2]);
/* Lays the balls out with the cue ball on the next of the positions. */
void carom_search_next_place(carom_search *search);

#endif
