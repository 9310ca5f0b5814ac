/* Random collisions by named regime, the same for the same seed. */
#ifndef CAROM_LAB_REGIMES_H
#define CAROM_LAB_REGIMES_H

#include "carom.h"
#include "random.h"

#include "ball_ball/frame.h"

#include <stdbool.h>

int regimes_count(void);
const char *regimes_name(int regime);

/* One random collision of the regime that suits the slip sign s. */
carom_impact regimes_draw(int regime, double s, lab_random *rng);

/* A collision of the frame of ball_ball/frame.h, its line of centres turned from the y axis by
 * an angle, rad. */
carom_impact draw_turned(const carom_local *c, double angle);

/* The same collision seen from the other side, the second ball named first. */
carom_local draw_exchanged(const carom_local *c);

/* Gives a ball the velocity (v_x, v_y), the share `roll` of the spin of rolling (1 rolls, 0
 * slides, -1 spins backward) and the surface speed `side` of side spin. */
void draw_ball(carom_local *c, bool second, double v_x, double v_y, double roll, double side);

#endif
