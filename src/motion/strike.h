/* The strike of a cue. See strike.c. */
#ifndef CAROM_SRC_MOTION_STRIKE_H
#define CAROM_SRC_MOTION_STRIKE_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

/* The numbers of a cue, apart from its ball; and carom_strike() with the part of the blow that
 * goes down. */
carom_status carom_check_cue(const carom_cue *cue);
carom_status carom_strike_in_space(const carom_cue *cue, const carom_ball_kind *kind,
                                   carom_motion *out);

#endif
