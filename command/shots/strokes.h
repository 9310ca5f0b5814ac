/* The strokes of a subcommand: of a file of shots, or by its options. */
#ifndef CAROM_CLI_STROKES_H
#define CAROM_CLI_STROKES_H

#include "shots/shoot_flags.h"
#include "shots/shot_file.h"

extern const option_row option_layout;

/* Whether the numbers of --with are for the tables of a file; else a complaint. */
bool with_fits_file(const given_numbers *with);

/* The balls that a subcommand takes which plays the shots of a file again: by default those before
 * each shot. */
layout_moment played_again(const shared_options *shared);

/* Opens the file of a subcommand, or the shots that its options describe; complains and returns
 * NULL where both or none are given, or it cannot. */
shot_file *layout_open(shoot_flags *f, const char *path, const carom_shot_options *options,
                       int most);

/* Reads all shots of the file with the numbers of --with, at most `most`, of which all must have
 * the layout of the first one; where `most` is 1, the first alone. *line is to be freed; how
 * many, with their strokes in cues[]. 0 after a complaint. */
int strokes_read(shot_file *file, const shared_options *shared, shot_line *line, carom_cue *cues,
                 int most);

#endif
