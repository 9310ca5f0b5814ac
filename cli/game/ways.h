/* The ways to pot a ball of a layout, to score in three-cushion, or to bring the cue ball to a
 * place. See ways.c. */
#ifndef CAROM_CLI_WAYS_H
#define CAROM_CLI_WAYS_H

#include "carom_plan.h"
#include "program/options.h"
#include "shots/shot_file.h"

enum { MOST_WAYS = 20000, MOST_PARTS = 12 };

/* What the ways of a search do: pot a ball, score, or bring the cue ball to a place. */
typedef enum way_aim { TO_POT, TO_SCORE, TO_PLACE } way_aim;

/* A way: the rails and balls that are met in their order, and its best stroke. NAN: not known. */
typedef struct way {
  int kind;         /* a carom_plan_kind; -1 of a point and a place */
  int ball, pocket; /* as much */
  int parts;
  carom_part part[MOST_PARTS];
  carom_cue cue;
  double cut, phi[2], speed[2]; /* as in carom_pot */
  double chance, error;         /* of a player, and its standard error */
  int64_t found;                /* of the strokes in all directions */
  /* of these: its run of neighbouring directions, and the longest one with its end */
  int64_t last, run, longest;
  double end;
  int stroke; /* of the search's */
} way;

/* What is searched, and what was found. */
typedef struct ways_search {
  const shot_line *line;
  carom_shot_options options;
  carom_player player;
  const carom_cue *stroke; /* each is tried in all directions */
  int strokes;
  way_aim aim;      /* what strokes in all directions are read for */
  int ball, pocket; /* of pots; -1: any */
  int rails;        /* at most, of pots and places */
  int scan;         /* strokes in all directions, of all strokes together, at least 1 for each */
  bool each;        /* whether a pot is a way of its own by each stroke */

  /* the cue ball shall end within `radius`, m, of a place, where it is above 0 */
  double place[2], radius;

  way *way; /* with room for MOST_WAYS */
  int ways;
  int64_t scanned, good;
  int64_t left_out; /* good strokes for which there was no room */
} ways_search;

/* "bank", "point", "place": what a way does. */
const char *way_name(const ways_search *s, const way *w);

/* Makes the player; complains and returns false where both are given. Without either, errors of
 * scale 1. */
bool player_of(const given_player *options, carom_player *player);

/* Lets a player strike as slowly, as hard and as far from the centre as he is asked to. */
void without_bounds(carom_player *player);

/* Whether a shot pots the ball of a way without losing the cue ball, or scores: both balls met, the
 * second one after three cushions; and whether the cue ball ends where it shall. */
bool way_is_good(const ways_search *s, const carom_facts *f, const carom_ball_state *final,
                 const way *w);

/* The share of the player's strokes that are good, with its error; false after a complaint. */
bool ways_chance(const ways_search *s, way *w);

/* Finds the ways, those of pots first; false after a complaint. */
bool ways_find(ways_search *s);

#endif
