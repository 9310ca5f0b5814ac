/* Players: the bounds of their strokes, and how their strokes differ from those that they mean. */
#ifndef CAROM_PLAN_PLAYER_H
#define CAROM_PLAN_PLAYER_H

#include "carom_plan.h"

#include <stdbool.h>

/* The least and the greatest number of shots of a player's plans. */
enum { PLAYER_SHOTS_LEAST = 100, PLAYER_SHOTS_MOST = 2000 };
/* The first number of a player that is out of its range; NULL: all are within. */
const carom_number *carom_player_wrong_number(const carom_player *player);
/* Whether the numbers of a player are within their ranges, and fit together. */
bool carom_player_is_good(const carom_player *p);
/* The player with his bounds: 0 becomes the value it represents. */
carom_player carom_player_bounded(const carom_player *player, const carom_cue *cue);
/* A stroke by a player with bounds; z are his errors in standard deviations. */
void carom_player_errs(const carom_player *player, const double z[6], carom_cue *cue);
/* The ratio of the errors of a stroke of this speed to the errors of the slowest stroke. */
double carom_player_growth(const carom_player *player, double speed);

#endif
