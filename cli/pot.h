/* The direction of a cue that makes another ball fall into a pocket, and what one may err. */
#ifndef CAROM_CLI_POT_H
#define CAROM_CLI_POT_H

#include "carom_shot.h"

typedef enum pot_result {
  POT_FOUND,
  POT_NO_CUT,  /* the ball cannot be cut to the pocket from there */
  POT_BARRED,  /* the ball of the cue meets something else first, or nothing */
  POT_MET,     /* the ball meets another one on its way */
  POT_SHORT,   /* it comes to rest before the pocket */
  POT_REJECTED /* the jaws send it back, at this speed */
} pot_result;

typedef struct pot {
  double cut;           /* degrees, above 0 to the left */
  double right, left;   /* by how much the ball may leave otherwise, degrees, to either jaw */
  double least, most;   /* speeds of the cue between which it falls with this direction, m/s */
  carom_event obstacle; /* POT_BARRED, POT_MET: what is met; of type 0: nothing */
} pot;

/* Sets cue->phi by carom_plan_aim(), which knows of squirt and throw, and plays the shot. The
 * arguments are such that carom_shot_check() accepts them. */
pot_result pot_aim(const carom_table *table, const carom_shot_ball *balls, int count,
                   const carom_shot_options *options, int ball, int pocket, carom_cue *cue,
                   pot *found);

#endif
