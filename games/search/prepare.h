/* A search before its first candidate. */
#ifndef CAROM_PLAN_PREPARE_H
#define CAROM_PLAN_PREPARE_H

#include "search_state.h"

/* The options of a caller, or the defaults for NULL; whether they are valid; and how many shots
 * they request. */
const carom_plan_options *carom_search_options(const carom_plan_options *options);
carom_status carom_search_check_options(const carom_plan_options *o);
int64_t carom_search_shots(const carom_plan_options *o);
/* The fraction of the shots that the scan has. */
double carom_scan_of(const carom_plan_options *o);
/* The bytes of a plan on a known table, which may search leaves; and those for its leaves, with
 * room for its trails, of which it has no use later. */
size_t carom_search_memory(const carom_plan_options *options, bool searches_leaves);
size_t carom_leaves_memory(bool searches);
/* Whether a job has all that it must point to. */
bool carom_search_is_whole(const carom_plan_job *job);
/* Whether rules have their functions, and numbers that this version knows. */
bool carom_search_has_good_rules(const carom_plan_rules *rules);
/* Checks a layout, with the cue; and the cue with the stroke of another one. */
carom_status carom_search_check(carom_search *search, const carom_shot_ball *balls, bool with_cue);
carom_status carom_search_check_stroke(const carom_search *search, const carom_cue *stroke);
/* Makes a search, in memory that suffices. */
carom_status carom_search_make(carom_search *search, const carom_plan_job *job, bool in_hand,
                               int choices);
/* The value of a foul at the first contact, which leaves about the layout that there is. */
double carom_search_foul_value(const carom_search *search);

#endif
