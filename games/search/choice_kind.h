/* By which kind of stroke a choice pots, or scores. */
#ifndef CAROM_PLAN_CHOICE_KIND_H
#define CAROM_PLAN_CHOICE_KIND_H

#include "search_state.h"

/* The carom_plan_kind of a choice, by what happens. */
int32_t carom_search_kind(carom_search *search, carom_candidate *c,
                          const carom_plan_stroke *choice);

#endif
