/* Matches of two rated players. */
#ifndef CAROM_LAB_RATED_MATCH_H
#define CAROM_LAB_RATED_MATCH_H

#include "carom_match.h"

#include <stdbool.h>

/* Wilson's interval, 95 %, of a chance that occurred `wins` times in `count`. */
void lab_interval(double wins, double count, double bounds[2]);

typedef struct lab_ratings {
  carom_rules_kind rules;
  int target; /* points that win; 0: as many as the game has */
  int matches, seed, threads;
  int shots;            /* of the plans of lab_play_told() */
  const double *rating; /* of two players */
} lab_ratings;

/* Plays matches in which the players break alternately, and prints how many the first one wins.
 * Returns false if a match cannot be played, and complains. */
bool lab_play_ratings(const lab_ratings *wanted);

/* Plays them with plans of `shots` shots, and with errors of the balls' positions in each stroke,
 * as the players see them. Prints rows of CSV by kind of stroke: the chances that plans predict,
 * the results of these strokes, and the difference with its standard error by matches. Returns as
 * above. */
bool lab_play_told(const lab_ratings *wanted);

#endif
