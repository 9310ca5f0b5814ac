/* double_fisr64_2: double_fisr64_1 with a second Newton step. */
#define RUNG_FUNCTION carom_rung_double_fisr64_2
#define RUNG_BITS 64
#define TRICK_BITS 64
#define NEWTON_STEPS 2
#include "fisr.h"
