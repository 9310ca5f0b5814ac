/* The rules of a world: everything that shots do otherwise in one world than in another, but for
 * its default models, shot.h. The loop, the detection and the models read them here, and do not
 * test which rules apply. */
#ifndef CAROM_SRC_SHOT_RULES_H
#define CAROM_SRC_SHOT_RULES_H

#include "motion/gap.h"
#include "shot/sim.h"

typedef struct carom_rules {
  bool flat;           /* balls stay on the cloth, whatever the options are */
  bool one_mass;       /* all balls have equal masses */
  bool clusters;       /* contacts of several balls at one instant may last: options.simultaneous */
  bool contacts_slide; /* after a strike or a contact a ball slides, even where it would roll */
  bool abrupt_jaws;    /* jaws have their own friction right from their seams on */
  double simultaneous; /* s: events this much later than the earliest are simultaneous with it */
  /* numbers that models read in addition to the options */
  carom_slip euler_slip;               /* of Euler's model of two balls */
  carom_cushion_convention convention; /* of the models of cushions */
  double least_step;                   /* N s, of Euler's model of a cushion */
  /* Of `count` simultaneous events the one that goes first. */
  carom_due (*choose)(const carom_sim *sim, const carom_due *pending_events, int count);
  /* The times in [0, T] at which a ball touches the line of a rail, for a gap of g[0] + g[1] t +
   * g[2] t^2, the first one first; the number of them, 0 to 2. The caller takes the first at
   * which the ball is next to the rail. */
  int (*touch_rail)(const double g[3], double T, double times[2]);
  /* The first time in [0, T] at which a ball on the cloth touches a jaw or another ball, its
   * centre `reach` away, or falls into a pocket of a radius; or infinity. */
  double (*touch_jaw)(const carom_separation *d, double reach, double T);
  double (*touch_ball)(const carom_separation *d, double reach, double T);
  double (*enter_pocket)(const carom_separation *d, double radius, double T);
  /* A contact of two balls, or of a ball with a rail or a jaw, now; b is NULL then. Changes the
   * states, labels too. */
  carom_status (*resolve)(carom_sim *sim, const carom_due *pending_events, carom_ball_state *a,
                          carom_ball_state *b);
  /* Resolves balls that part, by Euler's model of two balls; NULL: they stay as they are. */
  void (*part_by_steps)(const carom_impact *in, const carom_options *options, carom_result *out);
} carom_rules;

const carom_rules *carom_rules_carom(void);
const carom_rules *carom_rules_pooltool(void);

static inline const carom_rules *carom_rules_of(carom_world world) {
  return world == CAROM_WORLD_POOLTOOL ? carom_rules_pooltool() : carom_rules_carom();
}

#endif
