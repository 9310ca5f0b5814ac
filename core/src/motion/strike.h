/* The strike of a cue. See strike.c. */
#ifndef CAROM_SRC_MOTION_STRIKE_H
#define CAROM_SRC_MOTION_STRIKE_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

#include <math.h>
#include <stdbool.h>

/* The restitution of the tip. If it is 0, which means 1, its derivative is the derivative at 1. */
static inline double carom_tip_of(const carom_cue *cue) {
  return cue->tip_restitution == 0.0 ? 1.0 + cue->tip_restitution : cue->tip_restitution;
}

/* How long the tip touches a single, free ball, s. */
static inline double carom_tip_time(const carom_cue *cue) {
  return cue->tip_time > 0.0 ? cue->tip_time : CAROM_TIP_TIME;
}

/* How much faster a cue is than one whose tip loses nothing, and which strikes as hard. */
static inline double carom_tip_gain(const carom_cue *cue) {
  return 2.0 / (1.0 + carom_tip_of(cue));
}

/* The offset at which a chalked tip slips, in radii, and the largest with which the friction of a
 * tip is computed: beyond, it would grow without a limit. */
#define CAROM_CHALKED_OFFSET 0.55
#define CAROM_MOST_SLIP_OFFSET 0.9

/* The friction of the tip and a ball that it touches again, by the offset a at which the tip slips:
 * a/sqrt(1 - a^2). A cue without a miscue, up to 0.9, has the offset of a chalked tip. */
static inline double carom_tip_friction(const carom_cue *cue) {
  const double chalked = CAROM_CHALKED_OFFSET;
  const double offset =
      cue->miscue > 0.0 && cue->miscue < CAROM_MOST_SLIP_OFFSET ? cue->miscue : chalked;
  return offset / sqrt(1.0 - offset * offset);
}

/* Whether a cue is raised, and not level. */
static inline bool carom_is_raised(const carom_cue *cue) {
  return cue->theta >= CAROM_LEAST_ELEVATION;
}

/* What happens to the downward component of the strike: in space the slate receives it; on the
 * cloth it is lost, or squirt turns the rest of the strike, as in pooltool. */
typedef enum carom_strike_kind {
  CAROM_STRIKE_IN_SPACE,
  CAROM_STRIKE_ON_CLOTH,
  CAROM_STRIKE_TURNED
} carom_strike_kind;

/* The numbers of a cue, apart from its ball; the speed V that it gives a ball; and carom_strike()
 * of a cue and a ball that have been checked. */
carom_status carom_check_cue(const carom_cue *cue);
double carom_strike_speed(const carom_cue *cue, const carom_ball_kind *kind);
carom_status carom_strike_motion(const carom_cue *cue, const carom_ball_kind *kind,
                                 carom_strike_kind how, carom_motion *out);

#endif
