/* Ratings of players, and lists of numbers like them. */
#ifndef CAROM_CLI_RATINGS_H
#define CAROM_CLI_RATINGS_H

#include "program/options.h"

OPTION_SET(set_ratings); /* double[CAROM_SEATS_MOST]: 2 or more Fargo ratings; 0 behind them */
OPTION_SET(
    set_lengths); /* double[2]: how many games or sets each side needs; one number for both */

#endif
