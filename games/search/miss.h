/* How far a stroke misses a pocket or a ball, and how it is turned until it does not. */
#ifndef CAROM_PLAN_MISS_H
#define CAROM_PLAN_MISS_H

#include "search_state.h"

/* Finds what the strokes of a plan aim at: search->cushions and search->deciding. */
void carom_search_find_goals(carom_search *search);
/* Whether a plan steers strokes: not with ball in hand, in breaks, and for safeties. */
bool carom_search_is_steered(const carom_search *search);
/* The least miss of a shot without errors of a candidate, with its slope where it is near. The
 * path has the shot's events, and is overwritten. */
carom_miss carom_search_measure(const carom_search *search, const carom_candidate *c,
                                carom_trail *path, int64_t count);
/* Whether a turn of the cue that keeps to the same contacts may end a miss. */
bool carom_search_is_in_reach(const carom_miss *m);
/* Whether a stroke hits its goal well. */
bool carom_search_is_good(const carom_miss *m);
/* Turns a candidate until it does not miss the goal of c->miss; false where it cannot. */
bool carom_search_turn(const carom_search *search, carom_candidate *c, carom_trail *path);
/* What a stroke is worth that reaches its goal with a chance, and is worth so much there. */
double carom_search_expected(const carom_search *search, double chance, double worth);
/* The worth of a candidate on its way, which is worth so much without errors. */
double carom_search_worth(const carom_search *search, const carom_candidate *c, double worth);

#endif
