/* carom_plan.h by itself, in C and in C++, and the layouts that callers rely on. */
#include "carom_plan.h"

#ifdef __cplusplus
#define STATIC_ASSERT static_assert
#else
#define STATIC_ASSERT _Static_assert
#endif

STATIC_ASSERT(sizeof(carom_player) == 12 * sizeof(double), "a player is 12 doubles");
STATIC_ASSERT(sizeof(carom_choice) == 192, "choices have no gaps that a compiler may fill");
STATIC_ASSERT(CAROM_RULES_EIGHTBALL == 0 && CAROM_TURN_LOSE == 3 && CAROM_PLAN_GIVEN == 3,
              "values are never changed");

int use(const carom_plan_job *in, carom_choice *out, int *found);
int use(const carom_plan_job *in, carom_choice *out, int *found) {
  return carom_plan(in, out, 1, found);
}
