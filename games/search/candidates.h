/* The strokes that a search tries. */
#ifndef CAROM_PLAN_CANDIDATES_H
#define CAROM_PLAN_CANDIDATES_H

#include "search_state.h"

/* Makes direct pots, up to `most` of them, with the stage that aims them. */
void carom_search_pots(carom_search *search, int64_t most);
/* Keeps those that could be aimed. */
void carom_search_aimed(carom_search *search);
/* Makes the next block of strokes in all directions, with its stage; false where there are enough
 * of them. */
bool carom_search_scan(carom_search *search);
/* Takes those that were played and begin without a foul. */
void carom_search_scanned(carom_search *search);
/* Makes strokes near the best `parents`. */
void carom_search_near(carom_search *search, int64_t parents);
/* Makes strokes of a break, instead of pots and scan. */
void carom_search_breaks(carom_search *search, int64_t most);
void carom_search_add(carom_search *search, carom_candidate c);

#endif
