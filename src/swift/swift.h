/* The swift solver of the exact limit, for the collisions of ordinary balls. See swift.c. */
#ifndef CAROM_SRC_SWIFT_SWIFT_H
#define CAROM_SRC_SWIFT_SWIFT_H

#include "batch/batch.h"
#include "exact.h"

#include <stdbool.h>

/* Resolves the collision and returns true, or returns false and leaves *out unspecified: the numbers in *in were not checked
 * before, and whatever is wrong or out of its range is left to the others. `s` is the sign of the spin in the cloth slip;
 * `report` may be NULL. */
typedef bool carom_swift_solver(const carom_impact *in, double s, carom_result *out, carom_exact_report *report);

#define CAROM_SWIFT_PROTOTYPE(NAME, suffix) carom_swift_solver carom_swift_##suffix;
CAROM_BUILT_ISAS(CAROM_SWIFT_PROTOTYPE)
#undef CAROM_SWIFT_PROTOTYPE

/* That of the instruction set in force. */
carom_swift_solver *carom_swift(void);

#endif
