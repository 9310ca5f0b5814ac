/* How wide a pot is over places of the cue ball: the same ball and pocket at each cut and from each
 * distance, with each stroke. */
#ifndef CAROM_CLI_WIDE_H
#define CAROM_CLI_WIDE_H

#include "shoot_flags.h"
#include "ways.h"

/* Which of the numbers are asked for; what has one value is the same for all. */
typedef struct wide_job {
  const values *cut, *distance;
  const shoot_flags *from; /* speeds, tips and elevations, in the order of the search's strokes */
  int quantity;            /* of curves: FALLS, CHANCE or WINDOW */
} wide_job;

enum { FALLS, CHANCE, WINDOW };

/* Finds the direct pots of the search's ball and pocket as ways, in the order of cuts, distances
 * and strokes; `line` is the search's, whose cue ball is moved. Those that cannot be played are
 * left out, and counted on stderr. False after a complaint. */
bool wide_find(const wide_job *job, shot_line *line, ways_search *s);

/* Draws a quantity over the number that is a range, a curve for each combination of the others;
 * false after a complaint. */
/* over a range, */
bool wide_has_range(const wide_job *job);
bool wide_plot(const wide_job *job, const ways_search *s, const char *path);

#endif
