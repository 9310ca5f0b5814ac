/* Random numbers that are a function of their position in a plan, so that they do not depend on
 * threads, and the elementary functions that platform/elementary.h does not have. */
#ifndef CAROM_PLAN_RANDOM_DRAWS_H
#define CAROM_PLAN_RANDOM_DRAWS_H

#include <stdint.h>

/* of a vector, -pi to pi, rad */
double carom_angle_of(double x, double y);
double carom_asin(double x); /* |x| <= 1 */
/* x >= 0; to 1.5e-7 */
double carom_erf(double x);
/* The stages of draws. Two that shared a number would have the same draws. */
enum {
  DRAW_STROKES = 1, /* the order of the strokes of pots, */
  DRAW_SCAN,        /* those of the scan, */
  DRAW_PLACES,      /* the positions of a cue ball in hand, */
  DRAW_PLAYED,      /* the errors of a stroke that is played, outside plans, */
  DRAW_BREAKS,      /* the order of the strokes of a break, */
  DRAW_TABLES,      /* tables that are not known, */
  DRAW_REPLAY,      /* the errors of the shots that choose nothing, */
  DRAW_MIRRORS,     /* the strokes of banks, kicks and combinations, */
  DRAW_MIND,        /* whether a player thinks of nothing but potting, */
  DRAW_REASONS,     /* the errors of strokes that explain a choice, */
  DRAW_RUN_OUTS,    /* the seeds of the strokes of a run-out, */
  DRAW_LEAVES,      /* the errors of push-outs whose leaves are searched, */
  DRAW_ROUND = 16   /* and the errors of the rounds, a stage each. */
};
/* between 0 and 1, without the ends */
double carom_uniform(uint64_t seed, uint32_t stage, uint64_t row, uint32_t number);
/* two normal numbers, of the uniform ones `number` and the next; and the first six */
void carom_normal_pair(uint64_t seed, uint32_t stage, uint64_t row, uint32_t number, double z[2]);
void carom_normals(uint64_t seed, uint32_t stage, uint64_t row, double z[6]);

#endif
