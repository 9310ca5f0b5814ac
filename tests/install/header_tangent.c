/* carom_tangent.h by itself, in C and in C++, and the layouts that callers rely on. */
#include "carom_tangent.h"

#ifdef __cplusplus
#define STATIC_ASSERT static_assert
#else
#define STATIC_ASSERT _Static_assert
#endif

STATIC_ASSERT(sizeof(carom_tangent_seeds) == 72, "options have no gaps that a compiler may fill");
STATIC_ASSERT(CAROM_STATE_NUMBERS == 9 && CAROM_CUE_NUMBERS == 7 && CAROM_DIRECTIONS_MOST == 64,
              "rows that callers rely on");

int use(const carom_impact *in, const double *seeds, double *tangent);
int use(const carom_impact *in, const double *seeds, double *tangent) {
  return carom_collide_tangent(in, NULL, 1, seeds, tangent, NULL) == CAROM_OK;
}
