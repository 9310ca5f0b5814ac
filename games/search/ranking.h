/* What candidates are worth, and which is better. */
#ifndef CAROM_PLAN_RANKING_H
#define CAROM_PLAN_RANKING_H

#include "search_state.h"

/* Gives candidate k the outcome of its shot without errors. The best of those that have one is
 * always the first, so that a plan can be stopped at any time. */
void carom_search_take(carom_search *search, int64_t k, const carom_outcome *o);
/* Adds the outcomes of a round to its candidates. Of a round that was stopped, those count that
 * were played `each` times; of a round of one candidate all its rows. */
void carom_search_add_up(carom_search *search);
/* Adds the outcomes of shots that chose nothing to the candidates of the stage. */
void carom_search_replayed(carom_search *search);
/* Puts candidate k first if it is better than the first. */
void carom_search_lead(carom_search *search, int64_t k);
/* Sorts the first n. */
void carom_search_sort(const carom_search *search, int64_t n);

#endif
