/* Recorded shots, played again. */
#include "recorded.h"

#include "memory.h"

#include <stdlib.h>

carom_status play_recorded(const shot_line *line, const carom_shot_options *options,
                           carom_shot *shot) {
  *shot = (carom_shot){.room = 256};
  for (;;) {
    shot->events = allocate((size_t)shot->room, sizeof *shot->events);
    const carom_status status =
        carom_shoot(&line->table->table, line->ball, line->count, &line->cue, options, shot);
    if (shot->count <= shot->room)
      return status;
    shot->room = shot->count;
    free(shot->events);
  }
}
