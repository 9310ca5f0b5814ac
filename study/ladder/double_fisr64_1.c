/* double_fisr64_1: the bit trick of double_fisr1 in double precision, one Newton step.
 *
 * It needs no conversions, but costs more in the chain than the two that it saves.
 */
#define RUNG_FUNCTION carom_rung_double_fisr64_1
#define RUNG_BITS 64
#define TRICK_BITS 64
#define NEWTON_STEPS 1
#include "fisr.h"
