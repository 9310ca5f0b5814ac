/* Rows that can be resolved but hardly were meant: centres that are not R1 + R2 apart, and motion and balls that no table sees.
 *
 * Most such input is in other units. The library resolves it all the same: of the positions only the direction between the
 * centres counts.
 */
#ifndef CAROM_CLI_DOUBTS_H
#define CAROM_CLI_DOUBTS_H

#include "kind.h"

enum { DOUBT_APART, DOUBT_SPEED, DOUBT_SPIN, DOUBT_RADIUS, DOUBT_MASS, DOUBTS };

/* How many rows of an input were doubtful, and the first number of each doubt: the distance of the centres over R1 + R2, m/s,
 * rad/s, m, kg. */
typedef struct doubts {
  long long rows, count[DOUBTS];
  double first[DOUBTS];
} doubts;

/* Looks at a row that the library takes, and counts it. Returns NULL, or the name of what is doubtful, which --strict makes the
 * status of the row: "not_touching", "implausible_speed", ... */
const char *doubts_about(doubts *d, const row_kind *kind, const double *in);

/* Says what has been counted, with a guess at its cause. */
void doubts_report(const doubts *d, const row_kind *kind, const char *file);

#endif
