/* Recordings of matches, one behind the other, as lines that are read and judged. */
#include "game/match_lines.h"

#include "program/message.h"

#include <string.h>

bool match_line_read(carom_match *match, const char *path, const char *line, size_t size) {
  static const char head[] = "{\"recording\"";
  static carom_record scratch;
  carom_standing standing;
  const bool begins = strncmp(line, head, sizeof head - 1) == 0;
  if (begins && match->phase == CAROM_MATCH_OVER &&
      carom_match_standing(match, &standing) == CAROM_OK &&
      (match->record.set.race == 0 || standing.set_winner > 0))
    *match = (carom_match){0};
  if (carom_match_read(match, &scratch, line, size) == CAROM_OK)
    return true;
  complain("%s: %s", path, match->fault);
  return false;
}
