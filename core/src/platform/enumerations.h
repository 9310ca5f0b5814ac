/* How many values the public enumerations have; in carom.h these numbers would change with every
 * addition. */
#ifndef CAROM_SRC_PLATFORM_ENUMERATIONS_H
#define CAROM_SRC_PLATFORM_ENUMERATIONS_H

#include "carom.h"

#define CAROM_SOLVER_COUNT (CAROM_SOLVER_FAST + 1)
#define CAROM_SLIP_COUNT (CAROM_SLIP_POOLTOOL + 1)
#define CAROM_ISA_COUNT (CAROM_ISA_AVX512 + 1)

#endif
