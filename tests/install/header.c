/* The public header by itself, in C and in C++, and the constants that callers rely on. */
#include "carom.h"

#ifdef __cplusplus
#define STATIC_ASSERT static_assert
#else
#define STATIC_ASSERT _Static_assert
#endif

STATIC_ASSERT(sizeof(carom_ball) == 12 * sizeof(double), "a ball is 12 doubles");
STATIC_ASSERT(sizeof(carom_impact) == 26 * sizeof(double), "an impact is 26 doubles");
STATIC_ASSERT(sizeof(carom_result) == 12 * sizeof(double), "a result is 12 doubles");
STATIC_ASSERT(CAROM_OK == 0 && CAROM_SEPARATING > 0 && CAROM_ERROR_NULL < 0,
              "signs of the statuses");

int use(const carom_impact *in, carom_result *out);
int use(const carom_impact *in, carom_result *out) {
#ifdef __cplusplus
  carom_options options = {};
#else
  carom_options options = {0};
#endif
  options.slip = CAROM_SLIP_POOLTOOL;
  return carom_collide(in, &options, out) == CAROM_OK && carom_serves(CAROM_VERSION_NUMBER);
}
