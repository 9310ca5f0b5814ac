/* The shots that options describe, `carom shoot --cue 0.6,0.8 --at-ball 1 --cut 20 --balls
 * 0.6,1.5`, as shots of a file. */
#ifndef CAROM_CLI_GIVEN_SHOTS_H
#define CAROM_CLI_GIVEN_SHOTS_H

#include "shots/shoot_flags.h"
#include "shots/shot_file.h"

#define SHOTS_GIVEN "the shot given"

/* The shots, one for each combination and at most `most`, aimed for a play by these options, as a
 * file of the name SHOTS_GIVEN; NULL after a complaint. With f->tries it may have none. */
shot_file *flags_open(shoot_flags *f, const carom_shot_options *options, int most);

#endif
