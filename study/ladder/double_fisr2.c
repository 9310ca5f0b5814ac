/* double_fisr2: double_fisr1 with a second Newton step. */
#define RUNG_FUNCTION carom_rung_double_fisr2
#define RUNG_BITS 64
#define TRICK_BITS 32
#define NEWTON_STEPS 2
#include "fisr.h"
