/* The rows of a stage: shots of candidates, and what they are worth. */
#ifndef CAROM_PLAN_ROWS_H
#define CAROM_PLAN_ROWS_H

#include "search_state.h"

/* Makes the balls in play of a layout the balls of shots. */
void carom_search_lay_out(carom_search *search, const carom_shot_ball *balls);
/* Sets the next stage: candidates from the one of index `first` on, `each` times with the errors of
 * these draws; 0: without errors. */
void carom_search_stage(carom_search *search, int64_t first, int64_t candidates, int64_t each,
                        uint32_t draws);
/* Plays rows of the stage, whose outcomes are in the order of the rows. Returns whether the stage
 * is done: all rows are played, or those before the plan was stopped, at least one. It is not done
 * where the slice has ended. */
bool carom_search_play(carom_search *search);
/* Takes the cost of a shot with so many events from the slice. */
void carom_search_spend(carom_search *search, int64_t events);
/* The layout of a row of a candidate, whose cue ball is where it is put; draws above 0: as the
 * player may see it. */
carom_prepared carom_search_layout(const carom_search *search, const carom_candidate *c,
                                   uint32_t draws, int64_t row,
                                   carom_ball_state drawn[CAROM_BALLS_MOST]);
/* The stroke of a candidate, with the errors of a row; draws 0: without errors. */
carom_cue carom_search_stroke(const carom_search *search, const carom_candidate *c, uint32_t draws,
                              int64_t row);
/* Whether a stroke of the scan met a ball first that is on. */
bool carom_search_begins_well(const carom_search *search, int first);
/* Whether a stroke of the scan, or one near the best, may be a candidate after its shot without
 * errors. */
bool carom_search_may_join(const carom_search *search, const carom_outcome *o);
/* The work of a shot with facts, in events. */
uint16_t carom_search_work(const carom_shot *shot);
/* The value of what a turn leaves, for the player who made it: the points of a single player, or
 * the value of the layout to the next player. Plans, fouls, passes, reasons, breaks and reviews all
 * take it from here. */
double carom_search_leave(const carom_search *search, const carom_rules_state *game,
                          const carom_ball_state *layout, const carom_turn *turn);
/* The worth of a stroke that was ruled: of its turn, or of what it leaves. */
double carom_search_ruled(const carom_search *search, const carom_ruling *ruling);
/* Points as a fraction of the balls left before the shot. */
double carom_search_share(const carom_search *search, double points);

#endif
