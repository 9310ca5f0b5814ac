/* Choices: the results of candidates, and which of them a plan lists. */
#ifndef CAROM_PLAN_LISTING_H
#define CAROM_PLAN_LISTING_H

#include "search_state.h"

/* The result of a candidate. */
carom_plan_stroke carom_search_choice(const carom_search *search, const carom_candidate *c);
/* Puts the candidates behind the best, search->listed with it, that may be listed: one for each
 * pocket and kind, and some safeties. Continues where the last slice ended, from candidate
 * search->examined on. Returns whether it is done. */
bool carom_search_list(carom_search *search);
/* Writes up to `room` choices of those that are listed, the best first. Returns their number. */
int carom_search_give(carom_search *search, carom_plan_stroke *choices, int room);

#endif
