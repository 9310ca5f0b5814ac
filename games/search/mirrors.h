/* Ways of a mirror: banks, kicks and combinations. */
#ifndef CAROM_PLAN_MIRRORS_H
#define CAROM_PLAN_MIRRORS_H

#include "candidates.h"

/* Adds up to `most` strokes of the likeliest banks, kicks and combinations. They still have to be
 * steered. */
void carom_search_mirrors(carom_search *search, int64_t most);

#endif
