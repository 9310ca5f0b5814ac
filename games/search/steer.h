/* Strokes that are turned until they succeed. */
#ifndef CAROM_PLAN_STEER_H
#define CAROM_PLAN_STEER_H

#include "search_state.h"

/* Makes the next strokes that are steered, with their stage; false where there are no more. */
bool carom_search_steer(carom_search *search);
/* The stage that turns the candidates from `first` on that are to be turned. */
void carom_search_steer_added(carom_search *search, int64_t first);
/* Keeps those that could be steered, with the stage that plays them. */
void carom_search_steered(carom_search *search);
/* Takes those that reach a goal. */
void carom_search_take_steered(carom_search *search);

#endif
