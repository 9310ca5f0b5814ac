/* The judge of `carom verify`: a match that reads its own lines. */
#include "game/judge_match.h"

#include "carom_match.h"

#include <stdio.h>

static carom_match match;
static carom_record scratch;
static int64_t rulings; /* of all matches of a set */

bool judge_line(const char *line, size_t size, char why[JUDGED_TEXT]) {
  const int64_t known = match.rulings;
  const carom_status status = carom_match_read(&match, &scratch, line, size);
  if (match.rulings > known)
    rulings += match.rulings - known;
  snprintf(why, JUDGED_TEXT, "%s", match.fault);
  return status == CAROM_OK;
}

bool judge_end(char what[JUDGED_TEXT]) {
  char winner[128] = "nobody has won", set[64] = "";
  if (match.winner == CAROM_DRAWN)
    snprintf(winner, sizeof winner, "the match is drawn");
  else if (match.winner > 0 && match.seating.seat[match.winner - 1].name[0] != '\0')
    carom_match_string(&match, winner, sizeof winner);
  else if (match.winner > 0)
    snprintf(winner, sizeof winner, "player %d has won", (int)match.winner);
  carom_standing standing;
  carom_match_standing(&match, &standing);
  if (match.record.set.race > 0)
    snprintf(set, sizeof set, "; match %d of a set, which stands %d : %d",
             (int)match.record.set.number, (int)standing.won[0], (int)standing.won[1]);
  snprintf(what, JUDGED_TEXT, "%lld rulings by the rules; %s%s", (long long)rulings, winner, set);
  return match.size == 0;
}
