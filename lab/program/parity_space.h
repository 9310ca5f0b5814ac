/* `carom-lab parity` of shots recorded in space: see parity_space.c. */
#ifndef CAROM_LAB_PARITY_SPACE_H
#define CAROM_LAB_PARITY_SPACE_H

#include "shot_file.h"

/* What is compared at each event. */
typedef struct space_stage {
  long compared, left_out, apart; /* apart: the models differ by more than rounding as they are */
  double as_is, by_rule;          /* largest differences, the second one with pooltool's rule in the place of carom's */
} space_stage;

enum {
  SPACE_STRIKE,
  SPACE_MOTION,
  SPACE_NEXT,
  SPACE_POCKET,
  SPACE_SLATE,
  SPACE_SPHERES,
  SPACE_RAIL,
  SPACE_NEAR,
  SPACE_LYING,
  SPACE_STAGES
};

/* Events that carom's rules give where pooltool's give others. */
typedef struct space_other {
  const char *pooltool, *carom;
  long count;
} space_other;

typedef struct space_parity {
  long shots, events, ended, bad; /* ended: by an error of pooltool; bad: no such record */
  long stick, stay;               /* landings at which the ball sticks, and after which pooltool lets it stay down */
  space_stage stage[SPACE_STAGES];
  space_other other[64];
  int others;
} space_parity;

/* Compares a recorded shot, event by event. False, with the reason in `why`, where it is not such a record. */
bool space_compare(const shot_line *line, space_parity *p, char why[200]);

/* Prints the table. Whether all that should agree does. */
bool space_report(const space_parity *p);

#endif
