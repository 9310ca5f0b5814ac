/* The ways to pot a ball of a layout, to score in three-cushion, or to bring the cue ball to a
 * place, as the library finds them. */
#ifndef CAROM_CLI_WAYS_H
#define CAROM_CLI_WAYS_H

#include "program/options.h"
#include "shots/shot_file.h"

#include "carom_coach.h"

enum { MOST_WAYS = 20000 };

typedef carom_shot_way way;

/* What is searched, and what was found. */
typedef struct ways_search {
  const shot_line *line;
  carom_shot_options options;
  carom_player player;
  carom_ways_job job; /* its table, balls, count, cues, player and options are of the others */
  way *way;           /* with room for MOST_WAYS */
  carom_ways_result result;
} ways_search;

/* "bank", "point", "place": what a way does. */
const char *way_name(const ways_search *s, const way *w);

/* Makes the player; complains and returns false where both are given. Without either, errors of
 * scale 1. */
bool player_of(const given_player *options, carom_player *player);

/* Lets a player strike as slowly, as hard and as far from the centre as he is asked to. */
void without_bounds(carom_player *player);

/* Gives the job the line, with memory for so many ways, to be freed. */
void ways_begin(ways_search *s, const carom_cue *cues, int strokes, int room);

/* The share of the player's strokes that are good, with its error; false after a complaint. */
bool ways_chance(const ways_search *s, way *w);

/* Finds the ways, those of pots first; false after a complaint. */
bool ways_find(ways_search *s);

#endif
