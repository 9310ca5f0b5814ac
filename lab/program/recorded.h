/* Recorded shots, played again. */
#ifndef CAROM_LAB_RECORDED_H
#define CAROM_LAB_RECORDED_H

#include "shot_file.h"

/* Plays a shot that was read without error; shot->events, all of them, are to be freed. */
carom_status play_recorded(const shot_line *line, const carom_shot_options *options,
                           carom_shot *shot);

#endif
