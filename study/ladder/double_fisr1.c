/* double_fisr1: Walsh's "fast inverse square root" in place of the instruction, one Newton step.
 *
 * The trick is in single precision here, with the conversions of `double`.
 */
#define RUNG_FUNCTION carom_rung_double_fisr1
#define RUNG_BITS 64
#define TRICK_BITS 32
#define NEWTON_STEPS 1
#include "fisr.h"
