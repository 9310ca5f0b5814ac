/* Friction between two balls by a law of its speed. */
#ifndef CAROM_SRC_BALL_BALL_FRICTION_H
#define CAROM_SRC_BALL_BALL_FRICTION_H

#include "carom.h"
#include "platform/elementary.h"

/* The coefficient where the balls slip on each other at u, m/s. */
static inline double carom_friction_at(const carom_speed_law *law, double u) {
  return law->a + law->b * carom_exp(-law->c * u);
}

#endif
