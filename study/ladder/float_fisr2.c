/* float_fisr2: float_fisr1 with a second Newton step. */
#define RUNG_FUNCTION carom_rung_float_fisr2
#define RUNG_BITS 32
#define TRICK_BITS 32
#define NEWTON_STEPS 2
#include "fisr.h"
