/* Numbers of value.c, fitted to 373666 strokes: `carom-lab learn --racks 100000 --shots 200 --seed
 * 0` made this file. */
#ifndef CAROM_SRC_PLAN_LEARNED_H
#define CAROM_SRC_PLAN_LEARNED_H

#include "plan/view.h"

/* log-likelihood of a stroke -0.2843; of one number for all, -0.4119 */
static const double next_numbers[] = {-0.140, -0.789, 1.937, 1.886, -0.086, -0.232, 0.634};

/* log-likelihood of a stroke -0.3127; of one number for all, -0.3725 */
static const double later_numbers[] = {1.729, -1.130, 0.695};

/* the mean of x[2] */
static const double usual_mean = 0.619;

#endif
