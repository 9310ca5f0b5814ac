/* The strike of a cue. See strike.c. */
#ifndef CAROM_SRC_MOTION_STRIKE_H
#define CAROM_SRC_MOTION_STRIKE_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

#include <stdbool.h>

/* The restitution of the tip. Where it is 0, which stands for 1, its derivative is that of 1. */
static inline double carom_tip_of(const carom_cue *cue) {
  return cue->tip_restitution == 0.0 ? 1.0 + cue->tip_restitution : cue->tip_restitution;
}

/* How much faster a cue is than one whose tip loses nothing, and which strikes as hard. */
static inline double carom_tip_gain(const carom_cue *cue) {
  return 2.0 / (1.0 + carom_tip_of(cue));
}

/* The numbers of a cue, apart from its ball; the speed V that it gives a ball; and carom_strike()
 * of a cue and a ball that have been checked, in space with the part of the blow that goes down. */
carom_status carom_check_cue(const carom_cue *cue);
double carom_speed_of_blow(const carom_cue *cue, const carom_ball_kind *kind);
carom_status carom_blow(const carom_cue *cue, const carom_ball_kind *kind, bool in_space,
                        carom_motion *out);

#endif
