/* Games that are played by plans of players with errors: racks after a break, and their strokes. */
#ifndef CAROM_LAB_RACK_PLAY_H
#define CAROM_LAB_RACK_PLAY_H

#include "carom_plan.h"
#include "random.h"

#include <stdbool.h>

enum { RACK_BALLS = 22 };

/* Whether a game of the option --rules is played by two; complains where it is not. */
bool lab_game_is_played(int rules);

/* The table on which a game is played here. */
carom_table_kind lab_table_of(carom_rules_kind game);

typedef struct lab_rack {
  carom_plan_job plan; /* with memory; all that it points to is here */
  carom_table table;
  carom_cue cue;
  carom_player player;
  carom_shot_options shot;
  carom_shot_ball balls[RACK_BALLS];
  carom_plan_rules rules;
  carom_plan_options options;
  lab_random state;
  bool hand; /* whether the cue ball is in hand, by the leave of the plan */
} lab_rack;

/* The job for a game, by the options of the rack and the errors of a player; its memory is to be
 * freed. */
void lab_rack_begin(lab_rack *rack, carom_rules_kind game, double errors);
/* The layout after the first break of a seed that pots nothing, with the cue ball in hand. Of games
 * whose break is a stroke like others the rack before it. */
void lab_rack_make(lab_rack *rack, carom_rules_kind game, uint64_t seed);
/* An end game in place: so many solids, one stripe more, and the eight, or the last balls of
 * nine-ball, at random positions; the cue ball is not in hand. */
void lab_rack_end(lab_rack *rack, int left);
/* One stroke by a plan. Returns the choice and the turn; if neither has won, the rack is ready for
 * the next stroke, of the other player after a CAROM_TURN_PASS. False: the plan was rejected, which
 * is printed. */
bool lab_rack_stroke(lab_rack *rack, carom_plan_stroke *choice, carom_turn *turn);

#endif
