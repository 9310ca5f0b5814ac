/* What is wrong with the arguments of a shot, in words. */
#ifndef CAROM_CLI_SHOT_FAULT_H
#define CAROM_CLI_SHOT_FAULT_H

#include "program/options.h"
#include "shots/shot_file.h"

enum { FAULT_TEXT = 300 };

/* How far the tip is from the centre, R. */
double tip_off_centre(const carom_cue *cue);

/* What is wrong, with the key. False if nothing is. */
bool shot_fault(const shot_line *line, const carom_shot_options *options, char text[FAULT_TEXT]);

/* Gives balls and cue the numbers of --with, and says once for each, which then is in `told`, which
 * numbers of a file these models do not read. --strict makes it an error of the line. */
void shot_numbers(shot_line *line, const shared_options *shared, const char *file,
                  uint64_t *warned);

#endif
