/* Rows that can be resolved but hardly were meant: centres that are not R1 + R2 apart, motion
 * and balls that no table sees, and tips of cues so far from the centre that they slip off the
 * ball.
 *
 * Most such input is in other units. The library resolves it all the same: of the positions only
 * the direction between the centres counts.
 */
#ifndef CAROM_CLI_DOUBTS_H
#define CAROM_CLI_DOUBTS_H

#include "rows/kind.h"

enum { DOUBT_APART, DOUBT_SPEED, DOUBT_SPIN, DOUBT_RADIUS, DOUBT_MASS, DOUBT_TIP, DOUBTS };

/* How many rows of an input were doubtful, and the first number of each doubt: the distance of
 * the centres over R1 + R2, m/s, rad/s, m, kg, R. */
typedef struct doubts {
  long long rows, count[DOUBTS];
  double first[DOUBTS];
} doubts;

/* Looks at a row that the library takes, or a shot by its tip's distance from the centre, in R,
 * and counts it. Returns NULL, or the name of what is doubtful, which --strict makes the status
 * of the row: "not_touching", "implausible_speed", ... */
const char *doubts_about(doubts *d, const row_kind *kind, const double *in);
const char *doubts_about_tip(doubts *d, double offset);

/* From where on a chalked tip slips off a ball, R from the centre. */
#define TIP_LIMIT 0.5

/* Says what has been counted, with a guess at its cause; `noun` is what a row is called. */
void doubts_report(const doubts *d, const char *noun, const char *file);

#endif
