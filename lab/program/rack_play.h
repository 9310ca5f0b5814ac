/* Racks of eight-ball, run out by a player who errs and plans. */
#ifndef CAROM_LAB_RACK_PLAY_H
#define CAROM_LAB_RACK_PLAY_H

#include "carom_plan.h"
#include "random.h"

#include <stdbool.h>

enum { RACK_BALLS = 16 };

typedef struct lab_rack {
  carom_plan_job plan; /* with memory; its balls, rules and options are those here */
  carom_shot_ball balls[RACK_BALLS];
  carom_plan_rules rules;
  carom_plan_options options;
  lab_random state;
} lab_rack;

/* The layout after the first break of a seed that pots nothing. */
void lab_rack_make(lab_rack *rack, uint64_t seed);
/* One stroke by a plan, with ball in hand or not. Gives the choice, and whether the turn was kept
 * (CAROM_TURN_KEEP, with the layout after it), won or ended. False: the plan was refused, which
 * is told. */
bool lab_rack_stroke(lab_rack *rack, bool hand, carom_choice *choice, carom_turn *turn);

#endif
