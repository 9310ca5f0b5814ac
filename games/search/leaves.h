/* Leaves that a plan searches: what a push-out or a pass hands over. */
#ifndef CAROM_PLAN_LEAVES_H
#define CAROM_PLAN_LEAVES_H

#include "search_state.h"

/* Removes push-outs from the candidates: rounds do not determine their value. */
void carom_leaves_collect(carom_search *search);
/* Begins with the leaves of a plan whose rounds are over. False: it may not push out or pass. */
bool carom_leaves_begin(carom_search *search);
bool carom_leaves_ended(const carom_search *search);
/* The plan from the next leave, which has not begun; NULL: not yet, or no further one. */
carom_search *carom_leaves_next(carom_search *search);
/* Takes the value of that plan, which has ended. */
void carom_leaves_take(carom_search *search);
/* Adds the best push-out and the pass as candidates. */
void carom_leaves_end(carom_search *search);

#endif
