/* Plans that may be stopped, which continue by rounds of twice as many shots. */
#ifndef CAROM_PLAN_ANYTIME_H
#define CAROM_PLAN_ANYTIME_H

#include "search_state.h"

/* Whether a plan doubles, as it may be stopped. */
bool carom_search_doubles(const carom_search *search);
/* Begins a plan of so many shots: at once, or by rounds, of which the first has `first`. */
void carom_search_begin_doubling(carom_search *search, int64_t first, int64_t shots);
/* Ends a round: true if the next one has begun; else the best so far is the first, and
 * search->best. */
bool carom_search_double(carom_search *search);

#endif
