/* The game of `carom plan`. */
#ifndef CAROM_CLI_PLAN_GAME_H
#define CAROM_CLI_PLAN_GAME_H

#include "program/options.h"
#include "shots/shot_file.h"

#include "carom_plan.h"

#include <stdbool.h>

enum { NOT_GIVEN = -1 };

typedef struct plan_game {
  int rules;             /* a carom_rules_kind */
  int group, permission; /* of their choices */
  int target, score[2];  /* 0: not given */
  int pocket;            /* the player's: 0 foot-right, 1 foot-left, or NOT_GIVEN */
  bool opening, colour, last_inning;
} plan_game;

OPTION_SET(set_score); /* int[2]: OWN,OTHER */

/* Whether the options are those of the game; complains where they are not. */
bool plan_game_fits(const plan_game *game);
/* Its rules, with the state that the options tell. */
void plan_game_state(const plan_game *game, const shot_line *line, carom_plan_rules *rules);
/* Puts the balls of a line where their numbers are, with those that are missing in a pocket; its
 * balls and names change. Complains, with false, of a ball that the game does not have, and of a
 * table without its pockets. */
bool plan_game_order(const plan_game *game, shot_line *line, const char *file);

#endif
