/* The stages of a search, from its first candidates to the best one. */
#ifndef CAROM_PLAN_SEARCH_H
#define CAROM_PLAN_SEARCH_H

#include "search_state.h"

/* Begins all stages with so many shots. */
void carom_search_begin(carom_search *search, int64_t shots);
/* Continues them. Returns whether the end is reached, where the best candidate is the first. */
bool carom_search_run(carom_search *search);
/* The fingerprint of a job and of all that it points to but its memory. */
uint64_t carom_fingerprint_of_job(const carom_plan_job *job);

#endif
