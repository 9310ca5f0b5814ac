/* Steps while what slips has a direction. See sliding.c. */
#ifndef CAROM_SRC_CUSHION_SLIDING_H
#define CAROM_SRC_CUSHION_SLIDING_H

#include "cushion/mathavan.h"

/* Whether the present regime is one of this file. */
bool carom_sliding_applies(const carom_cushion_way *way);

/* Takes one step, whatever events are in it. */
void carom_sliding_step(carom_cushion_way *way);

/* Goes to the first event between *start, where the event function is negative, and the present point, where it is not. */
void carom_sliding_locate(carom_cushion_way *way, const carom_ode_point *start);

#endif
