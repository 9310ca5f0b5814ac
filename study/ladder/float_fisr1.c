/* float_fisr1: the bit trick of double_fisr1 in the loops of `float`, one Newton step.
 *
 * Nothing is converted here, neither for the trick nor for the instruction.
 */
#define RUNG_FUNCTION carom_rung_float_fisr1
#define RUNG_BITS 32
#define TRICK_BITS 32
#define NEWTON_STEPS 1
#include "fisr.h"
