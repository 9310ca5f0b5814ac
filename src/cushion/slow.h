/* Slips whose rate is small. See slow.c. */
#ifndef CAROM_SRC_CUSHION_SLOW_H
#define CAROM_SRC_CUSHION_SLOW_H

#include "cushion/mathavan.h"

/* Whether a contact slips, and the rate of its slip is small against what friction does to it. */
bool carom_slip_is_stiff(const carom_cushion_way *way, bool cloth);

/* Takes a slip as slow from here on, if it is small against what turns it. `regime` has the direction with which to begin. */
bool carom_slow_begin(carom_cushion_way *way, bool cloth, bool falls, carom_regime regime);

/* The same after a step, if a slip that falls has become slow. */
bool carom_slow_try(carom_cushion_way *way, bool cloth);

/* After a step of a slow slip: its direction is the quasi-steady one, whatever errors have added up to. False if it is too
 * large for that now. */
bool carom_slow_keep(carom_cushion_way *way);

/* Takes a slow slip to where it ends, at zero or because it is too large, if the way there is short and no event is on it.
 * carom_slow_end() is due then. */
bool carom_slow_finish(carom_cushion_way *way);

/* A slow slip has become zero, which may change the regime, or too large. Returns whether it is zero. */
bool carom_slow_end(carom_cushion_way *way);

#endif
