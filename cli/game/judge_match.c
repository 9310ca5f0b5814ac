/* The judge of `carom verify`: a match that reads its own lines. */
#include "game/judge_match.h"

#include "carom_match.h"

#include <stdio.h>

static carom_match match;
static carom_record scratch;

bool judge_line(const char *line, size_t size, char why[JUDGED_TEXT]) {
  const carom_status status = carom_match_read(&match, &scratch, line, size);
  snprintf(why, JUDGED_TEXT, "%s", match.fault);
  return status == CAROM_OK;
}

bool judge_end(char what[JUDGED_TEXT]) {
  static const char *const ends[] = {"nobody has won", "player 1 has won", "player 2 has won",
                                     "the match is drawn"};
  snprintf(what, JUDGED_TEXT, "%lld rulings by the rules; %s", (long long)match.rulings,
           ends[match.winner]);
  return match.size == 0;
}
