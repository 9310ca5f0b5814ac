/* Numbers of value.c, fitted to racks that were played: rows of `carom-lab learn`. */
#ifndef CAROM_SRC_PLAN_LEARNED_H
#define CAROM_SRC_PLAN_LEARNED_H

#include "plan/view.h"

typedef struct learned {
  double next[NEXT_NUMBERS], later[LATER_NUMBERS], first[FIRST_NUMBERS];
  double mean;    /* of x[2] */
  double stretch; /* of the log-odds of a value: carom-lab plan --games tells it */
} learned;

/* of eight-ball, and of games in which both have the same balls */
static const learned learned_of[2] = {
    {/* of 373666 strokes: carom-lab learn --rules eightball --racks 100000 --shots 200 --seed 0;
        first: --racks 6144 */
     /* log-likelihood of a stroke -0.2843; of one number for all, -0.4119 */
     .next = {-0.140, -0.789, 1.937, 1.886, -0.086, -0.232, 0.634},
     /* log-likelihood of a stroke -0.3127; of one number for all, -0.3725 */
     .later = {1.729, -1.130, 0.0, 0.695},
     /* log-likelihood of a stroke -0.5080; of one number for all, -0.5484 */
     .first = {2.254, -1.145, 0.0},
     .mean = 0.619,
     .stretch = 1.0},
    {/* of 18459 strokes: carom-lab learn --rules nineball --racks 6144 --shots 200 --seed 0 */
     /* log-likelihood of a stroke -0.3021; of one number for all, -0.4525 */
     .next = {0.156, -1.092, 1.374, 1.374, 0.000, 0.156, -0.076},
     /* log-likelihood of a stroke -0.2170; of one number for all, -0.2813 */
     .later = {1.788, -1.548, 0.951, 0.353},
     /* log-likelihood of a stroke -0.5945; of one number for all, -0.6557 */
     .first = {1.032, -1.034, 1.755},
     .mean = 0.728,
     .stretch = 1.4},
};

#endif
