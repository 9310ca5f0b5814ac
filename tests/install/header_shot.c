/* carom_shot.h by itself, in C and in C++, and the layouts that callers rely on. */
#include "carom_shot.h"

#ifdef __cplusplus
#define STATIC_ASSERT static_assert
#else
#define STATIC_ASSERT _Static_assert
#endif

STATIC_ASSERT(sizeof(carom_cushion_impact) == 15 * sizeof(double), "an impact is 15 doubles");
STATIC_ASSERT(sizeof(carom_motion) == 6 * sizeof(double), "a motion is 6 doubles");
STATIC_ASSERT(sizeof(carom_cushion_options) == 72, "options have no gaps that a compiler may fill");
STATIC_ASSERT(CAROM_CUSHION_MATHAVAN == 0 && CAROM_CUSHION_EULER == 4, "values are never changed");

int use(const carom_cushion_impact *in, carom_motion *out);
int use(const carom_cushion_impact *in, carom_motion *out) {
  return carom_cushion(in, NULL, out) == CAROM_OK;
}
