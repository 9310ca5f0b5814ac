/* The layout that the options of a shot describe. */
#ifndef CAROM_CLI_LAY_OUT_H
#define CAROM_CLI_LAY_OUT_H

#include "shots/shoot_flags.h"
#include "shots/shot_file.h"

/* The numbers of the balls and the cue in a combination: of --with, and those of --cue-ball and of
 * the tip. */
typedef struct chosen_numbers {
  given_numbers every_ball, cue_ball;
} chosen_numbers;

/* The layout with rack number `shot` of those that gaps and seeds describe, on a table that the
 * file keeps; false after a complaint. */
bool lay_out(const shoot_flags *f, shot_file *file, carom_shot_cushion cushion,
             const chosen_numbers *numbers, int shot, layout *l);

/* The place of a ball of radius R that touches a rail, or with R = 0 of a point of its nose; false
 * where the place is at none. */
bool place_at_rail(const layout *l, const given_place *request, double R, double place[2]);

#endif
