/* Collisions that can be resolved but hardly were meant: centres that are not R1 + R2 apart, and motion that no table sees.
 *
 * Most such input is in other units. The library resolves it all the same, as only the direction between the centres counts.
 */
#ifndef CAROM_CLI_DOUBTS_H
#define CAROM_CLI_DOUBTS_H

#include "carom.h"

#include <stdbool.h>

/* How many collisions of an input were doubtful, and the first of each kind. */
typedef struct doubts {
  long long rows, apart, fast, spinning;
  double share, speed, spin; /* distance of the centres over R1 + R2; m/s; rad/s */
} doubts;

/* Looks at a collision that the library takes, and counts it. Returns NULL, or the name of what is doubtful, which --strict
 * makes the status of the row: "not_touching", "implausible_speed" or "implausible_spin". `distance` says whether the
 * distance of the centres is to be looked at. */
const char *doubts_about(doubts *d, const carom_impact *in, bool distance);

/* Says what has been counted, with a guess at its cause. */
void doubts_report(const doubts *d, const char *file);

#endif
