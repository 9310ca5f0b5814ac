/* What the files of the coach and leaves.c share: cuts, strokes that are ruled, and what they are
 * worth. */
#ifndef CAROM_PLAN_COACH_H
#define CAROM_PLAN_COACH_H

#include "carom_plan.h"

#include <stdbool.h>

/* The angle from the way of the cue ball, just before its contact with a ball, to the line of
 * centres, degrees; above 0 to the left of the way. */
double carom_cut_at(const carom_event *contact, int cue_ball);
/* plan.c: what a stroke is worth to its player, as a plan from its layout values what it leaves. */
double carom_worth_left(const carom_plan_job *job, const carom_ruling *ruling);

/* What a shot writes, in the caller's memory, since shots need most of a small stack. */
typedef struct carom_stroke_room {
  carom_facts facts;
  carom_ball_state final[CAROM_BALLS_MOST];
} carom_stroke_room;

/* Plays a stroke of a job's layout and rules it, as the player sees its turn. The shot may have
 * room for events. */
void carom_play_stroke(const carom_plan_job *job, const carom_cue *cue, carom_call call,
                       carom_stroke_room *room, carom_shot *shot, carom_ruling *ruling);
/* The job of whoever plays next, from what a ruling leaves, with room for its rules. */
carom_plan_job carom_job_after(const carom_plan_job *job, const carom_ruling *ruling,
                               carom_plan_rules *rules);

#endif
